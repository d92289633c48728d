"""Neighbours within a radius from a grid of occupied cells with points stored in cell order.

Cells are numbered with z running fastest, so the cells that a ball touches in one column of the
grid are one run of points, found by two binary searches. All points of a cell share these runs.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from pdtheory.pointset.kernels.jit import Array, IntArray, inner

#: Cells on each side of the own one that a ball can touch: the cell is at least half a radius.
REACH = 2
#: Columns of cells that a ball can touch.
COLUMNS = (2 * REACH + 1) ** 2


class Grid(NamedTuple):
    """Points in cell order, and the occupied cells.

    Attributes
    ----------
    points : (P, 3) float64
        Points, sorted by cell.
    keys : (C,) int64
        Numbers of the occupied cells, ascending.
    starts : (C + 1,) int64
        First point of each.
    shape : (3,) int64
        Cells along each axis.
    corner : (3,) float64
        Lowest corner of the grid.
    cell : float
        Edge of a cell.
    """

    points: Any
    keys: Any
    starts: Any
    shape: Any
    corner: Any
    cell: float


@inner
def _lower_bound(keys: IntArray, key: int) -> int:
    """Index of the first entry >= key."""
    low = 0
    high = len(keys)
    while low < high:
        middle = (low + high) // 2
        if keys[middle] < key:
            low = middle + 1
        else:
            high = middle
    return low


@inner
def find_runs(grid: Grid, ix: int, iy: int, iz: int, runs: IntArray) -> tuple[int, int]:
    """Write the runs of points in the cells around (ix, iy, iz).

    Returns
    -------
    (int, int)
        Number of runs, and number of points in them.
    """
    count = 0
    total = 0
    low_z = max(iz - REACH, 0)
    high_z = min(iz + REACH, grid.shape[2] - 1)
    if low_z > high_z:
        return 0, 0
    for jx in range(max(ix - REACH, 0), min(ix + REACH, grid.shape[0] - 1) + 1):
        for jy in range(max(iy - REACH, 0), min(iy + REACH, grid.shape[1] - 1) + 1):
            column = (jx * grid.shape[1] + jy) * grid.shape[2]
            start = grid.starts[_lower_bound(grid.keys, column + low_z)]
            stop = grid.starts[_lower_bound(grid.keys, column + high_z + 1)]
            if stop > start:
                runs[count, 0] = start
                runs[count, 1] = stop
                count += 1
                total += stop - start
    return count, total


@inner
def locate(grid: Grid, query: Array, here: IntArray) -> None:
    """Write the cell of a query, which may lie outside the grid."""
    for axis in range(3):
        at = np.floor((query[axis] - grid.corner[axis]) / grid.cell)
        here[axis] = int(min(max(at, -2.0 * REACH), grid.shape[axis] + 2.0 * REACH))


@inner
def gather(
    points: Array,
    runs: IntArray,
    count: int,
    query: Array,
    reach: float,
    radius: float,
    cloud: Array,
) -> int:
    """Collect the points within `reach` of a query, relative to it, in units of the radius.

    Returns
    -------
    int
        Their number n; ``cloud[0:3, :n]`` holds the coordinates, ``cloud[3, :n]`` the squared
        distances.
    """
    n = 0
    limit = reach * reach
    scale = 1.0 / radius
    qx = query[0]
    qy = query[1]
    qz = query[2]
    for r in range(count):
        for i in range(runs[r, 0], runs[r, 1]):
            x = points[i, 0] - qx
            y = points[i, 1] - qy
            z = points[i, 2] - qz
            d = x * x + y * y + z * z
            cloud[0, n] = x * scale
            cloud[1, n] = y * scale
            cloud[2, n] = z * scale
            cloud[3, n] = d * scale * scale
            if d <= limit:
                n += 1
    return n


@inner
def gather_listed(
    points: Array, members: IntArray, query: Array, radius: float, cloud: Array
) -> int:
    """Collect the listed points as `gather` does; returns their number."""
    scale = 1.0 / radius
    for j in range(len(members)):
        i = members[j]
        x = (points[i, 0] - query[0]) * scale
        y = (points[i, 1] - query[1]) * scale
        z = (points[i, 2] - query[2]) * scale
        cloud[0, j] = x
        cloud[1, j] = y
        cloud[2, j] = z
        cloud[3, j] = x * x + y * y + z * z
    return len(members)


def _cell_numbers(points: Any, corner: Any, cell: float, shape: Any) -> Any:
    cells = np.clip(np.floor((points - corner) / cell), 0, shape - 1).astype(np.int64)
    return (cells[:, 0] * shape[1] + cells[:, 1]) * shape[2] + cells[:, 2]


def build_grid(points: Any, radius: float) -> tuple[Grid, Any]:
    """Sort points into cells of half the radius.

    Parameters
    ----------
    points : (P, 3) float64
        Finite points.
    radius : float
        Radius of the later queries.

    Returns
    -------
    grid : Grid
        The grid.
    order : (P,) int64
        Which point stands where: ``grid.points = points[order]``.
    """
    corner = points.min(axis=0)
    extent = points.max(axis=0) - corner
    # 2^20 cells an axis keep the cell number within 63 bits; larger cells are slower, not wrong.
    cell = max(radius / REACH, float(extent.max()) / 2**20)
    shape = np.floor(extent / cell).astype(np.int64) + 1
    key = _cell_numbers(points, corner, cell, shape)
    order = np.argsort(key, kind="stable")
    keys, starts = np.unique(key[order], return_index=True)
    starts = np.append(starts, len(points)).astype(np.int64)
    return Grid(points[order], keys, starts, shape, corner, cell), order


def cell_order(grid: Grid, queries: Any) -> Any:
    """Return the (Q,) order that visits queries by cell; those outside go to the nearest cell."""
    key = _cell_numbers(queries, grid.corner, grid.cell, grid.shape)
    return np.argsort(key, kind="stable")
