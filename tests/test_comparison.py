"""How far directions are from exact ones: in angle, in eigenvalue, and across similarities."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import synthetic_surfaces
from pdtheory.comparison import compare_fields, field_of_jets
from pdtheory.conventions import Kind


@pytest.fixture(scope="module")
def exact():
    site = synthetic_surfaces.get("monkey").sites()[0]
    return field_of_jets([site.jet(4), site.jet(4, at=("1/4", "-1/3"))], (2, 3))


def turned(field, angle):
    """Return a field whose directions of order 3 are turned in their tangent planes."""
    rows = field[3]
    frame = field.frames[rows.point_index]
    theta = rows.angle + angle
    vector = np.cos(theta)[:, None] * frame[:, 0] + np.sin(theta)[:, None] * frame[:, 1]
    return replace(field, directions={**field.directions, 3: replace(rows, vector=vector)})


def test_a_field_agrees_with_itself(exact):
    for agreement in compare_fields(exact, exact):
        assert len(agreement.angle) == agreement.estimated == len(exact[agreement.order])
        np.testing.assert_allclose(agreement.angle, 0.0, atol=1e-15)
        np.testing.assert_allclose(agreement.eigenvalue, 0.0, atol=1e-15)


def test_a_turn_is_measured_even_where_it_is_tiny(exact):
    for angle in (0.02, 1e-9):
        (agreement,) = [a for a in compare_fields(turned(exact, angle), exact) if a.order == 3]
        np.testing.assert_allclose(agreement.angle, angle, rtol=1e-6)
    assert "worst 5.7e-08°" in agreement.in_words()


def test_a_similarity_takes_directions_and_eigenvalues_along(exact):
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    moved = replace(
        exact,
        points=2.0 * exact.points @ turn.T,
        frames=exact.frames @ turn.T,
        directions={
            order: replace(
                rows, vector=rows.vector @ turn.T, eigenvalue=rows.eigenvalue * 2.0 ** (1 - order)
            )
            for order, rows in exact.directions.items()
        },
    )
    for agreement in compare_fields(moved, exact, 2.0 * turn):
        np.testing.assert_allclose(agreement.angle, 0.0, atol=1e-12)
        np.testing.assert_allclose(agreement.eigenvalue, 0.0, atol=1e-12)


def test_what_is_not_there_is_counted(exact):
    rows = exact[3]
    blind = replace(rows, kind=np.full_like(rows.kind, Kind.MAXIMUM))
    found = compare_fields(
        replace(exact, directions={3: blind}), replace(exact, directions={3: rows})
    )
    minima = int((rows.kind == Kind.MINIMUM).sum())
    assert np.isnan(found[0].angle).sum() == minima
    assert f"{minima} not found" in found[0].in_words()


def test_points_without_an_estimate_are_left_out_and_counted(exact):
    for away, apart in ((0.9e-3, 0), (1.1e-3, 1)):
        places = exact.points.copy()
        places[1] += (0.0, 0.0, away)
        for agreement in compare_fields(exact, replace(exact, points=places)):
            rows = exact[agreement.order]
            kept = len(rows) - apart * int(rows.counts[1])
            assert (agreement.apart, len(agreement.angle)) == (apart, kept)
            assert agreement.estimated == kept
            np.testing.assert_allclose(agreement.angle, 0.0, atol=1e-15)


def test_a_field_without_answers_has_nothing_to_compare(exact):
    blind = replace(exact, frames=np.full_like(exact.frames, np.nan))
    for agreement in compare_fields(blind, exact):
        assert agreement.apart == len(exact)
        assert agreement.in_words() == f"Order {agreement.order}: nothing to compare"
