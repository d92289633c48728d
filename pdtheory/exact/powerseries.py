"""Truncated power series in a few variables, by their graded parts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Series:
    """A power series modulo degree K + 1.

    The degree of a variable is the index of the part in which it stands, so that a height over a
    tangent plane may count as 2.

    Attributes
    ----------
    terms : tuple
        The homogeneous parts of degrees 0 to K, elements of one SymPy polynomial ring.
    """

    terms: tuple[Any, ...]

    @property
    def degree(self) -> int:
        """The degree K to which the series is known."""
        return len(self.terms) - 1

    def __add__(self, other: Series) -> Series:
        return Series(tuple(a + b for a, b in zip(self.terms, other.terms, strict=True)))

    def __sub__(self, other: Series) -> Series:
        return Series(tuple(a - b for a, b in zip(self.terms, other.terms, strict=True)))

    def __mul__(self, other: Series) -> Series:
        a, b = self.terms, other.terms
        zero = a[0] * 0
        return Series(
            tuple(
                sum((a[i] * b[j - i] for i in range(j + 1) if a[i] and b[j - i]), zero)
                for j in range(len(a))
            )
        )

    def __pow__(self, exponent: int) -> Series:
        result: Series | None = None
        base = self
        while exponent:
            if exponent & 1:
                result = base if result is None else result * base
            exponent >>= 1
            base = base * base if exponent else base
        if result is None:
            one = self.terms[0] * 0 + 1
            return Series((one, *(t * 0 for t in self.terms[1:])))
        return result

    def scale(self, factor: Any) -> Series:
        """Return the series times an element of the coefficient field."""
        return Series(tuple(a * factor for a in self.terms))

    def without_constant(self) -> Series:
        """Return the series minus its constant term."""
        return Series((self.terms[0] * 0, *self.terms[1:]))

    def apply(self, coefficients: Sequence[Any]) -> Series:
        """Return sum_j c_j (self - constant)^j by Horner's rule."""
        small = self.without_constant()
        value = self.scale(0)
        for c in reversed(coefficients):
            value = value * small
            value = Series((value.terms[0] + c, *value.terms[1:]))
        return value
