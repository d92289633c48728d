"""Taylor expansions in two variables of any expression, exactly and to any degree.

The expression tree is walked once with truncated power series instead of numbers. The constants
that appear on the way (function values at the point) are collected first, so that all arithmetic is
done in one field: Q, Q(a) for algebraic numbers, or rational functions of parameters.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import factorial
from typing import Any

import sympy as sp
from sympy.polys.rings import ring

from pdtheory.errors import ComputationError, ExpressionError, InputError
from pdtheory.exact.coefficients import check_order, exact, is_zero
from pdtheory.exact.faces import BinaryForm
from pdtheory.exact.tensor import SymmetricTensor

_Z = sp.Symbol("z")

#: Largest power of one generator in a field of several: greatest common divisors of such
#: fractions are found from values at large integers, which these powers make unbearably long.
MAX_POWER = 1000


@dataclass(frozen=True)
class Series:
    """A power series in two variables modulo degree K + 1.

    Attributes
    ----------
    terms : tuple
        The homogeneous parts of degrees 0 to K, elements of one SymPy polynomial ring.
    """

    terms: tuple[Any, ...]

    @property
    def degree(self) -> int:
        """The degree K to which the series is known."""
        return len(self.terms) - 1

    def __add__(self, other: Series) -> Series:
        return Series(tuple(a + b for a, b in zip(self.terms, other.terms, strict=True)))

    def __sub__(self, other: Series) -> Series:
        return Series(tuple(a - b for a, b in zip(self.terms, other.terms, strict=True)))

    def __mul__(self, other: Series) -> Series:
        a, b = self.terms, other.terms
        zero = a[0] * 0
        return Series(
            tuple(
                sum((a[i] * b[j - i] for i in range(j + 1) if a[i] and b[j - i]), zero)
                for j in range(len(a))
            )
        )

    def scale(self, factor: Any) -> Series:
        """Return the series times an element of the coefficient field."""
        return Series(tuple(a * factor for a in self.terms))

    def truncate(self, degree: int) -> Series:
        """Return the series modulo a degree lower by one than the first term left out."""
        return Series(self.terms[: degree + 1])

    def extend(self, degree: int) -> Series:
        """Return the series padded with zeros up to a degree."""
        zero = self.terms[0] * 0
        return Series((*self.terms, *([zero] * (degree - self.degree))))

    def without_constant(self) -> Series:
        """Return the series minus its constant term."""
        return Series((self.terms[0] * 0, *self.terms[1:]))

    def apply(self, coefficients: Sequence[Any]) -> Series:
        """Return sum_j c_j (self - constant)^j by Horner's rule."""
        small = self.without_constant()
        value = self.scale(0)
        for c in reversed(coefficients):
            value = value * small
            value = Series((value.terms[0] + c, *value.terms[1:]))
        return value

    def substitute(self, x: Series, y: Series) -> Series:
        """Return self(x, y) for two series of the same degree without constant term."""
        result = self.scale(0)
        one = Series((x.terms[0] * 0 + 1, *(t * 0 for t in x.terms[1:])))
        x_powers, y_powers = [one], [one]
        for _ in range(self.degree):
            x_powers.append(x_powers[-1] * x)
            y_powers.append(y_powers[-1] * y)
        for term in self.terms:
            for (i, j), c in term.terms():
                result = result + (x_powers[i] * y_powers[j]).scale(c)
        return result


