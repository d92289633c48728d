"""Chunks of results put together in the order of the points."""

from __future__ import annotations

import numpy as np

from pdtheory.conventions import wavejets_table
from pdtheory.pointset.cloud import FloatArray, IntArray
from pdtheory.pointset.directions import OrderDirections
from pdtheory.pointset.field import DirectionField
from pdtheory.pointset.kernels import results
from pdtheory.pointset.kernels.results import Output


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
        self._where: list[IntArray] = []
        self._rows: list[list[FloatArray]] = [[] for _ in orders]

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
        self._where.append(where)
        for rows, first, count in zip(self._rows, base, found.counts.sum(axis=1), strict=True):
            rows.append(found.rows[first : first + count].copy())

    def field(self) -> DirectionField:
        """Return everything that was added as one field; the collector is empty afterwards."""
        # Place of each query among the chunks.
        place = np.empty(len(self._points), np.int64)
        place[np.concatenate([*self._where, np.empty(0, np.int64)])] = np.arange(len(place))
        directions = {}
        for j, order in enumerate(self._orders):
            counts = self._counts[j]
            offsets = np.concatenate(([0], np.cumsum(counts))).astype(np.int64)
            arrived = np.empty_like(counts)
            arrived[place] = counts
            first = (np.cumsum(arrived) - arrived)[place]
            source = np.repeat(first - offsets[:-1], counts) + np.arange(int(offsets[-1]))
            rows = np.concatenate([*self._rows[j], np.empty((0, results.COLUMNS))])
            self._rows[j].clear()
            rows = rows.take(source, axis=0)
            directions[int(order)] = OrderDirections(
                order=int(order),
                offsets=offsets,
                angle=rows[:, results.ANGLE].copy(),
                vector=rows[:, results.VECTOR : results.VECTOR + 3].copy(),
                eigenvalue=rows[:, results.EIGENVALUE].copy(),
                strength=rows[:, results.STRENGTH].copy(),
                kind=rows[:, results.KIND].astype(np.int8),
                angle_std=rows[:, results.ANGLE_STD].copy(),
                eigenvalue_std=rows[:, results.EIGENVALUE_STD].copy(),
                isotropic=self._isotropic[j],
            )
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
            directions=directions,
        )
