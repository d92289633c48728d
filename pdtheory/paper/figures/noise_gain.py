"""How much noise the coefficients of every order carry, by the degree of the fit."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

import synthetic_surfaces
from pdtheory.conventions import frequencies
from pdtheory.paper.figures.outcome import Check, Figure, Job, Outcome
from pdtheory.paper.figures.plots import colour, new_plot, pyplot, save
from pdtheory.pointset import estimate_directions
from pdtheory.pointset.cloud import FloatArray

_ORDERS = (2, 3, 4, 5, 6)
_RADIUS = 0.5
_SIGMA = 1e-4


def gain(x: FloatArray, y: FloatArray, degree: int) -> dict[int, float]:
    """Return the predicted deviation of phi_{k,.} R^(k-1) per unit of noise over R, by order.

    Propagates independent noise of the heights through the weighted fit, with NumPy alone.

    Parameters
    ----------
    x, y : (N,) float64
        Places of the samples over the radius.
    degree
        Degree of the fit.
    """
    weight = np.exp(-4.5 * (x**2 + y**2))
    table = [(k, n) for k in range(degree + 1) for n in frequencies(k)]
    w = x + 1j * y
    columns: list[FloatArray] = []
    for k, n in table:
        base = w**n * (x**2 + y**2) ** ((k - n) // 2)
        parts = [base.real] if n == 0 else [2 * base.real, -2 * base.imag]
        columns += [np.asarray(part, dtype=np.float64) for part in parts]
    matrix = np.stack(columns, axis=1)
    solve = np.linalg.pinv(matrix * np.sqrt(weight)[:, None]) * np.sqrt(weight)
    variance = np.sum(solve**2, axis=1)
    result: dict[int, float] = {}
    row = 0
    for k, n in table:
        size = 1 if n == 0 else 2
        result[k] = result.get(k, 0.0) + float(variance[row : row + size].sum())
        row += size
    return {k: float(np.sqrt(value)) for k, value in result.items()}


def compute(job: Job) -> Outcome:
    """Repeat fits of a noisy plane, and compare their scatter with propagated noise."""
    degrees = job.pick((4, 8), (2, 3, 4, 5, 6, 7, 8, 9, 10), (2, 3, 4, 5, 6, 7, 8, 9, 10))
    repeats = job.pick(60, 200, 1000)
    count = job.pick(600, 900, 900)
    plane = synthetic_surfaces.get("plane", side=2 * _RADIUS)
    clean = plane.sample(count, method="blue", seed=job.seed).points
    near = np.linalg.norm(clean, axis=1) <= _RADIUS
    rng = np.random.default_rng(job.seed)
    normals = np.tile([0.0, 0.0, 1.0], (count, 1))
    predicted: dict[int, dict[int, float]] = {}
    observed: dict[int, dict[int, float]] = {}
    for degree in degrees:
        job.tell(degree / 10, f"noise-gain: degree {degree}")
        factors = gain(clean[near, 0] / _RADIUS, clean[near, 1] / _RADIUS, degree)
        orders = [order for order in _ORDERS if order <= degree]
        predicted[degree] = {order: factors[order] for order in orders}
        squares = dict.fromkeys(orders, 0.0)
        for _ in range(repeats):
            points = clean.copy()
            points[:, 2] += _SIGMA * rng.standard_normal(count)
            field = estimate_directions(
                points,
                normals=normals,
                radius=_RADIUS,
                degree=degree,
                orders=orders,
                frame="given",
                uncertainty=False,
                threads=1,
                queries=np.zeros((1, 3)),
            )
            for order in orders:
                size = sum(abs(field.coefficient(order, n)[0]) ** 2 for n in frequencies(order))
                squares[order] += size * _RADIUS ** (2 * order - 2)
        observed[degree] = {
            order: float(np.sqrt(squares[order] / repeats)) / (_SIGMA / _RADIUS) for order in orders
        }
    ratio = [
        observed[degree][order] / predicted[degree][order]
        for degree in degrees
        for order in observed[degree]
    ]
    # The scatter of a standard deviation from so many repeats of at least three numbers each.
    bound = 4.0 / np.sqrt(2 * 3 * repeats)
    highest = max(degrees)
    lowest = min(degree for degree in degrees if 2 in observed[degree])
    checks = [
        Check("largest observed over predicted deviation", max(ratio), 1 - bound, 1 + bound,
              "propagation of independent noise; four standard errors"),
        Check("smallest observed over predicted deviation", min(ratio), 1 - bound, 1 + bound,
              "propagation of independent noise; four standard errors"),
        Check(f"order 2: gain at degree {highest} over degree {lowest}",
              observed[highest][2] / observed[lowest][2], 2.0, float("inf"),
              "a high degree amplifies noise"),
    ]  # fmt: skip
    numbers: dict[str, Any] = {"predicted": predicted, "observed": observed}
    parameters = {"samples": int(near.sum()), "repeats": repeats, "sigma": _SIGMA, "seed": job.seed}
    return Outcome(checks, parameters, numbers, (degrees, predicted, observed))


def draw(job: Job, outcome: Outcome, folder: Path) -> list[Path]:
    """Plot the predicted gain as lines and the observed one as dots."""
    degrees, predicted, observed = outcome.scene
    pyplot()
    figure = new_plot(4.8, 3.6)
    axes = figure.add_axes((0.14, 0.14, 0.82, 0.82))
    for order in _ORDERS:
        there = [degree for degree in degrees if degree >= order]
        axes.semilogy(there, [predicted[d][order] for d in there], color=colour(order))
        axes.semilogy(
            there, [observed[d][order] for d in there], "o", ms=4, color=colour(order),
            label=f"order {order}",
        )  # fmt: skip
    axes.set_xlabel("degree K of the fit")
    axes.set_ylabel(r"deviation of $\phi_k R^{k-1}$ over noise $/R$")
    axes.legend()
    return save(figure, folder / "noise-gain.png", vector=True)


FIGURE = Figure(
    "noise-gain",
    "beyond the paper",
    "Standard deviation of the coefficients of each order per unit of noise, by the degree of the "
    "fit: propagated (lines) and observed over repeated noise (dots).",
    compute,
    draw,
)
