"""Complex E-eigenpairs and isotropic eigenvectors of a symmetric tensor of dimension 2.

Qi's E-eigenvectors are complex: v = (cos t, sin t) with complex t. With tau = tan t they are the
complex roots of F(1, tau), of which tau = +-i belong to the isotropic vectors (1, +-i), which no
scale turns into unit vectors. v and -v form one class.

The roots are isolated with proof; the vector and its eigenvalue are enclosed in rectangles that
follow from those of the roots in interval arithmetic.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any

import sympy as sp

from pdtheory.errors import InputError
from pdtheory.exact.algebraic import FIRST_BITS, bits_for, precisions
from pdtheory.exact.balls import complex_roots, engine, horner, real_roots
from pdtheory.exact.coefficients import check_order
from pdtheory.exact.eigenpairs import Outcome
from pdtheory.exact.engines import Integers
from pdtheory.exact.faces import Face
from pdtheory.exact.intervals import Enclosure, Rectangle
from pdtheory.exact.roots import Coefficients, candidates, is_root

#: tau^2 + 1, the polynomial of the isotropic directions.
ISOTROPIC: Integers = (1, 0, 1)

_ZERO = Enclosure(Fraction(0), Fraction(0))
_ONE = Enclosure(Fraction(1), Fraction(1))


@dataclass(frozen=True)
class ComplexEigenPair:
    """One class +-v of complex E-eigenvectors.

    Attributes
    ----------
    polynomial : tuple of int or None
        Minimal polynomial of tau = tan t, constant term first; None for the vertical vector.
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

    polynomial: Integers | None
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
        if self.is_real:
            return Rectangle(real_roots(self.polynomial, bits)[self.index], _ZERO)
        found = complex_roots(self.polynomial, bits)[self.index]
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
            return 1 / engine().sqrt(square)
        unit = engine().complex_interval(Rectangle(_ZERO, _ONE))
        return 1 / (unit * engine().sqrt(-square))

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


@dataclass(frozen=True)
class ComplexEigenPairs:
    """All classes of complex E-eigenvectors of one form.

    Attributes
    ----------
    order : int
        The order k.
    status : {"ok", "isotropic", "vanishing"}
        As for :class:`EigenPairs`.
    classes : tuple of ComplexEigenPair
        The classes: the real ones first. With multiplicity they number n_max, the largest n with
        phi_n != 0.
    isotropic_multiplicity : int
        Multiplicity of each of the isotropic eigenvectors (1, +-i); positive iff phi_k = 0.
    """

    order: int
    status: Outcome
    classes: tuple[ComplexEigenPair, ...]
    isotropic_multiplicity: int

    @property
    def count(self) -> int:
        """Number of classes with multiplicity."""
        return sum(p.multiplicity for p in self.classes)

    def __len__(self) -> int:
        return len(self.classes)

    def __iter__(self) -> Iterator[ComplexEigenPair]:
        return iter(self.classes)

    def __getitem__(self, index: int) -> ComplexEigenPair:
        return self.classes[index]


def complex_eigenpairs(face: Face) -> ComplexEigenPairs:
    """Return all complex E-eigenpairs of a symmetric tensor, up to the sign of v.

    Parameters
    ----------
    face
        A tensor, form or row of order k >= 1 with real algebraic coefficients (times a common
        factor).

    Returns
    -------
    ComplexEigenPairs
        With multiplicity there are n_max classes, k in general (Cartwright and Sturmfels 2013).

    Raises
    ------
    InputError
        If the order is 0, or a coefficient is symbolic, complex, or transcendental other than by a
        common factor.

    Notes
    -----
    For algebraic coefficients every squarefree part of F over their field is factored through its
    norm, so that each root comes with its minimal polynomial over Q; which roots of the norm are
    roots of the part is decided by excluding zero from one of two complementary factors.

    Examples
    --------
    >>> from pdtheory.exact import BinaryForm
    >>> pairs = complex_eigenpairs(BinaryForm([1, 0, sp.Rational(3, 4), 0]))
    >>> [(p.is_real, p.multiplicity, p.eigenvalue(4)) for p in pairs]
    [(True, 1, 1.000), (False, 1, -0.5*I), (False, 1, -0.5*I)]
    """
    form = face.form
    check_order(form.order, 1)
    numbers = Coefficients(form.coefficients)
    numbers.check_real_numbers()
    if form.is_zero:
        return ComplexEigenPairs(form.order, "vanishing", (), 0)
    derivative = form.angular_derivative()
    if derivative.is_zero:
        return ComplexEigenPairs(form.order, "isotropic", (), 0)
    degree, found = candidates(derivative.coefficients)
    value = numbers.polynomial
    real: list[ComplexEigenPair] = []
    other: list[ComplexEigenPair] = []
    isotropic = 0
    for factor, part, multiplicity in found:
        if factor == ISOTROPIC:
            isotropic += multiplicity
            continue
        for is_real, isolate in ((True, _real_rectangles), (False, complex_roots)):
            for i in range(len(isolate(factor, FIRST_BITS))):

                def place(bits: int, isolate: Any = isolate, i: int = i) -> Rectangle:
                    return isolate(factor, bits)[i]  # noqa: B023

                if not is_root(part, factor, place):
                    continue
                vanishing = is_root(value, factor, place)
                target = real if is_real else other
                for mirrored in (False,) if is_real else (False, True):
                    target.append(
                        ComplexEigenPair(
                            factor, i, is_real, mirrored, multiplicity, vanishing, numbers
                        )
                    )
    vertical = form.order - degree
    if vertical:
        zero = form.coefficients[-1] == 0 or value.degree() < form.order
        real.append(ComplexEigenPair(None, 0, True, False, vertical, zero, numbers))
    return ComplexEigenPairs(form.order, "ok", (*real, *other), isotropic)


def _real_rectangles(polynomial: Integers, bits: int) -> list[Rectangle]:
    return [Rectangle(root, _ZERO) for root in real_roots(polynomial, bits)]
