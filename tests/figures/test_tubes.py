"""Strokes as tubes: they lie on the surface, end where it ends, and are closed."""

from __future__ import annotations

import numpy as np
import trimesh

import synthetic_surfaces
from pdtheory.paper.figures.tubes import Drapery, tubes
from pdtheory.pointset.cloud import FloatArray


def star(count: int) -> FloatArray:
    angle = 2 * np.pi * np.arange(count) / count
    return np.stack([np.cos(angle), np.sin(angle), np.zeros(count)], axis=1)


def test_tubes_are_closed_and_face_outwards() -> None:
    surface = synthetic_surfaces.get("monkey", amplitude="2/5").mesh(40)
    up = np.tile([0.0, 0.0, 1.0], (6, 1))
    made = tubes(Drapery(surface), np.zeros((6, 3)), star(6), up, np.full(6, 0.7), np.full(6, 0.02))
    mesh = trimesh.Trimesh(made.points, made.faces, process=False)
    assert len(mesh.split(only_watertight=True)) == 6
    assert mesh.is_winding_consistent
    assert mesh.volume > 0


def test_tubes_lie_on_a_curved_surface() -> None:
    monkey = synthetic_surfaces.get("monkey", amplitude="2/5")
    up = np.tile([0.0, 0.0, 1.0], (6, 1))
    made = tubes(
        Drapery(monkey.mesh(60)), np.zeros((6, 3)), star(6), up, np.full(6, 0.8), np.full(6, 0.01)
    )
    x, y, z = made.points.T
    gap = np.abs(z - 0.4 * (x**3 - 3 * x * y**2))
    # Radius, the part above the surface, and the chords between the pieces.
    assert gap.max() < 0.03
    assert np.hypot(x, y).max() > 0.79


def test_tubes_follow_steep_planes_and_end_with_the_surface() -> None:
    ridge = synthetic_surfaces.get("ridge", slope=1, extent=1)
    direction = np.array([[0.0, 1.0, 0.0]])
    made = tubes(
        Drapery(ridge.mesh(40)), np.zeros((1, 3)), direction, np.array([[0.0, 0.0, 1.0]]),
        np.array([1.5]), np.array([0.01]),
    )  # fmt: skip
    assert np.max(np.abs(made.points[:, 2] + np.abs(made.points[:, 1]))) < 0.05
    assert 0.8 < made.points[:, 1].max() < 1.05


def test_falling_measures_along_the_normal() -> None:
    plane = synthetic_surfaces.get("plane").mesh(8)
    points = np.array([[0.1, 0.2, 0.3], [0.1, 0.2, -0.3], [5.0, 0.0, 0.1]])
    height = Drapery(plane).fall(points, np.tile([0.0, 0.0, 1.0], (3, 1)), np.full(3, 1.0))
    np.testing.assert_allclose(height[:2], [-0.3, 0.3], atol=1e-12)
    assert np.isnan(height[2])
