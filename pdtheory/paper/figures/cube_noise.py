"""A cube with Gaussian noise on the positions, fitted in both norms."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

import numpy as np

import synthetic_surfaces
from pdtheory.paper.figures.cube import DEGREE, RADIUS, estimate, panels, places
from pdtheory.paper.figures.outcome import Check, Figure, Job, Outcome, at_most
from pdtheory.paper.figures.stage import sheet
from pdtheory.pointset.cloud import FloatArray
from pdtheory.pointset.field import DirectionField

#: Standard deviation of the noise, in percent of the diagonal.
LEVELS = (0.0, 0.01, 0.05, 0.1)
NORMS: tuple[Literal["l2", "l1"], ...] = ("l2", "l1")


def edge_errors(field: DirectionField) -> FloatArray:
    """Return the angle in degrees between each edge and the nearest order-2 maximum on it."""
    edges = places()[0]
    along = np.abs(np.abs(edges) - 1.0) > 1e-9
    maxima = field[2].maxima.vectors
    result = []
    for index, axis in enumerate(along):
        cosine = np.abs(maxima[index] @ axis.astype(float))
        result.append(np.degrees(np.arccos(np.clip(cosine.max(initial=0.0), 0, 1))))
    return np.array(result)


def corner_errors(field: DirectionField) -> FloatArray:
    """Return for each corner the largest angle in degrees from an edge to an order-3 maximum."""
    edges, corners = places()
    maxima = field[3].maxima.vectors
    result = []
    for index, corner in enumerate(corners):
        normal = corner / np.linalg.norm(corner)
        edge = -np.diag(corner) + np.outer(corner * normal, normal)
        edge = edge / np.linalg.norm(edge, axis=1, keepdims=True)
        found = maxima[len(edges) + index]
        cosine = (edge @ found.T).max(axis=1, initial=-1.0)
        result.append(np.degrees(np.arccos(np.clip(cosine.min(), -1, 1))))
    return np.array(result)


def compute(job: Job) -> Outcome:
    """Estimate orders 2 and 3 at every noise level, in both norms."""
    surface = synthetic_surfaces.get("cube")
    count = 6 * job.pick(100, 180, 400) ** 2
    checks: list[Check] = []
    numbers = {}
    scenes: list[tuple[float, str, DirectionField]] = []
    for level in LEVELS:
        samples = surface.sample(
            count, method="grid", noise=level, noise_along="position", seed=job.seed
        )
        for norm in NORMS:
            job.tell(len(scenes) / 8, f"cube-noise: {level} %, {norm}")
            field = estimate(samples, norm=norm)
            on_edges, at_corners = edge_errors(field), corner_errors(field)
            because = "grows in proportion to the noise"
            checks += [
                at_most(
                    f"{level} %, {norm}: median angle in degrees from edge to order-2 maximum",
                    float(np.median(on_edges)),
                    0.3 + 25.0 * level,
                    because,
                ),
                at_most(
                    f"{level} %, {norm}: median over corners of the worst angle from edge to "
                    "order-3 maximum",
                    float(np.median(at_corners)),
                    1.0 + 150.0 * level,
                    because,
                ),
            ]
            numbers[f"{level} %, {norm}"] = {
                "edges, median": float(np.median(on_edges)),
                "edges, worst": float(on_edges.max()),
                "corners, median": float(np.median(at_corners)),
                "corners, worst": float(at_corners.max()),
            }
            scenes.append((level, norm, field))
    parameters = {"samples": count, "radius": RADIUS, "degree": DEGREE, "seed": job.seed}
    return Outcome(checks, parameters, numbers, (surface.mesh(job.pick(8, 60, 60)), scenes))


def draw(job: Job, outcome: Outcome, folder: Path) -> list[Path]:
    """Draw orders 2 and 3 together for every level, l2 above and l1 below."""
    mesh, scenes = outcome.scene
    sheets = []
    for norm in NORMS:
        for level, its_norm, field in scenes:
            if its_norm == norm:
                two, three = panels(mesh, field)
                title = f"{level:g} %, {norm}" if level else f"no noise, {norm}"
                sheets.append(
                    type(two)(
                        mesh,
                        [*two.strokes, *three.strokes],
                        title,
                        azimuth=two.azimuth,
                        elevation=two.elevation,
                    )
                )
    return sheet(job, sheets, folder, "cube-noise", columns=4, size=(440, 400))


FIGURE = Figure(
    "cube-noise",
    "principal directions of order 2 and 3 computed on a cube with added Gaussian noise",
    "Orders 2 (maxima thick, minima thin) and 3 on a cube with Gaussian noise on the positions, in "
    "percent of the diagonal; fits in l2 above and l1 below.",
    compute,
    draw,
)
