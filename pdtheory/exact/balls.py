"""Certified roots of integer polynomials.

Polynomials are tuples of integers, constant term first.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache, lru_cache
from typing import Any

from pdtheory.exact.engines import Engine, Integers
from pdtheory.exact.intervals import Enclosure, Rectangle
from pdtheory.exact.realnumber import FIRST_BITS


@cache
def engine() -> Engine:
    """Return the one engine; python-flint is imported when it is first asked for."""
    return Engine()


@lru_cache(maxsize=512)
def real_roots(polynomial: Integers, bits: int) -> tuple[Enclosure, ...]:
    """Return the enclosures of all real roots of a squarefree polynomial, ascending and disjoint.

    The number of enclosures is the number of real roots: that is proved, not counted numerically.
    """
    return tuple(engine().real_roots(polynomial, bits))


@lru_cache(maxsize=512)
def complex_roots(polynomial: Integers, bits: int) -> tuple[Rectangle, ...]:
    """Return enclosures of the roots in the upper half plane of a squarefree polynomial.

    They are disjoint and come in one order, whatever the precision.
    """
    found = tuple(engine().complex_roots(polynomial, bits))
    if bits <= FIRST_BITS:
        return found
    ordered = in_order_of(complex_roots(polynomial, FIRST_BITS), found)
    return complex_roots(polynomial, 2 * bits) if ordered is None else ordered


def in_order_of(
    known: Sequence[Rectangle], found: Sequence[Rectangle]
) -> tuple[Rectangle, ...] | None:
    """Return narrower enclosures of numbers in the order of wider ones, None if that is not clear.

    Numbers with equal real parts have no order that rounding would leave alone.
    """
    placed = []
    for wide in known:
        inside = [f for f in found if wide.overlaps(f)]
        if len(inside) != 1:
            return None
        placed.append(inside[0])
    return tuple(placed)


def horner(coefficients: Sequence[Any], at: Any) -> Any:
    """Evaluate a polynomial, constant term first, in whatever arithmetic the operands bring."""
    value = coefficients[-1]
    for c in reversed(coefficients[:-1]):
        value = value * at + c
    return value
