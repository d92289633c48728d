"""The inverse problem: what is built is found again, and what is refused cannot be."""

import itertools

import mpmath
import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from pdtheory.conventions import Kind
from pdtheory.errors import ComputationError, InputError
from pdtheory.exact import WavejetsRow, real_eigenpairs
from pdtheory.exact.inverse import realize_maxima, rows_with_critical_lines
from pdtheory.exact.rosy import rosy_kinds
from pdtheory.testing.profiles import examples


def numeric_maxima(row, count=7200):
    """Angles of the maxima of g by sampling g itself: no part of the exact machinery."""
    grid = np.arange(count) * 360 / count
    phi = row.to_complex()
    g = sum(
        (1 if n == 0 else 2) * (p * np.exp(1j * n * np.deg2rad(grid))).real for n, p in phi.items()
    )
    return grid[(g > np.roll(g, 1)) & (g >= np.roll(g, -1))]


def numeric_phi(row):
    """The coefficients by mpmath."""
    return {n: mpmath.mpc(*(sp.N(p, 60) for p in parts)) for n, parts in row.parts.items()}


def derivative(phi, degrees, times):
    """A derivative of g along the circle by mpmath, from the coefficients alone."""
    a = mpmath.radians(mpmath.mpf(sp.N(degrees, 60)))
    return 2 * mpmath.re(
        mpmath.fsum((1j * n) ** times * p * mpmath.expj(n * a) for n, p in phi.items())
    )


def assert_maxima(row, angles):
    found = numeric_maxima(row)
    expected = sorted(float(a) % 360 for a in angles)
    assert len(found) == len(expected)
    gaps = np.abs(np.sort(found)[:, None] - np.array(expected)[None, :])
    assert np.minimum(gaps, 360 - gaps).min(axis=0).max() <= 0.051


@pytest.mark.parametrize(
    ("order", "angles"),
    [
        (3, [0, 120, 240]),
        (3, [0, 110, 250]),
        (3, [10, 100, 250]),
        (3, [77]),
        (1, [30]),
        (5, [0, 110, 250]),
        (5, [0, 72, 144, 216, 288]),
        (5, [0, 50, 130, 200, 290]),
        (2, [20, 200]),
        (4, [0, 180]),
        (4, [0, 90, 180, 270]),
        (4, [0, 30, 180, 210]),
        (6, [0, 30, 75, 180, 210, 255]),
        (9, [0, 41, 79, 121, 161, 199, 241, 281, 319]),
        (8, [15, 30, 195, 210]),
    ],
)
def test_realized_maxima_are_found_again(order, angles):
    result = realize_maxima(order, angles)
    assert result.is_realizable, result.reason
    assert_maxima(result.row, angles)


@pytest.mark.parametrize(
    ("order", "lines"),
    [
        (6, [0, 10, 70]),
        (8, [5, 17, 60, 100]),
        (9, [0, 41, 79, 121, 161, 199, 241, 281, 319]),
        (10, [1, 22, 63, 97, 150]),
        (10, [sp.sqrt(2), sp.Rational(45, 2), sp.pi + 60, 100]),
        (16, [1, 22, 45, 63, 97, 120, 150, 170]),
    ],
)
def test_long_rows_have_the_maxima_to_50_digits(order, lines):
    """Their derivative is evaluated by mpmath, and its zeros are counted by its signs."""
    angles = lines if order % 2 else [*lines, *(a + 180 for a in lines)]
    row = realize_maxima(order, angles).row
    # Multiplied out without merging, these rows have more terms by orders of magnitude.
    lengths = [len(sp.Add.make_args(part)) for parts in row.parts.values() for part in parts]
    assert max(lengths) <= min(3 ** len(lines), 360)
    with mpmath.workdps(60):
        phi = numeric_phi(row)
        size = max(abs(p) for p in phi.values())
        for angle in angles:
            assert abs(derivative(phi, angle, 1)) < size * mpmath.mpf(10) ** -50
            assert derivative(phi, angle, 2) < 0
    grid = 2 * np.pi * (np.arange(20000) + 0.5) / 20000
    slope = sum((2j * n * complex(p) * np.exp(1j * n * grid)).real for n, p in phi.items())
    assert np.count_nonzero((slope > 0) & (np.roll(slope, -1) < 0)) == len(angles)
    found = [p.angle_degrees(40) for p in row.eigenpairs().maxima]
    assert len(found) == len(angles)
    for value, angle in zip(found, sorted(angles), strict=True):
        assert abs(value - sp.N(angle, 50)) < 1e-36