class Field:
    """One exact field with the ring of polynomials in two variables over it.

    Parameters
    ----------
    constants
        SymPy expressions that the field must contain.
    """

    def __init__(self, constants: Sequence[Any]) -> None:
        constants = [*dict.fromkeys([sp.Integer(1), *constants])]
        self.domain, elements = sp.construct_domain(constants, extension=True, field=True)
        self._known = dict(zip(constants, elements, strict=True))
        self.ring, self.x, self.y = ring("x,y", self.domain)

    def check_division(self) -> None:
        """Refuse constants whose fractions cannot be reduced in reasonable time.

        Raises
        ------
        ComputationError
            If the field has several generators and a constant holds one to a power above
            `MAX_POWER`, as exp(380689/1562500) does beside exp(1/1562500).
        """
        if not self.domain.is_FractionField or len(self.domain.symbols) < 2:
            return
        power = max(
            max(map(max, part.keys()), default=0)
            for e in self._known.values()
            for part in (e.numer, e.denom)
        )
        if power > MAX_POWER:
            raise ComputationError(
                f"The constants of the surface at this point need the power {power} of one of "
                f"{len(self.domain.symbols)} transcendental numbers or parameters, above "
                f"{MAX_POWER}, too long to divide; choose a point with shorter fractions."
            )

    def element(self, constant: Any) -> Any:
        """Return a constant as an element of the field."""
        constant = sp.sympify(constant)
        if constant not in self._known:
            self._known[constant] = self.domain.from_sympy(constant)
        return self._known[constant]

    def constant(self, value: Any, degree: int) -> Series:
        """Return a constant series."""
        zero = self.ring.zero
        return Series((self.ring.ground_new(self.element(value)), *([zero] * degree)))

    def affine(self, value: Any, x: Any, y: Any, degree: int) -> Series:
        """Return value + x X + y Y."""
        start = self.constant(value, degree)
        if degree == 0:
            return start
        linear = self.x * self.element(x) + self.y * self.element(y)
        return Series((start.terms[0], linear, *start.terms[2:]))

    def variables(
        self, expansions: Sequence[Expansion], x: Any, y: Any, degree: int
    ) -> dict[Any, Series]:
        """Return the series of two variables about the point of some expansions."""
        needed = set().union(*(e.needed for e in expansions))
        point = expansions[0].point
        start = {w: point[w] if w in needed else 0 for w in (x, y)}
        return {x: self.affine(start[x], 1, 0, degree), y: self.affine(start[y], 0, 1, degree)}

    def forms(self, series: Series) -> list[BinaryForm]:
        """Return T_k v^k = k! times the homogeneous part, for k = 0 to K."""
        result = []
        for k, term in enumerate(series.terms):
            coefficients = [sp.Integer(0)] * (k + 1)
            for (_, j), c in term.terms():
                coefficients[j] = factorial(k) * sp.expand(self.domain.to_sympy(c))
            result.append(BinaryForm(coefficients))
        return result


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
        leaves = [
            e for e in _constant_leaves(self.expression, set(self.point)) if not e.is_Rational
        ]
        return [*values, *leaves, *(self.point[s] for s in self.needed)]

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
            return field.constant(node, self.degree)
        if node in self._univariate:
            argument, coefficients = self._univariate[node]
            return walk(argument).apply([field.element(c) for c in coefficients])
        if node.is_Pow:
            return _power(walk(node.base), int(node.exp))
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
                place = ", ".join(f"{s} = {v}" for s, v in self.point.items())
                raise ExpressionError(
                    f"{node} has no derivative of order {j} at {place}, where its argument is "
                    f"{start}; choose another point."
                )
            coefficients.append(sp.expand(value))
        self._univariate[node] = (argument, coefficients)

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


@lru_cache(maxsize=4096)
def _derivative(function: Any, order: int) -> Any:
    """Return a derivative of a function of one argument, kept compact."""
    if order == 0:
        return function
    if function.is_Pow and function.base == _Z:
        return sp.ff(function.exp, order) * _Z ** (function.exp - order)
    return sp.cancel(sp.diff(_derivative(function, order - 1), _Z))


def _power(base: Series, exponent: int) -> Series:
    result: Series | None = None
    while exponent:
        if exponent & 1:
            result = base if result is None else result * base
        exponent >>= 1
        base = base * base if exponent else base
    assert result is not None
    return result


def _constant_leaves(node: Any, variables: set[Any]) -> list[Any]:
    if not node.free_symbols & variables:
        return [node]
    return [leaf for child in node.args for leaf in _constant_leaves(child, variables)]


def taylor_forms(
    f: Any, variables: Sequence[Any], degree: int, at: Sequence[Any] = (0, 0)
) -> list[BinaryForm]:
    """Return the forms T_k v^k of an expression for k = 0 to K, about a point of the plane.

    Parameters
    ----------
    f
        A SymPy expression, smooth at the point.
    variables
        The two variables (x, y).
    degree
        The largest order K.
    at
        The point, with exact coordinates.

    Raises
    ------
    ExpressionError
        If the expression is not smooth there.
    InputError
        If the degree is negative or too large, or a coordinate is no number.
    """
    degree = check_order(degree)
    if len(variables) != 2 or len(at) != 2:
        raise InputError(
            f"Two variables and a point of the plane are needed, not {variables}, {at}."
        )
    (x, y), (x0, y0) = variables, (exact(c) for c in at)
    expansion = Expansion(f, {x: x0, y: y0}, degree)
    field = Field(expansion.constants)
    arguments = field.variables([expansion], x, y, degree)
    return field.forms(expansion.evaluate(field, arguments))


def differential_tensor(
    f: Any, variables: Sequence[Any], order: int, at: Sequence[Any] = (0, 0)
) -> SymmetricTensor:
    """Return the differential tensor T_k of an expression at a point (definition 4 of the paper).

    Its component t_j is the derivative d^k f / dx^(k-j) dy^j.

    Parameters
    ----------
    f
        A SymPy expression, smooth at the point.
    variables
        The two variables (x, y).
    order
        The order k.
    at
        The point, with exact coordinates; the origin by default.

    Raises
    ------
    ExpressionError
        If the expression is not smooth at the point.
    InputError
        If the order is negative or too large.

    Examples
    --------
    >>> x, y = sp.symbols("x y")
    >>> differential_tensor(x**3 - 3 * x * y**2, (x, y), 3)
    SymmetricTensor(order=3, [6, 0, -6, 0])
    """
    return taylor_forms(f, variables, order, at)[order].tensor
