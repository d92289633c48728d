"""Directions laid out for drawing, where there is little to draw."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pdtheory.drawing.glyphs import glyph_data
from pdtheory.drawing.thinning import choose_spots
from pdtheory.pointset import estimate_directions


@pytest.fixture(scope="module")
def field():
    x, y = np.random.default_rng(2).uniform(-1.0, 1.0, (2, 200))
    points = np.column_stack([x, y, x**2 - 0.5 * y**2])
    return estimate_directions(points, radius=0.8, degree=2, orders=(2,))


@pytest.mark.parametrize("strong", [0, 1])
def test_relative_strength_where_most_strengths_are_zero(field, strong):
    strength = np.zeros(len(field[2]))
    strength[:strong] = 3.0
    flat = replace(field, directions={2: replace(field[2], strength=strength)})
    relative = glyph_data(flat).attributes["relative_strength"]
    np.testing.assert_array_equal(relative, np.where(strength > 0.0, 1.5, 0.0))


def test_spacing_for_more_points_than_there_are():
    points = np.random.default_rng(0).random((30, 3))
    spots = choose_spots(points)
    assert spots.spacing_for(31) == spots.spacing_for(30) == spots.spacing.min() > 0.0
    assert choose_spots(points, np.zeros(30, bool)).spacing_for(5) == 0.0
