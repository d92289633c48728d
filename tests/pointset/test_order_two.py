"""Order 2 against closed forms: principal directions and curvatures."""

from __future__ import annotations

import numpy as np
import pytest

from pdtheory.conventions import Kind, Status
from pdtheory.pointset import estimate_directions
from tests.pointset.surfaces import torus


def _angle_between_lines(a, b):
    """Angle in degrees between unoriented unit vectors, row by row."""
    cross = np.linalg.norm(np.cross(a, b), axis=1)
    return np.degrees(np.arctan2(cross, np.abs(np.sum(a * b, axis=1))))


def _first_of_kind(rows, kind):
    chosen = rows.of_kind(kind)
    assert np.all(np.diff(chosen.offsets) == 2)
    return chosen.vector[::2], chosen.eigenvalue[::2]


@pytest.mark.parametrize("oriented", [True, False])
def test_torus(oriented):
    points, normals, meridian, parallel, curvatures = torus(20_000, 1.0, 0.4, 1)
    queries = np.arange(0, 20_000, 50)
    field = estimate_directions(
        points,
        radius=0.2,
        degree=6,
        orders=(2,),
        queries=queries,
        normals=normals if oriented else None,
    )
    assert np.all(field.status & (Status.DEGREE_LOWERED | Status.ILL_CONDITIONED) == 0)
    assert np.all((field.status & Status.UNORIENTED == 0) == oriented)
    side = np.sign(np.sum(field.frames[:, 2] * normals[queries], axis=1))
    if oriented:
        assert np.all(side == 1)
    out = (side > 0)[:, None]
    least, low = _first_of_kind(field[2], Kind.MINIMUM)
    most, high = _first_of_kind(field[2], Kind.MAXIMUM)
    assert _angle_between_lines(np.where(out, least, most), meridian[queries]).max() < 0.1
    assert _angle_between_lines(np.where(out, most, least), parallel[queries]).max() < 0.1
    np.testing.assert_allclose(np.where(side > 0, low, -high), curvatures[queries, 0], atol=5e-3)
    np.testing.assert_allclose(np.where(side > 0, high, -low), curvatures[queries, 1], atol=5e-3)


def test_monge_patch():
    """z = exp(x) cos(y) / 4 + x y^2 / 8, with curvatures from its first and second derivatives."""
    rng = np.random.default_rng(4)
    x, y = rng.uniform(-1, 1, (2, 30_000))
    e, c, s = np.exp(x) / 4, np.cos(y), np.sin(y)
    points = np.column_stack([x, y, e * c + x * y**2 / 8])
    inside = np.flatnonzero((np.abs(x) < 0.7) & (np.abs(y) < 0.7))[:300]
    field = estimate_directions(
        points,
        radius=0.2,
        degree=5,
        orders=(2,),
        queries=inside,
        normals=np.tile([0.0, 0.0, 1.0], (len(points), 1)),
    )
    for row, i in enumerate(inside):
        zx, zy = e[i] * c[i] + y[i] ** 2 / 8, -e[i] * s[i] + x[i] * y[i] / 4
        hessian = np.array(
            [
                [e[i] * c[i], -e[i] * s[i] + y[i] / 4],
                [-e[i] * s[i] + y[i] / 4, -e[i] * c[i] + x[i] / 4],
            ]
        )
        first = np.array([[1 + zx**2, zx * zy], [zx * zy, 1 + zy**2]])
        values, vectors = np.linalg.eig(
            np.linalg.solve(first, hessian / np.sqrt(1 + zx**2 + zy**2))
        )
        rows = field[2].rows_of(row)
        for kind, which in ((1, np.argmax(values)), (-1, np.argmin(values))):
            found = rows.start + int(np.flatnonzero(field[2].kind[rows] == kind)[0])
            assert abs(field[2].eigenvalue[found] - values[which]) < 2e-4
            u, v = vectors[:, which]
            tangent = np.array([u, v, zx * u + zy * v])
            tangent /= np.linalg.norm(tangent)
            gap = abs(values[0] - values[1])
            assert _angle_between_lines(field[2].vector[[found]], tangent[None])[0] < 0.02 / gap


def test_sphere_eigenvalue_has_the_sign_of_the_conventions():
    rng = np.random.default_rng(2)
    points = rng.normal(size=(5000, 3))
    points *= 2.0 / np.linalg.norm(points, axis=1, keepdims=True)
    field = estimate_directions(
        points, radius=0.6, degree=6, orders=(2,), queries=np.arange(50), normals=points
    )
    assert np.abs(field.coefficient(2, 0).real * 2 + 0.5).max() < 1e-4
    np.testing.assert_allclose(np.linalg.norm(field.frames, axis=2), 1, atol=1e-12)
    np.testing.assert_allclose(np.linalg.det(field.frames), 1, atol=1e-12)


def test_plane_is_isotropic_in_every_order():
    rng = np.random.default_rng(3)
    xy = rng.uniform(-1, 1, (2000, 2))
    points = np.column_stack([xy, 0.3 * xy[:, 0] - 0.2 * xy[:, 1]]) + 100.0
    field = estimate_directions(
        points, radius=0.4, degree=6, orders=(2, 3, 4), queries=np.arange(100)
    )
    for order in (2, 3, 4):
        assert np.all(field[order].isotropic)
        assert len(field[order]) == 0


@pytest.mark.parametrize("turn", range(16))
def test_angles_of_a_parabolic_cylinder_follow_it_around_the_circle(turn):
    """z = s^2 / 2 with s along an axis at any angle, those of the coordinates among them."""
    angle = turn * np.pi / 16
    grid = np.linspace(-1, 1, 41)
    x, y = (part.ravel() for part in np.meshgrid(grid, grid))
    along = x * np.cos(angle) + y * np.sin(angle)
    points = np.column_stack([x, y, along**2 / 2])
    field = estimate_directions(
        points, radius=0.6, degree=4, orders=(2,), queries=np.zeros((1, 3)), orient=(0, 0, 9)
    )
    rows = field[2]
    assert np.all((rows.angle >= 0) & (rows.angle < 2 * np.pi))
    assert np.all(np.diff(rows.angle) > 0)
    assert rows.kind.tolist() in ([1, -1, 1, -1], [-1, 1, -1, 1])
    far = (rows.angle[rows.kind == Kind.MAXIMUM] - angle + np.pi / 2) % np.pi - np.pi / 2
    np.testing.assert_allclose(far, 0.0, atol=1e-9)
    np.testing.assert_allclose(rows.eigenvalue[rows.kind == Kind.MAXIMUM], 1.0, atol=1e-8)
    np.testing.assert_allclose(rows.eigenvalue[rows.kind == Kind.MINIMUM], 0.0, atol=1e-8)
