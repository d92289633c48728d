"""Order 3 on a family of surfaces: three maxima inside the deltoid, one outside."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import synthetic_surfaces
from pdtheory.exact import real_eigenpairs
from pdtheory.paper.figures.measure import angles_in, angles_of, exact_rows, worst_angle
from pdtheory.paper.figures.outcome import Check, Figure, Job, Outcome, at_most, equal
from pdtheory.paper.figures.stage import Panel, Strokes, sheet
from pdtheory.pointset import estimate_directions

#: phi_31 / phi_33 on the way out of the deltoid, which ends at 3 in this direction.
STEPS = ("0", "1", "2.5", "4", "8")
_PHI33 = "1/10"
_RADIUS = 0.6
_DEGREE = 6


def discriminant(p1: complex, p3: complex) -> float:
    """Return D3, negative exactly where order 3 has three maxima."""
    a, b = abs(p1) ** 2, abs(p3) ** 2
    return a**2 + 162 * a * b - 2187 * b**2 + 24 * (p1**3 * np.conj(p3)).real


def compute(job: Job) -> Outcome:
    """Count the maxima of every step, exactly and on samples, and compare their angles."""
    checks: list[Check] = []
    numbers = {}
    scenes = []
    count = job.pick(2_000, 20_000, 60_000)
    for step in STEPS:
        surface = synthetic_surfaces.get("order3", real=step, phi33=_PHI33)
        field = estimate_directions(
            surface.sample(count, seed=job.seed),
            radius=_RADIUS,
            degree=_DEGREE,
            orders=[2, 3],
            queries=np.zeros((1, 3)),
        )
        row = exact_rows(surface, [3])[3]
        found = angles_in(field[3].maxima, 0, [1, 0, 0], [0, 1, 0])
        expected = angles_of(real_eigenpairs(row).maxima)
        values = row.to_complex()
        wanted = 3 if discriminant(values[1], values[3]) < 0 else 1
        checks += [
            equal(f"phi_31 = {step} phi_33: exact number of maxima", len(expected), wanted,
                  "sign of the discriminant D3"),
            equal(f"phi_31 = {step} phi_33: number of maxima on samples", len(found), wanted,
                  "sign of the discriminant D3"),
            at_most(f"phi_31 = {step} phi_33: worst angle in degrees",
                    worst_angle(found, expected), 1e-5, "a cubic is fitted exactly"),
        ]  # fmt: skip
        numbers[step] = {"maxima in degrees": np.degrees(found).tolist(), "exact": len(expected)}
        scenes.append((step, surface.mesh(job.pick(16, 80, 140)), field))
    parameters = {"samples": count, "radius": _RADIUS, "degree": _DEGREE, "seed": job.seed}
    return Outcome(checks, parameters, numbers, scenes)


def draw(job: Job, outcome: Outcome, folder: Path) -> list[Path]:
    """Draw the five surfaces with the maxima and, thinner, the minima at the centre."""
    panels = [
        Panel(
            mesh,
            [Strokes(field, [3], 0.6, minima=True, width=0.07)],
            rf"$\phi_{{3,1}} = {step}\,\phi_{{3,3}}$",
            azimuth=20,
            elevation=48,
        )
        for step, mesh, field in outcome.scene
    ]
    return sheet(job, panels, folder, "order3", columns=5, size=(480, 400))


FIGURE = Figure(
    "order3",
    "order 3 principal directions on a surface controlled by its Wavejets coefficients",
    "Order-3 directions (maxima thick, minima thin) as phi_31 grows against a fixed phi_33. Inside "
    "the deltoid, here below 3, there are three maxima; outside there is one.",
    compute,
    draw,
)
