"""Where a fit does not tell the tangent plane: against NumPy's own covariance, and the truth."""

from __future__ import annotations

import numpy as np
import pytest

from pdtheory.conventions import Status
from pdtheory.pointset import estimate_directions

UP = np.array([0.0, 0.0, 1.0])


def bound_on_slope(x, y, z, degree):
    """Bound on the deviation of the slope at 0 of a weighted fit, by dense linear algebra."""
    rho = x**2 + y**2 + z**2
    inside = rho <= 1.0
    x, y, z, w = x[inside], y[inside], z[inside], np.exp(-4.5 * rho[inside])
    powers = [(d - b, b) for d in range(degree + 1) for b in range(d + 1)]
    design = np.stack([x**a * y**b for a, b in powers], axis=1)
    root = np.sqrt(w)[:, None]
    left = (
        root[:, 0] * z
        - root * design @ np.linalg.lstsq(root * design, root[:, 0] * z, rcond=None)[0]
    )
    noise = np.sqrt(left @ left / w.sum() * len(x) / (len(x) - len(powers)))
    inverse = np.linalg.pinv(root * design)
    covariance = inverse @ inverse.T
    slope = [powers.index((1, 0)), powers.index((0, 1))]
    return noise * np.sqrt(covariance[slope, slope].sum())


@pytest.mark.parametrize(("degree", "least", "noise"), [(3, 20, 0.2), (6, 40, 0.2), (10, 100, 0.1)])
def test_the_flag_follows_the_uncertainty_of_the_slope(degree, least, noise):
    rng = np.random.default_rng(degree)
    clouds, bounds = [], []
    for number in range(400):
        n = int(rng.integers(least, 3 * least))
        r, t = np.sqrt(rng.random(n)), rng.uniform(0, 2 * np.pi, n)
        # From the middle of a disc to its edge.
        x, y = r * np.cos(t), r * np.sin(t)
        y = np.where(y < -rng.random(), -y, y)
        z = noise * 10 ** rng.uniform(-2, 0) * rng.normal(size=n)
        bounds.append(bound_on_slope(x, y, z, degree))
        clouds.append(np.stack([x + 10.0 * number, y, z], axis=1))
    queries = np.stack([10.0 * np.arange(400), np.zeros(400), np.zeros(400)], axis=1)
    points = np.concatenate(clouds)
    field = estimate_directions(
        points, radius=1.0, degree=degree, orders=(2,), queries=queries,
        normals=np.broadcast_to(UP, points.shape),
    )  # fmt: skip
    flagged = (field.status & Status.UNCERTAIN_FRAME) != 0
    bounds = np.array(bounds)
    # The kernel computes it in a frame that lies a little aslant.
    sure, unsure = bounds < 0.2, bounds > 0.5
    assert sure.sum() > 20
    assert unsure.sum() > 20
    assert not flagged[sure].any()
    assert flagged[unsure].all()
    tilt = np.degrees(np.arccos(np.clip(field.frames[:, 2, 2], -1.0, 1.0)))
    assert tilt[~flagged].max() < 45.0


@pytest.mark.parametrize(("degree", "n"), [(2, 12), (4, 40), (6, 60)])
@pytest.mark.parametrize("size", [0.3, 0.15, 0.08])
def test_a_patch_beyond_a_gap_does_not_tell_the_slope_here(degree, n, size):
    rng = np.random.default_rng(3)
    clouds, bounds = [], []
    for number in range(60):
        r, t = size * np.sqrt(rng.random(n)), rng.uniform(0, 2 * np.pi, n)
        x, y, z = r * np.cos(t) + 0.99 - size, r * np.sin(t), 1e-3 * size * rng.normal(size=n)
        bounds.append(bound_on_slope(x, y, z, degree))
        clouds.append(np.stack([x + 10.0 * number, y, z], axis=1))
    queries = np.stack([10.0 * np.arange(60), np.zeros(60), np.zeros(60)], axis=1)
    points = np.concatenate(clouds)
    field = estimate_directions(
        points, radius=1.0, degree=degree, orders=(2,), queries=queries,
        normals=np.broadcast_to(UP, points.shape),
    )  # fmt: skip
    flagged = (field.status & Status.UNCERTAIN_FRAME) != 0
    assert not np.any(field.answered & ~flagged & (np.array(bounds) > 1.0))


