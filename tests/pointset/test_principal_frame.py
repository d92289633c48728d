"""The robust principal plane against the eigenvectors of LAPACK."""

from __future__ import annotations

import numpy as np
import pytest

from pdtheory.pointset import estimate_directions

RADIUS = 0.5


def reference(points: np.ndarray, query: np.ndarray) -> np.ndarray:
    """The normal of the weighted principal plane, reweighted twice."""
    near = (points - query) / RADIUS
    near = near[(near**2).sum(axis=1) <= 1.0]
    weight = np.exp(-4.5 * (near**2).sum(axis=1))
    u = weight
    for _ in range(3):
        mean = u @ near / u.sum()
        variance, axes = np.linalg.eigh((near.T * u) @ near / u.sum() - np.outer(mean, mean))
        distance = (near - mean) @ axes[:, 0]
        u = weight / (1.0 + distance**2 / variance[0])
    return axes[:, 0]


@pytest.mark.parametrize(
    "sigma",
    [
        pytest.param(0.0, id="smooth"),
        pytest.param(0.03, id="noisy"),
        # Here the least variance is hardly less than the others, and the normal may jump.
        pytest.param(0.7, id="a ball"),
    ],
)
def test_the_normal_is_that_of_the_reweighted_plane(sigma):
    rng = np.random.default_rng(5)
    xy = rng.uniform(-1, 1, (1500, 2))
    z = 0.4 * xy[:, 0] ** 2 - 0.2 * xy[:, 1] ** 3 + sigma * rng.normal(size=len(xy))
    outliers = rng.uniform(-1, 1, (30, 3))
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    points = np.vstack([np.column_stack([xy, z]), outliers]) @ turn
    queries = points[:200]
    field = estimate_directions(
        points, radius=RADIUS, degree=2, orders=(2,), frame="principal", queries=queries,
        orient="none",
    )  # fmt: skip
    answered = np.isfinite(field.frames[:, 0, 0])
    assert answered.mean() > 0.9
    expected = np.array([reference(points, query) for query in queries[answered]])
    cosine = np.einsum("ij,ij->i", expected, field.frames[answered, 2])
    across = np.linalg.norm(np.cross(expected, field.frames[answered, 2]), axis=1)
    assert np.abs(cosine).min() > 0.5
    np.testing.assert_allclose(across, 0.0, atol=1e-10)
