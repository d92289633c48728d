"""Expressions evaluated on power series: function by function along the expression tree."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from math import factorial
from typing import Any

import sympy as sp

from pdtheory.errors import ExpressionError
from pdtheory.exact.coefficients import exact
from pdtheory.exact.enclosing import is_finite
from pdtheory.exact.fields import Field
from pdtheory.exact.powerseries import Series
from pdtheory.exact.zeros import is_real, is_zero

_Z = sp.Symbol("z")


class Expansion:
    """An expression ready to be evaluated on power series about one point.

    Parameters
    ----------
    expression
        A SymPy expression.
    point
        Exact value of each variable at the point of expansion.
    degree
        Degree K of the truncation.
    constant_matters
        Whether the constant term will be used; if not, it may come out wrong.

    Raises
    ------
    ExpressionError
        If the expression is not smooth at the point, or holds something that has no derivative.
    """

    def __init__(
        self,
        expression: Any,
        point: Mapping[Any, Any],
        degree: int,
        *,
        constant_matters: bool = True,
    ) -> None:
        self.expression = exact(expression)
        self.point = {symbol: exact(value) for symbol, value in point.items()}
        self.degree = degree
        self._leaves = [
            e for e in _constant_leaves(self.expression, set(self.point)) if not e.is_Rational
        ]
        for constant in (*self._leaves, *self.point.values()):
            if not constant.free_symbols and not is_finite(constant):
                raise ExpressionError(f"The constant {constant} has no finite value.")
        self._univariate: dict[Any, tuple[Any, list[Any]]] = {}
        self._collect(self.expression)
        #: Variables whose value at the point enters the arithmetic. In sin(u) it does not: only
        #: sin and cos of it do, so that a point such as pi/3 brings no pi into the field.
        self.needed: set[Any] = set()
        self._find_needed(self.expression, constant_matters)

    @property
    def constants(self) -> list[Any]:
        """All constants that the evaluation needs in its field."""
        values = [c for _, coefficients in self._univariate.values() for c in coefficients]
        return [*values, *self._leaves, *(self.point[s] for s in self.needed)]

    def evaluate(self, field: Field, arguments: Mapping[Any, Series]) -> Series:
        """Return the series of the expression for series put in place of the variables."""
        cache: dict[Any, Series] = {}

        def walk(node: Any) -> Series:
            if node not in cache:
                cache[node] = self._step(node, field, arguments, walk)
            return cache[node]

        return walk(self.expression)

    def _step(self, node: Any, field: Field, arguments: Mapping[Any, Series], walk: Any) -> Series:
        if node in arguments:
            return arguments[node]
        if not node.free_symbols & set(self.point):
            return field.series(self.degree, field.element(node))
        if node in self._univariate:
            argument, coefficients = self._univariate[node]
            return walk(argument).apply([field.element(c) for c in coefficients])
        if node.is_Pow:
            return walk(node.base) ** int(node.exp)
        first, *rest = (walk(a) for a in node.args)
        for other in rest:
            first = first + other if node.is_Add else first * other
        return first

    def _collect(self, node: Any) -> None:
        """Expand every function of one argument below a node about the value of its argument."""
        if node in self._univariate or not node.free_symbols & set(self.point):
            return
        if node.is_Symbol:
            return
        if node.is_Add or node.is_Mul or (node.is_Pow and node.exp.is_Integer and node.exp > 0):
            for child in node.args:
                self._collect(child)
            return
        if node.is_Pow and not node.base.free_symbols & set(self.point):
            argument, function = node.exp, node.base**_Z
        elif node.is_Pow and not node.exp.free_symbols & set(self.point):
            argument, function = node.base, _Z**node.exp
        elif node.is_Function and len(node.args) == 1:
            argument, function = node.args[0], node.func(_Z)
        else:
            raise ExpressionError(f"{node} cannot be expanded: it is no function of one argument.")
        self._collect(argument)
        start = argument.subs(self.point, simultaneous=True)
        if is_zero(start):
            start = sp.Integer(0)
        coefficients = []
        for j in range(self.degree + 1):
            value = _derivative(function, j).subs(_Z, start) / factorial(j)
            if value.has(sp.zoo, sp.nan, sp.oo, -sp.oo, sp.Subs, sp.Derivative):
                raise self._refusal(node, f"has no derivative of order {j}", start)
            coefficients.append(sp.expand(value))
        # The value and the slope leave the real numbers where the function is not defined.
        if _counts_as_real(start, otherwise=False) and not all(
            _counts_as_real(c, otherwise=True) for c in coefficients[:2]
        ):
            raise self._refusal(node, "is not real", start)
        self._univariate[node] = (argument, coefficients)

    def _refusal(self, node: Any, what: str, start: Any) -> ExpressionError:
        place = ", ".join(f"{s} = {v}" for s, v in self.point.items())
        return ExpressionError(
            f"{node} {what} at {place}, where its argument is {start}; choose another point."
        )

    def _find_needed(self, node: Any, constant_matters: bool) -> None:
        variables = set(self.point)
        if node.is_Symbol:
            if constant_matters and node in variables:
                self.needed.add(node)
        elif node in self._univariate:
            self._find_needed(self._univariate[node][0], False)
        elif node.is_Add:
            for child in node.args:
                self._find_needed(child, constant_matters)
        else:
            moving = [child for child in node.args if child.free_symbols & variables]
            for child in moving:
                product = len(moving) > 1 or node.is_Pow
                self._find_needed(child, constant_matters or product)


def _counts_as_real(value: Any, *, otherwise: bool) -> bool:
    """Return whether a value is real; with symbols of unknown kind what is passed for them."""
    if not value.free_symbols:
        return is_real(value)
    return otherwise if value.is_real is None else bool(value.is_real)


@lru_cache(maxsize=4096)
def _derivative(function: Any, order: int) -> Any:
    """Return a derivative of a function of one argument, kept compact."""
    if order == 0:
        return function
    if function.is_Pow and function.base == _Z:
        return sp.ff(function.exp, order) * _Z ** (function.exp - order)
    return sp.cancel(sp.diff(_derivative(function, order - 1), _Z))


def _constant_leaves(node: Any, variables: set[Any]) -> list[Any]:
    if not node.free_symbols & variables:
        return [node]
    return [leaf for child in node.args for leaf in _constant_leaves(child, variables)]
