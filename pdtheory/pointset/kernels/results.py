"""What the kernels hand over: jets, directions, and both together."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np


class Jets(NamedTuple):
    """Fits of Q points, J orders.

    Attributes
    ----------
    frames : (Q, 3, 3) float64
        Frames handed out.
    degree, neighbours, status : (Q,) int64
        Degree used, points within the radius, flags.
    residual, noise, condition : (Q,) float64
        Root mean square residual and standard deviation of the heights that the error bars rest on,
        in world units; smallest relative pivot.
    phi : (Q, M) complex128
        All Wavejets coefficients in these frames, in world units.
    turn : (Q, 2) float64
        Cosine and sine of the angle of t1 in the frame of the fit.
    blur : (Q, J) float64
        Size that rounding may give to the coefficients of an order, in units of the radius.
    covariance : (Q, sum of (k + 1)^2) float64
        For each order the covariance of c_{k-b,b} in the frame of the fit, in units of the radius.
    """

    frames: Any
    degree: Any
    neighbours: Any
    residual: Any
    noise: Any
    condition: Any
    status: Any
    phi: Any
    turn: Any
    blur: Any
    covariance: Any


def make_jets(size: int, orders: Any, columns: int, covariance: Any) -> Jets:
    """Allocate results for `size` points, but for the covariances."""
    return Jets(
        np.full((size, 3, 3), np.nan),
        np.zeros(size, np.int64),
        np.zeros(size, np.int64),
        np.full(size, np.nan),
        np.full(size, np.nan),
        np.full(size, np.nan),
        np.zeros(size, np.int64),
        np.full((size, columns), np.nan, np.complex128),
        np.empty((size, 2)),
        np.empty((size, len(orders))),
        covariance,
    )


#: Columns of the rows of directions; what they hold is told by :class:`OrderDirections`.
ANGLE, VECTOR, EIGENVALUE, STRENGTH = 0, 1, 4, 5
ANGLE_STD, EIGENVALUE_STD, KIND, COLUMNS = 6, 7, 8, 9


class Directions(NamedTuple):
    """Directions of Q points, J orders.

    Attributes
    ----------
    counts : (J, Q) int64
        Number of directions.
    isotropic : (J, Q) bool
        Where an order is constant.
    rows : (M, COLUMNS) float64
        The directions; those of order j of all points follow one another from row ``base[j]``.
    """

    counts: Any
    isotropic: Any
    rows: Any


def make_directions(size: int, orders: Any) -> Directions:
    """Allocate results for `size` points."""
    return Directions(
        np.zeros((len(orders), size), np.int64),
        np.zeros((len(orders), size), np.bool_),
        np.empty((size * int(2 * orders.sum()), COLUMNS)),
    )


class Output(NamedTuple):
    """Results of one chunk."""

    jets: Jets
    directions: Directions
