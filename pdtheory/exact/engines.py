"""Certified numbers by python-flint (Arb's balls), behind our own plain types."""

from __future__ import annotations

from contextlib import AbstractContextManager
from fractions import Fraction
from typing import Any

from pdtheory.exact.intervals import Enclosure, Rectangle

#: The coefficients of an integer polynomial, constant term first.
Integers = tuple[int, ...]


class Engine:
    """Arb's balls, polynomials and their roots through python-flint."""

    def __init__(self) -> None:
        import flint

        self.library = flint

    def factor(self, polynomial: Integers) -> list[tuple[Integers, int]]:
        """Return the irreducible factors over Q of positive degree, with their multiplicities."""
        _, factors = self.library.fmpz_poly(list(polynomial)).factor()
        return [(tuple(int(c) for c in p.coeffs()), int(m)) for p, m in factors]

    def real_roots(self, polynomial: Integers, bits: int) -> list[Enclosure]:
        """Return disjoint enclosures of all real roots of a squarefree polynomial, ascending."""
        p = self.library.fmpz_poly(list(polynomial))
        if p.degree() == 1:
            root = Fraction(-int(p[0]), int(p[1]))
            return [Enclosure(root, root)]
        # FLINT proves that a root is real before it sets the imaginary part to exact zero.
        with self.precision(bits):
            roots = [r.real for r, _ in p.complex_roots() if r.imag.is_zero()]
            return sorted(self.enclosure(r) for r in roots)

    def complex_roots(self, polynomial: Integers, bits: int) -> list[Rectangle]:
        """Return disjoint enclosures of the roots with positive imaginary part."""
        with self.precision(bits):
            roots = [r for r, _ in self.library.fmpz_poly(list(polynomial)).complex_roots()]
            upper = [r for r in roots if not r.imag.is_zero() and r.imag > 0]
            return sorted(self.rectangle(r) for r in upper)

    def precision(self, bits: int) -> AbstractContextManager[Any]:
        """Return a context in which intervals carry this many bits."""
        return self.library.ctx.workprec(bits)

    def interval(self, enclosure: Enclosure) -> Any:
        """Return a ball that contains the enclosure."""
        lower, upper = (
            self.library.arb(self.library.fmpq(e.numerator, e.denominator)) for e in enclosure
        )
        return lower if enclosure.lower == enclosure.upper else lower.union(upper)

    def enclosure(self, interval: Any) -> Enclosure:
        """Return rational ends of a real ball."""
        middle, radius = _dyadic(interval.mid()), _dyadic(interval.rad())
        return Enclosure(middle - radius, middle + radius)

    def complex_interval(self, rectangle: Rectangle) -> Any:
        """Return a complex ball that contains the rectangle."""
        return self.library.acb(*(self.interval(side) for side in rectangle))

    def rectangle(self, interval: Any) -> Rectangle:
        """Return a rectangle with rational corners around a complex ball."""
        return Rectangle(self.enclosure(interval.real), self.enclosure(interval.imag))

    def atan_degrees(self, interval: Any) -> Any:
        """Return the arc tangent in degrees."""
        return interval.atan() * 180 / self.library.arb.pi()


def _dyadic(value: Any) -> Fraction:
    mantissa, exponent = (int(part) for part in value.man_exp())
    return _power_of_two(mantissa, exponent)


def _power_of_two(mantissa: int, exponent: int) -> Fraction:
    if exponent >= 0:
        return Fraction(mantissa << exponent)
    return Fraction(mantissa, 1 << -exponent)
