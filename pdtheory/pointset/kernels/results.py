"""What the kernels hand over: what is found at each point, and the rows of its directions."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from pdtheory.pointset.kernels.jit import Array, IntArray, kernel


class Found(NamedTuple):
    """What is found at Q points in J orders.

    Attributes
    ----------
    frames : (Q, 3, 3) float64
        Frames handed out.
    radius : (Q,) float64
        Radius of the neighbourhood.
    degree, neighbours, status : (Q,) int64
        Degree used, points within the radius, flags.
    residual, noise, condition : (Q,) float64
        Root mean square residual and standard deviation of the heights that the error bars rest on,
        in world units; smallest relative pivot.
    phi : (Q, M) complex128
        All Wavejets coefficients in these frames, in world units.
    counts : (J, Q) int64
        Number of directions on the half circle.
    isotropic : (J, Q) bool
        Where an order is constant.
    """

    frames: Any
    radius: Any
    degree: Any
    neighbours: Any
    residual: Any
    noise: Any
    condition: Any
    status: Any
    phi: Any
    counts: Any
    isotropic: Any


def make_found(size: int, orders: int, columns: int) -> Found:
    """Allocate what the kernels fill in for `size` points, with any contents."""
    return Found(
        np.empty((size, 3, 3)),
        np.empty(size),
        np.empty(size, np.int64),
        np.empty(size, np.int64),
        np.empty(size),
        np.empty(size),
        np.empty(size),
        np.empty(size, np.int64),
        np.empty((size, columns), np.complex128),
        np.empty((orders, size), np.int64),
        np.empty((orders, size), np.bool_),
    )


class Traces(NamedTuple):
    """What the directions of Q points need to know of the fits beside their results.

    Attributes
    ----------
    turn : (Q, 2) float64
        Cosine and sine of the angle of t1 in the frame of the fit.
    blur : (Q, J) float64
        Size that rounding may give to the coefficients of an order, in units of the radius.
    covariance : (Q, sum of (k + 1)^2) float64
        For each order the covariance of c_{k-b,b} in the frame of the fit, in units of the radius;
        no columns without error bars.
    """

    turn: Any
    blur: Any
    covariance: Any


#: Columns of the rows of directions, which stand order by order and, in each, point by point. Only
#: those of the half circle have rows; what they hold is told by :class:`OrderDirections`.
ANGLE, VECTOR, EIGENVALUE, STRENGTH = 0, 1, 4, 5
ANGLE_STD, EIGENVALUE_STD, KIND, COLUMNS = 6, 7, 8, 9


class Columns(NamedTuple):
    """The same directions of one order column by column, (M,) each but for ``vector``, (M, 3)."""

    angle: Any
    vector: Any
    eigenvalue: Any
    strength: Any
    angle_std: Any
    eigenvalue_std: Any
    kind: Any


def make_columns(size: int) -> Columns:
    """Allocate the columns of `size` directions, with any contents."""
    return Columns(
        np.empty(size),
        np.empty((size, 3)),
        np.empty(size),
        np.empty(size),
        np.empty(size),
        np.empty(size),
        np.empty(size, np.int8),
    )


@kernel
def place(rows: Array, odd: bool, slots: IntArray, offsets: IntArray, out: Columns) -> None:
    """Bring rows to the columns: at each point those of the half circle, then the opposite ones.

    Parameters
    ----------
    rows : (>= sum of counts, COLUMNS) float64
        Directions of one order at the points of a chunk.
    odd : bool
        Whether the order is odd, so that opposite directions have opposite eigenvalues.
    slots : (C,) int64
        These points.
    offsets : (Q + 1,) int64
        The directions of point q are the entries offsets[q]..offsets[q + 1] of the columns.
    out : Columns
        Receives them.
    """
    first = 0
    for slot in slots:
        count = (offsets[slot + 1] - offsets[slot]) // 2
        for half in range(2):
            way = -1.0 if half else 1.0
            sign = way if odd else 1.0
            to = offsets[slot] + half * count
            for row in range(first, first + count):
                out.angle[to] = rows[row, ANGLE] + half * np.pi
                for axis in range(3):
                    out.vector[to, axis] = way * rows[row, VECTOR + axis]
                out.eigenvalue[to] = sign * rows[row, EIGENVALUE]
                out.strength[to] = rows[row, STRENGTH]
                out.angle_std[to] = rows[row, ANGLE_STD]
                out.eigenvalue_std[to] = rows[row, EIGENVALUE_STD]
                out.kind[to] = np.int8(sign * rows[row, KIND])
                to += 1
        first += count
