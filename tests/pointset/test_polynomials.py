"""A polynomial surface of degree <= K is recovered to rounding."""

from __future__ import annotations

import numpy as np
import pytest

from pdtheory.conventions import Status
from pdtheory.pointset import estimate_directions
from tests.pointset.surfaces import disc, evaluate, polynomial, rotation, wavejets


def _relative_errors(field, coefficients, degree, radius, t1):
    """Largest error of phi_{k,n} R^k of each order, relative to the largest of all."""
    exact = wavejets(coefficients, degree)
    scale = max(abs(value) * radius**k for (k, n), value in exact.items())
    turn = np.arctan2(t1[1], t1[0])
    errors = {}
    for (k, n), value in exact.items():
        found = field.coefficient(k, n)[0]
        errors[k, n] = abs(found - value * np.exp(1j * n * turn)) * radius**k / scale
    return errors


@pytest.mark.parametrize("degree", [2, 3, 4, 6, 8, 10])
@pytest.mark.parametrize("seed", [1, 2])
def test_every_coefficient_is_recovered(degree, seed):
    radius = 0.9
    coefficients = polynomial(degree, seed)
    xy = disc(max(400, 3 * (degree + 1) ** 2), 1.0, seed)
    points = np.column_stack([xy, evaluate(coefficients, xy[:, 0], xy[:, 1])])
    turned = points @ rotation(seed).T
    normal = rotation(seed) @ [0.0, 0.0, 1.0]
    field = estimate_directions(
        turned,
        radius=radius,
        degree=degree,
        orders=(2,),
        queries=[0],
        normals=np.tile(normal, (len(points), 1)),
    )
    np.testing.assert_allclose(field.frames[0, 2], normal, atol=1e-10)
    t1 = rotation(seed).T @ field.frames[0, 0]
    errors = _relative_errors(field, coefficients, degree, radius, t1)
    assert max(errors.values()) < 1e-8


def test_coefficients_in_given_planes_off_the_centre():
    radius, degree = 0.6, 6
    coefficients = polynomial(degree, 5) | {(1, 0): 0.3, (0, 1): -0.2, (0, 0): 0.1}
    xy = disc(900, 1.0, 5)
    points = np.column_stack([xy, evaluate(coefficients, xy[:, 0], xy[:, 1])])
    field = estimate_directions(
        points,
        radius=radius,
        degree=degree,
        orders=(2,),
        queries=[[0.0, 0.0, 0.0]],
        normals=np.tile([0.0, 0.0, 2.0], (len(points), 1)),
        frame="given",
    )
    np.testing.assert_allclose(field.frames[0], np.eye(3), atol=1e-15)
    errors = _relative_errors(field, coefficients, degree, radius, [1.0, 0.0])
    assert max(errors.values()) < 1e-10


@pytest.mark.parametrize("weight_distance", ["3d", "planar"])
def test_boundary_points_are_recovered_and_flagged(weight_distance):
    coefficients = polynomial(8, 3)
    xy = disc(1500, 1.0, 3)
    xy = xy[xy[:, 0] >= 0]
    xy[0] = 0.0
    points = np.column_stack([xy, evaluate(coefficients, xy[:, 0], xy[:, 1])])
    field = estimate_directions(
        points,
        radius=0.9,
        degree=8,
        orders=(2, 3),
        queries=[0],
        normals=np.tile([0.0, 0.0, 1.0], (len(points), 1)),
        weight_distance=weight_distance,
    )
    errors = _relative_errors(field, coefficients, 8, 0.9, field.frames[0, 0])
    assert max(errors.values()) < 1e-7
    assert field.status[0] & Status.ONE_SIDED
