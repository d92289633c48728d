"""Chunks of results put together in the order of the points."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np

from pdtheory.conventions import wavejets_table
from pdtheory.pointset.cloud import FloatArray, IntArray
from pdtheory.pointset.directions import OrderDirections
from pdtheory.pointset.field import DirectionField
from pdtheory.pointset.kernels import results
from pdtheory.pointset.kernels.results import Output

#: Columns of numbers among those of the rows.
_COLUMNS = {
    "angle": results.ANGLE,
    "eigenvalue": results.EIGENVALUE,
    "strength": results.STRENGTH,
    "angle_std": results.ANGLE_STD,
    "eigenvalue_std": results.EIGENVALUE_STD,
}


class Collector:
    """Takes chunks in any order and makes a :class:`DirectionField` of them.

    Parameters
    ----------
    points : (Q, 3) float64
        Where the directions are computed.
    radius : (Q,) float64
        Radius at each; filled in by the chunks.
    degree : int
        Degree asked for, which gives the columns of phi.
    orders : (J,) int64
        The orders.
    """

    def __init__(self, points: FloatArray, degree: int, orders: IntArray) -> None:
        size = len(points)
        self._points = points
        self._orders = orders
        self._table = np.array(wavejets_table(degree), dtype=np.int64)
        self._radius = np.empty(size)
        self._frames = np.empty((size, 3, 3))
        self._degree = np.empty(size, np.int64)
        self._neighbours = np.empty(size, np.int64)
        self._residual = np.empty(size)
        self._condition = np.empty(size)
        self._status = np.empty(size, np.int64)
        self._phi = np.empty((size, len(self._table)), np.complex128)
        self._counts = np.empty((len(orders), size), np.int64)
        self._isotropic = np.empty((len(orders), size), np.bool_)
        self._chunks: list[tuple[IntArray, FloatArray, IntArray]] = []

    def add(self, where: IntArray, radii: FloatArray, output: Output, base: IntArray) -> None:
        """Take the results for the queries `where`."""
        jets, found = output
        self._radius[where] = radii
        self._frames[where] = jets.frames
        self._degree[where] = jets.degree
        self._neighbours[where] = jets.neighbours
        self._residual[where] = jets.residual
        self._condition[where] = jets.condition
        self._status[where] = jets.status
        self._phi[where] = jets.phi
        self._counts[:, where] = found.counts
        self._isotropic[:, where] = found.isotropic
        # The rows are not copied: what a chunk has not used of them takes no memory.
        self._chunks.append((where, found.rows, base))

    def field(self, threads: int = 1) -> DirectionField:
        """Return everything that was added as one field.

        Parameters
        ----------
        threads : int
            Threads to put the orders together in.
        """
        with ThreadPoolExecutor(threads) as pool:
            found = list(pool.map(self._directions, range(len(self._orders))))
        return DirectionField(
            points=self._points,
            frames=self._frames,
            radius=self._radius,
            degree=self._degree,
            neighbours=self._neighbours,
            residual_rms=self._residual,
            condition=self._condition,
            status=self._status,
            phi=self._phi,
            phi_order=self._table[:, 0],
            phi_frequency=self._table[:, 1],
            directions={order.order: order for order in found},
        )

    def _directions(self, j: int) -> OrderDirections:
        """Return the directions of one order."""
        counts = self._counts[j]
        offsets = np.concatenate(([0], np.cumsum(counts))).astype(np.int64)
        total = int(offsets[-1])
        columns = {name: np.empty(total) for name in _COLUMNS}
        vector, kind = np.empty((total, 3)), np.empty(total, np.int8)
        for where, rows, base in self._chunks:
            here = counts[where]
            last = np.cumsum(here)
            target = np.repeat(offsets[where] - last + here, here) + np.arange(int(here.sum()))
            rows = rows[base[j] : base[j] + len(target)]
            for name, number in _COLUMNS.items():
                columns[name][target] = rows[:, number]
            vector[target] = rows[:, results.VECTOR : results.VECTOR + 3]
            kind[target] = rows[:, results.KIND]
        return OrderDirections(
            order=int(self._orders[j]),
            offsets=offsets,
            vector=vector,
            kind=kind,
            isotropic=self._isotropic[j],
            **columns,
        )
