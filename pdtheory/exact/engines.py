"""Two libraries of certified numbers behind one interface.

`FlintEngine` uses python-flint (Arb's balls); `SympyEngine` uses SymPy's real root isolation and
mpmath's interval arithmetic, slower and without a compiled library.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from fractions import Fraction
from itertools import pairwise
from typing import Any, Protocol

from pdtheory.exact.intervals import Enclosure, Rectangle

#: The coefficients of an integer polynomial, constant term first.
Integers = tuple[int, ...]


class Engine(Protocol):
    """What the exact side asks of a library of certified numbers."""

    name: str

    def factor(self, polynomial: Integers) -> list[tuple[Integers, int]]:
        """Return the irreducible factors over Q of positive degree, with their multiplicities."""

    def real_roots(self, polynomial: Integers, bits: int) -> list[Enclosure]:
        """Return disjoint enclosures of all real roots of a squarefree polynomial, ascending."""

    def complex_roots(self, polynomial: Integers, bits: int) -> list[Rectangle]:
        """Return disjoint enclosures of the roots with positive imaginary part."""

    def precision(self, bits: int) -> AbstractContextManager[Any]:
        """Return a context in which intervals carry this many bits."""

    def interval(self, enclosure: Enclosure) -> Any:
        """Return an interval number of the engine that contains the enclosure."""

    def enclosure(self, interval: Any) -> Enclosure:
        """Return rational ends of an interval number."""

    def complex_interval(self, rectangle: Rectangle) -> Any:
        """Return a complex interval number that contains the rectangle."""

    def rectangle(self, interval: Any) -> Rectangle:
        """Return a rectangle with rational corners around a complex interval number."""

    def sqrt(self, interval: Any) -> Any:
        """Return the principal square root; a complex number must lie off the negative axis."""

    def atan_degrees(self, interval: Any) -> Any:
        """Return the arc tangent in degrees."""


class FlintEngine:
    """Arb's balls through python-flint."""

    name = "python-flint"

    def __init__(self) -> None:
        import flint

        self.library = flint

    def factor(self, polynomial: Integers) -> list[tuple[Integers, int]]:
        """See :class:`Engine`."""
        _, factors = self.library.fmpz_poly(list(polynomial)).factor()
        return [(tuple(int(c) for c in p.coeffs()), int(m)) for p, m in factors]

    def real_roots(self, polynomial: Integers, bits: int) -> list[Enclosure]:
        """See :class:`Engine`."""
        p = self.library.fmpz_poly(list(polynomial))
        if p.degree() == 1:
            root = Fraction(-int(p[0]), int(p[1]))
            return [Enclosure(root, root)]
        # FLINT proves that a root is real before it sets the imaginary part to exact zero.
        with self.precision(bits):
            roots = [r.real for r, _ in p.complex_roots() if r.imag.is_zero()]
            return sorted(self.enclosure(r) for r in roots)

    def complex_roots(self, polynomial: Integers, bits: int) -> list[Rectangle]:
        """See :class:`Engine`."""
        with self.precision(bits):
            roots = [r for r, _ in self.library.fmpz_poly(list(polynomial)).complex_roots()]
            upper = [r for r in roots if not r.imag.is_zero() and r.imag > 0]
            return sorted(Rectangle(self.enclosure(r.real), self.enclosure(r.imag)) for r in upper)

    def precision(self, bits: int) -> AbstractContextManager[Any]:
        """See :class:`Engine`."""
        return self.library.ctx.workprec(bits)

    def interval(self, enclosure: Enclosure) -> Any:
        """See :class:`Engine`."""
        lower, upper = (
            self.library.arb(self.library.fmpq(e.numerator, e.denominator)) for e in enclosure
        )
        return lower if enclosure.lower == enclosure.upper else lower.union(upper)

    def enclosure(self, interval: Any) -> Enclosure:
        """See :class:`Engine`."""
        middle, radius = _dyadic(interval.mid()), _dyadic(interval.rad())
        return Enclosure(middle - radius, middle + radius)

    def complex_interval(self, rectangle: Rectangle) -> Any:
        """See :class:`Engine`."""
        return self.library.acb(*(self.interval(side) for side in rectangle))

    def rectangle(self, interval: Any) -> Rectangle:
        """See :class:`Engine`."""
        return Rectangle(self.enclosure(interval.real), self.enclosure(interval.imag))

    def sqrt(self, interval: Any) -> Any:
        """See :class:`Engine`."""
        return interval.sqrt()

    def atan_degrees(self, interval: Any) -> Any:
        """See :class:`Engine`."""
        return interval.atan() * 180 / self.library.arb.pi()


