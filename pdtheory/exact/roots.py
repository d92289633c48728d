"""The real zeros of a binary form with real algebraic coefficients, with proof of their number."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, partial
from itertools import pairwise
from typing import Any, NamedTuple

import sympy as sp

from pdtheory.errors import InputError
from pdtheory.exact.algebraic import FIRST_BITS, RealAlgebraic, precisions, primitive
from pdtheory.exact.balls import engine, horner, real_roots
from pdtheory.exact.enclosing import enclose_real
from pdtheory.exact.engines import Integers
from pdtheory.exact.intervals import Enclosure, Rectangle
from pdtheory.exact.separation import extent
from pdtheory.exact.zeros import is_zero, sign

_T = sp.Symbol("t")


class Root(NamedTuple):
    """A real zero t = y/x of a binary form, None for x = 0, with its multiplicity."""

    value: RealAlgebraic | None
    multiplicity: int


@dataclass(frozen=True)
class Coefficients:
    """Real numbers a common factor times elements of one field Q(a), or of Q.

    The factor is 1 if the numbers are algebraic. Else it is the size of the first one that does not
    vanish, and the quotients must be algebraic: pi x^2 + pi sqrt(2) y^2 has the factor pi.

    Attributes
    ----------
    expressions : tuple
        The numbers as SymPy expressions.
    """

    expressions: tuple[Any, ...]

    def check_real_numbers(self) -> None:
        """Refuse coefficients with free symbols and those that are not real."""
        for e in self.expressions:
            if e.free_symbols:
                names = ", ".join(sorted(str(s) for s in e.free_symbols))
                raise InputError(
                    f"The coefficient {e} depends on {names}; put numbers in place of symbols."
                )
            if e.is_real is False:
                raise InputError(f"The coefficient {e} is not real; the form must be real.")

    @cached_property
    def factor(self) -> Any:
        """The common factor, positive."""
        if all(e.is_algebraic for e in self.expressions):
            return sp.Integer(1)
        self.check_real_numbers()
        lead = next(e for e in self.expressions if not is_zero(e))
        return lead if sign(lead) > 0 else -lead

    @cached_property
    def algebraic(self) -> tuple[Any, ...]:
        """The numbers divided by the common factor."""
        if self.factor == 1:
            return self.expressions
        return tuple(sp.radsimp(sp.cancel(e / self.factor)) for e in self.expressions)

    @cached_property
    def rationals(self) -> list[Fraction] | None:
        """The numbers over the factor as fractions if all are rational, else None."""
        if all(e.is_Rational for e in self.algebraic):
            return [Fraction(int(e.p), int(e.q)) for e in self.algebraic]
        return None

    @cached_property
    def field_elements(self) -> tuple[Any, list[Any]]:
        """The field Q(a) and the numbers over the factor as elements of it."""
        for original, e in zip(self.expressions, self.algebraic, strict=True):
            if e.is_real is False:
                raise InputError(f"The coefficient {original} is not real; the form must be real.")
            if not e.is_algebraic:
                culprit = next((c for c in self.expressions if not c.is_algebraic), original)
                raise InputError(
                    f"The coefficient {culprit} is not known to be algebraic, nor to be so over "
                    "a common factor; exact directions need rational or real algebraic numbers."
                )
        size = extent(self.algebraic)
        if size.is_hopeless:
            raise InputError(
                f"The coefficients lie in a field whose degree may be {size.degree}, too large for "
                "exact directions; "
                "use fewer different roots, or rational numbers near to them."
            )
        field, elements = sp.construct_domain(self.algebraic, extension=True, field=True)
        return field, elements

    @cached_property
    def polynomial(self) -> Any:
        """f(1, t) over the factor, as a SymPy polynomial over the field."""
        field, elements = self.field_elements
        poly = sp.Poly.from_list(elements[::-1], _T, domain=field)
        return poly.set_domain(sp.QQ) if field.is_QQ else poly

    @cached_property
    def generator(self) -> RealAlgebraic:
        """The generator a of the field."""
        field, _ = self.field_elements
        if field.is_QQ:
            return RealAlgebraic.rational(0)
        minimal = primitive([Fraction(int(c.p), int(c.q)) for c in _rationals(field.mod.to_list())])
        expression = field.ext.as_expr()
        return RealAlgebraic.select(minimal, lambda bits: enclose_real(expression, bits))

    @cached_property
    def factor_interval(self) -> Callable[[int], Any]:
        """An interval number for the common factor at a working precision in bits."""
        return lambda bits: engine().interval(enclose_real(self.factor, bits))

    @cached_property
    def in_generator(self) -> list[list[Fraction]]:
        """Each number over the factor as a polynomial in the generator, constant term first."""
        if self.rationals is not None:
            return [[r] for r in self.rationals]
        field, elements = self.field_elements
        if field.is_QQ:
            return [[Fraction(int(e.numerator), int(e.denominator))] for e in elements]
        return [
            [Fraction(int(c.p), int(c.q)) for c in _rationals(e.to_list())] or [Fraction(0)]
            for e in elements
        ]

    def intervals(self, bits: int) -> list[Any]:
        """Return interval numbers for the coefficients over the factor (inside `precision`)."""
        if bits not in self._intervals:
            self._intervals[bits] = self._enclose(bits)
        return self._intervals[bits]

    @cached_property
    def _intervals(self) -> dict[int, list[Any]]:
        return {}

    def _enclose(self, bits: int) -> list[Any]:
        number = engine().interval
        if self.rationals is not None:
            return [number(Enclosure(r, r)) for r in self.rationals]
        a = number(self.generator.at_precision(bits))
        return [horner([number(Enclosure(c, c)) for c in p], a) for p in self.in_generator]


def _rationals(leading_first: Sequence[Any]) -> list[Any]:
    return [sp.Rational(int(c.numerator), int(c.denominator)) for c in leading_first][::-1]


def form_roots(coefficients: Sequence[Any], least_multiplicity: int = 1) -> list[Root]:
    """Return all real zeros t = y/x of a binary form, ascending, the one at infinity last.

    Over Q the polynomial f(1, t) is factored, so that every root comes with its minimal polynomial
    and its multiplicity. Over Q(a) each squarefree part is factored through its norm, and a
    candidate is kept if the part of its minimal polynomial that divides the squarefree part
    vanishes there, which is decided by excluding zero from one of two complementary factors.

    Parameters
    ----------
    coefficients
        Those of x^k, x^(k-1) y, ..., y^k as SymPy expressions, not all zero.
    least_multiplicity
        Leave out the zeros of a lower multiplicity.

    Raises
    ------
    InputError
        If a coefficient is not a real algebraic number.
    """
    degree, found = candidates(coefficients)
    roots = [
        (root, multiplicity)
        for factor, part, multiplicity in found
        if multiplicity >= least_multiplicity
        for root in (RealAlgebraic(factor, i) for i in range(len(real_roots(factor, FIRST_BITS))))
        if is_root(part, factor, partial(_real_place, root))
    ]
    ascending = [Root(*pair) for pair in _ascending(roots)]
    at_infinity = len(coefficients) - 1 - degree
    if at_infinity >= least_multiplicity:
        ascending.append(Root(None, at_infinity))
    return ascending


def candidates(coefficients: Sequence[Any]) -> tuple[int, list[tuple[Integers, Any, int]]]:
    """Return irreducible polynomials over Q that together have all zeros t of a form f(1, t).

    Parameters
    ----------
    coefficients
        Those of the form as SymPy expressions, not all zero.

    Returns
    -------
    degree : int
        The degree of f(1, t).
    candidates : list of (polynomial, part, multiplicity)
        The zeros of f(1, t) of this multiplicity are those of the squarefree part, a SymPy
        polynomial over the field of the coefficients; each is a root of one of the irreducible
        polynomials. For rational coefficients the part is None and all roots are zeros.
    """
    numbers = Coefficients(tuple(coefficients))
    if numbers.rationals is not None:
        polynomial = primitive(numbers.rationals)
        factors = engine().factor(polynomial)
        return len(polynomial) - 1, [(p, None, multiplicity) for p, multiplicity in factors]
    poly = numbers.polynomial
    found = []
    for part, multiplicity in poly.sqf_list()[1]:
        norm = part if poly.domain.is_QQ else part.norm()
        found += [(p, part, multiplicity) for p, _ in engine().factor(primitive(_fractions(norm)))]
    return int(poly.degree()), found


def _fractions(poly: Any) -> list[Fraction]:
    return [Fraction(int(c.p), int(c.q)) for c in poly.all_coeffs()[::-1]]


def is_root(part: Any, candidate: Integers, place: Callable[[int], Rectangle]) -> bool:
    """Decide whether a root of an irreducible polynomial is one of another polynomial too.

    Over the field of the other the irreducible polynomial splits into the part that divides it and
    the rest, and zero is excluded from the value of one of these.

    Parameters
    ----------
    part
        A SymPy polynomial over an algebraic field; None for one that has all the roots.
    candidate
        The irreducible polynomial.
    place
        Returns a rectangle around the root at a working precision in bits.
    """
    if part is None:
        return True
    minimal = sp.Poly(candidate[::-1], _T, domain=part.domain)
    common = sp.gcd(part, minimal)
    rest = minimal.quo(common)
    if common.degree() <= 0 or rest.degree() <= 0:
        return bool(common.degree() > 0)
    sides = [Coefficients(tuple(p.all_coeffs()[::-1])) for p in (common, rest)]
    for bits in precisions():
        with engine().precision(bits):
            t = engine().complex_interval(place(bits))
            away = [
                engine().rectangle(horner(side.intervals(bits), t)).excludes_zero for side in sides
            ]
        if any(away):
            return not away[0]
    raise AssertionError("unreachable")


def _real_place(root: RealAlgebraic, bits: int) -> Rectangle:
    return Rectangle(root.at_precision(bits), Enclosure(Fraction(0), Fraction(0)))


def _ascending(roots: list[tuple[RealAlgebraic, int]]) -> list[tuple[RealAlgebraic, int]]:
    """Sort roots that may belong to different polynomials."""
    for bits in precisions():
        placed = sorted(((root[0].at_precision(bits), root) for root in roots), key=_lower_end)
        if all(a[0].upper < b[0].lower for a, b in pairwise(placed)):
            return [root for _, root in placed]
    raise AssertionError("unreachable")


def _lower_end(placed: tuple[Enclosure, tuple[RealAlgebraic, int]]) -> Fraction:
    return placed[0].lower
