"""Exact forms of the certificates and what Sturm sequences count on them.

Written with plain python-flint, apart from :mod:`pdtheory.exact`, which the certificates must not
rest on. A form f of order k with rational coefficients is handled by p(t) = f(1, t); the direction
x = 0 is the root at infinity, whose multiplicity is the missing degree.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any

import flint
import sympy as sp

from pdtheory.paper.claims.kit import t, x, y

#: (Re phi_n, Im phi_n) by frequency n >= 0.
Row = Mapping[int, tuple[Fraction, Fraction]]


def form_of_row(order: int, row: Row) -> Any:
    """Return p(t) = g(1, t), g = sum_n phi_n z^((k+n)/2) conj(z)^((k-n)/2), z = 1 + i t.

    Parameters
    ----------
    order
        k.
    row
        (Re phi_n, Im phi_n) for some n >= 0 with n = k mod 2; phi_{-n} is the conjugate.
    """
    total = flint.fmpq_poly()
    square = flint.fmpq_poly([1, 0, 1])
    for frequency, (re, im) in row.items():
        real, imaginary = flint.fmpq_poly([1]), flint.fmpq_poly()
        step = flint.fmpq_poly([0, 1])
        for _ in range(frequency):
            real, imaginary = real - imaginary * step, imaginary + real * step
        term = real * _rational(re) - imaginary * _rational(im)
        total += square ** ((order - frequency) // 2) * term * (2 if frequency else 1)
    return total


def form_of_expression(f: Any, a: Any = x, b: Any = y) -> Any:
    """Return p(t) = f(1, t) of a SymPy form with rational coefficients."""
    coefficients = sp.Poly(sp.expand(f.subs({a: 1, b: t})), t).all_coeffs()[::-1]
    return flint.fmpq_poly([flint.fmpq(int(c.p), int(c.q)) for c in coefficients])


def critical(order: int, p: Any) -> Any:
    """Return F(1, t) = (1 + t^2) p' - k t p."""
    return flint.fmpq_poly([1, 0, 1]) * p.derivative() - flint.fmpq_poly([0, order]) * p


def real_lines(degree: int, polynomial: Any) -> dict[int, int]:
    """Count the real projective roots of a form of the given degree, by multiplicity.

    The count is a difference of sign variations in Sturm's sequence of each squarefree factor.
    """
    counts: dict[int, int] = {}
    missing = degree - polynomial.degree()
    if missing:
        counts[missing] = 1
    integral = polynomial.numer()
    for factor, multiplicity in integral.factor_squarefree()[1]:
        found = sturm_count(factor)
        if found:
            counts[multiplicity] = counts.get(multiplicity, 0) + found
    return counts


def sturm_count(squarefree: Any, weight: Any = 1) -> int:
    """Return the number of real roots, or the sum of the signs of `weight` at them.

    It is V(-oo) - V(+oo) of the chain that starts with p and p' times the weight (Sturm; Tarski).
    """
    chain = [flint.fmpq_poly(squarefree)]
    chain.append(chain[0].derivative() * weight)
    while chain[-1].degree() > 0:
        remainder = chain[-2] % chain[-1]
        if remainder == 0:
            break
        # The chain is the same up to positive factors; keep the numbers short.
        chain.append(flint.fmpq_poly(-remainder.numer() / remainder.numer().content()))
    right = [_sign(p[p.degree()]) for p in chain if p != 0]
    left = [s * (-1) ** p.degree() for s, p in zip(right, chain, strict=False)]
    return _variations(left) - _variations(right)


def _variations(signs: Sequence[int]) -> int:
    return sum(a * b < 0 for a, b in pairwise(signs))


def _sign(value: Any) -> int:
    return int(value > 0) - int(value < 0)


def count_maxima(order: int, p: Any) -> int | None:
    """Return the number of maxima of g on the circle; None if g is constant.

    The derivative changes sign at the lines of odd multiplicity, twice on each (at v and -v), and
    maxima and minima alternate: so there are as many maxima as such lines, for even and odd order.
    """
    F = critical(order, p)
    if F == 0:
        return None
    return sum(found for power, found in real_lines(order, F).items() if power % 2)


