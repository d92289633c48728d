"""Charts: smooth maps of the unit square, from which surfaces are meshed and sampled."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from pdtheory.pointset.cloud import FloatArray, IntArray

#: (u, v) of shape (m,) to the points and the two tangents, each of shape (m, 3).
Evaluate = Callable[[FloatArray, FloatArray], tuple[FloatArray, FloatArray, FloatArray]]

#: Nodes in each direction on which bounds and sizes of a chart are measured.
_PROBE = 65

#: Safety factor of the bound on the area element between the probes.
_MARGIN = 1.1


#: Step of the complex-step derivative; far below rounding, since nothing is subtracted.
_IMAGINARY_STEP = 1e-30


def from_map(position: Callable[[Any, Any], Any]) -> Evaluate:
    """Return points and tangents of a chart that is given by its points alone.

    The tangents are complex-step derivatives, Im X(u + ih, v) / h, exact to rounding.

    Parameters
    ----------
    position
        Maps u, v of shape (m,) to points (m, 3), by analytic NumPy functions that take complex
        numbers.
    """

    def evaluate(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        step = 1j * _IMAGINARY_STEP
        along_u, along_v = position(u + step, v + 0j), position(u + 0j, v + step)
        return along_u.real, along_u.imag / _IMAGINARY_STEP, along_v.imag / _IMAGINARY_STEP

    return evaluate


@dataclass(frozen=True)
class Chart:
    """A map of the unit square into space, with dX/du x dX/dv along the outward normal.

    Attributes
    ----------
    evaluate : callable
        Maps u, v of shape (m,) to points, dX/du and dX/dv of shape (m, 3).
    cells : (float, float)
        Cells of the mesh along u and v at resolution 1; a surface gives charts that share an edge
        the same number along it.
    """

    evaluate: Evaluate
    cells: tuple[float, float] = (1.0, 1.0)

    def points(self, u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return points (m, 3), unit normals (m, 3) and area elements (m,) at u, v of shape (m,).

        Where the map is degenerate, as at a pole, the normal is 0.
        """
        points, du, dv = self.evaluate(u, v)
        cross = np.cross(du, dv)
        element = np.linalg.norm(cross, axis=1)
        scale = np.linalg.norm(du, axis=1).max() * np.linalg.norm(dv, axis=1).max()
        proper = element > 1e-12 * scale
        normals: FloatArray = np.zeros_like(cross)
        normals[proper] = cross[proper] / element[proper, None]
        return points, normals, element

    @cached_property
    def _probe(self) -> tuple[FloatArray, FloatArray, tuple[float, float]]:
        ticks = np.linspace(0.0, 1.0, _PROBE)
        u, v = (grid.ravel() for grid in np.meshgrid(ticks, ticks, indexing="ij"))
        points, du, dv = self.evaluate(u, v)
        sizes = (
            float(np.linalg.norm(du, axis=1).mean()),
            float(np.linalg.norm(dv, axis=1).mean()),
        )
        return points, np.linalg.norm(np.cross(du, dv), axis=1), sizes

    @property
    def probe_points(self) -> FloatArray:
        """Points on a grid that includes the edges, shape (65 * 65, 3)."""
        return self._probe[0]

    @property
    def element_bound(self) -> float:
        """An upper bound of the area element."""
        return _MARGIN * float(self._probe[1].max())

    @property
    def area(self) -> float:
        """The area, by the trapezoidal rule; used for proportions only."""
        weights = np.ones(_PROBE)
        weights[[0, -1]] = 0.5
        elements = self._probe[1].reshape(_PROBE, _PROBE)
        return float(weights @ elements @ weights) / (_PROBE - 1) ** 2

    @property
    def sizes(self) -> tuple[float, float]:
        """Mean length of the chart along u and along v."""
        return self._probe[2]


def draw(
    charts: Sequence[Chart], count: int, rng: np.random.Generator
) -> tuple[FloatArray, FloatArray]:
    """Draw points uniformly by area, by rejection.

    Parameters
    ----------
    charts
        The surface.
    count
        Number of points.
    rng
        Source of random numbers.

    Returns
    -------
    points, normals : (count, 3) float64
        The points, in random order, and their unit normals.
    """
    bounds = np.array([chart.element_bound for chart in charts])
    while True:
        result = _draw_below(charts, bounds, count, rng)
        if result is not None:
            return result
        bounds *= 1.5


