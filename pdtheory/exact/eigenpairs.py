"""Real E-eigenpairs of a symmetric tensor of dimension 2, exact and certified.

The E-eigenvectors are the zeros on the circle of F = x f_y - y f_x, that is the real roots of
F(1, t), t = tan(theta), and theta = 90 degrees where the degree of F(1, t) drops. The polynomial is
factored exactly and its real roots isolated with proof, so their number is proved.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal

from pdtheory.conventions import Kind
from pdtheory.exact.balls import engine, horner
from pdtheory.exact.coefficients import check_order
from pdtheory.exact.eigenpair import EigenPair
from pdtheory.exact.faces import BinaryForm, Face
from pdtheory.exact.realcoefficients import Coefficients
from pdtheory.exact.realnumber import FIRST_BITS, RealNumber, precisions
from pdtheory.exact.roots import form_roots, found_among
from pdtheory.exact.zeros import is_zero

Outcome = Literal["ok", "isotropic", "vanishing"]


@dataclass(frozen=True)
class EigenPairs:
    """All real E-eigenpairs of one form, by angle in [0, 360) degrees.

    Iterate over it, index it, take its length.

    Attributes
    ----------
    form : BinaryForm
        The form f = T_k v^k.
    status : {"ok", "isotropic", "vanishing"}
        "isotropic" if f is a nonzero constant on the circle, so that every unit vector is an
        E-eigenvector and none is listed; "vanishing" if f = 0.
    pairs : tuple of EigenPair
        The pairs, by ascending angle.
    """

    form: BinaryForm
    status: Outcome
    pairs: tuple[EigenPair, ...]

    @property
    def order(self) -> int:
        """The order k."""
        return self.form.order

    @property
    def isotropic_eigenvalue(self) -> Any | None:
        """The one value of f on the circle where the status is not "ok", else None."""
        return None if self.status == "ok" else self.form.coefficients[0]

    @property
    def maxima(self) -> tuple[EigenPair, ...]:
        """The maximum principal directions."""
        return self.of_kind(Kind.MAXIMUM)

    @property
    def minima(self) -> tuple[EigenPair, ...]:
        """The minimum principal directions."""
        return self.of_kind(Kind.MINIMUM)

    @property
    def inflections(self) -> tuple[EigenPair, ...]:
        """The E-eigenvectors that are no extrema."""
        return self.of_kind(Kind.INFLECTION)

    def of_kind(self, kind: Kind) -> tuple[EigenPair, ...]:
        """Return the pairs of one kind."""
        return tuple(p for p in self.pairs if p.kind == kind)

    def _repr_latex_(self) -> str:
        from pdtheory.exact.report import latex_pairs

        return latex_pairs(self)

    def __len__(self) -> int:
        return len(self.pairs)

    def __iter__(self) -> Iterator[EigenPair]:
        return iter(self.pairs)

    def __getitem__(self, index: int) -> EigenPair:
        return self.pairs[index]


def real_eigenpairs(face: Face) -> EigenPairs:
    """Return all real E-eigenpairs of a symmetric tensor, on the full circle.

    Parameters
    ----------
    face
        A tensor, binary form or Wavejets row of order k >= 1 with real coefficients that can be
        enclosed: algebraic numbers, pi, values of exponentials and the like.

    Returns
    -------
    EigenPairs
        For odd k the pair at theta + 180 degrees has the opposite kind and eigenvalue, for even k
        the same.

    Raises
    ------
    InputError
        If the order is 0, or a coefficient is symbolic or complex.
    ComputationError
        If a coefficient cannot be enclosed, or a number that decides on degree or multiplicity is
        too close to zero to be told from it and no proof is known either way.

    Notes
    -----
    theta is an E-eigenvector iff g_k'(theta) = 0 (theorem 1 of the paper). It is an extremum iff
    the multiplicity of that zero is odd; then the first derivative of g_k that does not vanish
    has the sign in which F changes across theta, and F has no other zero between neighbours.

    Examples
    --------
    >>> pairs = real_eigenpairs(BinaryForm([6, 0, -18, 0]))
    >>> [(str(p.vector[0]), p.eigenvalue, p.kind.label) for p in pairs][:3]
    [('1', 6, 'max'), ('1/2', -6, 'min'), ('-1/2', 6, 'max')]
    """
    form = face.form
    check_order(form.order, 1)
    numbers = Coefficients(form.coefficients)
    numbers.check_real_numbers()
    if face.is_zero:
        return EigenPairs(form, "vanishing", ())
    derivative = critical_form(form, numbers)
    if derivative.is_zero:
        return EigenPairs(form, "isotropic", ())
    half = _half_circle(derivative)
    zeros = _common_zeros(form, numbers, [tangent for tangent, _, _ in half])
    pairs = [
        EigenPair(
            tangent,
            opposite,
            Kind(-kind if opposite and form.order % 2 else kind),
            multiplicity,
            tangent in zeros,
            numbers,
        )
        for opposite in (False, True)
        for tangent, multiplicity, kind in half
    ]
    return EigenPairs(form, "ok", tuple(pairs))


def critical_form(form: BinaryForm, numbers: Coefficients) -> BinaryForm:
    """Return F, or F over the common factor of f, so that both lie in one field where f does.

    The factor is positive, so that zeros, multiplicities and signs are those of F.
    """
    return (BinaryForm(numbers.algebraic) if numbers.in_field else form).angular_derivative()


def _common_zeros(
    form: BinaryForm, numbers: Coefficients, critical: list[RealNumber | None]
) -> set[RealNumber | None]:
    """Return the zeros of f among the zeros of F, which are the multiple zeros of f."""
    if numbers.in_field:
        return {root.value for root in form_roots(form.coefficients, least_multiplicity=2)}
    doubtful = [t for t in critical if t is not None and not _excludes_zero(numbers, t, FIRST_BITS)]
    vertical: set[RealNumber | None] = {
        t for t in critical if t is None and is_zero(form.coefficients[-1])
    }
    if not doubtful:
        return vertical
    multiple = [
        r.value for r in form_roots(form.coefficients, least_multiplicity=2) if r.value is not None
    ]
    return vertical.union(found_among(doubtful, multiple, lambda t, bits: t.at_precision(bits)))


def _excludes_zero(numbers: Coefficients, tangent: RealNumber, bits: int) -> bool:
    """Return whether f(1, t) is seen not to vanish."""
    with engine().precision(bits):
        t = engine().interval(tangent.at_precision(bits))
        return not horner(numbers.intervals(bits), t).contains(0)


def _half_circle(derivative: BinaryForm) -> list[tuple[RealNumber | None, int, int]]:
    """Return (tan theta, multiplicity, kind) of the zeros of F for theta in [0, 180) degrees."""
    order = derivative.order
    before = _sign_after_minus_90(derivative)
    first, second = [], []
    for root in form_roots(derivative.coefficients):
        after = before * (-1) ** root.multiplicity
        kind = (before - after) // 2
        if root.value is None or root.value.sign() >= 0:
            first.append((root.value, root.multiplicity, kind))
        else:
            # theta + 180 degrees: F has degree k, so its sign there is (-1)^k times.
            second.append((root.value, root.multiplicity, kind * (-1) ** order))
        before = after
    return first + second


def _sign_after_minus_90(derivative: BinaryForm) -> int:
    """Return the sign of F(1, t) for t towards minus infinity."""
    numbers = Coefficients(derivative.coefficients)
    degree = max(j for j, a in enumerate(derivative.coefficients) if not is_zero(a))
    for bits in precisions():
        with engine().precision(bits):
            sign = engine().enclosure(numbers.intervals(bits)[degree]).sign
        if sign:
            return sign * (-1) ** degree
    raise AssertionError("unreachable")
