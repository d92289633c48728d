"""Chunks of results put together in the order of the points."""

from __future__ import annotations

import threading
from concurrent.futures import ThreadPoolExecutor
from math import factorial

import numpy as np

from pdtheory.conventions import wavejets_table
from pdtheory.pointset.cloud import FloatArray, IntArray
from pdtheory.pointset.directions import OrderDirections
from pdtheory.pointset.engine import Engine
from pdtheory.pointset.field import DirectionField
from pdtheory.pointset.kernels import results
from pdtheory.pointset.kernels.results import place
from pdtheory.pointset.pool import Flag
from pdtheory.pointset.selection import Selector


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
        # As large as they can get; the system gives only what is written to.
        columns = results.row_columns(engine.settings.uncertainty)
        self._rows = {
            j: np.empty((len(points) * int(k), columns)) for j, k in enumerate(engine.orders)
        }
        self._used = np.zeros(len(engine.orders), np.int64)
        self._slots: list[IntArray] = []
        self._lock = threading.Lock()

    def compute(self, where: IntArray, flag: Flag, slots: IntArray) -> None:
        """Compute the queries `where`, which are the points `slots`; several threads may do so."""
        rows = self._engine.work(where, flag, slots, self._found)
        lengths = self._found.lengths(slots).sum(axis=1)
        with self._lock:
            starts = self._used.copy()
            self._used += lengths
            self._slots.append(slots)
        first = 0
        for kept, start, length in zip(self._rows.values(), starts, lengths, strict=True):
            kept[start : start + length] = rows[first : first + length]
            first += length

    def field(self, threads: int = 1) -> DirectionField:
        """Return everything that was added as one field; to be called once.

        Parameters
        ----------
        threads : int
            Threads to put the orders together in.
        """
        found = self._found
        slots = np.concatenate([np.empty(0, np.int64), *self._slots])
        lengths = found.lengths()
        with ThreadPoolExecutor(threads) as pool:
            numbers = range(len(lengths))
            orders = list(pool.map(lambda j: self._directions(j, lengths[j], slots), numbers))
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

    def _directions(self, j: int, lengths: IntArray, slots: IntArray) -> OrderDirections:
        """Return the directions of one order, whose rows were kept in the order of `slots`."""
        order = int(self._engine.orders[j])
        offsets = np.concatenate(([0], np.cumsum(2 * lengths)))
        firsts = np.zeros_like(lengths)
        firsts[slots] = np.cumsum(lengths[slots]) - lengths[slots]
        total = int(offsets[-1])
        # They go where they belong, and their memory serves the next order.
        rows = self._rows.pop(j)
        uncertain = rows.shape[1] == results.COLUMNS
        angles, values, vectors = np.empty(total), np.empty((2, total)), np.empty((total, 3))
        kinds, deviations = np.empty(total, np.int8), np.empty((2, total if uncertain else 0))
        points = self._found.numbers
        place(rows, order, float(factorial(order)), firsts, offsets, points,
              angles, values, vectors, kinds, deviations)  # fmt: skip
        unknown = np.broadcast_to(np.nan, total)
        return OrderDirections(
            order=order,
            offsets=offsets,
            vector=vectors,
            kind=kinds,
            isotropic=self._found.counts[j] < 0,
            angle=angles,
            eigenvalue=values[0],
            strength=values[1],
            angle_std=deviations[0] if uncertain else unknown,
            eigenvalue_std=deviations[1] if uncertain else unknown,
        )
