"""Direction fields from closed forms, for the Blender tests."""

from __future__ import annotations

import numpy as np

from pdtheory.pointset.cloud import PointCloud
from pdtheory.pointset.directions import OrderDirections
from pdtheory.pointset.field import DirectionField


def torus(major: float = 1.0, minor: float = 0.4, count: tuple[int, int] = (48, 20)):
    """Return a torus mesh and its field of order 2 (principal curvatures) and 3 (invented angles).

    The angles of order 2 are exact: t1 runs along the meridian, t2 along the parallel, and with the
    outward normal g_2 = -(cos^2 / r + cos(v) sin^2 / (R + r cos v)) / 2.
    """
    u, v = (
        part.ravel()
        for part in np.meshgrid(
            2 * np.pi * np.arange(count[0]) / count[0],
            2 * np.pi * np.arange(count[1]) / count[1],
            indexing="ij",
        )
    )
    ring = major + minor * np.cos(v)
    points = np.stack((ring * np.cos(u), ring * np.sin(u), minor * np.sin(v)), axis=1)
    normal = np.stack((np.cos(u) * np.cos(v), np.sin(u) * np.cos(v), np.sin(v)), axis=1)
    meridian = np.stack((-np.cos(u) * np.sin(v), -np.sin(u) * np.sin(v), np.cos(v)), axis=1)
    parallel = np.cross(normal, meridian)
    frames = np.stack((meridian, parallel, normal), axis=1)
    along_meridian, along_parallel = -1.0 / minor, -np.cos(v) / ring
    # The parallel bends less, so it is the maximum of the signed g_2.
    order2 = _order(
        2,
        frames,
        angle=np.tile(np.array([0.0, 0.5, 1.0, 1.5]) * np.pi, (len(u), 1)),
        height=np.stack((along_meridian + 0 * v, along_parallel) * 2, axis=1) / 2,
        kind=np.array([-1, 1, -1, 1]),
    )
    order3 = _order(
        3,
        frames,
        angle=np.tile(np.arange(6) * np.pi / 3, (len(u), 1)),
        height=np.tile([0.3, -0.3] * 3, (len(u), 1)),
        kind=np.array([1, -1] * 3),
    )
    i, j = np.divmod(np.arange(len(u)), count[1])
    right = ((i + 1) % count[0]) * count[1] + j
    top = i * count[1] + (j + 1) % count[1]
    corner = ((i + 1) % count[0]) * count[1] + (j + 1) % count[1]
    here = np.arange(len(u))
    faces = np.concatenate(
        (np.stack((here, right, corner), axis=1), np.stack((here, corner, top), axis=1))
    )
    phi_20 = (along_meridian + along_parallel) / 4
    phi_22 = (along_meridian - along_parallel) / 8
    zero = np.zeros(len(u))
    field = DirectionField(
        points=points,
        frames=frames,
        radius=zero + 0.1,
        degree=np.full(len(u), 4),
        neighbours=np.full(len(u), 20),
        residual_rms=zero,
        condition=zero + 1.0,
        status=np.zeros(len(u), dtype=np.int64),
        phi=np.stack((zero, zero, phi_20, phi_22, zero, zero + 0.15), axis=1).astype(complex),
        phi_order=np.array([0, 1, 2, 2, 3, 3]),
        phi_frequency=np.array([0, 1, 0, 2, 1, 3]),
        directions={2: order2, 3: order3},
    )
    return PointCloud(points, normal, faces, "torus"), field


def _order(order: int, frames, *, angle, height, kind) -> OrderDirections:
    points, each = angle.shape
    vector = (
        np.cos(angle)[..., None] * frames[:, None, 0]
        + np.sin(angle)[..., None] * frames[:, None, 1]
    )
    factorial = {2: 2.0, 3: 6.0}[order]
    flat = height.ravel()
    return OrderDirections(
        order=order,
        offsets=np.arange(points + 1) * each,
        angle=angle.ravel(),
        vector=vector.reshape(-1, 3),
        eigenvalue=factorial * flat,
        strength=np.abs(flat) * 0.1 ** (order - 1),
        kind=np.tile(kind, points).astype(np.int8),
        angle_std=np.full(points * each, 0.01),
        eigenvalue_std=np.zeros(points * each),
        isotropic=np.zeros(points, dtype=bool),
    )
