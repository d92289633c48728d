"""Intervals and rectangles with rational ends that are proved to hold a number."""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

from mpmath.libmp import numeral


class Enclosure(NamedTuple):
    """A closed interval with rational ends that is proved to hold a real number."""

    lower: Fraction
    upper: Fraction

    @property
    def middle(self) -> Fraction:
        """The midpoint."""
        return (self.lower + self.upper) / 2

    @property
    def width(self) -> Fraction:
        """The length of the interval."""
        return self.upper - self.lower

    @property
    def sign(self) -> int | None:
        """The sign of every number inside, or None if zero is inside among others."""
        if self.lower > 0:
            return 1
        if self.upper < 0:
            return -1
        return 0 if self.lower == self.upper else None

    def narrower_than(self, digits: int) -> bool:
        """Return whether the width is below 10^-digits relative to max(1, |number|)."""
        scale = max(Fraction(1), min(abs(self.lower), abs(self.upper)))
        return self.width * 10**digits <= scale

    def overlaps(self, other: Enclosure) -> bool:
        """Return whether the two intervals share a point."""
        return self.lower <= other.upper and other.lower <= self.upper

    def shift(self, by: int) -> Enclosure:
        """Return the interval moved by an integer."""
        return Enclosure(self.lower + by, self.upper + by)

    def flip(self) -> Enclosure:
        """Return the interval mirrored at zero."""
        return Enclosure(-self.upper, -self.lower)

    def text(self, digits: int) -> str:
        """Return the interval with decimal ends of about this many digits, rounded outwards."""
        size = max(abs(self.lower), abs(self.upper))
        places = digits
        while places > 0 and size >= 1:
            size, places = size / 10, places - 1
        while size and size < Fraction(1, 10):
            size, places = size * 10, places + 1
        lower = _decimal((self.lower * 10**places).__floor__(), places)
        upper = _decimal((self.upper * 10**places).__ceil__(), places)
        return f"[{lower}, {upper}]"


def _decimal(scaled: int, places: int) -> str:
    # Python refuses to write numbers of more than 4,300 digits.
    size = abs(scaled)
    text = numeral(size, size=size.bit_length() * 3 // 10).rjust(places + 1, "0")
    sign = "-" if scaled < 0 else ""
    return f"{sign}{text[:-places]}.{text[-places:]}" if places else f"{sign}{text}"


class Rectangle(NamedTuple):
    """A rectangle in the complex plane that is proved to hold one complex number."""

    real: Enclosure
    imaginary: Enclosure

    @property
    def excludes_zero(self) -> bool:
        """True if the number is proved not to be zero."""
        return any(side.sign in (1, -1) for side in self)

    def overlaps(self, other: Rectangle) -> bool:
        """Return whether the two rectangles share a point."""
        return self.real.overlaps(other.real) and self.imaginary.overlaps(other.imaginary)

    @property
    def width(self) -> Fraction:
        """The longer side."""
        return max(side.width for side in self)

    @property
    def least_size(self) -> Fraction:
        """A lower bound on the larger of the two parts in size."""
        return max(
            min(abs(side.lower), abs(side.upper)) if side.sign in (1, -1) else Fraction(0)
            for side in self
        )
