"""Complex E-eigenpairs and isotropic eigenvectors of a symmetric tensor of dimension 2.

Qi's E-eigenvectors are complex: v = (cos t, sin t) with complex t. With tau = tan t they are the
complex roots of F(1, tau), of which tau = +-i belong to the isotropic vectors (1, +-i), which no
scale turns into unit vectors. v and -v form one class.

The roots are isolated with proof; the vector and its eigenvalue are enclosed in rectangles that
follow from those of the roots in interval arithmetic.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from pdtheory.exact.balls import engine, horner
from pdtheory.exact.coefficients import check_order
from pdtheory.exact.complexpair import ComplexEigenPair, places
from pdtheory.exact.constantpolynomial import ConstantPolynomial
from pdtheory.exact.eigenpairs import Outcome, critical_form
from pdtheory.exact.engines import Integers
from pdtheory.exact.faces import BinaryForm, Face
from pdtheory.exact.intervals import Rectangle
from pdtheory.exact.realcoefficients import Coefficients
from pdtheory.exact.realnumber import FIRST_BITS
from pdtheory.exact.roots import candidates, found_among, is_root, without_outer_zeros
from pdtheory.exact.squarefree import squarefree_parts
from pdtheory.exact.wavejets import WavejetsRow
from pdtheory.exact.zeros import is_zero

#: tau^2 + 1, the polynomial of the isotropic directions.
ISOTROPIC: Integers = (1, 0, 1)


class _Zero(NamedTuple):
    """A zero of F: a root of a polynomial, real or in the upper half plane."""

    polynomial: Integers | ConstantPolynomial
    position: int
    is_real: bool
    multiplicity: int

    def place(self, bits: int) -> Rectangle:
        return places(self.polynomial, bits, self.is_real)[self.position]


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
        A tensor, form or row of order k >= 1 with real coefficients that can be enclosed.

    Returns
    -------
    ComplexEigenPairs
        With multiplicity there are n_max classes, k in general (Cartwright and Sturmfels 2013).

    Raises
    ------
    InputError
        If the order is 0, or a coefficient is symbolic or complex.
    ComputationError
        As for :func:`real_eigenpairs`.

    Notes
    -----
    For algebraic coefficients every squarefree part of F over their field is factored through its
    norm, so that each root comes with its minimal polynomial over Q; which roots of the norm are
    roots of the part is decided by excluding zero from one of two complementary factors. For other
    coefficients all complex roots are isolated in balls at once.

    Examples
    --------
    >>> import sympy as sp
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
    derivative = critical_form(form, numbers)
    if derivative.is_zero:
        return ComplexEigenPairs(form.order, "isotropic", (), 0)
    # F = (x^2 + y^2)^m times a form without isotropic zeros, and likewise f up to its mean.
    isotropic = (form.order - form.row.support[-1]) // 2
    critical = Coefficients(derivative.coefficients)
    if critical.in_field:
        zeros, vertical = _algebraic_zeros(critical)
    else:
        zeros, vertical = _constant_zeros(_without_isotropic(derivative, isotropic))
    if numbers.in_field:
        value = numbers.polynomial
        vanishing = [
            isinstance(z.polynomial, tuple) and is_root(value, z.polynomial, z.place) for z in zeros
        ]
    else:
        vanishing = _common_zeros(form, isotropic, numbers, zeros)
    classes = [
        ComplexEigenPair(
            z.polynomial, z.position, z.is_real, mirrored, z.multiplicity, vanishes, numbers
        )
        for z, vanishes in zip(zeros, vanishing, strict=True)
        for mirrored in ((False,) if z.is_real else (False, True))
    ]
    if vertical:
        zero = is_zero(form.coefficients[-1])
        classes.append(ComplexEigenPair(None, 0, True, False, vertical, zero, numbers))
    classes.sort(key=lambda pair: not pair.is_real)
    return ComplexEigenPairs(form.order, "ok", tuple(classes), isotropic)


def _algebraic_zeros(critical: Coefficients) -> tuple[list[_Zero], int]:
    """Return the zeros of F(1, tau) other than +-i, and the multiplicity of the vertical vector."""
    vertical, found = candidates(critical)
    zeros = [
        zero
        for factor, part, multiplicity in found
        if factor != ISOTROPIC
        for real in (True, False)
        for zero in (
            _Zero(factor, i, real, multiplicity)
            for i in range(len(places(factor, FIRST_BITS, real)))
        )
        if is_root(part, factor, zero.place)
    ]
    return zeros, vertical


def _constant_zeros(derivative: BinaryForm) -> tuple[list[_Zero], int]:
    """Return the same for a form with constants as coefficients and without isotropic zeros."""
    at_zero, kept, vertical = without_outer_zeros(derivative.coefficients)
    zeros = [_Zero((0, 1), 0, True, at_zero)] if at_zero else []
    for part in squarefree_parts(kept):
        for real, multiplicities in ((True, part.real), (False, part.upper)):
            zeros += [_Zero(part.polynomial, i, real, m) for i, m in enumerate(multiplicities) if m]
    return zeros, vertical


def _without_isotropic(form: BinaryForm, power: int) -> BinaryForm:
    """Divide a form by (x^2 + y^2)^power, of which it is a multiple."""
    if not power:
        return form
    row = form.row
    order = row.order - 2 * power
    return WavejetsRow(order, {n: value for n, value in row.phi.items() if n <= order}).form


def _common_zeros(
    form: BinaryForm, isotropic: int, numbers: Coefficients, zeros: list[_Zero]
) -> list[bool]:
    """Return which zeros of F are zeros of f: the multiple ones of f, those at +-i left out."""
    doubtful = []
    for zero in zeros:
        with engine().precision(FIRST_BITS):
            tau = engine().complex_interval(zero.place(FIRST_BITS))
            if horner(numbers.intervals(FIRST_BITS), tau).contains(0):
                doubtful.append(zero)
    if not doubtful:
        return [False] * len(zeros)
    found, _ = _constant_zeros(_without_isotropic(form, isotropic))
    common = found_among(doubtful, [z for z in found if z.multiplicity > 1], _Zero.place)
    return [any(z is c for c in common) for z in zeros]
