"""Degree and radius chosen at each point: close to the best fixed one at every noise level."""

from __future__ import annotations

import numpy as np
import pytest

from pdtheory.conventions import Status
from pdtheory.errors import InputError
from pdtheory.pointset import estimate_directions, selection
from tests.pointset.surfaces import torus

COUNT, QUERIES, RADIUS = 20_000, 300, 0.25
#: Noise as a fraction of the diagonal.
SWEEP = (0.0, 1e-5, 1e-4, 1e-3, 1e-2)


def operator(gradients, hessians):
    """The curvature tensor of an implicit surface as a 3x3 matrix."""
    size = np.linalg.norm(gradients, axis=1)
    normals = gradients / size[:, None]
    plane = np.eye(3) - normals[:, :, None] * normals[:, None, :]
    return -plane @ hessians @ plane / size[:, None, None]


def ellipsoid(count):
    """Points, outward normals, curvature tensors."""
    axes = np.array([1.0, 0.8, 0.6])
    unit = np.random.default_rng(1).normal(size=(count, 3))
    points = unit / np.linalg.norm(unit, axis=1, keepdims=True) * axes
    gradients = 2 * points / axes**2
    return points, gradients, operator(gradients, np.diag(2 / axes**2))


def waves(count):
    """The same of z = sin(2x) cos(3y) / 5 over a square, the queries in its middle."""
    x, y = np.random.default_rng(2).uniform(-1, 1, (2, count))
    x[:QUERIES], y[:QUERIES] = 0.6 * x[:QUERIES], 0.6 * y[:QUERIES]
    sx, cx, sy, cy = np.sin(2 * x), np.cos(2 * x), np.sin(3 * y), np.cos(3 * y)
    gradients = np.column_stack([-2 * cx * cy / 5, 3 * sx * sy / 5, np.ones(count)])
    hessians = np.zeros((count, 3, 3))
    hessians[:, 0, 0], hessians[:, 1, 1] = 4 * sx * cy / 5, 9 * sx * cy / 5
    hessians[:, 0, 1] = hessians[:, 1, 0] = 6 * cx * sy / 5
    return np.column_stack([x, y, sx * cy / 5]), gradients, operator(gradients, hessians)


def ring(count):
    """The same of a torus."""
    points, normals, *directions, curvatures = torus(count, 1.0, 0.4, 3)
    tensors = sum(
        value[:, None, None] * v[:, :, None] * v[:, None, :]
        for value, v in zip(curvatures.T, directions, strict=True)
    )
    return points, normals, tensors


@pytest.fixture(scope="module")
def surface():
    return ring(COUNT)


@pytest.fixture(scope="module")
def surfaces():
    return [make(COUNT) for make in (ring, ellipsoid, waves)]


def _noisy(surface, level):
    points, normals = surface[:2]
    size = level * np.linalg.norm(np.ptp(points, axis=0))
    unit = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    return points + size * np.random.default_rng(5).normal(size=(COUNT, 1)) * unit


def _estimate(surface, level, **how):
    how = {"radius": RADIUS, "degree": 4, "orders": (2,)} | how
    return estimate_directions(
        _noisy(surface, level), queries=np.arange(QUERIES), normals=surface[1], **how
    )


def _error(surface, level, **how):
    """Median error of the curvature tensor, in which eigenvalues and directions both count."""
    rows = _estimate(surface, level, **how)[2]
    values, vectors = rows.eigenvalues.padded(), rows.vectors.padded()
    assert values.shape == (QUERIES, 4)
    tensors = np.einsum("pd,pdi,pdj->pij", values, vectors, vectors) / 2
    return np.median(np.linalg.norm(tensors - surface[2][:QUERIES], axis=(1, 2)))


def _compare(surfaces, level, fixed, chosen):
    """Error of the choice over that of the best fixed one, both medians over the surfaces."""
    best = min(np.median([_error(surface, level, **how) for surface in surfaces]) for how in fixed)
    return np.median([_error(surface, level, **chosen) for surface in surfaces]) / best


@pytest.mark.parametrize("level", SWEEP)
def test_degree_is_as_good_as_the_best_fixed_one(surfaces, level):
    fixed = [{"degree": degree} for degree in (2, 4, 6, 8, 10)]
    assert _compare(surfaces, level, fixed, {"degree": "auto"}) <= 1.3


@pytest.mark.parametrize("level", SWEEP)
def test_radius_is_as_good_as_the_best_fixed_one(surfaces, level):
    radii = (0.125, 0.25, 0.4)
    fixed = [{"radius": radius} for radius in radii]
    assert _compare(surfaces, level, fixed, {"radius": radii}) <= 1.3