@examples
@given(st.sets(st.integers(0, 23), min_size=3, max_size=3))
def test_triples_of_order_three_are_maxima_iff_all_gaps_are_below_180(steps):
    angles = sorted(15 * s for s in steps)
    gaps = [(b - a) % 360 for a, b in zip(angles, angles[1:] + angles[:1], strict=True)]
    result = realize_maxima(3, angles)
    assert result.is_realizable == all(gap < 180 for gap in gaps)
    if result.is_realizable:
        pairs = real_eigenpairs(result.row)
        assert [p.angle_degrees(15) for p in pairs.maxima] == pytest.approx(angles)


def test_three_lines_fix_order_three_by_the_closed_formula():
    angles = [0, 110, 250]
    row = realize_maxima(3, angles).row
    t = [sp.pi * a / 180 for a in angles]
    phase = sp.exp(-sp.I * sum(t))
    p3 = phase / 24
    p1 = -phase / 8 * sum(sp.exp(2 * sp.I * a) for a in t)
    assert abs(sp.N(row[1] / row[3] - p1 / p3, 30)) < 1e-20
    assert abs(sp.im(sp.N(row[3] / p3, 30))) < 1e-20


@pytest.mark.parametrize(
    ("order", "angles", "reason"),
    [
        (3, [0, 90, 180], "opposite"),
        (3, [0, 90], "odd, not 2"),
        (3, [0, 10, 20], "between"),
        (3, [0, 70, 140, 210, 280], "at most 3"),
        (5, [0, 10, 20, 120, 240], "between"),
        (4, [0, 90], "without its opposite"),
        (4, [0, 20, 40, 180, 200, 220], "at most 4"),
    ],
)
def test_refused_with_the_reason(order, angles, reason):
    result = realize_maxima(order, angles)
    assert not result.is_realizable
    assert reason in result.reason


@pytest.mark.parametrize(("order", "angles"), [(3, [0, 10, 20]), (5, [0, 10, 20, 120, 240])])
def test_refused_sets_have_no_row(order, angles):
    """Every row with these lines, over a net of the family, has another set of maxima."""
    basis = rows_with_critical_lines(order, angles)
    rng = np.random.default_rng(0)
    for weights in itertools.chain([np.ones(len(basis))], rng.normal(size=(20, len(basis)))):
        for sign in (1, -1):
            phi = {n: sum(sign * w * complex(row[n]) for w, row in zip(weights, basis, strict=True))
                   for n in basis[0].parts}  # fmt: skip
            found = numeric_maxima(WavejetsRow(order, phi), 3600)
            expected = np.array(sorted(angles))
            assert len(found) != len(expected) or np.abs(np.sort(found) - expected).max() > 0.2


@pytest.mark.parametrize(
    ("order", "angles", "dimension"),
    [
        (3, [0, 45, 90], 1),
        (3, [0, 45, 90, 180, 225], 1),
        (3, [0, 30, 60, 120], 0),
        (3, [0], 3),
        (4, [0, 45], 3),
        (4, [0, 45, 90], 2),
        (5, [0, 60, 120], 3),
        (6, [0, 60, 120], 4),
        (7, [3, 20, 77, 101], 4),
        (8, [5, 17, 60, 100], 5),
    ],
)
def test_family_of_given_critical_lines(order, angles, dimension):
    rows = rows_with_critical_lines(order, angles)
    assert len(rows) == dimension
    with mpmath.workdps(60):
        for row in rows:
            phi = numeric_phi(row)
            size = max(abs(p) for p in phi.values())
            for angle in angles:
                assert abs(derivative(phi, angle, 1)) < size * mpmath.mpf(10) ** -50
    table = [[f(complex(p)) for p in numeric_phi(row).values() for f in (np.real, np.imag)]
             for row in rows]  # fmt: skip
    assert not rows or np.linalg.matrix_rank(np.array(table)) == dimension


BOTH = {Kind.MAXIMUM, Kind.MINIMUM}


