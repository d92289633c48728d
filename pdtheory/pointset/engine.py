"""One run of the estimator: the prepared input, and the work on one chunk of it."""

from __future__ import annotations

import threading
from collections.abc import Callable
from copy import copy
from typing import Any

import numpy as np
import numpy.typing as npt

from pdtheory.conventions import wavejets_table
from pdtheory.pointset.cloud import FloatArray, IntArray
from pdtheory.pointset.columns import finite_rows, highest, lowest
from pdtheory.pointset.kernels.chunk import fit_chunk
from pdtheory.pointset.kernels.directions import BENCH, find_directions
from pdtheory.pointset.kernels.fit import Settings
from pdtheory.pointset.kernels.grid import Grid, build_grid, cell_order
from pdtheory.pointset.kernels.results import (
    NEIGHBOURS,
    RADIUS,
    SPARE,
    Found,
    Traces,
    make_found,
    row_columns,
)
from pdtheory.pointset.kernels.tables import WORKSPACE, make_cloud, make_record, make_tables
from pdtheory.pointset.neighbourhoods import Choice, nearest, refuse_crowd
from pdtheory.pointset.pool import Flag
from pdtheory.pointset.trees import kd_tree

#: Points are collected this many radii around when the weights depend on the planar distance: the
#: face of a cube corner rises by sqrt(2) over the plane of the corner, so sqrt(3) radii see it all.
PLANAR_REACH = 1.75
#: Neighbours that memory is kept for at first.
_CAPACITY = 1024


class _Memory(threading.local):
    """What one thread works in, kept from chunk to chunk: fresh memory is slow to touch first."""

    def __init__(self) -> None:
        self.workspace = make_record(WORKSPACE)
        self.bench = make_record(BENCH)
        self.cloud = make_cloud(_CAPACITY)
        self._arrays: dict[str, FloatArray] = {}

    def array(self, name: str, size: int, columns: int) -> FloatArray:
        """Return an array of shape (size, columns) with any contents."""
        count = size * columns
        if name not in self._arrays or len(self._arrays[name]) < count:
            self._arrays[name] = np.empty(count)
        return self._arrays[name][:count].reshape(size, columns)


class Engine:
    """Points, queries and settings, ready for work in any thread.

    Parameters
    ----------
    points : (P, 3) float64
        Finite points, centred.
    queries : (Q, 3) float64
        Where to compute, in the same coordinates; may be non-finite.
    references : callable
        Returns (Q, 3) vectors on the side of the normals.
    choice : Choice
        The neighbourhoods.
    orders : (J,) int64
        Orders to compute.
    settings : Settings
        What is asked for.
    rounding : float
        Rounding error of the coordinates.

    Attributes
    ----------
    visit : (Q,) int64
        The order in which queries are visited: neighbours in space follow one another.
    points, choice, orders, settings
        As given.
    references : (Q, 3) float64
        What the call returned.
    queries : (Q, 3) float64
        As given, with zeros in place of those that are not finite.
    """

    def __init__(
        self,
        points: FloatArray,
        queries: FloatArray,
        references: Callable[[], FloatArray],
        choice: Choice,
        orders: IntArray,
        settings: Settings,
        rounding: float,
    ) -> None:
        self.choice = choice
        self.points = points
        self.orders = orders
        self.settings = settings
        self._rounding = rounding
        self._columns = len(wavejets_table(settings.degree))
        self._reach = PLANAR_REACH if settings.planar else 1.0
        extent = float((highest(points) - lowest(points)).max())
        if choice.radius is not None:
            size = choice.radius * self._reach
        else:
            assert choice.neighbours is not None
            size = extent * float(np.sqrt(choice.neighbours / len(points)))
        self._grid: Grid
        self._grid, order = build_grid(points, size)
        self._tree: Any = None
        if choice.radius is None:
            self._tree = kd_tree(points[order])
        else:
            refuse_crowd(int(np.diff(self._grid.starts).max()), choice)
        self._valid: npt.NDArray[np.bool_] = finite_rows(queries)
        self.queries = np.where(self._valid[:, None], queries, 0.0)
        self.references = references()
        same = np.array_equal(self.queries, points)
        self._memory = _Memory()
        self.visit = order if same else cell_order(self._grid, self.queries)

    def at_degree(self, degree: int) -> Engine:
        """Return an engine for the same points and neighbourhoods with another degree."""
        other = copy(self)
        other.settings = self.settings._replace(degree=degree)
        other._columns = len(wavejets_table(degree))
        return other

    def make_found(self, size: int) -> Found:
        """Allocate the results of `size` queries."""
        return make_found(size, len(self.orders), self._columns)

    def warm_up(self) -> None:
        """Compile or load the kernels in this thread, where Ctrl-C can interrupt that."""
        none = np.empty(0, np.int64)
        self.work(none, np.zeros(1, np.uint8), none, self.make_found(0))

    def work(self, where: IntArray, flag: Flag, slots: IntArray, found: Found) -> FloatArray:
        """Compute some queries.

        Parameters
        ----------
        where : (C,) int64
            Their numbers, best in the order of `visit`.
        flag : (1,) uint8
            Set to non-zero by another thread to end the work.
        slots : (C,) int64
            Where their results go.
        found : Found
            Receives them.

        Returns
        -------
        (M, PLAIN or COLUMNS) float64
            The directions of the half circle: order by order and, in each, query by query. The
            next call in this thread writes over them.
        """
        size = len(where)
        if self._tree is None:
            lists = np.empty((0, 0), np.int64)
            found.numbers[slots, RADIUS] = self.choice.radius
        else:
            radii, lists = nearest(self._tree, self.queries[where], self.choice.neighbours or 0)
            found.numbers[slots, RADIUS] = radii
        memory = self._memory
        entries = int(((self.orders + 1) ** 2).sum()) if self.settings.uncertainty else 0
        traces = Traces(
            memory.array("turn", size, 2),
            memory.array("blur", size, len(self.orders)),
            memory.array("covariance", size, entries + SPARE if entries else 0),
        )
        tables = make_tables()
        begin = 0
        while True:
            done = fit_chunk(
                self._grid,
                self.queries,
                self.references,
                self._valid,
                where,
                lists,
                self.orders,
                self._reach,
                self._rounding,
                self.settings,
                self.settings.robust or None,
                tables,
                memory.workspace,
                memory.cloud,
                flag,
                begin,
                traces,
                slots,
                found,
            )
            if done >= 0:
                break
            begin = -1 - done
            memory.cloud = make_cloud(2 * int(found.numbers[slots[begin], NEIGHBOURS]))
        columns = row_columns(self.settings.uncertainty)
        rows = memory.array("rows", size * int(self.orders.sum()), columns)
        count = find_directions(self.orders, tables, memory.bench, flag, traces, slots, found, rows)
        return rows[:count]
