"""The l1 fit against linear programming, which knows nothing of weights."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import linprog

from pdtheory.conventions import Status, frequencies
from pdtheory.pointset import DirectionField, estimate_directions

RADIUS = 0.6


def heights(
    field: DirectionField, degree: int, point: int, x: np.ndarray, y: np.ndarray
) -> np.ndarray:
    """The fitted surface over places in the frame of a point."""
    r, angle = np.hypot(x, y), np.arctan2(y, x)
    total = np.zeros(len(x))
    for k in range(degree + 1):
        for n in frequencies(k):
            term = field.coefficient(k, n)[point] * np.exp(1j * n * angle)
            total += r**k * (term.real if n == 0 else 2 * term.real)
    return total


# An l1 fit goes through as many points as it has coefficients (120 at degree 14), and their weights
# grow without bounds.
@pytest.mark.parametrize(
    ("degree", "count", "outliers"),
    [(4, 2500, 0.0), (4, 2500, 0.1), (10, 500, 0.1), (14, 1000, 0.0)],
)
def test_sum_of_residuals_is_nearly_the_smallest(degree, count, outliers):
    rng = np.random.default_rng(8)
    xy = rng.uniform(-1, 1, (count, 2))
    z = 0.3 * xy[:, 0] ** 2 - 0.2 * xy[:, 0] * xy[:, 1] ** 2 + 0.01 * rng.normal(size=count)
    z += 0.2 * (rng.random(count) < outliers)
    points = np.column_stack([xy, z])
    places = np.array([[0.0, 0.0, 0.0], [0.2, -0.1, 0.0], [0.7, 0.1, 0.1]])
    field = estimate_directions(
        points, radius=RADIUS, degree=degree, orders=(2,), queries=places, norm="l1",
        frame="given", normals=np.tile([0.0, 0.0, 1.0], (count, 1)),
    )  # fmt: skip
    assert not np.any(field.status & (Status.NOT_CONVERGED | Status.DEGREE_LOWERED))
    for i, place in enumerate(places):
        offset = points - place
        distance = np.linalg.norm(offset, axis=1)
        x, y, h = (offset[distance <= RADIUS] @ field.frames[i].T).T
        weight = np.exp(-4.5 * (distance[distance <= RADIUS] / RADIUS) ** 2)
        found = np.sum(weight * np.abs(h - heights(field, degree, i, x, y)))
        powers = [(a, b) for a in range(degree + 1) for b in range(degree + 1 - a)]
        matrix = np.column_stack([(x / RADIUS) ** a * (y / RADIUS) ** b for a, b in powers])
        # Smallest sum of w (p + m) with matrix c + p - m = h and p, m >= 0.
        one = np.eye(len(x))
        best = linprog(
            np.concatenate([np.zeros(len(powers)), weight, weight]),
            A_eq=np.hstack([matrix, one, -one]), b_eq=h,
            bounds=[(None, None)] * len(powers) + [(0, None)] * (2 * len(x)),
        )  # fmt: skip
        assert best.success
        assert best.fun <= found * (1 + 1e-9)
        assert found <= 1.006 * best.fun