@pytest.mark.parametrize(
    ("order", "phi", "kinds"),
    [
        (3, {3: 1 + 2 * sp.I}, BOTH),
        (3, {1: 1, 3: 1}, set()),
        (5, {3: 1}, set()),
        (4, {0: 7, 4: sp.I}, BOTH),
        (4, {2: 1, 4: 1}, {Kind.MAXIMUM}),
        (4, {2: 1, 4: -1}, {Kind.MINIMUM}),
        (4, {2: sp.I, 4: 1}, {Kind.MINIMUM}),
        (4, {2: 4, 4: 1}, set()),
        (4, {2: 1 + sp.I, 4: 1}, set()),
        (4, {2: 1}, set()),
        (2, {0: 3, 2: sp.I}, BOTH),
        (2, {0: 3}, set()),
        (6, {2: 2, 4: 1, 6: 1}, {Kind.MAXIMUM}),
        (6, {2: 1, 4: 1, 6: 1}, set()),
        (8, {8: 3}, BOTH),
    ],
)
def test_rosy_by_the_corrected_theorem(order, phi, kinds):
    row = WavejetsRow(order, phi)
    assert rosy_kinds(row) == kinds
    # Independently, from the exact directions.
    pairs = real_eigenpairs(row)
    for kind in BOTH:
        angles = [float(p.angle_degrees()) for p in pairs.of_kind(kind)]
        gaps = np.diff([*angles, angles[0] + 360]) if angles else np.array([])
        even = len(angles) == order and np.allclose(gaps, 360 / order)
        assert even == (kind in kinds)


def test_rosy_turned():
    row = WavejetsRow(4, {2: 1, 4: 1}).turn_frame(cosine=sp.Rational(3, 5), sine=sp.Rational(4, 5))
    assert rosy_kinds(row) == {Kind.MAXIMUM}


def test_rows_from_angles():
    row = WavejetsRow.from_maxima(3, [0, 110, 250])
    assert_maxima(row, [0, 110, 250])
    with pytest.raises(InputError, match="0, 90, 180 degrees: 0 and 180"):
        WavejetsRow.from_maxima(3, [0, 90, 180])


def test_bad_input():
    with pytest.raises(InputError, match="No angle"):
        realize_maxima(3, [])
    with pytest.raises(InputError, match="order is 0"):
        realize_maxima(0, [1])
    with pytest.raises(InputError, match="not a real"):
        realize_maxima(3, [sp.I])
    with pytest.raises(InputError, match="order is 1"):
        rosy_kinds(WavejetsRow(1, {1: 1}))


def test_maxima_nearer_than_any_fixed_precision():
    gap = sp.Rational(1, 10**200)
    angles = [0, gap, 180, 180 + gap]
    found = realize_maxima(4, angles)
    assert found.row is not None
    second = found.row.form.angular_derivative().angular_derivative()
    with mpmath.workdps(700):
        for angle in found.angles:
            a = mpmath.radians(mpmath.mpf(int(angle.p)) / int(angle.q))
            c, s = mpmath.cos(a), mpmath.sin(a)
            value = sum(
                mpmath.mpmathify(sp.N(b, 700, maxn=4000)) * c ** (4 - j) * s**j
                for j, b in enumerate(second.coefficients)
            )
            assert value < 0


def test_angles_are_sorted_by_proof():
    near = sp.Rational(str(sp.N(sp.sqrt(2), 150))) - sp.Rational(1, 10**140)
    assert realize_maxima(1, [sp.sqrt(2), near]).angles == (near, sp.sqrt(2))
    with pytest.raises(ComputationError, match="could not be proved"):
        realize_maxima(
            1, [4 * sp.atan(sp.Rational(1, 5)), sp.atan(sp.Rational(1, 239)) + sp.pi / 4]
        )


def test_equal_angles_in_different_forms():
    # Both are 10 (sqrt(2) + sqrt(3)), and no simplification is asked for.
    a = 10 * sp.sqrt(5 + 2 * sp.sqrt(6))
    b = 10 * (sp.sqrt(2) + sp.sqrt(3))
    assert a != b
    assert realize_maxima(4, [a, b + 180]).is_realizable
    assert realize_maxima(3, [a, b]).angles == (a,)
    assert realize_maxima(3, [a, b]).row == realize_maxima(3, [a]).row
    assert "opposite" in realize_maxima(3, [a, 100, b + 180]).reason
    assert "without its opposite" in realize_maxima(4, [a, b]).reason
    assert len(rows_with_critical_lines(3, [a, b, b + 180])) == 3
    # A difference that is a whole turn, though no rounding tells on which side.
    assert realize_maxima(1, [a - b + 360, b - a]).angles == (0,)


@pytest.mark.parametrize("angle", [-10, 370, sp.pi - 1000, 10**40 * sp.sqrt(2), -720])
def test_angles_are_taken_into_one_turn(angle):
    (found,) = realize_maxima(1, [angle]).angles
    with mpmath.workdps(80):
        expected = mpmath.fmod(mpmath.mpf(sp.N(angle, 80)), 360)
        assert abs(mpmath.mpf(sp.N(found, 60)) - expected % 360) < mpmath.mpf(10) ** -30
