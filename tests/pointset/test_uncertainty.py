"""The error bars hold: as many true values lie within them as a normal law says."""

from __future__ import annotations

import numpy as np
import pytest

from pdtheory.conventions import Status, frequencies
from pdtheory.pointset import estimate_directions
from tests.pointset.surfaces import disc, evaluate, wavejets

COEFFICIENTS = {
    (2, 0): 0.4, (0, 2): -0.15, (1, 1): 0.1, (3, 0): 0.3, (1, 2): -0.4, (0, 3): 0.1, (2, 1): 0.05,
}  # fmt: skip
REPETITIONS = 1000


def _repetitions(count, noise, seed):
    """Noisy copies of one patch, far apart from each other, and their origins."""
    rng = np.random.default_rng(seed)
    clouds = []
    for i in range(REPETITIONS):
        xy = disc(count, 1.0, rng.integers(2**31), inner=False)
        z = evaluate(COEFFICIENTS, xy[:, 0], xy[:, 1]) + noise * rng.normal(size=count)
        clouds.append(np.column_stack([xy[:, 0] + 10.0 * i, xy[:, 1], z]))
    origins = np.zeros((REPETITIONS, 3))
    origins[:, 0] = 10.0 * np.arange(REPETITIONS)
    return np.concatenate(clouds), origins


def _true_maxima(order):
    """Angles and eigenvalues of the maxima, from a fine table of g_k."""
    phi = wavejets(COEFFICIENTS, 3)
    theta = np.linspace(0, 2 * np.pi, 400_001)[:-1]
    g = sum(
        (1 if n == 0 else 2) * np.real(phi[order, n] * np.exp(1j * n * theta))
        for n in frequencies(order)
    )
    top = (g > np.roll(g, 1)) & (g >= np.roll(g, -1))
    return theta[top], g[top] * (2 if order == 2 else 6)


def _coverage(field, order):
    """Fractions of true angles and eigenvalues within one and two standard deviations."""
    rows = field[order].maxima
    inside = []
    for angle, eigenvalue in zip(*_true_maxima(order), strict=True):
        for i in range(len(field)):
            found = rows.rows_of(i)
            off = np.abs((rows.angle[found] - angle + np.pi) % (2 * np.pi) - np.pi)
            nearest = found.start + int(np.argmin(off))
            ratios = (
                off.min() / rows.angle_std[nearest],
                abs(rows.eigenvalue[nearest] - eigenvalue) / rows.eigenvalue_std[nearest],
            )
            inside.append([ratio <= width for ratio in ratios for width in (1, 2)])
    return np.mean(inside, axis=0)


@pytest.mark.parametrize(
    ("degree", "count", "noise"), [(4, 100, 1e-4), (4, 60, 1e-2), (6, 150, 1e-3), (8, 200, 1e-4)]
)
def test_l2(degree, count, noise):
    points, origins = _repetitions(count, noise, degree)
    field = estimate_directions(
        points,
        radius=1.0,
        degree=degree,
        orders=(2, 3),
        queries=origins,
        normals=np.tile([0.0, 0.0, 1.0], (len(points), 1)),
    )
    assert np.mean(field.status & ~int(Status.REFINED) == 0) > 0.9
    for order in (2, 3):
        one_angle, two_angle, one_value, two_value = _coverage(field, order)
        assert abs(one_angle - 0.683) < 0.05
        assert abs(two_angle - 0.954) < 0.05
        assert abs(one_value - 0.683) < 0.05
        assert abs(two_value - 0.954) < 0.05


def test_l1_errs_on_the_safe_side():
    points, origins = _repetitions(100, 1e-4, 3)
    field = estimate_directions(
        points,
        radius=1.0,
        degree=4,
        orders=(2, 3),
        queries=origins,
        normals=np.tile([0.0, 0.0, 1.0], (len(points), 1)),
        norm="l1",
    )
    for order in (2, 3):
        one_angle, two_angle, one_value, two_value = _coverage(field, order)
        assert 0.65 < one_angle < 0.85
        assert 0.65 < one_value < 0.85
        assert min(two_angle, two_value) > 0.93


def test_uncertainty_can_be_left_out():
    points, origins = _repetitions(60, 1e-3, 1)
    how = {"radius": 1.0, "degree": 4, "queries": origins[:50]}
    with_bars = estimate_directions(points, **how)
    without = estimate_directions(points, uncertainty=False, **how)
    assert np.isnan(without[2].angle_std).all()
    np.testing.assert_array_equal(without[2].angle, with_bars[2].angle)


def test_l1_withstands_outliers():
    rng = np.random.default_rng(2)
    xy = disc(600, 1.0, 2)
    z = evaluate(COEFFICIENTS, xy[:, 0], xy[:, 1])
    exact = np.column_stack([xy, z])
    broken = exact.copy()
    outliers = rng.permutation(np.arange(1, 600))[:60]
    broken[outliers, 2] += rng.choice([-0.1, 0.1], 60)
    normals = np.tile([0.0, 0.0, 1.0], (600, 1))
    errors = {}
    for norm in ("l1", "l2"):
        field = estimate_directions(
            broken, radius=1.0, degree=4, orders=(2,), queries=[0], normals=normals, norm=norm
        )
        errors[norm] = abs(abs(field.coefficient(2, 0)[0]) - 0.125)
    assert errors["l1"] < 1e-4
    assert errors["l2"] > 1e-3
