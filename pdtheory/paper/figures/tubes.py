"""Strokes as tubes that lie on a mesh: long ones, too, where the surface bends away under them."""

from __future__ import annotations

from typing import Final

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from pdtheory.pointset.cloud import FloatArray, IntArray, PointCloud

#: Pieces along a tube, corners around it, triangles looked at below a point of it.
_PIECES: Final = 10
_CORNERS: Final = 8
_NEAR: Final = 32

#: A tube is sunk into the surface by this part of its radius.
_SUNK: Final = 0.3


class Drapery:
    """A mesh onto which things fall along lines.

    Parameters
    ----------
    surface
        The mesh.
    """

    def __init__(self, surface: PointCloud) -> None:
        assert surface.faces is not None
        self._corners = surface.points[surface.faces]
        self._centres = cKDTree(self._corners.mean(axis=1))

    def fall(self, points: FloatArray, normals: FloatArray, reach: FloatArray) -> FloatArray:
        """Return the signed distance along the normal from points to the mesh.

        Parameters
        ----------
        points, normals : (N, 3) float64
            Lines.
        reach : (N,) float64
            Largest distance looked for.

        Returns
        -------
        (N,) float64
            NaN where the mesh is too far.
        """
        _, near = self._centres.query(points, k=min(_NEAR, len(self._corners)))
        triangle = self._corners[near.reshape(len(points), -1)]
        edge, other = triangle[:, :, 1] - triangle[:, :, 0], triangle[:, :, 2] - triangle[:, :, 0]
        # Moeller and Trumbore: barycentric coordinates of the line in each triangle.
        ray = np.broadcast_to(normals[:, None], edge.shape)
        across = np.cross(ray, other)
        size = np.einsum("nti,nti->nt", edge, across)
        with np.errstate(divide="ignore", invalid="ignore"):
            offset = points[:, None] - triangle[:, :, 0]
            u = np.einsum("nti,nti->nt", offset, across) / size
            turned = np.cross(offset, edge)
            v = np.einsum("nti,nti->nt", ray, turned) / size
            distance = np.einsum("nti,nti->nt", other, turned) / size
            inside = (u >= -1e-6) & (v >= -1e-6) & (u + v <= 1 + 1e-6)
            hit = inside & (np.abs(distance) <= reach[:, None])
        gap = np.where(hit, np.abs(distance), np.inf)
        best = gap.argmin(axis=1)
        rows = np.arange(len(points))
        return np.where(np.isfinite(gap[rows, best]), distance[rows, best], np.nan)


def tubes(
    drapery: Drapery,
    start: FloatArray,
    direction: FloatArray,
    normal: FloatArray,
    length: FloatArray,
    radius: FloatArray,
) -> PointCloud:
    """Return tubes that start at points of a mesh and run along tangents, draped onto the mesh.

    Parameters
    ----------
    drapery
        The mesh.
    start, direction, normal : (M, 3) float64
        Where each tube starts, its unit tangent and the unit normal there.
    length, radius : (M,) float64
        Size of each tube.

    Returns
    -------
    PointCloud
        One mesh with all tubes; a tube ends where the surface does.
    """
    if not len(start):
        return PointCloud(np.empty((0, 3)), faces=np.empty((0, 3), dtype=np.int64))
    along = np.linspace(0.0, 1.0, _PIECES + 1)
    lines = start[:, None] + (length[:, None] * along)[:, :, None] * direction[:, None]
    # A short step first tells how steeply the surface leaves the tangent plane.
    short = 0.1 / _PIECES
    first = drapery.fall(start + (short * length)[:, None] * direction, normal, length)
    height = np.zeros(lines.shape[:2])
    before = height[:, 0] - np.nan_to_num(first) / short / _PIECES
    for piece in range(1, _PIECES + 1):
        # Go on as before, then fall onto the triangles around there.
        here = height[:, piece - 1]
        guess = 2 * here - before
        ahead = lines[:, piece] + np.nan_to_num(guess)[:, None] * normal
        height[:, piece] = guess + drapery.fall(ahead, normal, length / 2)
        before = here
    height = _hold_on(height, lines)
    lines = lines + height[:, :, None] * normal[:, None]
    return _around(lines, direction, normal, radius)


def _hold_on(height: FloatArray, lines: FloatArray) -> FloatArray:
    """End tubes where the surface ends: what lies beyond collapses onto the last point on it."""
    missing = np.isnan(height)
    # A jump of more than 60 degrees between neighbours is another sheet, not this one.
    step = np.linalg.norm(np.diff(lines, axis=1), axis=2)
    missing[:, 1:] |= np.abs(np.diff(np.nan_to_num(height), axis=1)) > np.sqrt(3.0) * step
    beyond = np.maximum.accumulate(missing, axis=1)
    last = (~beyond).sum(axis=1) - 1
    rows = np.arange(len(height))
    lines[:] = np.where(beyond[:, :, None], lines[rows, last][:, None], lines)
    kept: FloatArray = np.where(beyond, height[rows, last][:, None], height)
    return kept


def _around(
    lines: FloatArray, direction: FloatArray, normal: FloatArray, radius: FloatArray
) -> PointCloud:
    """Put rings around polylines (M, pieces + 1, 3) and join them to closed tubes."""
    count, rings = lines.shape[:2]
    tangent = np.gradient(lines, axis=1)
    size = np.linalg.norm(tangent, axis=2, keepdims=True)
    tangent = np.where(size > 0, tangent / np.where(size > 0, size, 1.0), direction[:, None])
    side = np.cross(normal, direction)[:, None]
    up = np.cross(tangent, np.broadcast_to(side, tangent.shape))
    up /= np.linalg.norm(up, axis=2, keepdims=True)
    turn = 2 * np.pi * np.arange(_CORNERS) / _CORNERS
    ring = np.cos(turn)[:, None] * side[:, :, None] + np.sin(turn)[:, None] * up[:, :, None]
    # Rounded ends: the last rings draw together.
    share = np.ones(rings)
    share[-1] = 0.55
    centre = lines + (1 - _SUNK) * radius[:, None, None] * up
    points = centre[:, :, None] + (radius[:, None] * share)[:, :, None, None] * ring
    ends = centre[:, [0, -1]]
    vertices = np.concatenate([points.reshape(count, -1, 3), ends], axis=1)
    return PointCloud(
        vertices.reshape(-1, 3),
        faces=(_tube_faces(rings)[None] + (np.arange(count) * vertices.shape[1])[:, None, None])
        .reshape(-1, 3)
        .astype(np.int64),
        name="strokes",
    )


def _tube_faces(rings: int) -> IntArray:
    """Return the triangles of one closed tube: rings, then the centres of both ends."""
    corner = np.arange(rings * _CORNERS).reshape(rings, _CORNERS)
    after = np.roll(corner, -1, axis=1)
    a, b, c, d = corner[:-1].ravel(), after[:-1].ravel(), after[1:].ravel(), corner[1:].ravel()
    first, last = rings * _CORNERS, rings * _CORNERS + 1
    parts: list[npt.NDArray[np.int64]] = [
        np.stack([a, b, c], axis=1),
        np.stack([a, c, d], axis=1),
        np.stack([after[0], corner[0], np.full(_CORNERS, first)], axis=1),
        np.stack([corner[-1], after[-1], np.full(_CORNERS, last)], axis=1),
    ]
    return np.concatenate(parts)
