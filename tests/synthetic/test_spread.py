"""Blue noise against the same elimination, one point after the other."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.distance import cdist

from pdtheory.errors import InputError
from synthetic_surfaces.spread import thin


def one_by_one(points: np.ndarray, count: int, area: float) -> np.ndarray:
    """The definition: the largest sum of (1 - d / (2 r))^8 over the neighbours that are left."""
    reach = 2.0 * np.sqrt(area / (2.0 * np.sqrt(3.0) * count))
    share = np.maximum(1.0 - cdist(points, points) / reach, 0.0) ** 8
    np.fill_diagonal(share, 0.0)
    left = list(range(len(points)))
    while len(left) > count:
        left.pop(int(share[np.ix_(left, left)].sum(axis=1).argmax()))
    return np.array(left)


@pytest.mark.parametrize("count", [20, 40, 120, 199, 200])
def test_rounds_give_what_single_steps_give(count: int) -> None:
    # With fewer points left, those without neighbours tie, and rounding decides.
    points = np.random.default_rng(count).random((200, 3)) * [1.0, 1.0, 0.0]
    np.testing.assert_array_equal(thin(points, count, area=1.0), one_by_one(points, count, 1.0))


def test_points_at_the_same_place_and_a_lattice_are_thinned() -> None:
    side = np.arange(20.0)
    lattice = np.stack(np.meshgrid(side, side, [0.0]), axis=-1).reshape(-1, 3)
    twice = np.concatenate([lattice, lattice])
    kept = thin(twice, 400, area=400.0)
    assert len(np.unique(twice[kept], axis=0)) == 400
    assert len(thin(np.zeros((50, 3)), 7, area=1.0)) == 7
    assert len(thin(lattice, 1, area=400.0)) == 1


def test_more_points_than_there_are_cannot_be_chosen() -> None:
    for count in (0, 11):
        with pytest.raises(InputError, match=f"cannot choose {count} of 10 points"):
            thin(np.zeros((10, 3)), count)
