"""Directions that fall together, and directions along the first axis."""

from __future__ import annotations

import numpy as np
import pytest

from pdtheory.pointset import estimate_directions


def directions(height, order, degree, seed=0, count=400):
    """Return those at the origin of the graph of a polynomial."""
    rng = np.random.default_rng(seed)
    size, angle = np.sqrt(rng.random(count)), 2 * np.pi * rng.random(count)
    x, y = size * np.cos(angle), size * np.sin(angle)
    return estimate_directions(
        np.column_stack([x, y, height(x, y)]),
        radius=1.0,
        degree=degree,
        orders=(order,),
        queries=[[0.0, 0.0, 0.0]],
        normals=np.tile([0.0, 0.0, 1.0], (count, 1)),
        frame="given",
    )[order]


@pytest.mark.parametrize("turn", np.linspace(0.0, np.pi, 61))
def test_a_cubic_cylinder_has_one_maximum_and_one_minimum_wherever_it_points(turn):
    """The double zero of g' is no extremum: rounding may part it only into one of each kind."""
    found = directions(lambda x, y: (np.cos(turn) * y - np.sin(turn) * x) ** 3, 3, 4)
    assert np.count_nonzero(found.kind == 1) == np.count_nonzero(found.kind == -1)
    top = found.kind == 1
    strongest = found.angle[top][np.argmax(found.eigenvalue[top])]
    assert np.cos(strongest - (turn + np.pi / 2)) == pytest.approx(1.0, abs=1e-9)
    assert (np.diff(found.angle) > 0).all()
    changing = found.kind[found.kind != 0]
    assert (changing != np.roll(changing, 1)).all()


@pytest.mark.parametrize("order", [4, 5, 6, 7])
@pytest.mark.parametrize("turn", [0.0, np.pi / 2, 0.3])
def test_the_flat_direction_of_a_cylinder_is_there_once(order, turn):
    found = directions(lambda x, y: (np.cos(turn) * x + np.sin(turn) * y) ** order, order, order)
    assert len(found.angle) == 4
    gaps = np.diff(found.angle)
    assert gaps == pytest.approx(np.pi / 2, abs=1e-2)


@pytest.mark.parametrize("seed", range(20))
def test_a_direction_along_the_first_axis_has_an_angle_below_a_full_turn(seed):
    """Rounding puts it on either side of the axis."""
    found = directions(lambda x, y: y * y * (0.5 * x - y), 3, 4, seed)
    assert (found.angle >= 0.0).all()
    assert (found.angle < 2 * np.pi).all()
    assert (np.diff(found.angle) > 0).all()
    along = np.abs(found.vector[:, 1]) < 1e-9
    assert np.count_nonzero(along) == 2
    assert np.sin(found.angle[along]) == pytest.approx([0.0, 0.0], abs=1e-9)
    assert found.kind[along].sum() == 0
