"""The regression in its continuous limit: moment systems on the disc, exactly.

Weights depend on the distance only and the basis r^k e^(i n theta) separates, so the weighted least
squares fit of degree K decouples by frequency. In units of R the part r^d e^(i n theta) of the data
has the coefficients c with M c = b, M_kl = mu_(k+l+1), b_k = mu_(k+d+1), where mu_m is the integral
of rho^m w(rho) over [0, 1].
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import cache
from typing import Any

import flint
import sympy as sp
from sympy.polys.matrices import DomainMatrix

from pdtheory.errors import ComputationError

#: q = exp(-9/2) and E = sqrt(2 pi) erf(3 / sqrt 2), which the Gaussian moments are rational in.
Q, E = sp.symbols("q E", positive=True)

_FIELD = sp.QQ.frac_field(Q, E)

Moment = Callable[[int], Any]


def uniform_moment(power: int) -> Any:
    """Return the integral of rho^power over [0, 1]."""
    return sp.Rational(1, power + 1)


def gaussian_moment(power: int) -> Any:
    """Return the integral of rho^power exp(-9 rho^2 / 2) over [0, 1], in terms of q and E."""
    if power == 0:
        return E / 6
    if power == 1:
        return (1 - Q) / 9
    return sp.expand(((power - 1) * gaussian_moment(power - 2) - Q) / 9)


def gaussian_values(digits: int = 50) -> dict[Any, Any]:
    """Return q and E as SymPy floats with the given number of digits."""
    return {
        Q: sp.exp(sp.Rational(-9, 2)).evalf(digits),
        E: (sp.sqrt(2 * sp.pi) * sp.erf(3 / sp.sqrt(2))).evalf(digits),
    }


def basis(degree: int, frequency: int, *, constant: bool = False) -> list[int]:
    """Return the powers k of r that go with e^(i n theta): |n| <= k <= K, k = n mod 2.

    The regression (6.1) of the paper has no constant term; `constant` adds it.
    """
    powers = range(abs(frequency), degree + 1, 2)
    return [power for power in powers if power or constant]


def fit(moment: Moment, powers: Sequence[int], data: int) -> Mapping[int, Any]:
    """Return the coefficients of r^k in the weighted fit of r^data by the given powers.

    Raises
    ------
    ZeroDivisionError
        If the moment matrix is singular, which a positive weight excludes.
    """
    return _fit(moment, tuple(powers), data)


@cache
def _fit(moment: Moment, powers: tuple[int, ...], data: int) -> Mapping[int, Any]:
    size = len(powers)
    matrix = [[_FIELD.from_sympy(moment(a + b + 1)) for b in powers] for a in powers]
    right = [[_FIELD.from_sympy(moment(a + data + 1))] for a in powers]
    solution = DomainMatrix(matrix, (size, size), _FIELD).lu_solve(
        DomainMatrix(right, (size, 1), _FIELD)
    )
    column = solution.to_Matrix()
    return {power: column[j] for j, power in enumerate(powers)}


def normal_residuals(
    moment: Moment, powers: Sequence[int], data: int, solution: Mapping[int, Any]
) -> list[Any]:
    """Return what is left of the normal equations for a claimed solution."""
    values = {power: _FIELD.from_sympy(value) for power, value in solution.items()}
    return [
        _FIELD.to_sympy(
            sum(
                (_FIELD.from_sympy(moment(a + b + 1)) * values[b] for b in powers),
                -_FIELD.from_sympy(moment(a + data + 1)),
            )
        )
        for a in powers
    ]


def crease_coefficient(
    frequency: int, creases: Sequence[tuple[tuple[Fraction, Fraction], Fraction]]
) -> tuple[Fraction, Fraction]:
    """Return 2 pi h_n of a cone z = r h with planes between creases, as an exact complex number.

    h_n = -sum_j J_j e^(-i n a_j) / (2 pi (n^2 - 1)); J_j is the jump of h' at the angle a_j.

    Parameters
    ----------
    frequency
        n, not 1 or -1.
    creases
        Rational points (cos a_j, sin a_j) with their jumps.
    """
    total = sp.QQ_I(0, 0)
    for (c, s), jump in creases:
        point = sp.QQ_I(sp.QQ(c.numerator, c.denominator), -sp.QQ(s.numerator, s.denominator))
        total += point**frequency * sp.QQ_I(sp.QQ(jump.numerator, jump.denominator), 0)
    value = total / sp.QQ_I(1 - frequency**2, 0)
    return _fraction(value.x), _fraction(value.y)


def count_maxima_certified(order: int, coefficients: Sequence[Any], digits: int = 50) -> int:
    """Count the maxima of a form whose coefficients are known as balls.

    Parameters
    ----------
    order
        k.
    coefficients
        Coefficients of g(1, t), ascending, as `flint.arb`.
    digits
        Working precision.

    Returns
    -------
    int
        Number of real roots of F(1, t), which are isolated in disjoint balls, hence simple.

    Raises
    ------
    ComputationError
        If the precision does not decide whether a root is real.
    """
    old = flint.ctx.dps
    flint.ctx.dps = digits
    try:
        a = [*coefficients, *[flint.arb(0)] * (order + 2 - len(coefficients))]
        # F_j = (j + 1) a_{j+1} - (k - j + 1) a_{j-1}: written out, so that the term of degree
        # k + 1, which cancels, does not stay as a ball around 0.
        F = flint.arb_poly(
            [
                (j + 1) * a[j + 1] - ((order - j + 1) * a[j - 1] if j else 0)
                for j in range(order + 1)
            ]
        )
        roots = flint.acb_poly(F).roots()
        real = 0
        for root in roots:
            if not root.imag.contains(0):
                continue
            # The conjugate of the root in this ball lies in the mirrored ball and in one of the
            # balls; if that can only be this one, it is the root itself, which is then real.
            if any(other is not root and root.conjugate().overlaps(other) for other in roots):
                raise ComputationError(
                    f"{digits} digits do not decide whether a root is real; use more."
                )
            real += 1
        return real + (order - F.degree())
    finally:
        flint.ctx.dps = old


def _fraction(value: Any) -> Fraction:
    return Fraction(int(value.numerator), int(value.denominator))
