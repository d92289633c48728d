"""The side of the normals: consistent without any, by winding, towards a viewpoint."""

from __future__ import annotations

import numpy as np
import pytest

from pdtheory.conventions import Status
from pdtheory.errors import InputError
from pdtheory.pointset import PointCloud, estimate_directions
from pdtheory.pointset.orientation import consistent_normals
from tests.pointset.surfaces import rotation, torus

HOW = {"neighbours": 40, "degree": 4, "orders": (2,)}


def test_handed_on_over_a_connected_cloud():
    points, normals, *_ = torus(8000, 1.0, 0.4, 3)
    field = estimate_directions(points @ rotation(1).T, **HOW)
    assert not np.any(field.status & Status.UNORIENTED)
    side = np.sum(field.frames[:, 2] * (normals @ rotation(1).T), axis=1)
    assert np.all(side > 0.9)


def test_handed_on_in_each_part_by_itself():
    points, normals, *_ = torus(4000, 1.0, 0.4, 4)
    two = np.concatenate([points, points + np.array([10.0, 0.0, 0.0])])
    field = estimate_directions(two, **HOW)
    assert np.all(np.sum(field.frames[:, 2] * np.tile(normals, (2, 1)), axis=1) > 0.9)


def test_open_patch_has_one_sign():
    rng = np.random.default_rng(0)
    xy = rng.uniform(-1, 1, (3000, 2))
    points = np.column_stack([xy, np.sin(3 * xy[:, 0]) * np.cos(2 * xy[:, 1])])
    field = estimate_directions(points, **HOW)
    assert np.all(field.frames[:, 2, 2] > 0)


@pytest.mark.parametrize("bend", [-1.0, -0.1, 0.0, 0.1, 1.0])
@pytest.mark.parametrize("seed", range(3))
def test_terrains_are_seen_from_above(bend, seed):
    xy = np.random.default_rng(seed).uniform(-1, 1, (2000, 2))
    height = bend * np.sum(xy**2, axis=1) + 0.02 * np.sin(9 * xy[:, 0])
    assert consistent_normals(np.column_stack([xy, height]))[:, 2].min() > 0


@pytest.mark.parametrize("down", [0, 1, 2])
def test_most_of_a_closed_surface_still_shows_its_outside(down):
    sphere = np.random.default_rng(4).normal(size=(6000, 3))
    sphere /= np.linalg.norm(sphere, axis=1, keepdims=True)
    part = sphere[sphere[:, down] < 0.3]
    assert np.all(np.sum(consistent_normals(part) * part, axis=1) > 0.9)


def test_winding_of_a_mesh():
    count = 60
    u, v = np.meshgrid(np.arange(count), np.arange(count), indexing="ij")
    a, b = 2 * np.pi * u / count, 2 * np.pi * v / count
    points = np.column_stack(
        [
            ((1 + 0.4 * np.cos(b)) * np.cos(a)).ravel(),
            ((1 + 0.4 * np.cos(b)) * np.sin(a)).ravel(),
            (0.4 * np.sin(b)).ravel(),
        ]
    )
    normals = np.column_stack(
        [(np.cos(b) * np.cos(a)).ravel(), (np.cos(b) * np.sin(a)).ravel(), np.sin(b).ravel()]
    )
    corner = (u * count + v).ravel()
    right = ((u + 1) % count * count + v).ravel()
    up = (u * count + (v + 1) % count).ravel()
    faces = np.column_stack([corner, right, up])
    for turned, sign in ((faces, 1.0), (faces[:, ::-1], -1.0)):
        field = estimate_directions(PointCloud(points, faces=np.ascontiguousarray(turned)), **HOW)
        assert not np.any(field.status & Status.UNORIENTED)
        assert np.all(sign * np.sum(field.frames[:, 2] * normals, axis=1) > 0.9)


def test_viewpoint():
    points = torus(4000, 1.0, 0.4, 5)[0]
    viewpoint = np.array([0.0, 0.0, 7.0])
    field = estimate_directions(points, orient=viewpoint, **HOW)
    assert not np.any(field.status & Status.UNORIENTED)
    # At grazing incidence the fit may still tilt the normal past the line of sight.
    assert np.all(np.sum(field.frames[:, 2] * (viewpoint - points), axis=1) > -0.2)


def test_turning_the_normals_over_mirrors_everything():
    points, normals, *_ = torus(4000, 1.0, 0.4, 6)
    up = estimate_directions(points, normals=normals, **HOW)
    down = estimate_directions(points, normals=-normals, **HOW)
    np.testing.assert_allclose(down.frames[:, 2], -up.frames[:, 2], atol=1e-12)
    for order in (2,):
        a, b = up[order].maxima, down[order].minima
        np.testing.assert_allclose(a.eigenvalue, -b.eigenvalue, atol=1e-10)
        np.testing.assert_array_equal(a.offsets, b.offsets)


def test_none_is_stated():
    points = torus(2000, 1.0, 0.4, 7)[0]
    assert np.all(estimate_directions(points, orient="none", **HOW).status & Status.UNORIENTED)


@pytest.mark.parametrize(
    ("orient", "words"),
    [
        ("up", "orient 'up'"),
        ("normals", "needs normals"),
        ("winding", "faces"),
        ([1.0, 2.0], "three numbers"),
        ([np.nan, 0.0, 0.0], "NaN"),
    ],
)
def test_unusable_orientations(orient, words):
    with pytest.raises(InputError, match=words):
        estimate_directions(torus(500, 1.0, 0.4, 7)[0], orient=orient, **HOW)
