"""Blue noise: subsets of points that keep their distance."""

from __future__ import annotations

import heapq

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
    pairs = tree.query_pairs(reach, output_type="ndarray")
    distance = np.linalg.norm(points[pairs[:, 0]] - points[pairs[:, 1]], axis=1)
    weight = (1.0 - distance / reach) ** _ALPHA
    ends = np.concatenate([pairs[:, 0], pairs[:, 1]])
    others = np.concatenate([pairs[:, 1], pairs[:, 0]])
    order = np.argsort(ends, kind="stable")
    start = np.concatenate(([0], np.cumsum(np.bincount(ends, minlength=len(points))))).tolist()
    neighbour, share = others[order].tolist(), np.concatenate([weight, weight])[order].tolist()
    load = np.bincount(ends, np.concatenate([weight, weight]), len(points)).tolist()
    heap = [(-value, index) for index, value in enumerate(load)]
    heapq.heapify(heap)
    alive = np.ones(len(points), dtype=bool)
    left = len(points)
    while left > count:
        value, index = heapq.heappop(heap)
        if not alive[index] or -value != load[index]:
            continue
        alive[index] = False
        left -= 1
        for place in range(start[index], start[index + 1]):
            other = neighbour[place]
            if alive[other]:
                load[other] -= share[place]
                heapq.heappush(heap, (-load[other], other))
    return np.flatnonzero(alive)
