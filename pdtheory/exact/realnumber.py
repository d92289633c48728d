"""Real numbers that can be enclosed to any number of digits."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from typing import Any, Final

import sympy as sp

from pdtheory.errors import ComputationError, InputError
from pdtheory.exact.intervals import Enclosure

#: Longest text of an exact number that is shown.
SHORT: Final = 48
#: Bits with which work starts, and where it is given up (a comparison that never ends).
FIRST_BITS: Final = 112
LAST_BITS: Final = 1 << 20


def precisions(first: int = FIRST_BITS) -> Iterator[int]:
    """Yield growing working precisions in bits.

    Raises
    ------
    ComputationError
        When the next one would pass `LAST_BITS`.
    """
    bits = first
    while bits <= LAST_BITS:
        yield bits
        bits *= 2
    raise ComputationError(f"A number could not be enclosed within {LAST_BITS} bits.")


def bits_for(digits: int) -> int:
    """Return a working precision with which to start for this many decimal digits.

    Raises
    ------
    InputError
        If the number of digits is below 1.
    """
    if digits < 1:
        raise InputError(f"The number of digits is {digits}; it must be at least 1.")
    return max(FIRST_BITS, int(digits * 3.33) + 48)


class RealNumber(ABC):
    """A real number, exact, with enclosures of any width."""

    @abstractmethod
    def at_precision(self, bits: int) -> Enclosure:
        """Return an enclosure computed with a working precision in bits."""

    @property
    @abstractmethod
    def radical(self) -> Any | None:
        """The number as a short expression, else None."""

    @property
    @abstractmethod
    def exact(self) -> Any:
        """The number as an exact SymPy expression."""

    @abstractmethod
    def text(self, digits: int = 15) -> str:
        """Return the number for people."""

    @property
    def is_short(self) -> bool:
        """True if the number has a short text."""
        return self.radical is not None

    @property
    def is_rational(self) -> bool:
        """True if the number is known to be rational."""
        return False

    def enclosure(self, digits: int = 15) -> Enclosure:
        """Return an enclosure of width at most 10^-digits relative to max(1, |number|)."""
        for bits in precisions(bits_for(digits)):
            found = self.at_precision(bits)
            if found.narrower_than(digits):
                return found
        raise AssertionError("unreachable")

    def sign(self) -> int:
        """Return the sign of a number that is not an irrational form of zero."""
        for bits in precisions():
            sign = self.at_precision(bits).sign
            if sign is not None:
                return sign
        raise AssertionError("unreachable")

    def __float__(self) -> float:
        return float(self.enclosure(20).middle)


def to_float(enclose: Callable[[int], Enclosure], digits: int) -> Any:
    """Return a nonzero number as a SymPy Float with this many correct digits, however small.

    Parameters
    ----------
    enclose
        Returns an enclosure of width 10^-d times max(1, |number|) for d digits.
    digits
        Number of significant digits.
    """
    bits_for(digits)
    asked = digits + 3
    while True:
        found = enclose(asked)
        if found.width * 10 ** (digits + 2) <= min(abs(found.lower), abs(found.upper)):
            middle = found.middle
            return sp.Float(sp.Rational(middle.numerator, middle.denominator), digits)
        asked *= 2
