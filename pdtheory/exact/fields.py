"""The coefficients of power series: one field where its arithmetic is exact, else one ring.

Algebraic numbers and free parameters form a field Q(a)(p, q, ...) in which SymPy adds, multiplies
and divides in a normal form; so does one transcendental number beside them. Several such numbers
may depend on each other, as cosh(1) and sinh(1) do, and a division would not see it; and a tower of
roots may generate a field of a degree that nobody can wait for. Such numbers become the variables
of a polynomial ring, in which only sums and products are taken: those are right whatever the
relations between the numbers are. What vanishes is decided afterwards (`zeros`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import cached_property
from math import factorial
from typing import Any

import sympy as sp
from sympy.polys.rings import ring

from pdtheory.exact.coefficients import tidy
from pdtheory.exact.faces import BinaryForm
from pdtheory.exact.numberfield import composed, in_number_field, is_composed
from pdtheory.exact.powerseries import Series
from pdtheory.exact.separation import (
    MOST_SQUARE_ROOTS,
    extent,
    is_known_algebraic,
    is_square_root,
)
from pdtheory.exact.zeros import is_zero


class Field:
    """The coefficients, with the ring of polynomials in some variables over them.

    Parameters
    ----------
    constants
        SymPy expressions that must be among the coefficients.
    variables
        Names of the variables of the polynomials, separated by commas.

    Attributes
    ----------
    divides : bool
        True if the coefficients form a field, so that they may be divided.
    numbers : list
        The numbers that stand beside those of the ground field, such as pi.
    """

    def __init__(self, constants: Iterable[Any], variables: str = "x,y") -> None:
        listed = [*dict.fromkeys([sp.Integer(1), *constants])]
        self._in_field = _membership(listed)
        parts, atoms = self._parts(listed, into_quotients=True)
        numbers = [a for a in atoms if not a.is_Symbol]
        self.divides = len(numbers) <= 1 and all(
            not a.free_symbols and a.is_algebraic is False for a in numbers
        )
        if not self.divides:
            parts, atoms = self._parts(listed, into_quotients=False)
        self.numbers = [a for a in atoms if not a.is_Symbol]
        self._names = {a: a if a.is_Symbol else sp.Dummy() for a in atoms}
        self._meaning = {name: a for a, name in self._names.items()}
        ground, elements = in_number_field(parts)
        symbols = [*self._names.values()]
        if self.divides:
            self.domain = ground.frac_field(*symbols) if symbols else ground
        else:
            self.domain = ground.poly_ring(*symbols)
        if symbols:
            elements = [self.domain.convert_from(e, ground) for e in elements]
        self._known = dict(zip(parts, elements, strict=True))
        if symbols:
            self._known.update(zip(self._names, self.domain.gens, strict=True))
        self._variable_names = variables

    @cached_property
    def _ring(self) -> tuple[Any, ...]:
        return tuple(ring(self._variable_names, self.domain))

    @property
    def ring(self) -> Any:
        """The ring of polynomials in the variables."""
        return self._ring[0]

    @property
    def variables(self) -> tuple[Any, ...]:
        """The variables of the polynomials."""
        return self._ring[1:]

    def element(self, constant: Any) -> Any:
        """Return a constant as a coefficient."""
        constant = sp.sympify(constant, strict=True)
        if constant not in self._known:
            self._known[constant] = composed(constant, self.domain, self.element)
        return self._known[constant]

    def expression(self, element: Any) -> Any:
        """Return a coefficient as a SymPy expression; 0 if it vanishes."""
        value = self.domain.to_sympy(element)
        if self.divides:
            value = tidy(value.xreplace(self._meaning))
        else:
            # The numbers behind the variables may be long: they stay as they were.
            value = tidy(value).xreplace(self._meaning)
        return sp.Integer(0) if is_zero(value) else value

    def series(self, degree: int, *terms: Any) -> Series:
        """Return the series with these first parts, elements of the ring or of its ground."""
        parts = [self.ring(t) for t in terms[: degree + 1]]
        return Series((*parts, *([self.ring.zero] * (degree + 1 - len(parts)))))

    def linear(self, coefficients: Sequence[Any]) -> Any:
        """Return the sum of coefficients times the first variables of the ring."""
        pairs = zip(self.variables, coefficients, strict=False)
        return sum((w * self.element(c) for w, c in pairs), self.ring.zero)

    def forms(self, series: Series) -> list[BinaryForm]:
        """Return T_k v^k = k! times the homogeneous part, for k = 0 to K."""
        result = []
        for k, term in enumerate(series.terms):
            coefficients = [sp.Integer(0)] * (k + 1)
            for (_, j), c in term.terms():
                coefficients[j] = factorial(k) * self.expression(c)
            result.append(BinaryForm(coefficients))
        return result

    def _parts(
        self, constants: Iterable[Any], *, into_quotients: bool
    ) -> tuple[list[Any], list[Any]]:
        """Return the algebraic numbers in sums, products and powers, and what else is in them."""
        algebraic: dict[Any, None] = {}
        others: dict[Any, None] = {}

        def walk(node: Any) -> None:
            if self._in_field(node):
                algebraic[node] = None
            elif node.is_Add or node.is_Mul:
                for part in node.args:
                    walk(part)
            elif node.is_Pow and node.exp.is_Integer and (into_quotients or node.exp > 0):
                walk(node.base)
            else:
                others[node] = None

        for constant in constants:
            walk(constant)
        return [*algebraic], [*others]


def _membership(constants: Sequence[Any]) -> Callable[[Any], bool]:
    """Return which subexpressions of the constants count as elements of the algebraic field.

    All algebraic numbers do if the field that they generate is small enough, else those of square
    roots of rational numbers, or rational numbers alone.
    """
    size = extent(c for c in constants if is_known_algebraic(c))
    if size.is_small:
        return is_known_algebraic
    if size.square_roots <= MOST_SQUARE_ROOTS:
        return _is_of_square_roots
    return lambda node: bool(node.is_Rational)


def _is_of_square_roots(node: Any) -> bool:
    if node.is_Rational or is_square_root(node):
        return True
    return is_composed(node) and all(_is_of_square_roots(a) for a in node.args)
