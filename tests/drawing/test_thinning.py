"""Which points carry strokes: an even selection at every density."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree

from pdtheory.drawing.thinning import choose_spots


@pytest.fixture(scope="module")
def sphere():
    points = np.random.default_rng(5).normal(size=(30_000, 3))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


@pytest.fixture(scope="module")
def spots(sphere):
    return choose_spots(sphere)


@pytest.mark.parametrize("count", [50, 300, 1500])
def test_spots_are_apart_and_leave_no_gap(sphere, spots, count):
    spacing = spots.spacing_for(count)
    chosen = sphere[spots.spacing >= spacing]
    # Levels follow one another by 2^(1/6) in distance, by 2^(1/3) = 1.26 in number.
    assert count <= len(chosen) <= 1.35 * count
    apart = cKDTree(chosen).query(chosen, k=2)[0][:, 1]
    assert apart.min() >= spacing
    gap = cKDTree(chosen).query(sphere)[0].max()
    # Candidates come one from a cell of half the radius, so a hole is at most its diagonal wider.
    assert gap <= spacing * (1 + np.sqrt(3) / 2)


def test_neighbouring_spots_get_different_orders(sphere, spots):
    keep = spots.spacing >= spots.spacing_for(1000)
    turn = np.floor(3 * spots.turn[keep]).astype(int)
    shares = np.bincount(turn, minlength=3) / len(turn)
    assert shares == pytest.approx([1 / 3] * 3, abs=0.06)
    _, near = cKDTree(sphere[keep]).query(sphere[keep], k=5)
    alike = (turn[near[:, 1:]] == turn[:, None]).mean()
    assert alike < 0.27  # a third, were the turns dealt at random


def test_every_usable_point_has_a_spacing_and_no_other(sphere):
    points = sphere[:500].copy()
    points[7] = np.nan
    usable = np.arange(500) % 2 == 1
    spots = choose_spots(points, usable)
    expected = usable.copy()
    expected[7] = False
    assert np.array_equal(spots.spacing > 0, expected)
    assert spots.spacing_for(10_000) == spots.spacing[expected].min()


def test_the_same_seed_gives_the_same_spots(sphere):
    once, again = (choose_spots(sphere[:3000], seed=3) for _ in range(2))
    assert np.array_equal(once.spacing, again.spacing)
    assert np.array_equal(once.turn, again.turn)


@pytest.mark.parametrize("points", [np.empty((0, 3)), np.zeros((1, 3)), np.zeros((9, 3))])
def test_few_and_equal_points(points):
    spots = choose_spots(points)
    assert (spots.spacing > 0).all()
    assert len(spots.turn) == len(points)


def test_preferred_points_are_taken_where_there_is_a_choice(sphere):
    preferred = np.random.default_rng(1).random(len(sphere)) < 0.3
    spots = choose_spots(sphere, preference=preferred)
    keep = spots.spacing >= spots.spacing_for(300)
    assert preferred[keep].mean() > 0.9
    assert cKDTree(sphere[keep]).query(sphere)[0].max() < 2.0 * spots.spacing_for(300)
