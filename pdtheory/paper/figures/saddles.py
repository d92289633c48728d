"""Monkey and octopus saddle: one order stands alone, and its maxima are a k-RoSy."""

from __future__ import annotations

from math import factorial
from pathlib import Path

import numpy as np

import synthetic_surfaces
from pdtheory.exact import real_eigenpairs
from pdtheory.paper.figures.measure import TURN, angles_in, angles_of, exact_rows, worst_angle
from pdtheory.paper.figures.outcome import Check, Figure, Job, Outcome, at_most
from pdtheory.paper.figures.stage import Panel, Strokes, sheet
from pdtheory.pointset import estimate_directions

#: Name, order that does not vanish, amplitude, length of the strokes.
_SADDLES = (("monkey", 3, "2/5", 0.52), ("octopus", 8, "2/5", 0.62))
_RADIUS = 0.6
_DEGREE = 10


def compute(job: Job) -> Outcome:
    """Estimate orders 2 to 8 at the centre of both saddles and compare with the exact ones."""
    checks: list[Check] = []
    numbers = {}
    scenes = []
    count = job.pick(4_000, 20_000, 60_000)
    for name, order, amplitude, length in _SADDLES:
        surface = synthetic_surfaces.get(name, amplitude=amplitude)
        field = estimate_directions(
            surface.sample(count, seed=job.seed),
            radius=_RADIUS,
            degree=_DEGREE,
            orders=range(2, 9),
            queries=np.zeros((1, 3)),
        )
        row = exact_rows(surface, [order])[order]
        maxima = field[order].maxima
        found = angles_in(maxima, 0, [1, 0, 0], [0, 1, 0])
        expected = angles_of(real_eigenpairs(row).maxima)
        largest = factorial(order) * float(surface.values["amplitude"])
        because = "the surface is a polynomial of lower degree than the fit"
        checks += [
            at_most(f"{name}: worst angle of the maxima in degrees",
                    worst_angle(found, expected), 1e-5, because),
            at_most(f"{name}: distance from an exact {order}-RoSy in degrees",
                    worst_angle(found, TURN * np.arange(order) / order), 1e-5, because),
            at_most(f"{name}: relative error of lambda = {largest:g}",
                    np.max(np.abs(maxima.eigenvalue / largest - 1), initial=0.0), 1e-7, because),
            at_most(
                f"{name}: strength of the other orders over that of order {order}",
                max(field[k].strength.max(initial=0.0) for k in range(2, 9) if k != order)
                / maxima.strength.max(initial=1e-300),
                1e-6,
                "all other orders vanish",
            ),
        ]  # fmt: skip
        numbers[name] = {
            "angles in degrees": np.degrees(found).tolist(),
            "lambda": maxima.eigenvalue.tolist(),
        }
        scenes.append((surface.mesh(job.pick(16, 96, 160)), field, order, length))
    parameters = {"samples": count, "radius": _RADIUS, "degree": _DEGREE, "seed": job.seed}
    return Outcome(checks, parameters, numbers, scenes)


def draw(job: Job, outcome: Outcome, folder: Path) -> list[Path]:
    """Draw both saddles with the maxima and, thinner, the minima of their order."""
    panels = [
        Panel(
            mesh,
            [Strokes(field, [order], length, minima=True, width=0.07)],
            f"order {order}",
            azimuth=18,
            elevation=48,
        )
        for mesh, field, order, length in outcome.scene
    ]
    return sheet(job, panels, folder, "saddles", columns=2)


FIGURE = Figure(
    "saddles",
    "two synthetic surfaces with relevant principal directions of order 3 and 8",
    "Monkey saddle with its order-3 and octopus saddle with its order-8 principal directions at "
    "the centre: maxima thick, minima thin. All other orders vanish.",
    compute,
    draw,
)
