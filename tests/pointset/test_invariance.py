"""Motions, scalings, permutations and duplicates change nothing but rounding."""

from __future__ import annotations

import numpy as np
import pytest

from pdtheory.conventions import Status
from pdtheory.pointset import estimate_directions
from tests.pointset.surfaces import rotation, torus

ORDERS = (2, 3, 4)
RADIUS = 0.35


@pytest.fixture(scope="module")
def reference():
    points = torus(6000, 1.0, 0.4, 11)[0]
    queries = np.arange(0, 6000, 60)
    return points, queries, _run(points, queries, RADIUS)


def _run(points, queries, radius, **options):
    return estimate_directions(
        points, radius=radius, degree=6, orders=ORDERS, queries=queries, **options
    )


def _same(field, expected, turn=None, scale=1.0, tolerance=1e-9):
    """The same directions up to rounding, whatever the frames.

    The directions of a fold, where a maximum and a minimum are about to vanish, move with the
    square root of the rounding, hence the comparison of the coefficients' moduli too.
    """
    turn = np.eye(3) if turn is None else turn
    np.testing.assert_allclose(field.frames[:, 2], expected.frames[:, 2] @ turn.T, atol=tolerance)
    size = (scale * RADIUS) ** field.phi_order.astype(float)
    before = np.abs(expected.phi) * RADIUS ** expected.phi_order.astype(float)
    after = np.abs(field.phi) * size
    np.testing.assert_allclose(after / scale, before, atol=tolerance)
    np.testing.assert_array_equal(field.neighbours, expected.neighbours)
    np.testing.assert_array_equal(field.status, expected.status)
    for order in ORDERS:
        a, b = field[order], expected[order]
        for i in range(len(field)):
            rows, wanted = a.vectors[i], b.vectors[i] @ turn.T
            sharp = b.angle_std[b.rows_of(i)] < 0.1
            if len(rows) != len(wanted):
                assert not sharp.all()
                continue
            for vector in wanted[sharp]:
                assert np.linalg.norm(rows - vector, axis=1).min() < 1e-6


def test_rigid_motion(reference):
    points, queries, expected = reference
    turn = rotation(4)
    _same(_run(points @ turn.T + np.array([3.0, -2.0, 5.0]), queries, RADIUS), expected, turn)


@pytest.mark.parametrize("scale", [1e-9, 7.3, 1e9])
def test_scaling(reference, scale):
    points, queries, expected = reference
    field = _run(scale * points, queries, scale * RADIUS)
    _same(field, expected, scale=scale)
    two = field[2]
    np.testing.assert_allclose(two.eigenvalue * scale, expected[2].eigenvalue, atol=1e-8)
    np.testing.assert_allclose(two.strength, expected[2].strength, atol=1e-9)


def test_permutation(reference):
    points, queries, expected = reference
    shuffle = np.random.default_rng(1).permutation(len(points))
    where = np.argsort(shuffle)[queries]
    _same(_run(points[shuffle], where, RADIUS), expected)


def test_duplicates(reference):
    points, queries, expected = reference
    field = _run(np.concatenate([points, points]), queries, RADIUS)
    np.testing.assert_array_equal(field.neighbours, 2 * expected.neighbours)
    np.testing.assert_allclose(np.abs(field.phi), np.abs(expected.phi), atol=1e-7)
    np.testing.assert_array_equal(field[2].offsets, expected[2].offsets)


def test_survey_coordinates():
    """Millions of metres from the origin, with detail of a centimetre."""
    place = np.array([4.4e6, 5.3e6, 3.0e6])
    far = torus(20_000, 0.05, 0.02, 3)[0] + place
    rounded = far - place
    queries = np.arange(0, 20_000, 200)
    field = estimate_directions(
        far, radius=0.008, degree=4, orders=(2,), queries=queries, normals=rounded * [1, 1, 0]
    )
    assert not np.any(field.status & Status.ILL_CONDITIONED)
    near = estimate_directions(
        rounded, radius=0.008, degree=4, orders=(2,), queries=queries, normals=rounded * [1, 1, 0]
    )
    np.testing.assert_allclose(far[queries], field.points)
    np.testing.assert_allclose(field[2].eigenvalue, near[2].eigenvalue, atol=1e-3)


@pytest.mark.parametrize("kind", [np.float32, np.int64])
def test_array_types(reference, kind):
    points, queries, _ = reference
    grid = np.round(1e5 * points).astype(kind)
    field = _run(grid, queries, 1e5 * RADIUS)
    same = _run(grid.astype(float), queries, 1e5 * RADIUS)
    np.testing.assert_array_equal(field.phi, same.phi)
