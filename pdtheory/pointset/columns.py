"""Reductions of (P, 3) arrays by columns, many times faster than NumPy's along a short axis."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from pdtheory.pointset.cloud import FloatArray


def lowest(points: FloatArray) -> FloatArray:
    """Return the (3,) smallest coordinates."""
    return np.array([column.min() for column in points.T])


def highest(points: FloatArray) -> FloatArray:
    """Return the (3,) largest coordinates."""
    return np.array([column.max() for column in points.T])


def finite_rows(points: FloatArray) -> npt.NDArray[np.bool_]:
    """Return which of the (P,) rows are finite."""
    x, y, z = (np.isfinite(column) for column in points.T)
    return x & y & z
