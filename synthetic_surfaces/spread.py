"""Blue noise: subsets of points that keep their distance."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray, IntArray

#: Candidates for each point that is kept.
OVERSAMPLING = 5

#: Exponent of the weight by distance.
_ALPHA = 8


def thin(points: FloatArray, count: int, area: float | None = None) -> IntArray:
    """Choose `count` points that are spread as evenly as possible, by sample elimination.

    The point with the largest weight sum_j (1 - d_ij / (2 r))^8 over its neighbours within 2 r goes
    first, until `count` remain; r is the radius of the densest packing of discs on the area.

    Parameters
    ----------
    points : (P, 3) float64
        Candidates, dense against the result.
    count
        Number of points to keep, at most P.
    area
        Area of the surface they lie on; estimated from the spacing of the candidates if not given.

    Returns
    -------
    (count,) int64
        Indices of the points kept, ascending.

    Raises
    ------
    InputError
        If `count` is not between 1 and P.

    References
    ----------
    C. Yuksel, "Sample elimination for generating Poisson disk sample sets", Computer Graphics
    Forum 34 (2015).
    """
    if not 1 <= count <= len(points):
        raise InputError(f"cannot choose {count} of {len(points)} points.")
    tree = cKDTree(points)
    if area is None:
        # Points drawn at random with density d have a mean nearest distance of 1 / (2 sqrt d).
        nearest, _ = tree.query(points, k=[2])
        area = len(points) * 4.0 * float(np.mean(nearest)) ** 2
    reach = 2.0 * np.sqrt(area / (2.0 * np.sqrt(3.0) * count))
    one, two = tree.query_pairs(reach, output_type="ndarray").T
    distance = np.linalg.norm(points[one] - points[two], axis=1)
    return _eliminate(one, two, (1.0 - distance / reach) ** _ALPHA, len(points), count)


def _eliminate(one: IntArray, two: IntArray, share: FloatArray, total: int, count: int) -> IntArray:
    """Return which points are left if the one with the largest load goes first, again and again.

    A point whose load is above that of all its neighbours goes before any of them, whatever happens
    elsewhere, since loads only fall. So all such points go in one round, with the loads that they
    would have in turn. These fall from one to the next, so those that were to go first are those
    with the largest; once enough of them are above every load that is left, all is decided.

    Parameters
    ----------
    one, two : (M,) int64
        The pairs of neighbours.
    share : (M,) float64
        What each of a pair adds to the load of the other.
    total, count
        Number of points, and of those to be left.
    """
    load = np.bincount(one, share, total) + np.bincount(two, share, total)
    alive = np.ones(total, dtype=bool)
    last = np.full(total, -np.inf)
    while (last > load[alive].max(initial=-np.inf)).sum() < total - count:
        higher = (load[one] > load[two]) | ((load[one] == load[two]) & (one < two))
        highest = alive.copy()
        highest[np.where(higher, two, one)] = False
        last[highest] = load[highest]
        alive &= ~highest
        first, second = highest[one], highest[two]
        load -= np.bincount(two[first], share[first], total)
        load -= np.bincount(one[second], share[second], total)
        kept = ~(first | second)
        one, two, share = one[kept], two[kept], share[kept]
    left = np.ones(total, dtype=bool)
    left[np.argsort(-last, kind="stable")[: total - count]] = False
    return np.flatnonzero(left)
