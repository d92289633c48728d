"""Properties that every binary form has, whatever its coefficients."""

from __future__ import annotations

import cmath
import math
from fractions import Fraction
from itertools import pairwise
from typing import Any

import mpmath
import sympy as sp
from hypothesis import assume, given
from hypothesis import strategies as st

from pdtheory.conventions import Kind
from pdtheory.exact import (
    BinaryForm,
    EigenPairs,
    RealAlgebraic,
    SymmetricTensor,
    WavejetsRow,
    characteristic_polynomial,
    complex_eigenpairs,
    count_maxima,
    realize_maxima,
)
from pdtheory.exact.strata import order3_discriminant, order4_discriminant
from pdtheory.testing.profiles import examples
from pdtheory.testing.strategies import any_forms, forms, forms_with_repeated_roots

X, Y = sp.symbols("x y", real=True)

#: Digits of the numerical checks; the pairs are enclosed to as many.
DIGITS = 40


def circle_points() -> st.SearchStrategy[tuple[Any, Any]]:
    """Draw a rational point of the unit circle."""
    half = st.fractions(min_value=-5, max_value=5, max_denominator=12)

    def point(parameter: Fraction) -> tuple[Any, Any]:
        t = sp.Rational(parameter.numerator, parameter.denominator)
        return (1 - t**2) / (1 + t**2), 2 * t / (1 + t**2)

    return half.map(point)


def _lists_pairs(pairs: EigenPairs) -> bool:
    """Tell whether the form has directions, rather than all or none being one."""
    return pairs.status == "ok"


def _numbers(pairs: EigenPairs) -> list[tuple[Any, Any, Kind]]:
    """Return (angle in radians, eigenvalue, kind) with `DIGITS` digits."""
    return [
        (
            mpmath.mpf(str(pair.angle_degrees(DIGITS))) * mpmath.pi / 180,
            mpmath.mpf(str(pair.eigenvalue_float(DIGITS))),
            pair.kind,
        )
        for pair in pairs
    ]


@examples
@given(any_forms(max_order=7))
def test_theorem_as_an_identity(form: BinaryForm) -> None:
    """|v|^2 T v^(k-1) - (T v^k) v = (F / k) (-y, x), coefficient by coefficient."""
    k = form.order
    once = form.contract((X, Y), k - 1).components
    value = form(X, Y)
    turned = form.angular_derivative()(X, Y) / k
    square = X**2 + Y**2
    assert sp.expand(square * once[0] - value * X + turned * Y) == 0
    assert sp.expand(square * once[1] - value * Y - turned * X) == 0


@examples
@given(any_forms(max_order=12), circle_points())
def test_theorem_both_ways_at_rational_vectors(form: BinaryForm, v: tuple[Any, Any]) -> None:
    """F(v) = 0 exactly if T v^(k-1) = (T v^k) v."""
    value = form(*v)
    contracted = form.contract(v, form.order - 1).components
    eigenvector = all(sp.expand(t - value * c) == 0 for t, c in zip(contracted, v, strict=True))
    assert eigenvector == (form.angular_derivative()(*v) == 0)


@examples
@given(any_forms(max_order=10))
def test_pairs_are_eigenpairs(form: BinaryForm) -> None:
    """Every listed pair satisfies T v^(k-1) = lambda v to 30 digits of its size."""
    k = form.order
    with mpmath.workdps(DIGITS):
        scale = max(mpmath.mpf(str(sp.N(abs(a), 20))) for a in form.coefficients) + 1
        tensor = [mpmath.mpf(str(sp.N(a, DIGITS + 10))) for a in form.tensor.components]
        for angle, value, _ in _numbers(form.eigenpairs()):
            v = mpmath.cos(angle), mpmath.sin(angle)
            t = tensor
            for _ in range(k - 1):
                t = [v[0] * a + v[1] * b for a, b in pairwise(t)]
            for component, coordinate in zip(t, v, strict=True):
                assert abs(component - value * coordinate) < mpmath.mpf(10) ** -30 * scale * 2**k


@examples
@given(any_forms(max_order=10))
def test_eigenvalue_link(form: BinaryForm) -> None:
    """g(theta_e) = lambda / k! with g from the Wavejets row."""
    row, k = form.row, form.order
    with mpmath.workdps(DIGITS):
        scale = max(mpmath.mpf(str(sp.N(abs(a), 20))) for a in form.coefficients) + 1
        phi = {
            n: mpmath.mpc(str(sp.N(sp.re(c), DIGITS)), str(sp.N(sp.im(c), DIGITS)))
            for n, c in row.phi.items()
        }
        for angle, value, _ in _numbers(form.eigenpairs()):
            g = sum((2 if n else 1) * mpmath.re(c * mpmath.expj(n * angle)) for n, c in phi.items())
            error = abs(mpmath.factorial(k) * g - value)
            assert error < mpmath.mpf(10) ** -30 * scale * 2**k


