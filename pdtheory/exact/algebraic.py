"""Real algebraic numbers: an irreducible integer polynomial and which of its real roots.

Enclosures can be asked for to any number of digits; radicals are given when they are short.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import gcd
from typing import Any, Final

import sympy as sp

from pdtheory.exact.balls import engine, real_roots
from pdtheory.exact.enclosing import enclose
from pdtheory.exact.engines import Integers
from pdtheory.exact.intervals import Enclosure
from pdtheory.exact.realnumber import FIRST_BITS, SHORT, RealNumber, precisions

#: Longest text of a minimal polynomial that is shown.
LONG: Final = 400
#: Size of the integers in a minimal polynomial, in bits, from which no radicals are short: none has
#: more than four times the digits that are written in the radicals. SymPy looks for factors in what
#: it takes a root of, which takes minutes for an integer of a few thousand digits.
LARGE: Final = 16 * SHORT
_T = sp.Symbol("t")


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
class RealAlgebraic(RealNumber):
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

    @property
    def _is_large(self) -> bool:
        return max(abs(c) for c in self.polynomial).bit_length() >= LARGE

    @cached_property
    def radical(self) -> Any | None:
        """The number in radicals if it is rational or that is short, else None."""
        if self.is_rational:
            return sp.Rational(-self.polynomial[0], self.polynomial[1])
        if self._is_large:
            return None
        if self.degree == 2:
            return self._shortest(_quadratic(self.polynomial))
        if self.degree == 4 and self.polynomial[1] == self.polynomial[3] == 0:
            squares = _quadratic((self.polynomial[0], self.polynomial[2], self.polynomial[4]))
            roots = [sp.sqrtdenest(sp.sqrt(s)) for s in squares]
            return self._shortest([*roots, *(-r for r in roots)])
        return None

    def _shortest(self, candidates: list[Any]) -> Any | None:
        # The candidates are roots of the minimal polynomial: at some width one alone is near.
        for bits in precisions():
            here, near = self.at_precision(bits), []
            for candidate in candidates:
                found = enclose(candidate, bits)
                if found is None or (
                    found.real.overlaps(here) and found.imaginary.sign not in (1, -1)
                ):
                    near.append(candidate)
            if len(near) <= 1:
                return next((c for c in near if len(str(c)) <= SHORT), None)
        raise AssertionError("unreachable")

    @property
    def is_short(self) -> bool:
        """True if the number has a short text in radicals."""
        return not self._is_large and super().is_short and len(str(self.radical)) <= SHORT

    @property
    def exact(self) -> Any:
        """The number as an exact SymPy expression: radicals if short, else ``CRootOf``."""
        short = self.radical
        if short is not None:
            return short
        return sp.CRootOf(sp.Poly(self.polynomial[::-1], _T), self.index)

    def text(self, digits: int = 15) -> str:
        """Return the number for people: short radicals, or minimal polynomial and enclosure."""
        if self.is_short:
            return str(self.radical)
        if self.is_rational:
            return f"a number in {self.enclosure(digits).text(digits)}"
        polynomial = f"an irreducible polynomial of degree {self.degree}"
        # A digit takes fewer than four bits.
        if sum(c.bit_length() for c in self.polynomial) <= 4 * LONG:
            written = str(sp.Poly(self.polynomial[::-1], _T).as_expr())
            polynomial = written if len(written) <= LONG else polynomial
        return f"the root of {polynomial} in {self.enclosure(digits).text(digits)}"


def _quadratic(polynomial: Integers) -> list[Any]:
    c, b, a = (sp.Integer(e) for e in polynomial)
    root = sp.sqrt(b**2 - 4 * a * c)
    return [sp.expand((-b + root) / (2 * a)), sp.expand((-b - root) / (2 * a))]
