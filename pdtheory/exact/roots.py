"""The real zeros of a binary form with real coefficients, with proof of their number."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import partial
from itertools import pairwise
from typing import Any, NamedTuple, TypeVar

import sympy as sp

from pdtheory.exact.algebraic import RealAlgebraic, primitive
from pdtheory.exact.balls import engine, horner, real_roots
from pdtheory.exact.coefficients import as_fraction
from pdtheory.exact.constantroots import RealRoot
from pdtheory.exact.engines import Integers
from pdtheory.exact.intervals import Enclosure, Rectangle
from pdtheory.exact.realcoefficients import Coefficients
from pdtheory.exact.realnumber import FIRST_BITS, RealNumber, precisions
from pdtheory.exact.squarefree import squarefree_parts
from pdtheory.exact.zeros import is_zero

_T = sp.Symbol("t")
_Number = TypeVar("_Number")


class Root(NamedTuple):
    """A real zero t = y/x of a binary form, None for x = 0, with its multiplicity."""

    value: RealNumber | None
    multiplicity: int


def form_roots(coefficients: Sequence[Any], least_multiplicity: int = 1) -> list[Root]:
    """Return all real zeros t = y/x of a binary form, ascending, the one at infinity last.

    Over Q the polynomial f(1, t) is factored, so that every root comes with its minimal polynomial
    and its multiplicity. Over Q(a) each squarefree part is factored through its norm, and a
    candidate is kept if the part of its minimal polynomial that divides the squarefree part
    vanishes there, which is decided by excluding zero from one of two complementary factors.
    For other coefficients all complex roots are isolated in balls (`squarefree`).

    Parameters
    ----------
    coefficients
        Those of x^k, x^(k-1) y, ..., y^k as SymPy expressions, not all zero.
    least_multiplicity
        Leave out the zeros of a lower multiplicity.

    Raises
    ------
    ComputationError
        If a number that decides on multiplicities may or may not be zero (`zeros.is_zero`).
    """
    numbers = Coefficients(tuple(coefficients))
    if numbers.in_field:
        at_infinity, roots = _algebraic_roots(numbers, least_multiplicity)
    else:
        at_infinity, roots = _constant_roots(coefficients, least_multiplicity)
    ascending = [Root(*pair) for pair in _ascending(roots)]
    if at_infinity >= least_multiplicity:
        ascending.append(Root(None, at_infinity))
    return ascending


def _algebraic_roots(
    numbers: Coefficients, least_multiplicity: int
) -> tuple[int, list[tuple[RealNumber, int]]]:
    at_infinity, found = candidates(numbers)
    roots: list[tuple[RealNumber, int]] = [
        (root, multiplicity)
        for factor, part, multiplicity in found
        if multiplicity >= least_multiplicity
        for root in (RealAlgebraic(factor, i) for i in range(len(real_roots(factor, FIRST_BITS))))
        if is_root(part, factor, partial(_real_place, root))
    ]
    return at_infinity, roots


def _constant_roots(
    coefficients: Sequence[Any], least_multiplicity: int
) -> tuple[int, list[tuple[RealNumber, int]]]:
    at_zero, kept, at_infinity = without_outer_zeros(coefficients)
    roots: list[tuple[RealNumber, int]] = [
        (RealRoot(part.polynomial, i), multiplicity)
        for part in squarefree_parts(kept)
        for i, multiplicity in enumerate(part.real)
        if multiplicity >= least_multiplicity
    ]
    if at_zero >= least_multiplicity:
        roots.append((RealAlgebraic.rational(0), at_zero))
    return at_infinity, roots


def without_outer_zeros(coefficients: Sequence[Any]) -> tuple[int, Sequence[Any], int]:
    """Return coefficients without the zeros at both ends, and how many there were before and after.

    Raises
    ------
    ComputationError
        If one of them may or may not be zero.
    """
    first = next(j for j, c in enumerate(coefficients) if not is_zero(c))
    after = next(j for j, c in enumerate(reversed(coefficients)) if not is_zero(c))
    return first, coefficients[first : len(coefficients) - after], after


def candidates(numbers: Coefficients) -> tuple[int, list[tuple[Integers, Any, int]]]:
    """Return irreducible polynomials over Q that together have all zeros t of a form f(1, t).

    Parameters
    ----------
    numbers
        The coefficients of the form, not all zero, in a field.

    Returns
    -------
    at_infinity : int
        The multiplicity of the zero at infinity; 0 if there is none.
    candidates : list of (polynomial, part, multiplicity)
        The zeros of f(1, t) of this multiplicity are those of the squarefree part, a SymPy
        polynomial over the field of the coefficients; each is a root of one of the irreducible
        polynomials. For rational coefficients the part is None and all roots are zeros.
    """
    count = len(numbers.expressions)
    if numbers.rationals is not None:
        polynomial = primitive(numbers.rationals)
        factors = engine().factor(polynomial)
        return count - len(polynomial), [(p, None, multiplicity) for p, multiplicity in factors]
    poly = numbers.polynomial
    found = []
    for part, multiplicity in poly.sqf_list()[1]:
        norm = part if poly.domain.is_QQ else part.norm()
        over_q = primitive([as_fraction(c) for c in norm.all_coeffs()[::-1]])
        found += [(p, part, multiplicity) for p, _ in engine().factor(over_q)]
    return count - 1 - int(poly.degree()), found


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


def found_among(
    numbers: Sequence[_Number], zeros: Sequence[_Number], place: Callable[[_Number, int], Any]
) -> list[_Number]:
    """Return for each zero which one of some different numbers it is.

    Parameters
    ----------
    numbers
        The numbers, among them all of the zeros.
    zeros
        The zeros.
    place
        Returns an enclosure of a number or a zero at a working precision in bits.
    """
    for bits in precisions():
        near = [[n for n in numbers if place(n, bits).overlaps(place(z, bits))] for z in zeros]
        # A zero is one of the numbers: the only one that is near enough at last.
        if all(len(found) == 1 for found in near):
            return [found[0] for found in near]
    raise AssertionError("unreachable")


def _real_place(root: RealNumber, bits: int) -> Rectangle:
    return Rectangle(root.at_precision(bits), Enclosure(Fraction(0), Fraction(0)))


def _ascending(roots: list[tuple[RealNumber, int]]) -> list[tuple[RealNumber, int]]:
    """Sort roots that may belong to different polynomials."""
    for bits in precisions():
        placed = sorted(((root[0].at_precision(bits), root) for root in roots), key=_lower_end)
        if all(a[0].upper < b[0].lower for a, b in pairwise(placed)):
            return [root for _, root in placed]
    raise AssertionError("unreachable")


def _lower_end(placed: tuple[Enclosure, tuple[RealNumber, int]]) -> Fraction:
    return placed[0].lower