def test_a_tilt_that_makes_the_fit_worse_is_taken_back():
    rng = np.random.default_rng(5)
    x, y = rng.uniform(0, 1, (2, 20000))
    k = 2 * np.pi / 0.12
    amplitude = 1.05 / k
    z = amplitude * np.sin(k * x) * np.sin(k * y)
    by_x, by_y = (amplitude * k * np.cos(k * u) * np.sin(k * v) for u, v in ((x, y), (y, x)))
    normals = np.stack([-by_x, -by_y, np.ones_like(x)], axis=1)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    inner = np.flatnonzero((abs(x - 0.5) < 0.3) & (abs(y - 0.5) < 0.3))[:1000]
    points = np.stack([x, y, z], axis=1)
    field = estimate_directions(
        points, neighbours=264, degree=10, orders=(2,), queries=points[inner], normals=normals,
    )  # fmt: skip
    off = np.degrees(np.arccos(np.clip((field.frames[:, 2] * normals[inner]).sum(1), -1.0, 1.0)))
    plain = (field.status & Status.UNCERTAIN_FRAME) == 0
    assert plain.mean() > 0.9
    assert np.quantile(off[plain], 0.99) < 6.0


def noisy_patch():
    rng = np.random.default_rng(0)
    x, y = rng.uniform(0, 6, (2, 4000))
    z = 0.15 * (x - 3) ** 2 / 2 - 0.1 * (y - 3) ** 2 / 2 + 0.01 * rng.normal(size=len(x))
    normals = np.stack([-0.15 * (x - 3), 0.1 * (y - 3), np.ones(len(x))], axis=1)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    edge = np.minimum.reduce([x, y, 6 - x, 6 - y]) < 0.1
    return np.stack([x, y, z], axis=1), normals, edge


@pytest.mark.parametrize("norm", ["l2", "l1"])
def test_normals_at_a_noisy_boundary(norm):
    points, normals, edge = noisy_patch()
    field = estimate_directions(
        points, radius=1.0, degree=10, orders=(2,), normals=normals, norm=norm
    )
    off = np.degrees(np.arccos(np.clip((field.frames[:, 2] * normals).sum(1), -1.0, 1.0)))
    flagged = (field.status & Status.UNCERTAIN_FRAME) != 0
    assert flagged[edge].mean() > 0.5
    assert np.mean(off > 20.0) < 0.005
    assert off[flagged].max() < 20.0
    sure = field[2].maxima
    wrong = off[sure.point_index] > 20.0
    assert not np.any(sure.angle_std[wrong] < 0.05)


@pytest.mark.parametrize("uncertainty", [False, True])
@pytest.mark.parametrize("norm", ["l2", "l1"])
def test_a_flagged_point_has_the_jet_over_the_plane_that_it_gives(norm, uncertainty):
    points, normals, _ = noisy_patch()
    asked = {"radius": 1.0, "degree": 8, "orders": (2, 3), "norm": norm, "uncertainty": uncertainty}
    field = estimate_directions(points, normals=normals, **asked)
    flagged = (field.status & Status.UNCERTAIN_FRAME) != 0
    assert 10 < flagged.sum() < 2000
    assert np.abs(field.coefficient(1, 1)[flagged]).min() > 0.0
    np.testing.assert_array_equal(field.coefficient(1, 1)[~flagged], 0.0)
    given = estimate_directions(points, frame="given", normals=field.frames[:, 2], **asked)
    assert not np.any(given.status & Status.UNCERTAIN_FRAME)
    mine, theirs = field.take(flagged), given.take(flagged)
    np.testing.assert_allclose(mine.frames, theirs.frames, atol=1e-12)
    size = np.abs(theirs.coefficient(3, 1)).max()
    loose = 1e-3 if norm == "l1" else 1e-8  # l1 stops when it has nearly converged
    np.testing.assert_allclose(
        mine.coefficient(3, 1), theirs.coefficient(3, 1), atol=loose * size, rtol=0.0
    )
    if uncertainty and norm == "l2":
        # The error of a plane that is not fitted does not count.
        np.testing.assert_allclose(mine[2].maxima.angle_std, theirs[2].maxima.angle_std, rtol=1e-6)


def test_in_principal_axes_and_given_planes_nothing_is_tilted():
    points, normals, edge = noisy_patch()
    for frame in ("principal", "given"):
        field = estimate_directions(
            points, radius=1.0, degree=10, orders=(2,), normals=normals, frame=frame,
            queries=points[edge],
        )  # fmt: skip
        assert not np.any(field.status & Status.UNCERTAIN_FRAME)
