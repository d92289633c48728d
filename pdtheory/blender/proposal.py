"""A radius to begin with, from the spacing of the points."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray

#: Points that are looked at.
_PROBES = 1000


def propose_radius(points: FloatArray, degree: int) -> float:
    """Return the radius within which half of the points have twice the neighbours a fit needs.

    A polynomial of degree K in two variables has (K + 1)(K + 2)/2 coefficients.

    Parameters
    ----------
    points : (P, 3) float64
        Positions.
    degree
        Degree K of the fit.

    Raises
    ------
    InputError
        If there are fewer than two finite points, or all are equal.
    """
    finite = points[np.isfinite(points).all(axis=1)]
    wanted = min((degree + 1) * (degree + 2), len(finite))
    if wanted < 2:
        raise InputError(f"{len(finite)} finite points have no spacing; give at least two.")
    probes = finite[:: max(1, len(finite) // _PROBES)]
    distance, _ = cKDTree(finite).query(probes, k=wanted)
    radius = float(np.median(np.asarray(distance)[:, -1]))
    if radius <= 0.0:
        raise InputError("all points are equal; they have no spacing.")
    return radius
