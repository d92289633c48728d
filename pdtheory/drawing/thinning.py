"""Choose which points carry strokes, so that a dense field stays readable.

Every point gets a *spacing*: the points of spacing at least s form a Poisson-disk sample, in which
no two are closer than s and none is much farther than s from the sample. Keeping `spacing >= s`
thins to any density at once, also live in a modifier, without computing again.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from pdtheory.pointset.cloud import FloatArray, IntArray

#: Each level of the sample is this much finer than the one before.
_RATIO = 2.0 ** (-1.0 / 6.0)

#: Beyond so many points spots are not told apart in a picture; the rest comes in random order.
SPOTS = 20_000

#: So many points, taken at random, are enough to find those spots among.
_POOL = 5 * SPOTS

#: A spot's turn is chosen from so many random offers to differ from so many spots around it.
_OFFERS, _AROUND = 12, 6


@dataclass(frozen=True)
class Spots:
    """The order in which points are taken as a picture gets denser.

    Attributes
    ----------
    spacing : (P,) float64
        Distance to which the point is separated from all points of larger or equal spacing.
    turn : (P,) float64
        In [0, 1), far from the turns of the spots around: ``floor(turn * m)`` deals m orders to
        the spots so that neighbours differ.
    even : (P,) float64, optional
        Spacings that `spacing_for` counts by: those of a selection of all points, where `spacing`
        prefers some.
    """

    spacing: FloatArray
    turn: FloatArray
    even: FloatArray | None = None

    def spacing_for(self, count: int) -> float:
        """Return the spacing at which about `count` points are kept: all where there are fewer.

        It is 0 if no point has a spacing.
        """
        counted = self.spacing if self.even is None else self.even
        finite = np.sort(counted[counted > 0.0])[::-1]
        if count >= len(finite):
            return float(finite[-1]) if len(finite) else 0.0
        return float(finite[count - 1])


def choose_spots(
    points: FloatArray,
    usable: npt.NDArray[np.bool_] | None = None,
    *,
    preference: npt.NDArray[np.generic] | None = None,
    most: int = SPOTS,
    finest: float = 0.0,
    seed: int = 0,
) -> Spots:
    """Rank points by spacing and deal them turns.

    Parameters
    ----------
    points : (P, 3) float64
        Positions.
    usable : (P,) bool, optional
        Points that may carry strokes; the others get spacing 0.
    preference : (P,) array, optional
        Of points close together, compared to the distance of spots, the one with the largest value
        is taken.
    most
        So many points are apart from each other as their spacing says; the rest comes in random
        order.
    finest
        Spacings below this need not be told apart.
    seed
        Seed of the random choices; the same seed gives the same spots.

    Returns
    -------
    Spots
        Spacings and turns of all points.
    """
    count = len(points)
    good = np.isfinite(points).all(axis=1)
    if usable is not None:
        good &= usable
    index = np.flatnonzero(good)
    spacing = np.zeros(count)
    turn = np.zeros(count)
    if not len(index):
        return Spots(spacing, turn)
    random = np.random.default_rng(seed)
    index = random.permutation(index)
    pool = index[:_POOL]
    if preference is not None:
        pool = pool[np.argsort(-preference[pool].astype(np.float64), kind="stable")]
    chosen, reach, turns = _progressive_sample(points[pool], random, most, finest)
    spacing[pool[chosen]] = reach
    turn[pool[chosen]] = turns
    left = index[spacing[index] == 0.0]
    # On a surface the number of spots grows as 1/spacing^2.
    base = min(reach[-1], finest) if finest > 0.0 else reach[-1]
    spacing[left] = base * np.sqrt(len(chosen) / (len(chosen) + 1 + np.arange(len(left))))
    turn[left] = random.random(len(left))
    return Spots(spacing, turn)


def _progressive_sample(
    points: FloatArray, random: np.random.Generator, most: int, finest: float
) -> tuple[IntArray, FloatArray, FloatArray]:
    """Return indices of a progressive Poisson-disk sample, the radius of each, and its turn."""
    low, high = points.min(axis=0), points.max(axis=0)
    diagonal = float(np.linalg.norm(high - low)) or 1.0
    chosen = np.array([0])
    reach = np.array([diagonal])
    turn = random.random(1)
    waiting = np.arange(1, len(points))
    radius = diagonal / 2.0
    last = max(1e-9 * diagonal, finest * _RATIO)
    while len(chosen) < min(most, len(points)) and radius > last:
        # A point within the radius of a chosen one may be wanted at a finer level: it waits.
        candidates = waiting[_one_per_cell(points[waiting], low, radius / 2.0)]
        near, _ = cKDTree(points[chosen]).query(points[candidates], distance_upper_bound=radius)
        candidates = candidates[~np.isfinite(near)]
        accepted = candidates[_throw_darts(points[candidates], radius)]
        if len(accepted):
            chosen = np.concatenate((chosen, accepted))
            reach = np.concatenate((reach, np.full(len(accepted), radius)))
            turn = _deal_turns(points[chosen], turn, random)
            waiting = np.setdiff1d(waiting, accepted, assume_unique=True)
        radius *= _RATIO
    return chosen, reach, turn


def _one_per_cell(points: FloatArray, low: FloatArray, side: float) -> IntArray:
    """Return the index of the first point in every occupied cell of a grid."""
    cell = np.floor((points - low) / side).astype(np.int64)
    span = cell.max(axis=0) + 1 if len(cell) else np.ones(3, dtype=np.int64)
    key = (cell[:, 0] * span[1] + cell[:, 1]) * span[2] + cell[:, 2]
    return np.unique(key, return_index=True)[1].astype(np.int64)


def _throw_darts(points: FloatArray, radius: float) -> IntArray:
    """Return the points taken one after the other unless one within `radius` was taken before."""
    if not len(points):
        return np.empty(0, dtype=np.int64)
    pairs = cKDTree(points).query_pairs(radius, output_type="ndarray")
    both = np.concatenate((pairs, pairs[:, ::-1]))
    both = both[np.argsort(both[:, 0], kind="stable")]
    start = np.searchsorted(both[:, 0], np.arange(len(points) + 1))
    neighbours = both[:, 1]
    blocked = np.zeros(len(points), dtype=bool)
    taken = []
    for i in range(len(points)):
        if not blocked[i]:
            taken.append(i)
            blocked[neighbours[start[i] : start[i + 1]]] = True
    return np.array(taken, dtype=np.int64)


def _deal_turns(points: FloatArray, dealt: FloatArray, random: np.random.Generator) -> FloatArray:
    """Extend turns to new points at the end, each unlike those of the spots around it."""
    count, old = len(points), len(dealt)
    turn = np.concatenate((dealt, np.zeros(count - old)))
    _, found = cKDTree(points).query(points[old:], k=min(_AROUND, count))
    near = np.asarray(found)
    offers = random.random((count - old, _OFFERS))
    for i in range(old, count):
        offer, around = offers[i - old], np.atleast_1d(near[i - old])
        before = turn[around[around < i]]
        if len(before):
            apart = np.abs(offer[:, None] - before[None, :])
            turn[i] = offer[np.argmax(np.minimum(apart, 1.0 - apart).min(axis=1))]
    return turn
