"""Sums of products of exponentials and roots with exact coefficients: their ring operations."""

from __future__ import annotations

from typing import Any, Final, NamedTuple

import sympy as sp
from sympy.polys.polyerrors import CoercionFailed

#: Terms that a sum may have before the normal form is given up.
MOST_TERMS: Final = 50_000

#: Sorted pairs (basic exponent or root, power); a product of exponentials and roots.
Monomial = tuple[tuple[Any, Any], ...]
#: Coefficients by monomials: Gaussian rationals of SymPy's domain, or expanded expressions.
Sum = dict[Monomial, Any]

GAUSS: Final = sp.QQ_I
ONE: Final[Sum] = {(): GAUSS.one}


class TooLong(Exception):
    """The normal form has more than `MOST_TERMS` terms."""


class Root(NamedTuple):
    """The root base^(1/order) of a sum, as a factor of monomials."""

    base: Any
    order: int


def monomial_of(powers: dict[Any, Any]) -> Monomial:
    """Return the monomial with these powers."""
    return tuple(sorted(((e, p) for e, p in powers.items() if p), key=lambda pair: hash(pair[0])))


def coefficient_of(value: Any) -> Any:
    """Return a constant as a coefficient."""
    try:
        return GAUSS.from_sympy(value)
    except CoercionFailed:
        return sp.expand(value)


def expression_of(c: Any) -> Any:
    """Return a coefficient as an expression."""
    return c if isinstance(c, sp.Basic) else GAUSS.to_sympy(c)


def _joined(a: Any, b: Any, *, times: bool) -> Any:
    """Return the sum or product of two coefficients."""
    if isinstance(a, sp.Basic) or isinstance(b, sp.Basic):
        a, b = expression_of(a), expression_of(b)
        return sp.expand(a * b if times else a + b)
    return a * b if times else a + b


def added(a: Sum, b: Sum) -> Sum:
    """Return a + b."""
    total = dict(a)
    for monomial, c in b.items():
        if monomial in total:
            new = _joined(total.pop(monomial), c, times=False)
            if new:
                total[monomial] = new
        else:
            total[monomial] = c
    return total


def product(a: Sum, b: Sum) -> Sum:
    """Return a b.

    Raises
    ------
    TooLong
        If it would have more than `MOST_TERMS` terms.
    """
    if a is ONE or b is ONE:
        return b if a is ONE else a
    if len(a) * len(b) > 50 * MOST_TERMS:
        raise TooLong
    total: Sum = {}
    for left, c in a.items():
        for right, d in b.items():
            monomial = left or right
            if left and right:
                powers = dict(left)
                for e, p in right:
                    powers[e] = powers.get(e, 0) + p
                monomial = monomial_of(powers)
            value = _joined(c, d, times=True)
            if monomial in total:
                value = _joined(total[monomial], value, times=False)
            total[monomial] = value
    result = {m: c for m, c in total.items() if c}
    if len(result) > MOST_TERMS:
        raise TooLong
    return result
