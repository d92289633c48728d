"""Directions with their uncertainty on a noisy scan, and how often it holds."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from pdtheory.paper.figures.models import load
from pdtheory.paper.figures.outcome import Check, Figure, Job, Outcome
from pdtheory.paper.figures.scans import sample
from pdtheory.paper.figures.stage import Panel, Strokes, sheet
from pdtheory.pointset import estimate_directions
from pdtheory.pointset.cloud import FloatArray, PointCloud
from pdtheory.pointset.directions import OrderDirections
from pdtheory.pointset.field import DirectionField
from synthetic_surfaces.spread import OVERSAMPLING, thin

_MODEL = "igea"
_DEGREE = 6
_RADIUS = 0.04
#: Noise along the normal, in percent of the diagonal.
_NOISE = 0.1
_ORDERS = (2, 3)

#: Directions less certain than this are left out of the count: errors are no longer linear.
_LARGEST = np.radians(10.0)


def deviations(clean: OrderDirections, noisy: OrderDirections) -> FloatArray:
    """Return the errors of the maxima of a noisy fit over their stated deviations.

    Each maximum of `noisy` that is certain to 10 degrees is held against the nearest maximum of
    `clean` at the same point, in the tangent plane.
    """
    a, b = noisy.maxima, clean.maxima
    result = []
    for row, point in enumerate(a.point_index):
        others = b.vectors[int(point)]
        if a.angle_std[row] < _LARGEST and len(others):
            turn = np.arccos(np.clip(np.max(others @ a.vector[row]), -1, 1))
            result.append(turn / a.angle_std[row])
    return np.array(result)


def compute(job: Job) -> Outcome:
    """Repeat the estimation with fresh noise, and count how often the error bars hold the truth."""
    mesh = load((_MODEL,), job)
    count = job.pick(40_000, 150_000, 1_000_000)
    spots = job.pick(60, 700, 700)
    repeats = job.pick(4, 6, 20)
    cloud = sample(mesh, count, job.seed)
    assert cloud.normals is not None
    pool = cloud.points[: OVERSAMPLING * spots]
    chosen = thin(pool, spots)
    sigma = 0.01 * _NOISE * mesh.diagonal

    def estimate(points: FloatArray) -> DirectionField:
        return estimate_directions(
            PointCloud(points, cloud.normals),
            radius=_RADIUS * mesh.diagonal,
            degree=_DEGREE,
            orders=_ORDERS,
            queries=pool[chosen],
        )

    clean = estimate(cloud.points)
    rng = np.random.default_rng(job.seed)
    noisy = []
    for repeat in range(repeats):
        job.tell(repeat / repeats, f"error-bars: noise {repeat + 1} of {repeats}")
        shift = sigma * rng.standard_normal((count, 1))
        noisy.append(estimate(cloud.points + shift * cloud.normals))
    checks: list[Check] = []
    numbers = {}
    slack = job.pick(0.10, 0.06, 0.05)
    for order in _ORDERS:
        ratio = np.concatenate([deviations(clean[order], field[order]) for field in noisy])
        for within, share in ((1.0, 0.683), (2.0, 0.954)):
            checks.append(
                Check(
                    f"order {order}: share of maxima within {within:g} stated deviations",
                    float(np.mean(ratio <= within)),
                    share - slack,
                    min(1.0, share + slack),
                    "normal errors; maxima certain to 10 degrees",
                )
            )
        numbers[f"order {order}"] = {
            "maxima counted": len(ratio),
            "median deviation in degrees": float(np.degrees(np.median(noisy[0][order].angle_std))),
        }
    parameters = {
        "scan": _MODEL,
        "samples": count,
        "noise in percent of the diagonal": _NOISE,
        "radius over diagonal": _RADIUS,
        "degree": _DEGREE,
        "repeats": repeats,
        "seed": job.seed,
    }
    spacing = float(np.sqrt(np.linalg.norm(np.ptp(mesh.points, axis=0)) ** 2 / spots))
    return Outcome(checks, parameters, numbers, (mesh, noisy[0], spacing))


def leaning(field: DirectionField, order: int, turns: float) -> DirectionField:
    """Return the field with the directions of one order turned by so many of their deviations."""
    rows = field[order]
    normal = field.frames[rows.point_index, 2]
    # Half a turn of the disc is all that can be unknown.
    angle = np.clip(turns * rows.angle_std, -np.pi / 2, np.pi / 2)[:, None]
    vector = np.cos(angle) * rows.vector + np.sin(angle) * np.cross(normal, rows.vector)
    return replace(field, directions={**field.directions, order: replace(rows, vector=vector)})


def draw(job: Job, outcome: Outcome, folder: Path) -> list[Path]:
    """Draw the maxima thick, with thin strokes two deviations to either side."""
    mesh, field, spacing = outcome.scene
    panels = []
    for order in _ORDERS:
        strokes = [Strokes(field, [order], 0.42 * spacing, width=0.17)]
        strokes += [
            Strokes(leaning(field, order, turns), [order], 0.36 * spacing, width=0.08)
            for turns in (-2.0, 2.0)
        ]
        panels.append(Panel(mesh, strokes, f"order {order}", up="y", azimuth=0, elevation=5))
    return sheet(job, panels, folder, "error-bars", columns=2, size=(560, 640))


FIGURE = Figure(
    "error-bars",
    "beyond the paper",
    "Maxima of orders 2 and 3 on a head with Gaussian noise of "
    f"{_NOISE} % of the diagonal: thick where they were found, thin two standard deviations to "
    "either side.",
    compute,
    draw,
    ((_MODEL,),),
)
