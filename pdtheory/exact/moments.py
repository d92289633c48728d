"""The fit of degree K to r exp(i n theta): radial moments of a weight, and their systems."""

from __future__ import annotations

from functools import lru_cache
from typing import Any, Final, Literal

import sympy as sp

from pdtheory.conventions import DEFAULT_DEGREE, SIGMA_RATIO
from pdtheory.errors import InputError
from pdtheory.exact.balls import engine
from pdtheory.exact.enclosing import enclose_real, rounded
from pdtheory.exact.intervals import Enclosure
from pdtheory.exact.realnumber import bits_for, precisions

Weight = Literal["gaussian", "uniform"]
Measure = Literal["flat", "surface"]

_Q, _E = sp.symbols("q E", positive=True)

#: Significant digits of `coefficient_numbers`.
NUMBER_DIGITS: Final = 80


def radial_moment(m: int, weight: Weight = "gaussian") -> Any:
    """Return the integral of w(rho) rho^m over [0, 1], exactly.

    For the Gaussian w = exp(-9 rho^2 / 2) it is a polynomial in q = exp(-9/2) for odd m, and
    linear in E = sqrt(2 pi) erf(3 / sqrt 2) besides for even m.
    """
    return _closed(_moment(m, weight))


def _closed(expression: Any) -> Any:
    # sigma = R / SIGMA_RATIO = R / 3 gives the 9/2 and the 3 / sqrt 2.
    return expression.subs(
        {_Q: sp.exp(-sp.Rational(9, 2)), _E: sp.sqrt(2 * sp.pi) * sp.erf(3 / sp.sqrt(2))}
    )


@lru_cache(maxsize=1024)
def _moment(m: int, weight: Weight) -> Any:
    if weight == "uniform":
        return sp.Rational(1, m + 1)
    square = sp.Integer(int(SIGMA_RATIO)) ** 2
    if m == 0:
        return _E / (2 * sp.Integer(int(SIGMA_RATIO)))
    if m == 1:
        return (1 - _Q) / square
    return sp.expand(((m - 1) * _moment(m - 2, weight) - _Q) / square)


@lru_cache(maxsize=256)
def _solution(n: int, degree: int, weight: Weight, constant: bool) -> dict[int, Any]:
    """Return c_{k,n} by k for one frequency, rational functions of q and E."""
    orders = [k for k in range(n, degree + 1, 2) if constant or k > 0]
    if not orders:
        return {}
    if n == 1:
        return {k: sp.Integer(int(k == 1)) for k in orders}
    field = sp.QQ.frac_field(_Q, _E)
    moments = {m: field.from_sympy(_moment(m, weight)) for m in range(1, 2 * degree + 3)}
    matrix = sp.polys.matrices.DomainMatrix(
        [[moments[k + j + 1] for j in orders] for k in orders], (len(orders),) * 2, field
    )
    right = sp.polys.matrices.DomainMatrix(
        [[moments[k + 2]] for k in orders], (len(orders), 1), field
    )
    solved = matrix.lu_solve(right).to_list()
    return {k: field.to_sympy(row[0]) for k, row in zip(orders, solved, strict=True)}


def cone_coefficient(
    order: int,
    frequency: int,
    degree: int = DEFAULT_DEGREE,
    weight: Weight = "gaussian",
    *,
    constant: bool = True,
) -> Any:
    """Return c_{k,n}(K): the fit of degree K to r exp(i n theta) has phi_{k,n} = c R^(1-k).

    Parameters
    ----------
    order, frequency
        k and n >= 0, of the same parity, n <= k <= K.
    degree
        Degree K of the fit.
    weight
        "gaussian": exp(-9 rho^2 / 2); "uniform": 1.
    constant
        Whether the fit has a constant term.

    Raises
    ------
    InputError
        If k and n do not fit, or the weight is not known.

    Examples
    --------
    >>> cone_coefficient(3, 3, 10, "uniform")
    28/3
    """
    check_fit(degree, weight)
    if not (0 <= frequency <= order <= degree and (order - frequency) % 2 == 0):
        raise InputError(
            f"There is no coefficient of order {order} and frequency {frequency} in a fit of "
            f"degree {degree}."
        )
    if order == 0 and not constant:
        raise InputError("A fit without constant term has no coefficient of order 0.")
    return _closed(_solution(frequency, degree, weight, constant)[order])


def check_fit(degree: int, weight: str) -> None:
    """Refuse a degree or a weight that the closed forms do not cover."""
    if int(degree) != degree or not 1 <= degree <= 30:
        raise InputError(f"The degree is {degree}; it must be an integer from 1 to 30.")
    if weight not in ("gaussian", "uniform"):
        raise InputError(f"The weight {weight!r} is not known; use 'gaussian' or 'uniform'.")


@lru_cache(maxsize=1024)
def _moment_enclosure(m: int, weight: Weight, bits: int) -> Enclosure:
    return enclose_real(radial_moment(m, weight), bits)


@lru_cache(maxsize=256)
def coefficient_numbers(n: int, degree: int, weight: Weight, constant: bool) -> dict[int, Any]:
    """Return c_{k,n}(K) by k for one frequency n, to 80 certified digits, as rational numbers.

    The system of the moments is solved in balls; the closed forms of `cone_coefficient` take a
    second at K = 10. Where they are rational, they are taken.
    """
    orders = [k for k in range(n, degree + 1, 2) if constant or k > 0]
    if n == 1 or weight == "uniform":
        exact = _solution(n, degree, weight, constant)
        return {k: rounded(_closed(exact[k]), NUMBER_DIGITS) if exact[k] else exact[k]
                for k in orders}  # fmt: skip
    here = engine()
    flint = here.library
    for bits in precisions(2 * bits_for(NUMBER_DIGITS)):
        with here.precision(bits):
            known = {
                m: here.interval(_moment_enclosure(m, weight, bits))
                for m in range(1, 2 * degree + 3)
            }
            matrix = flint.arb_mat([[known[k + j + 1] for j in orders] for k in orders])
            right = flint.arb_mat([[known[k + 2]] for k in orders])
            try:
                solved = matrix.solve(right)
            except ZeroDivisionError:  # too few bits to tell the matrix from a singular one
                continue
            found = [here.enclosure(solved[i, 0]) for i in range(len(orders))]
        if all(e.sign and e.width * 10**NUMBER_DIGITS <= abs(e.middle) for e in found):
            return {
                k: sp.Rational(e.middle.numerator, e.middle.denominator)
                for k, e in zip(orders, found, strict=True)
            }
    raise AssertionError("unreachable")
