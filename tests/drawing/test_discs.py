"""Points drawn as discs look like a closed surface, evenly sampled or not."""

import numpy as np
import pytest

from pdtheory.drawing.discs import disc_radii

#: Of a hexagon the circle inside is certain, however it is turned.
INSIDE = np.cos(np.pi / 6.0)


@pytest.mark.parametrize("density", [0.0, 0.85], ids=["even", "uneven"])
def test_discs_leave_no_holes_in_a_square(density):
    rng = np.random.default_rng(0)
    samples = rng.random((20_000, 2))
    # Up to seven times fewer points on one side than on the other.
    samples = samples[rng.random(len(samples)) > density * samples[:, 0]]
    points = np.column_stack([samples, np.zeros(len(samples))])
    radius = INSIDE * disc_radii(points)
    places = rng.uniform(0.03, 0.97, (2000, 2))
    distance = np.linalg.norm(places[:, None] - samples, axis=2)
    open_share = np.mean((distance > radius).all(axis=1))
    assert open_share < 0.002


def test_an_outlier_gets_a_small_disc():
    points = np.random.default_rng(0).random((500, 3)) * [1.0, 1.0, 0.0]
    points[7] = [50.0, 0.0, 0.0]
    radius = disc_radii(points)
    assert radius[7] == radius.max() == pytest.approx(4.0 * np.median(radius))


def test_repeated_points_have_discs():
    points = np.repeat(np.random.default_rng(0).random((20, 3)), 8, axis=0)
    np.testing.assert_array_equal(disc_radii(points), 1.0)
    mixed = np.concatenate([points[:8], np.random.default_rng(1).random((100, 3))])
    assert (disc_radii(mixed) > 0.0).all()
    assert disc_radii(np.zeros((1, 3))).tolist() == [1.0]
