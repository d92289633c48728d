"""A perfect T-junction: order 3 cannot take its shape."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import synthetic_surfaces
from pdtheory.paper.figures.junctions import DEGREE, compare, fit_apex
from pdtheory.paper.figures.measure import TURN, worst_angle
from pdtheory.paper.figures.outcome import Check, Figure, Job, Outcome, at_most
from pdtheory.paper.figures.stage import Panel, Strokes, sheet


def compute(job: Job) -> Outcome:
    """Fit order 3 at the junction of three gable roofs."""
    surface = synthetic_surfaces.get("t-junction", slope="3/5")
    count = job.pick(20_000, 200_000, 300_000)
    field = fit_apex(surface, [2, 3], count)
    checks, _, counts = compare(surface, field, job.pick(2e-2, 5e-3, 2e-3))
    vector = field[3].maxima.vector
    angles = np.sort(np.arctan2(vector[:, 1], vector[:, 0]) % TURN)
    gap = np.abs((angles[:, None] - angles[None] + TURN / 2) % TURN - TURN / 2)
    checks += [
        at_most("distance of the maxima from a 3-RoSy in degrees",
                worst_angle(angles, angles[0] + TURN * np.arange(3) / 3), 0.5,
                "order 3 of any cone is a 3-RoSy or vanishes"),
        Check("smallest distance in degrees of two maxima from being opposite",
              float(180.0 - np.degrees(gap.max())), 1.0, 180.0,
              "two maxima of order 3 are never opposite"),
    ]  # fmt: skip
    numbers = {"order-3 maxima in degrees": np.degrees(angles).tolist(), "maxima": counts}
    parameters = {"samples": count, "degree": DEGREE, "slope": "3/5"}
    return Outcome(checks, parameters, numbers, (surface.mesh(job.pick(12, 60, 60)), field))


def draw(job: Job, outcome: Outcome, folder: Path) -> list[Path]:
    """Draw the maxima of order 3 at the junction."""
    mesh, field = outcome.scene
    panel = Panel(mesh, [Strokes(field, [3], 0.55, width=0.08)], azimuth=-12, elevation=52)
    return sheet(job, [panel], folder, "t-junction", columns=1, size=(720, 560))


FIGURE = Figure(
    "t-junction",
    "order 3 directions computed on a perfect T-junction",
    "Ridges lie at 0, 90 and 180 degrees, but two maxima of order 3 cannot be opposite: they stand "
    "120 degrees apart, as on every cone.",
    compute,
    draw,
)
