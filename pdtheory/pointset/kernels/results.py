"""What the kernels hand over: what is found at each point, and the rows of its directions."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from pdtheory.pointset.kernels.jit import Array, IntArray, inner, kernel
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


@inner
def scale_of_order(radius: float, order: int) -> float:
    """Return R^(k-1), which makes coefficients of order k dimensionless."""
    scale = 1.0
    for _ in range(order - 1):
        scale *= radius
    return scale


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


#: Columns of the rows of directions, which stand order by order and, in each, point by point: the
#: angle, its cosine and sine, g_k in units of the radius, the kind; with error bars also standard
#: deviations of angle and E-eigenvalue. Only directions of the half circle have rows.
ANGLE, COSINE, SINE, VALUE, KIND, PLAIN = range(6)
ANGLE_STD, EIGENVALUE_STD, COLUMNS = 5, 6, 7


def row_columns(uncertainty: bool) -> int:
    """Return the number of columns of the rows."""
    return COLUMNS if uncertainty else PLAIN


@kernel
def place(
    rows: Array,
    order: int,
    factorial: float,
    firsts: IntArray,
    offsets: IntArray,
    points: Array,
    angles: Array,
    values: Array,
    vectors: Array,
    kinds: Any,
    deviations: Array,
) -> None:
    """Bring rows to where they belong: at each point the half circle, then the opposite directions.

    Parameters
    ----------
    rows : (>= sum of counts, PLAIN or COLUMNS) float64
        Directions of one order at Q points; those of a point follow one another.
    order : int
        The order k.
    factorial : float
        k!.
    firsts : (Q,) int64
        Which row is the first of each point.
    offsets : (Q + 1,) int64
        The directions of point q are the entries offsets[q]..offsets[q + 1] of what follows.
    points : (Q, NUMBERS) float64
        The numbers of the points.
    angles : (M,) float64
        Receives the angles.
    values : (2, M) float64
        Receives E-eigenvalues and strengths.
    vectors : (M, 3) float64
        Receives the vectors.
    kinds : (M,) int8
        Receives the kinds.
    deviations : (2, M) float64
        Receives the standard deviations, if the rows have them.
    """
    odd = order % 2 == 1
    uncertain = rows.shape[1] > PLAIN
    for q in range(len(firsts)):
        count = (offsets[q + 1] - offsets[q]) // 2
        unit = factorial / scale_of_order(points[q, RADIUS], order)
        for half in range(2):
            way = 1.0 - 2.0 * half
            sign = way if odd else 1.0
            to = offsets[q] + half * count
            for row in range(firsts[q], firsts[q] + count):
                c = way * rows[row, COSINE]
                s = way * rows[row, SINE]
                for axis in range(3):
                    first = points[q, FRAME + axis]
                    vectors[to, axis] = c * first + s * points[q, FRAME + 3 + axis]
                angles[to] = rows[row, ANGLE] + half * np.pi
                value = sign * rows[row, VALUE]
                values[0, to] = value * unit
                values[1, to] = abs(value)
                kinds[to] = np.int8(sign * rows[row, KIND])
                if uncertain:
                    deviations[0, to] = rows[row, ANGLE_STD]
                    deviations[1, to] = rows[row, EIGENVALUE_STD]
                to += 1
