"""The fit of a lower degree where the points do not bear the one asked for."""

from __future__ import annotations

import numpy as np
import pytest

from pdtheory.conventions import Status
from pdtheory.pointset import estimate_directions


def at_the_origin(points, degree, radius=0.9):
    up = np.tile([0.0, 0.0, 1.0], (len(points), 1))
    return estimate_directions(
        points,
        radius=radius,
        degree=degree,
        orders=(1, 2),
        queries=[[0.0, 0.0, 0.0]],
        normals=up,
        frame="given",
    )


def reference(points, powers, radius=0.9):
    """Weighted least squares with NumPy."""
    x, y, z = points.T
    squares = (points**2).sum(axis=1) / radius**2
    root = np.where(squares <= 1.0, np.exp(-2.25 * squares), 0.0)
    columns = np.column_stack([x**a * y**b for a, b in powers]) * root[:, None]
    return np.linalg.lstsq(columns, root * z, rcond=None)[0]


@pytest.mark.parametrize("degree", range(2, 15))
def test_two_scan_lines_bear_a_plane(degree):
    """Wherever in its panel of four the pivot is that fails."""
    rng = np.random.default_rng(0)
    x, y = rng.uniform(-1, 1, 900), rng.choice([-0.6, 0.6], 900)
    points = np.column_stack([x, y, 0.2 * x * x + 0.1 * x * y + 0.3 * x**3])
    field = at_the_origin(points, degree)
    offset, by_x, by_y = reference(points, [(0, 0), (1, 0), (0, 1)])
    assert field.degree[0] == 1
    assert field.status[0] & Status.DEGREE_LOWERED
    slope = field.coefficient(1, 1)[0]
    assert field.phi[0, 0].real == pytest.approx(offset, abs=1e-9)
    assert [2 * slope.real, -2 * slope.imag] == pytest.approx([by_x, by_y], abs=1e-9)


@pytest.mark.parametrize("degree", range(3, 15))
def test_nine_places_bear_order_two(degree):
    rng = np.random.default_rng(3)
    x, y = (rng.integers(0, 3, (900, 2)) * 0.6 - 0.6).T
    height = 0.2 * x * x - 0.1 * x * y + 0.05 * y * y + 0.1 * np.sin(2 * x) * y * y
    points = np.column_stack([x, y, height])
    field = at_the_origin(points, degree)
    powers = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)]
    _, _, _, xx, xy, yy = reference(points, powers)
    assert field.degree[0] == 2
    expected = np.linalg.eigvalsh([[2 * xx, xy], [xy, 2 * yy]])
    assert np.sort(field[2].eigenvalue[:2]) == pytest.approx(expected, abs=1e-9)
