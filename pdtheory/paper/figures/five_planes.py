"""Five planes that meet at a point, irregularly: no order alone has all five ridges."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import synthetic_surfaces
from pdtheory.paper.figures.junctions import DEGREE, compare, fit_apex
from pdtheory.paper.figures.measure import circular_distance
from pdtheory.paper.figures.outcome import Figure, Job, Outcome
from pdtheory.paper.figures.stage import Panel, Strokes, sheet

ORDERS = range(2, 8)


def compute(job: Job) -> Outcome:
    """Fit the apex and compare with the exact prediction, order by order."""
    surface = synthetic_surfaces.get("planes")
    count = job.pick(20_000, 200_000, 300_000)
    field = fit_apex(surface, list(ORDERS), count)
    checks, angles, counts = compare(surface, field, job.pick(2e-2, 5e-3, 2e-3))
    ridges = np.radians([float(azimuth) for azimuth in surface.values["azimuths"]])
    numbers = {
        "ridges in degrees": np.degrees(ridges).tolist(),
        "maxima by order": counts,
        "distance in degrees from each ridge to the nearest maximum, by order": {
            order: np.round(circular_distance(ridges, angles[order]), 2).tolist()
            for order in ORDERS
        },
    }
    parameters = {
        "samples": count,
        "degree": DEGREE,
        "azimuths": [str(azimuth) for azimuth in surface.values["azimuths"]],
        "slopes": [str(slope) for slope in surface.values["slopes"]],
    }
    scene = (surface.mesh(job.pick(12, 60, 60)), field, counts)
    return Outcome(checks, parameters, numbers, scene)


def draw(job: Job, outcome: Outcome, folder: Path) -> list[Path]:
    """Draw the maxima of each order at the apex."""
    mesh, field, counts = outcome.scene
    panels = [
        Panel(
            mesh,
            [Strokes(field, [order], 0.62, width=0.08)],
            f"order {order}: {counts[order]} maxima",
            azimuth=0,
            elevation=68,
        )
        for order in ORDERS
    ]
    return sheet(job, panels, folder, "five-planes", columns=3, size=(520, 440))


FIGURE = Figure(
    "five-planes",
    "five intersecting planes, the intersection distribution being irregular",
    "Maxima of orders 2 to 7 at the point where five planes meet. How many maxima order 7 has "
    "depends on the azimuths of the ridges; it is checked against the exact fit to this cone.",
    compute,
    draw,
)
