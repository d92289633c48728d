"""One class of complex E-eigenvectors, with enclosures to any number of digits."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any

import sympy as sp

from pdtheory.errors import InputError
from pdtheory.exact.balls import complex_roots, engine, horner, real_roots
from pdtheory.exact.constantpolynomial import ConstantPolynomial
from pdtheory.exact.engines import Integers
from pdtheory.exact.intervals import Enclosure, Rectangle
from pdtheory.exact.realcoefficients import Coefficients
from pdtheory.exact.realnumber import bits_for, precisions

_ZERO = Enclosure(Fraction(0), Fraction(0))
_ONE = Enclosure(Fraction(1), Fraction(1))


def places(
    polynomial: Integers | ConstantPolynomial, bits: int, real: bool
) -> tuple[Rectangle, ...]:
    """Return enclosures of the real roots of a polynomial, or of those in the upper half plane."""
    if isinstance(polynomial, ConstantPolynomial):
        found = polynomial.isolated(bits)
        return tuple(Rectangle(r, _ZERO) for r in found.real) if real else found.upper
    if real:
        return tuple(Rectangle(root, _ZERO) for root in real_roots(polynomial, bits))
    return complex_roots(polynomial, bits)


@dataclass(frozen=True)
class ComplexEigenPair:
    """One class +-v of complex E-eigenvectors.

    Attributes
    ----------
    polynomial : tuple of int, ConstantPolynomial or None
        Minimal polynomial of tau = tan t, constant term first, or a squarefree polynomial with
        constants as coefficients; None for the vertical vector.
    index : int
        Position among its real roots, or among its roots in the upper half plane.
    is_real : bool
        True if the vector is real.
    conjugate : bool
        True for the mirror image of a root of the upper half plane.
    multiplicity : int
        Multiplicity as a root of F.
    vanishing : bool
        True if lambda = 0, decided exactly.
    """

    polynomial: Integers | ConstantPolynomial | None
    index: int
    is_real: bool
    conjugate: bool
    multiplicity: int
    vanishing: bool
    _numbers: Coefficients = field(repr=False, compare=False)

    def tangent_enclosure(self, digits: int = 15) -> Rectangle:
        """Return a rectangle that holds tau = tan t, of width 10^-digits relative to 1."""
        if self.polynomial is None:
            raise InputError("The vertical E-eigenvector has no finite tangent.")
        for bits in precisions(bits_for(digits)):
            found = self._tangent(bits)
            if all(part.narrower_than(digits) for part in found):
                return found
        raise AssertionError("unreachable")

    def vector_enclosure(self, digits: int = 15) -> tuple[Rectangle, Rectangle]:
        """Return rectangles that hold cos t and sin t of one member of the class.

        It is the same member for any number of digits, and that of `eigenvalue_enclosure`.
        """
        first, second = (
            _narrowed(lambda bits, i=i: self._vector(bits)[i], digits)  # type: ignore[misc]
            for i in (0, 1)
        )
        return first, second

    def eigenvalue_enclosure(self, digits: int = 15) -> Rectangle:
        """Return a rectangle that holds lambda = f(v), of width 10^-digits max(1, |lambda|)."""
        return _narrowed(self._eigenvalue, digits)

    def vector(self, digits: int = 15) -> tuple[Any, Any]:
        """Return (cos t, sin t) of one member of the class as SymPy numbers.

        The digits are proved; they count from the larger of the real and the imaginary part.
        """
        first, second = (
            _rounded(lambda bits, i=i: self._vector(bits)[i], digits)  # type: ignore[misc]
            for i in (0, 1)
        )
        return first, second

    def eigenvalue(self, digits: int = 15) -> Any:
        """Return lambda = f(v) for that member; -v has the opposite one for odd k."""
        return sp.Integer(0) if self.vanishing else _rounded(self._eigenvalue, digits)

    def _tangent(self, bits: int) -> Rectangle:
        assert self.polynomial is not None
        found = places(self.polynomial, bits, self.is_real)[self.index]
        return Rectangle(found.real, found.imaginary.flip()) if self.conjugate else found

    @cached_property
    def _turned(self) -> bool:
        """True if i sqrt(-s) is taken for the root of s = 1 + tau^2, which lies on or near the cut.

        Decided once, so that every precision gives the same of the two vectors.
        """
        for bits in precisions():
            with engine().precision(bits):
                square = engine().rectangle(self._square(bits))
            if square.imaginary.sign in (1, -1) or square.real.sign == 1:
                return False
            if square.real.sign == -1:
                return True
        raise AssertionError("unreachable")

    def _square(self, bits: int) -> Any:
        tau = engine().complex_interval(self._tangent(bits))
        return 1 + tau * tau

    def _cosine(self, bits: int) -> Any:
        square = self._square(bits)
        if not self._turned:
            return 1 / square.sqrt()
        unit = engine().complex_interval(Rectangle(_ZERO, _ONE))
        return 1 / (unit * (-square).sqrt())

    def _vector(self, bits: int) -> tuple[Rectangle, Rectangle]:
        if self.polynomial is None:
            return Rectangle(_ZERO, _ZERO), Rectangle(_ONE, _ZERO)
        with engine().precision(bits):
            cosine = self._cosine(bits)
            sine = cosine * engine().complex_interval(self._tangent(bits))
            return engine().rectangle(cosine), engine().rectangle(sine)

    def _eigenvalue(self, bits: int) -> Rectangle:
        if self.vanishing:
            return Rectangle(_ZERO, _ZERO)
        with engine().precision(bits):
            coefficients = self._numbers.intervals(bits)
            if self.polynomial is None:
                value = coefficients[-1]
            else:
                tau = engine().complex_interval(self._tangent(bits))
                value = horner(coefficients, tau) * self._cosine(bits) ** (len(coefficients) - 1)
            if self._numbers.factor != 1:
                value = value * self._numbers.factor_interval(bits)
            one = engine().complex_interval(Rectangle(_ONE, _ZERO))
            return engine().rectangle(one * value)


def _narrowed(enclose: Callable[[int], Rectangle], digits: int) -> Rectangle:
    """Return an enclosure of width at most 10^-digits times max(1, |number|)."""
    for bits in precisions(bits_for(digits)):
        found = enclose(bits)
        if found.width * 10**digits <= max(Fraction(1), found.least_size):
            return found
    raise AssertionError("unreachable")


def _rounded(enclose: Callable[[int], Rectangle], digits: int) -> Any:
    """Return a number with this many digits; a part too small to show in them is 0."""
    for bits in precisions(bits_for(digits)):
        found = enclose(bits)
        if found.real == found.imaginary == _ZERO:
            return sp.Integer(0)
        least = found.least_size
        if least and found.width * 10 ** (digits + 2) <= least:
            break
    parts = [
        sp.Float(sp.Rational(side.middle.numerator, side.middle.denominator), digits)
        if abs(side.middle) * 10 ** (digits + 1) > least
        else sp.Integer(0)
        for side in found
    ]
    return parts[0] + sp.I * parts[1]
