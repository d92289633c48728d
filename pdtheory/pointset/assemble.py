"""Chunks of results put together in the order of the points."""

from __future__ import annotations

from typing import Any

import numpy as np

from pdtheory.conventions import wavejets_table
from pdtheory.pointset.cloud import FloatArray, IntArray
from pdtheory.pointset.directions import ROW_ARRAYS, OrderDirections
from pdtheory.pointset.field import DirectionField
from pdtheory.pointset.kernels.chunk import Output


def order_rows(output: Output, base: IntArray, j: int) -> dict[str, Any]:
    """Return copies of the rows of order number j of one chunk, by name."""
    rows = slice(int(base[j]), int(base[j] + output.counts[j].sum()))
    return {name: getattr(output, name)[rows].copy() for name in ROW_ARRAYS}


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
        self._radius = np.zeros(size)
        self._frames = np.full((size, 3, 3), np.nan)
        self._degree = np.zeros(size, np.int64)
        self._neighbours = np.zeros(size, np.int64)
        self._residual = np.full(size, np.nan)
        self._condition = np.full(size, np.nan)
        self._status = np.zeros(size, np.int64)
        self._phi = np.full((size, len(self._table)), np.nan, np.complex128)
        self._counts = np.zeros((len(orders), size), np.int64)
        self._isotropic = np.zeros((len(orders), size), np.bool_)
        self._chunks: list[tuple[IntArray, list[dict[str, Any]]]] = []

    def add(self, where: IntArray, radii: FloatArray, output: Output, base: IntArray) -> None:
        """Take the results for the queries `where`."""
        self._radius[where] = radii
        self._frames[where] = output.frames
        self._degree[where] = output.degree
        self._neighbours[where] = output.neighbours
        self._residual[where] = output.residual
        self._condition[where] = output.condition
        self._status[where] = output.status
        self._phi[where] = output.phi
        self._counts[:, where] = output.counts
        self._isotropic[:, where] = output.isotropic
        rows = [order_rows(output, base, j) for j in range(len(self._orders))]
        self._chunks.append((where, rows))

    def field(self) -> DirectionField:
        """Return everything that was added as one field."""
        directions = {}
        for j, order in enumerate(self._orders):
            offsets = np.concatenate(([0], np.cumsum(self._counts[j]))).astype(np.int64)
            total = int(offsets[-1])
            arrays: dict[str, Any] = {
                name: np.empty(
                    (total, 3) if name == "vector" else total,
                    np.int8 if name == "kind" else np.float64,
                )
                for name in ROW_ARRAYS
            }
            for where, rows in self._chunks:
                counts = self._counts[j, where]
                first = np.cumsum(counts) - counts
                target = np.repeat(offsets[where] - first, counts) + np.arange(int(counts.sum()))
                for name in ROW_ARRAYS:
                    arrays[name][target] = rows[j][name]
            directions[int(order)] = OrderDirections(
                order=int(order), offsets=offsets, isotropic=self._isotropic[j], **arrays
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
