"""Real algebraic numbers: an irreducible integer polynomial and which of its real roots.

Enclosures can be asked for to any number of digits; radicals are given when they are short.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import gcd
from typing import Any, Final

import sympy as sp

from pdtheory.errors import ComputationError
from pdtheory.exact.balls import engine, real_roots
from pdtheory.exact.engines import Integers
from pdtheory.exact.intervals import Enclosure

#: Longest text of a radical that is shown instead of the minimal polynomial.
SHORT: Final = 48
#: Longest text of a minimal polynomial that is shown.
LONG: Final = 400
#: Bits with which work starts, and where it is given up (a comparison that never ends).
FIRST_BITS: Final = 112
LAST_BITS: Final = 1 << 20

_T = sp.Symbol("t")


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
    """Return a working precision with which to start for this many decimal digits."""
    return max(FIRST_BITS, int(digits * 3.33) + 48)


def primitive(coefficients: list[Fraction] | list[int]) -> Integers:
    """Return the primitive integer polynomial, positively led, on the line of a rational one."""
    fractions = [Fraction(c) for c in coefficients]
    while len(fractions) > 1 and fractions[-1] == 0:
        fractions.pop()
    scale = 1
    for c in fractions:
        scale = scale * c.denominator // gcd(scale, c.denominator)
    integers = [int(c * scale) for c in fractions]
    content = gcd(*integers) or 1
    sign = -1 if integers[-1] < 0 else 1
    return tuple(sign * c // content for c in integers)


@dataclass(frozen=True)
class RealAlgebraic:
    """A real root of an irreducible integer polynomial.

    Attributes
    ----------
    polynomial : tuple of int
        The minimal polynomial, constant term first, primitive.
    index : int
        Position among its real roots, ascending from 0.
    """

    polynomial: Integers
    index: int

    @classmethod
    def rational(cls, value: Fraction | int) -> RealAlgebraic:
        """Return a rational number."""
        value = Fraction(value)
        return cls((-value.numerator, value.denominator), 0)

    @classmethod
    def select(
        cls, polynomial: Integers, enclose: Callable[[int], Enclosure], first: int = FIRST_BITS
    ) -> RealAlgebraic:
        """Return the root of a polynomial that an ever narrower enclosure singles out.

        Parameters
        ----------
        polynomial
            An integer polynomial that has the number among its roots.
        enclose
            Returns an enclosure of the number at a working precision in bits.
        first
            Bits with which to start.
        """
        factors = [p for p, _ in engine().factor(polynomial)]
        for bits in precisions(first):
            target = enclose(bits)
            found = [
                cls(p, i)
                for p in factors
                for i, root in enumerate(real_roots(p, bits))
                if root.overlaps(target)
            ]
            if len(found) == 1:
                return found[0]
        raise AssertionError("unreachable")

    @property
    def degree(self) -> int:
        """Degree of the minimal polynomial."""
        return len(self.polynomial) - 1

    @property
    def is_rational(self) -> bool:
        """True if the number is rational."""
        return self.degree == 1

    def at_precision(self, bits: int) -> Enclosure:
        """Return an enclosure computed with a working precision in bits."""
        return real_roots(self.polynomial, bits)[self.index]

    def enclosure(self, digits: int = 15) -> Enclosure:
        """Return an enclosure of width at most 10^-digits relative to max(1, |number|)."""
        for bits in precisions(bits_for(digits)):
            found = self.at_precision(bits)
            if found.narrower_than(digits):
                return found
        raise AssertionError("unreachable")

    def sign(self) -> int:
        """Return the sign, exactly."""
        if self.is_rational:
            return -1 if self.polynomial[0] > 0 else int(self.polynomial[0] < 0)
        for bits in precisions():
            sign = self.at_precision(bits).sign
            if sign:
                return sign
        raise AssertionError("unreachable")

    def __float__(self) -> float:
        return float(self.enclosure(20).middle)

    @property
    def radical(self) -> Any | None:
        """The number in radicals if that is short, else None."""
        if self.is_rational:
            return sp.Rational(-self.polynomial[0], self.polynomial[1])
        if self.degree == 2:
            return self._shortest(_quadratic(self.polynomial))
        if self.degree == 4 and self.polynomial[1] == self.polynomial[3] == 0:
            squares = _quadratic((self.polynomial[0], self.polynomial[2], self.polynomial[4]))
            roots = [sp.sqrtdenest(sp.sqrt(s)) for s in squares]
            return self._shortest([*roots, *(-r for r in roots)])
        return None

    def _shortest(self, candidates: list[Any]) -> Any | None:
        # The candidates are the roots of the minimal polynomial: one alone lies in the enclosure.
        here = self.enclosure(30)
        tolerance = Fraction(1, 10**25) * max(Fraction(1), abs(here.middle))
        for candidate in candidates:
            value = sp.N(candidate, 40)
            if value.is_real and abs(Fraction(str(value)) - here.middle) <= tolerance:
                return candidate if len(str(candidate)) <= SHORT else None
        return None

    @property
    def exact(self) -> Any:
        """The number as an exact SymPy expression: radicals if short, else ``CRootOf``."""
        short = self.radical
        if short is not None:
            return short
        return sp.CRootOf(sp.Poly(self.polynomial[::-1], _T), self.index)

    def text(self, digits: int = 15) -> str:
        """Return the number for people: short radicals, or minimal polynomial and enclosure."""
        short = self.radical
        if short is not None and len(str(short)) <= SHORT:
            return str(short)
        if self.is_rational:
            return f"a number in {self.enclosure(digits).text(digits)}"
        polynomial = str(sp.Poly(self.polynomial[::-1], _T).as_expr())
        if len(polynomial) > LONG:
            polynomial = f"an irreducible polynomial of degree {self.degree}"
        return f"the root of {polynomial} in {self.enclosure(digits).text(digits)}"


def _quadratic(polynomial: Integers) -> list[Any]:
    c, b, a = (sp.Integer(e) for e in polynomial)
    root = sp.sqrt(b**2 - 4 * a * c)
    return [sp.expand((-b + root) / (2 * a)), sp.expand((-b - root) / (2 * a))]


def to_float(enclose: Callable[[int], Enclosure], digits: int) -> Any:
    """Return a nonzero number as a SymPy Float with this many correct digits, however small.

    Parameters
    ----------
    enclose
        Returns an enclosure of width 10^-d times max(1, |number|) for d digits.
    digits
        Number of significant digits.
    """
    asked = digits + 3
    while True:
        found = enclose(asked)
        if found.width * 10 ** (digits + 2) <= min(abs(found.lower), abs(found.upper)):
            middle = found.middle
            return sp.Float(sp.Rational(middle.numerator, middle.denominator), digits)
        asked *= 2
