"""What the kernels hand over: what is found at each point, and the rows of its directions."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from pdtheory.pointset.kernels.jit import Array, IntArray, kernel
from pdtheory.pointset.kernels.lanes import LANES

#: Columns of the numbers of a point: the frame that is handed out, row by row; radius, degree used,
#: points within the radius; root mean square of the residuals and standard deviation of the heights
#: that the error bars rest on, in world units; smallest relative pivot; status flags.
FRAME, RADIUS, DEGREE, NEIGHBOURS = 0, 9, 10, 11
RESIDUAL, NOISE, CONDITION, STATUS, NUMBERS = 12, 13, 14, 15, 16


class Found(NamedTuple):
    """What is found at Q points in J orders.

    The numbers of a point stand side by side, since a run visits the points in its own order.

    Attributes
    ----------
    numbers : (Q, NUMBERS) float64
        The columns named above.
    phi : (Q, M) complex128
        All Wavejets coefficients in these frames, in world units.
    counts : (J, Q) int64
        Number of directions on the half circle; -1 where an order is constant.
    """

    numbers: Any
    phi: Any
    counts: Any

    def column(self, number: int) -> Any:
        """Return one of the columns, shape (Q,)."""
        return self.numbers[:, number].copy()

    def integers(self, number: int) -> Any:
        """Return one of the columns as int64, shape (Q,)."""
        return self.numbers[:, number].astype(np.int64)

    def lengths(self, slots: Any = slice(None)) -> Any:
        """(J, C) int64: directions on the half circle, 0 where an order is constant."""
        return np.maximum(self.counts[:, slots], 0)


def make_found(size: int, orders: int, columns: int) -> Found:
    """Allocate what the kernels fill in for `size` points, with any contents."""
    return Found(
        np.empty((size, NUMBERS)),
        np.empty((size, columns), np.complex128),
        np.empty((orders, size), np.int64),
    )


#: Numbers behind the covariances of a point that may be read and overwritten.
SPARE = 2 * LANES


class Traces(NamedTuple):
    """What the directions of Q points need to know of the fits beside their results.

    Attributes
    ----------
    turn : (Q, 2) float64
        Cosine and sine of the angle of t1 in the frame of the fit.
    blur : (Q, J) float64
        Size that rounding may give to the coefficients of an order, in units of the radius.
    covariance : (Q, sum of (k + 1)^2 + SPARE) float64
        For each order the covariance of c_{k-b,b} in the frame of the fit, in units of the radius,
        row by row; no columns without error bars.
    """

    turn: Any
    blur: Any
    covariance: Any


#: Columns of the rows of directions, which stand order by order and, in each, point by point. Only
#: those of the half circle have rows; what they hold is told by :class:`OrderDirections`.
ANGLE, EIGENVALUE, STRENGTH, ANGLE_STD, EIGENVALUE_STD = range(5)
VECTOR, KIND, COLUMNS = 5, 8, 9


@kernel
def place(
    rows: Array,
    odd: bool,
    firsts: IntArray,
    offsets: IntArray,
    numbers: Array,
    vectors: Array,
    kinds: Any,
) -> None:
    """Bring rows to where they belong: at each point the half circle, then the opposite directions.

    Parameters
    ----------
    rows : (>= sum of counts, COLUMNS) float64
        Directions of one order at Q points; those of a point follow one another.
    odd : bool
        Whether the order is odd, so that opposite directions have opposite eigenvalues.
    firsts : (Q,) int64
        Which row is the first of each point.
    offsets : (Q + 1,) int64
        The directions of point q are the entries offsets[q]..offsets[q + 1] of what follows.
    numbers : (VECTOR, M) float64
        Receives the first columns.
    vectors : (M, 3) float64
        Receives the vectors.
    kinds : (M,) int8
        Receives the kinds.
    """
    for q in range(len(firsts)):
        count = (offsets[q + 1] - offsets[q]) // 2
        for half in range(2):
            way = 1.0 - 2.0 * half
            sign = way if odd else 1.0
            to = offsets[q] + half * count
            for row in range(firsts[q], firsts[q] + count):
                for column in range(VECTOR):
                    numbers[column, to] = rows[row, column]
                numbers[ANGLE, to] += half * np.pi
                numbers[EIGENVALUE, to] *= sign
                for axis in range(3):
                    vectors[to, axis] = way * rows[row, VECTOR + axis]
                kinds[to] = np.int8(sign * rows[row, KIND])
                to += 1