def test_answers_are_those_of_the_candidates_bit_for_bit(surface):
    auto = _estimate(surface, 1e-4, degree="auto", radius=(0.2, 0.25), orders=(2, 3))
    assert len(np.unique(auto.degree)) > 1
    assert set(np.unique(auto.radius)) == {0.2, 0.25}
    seen = 0
    for degree in np.unique(auto.degree):
        for radius in (0.2, 0.25):
            fixed = _estimate(surface, 1e-4, degree=int(degree), radius=radius, orders=(2, 3))
            here = np.flatnonzero((auto.degree == degree) & (auto.radius == radius))
            seen += len(here)
            one, two = auto.take(here), fixed.take(here)
            columns = fixed.phi.shape[1]
            np.testing.assert_array_equal(one.phi[:, :columns], two.phi)
            assert (one.phi[:, columns:] == 0).all()
            for name in ("frames", "residual_rms", "condition", "status", "neighbours"):
                np.testing.assert_array_equal(getattr(one, name), getattr(two, name))
            for order in (2, 3):
                np.testing.assert_array_equal(one[order].offsets, two[order].offsets)
                for name in ("vector", "eigenvalue", "kind", "angle_std", "eigenvalue_std"):
                    np.testing.assert_array_equal(
                        getattr(one[order], name), getattr(two[order], name)
                    )
    assert seen == QUERIES


def test_choice_depends_on_no_thread_and_no_chunk(surface):
    whole = _estimate(surface, 1e-4, degree="auto", threads=2)
    points = _noisy(surface, 1e-4)
    some = estimate_directions(
        points, radius=RADIUS, degree="auto", orders=(2,), normals=surface[1],
        queries=np.arange(40, 90), threads=1,
    )  # fmt: skip
    np.testing.assert_array_equal(some.degree, whole.degree[40:90])
    np.testing.assert_array_equal(some.phi, whole.phi[40:90])


def test_choice_does_not_depend_on_the_unit(surface):
    points = _noisy(surface, 1e-3)
    how = {"degree": "auto", "orders": (2, 3), "normals": surface[1], "queries": np.arange(100)}
    one = estimate_directions(points, radius=(0.2, 0.3), **how)
    for unit in (2.0**-40, 2.0**50):
        other = estimate_directions(unit * points, radius=(0.2 * unit, 0.3 * unit), **how)
        np.testing.assert_array_equal(other.degree, one.degree)
        np.testing.assert_array_equal(other.radius, unit * one.radius)


def test_flat_points_take_the_lowest_degree():
    x, y = np.random.default_rng(0).uniform(-1, 1, (2, 2000))
    field = estimate_directions(
        np.column_stack([x, y, 0 * x]), radius=0.3, degree="auto", orders=(2,), orient="none"
    )
    assert (field.degree == 2).all()
    assert field[2].isotropic.all()


def test_few_neighbours_leave_the_degree_that_they_bear(surface):
    field = estimate_directions(
        surface[0], radius=0.045, degree="auto", orders=(2, 3), normals=surface[1],
        queries=np.arange(QUERIES),
    )  # fmt: skip
    assert np.median(field.neighbours) < 20
    bearing = field.degree >= 3
    assert not (field.status[bearing] & Status.DEGREE_LOWERED).any()
    assert (field.status[field.answered & ~bearing] & Status.DEGREE_LOWERED).all()


def test_automatic_radii_hold_multiples_of_the_coefficients(surface):
    field = _estimate(surface, 1e-3, radius="auto", degree=4)
    assert len(np.unique(field.radius)) > 1
    widest = field.neighbours[field.radius == field.radius.max()]
    assert 500 < np.median(widest) < 700  # 22 times 3, 3 and 3


@pytest.mark.parametrize(
    ("orders", "degrees"),
    [
        ((2,), [2, 4, 6, 8, 10]),
        ((2, 3), [3, 5, 7, 9, 10]),
        ((1,), [2, 4, 6, 8, 10]),
        ((10,), [10, 12]),
        ((13,), [13, 14]),
        ((14,), [14]),
    ],
)
def test_candidate_degrees(orders, degrees):
    assert selection.candidate_degrees(orders, 14) == degrees


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"radius": 0.3, "degree": "best"}, "degree must be a number or 'auto'"),
        ({"radius": "best"}, "radius must be a number or 'auto'"),
        ({"radius": ()}, "no radius"),
        ({"radius": (0.1, -0.2)}, "positive"),
        ({"radius": "auto", "neighbours": 40}, "exactly one of radius"),
        ({"radius": (1e-6, 2e-6), "degree": "auto"}, "radius of"),
        ({"radius": 0.3, "degree": "auto", "orders": (15,)}, "order 15"),
    ],
)
def test_unusable_choices_are_refused(surface, options, words):
    with pytest.raises(InputError, match=words):
        estimate_directions(surface[0], **options)