def _draw_below(
    charts: Sequence[Chart], bounds: FloatArray, count: int, rng: np.random.Generator
) -> tuple[FloatArray, FloatArray] | None:
    """Draw with given bounds; None if an area element exceeds its bound, for then it was biased."""
    points, normals, found = [], [], 0
    while found < count:
        tries = 2 * (count - found) + 100
        which = rng.choice(len(charts), size=tries, p=bounds / bounds.sum())
        u, v, level = rng.random((3, tries))
        place, normal = np.empty((tries, 3)), np.empty((tries, 3))
        keep = np.zeros(tries, dtype=bool)
        for index, chart in enumerate(charts):
            own = np.flatnonzero(which == index)
            if not len(own):
                continue
            place[own], normal[own], element = chart.points(u[own], v[own])
            if element.max() > bounds[index]:
                return None
            keep[own] = level[own] * bounds[index] < element
        points.append(place[keep])
        normals.append(normal[keep])
        found += int(keep.sum())
    return np.concatenate(points)[:count], np.concatenate(normals)[:count]


def grid(charts: Sequence[Chart], count: int) -> tuple[FloatArray, FloatArray]:
    """Return points at the cell centres of regular grids over the charts, about `count` in all.

    Parameters
    ----------
    charts
        The surface.
    count
        Number of points aimed at.

    Returns
    -------
    points, normals : (m, 3) float64
        The points and their unit normals.
    """
    spacing = np.sqrt(sum(chart.area for chart in charts) / count)
    points, normals = [], []
    for chart in charts:
        along_u, along_v = chart.sizes
        wanted = max(1.0, chart.area / spacing**2)
        rows = max(1, round(np.sqrt(wanted * along_u / along_v)))
        columns = max(1, round(wanted / rows))
        u, v = np.meshgrid(
            (np.arange(rows) + 0.5) / rows, (np.arange(columns) + 0.5) / columns, indexing="ij"
        )
        place, normal, _ = chart.points(u.ravel(), v.ravel())
        points.append(place)
        normals.append(normal)
    return np.concatenate(points), np.concatenate(normals)


def mesh(charts: Sequence[Chart], resolution: int) -> tuple[FloatArray, FloatArray, IntArray]:
    """Triangulate the charts and join them where they meet.

    Parameters
    ----------
    charts
        The surface; charts that share an edge must have the same cells along it.
    resolution
        Number of cells along a chart with ``cells`` 1.

    Returns
    -------
    points : (P, 3) float64
        Vertices, one for each place.
    normals : (P, 3) float64
        Unit normals; on a crease the mean of both sides.
    faces : (F, 3) int64
        Triangles, counter-clockwise seen from outside.
    """
    points, normals, faces, start = [], [], [], 0
    for chart in charts:
        rows, columns = (max(1, round(resolution * part)) for part in chart.cells)
        u, v = np.meshgrid(
            np.linspace(0, 1, rows + 1), np.linspace(0, 1, columns + 1), indexing="ij"
        )
        place, normal, _ = chart.points(u.ravel(), v.ravel())
        corner = start + np.arange((rows + 1) * (columns + 1)).reshape(rows + 1, columns + 1)
        a, b = corner[:-1, :-1].ravel(), corner[1:, :-1].ravel()
        c, d = corner[1:, 1:].ravel(), corner[:-1, 1:].ravel()
        points.append(place)
        normals.append(normal)
        faces += [np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)]
        start += len(place)
    return weld(np.concatenate(points), np.concatenate(normals), np.concatenate(faces))


def weld(
    points: FloatArray, normals: FloatArray, faces: IntArray
) -> tuple[FloatArray, FloatArray, IntArray]:
    """Join vertices at the same place and drop triangles that have collapsed.

    Parameters
    ----------
    points, normals : (P, 3) float64
        Vertices and their normals (0 where unknown).
    faces : (F, 3) int64
        Triangles.

    Returns
    -------
    points, normals, faces
        The same surface; the normal of a joined vertex is the mean direction of those joined.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    tolerance = 1e-9 * float(np.linalg.norm(np.ptp(points, axis=0)))
    pairs = cKDTree(points).query_pairs(tolerance, output_type="ndarray")
    links = coo_array(
        (np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(points), len(points))
    )
    count, label = connected_components(links, directed=False)
    # Number the joined vertices by first occurrence, so that the order of the charts is kept.
    _, first = np.unique(label, return_index=True)
    rank = np.empty(count, dtype=np.int64)
    rank[np.argsort(first)] = np.arange(count)
    place = rank[label]
    sums = np.stack([np.bincount(place, normals[:, i], count) for i in range(3)], axis=1)
    lengths = np.linalg.norm(sums, axis=1, keepdims=True)
    joined = place[faces]
    whole = np.all(joined != np.roll(joined, 1, axis=1), axis=1)
    return points[np.sort(first)], sums / np.where(lengths > 0, lengths, 1.0), joined[whole]
