"""Chunks of results put together in the order of the points."""

from __future__ import annotations

import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from pdtheory.conventions import wavejets_table
from pdtheory.pointset.cloud import FloatArray, IntArray
from pdtheory.pointset.directions import OrderDirections
from pdtheory.pointset.engine import Engine
from pdtheory.pointset.field import DirectionField
from pdtheory.pointset.kernels import results
from pdtheory.pointset.kernels.results import COLUMNS, place
from pdtheory.pointset.pool import Flag
from pdtheory.pointset.selection import Selector

#: Rows in a block of memory. Where the system has large pages it takes them for so large a block,
#: which cost far less to touch first.
BLOCK = 2**17


class _Store:
    """Keeps copies of rows; several threads may use it."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._free = np.empty((0, COLUMNS))

    def keep(self, rows: FloatArray) -> FloatArray:
        """Return a copy."""
        with self._lock:
            if len(self._free) < len(rows):
                self._free = np.empty((max(BLOCK, len(rows)), COLUMNS))
            copy, self._free = self._free[: len(rows)], self._free[len(rows) :]
        copy[:] = rows
        return copy


class Collector:
    """Takes the results of chunks in any order and makes a :class:`DirectionField` of them.

    Parameters
    ----------
    engine : Engine or Selector
        Computes them.
    points : (Q, 3) float64
        Where the directions are computed.
    degree : int
        Degree asked for, which gives the columns of phi.
    """

    def __init__(self, engine: Engine | Selector, points: FloatArray, degree: int) -> None:
        self._engine = engine
        self._points = points
        self._table = np.array(wavejets_table(degree), dtype=np.int64)
        self._found = engine.make_found(len(points))
        self._store = _Store()
        self._chunks: list[tuple[IntArray, list[FloatArray]]] = []

    def compute(self, where: IntArray, flag: Flag, slots: IntArray) -> None:
        """Compute the queries `where`, which are the points `slots`; several threads may do so."""
        rows = self._store.keep(self._engine.work(where, flag, slots, self._found))
        ends = np.cumsum(np.maximum(self._found.counts[:, slots], 0).sum(axis=1))
        self._chunks.append((slots, np.split(rows, ends[:-1])))

    def field(self, threads: int = 1) -> DirectionField:
        """Return everything that was added as one field.

        Parameters
        ----------
        threads : int
            Threads to put the orders together in.
        """
        with ThreadPoolExecutor(threads) as pool:
            orders = list(pool.map(self._directions, range(len(self._engine.orders))))
        found = self._found
        return DirectionField(
            points=self._points,
            frames=found.numbers[:, results.FRAME : results.FRAME + 9].reshape(-1, 3, 3),
            radius=found.column(results.RADIUS),
            degree=found.integers(results.DEGREE),
            neighbours=found.integers(results.NEIGHBOURS),
            residual_rms=found.column(results.RESIDUAL),
            condition=found.column(results.CONDITION),
            status=found.integers(results.STATUS),
            phi=found.phi,
            phi_order=self._table[:, 0],
            phi_frequency=self._table[:, 1],
            directions={order.order: order for order in orders},
        )

    def _directions(self, j: int) -> OrderDirections:
        """Return the directions of one order."""
        counts = self._found.counts[j]
        order = int(self._engine.orders[j])
        offsets = np.concatenate(([0], np.cumsum(2 * np.maximum(counts, 0))))
        total = int(offsets[-1])
        numbers = np.empty((results.VECTOR, total))
        vectors, kinds = np.empty((total, 3)), np.empty(total, np.int8)
        for slots, rows in self._chunks:
            place(rows[j], order % 2 == 1, slots, offsets, numbers, vectors, kinds)
        return OrderDirections(
            order=order,
            offsets=offsets,
            vector=vectors,
            kind=kinds,
            isotropic=counts < 0,
            angle=numbers[results.ANGLE],
            eigenvalue=numbers[results.EIGENVALUE],
            strength=numbers[results.STRENGTH],
            angle_std=numbers[results.ANGLE_STD],
            eigenvalue_std=numbers[results.EIGENVALUE_STD],
        )
