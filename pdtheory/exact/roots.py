"""The real zeros of a binary form with real algebraic coefficients, with proof of their number."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

import sympy as sp

from pdtheory.errors import InputError
from pdtheory.exact.algebraic import FIRST_BITS, RealAlgebraic, precisions, primitive
from pdtheory.exact.balls import Enclosure, engine, horner, real_roots

_T = sp.Symbol("t")


class Root(NamedTuple):
    """A real zero t = y/x of a binary form, None for x = 0, with its multiplicity."""

    value: RealAlgebraic | None
    multiplicity: int


@dataclass(frozen=True)
class Coefficients:
    """Real algebraic numbers brought into one field Q(a), or into Q.

    Attributes
    ----------
    expressions : tuple
        The numbers as SymPy expressions.
    """

    expressions: tuple[Any, ...]

    @cached_property
    def rationals(self) -> list[Fraction] | None:
        """The numbers as fractions if all are rational, else None."""
        if all(e.is_Rational for e in self.expressions):
            return [Fraction(int(e.p), int(e.q)) for e in self.expressions]
        return None

    @cached_property
    def _field(self) -> tuple[Any, list[Any]]:
        """The field Q(a) and the numbers as elements of it."""
        for e in self.expressions:
            if e.free_symbols:
                names = ", ".join(sorted(str(s) for s in e.free_symbols))
                raise InputError(
                    f"The coefficient {e} depends on {names}; put numbers in their place, or ask "
                    "for the parametric discriminant."
                )
            if not e.is_algebraic:
                raise InputError(
                    f"The coefficient {e} is not known to be algebraic; exact directions need "
                    "rational or real algebraic coefficients."
                )
            if not e.is_real:
                raise InputError(f"The coefficient {e} is not real; the form must be real.")
        field, elements = sp.construct_domain(self.expressions, extension=True, field=True)
        return field, elements

    @cached_property
    def generator(self) -> RealAlgebraic:
        """The generator a of the field."""
        field, _ = self._field
        if field.is_QQ:
            return RealAlgebraic.rational(0)
        minimal = primitive([Fraction(int(c.p), int(c.q)) for c in _rationals(field.mod.to_list())])
        expression = field.ext.as_expr()

        def enclose(bits: int) -> Enclosure:
            value = sp.N(expression, int(bits * 0.302) + 5)
            middle = Fraction(*(int(p) for p in sp.Rational(value).as_numer_denom()))
            slack = max(Fraction(1), abs(middle)) / 2 ** (bits - 8)
            return Enclosure(middle - slack, middle + slack)

        return RealAlgebraic.select(minimal, enclose)

    @cached_property
    def in_generator(self) -> list[list[Fraction]]:
        """Each number as a polynomial in the generator, constant term first."""
        if self.rationals is not None:
            return [[r] for r in self.rationals]
        field, elements = self._field
        if field.is_QQ:
            return [[Fraction(int(e.numerator), int(e.denominator))] for e in elements]
        return [
            [Fraction(int(c.p), int(c.q)) for c in _rationals(e.to_list())] or [Fraction(0)]
            for e in elements
        ]

    def intervals(self, bits: int) -> list[Any]:
        """Return interval numbers of the engine for the coefficients (inside its `precision`)."""
        number = engine().interval
        if self.rationals is not None:
            return [number(Enclosure(r, r)) for r in self.rationals]
        a = number(self.generator.at_precision(bits))
        return [horner([number(Enclosure(c, c)) for c in p], a) for p in self.in_generator]


def _rationals(leading_first: Sequence[Any]) -> list[Any]:
    return [sp.Rational(int(c.numerator), int(c.denominator)) for c in leading_first][::-1]


def form_roots(coefficients: Sequence[Any]) -> list[Root]:
    """Return all real zeros t = y/x of a binary form, ascending, the one at infinity last.

    Over Q the polynomial f(1, t) is factored, so that every root comes with its minimal polynomial
    and its multiplicity. Over Q(a) each squarefree part is factored through its norm, and a
    candidate is kept if the part of its minimal polynomial that divides the squarefree part
    vanishes there, which is decided by excluding zero from one of two complementary factors.

    Parameters
    ----------
    coefficients
        Those of x^k, x^(k-1) y, ..., y^k as SymPy expressions, not all zero.

    Raises
    ------
    InputError
        If a coefficient is not a real algebraic number.
    """
    numbers = Coefficients(tuple(coefficients))
    if numbers.rationals is not None:
        polynomial = primitive(numbers.rationals)
        degree = len(polynomial) - 1
        roots = [
            (RealAlgebraic(p, i), multiplicity)
            for p, multiplicity in engine().factor(polynomial)
            for i in range(len(real_roots(p, FIRST_BITS)))
        ]
    else:
        degree, roots = _algebraic_roots(numbers)
    found = [Root(*pair) for pair in _ascending(roots)]
    at_infinity = len(coefficients) - 1 - degree
    return [*found, Root(None, at_infinity)] if at_infinity else found


def _algebraic_roots(numbers: Coefficients) -> tuple[int, list[tuple[RealAlgebraic, int]]]:
    field, elements = numbers._field
    poly = sp.Poly.from_list(elements[::-1], _T, domain=field)
    if field.is_QQ:
        poly = poly.set_domain(sp.QQ)
    roots = []
    for part, multiplicity in poly.sqf_list()[1]:
        norm = part if field.is_QQ else part.norm()
        for candidate, _ in engine().factor(primitive(_fractions(norm))):
            minimal = sp.Poly(candidate[::-1], _T, domain=field)
            common = sp.gcd(part, minimal)
            rest = minimal.quo(common)
            for i in range(len(real_roots(candidate, FIRST_BITS))):
                root = RealAlgebraic(candidate, i)
                if _vanishes(common, rest, root):
                    roots.append((root, multiplicity))
    return int(poly.degree()), roots


def _fractions(poly: Any) -> list[Fraction]:
    return [Fraction(int(c.p), int(c.q)) for c in poly.all_coeffs()[::-1]]


def _vanishes(common: Any, rest: Any, root: RealAlgebraic) -> bool:
    """Decide which of two complementary factors of the minimal polynomial has the root."""
    if common.degree() <= 0 or rest.degree() <= 0:
        return bool(common.degree() > 0)
    sides = [Coefficients(tuple(p.all_coeffs()[::-1])) for p in (common, rest)]
    for bits in precisions():
        with engine().precision(bits):
            t = engine().interval(root.at_precision(bits))
            signs = [engine().enclosure(horner(side.intervals(bits), t)).sign for side in sides]
        if signs[0] or signs[1]:
            return not signs[0]
    raise AssertionError("unreachable")


def _ascending(roots: list[tuple[RealAlgebraic, int]]) -> list[tuple[RealAlgebraic, int]]:
    """Sort roots that may belong to different polynomials."""
    for bits in precisions():
        placed = sorted(((root[0].at_precision(bits), root) for root in roots), key=_lower_end)
        if all(a[0].upper < b[0].lower for a, b in pairwise(placed)):
            return [root for _, root in placed]
    raise AssertionError("unreachable")


def _lower_end(placed: tuple[Enclosure, tuple[RealAlgebraic, int]]) -> Fraction:
    return placed[0].lower
