"""Squarefree parts of polynomials with constants as coefficients, multiplicities proved.

Isolation in balls proves that a polynomial is squarefree, and only that. Where it does not succeed
a squarefree polynomial is sought that has all its roots. First the coefficients are taken for
polynomials in independent unknowns (`independent`), whose irreducible factors python-flint finds.
What may remain are repeated roots that come from a relation between the constants that nobody sees.
Then the degree of the greatest common divisor with the derivative is the number of subresultant
coefficients that vanish, each decided by `zeros`; the divisor is made of determinants that are
evaluated in balls.

Multiplicities are counted in discs about the roots of the squarefree polynomial: by the theorem of
Pellet, that is of Rouche, there are m roots of sum c_j t^j within |t| < r if |c_m| r^m is larger
than the sum of the other |c_j| r^j.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from itertools import combinations
from operator import mul
from typing import Any, Final, NamedTuple

import sympy as sp
from sympy.polys.matrices import DomainMatrix

from pdtheory.exact.balls import engine
from pdtheory.exact.constantpolynomial import ConstantPolynomial
from pdtheory.exact.independent import Independent
from pdtheory.exact.realnumber import FIRST_BITS, precisions
from pdtheory.exact.zeros import is_zero

#: Precisions at which a polynomial may show that it is squarefree before its structure is decided.
ISOLATION_BITS: Final = (FIRST_BITS, 4 * FIRST_BITS)
#: Precisions at which a subresultant coefficient may show that it is not zero.
MINOR_BITS: Final = (256, 1024)


class Part(NamedTuple):
    """A squarefree polynomial and the multiplicities that its roots have in the whole.

    Attributes
    ----------
    polynomial : ConstantPolynomial
        The polynomial; no other part has a root of it.
    real, upper : tuple of int
        Multiplicities in the order of its isolation; 0 for what is no root of the whole.
    """

    polynomial: ConstantPolynomial
    real: tuple[int, ...]
    upper: tuple[int, ...]


def squarefree_parts(expressions: Sequence[Any]) -> list[Part]:
    """Return squarefree polynomials that together have the roots of a real polynomial, once each.

    Parameters
    ----------
    expressions
        The coefficients, constant term first; neither the first nor the last is zero.

    Raises
    ------
    ComputationError
        If a coefficient that decides on multiplicities may or may not be zero (`zeros.is_zero`).
    """
    if len(expressions) < 2:
        return []
    expressions = _primitive(expressions)
    whole = ConstantPolynomial.of(expressions)
    if _is_isolated(whole):
        found = whole.isolated(FIRST_BITS)
        return [Part(whole, (1,) * len(found.real), (1,) * len(found.upper))]
    numbers = Independent(expressions)
    factors = _formal_factors(numbers)
    if not _is_isolated(_product(factors)):
        factors = [_divided(whole, numbers)]
    return _with_multiplicities(whole, factors)


def _primitive(expressions: Sequence[Any]) -> list[Any]:
    """Divide by the rational content and by the factors that all coefficients are written with."""
    content = reduce(sp.gcd, (c.as_coeff_Mul()[0] for c in expressions))
    shared = [set(sp.Mul.make_args(c.as_coeff_Mul()[1])) for c in expressions if c != 0]
    divisor = content * sp.Mul(*set.intersection(*shared))
    return [c / divisor for c in expressions]


def _is_isolated(polynomial: ConstantPolynomial) -> bool:
    return any(polynomial.separates(bits) for bits in ISOLATION_BITS)


def _product(factors: Sequence[ConstantPolynomial]) -> ConstantPolynomial:
    def balls(bits: int) -> list[Any]:
        with engine().precision(bits):
            return list(reduce(mul, (f.ball(bits) for f in factors)).coeffs())

    return ConstantPolynomial(sum(f.degree for f in factors), balls)


def _formal_factors(numbers: Independent) -> list[ConstantPolynomial]:
    """Return the irreducible factors of the polynomial in independent unknowns, once each.

    Where algebraic numbers are among them, those of its norm, which has all its roots.
    """
    ring = numbers.polynomials[0].ring
    context = _context(ring.ngens, 1)
    poly = context.from_dict(
        {
            (j, *exponents): _rational(c)
            for j, polynomial in enumerate(numbers.polynomials)
            for exponents, c in polynomial.terms()
        }
    )
    if numbers.generator is not None:
        symbol, minimal = numbers.generator
        place = 1 + list(numbers.meaning).index(symbol)
        powers = [tuple(i * (k == place) for k in range(1 + ring.ngens))
                  for i in range(len(minimal))]  # fmt: skip
        equation = {e: _rational(c) for e, c in zip(powers, reversed(minimal), strict=True) if c}
        poly = poly.resultant(context.from_dict(equation), place)
    found = []
    for factor, _ in poly.factor()[1]:
        degree = factor.degrees()[0]
        if degree:
            parts: list[dict[Any, Any]] = [{} for _ in range(degree + 1)]
            for (j, *exponents), c in factor.to_dict().items():
                parts[j][tuple(exponents)] = c
            coefficients = [numbers.value(_element_of(part, ring)) for part in parts]
            found.append(ConstantPolynomial.of(_primitive(coefficients)))
    return found


def _context(count: int, before: int) -> Any:
    """Return polynomials over Q in `before` leading variables and as many as the symbols are."""
    names = [f"x{i}" for i in range(before + count)]
    return engine().library.fmpq_mpoly_ctx.get(names, "lex")


def _rational(c: Any) -> Any:
    return engine().library.fmpq(int(c.numerator), int(c.denominator))


def _element_of(terms: dict[Any, Any], ring: Any) -> Any:
    """Return terms of python-flint as an element of a SymPy ring over QQ."""
    return ring.from_dict(
        {tuple(int(i) for i in e): sp.QQ(int(c.p), int(c.q)) for e, c in terms.items()}
    )


def _with_multiplicities(
    whole: ConstantPolynomial, factors: Sequence[ConstantPolynomial]
) -> list[Part]:
    """Count the roots of a polynomial in discs about the roots of factors that have them all."""
    for bits in precisions():
        isolations = [f.isolation(bits) for f in factors]
        if any(i is None for i in isolations):
            continue
        with engine().precision(bits):
            places = [
                [
                    [engine().library.acb(engine().interval(r)) for r in isolation.real],
                    [engine().complex_interval(r) for r in isolation.upper],
                ]
                for isolation in isolations
                if isolation is not None
            ]
            counts = _counts(whole.ball(bits), places)
        if counts is not None:
            return [
                Part(f, tuple(real), tuple(upper))
                for f, (real, upper) in zip(factors, counts, strict=True)
            ]
    raise AssertionError("unreachable")


def _counts(whole: Any, places: list[list[list[Any]]]) -> list[list[list[int]]] | None:
    """Return the number of roots at every place, None if the precision does not show it."""
    flint = engine().library
    every = [r for real, upper in places for r in (*real, *upper, *(u.conjugate() for u in upper))]
    gaps = [abs(a - b).lower() for a, b in combinations(every, 2)]
    # Within this distance of a root no other is; the other terms of the sum stay small.
    radius = reduce(lambda a, b: a.min(b), gaps, flint.arb(1)) / (8 * whole.length())
    if not radius > 0:
        return None
    found: list[list[list[int]]] = []
    for kinds in places:
        found.append([])
        for roots in kinds:
            counts = [_count(whole, root, radius) for root in roots]
            if None in counts:
                return None
            found[-1].append(counts)  # type: ignore[arg-type]
    return found


def _count(whole: Any, center: Any, radius: Any) -> int | None:
    flint = engine().library
    moved = flint.acb_poly(whole)(flint.acb_poly([center.mid(), radius]))
    sizes = [abs(c) for c in moved.coeffs()]
    total = sum(sizes, flint.arb(0))
    # The middle of the ball is no root: the disc must hold the ball.
    if not abs(center - center.mid()) < radius / 2:
        return None
    return next((m for m, size in enumerate(sizes) if size > total - size), None)


def _divided(whole: ConstantPolynomial, numbers: Independent) -> ConstantPolynomial:
    """Divide a polynomial by the greatest common divisor with its derivative."""
    degree = 0
    while _minor_vanishes(whole, numbers, degree):
        degree += 1
    if not degree:
        return whole

    def balls(bits: int) -> list[Any]:
        with engine().precision(bits):
            above = whole.ball(bits)
            return list(divmod(above, _common_divisor(above, degree))[0].coeffs())

    return ConstantPolynomial(whole.degree - degree, balls)


def _minor_vanishes(polynomial: ConstantPolynomial, numbers: Independent, index: int) -> bool:
    """Decide whether a principal subresultant coefficient is zero."""
    for bits in MINOR_BITS:
        with engine().precision(bits):
            rows = _rows(polynomial.balls(bits), index)
            matrix = engine().library.arb_mat([r[: len(rows)] for r in rows])
            if not matrix.det().contains(0):
                return False
    rows = _rows(numbers.polynomials, index)
    size = len(rows)
    domain = numbers.polynomials[0].ring.to_domain()
    matrix = DomainMatrix([r[:size] for r in rows], (size, size), domain)
    determinant = matrix.det()
    if not determinant:
        return True
    # A product of long sums is decided by its factors, of which one may be short and zero.
    ring = determinant.ring
    poly = _context(ring.ngens, 0).from_dict({e: _rational(c) for e, c in determinant.terms()})
    return any(is_zero(numbers.value(_element_of(f.to_dict(), ring))) for f, _ in poly.factor()[1])


def _common_divisor(polynomial: Any, degree: int) -> Any:
    """Return the subresultant of a degree in balls."""
    flint = engine().library
    rows = _rows(list(polynomial.coeffs()), degree)
    size = len(rows)
    columns = [*range(len(rows[0]) - 1, size - 2, -1)]
    return flint.arb_poly(
        [flint.arb_mat([[*r[: size - 1], r[c]] for r in rows]).det() for c in columns]
    )


def _rows(coefficients: Sequence[Any], index: int) -> list[list[Any]]:
    """Return the rows of the subresultant of some index of a polynomial and its derivative.

    The columns are those of t^(m + n - 1 - index) down to t^0, for the degrees m and n = m - 1.
    """
    zero = coefficients[0] * 0
    slope = [j * c for j, c in enumerate(coefficients)][1:]
    m, n = len(coefficients) - 1, len(slope) - 1
    width = m + n - index
    rows = []
    for poly, count in ((coefficients, n - index), (slope, m - index)):
        for shift in reversed(range(count)):
            descending = [*reversed(poly), *([zero] * shift)]
            rows.append([*([zero] * (width - len(descending))), *descending])
    return rows