def star(order: int) -> Any:
    """Return Im (1 + i t)^k, whose lines are the multiples of 180 / k degrees."""
    return form_of_row(order, {order: (Fraction(0), Fraction(-1, 2))})


def lines_are_maxima(order: int, p: Any, lines: int) -> bool:
    """Tell whether all multiples of 180 / `lines` degrees are maxima of an even order, exactly.

    The star of these lines must divide F, and the sum of the signs of g'' at them, a Tarski query,
    must be minus their number.
    """
    F = critical(order, p)
    product = star(lines)
    if F == 0 or F % product != 0:
        return False
    # The derivative of F along the circle, at (1, t); it has the sign of g''.
    second = critical(order, F)
    finite = sturm_count(product, second)
    at_infinity = _sign(second[order]) if product.degree() < lines else 0
    return finite + at_infinity == -lines


def is_maximum(order: int, p: Any, point: tuple[Fraction, Fraction]) -> bool:
    """Tell whether the rational point (c, s) of the circle is a strict non-degenerate maximum."""
    c, s = point
    F = [_fraction(value) for value in critical(order, p).coeffs()]
    value = sum((a * s**j * c ** (order - j) for j, a in enumerate(F)), Fraction(0))
    # dF/dtheta = -s F_x + c F_y, which is g'' k! on the circle.
    slope = Fraction(0)
    for j, a in enumerate(F):
        if j:
            slope += a * j * s ** (j - 1) * c ** (order - j + 1)
        if order - j:
            slope -= a * (order - j) * s ** (j + 1) * c ** (order - j - 1)
    return value == 0 and slope < 0


def row_of_lines(points: Sequence[tuple[Fraction, Fraction]], sign: int = 1) -> Row:
    """Return the row with g' = C prod_j sin(t - t_j), C of the given sign, |C| a power of 2.

    Parameters
    ----------
    points
        Rational points (cos t_j, sin t_j); the row is one of every order that is at least their
        number and of its parity.
    sign
        Sign of C.
    """
    # prod_j sin(t - t_j) = prod_j (e^(it) conj(w_j) - e^(-it) w_j) / (2i), w_j = e^(i t_j).
    product = {0: sp.QQ_I(sign, 0)}
    for c, s in points:
        w = sp.QQ_I(sp.QQ(c.numerator, c.denominator), sp.QQ(s.numerator, s.denominator))
        new: dict[int, Any] = {}
        for power, value in product.items():
            new[power + 1] = new.get(power + 1, sp.QQ_I.zero) + value * _conj(w)
            new[power - 1] = new.get(power - 1, sp.QQ_I.zero) - value * w
        product = new
    # i^m is carried outside the fractions: prod / (i^m) then phi_n = coefficient / (i n).
    unit = sp.QQ_I(0, 1) ** (len(points) + 1)
    row: dict[int, tuple[Fraction, Fraction]] = {}
    for power, value in product.items():
        if power > 0:
            phi = value / unit / sp.QQ_I(power, 0)
            row[power] = (_fraction(phi.x), _fraction(phi.y))
    if product.get(0):
        raise ValueError("the product has a mean, so it is not the derivative of a periodic g")
    return row


def circle_point(parameter: Fraction) -> tuple[Fraction, Fraction]:
    """Return the rational point of the circle at the angle 2 arctan(parameter)."""
    return (1 - parameter**2) / (1 + parameter**2), 2 * parameter / (1 + parameter**2)


def random_row(order: int, generator: random.Random, size: int = 9) -> dict[int, Any]:
    """Return a row with small random rational coefficients, the highest one not zero."""

    def draw() -> Fraction:
        return Fraction(generator.randint(-size, size), generator.randint(1, 3))

    row = {m: (draw(), draw() if m else Fraction(0)) for m in range(order % 2, order + 1, 2)}
    if not any(row[order]):
        row[order] = (Fraction(1), Fraction(0))
    return row


def _conj(value: Any) -> Any:
    return sp.QQ_I(value.x, -value.y)


def _rational(value: Fraction) -> Any:
    return flint.fmpq(value.numerator, value.denominator)


def _fraction(value: Any) -> Fraction:
    return Fraction(int(value.numerator), int(value.denominator))
