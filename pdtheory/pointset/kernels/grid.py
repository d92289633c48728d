"""Neighbours within a radius from a grid of occupied cells with points stored in cell order.

Cells are numbered with z running fastest, so the cells that a ball touches in one column of the
grid are one run of points. Few other cells of a surface lie between those of neighbouring columns,
so the runs are found one after the other. All points of a cell share them.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from pdtheory.pointset.columns import highest, lowest
from pdtheory.pointset.kernels.jit import Array, IntArray, inner
from pdtheory.pointset.kernels.lanes import LANES, Lanes, Rows, emit
from pdtheory.pointset.kernels.tables import REACH

#: Cells that are looked at one by one before the rest is searched by halving.
NEAR = 8


class Grid(NamedTuple):
    """Points in cell order, and the occupied cells.

    Attributes
    ----------
    columns : (3, P + LANES) float64
        Coordinates of the points, sorted by cell, and zeros.
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

    columns: Any
    keys: Any
    starts: Any
    shape: Any
    corner: Any
    cell: float


@inner
def _lower_bound(keys: IntArray, key: int, low: int, high: int) -> int:
    """Index of the first entry >= key, known to be in low..high."""
    while low < high:
        middle = (low + high) // 2
        if keys[middle] < key:
            low = middle + 1
        else:
            high = middle
    return low


@inner
def _pass_by(keys: IntArray, key: int, low: int) -> int:
    """Index of the first entry >= key, known to be `low` or behind it, and likely not far."""
    end = min(low + NEAR, len(keys))
    while low < end and keys[low] < key:
        low += 1
    if low < end:
        return low
    return _lower_bound(keys, key, low, len(keys))


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
    low_y = max(iy - REACH, 0)
    high_y = min(iy + REACH, grid.shape[1] - 1)
    at = 0
    for jx in range(max(ix - REACH, 0), min(ix + REACH, grid.shape[0] - 1) + 1):
        column = (jx * grid.shape[1] + low_y) * grid.shape[2]
        at = _lower_bound(grid.keys, column + low_z, at, len(grid.keys))
        for _ in range(low_y, high_y + 1):
            low = _pass_by(grid.keys, column + low_z, at)
            at = _pass_by(grid.keys, column + high_z + 1, low)
            start = grid.starts[low]
            stop = grid.starts[at]
            if stop > start:
                runs[count, 0] = start
                runs[count, 1] = stop
                count += 1
                total += stop - start
            column += grid.shape[2]
    return count, total


@inner
def locate(grid: Grid, query: Array, here: IntArray) -> None:
    """Write the cell of a query, which may lie outside the grid."""
    for axis in range(3):
        at = np.floor((query[axis] - grid.corner[axis]) / grid.cell)
        here[axis] = int(min(max(at, -2.0 * REACH), grid.shape[axis] + 2.0 * REACH))


@emit
def gather(
    to: Lanes,
    columns: Rows,
    runs: Rows,
    count: Any,
    query: Rows,
    reach: Any,
    radius: Any,
    cloud: Rows,
) -> float:
    """Collect the points within `reach` radii of a query, relative to it, in units of the radius.

    Returns
    -------
    float
        Their number n; ``cloud[0:3, :n]`` holds the coordinates, ``cloud[3, :n]`` the squared
        distances.
    """
    n = to.variable(to.integer(0))
    scale = to.spread(to.builder.fdiv(to.real(1.0), radius))
    limit = to.spread(to.builder.fmul(reach, reach))
    centre = [to.spread(to.get(query.at(axis))) for axis in range(3)]
    with to.count(0, count) as run:
        start, stop = to.get(runs.at(run, 0)), to.get(runs.at(run, 1))
        with to.count(start, stop, LANES) as i:
            p = [
                to.times(to.subtract(to.load(columns.at(axis, i)), centre[axis]), scale)
                for axis in range(3)
            ]
            squared = to.times(p[0], p[0])
            for x in p[1:]:
                squared = to.add(to.times(x, x), squared)
            near = to.builder.fcmp_ordered("<=", squared, limit)
            near = to.builder.and_(near, to.below(to.minus(stop, i)))
            at = to.get(n)
            to.pack([*p, squared], near, [cloud.at(row, at) for row in range(4)])
            to.put(to.plus(at, to.number(near)), n)
    return to.builder.sitofp(to.get(n), to.real(0.0).type)


@inner
def gather_listed(
    columns: Array, members: IntArray, query: Array, radius: float, cloud: Array
) -> int:
    """Collect the listed points as `gather` does; returns their number."""
    scale = 1.0 / radius
    for j in range(len(members)):
        i = members[j]
        x = (columns[0, i] - query[0]) * scale
        y = (columns[1, i] - query[1]) * scale
        z = (columns[2, i] - query[2]) * scale
        cloud[0, j] = x
        cloud[1, j] = y
        cloud[2, j] = z
        # The last of them gave the radius, and rounding must not put it outside.
        cloud[3, j] = min(x * x + y * y + z * z, 1.0)
    return len(members)


def _cell_numbers(points: Any, corner: Any, cell: float, shape: Any) -> Any:
    number = np.zeros(len(points), np.int64)
    for axis, column in enumerate(points.T):
        at = np.clip(np.floor((column - corner[axis]) / cell), 0, shape[axis] - 1)
        number = number * shape[axis] + at.astype(np.int64)
    return number


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
        Which point stands where: ``grid.columns[:, :P] = points[order].T``.
    """
    corner = lowest(points)
    extent = highest(points) - corner
    # 2^20 cells an axis keep the cell number within 63 bits; larger cells are slower, not wrong.
    cell = max(radius / REACH, float(extent.max()) / 2**20)
    shape = np.floor(extent / cell).astype(np.int64) + 1
    key = _cell_numbers(points, corner, cell, shape)
    order = np.argsort(key, kind="stable")
    key = key[order]
    first = np.flatnonzero(np.diff(key, prepend=key[0] - 1))
    starts = np.append(first, len(points)).astype(np.int64)
    columns = np.zeros((3, len(points) + LANES))
    columns[:, : len(points)] = points[order].T
    return Grid(columns, key[first], starts, shape, corner, cell), order


def cell_order(grid: Grid, queries: Any) -> Any:
    """Return the (Q,) order that visits queries by cell; those outside go to the nearest cell."""
    key = _cell_numbers(queries, grid.corner, grid.cell, grid.shape)
    return np.argsort(key, kind="stable")