def _dyadic(value: Any) -> Fraction:
    mantissa, exponent = (int(part) for part in value.man_exp())
    return _power_of_two(mantissa, exponent)


def _power_of_two(mantissa: int, exponent: int) -> Fraction:
    if exponent >= 0:
        return Fraction(mantissa << exponent)
    return Fraction(mantissa, 1 << -exponent)


class SympyEngine:
    """SymPy's isolation of real roots and mpmath's intervals."""

    name = "sympy"

    def __init__(self) -> None:
        import mpmath
        import sympy

        self._mpmath = mpmath
        self._sympy = sympy

    def _poly(self, polynomial: Integers) -> Any:
        return self._sympy.Poly(polynomial[::-1], self._sympy.Symbol("t"), domain="ZZ")

    def factor(self, polynomial: Integers) -> list[tuple[Integers, int]]:
        """See :class:`Engine`."""
        _, factors = self._poly(polynomial).factor_list()
        return [(tuple(int(c) for c in p.all_coeffs()[::-1]), m) for p, m in factors]

    def real_roots(self, polynomial: Integers, bits: int) -> list[Enclosure]:
        """See :class:`Engine`."""
        p = self._poly(polynomial)
        isolated = p.intervals(eps=self._sympy.Rational(1, 2**bits))
        roots = [Enclosure(_fraction(a), _fraction(b)) for (a, b), _ in isolated]
        # Neighbouring intervals may touch; a common end is a root of neither.
        while any(a.upper >= b.lower for a, b in pairwise(roots)):
            bits *= 2
            roots = [
                Enclosure(_fraction(a), _fraction(b))
                for a, b in (
                    p.refine_root(r.lower, r.upper, eps=self._sympy.Rational(1, 2**bits))
                    for r in roots
                )
            ]
        return roots

    def complex_roots(self, polynomial: Integers, bits: int) -> list[Rectangle]:
        """See :class:`Engine`."""
        eps = self._sympy.Rational(1, 2**bits)
        _, isolated = self._poly(polynomial).intervals(all=True, eps=eps)
        corners = [
            [self._sympy.sympify(c, strict=True).as_real_imag() for c in pair]
            for pair, _ in isolated
        ]
        found = [
            Rectangle(
                Enclosure(_fraction(a[0]), _fraction(b[0])),
                Enclosure(_fraction(a[1]), _fraction(b[1])),
            )
            for a, b in corners
        ]
        return sorted(r for r in found if r.imaginary.lower >= 0)

    @contextmanager
    def precision(self, bits: int) -> Iterator[None]:
        """See :class:`Engine`."""
        iv = self._mpmath.iv
        before, iv.prec = iv.prec, bits
        try:
            yield
        finally:
            iv.prec = before

    def interval(self, enclosure: Enclosure) -> Any:
        """See :class:`Engine`."""
        iv = self._mpmath.iv
        lower, upper = (iv.mpf(e.numerator) / iv.mpf(e.denominator) for e in enclosure)
        return iv.mpf([lower.a, upper.b])

    def enclosure(self, interval: Any) -> Enclosure:
        """See :class:`Engine`."""
        ends = (self._mpmath.mp.make_mpf(end) for end in interval._mpi_)
        return Enclosure(*(_binary(end) for end in ends))

    def complex_interval(self, rectangle: Rectangle) -> Any:
        """See :class:`Engine`."""
        return self._mpmath.iv.mpc(*(self.interval(side) for side in rectangle))

    def rectangle(self, interval: Any) -> Rectangle:
        """See :class:`Engine`."""
        iv = self._mpmath.iv
        value = interval if isinstance(interval, iv.mpc) else iv.mpc(interval)
        return Rectangle(self.enclosure(value.real), self.enclosure(value.imag))

    def sqrt(self, interval: Any) -> Any:
        """See :class:`Engine`."""
        iv = self._mpmath.iv
        if not isinstance(interval, iv.mpc):
            return iv.sqrt(interval)
        # By the half angle: both roots are of numbers that are not negative.
        size = iv.sqrt(interval.real * interval.real + interval.imag * interval.imag)
        real = iv.sqrt((size + interval.real) / 2)
        return iv.mpc(real, interval.imag / (2 * real))

    def atan_degrees(self, interval: Any) -> Any:
        """See :class:`Engine`."""
        iv = self._mpmath.iv
        return iv.atan2(interval, iv.mpf(1)) * 180 / iv.pi


def _fraction(value: Any) -> Fraction:
    return Fraction(int(value.p), int(value.q))


def _binary(value: Any) -> Fraction:
    sign, mantissa, exponent, _ = value._mpf_
    return _power_of_two(-int(mantissa) if sign else int(mantissa), int(exponent))
