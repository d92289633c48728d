"""Certified roots of integer polynomials, by the library in use.

Polynomials are tuples of integers, constant term first.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache, lru_cache
from typing import Any

from pdtheory.exact.engines import Engine, FlintEngine, Integers, SympyEngine
from pdtheory.exact.intervals import Enclosure, Rectangle


@cache
def engine() -> Engine:
    """Return the engine in use: python-flint where it is installed, else SymPy."""
    try:
        return FlintEngine()
    except ImportError:
        return SympyEngine()


@lru_cache(maxsize=512)
def real_roots(polynomial: Integers, bits: int) -> tuple[Enclosure, ...]:
    """Return the enclosures of all real roots of a squarefree polynomial, ascending and disjoint.

    The number of enclosures is the number of real roots: that is proved, not counted numerically.
    """
    return tuple(engine().real_roots(polynomial, bits))


@lru_cache(maxsize=512)
def complex_roots(polynomial: Integers, bits: int) -> tuple[Rectangle, ...]:
    """Return enclosures of the roots in the upper half plane of a squarefree polynomial."""
    return tuple(engine().complex_roots(polynomial, bits))


def horner(coefficients: Sequence[Any], at: Any) -> Any:
    """Evaluate a polynomial, constant term first, in whatever arithmetic the operands bring."""
    value = coefficients[-1]
    for c in reversed(coefficients[:-1]):
        value = value * at + c
    return value