@examples
@given(any_forms())
def test_parity(form: BinaryForm) -> None:
    """Opposite vectors: the same kind and value for even order, the other ones for odd order."""
    pairs = form.eigenpairs()
    half = len(pairs) // 2
    assert len(pairs) == 2 * half
    sign = (-1) ** form.order
    for pair, opposite in zip(pairs.pairs[:half], pairs.pairs[half:], strict=True):
        turned = opposite.angle_degrees(30) - pair.angle_degrees(30)
        assert abs(turned - 180) < sp.Float("1e-25")
        assert opposite.kind == Kind(sign * pair.kind)
        difference = opposite.eigenvalue_float(30) - sign * pair.eigenvalue_float(30)
        assert abs(difference) <= sp.Float("1e-25") * (1 + abs(pair.eigenvalue_float(30)))


@examples
@given(any_forms())
def test_counts(form: BinaryForm) -> None:
    """#max = #min <= k with the parity of k, at most 2k in all; none listed if g is constant."""
    pairs = form.eigenpairs()
    if not _lists_pairs(pairs):
        assert form.angular_derivative().is_zero
        assert len(pairs) == 0
        return
    assert len(pairs) <= 2 * form.order
    assert len(pairs.maxima) == len(pairs.minima) <= form.order
    assert (len(pairs.maxima) - form.order) % 2 == 0


@examples
@given(any_forms())
def test_sturm_hurwitz(form: BinaryForm) -> None:
    """The number of maxima lies between the least and the largest frequency that is present."""
    pairs = form.eigenpairs()
    assume(_lists_pairs(pairs))
    support = form.row.support
    assert support[0] <= len(pairs.maxima) <= support[-1]


@examples
@given(any_forms())
def test_sturm_counts(form: BinaryForm) -> None:
    """Counting by Sturm sequences finds as many maxima as isolating the roots does."""
    pairs = form.eigenpairs()
    assume(_lists_pairs(pairs))
    assert count_maxima(form) == len(pairs.maxima)


@examples
@given(st.one_of(forms(min_order=3, max_order=4), forms(min_order=3, max_order=4, extreme=True)))
def test_discriminants(form: BinaryForm) -> None:
    """Order 3 has three maxima exactly if D3 < 0, order 4 has four exactly if D4 < 0."""
    pairs = form.eigenpairs()
    assume(_lists_pairs(pairs))
    discriminant = {3: order3_discriminant, 4: order4_discriminant}[form.order]
    assert (len(pairs.maxima) == form.order) == bool(discriminant(form) < 0)


@examples
@given(forms(min_order=2, max_order=5))
def test_eigenvalues_are_characteristic_roots(form: BinaryForm) -> None:
    """Every real E-eigenvalue is a root of psi, exactly; n_max classes are complex E-eigenpairs."""
    pairs = form.eigenpairs()
    assume(_lists_pairs(pairs))
    psi = characteristic_polynomial(form).polynomial
    for pair in pairs:
        number = pair.eigenvalue_number
        assert isinstance(number, RealAlgebraic)
        minimal = sp.Poly(number.polynomial[::-1], psi.gen)
        assert sp.rem(psi, minimal, domain="QQ").is_zero
    assert complex_eigenpairs(form).count == form.row.support[-1]


@examples
@given(any_forms())
def test_interlacing(form: BinaryForm) -> None:
    """Around the circle maxima and minima alternate; for odd order maxima face minima."""
    kinds = [pair.kind for pair in form.eigenpairs() if pair.kind is not Kind.INFLECTION]
    assert all(a == -b for a, b in pairwise([*kinds, *kinds[:1]]))


def _interlaces(angles: list[int]) -> bool:
    """Tell whether angles and their opposites alternate around the circle."""
    opposites = [(a + 180) % 360 for a in angles]
    if set(angles) & set(opposites):
        return False
    marks = [a in angles for a in sorted([*angles, *opposites])]
    return all(a != b for a, b in pairwise([*marks, marks[0]]))


