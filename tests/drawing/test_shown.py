"""Which of a noisy field's directions are shown, and where."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree

from pdtheory.blender.draw import draw_field
from pdtheory.drawing.choice import Choice
from pdtheory.drawing.glyphs import glyph_data
from pdtheory.drawing.view import on_fitted_surface
from pdtheory.errors import InputError
from pdtheory.pointset import estimate_directions
from pdtheory.viewer.strokes import Strokes
from tests.pointset.surfaces import torus

NOISE = 0.02


@pytest.fixture(scope="module")
def noisy():
    """A torus of which few directions are certain."""
    points, normals, *_ = torus(5000, 1.0, 0.4, 3)
    offset = NOISE * np.random.default_rng(1).normal(size=(len(points), 1))
    return estimate_directions(
        points + offset * normals, normals=normals, radius=0.25, degree=4, orders=(2, 3)
    )


@pytest.fixture(scope="module")
def rare(noisy):
    """The certainty that one point in twenty reaches."""
    best = np.full(len(noisy), np.inf)
    np.minimum.at(best, noisy[2].maxima.point_index, noisy[2].maxima.angle_std)
    return float(np.quantile(best, 0.05))


def blender_shows(data, choice):
    """Which rows the modifier lets through."""
    column = {name: np.asarray(values, float) for name, values in data.attributes.items()}
    point = column["point"].astype(int)
    keep = choice.passes(column["kind"], column["strength"], column["angle_std"])
    keep &= data.spots.spacing[point] >= data.spots.spacing_for(choice.strokes)
    turn = np.floor(column["turn"] * len(choice.orders)).astype(int)
    return keep & (np.array(choice.orders)[turn] == column["order"])


@pytest.mark.parametrize("strokes", [150, 400])
def test_strokes_are_spread_over_the_points_that_pass(noisy, rare, strokes):
    choice = Choice((2, 3), "max", strokes, 0.0, rare)
    rows = noisy[2].maxima, noisy[3].maxima
    pass_somewhere = np.unique(
        np.concatenate([row.point_index[row.angle_std < rare] for row in rows])
    )
    assert 200 < len(pass_somewhere) < len(noisy) / 5
    viewer = Strokes.of_field(noisy)
    drawn = glyph_data(noisy, choice.orders, choice)
    for data, shown in ((viewer.data, viewer.seen(choice)), (drawn, blender_shows(drawn, choice))):
        point = np.unique(data.attributes["point"][shown])
        apart = data.spots.spacing_for(strokes)
        assert set(point) <= set(pass_somewhere)
        separation = cKDTree(noisy.points[point]).query(noisy.points[point], k=2)[0][:, 1]
        assert separation.min() >= apart
        # Every point that passes carries strokes, or lies closer to one that does than strokes may.
        gap = cKDTree(noisy.points[point]).query(noisy.points[pass_somewhere])[0]
        assert gap.max() <= 2.0 * apart


def test_in_blender_the_others_wait_for_the_limits_to_be_widened(noisy, rare):
    narrow = Choice((2, 3), "max", 400, 0.0, rare)
    data = glyph_data(noisy, (2, 3), narrow)
    wide = blender_shows(data, narrow._replace(largest_uncertainty=np.inf))
    assert len(np.unique(data.attributes["point"][wide])) > 350
    assert blender_shows(data, narrow).sum() < wide.sum()


def test_points_are_dealt_to_orders_that_pass_there(noisy, rare):
    choice = Choice((2, 3), "max", 10**6, 0.0, rare)
    viewer = Strokes.of_field(noisy)
    shown = viewer.seen(choice)
    passing = [set(r.point_index[r.angle_std < rare]) for r in (noisy[2].maxima, noisy[3].maxima)]
    assert set(viewer.data.attributes["point"][shown]) == passing[0] | passing[1]


@pytest.mark.parametrize(
    "options", [{"largest_uncertainty": 1e-9}, {"least_strength": 1e30}, {"orders": []}]
)
def test_a_picture_without_strokes_is_refused(noisy, tmp_path, options):
    with pytest.raises(InputError, match="no direction"):
        draw_field(noisy, None, tmp_path / "a.png", **options)
    assert not list(tmp_path.iterdir())


def test_the_fitted_surface_is_smoother_than_the_samples(noisy):
    def off(points):
        ring = np.hypot(points[:, 0], points[:, 1]) - 1.0
        return float(np.std(np.hypot(ring, points[:, 2]) - 0.4))

    fitted = on_fitted_surface(noisy)
    assert off(noisy.points) == pytest.approx(NOISE, rel=0.1)
    assert off(fitted.points) < 0.5 * NOISE
