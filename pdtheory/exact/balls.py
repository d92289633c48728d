"""Certified real numbers: isolating the real roots of integer polynomials, and intervals.

Two engines do the same three jobs. `FlintEngine` uses python-flint (Arb's balls); `SympyEngine`
uses SymPy's real root isolation and mpmath's interval arithmetic, slower and without a compiled
library. `engine()` returns the first that can be imported.

Polynomials are tuples of integers, constant term first.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from fractions import Fraction
from functools import cache, lru_cache
from itertools import pairwise
from typing import Any, NamedTuple, Protocol

Integers = tuple[int, ...]


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
    text = str(abs(scaled)).rjust(places + 1, "0")
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
