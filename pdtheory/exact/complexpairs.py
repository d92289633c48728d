"""Complex E-eigenpairs and isotropic eigenvectors of a symmetric tensor of dimension 2.

Qi's E-eigenvectors are complex: v = (cos t, sin t) with complex t. With tau = tan t they are the
complex roots of F(1, tau), of which tau = +-i belong to the isotropic vectors (1, +-i), which no
scale turns into unit vectors. v and -v form one class.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import mpmath
import sympy as sp

from pdtheory.errors import InputError
from pdtheory.exact.algebraic import FIRST_BITS, bits_for, precisions, primitive
from pdtheory.exact.balls import Integers, Rectangle, complex_roots, engine, real_roots
from pdtheory.exact.coefficients import check_order
from pdtheory.exact.eigenpairs import Outcome
from pdtheory.exact.faces import BinaryForm, Face
from pdtheory.exact.roots import Coefficients
from pdtheory.exact.zeros import is_zero

#: tau^2 + 1, the polynomial of the isotropic directions.
ISOTROPIC: Integers = (1, 0, 1)


@dataclass(frozen=True)
class ComplexEigenPair:
    """One class +-v of complex E-eigenvectors.

    Attributes
    ----------
    form : BinaryForm
        The form f = T_k v^k.
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
    """

    form: BinaryForm
    polynomial: Integers | None
    index: int
    is_real: bool
    conjugate: bool
    multiplicity: int

    def tangent_enclosure(self, digits: int = 15) -> Rectangle:
        """Return a rectangle that holds tau = tan t, of width 10^-digits relative to 1."""
        if self.polynomial is None:
            raise InputError("The vertical E-eigenvector has no finite tangent.")
        for bits in precisions(bits_for(digits)):
            if self.is_real:
                zero = real_roots((0, 1), FIRST_BITS)[0]
                found = Rectangle(real_roots(self.polynomial, bits)[self.index], zero)
            else:
                found = complex_roots(self.polynomial, bits)[self.index]
            if all(part.narrower_than(digits) for part in found):
                return (
                    found if not self.conjugate else Rectangle(found.real, found.imaginary.flip())
                )
        raise AssertionError("unreachable")

    def vector(self, digits: int = 15) -> tuple[Any, Any]:
        """Return (cos t, sin t) of one member of the class as SymPy numbers."""
        with mpmath.workdps(digits + 15):
            return tuple(_sympy(c, digits) for c in self._vector(digits + 15))

    def eigenvalue(self, digits: int = 15) -> Any:
        """Return lambda = f(v) for that member; -v has the opposite one for odd k."""
        with mpmath.workdps(digits + 15):
            x, y = self._vector(digits + 15)
            k = self.form.order
            terms = (
                mpmath.mpmathify(sp.N(a, digits + 15)) * x ** (k - j) * y**j
                for j, a in enumerate(self.form.coefficients)
            )
            return _sympy(mpmath.fsum(terms), digits)

    def _vector(self, digits: int) -> tuple[Any, Any]:
        if self.polynomial is None:
            return mpmath.mpf(0), mpmath.mpf(1)
        box = self.tangent_enclosure(digits)
        real, imaginary = (mpmath.mpf(p.middle.numerator) / p.middle.denominator for p in box)
        tau = mpmath.mpc(real, imaginary)
        cosine = 1 / mpmath.sqrt(1 + tau * tau)
        return cosine, tau * cosine


def _sympy(value: Any, digits: int) -> Any:
    value = mpmath.mpc(value)
    real, imaginary = (
        sp.Float(mpmath.nstr(p, digits + 5), digits) for p in (value.real, value.imag)
    )
    return real + sp.I * imaginary if value.imag else real


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
        A tensor, form or row of order k >= 1 with rational coefficients (times a common factor).

    Returns
    -------
    ComplexEigenPairs
        With multiplicity there are n_max classes, k in general (Cartwright and Sturmfels 2013).

    Raises
    ------
    InputError
        If the order is 0 or the coefficients are not rational over a common factor.

    Examples
    --------
    >>> pairs = complex_eigenpairs(BinaryForm([1, 0, sp.Rational(3, 4), 0]))
    >>> [(p.is_real, p.multiplicity, p.eigenvalue(4)) for p in pairs]
    [(True, 1, 1.000), (False, 1, -0.5*I), (False, 1, -0.5*I)]
    """
    form = face.form
    check_order(form.order, 1)
    numbers = Coefficients(form.coefficients)
    if numbers.rationals is None:
        raise InputError(
            f"The coefficients of {form.expression} are not all rational over a common factor; "
            "complex E-eigenpairs need that."
        )
    if form.is_zero:
        return ComplexEigenPairs(form.order, "vanishing", (), 0)
    derivative = Coefficients(form.angular_derivative().coefficients)
    if all(is_zero(a) for a in derivative.expressions):
        return ComplexEigenPairs(form.order, "isotropic", (), 0)
    assert derivative.rationals is not None
    polynomial = primitive(derivative.rationals)
    real, other, isotropic = [], [], 0
    for factor, multiplicity in engine().factor(polynomial):
        if factor == ISOTROPIC:
            isotropic = multiplicity
            continue
        for i in range(len(real_roots(factor, FIRST_BITS))):
            real.append(ComplexEigenPair(form, factor, i, True, False, multiplicity))
        for i in range(len(complex_roots(factor, FIRST_BITS))):
            for mirrored in (False, True):
                other.append(ComplexEigenPair(form, factor, i, False, mirrored, multiplicity))
    vertical = form.order - (len(polynomial) - 1)
    if vertical:
        real.append(ComplexEigenPair(form, None, 0, True, False, vertical))
    return ComplexEigenPairs(form.order, "ok", (*real, *other), isotropic)
