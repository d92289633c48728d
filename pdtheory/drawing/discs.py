"""Points as discs that overlap, so that together they look like a closed surface."""

from __future__ import annotations

from typing import Final

import numpy as np
from scipy.spatial import cKDTree

from pdtheory.pointset.cloud import FloatArray

#: A disc reaches as far as the farthest of so many nearest points, itself among them,
_COVERED: Final = 8
#: but not farther than so many times the median, or an outlier would hide what is behind it.
_LARGEST: Final = 4.0


def disc_radii(points: FloatArray) -> FloatArray:
    """Return the radius of a disc about every point that closes the gaps to its neighbours.

    Parameters
    ----------
    points : (P, 3) float64
        Positions, finite; at least one.

    Returns
    -------
    (P,) float64
        Radii, positive. A point whose neighbours lie all in its place takes the median, or 1 if
        that is the case of most.
    """
    near, _ = cKDTree(points).query(points, k=min(_COVERED, len(points)))
    reach = np.asarray(near).reshape(len(points), -1)[:, -1]
    typical = float(np.median(reach)) or 1.0
    return np.minimum(np.where(reach > 0.0, reach, typical), _LARGEST * typical)