@examples
@given(st.integers(2, 6), st.sets(st.sampled_from(range(0, 360, 45)), min_size=1, max_size=6))
def test_realizable_maxima(order: int, chosen: set[int]) -> None:
    """Angles are the maxima of some row exactly if they interlace, or come in pairs (even)."""
    angles = sorted(chosen)
    if order % 2:
        expected = len(angles) % 2 == 1 and _interlaces(angles)
    else:
        expected = all((a + 180) % 360 in chosen for a in angles)
    expected = expected and len(angles) <= order
    found = realize_maxima(order, angles)
    assert found.is_realizable == expected
    if found.row is None:
        return
    assert count_maxima(found.row) == len(angles)
    phi = found.row.to_complex()
    for angle in map(math.radians, angles):
        first = sum((1j * n * c * cmath.exp(1j * n * angle)).real for n, c in phi.items())
        second = sum((-n * n * c * cmath.exp(1j * n * angle)).real for n, c in phi.items())
        assert abs(first) < 1e-12 * max(map(abs, phi.values()))
        assert second < 0


@examples
@given(any_forms())
def test_kind_follows_from_the_multiplicity(form: BinaryForm) -> None:
    """Extrema are the roots of odd multiplicity, and the multiplicities add up to at most 2k."""
    pairs = form.eigenpairs()
    assert all((pair.multiplicity % 2 == 0) == (pair.kind is Kind.INFLECTION) for pair in pairs)
    assert sum(pair.multiplicity for pair in pairs) <= 2 * form.order


def _gap(a: Any, b: Any) -> Any:
    """Return the distance of two angles in degrees."""
    return abs((a - b + 180) % 360 - 180)


@examples
@given(st.one_of(forms(max_order=12), forms_with_repeated_roots(max_order=9)), circle_points())
def test_rotation(form: BinaryForm, turn: tuple[Any, Any]) -> None:
    """Turning the frame by a multiplies phi_n by exp(i n a) and shifts angles by -a."""
    cosine, sine = turn
    turned = form.turn_frame(cosine=cosine, sine=sine)
    before, after = form.row, turned.row
    for n, phi in before.phi.items():
        assert sp.expand(after[n] - phi * sp.expand((cosine + sp.I * sine) ** n)) == 0
    old, new = form.eigenpairs(), turned.eigenpairs()
    assert old.status == new.status
    assert len(old) == len(new)
    shift = sp.N(sp.atan2(sine, cosine), 40) * 180 / sp.pi.evalf(40)
    found = [(pair.angle_degrees(30), pair) for pair in new]
    for pair in old:
        angle = pair.angle_degrees(30) - shift
        where, same = min(found, key=lambda other: _gap(other[0], angle))
        assert _gap(where, angle) < sp.Float("1e-25")
        assert (same.kind, same.multiplicity) == (pair.kind, pair.multiplicity)


@examples
@given(any_forms(max_order=7))
def test_lemma(form: BinaryForm) -> None:
    """The gradient of T v^k is k T v^(k-1)."""
    k = form.order
    contracted = form.contract((X, Y), k - 1).components
    for part, component in zip(form.gradient(), contracted, strict=True):
        assert sp.expand(part(X, Y) - k * component) == 0


@examples
@given(any_forms(max_order=16))
def test_conversions(form: BinaryForm) -> None:
    """Form, tensor and row are three faces of one object: every way round comes back."""
    assert BinaryForm.of(form.tensor) == form
    assert BinaryForm.of(form.row) == form
    assert WavejetsRow.of(SymmetricTensor.of(form.row)) == form.row
    row = form.row
    assert all(row[-n] == sp.conjugate(row[n]) for n in row.phi)
    if form.order <= 8:
        assert SymmetricTensor.from_array(form.tensor.to_array()) == form.tensor


@examples
@given(
    st.integers(1, 12).flatmap(lambda k: st.tuples(*[forms(min_order=k, max_order=k)] * 2)),
    st.fractions(-9, 9, max_denominator=9),
)
def test_linearity(pair: tuple[BinaryForm, BinaryForm], factor: Fraction) -> None:
    """Rows and tensors of sums and multiples are sums and multiples."""
    first, second = pair
    scalar = sp.Rational(factor.numerator, factor.denominator)
    combined = first + second * scalar
    assert combined.row == first.row + second.row * scalar
    assert combined.tensor == first.tensor + second.tensor * scalar


@examples
@given(any_forms(max_order=14), st.fractions(min_value=Fraction(1, 9), max_value=9))
def test_scaling_and_turning_over(form: BinaryForm, factor: Fraction) -> None:
    """A positive factor keeps directions and kinds; a negative one swaps maxima and minima."""
    scalar = sp.Rational(factor.numerator, factor.denominator)
    pairs, scaled, over = (f.eigenpairs() for f in (form, form * scalar, form * -scalar))
    angles = [pair.angle_degrees(20) for pair in pairs]
    for other, sign in ((scaled, 1), (over, -1)):
        assert [pair.angle_degrees(20) for pair in other] == angles
        assert [pair.kind for pair in other] == [Kind(sign * pair.kind) for pair in pairs]
