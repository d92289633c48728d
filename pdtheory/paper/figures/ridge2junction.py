"""A ridge that grows a branch: order 3 slowly takes over from order 2."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import synthetic_surfaces
from pdtheory.paper.figures.measure import angles_in, circular_distance, exact_rows
from pdtheory.paper.figures.outcome import Check, Figure, Job, Outcome, at_most
from pdtheory.paper.figures.stage import Panel, Strokes, sheet
from pdtheory.pointset import estimate_directions
from synthetic_surfaces.spread import OVERSAMPLING, thin

#: How far the branch has grown.
STEPS = ("0", "1/2", "1")
_WIDTH = "3/10"
_EXTENT = "4/5"
_RADIUS = 0.2
_DEGREE = 10


def compute(job: Job) -> Outcome:
    """Estimate orders 2 and 3, and compare those at the junction with the exact ones."""
    checks: list[Check] = []
    numbers = {}
    scenes = []
    ratios = []
    count = job.pick(20_000, 60_000, 200_000)
    for step in STEPS:
        surface = synthetic_surfaces.get(
            "ridge-to-junction", step=step, width=_WIDTH, height=_WIDTH, extent=_EXTENT
        )
        samples = surface.sample(count, seed=job.seed)
        inner = (
            np.linalg.norm(samples.points[:, :2], axis=1) < float(surface.values["extent"]) - 0.06
        )
        wanted = job.pick(40, 240, 240)
        candidates = samples.points[inner][: OVERSAMPLING * wanted]
        spots = candidates[thin(candidates, wanted)]
        centre = np.array([[0.0, 0.0, float(surface.values["height"])]])
        field = estimate_directions(
            samples,
            radius=_RADIUS,
            degree=_DEGREE,
            orders=[2, 3],
            queries=np.concatenate([centre, spots]),
        )
        rows = exact_rows(surface, [2, 3])
        frame = field.frames[0]
        turn = np.arctan2(frame[0, 1], frame[0, 0])
        for order in (2, 3):
            exact = rows[order].to_complex()
            worst = max(
                abs(field.coefficient(order, n)[0] * np.exp(-1j * n * turn) - exact[n])
                for n in exact
            )
            checks.append(
                at_most(
                    f"step {step}: error of phi of order {order} times R^{order - 1}",
                    worst * _RADIUS ** (order - 1),
                    2e-4,
                    f"the exact expansion; the fit has degree {_DEGREE}",
                )
            )
        strongest = {order: field[order].maxima.strengths[0].max(initial=0.0) for order in (2, 3)}
        least = np.max(np.abs(field[2].eigenvalues[0])) / 2 * _RADIUS
        ratios.append(strongest[3] / least)
        if step != "0":
            up = angles_in(field[3].maxima, 0, [1, 0, 0], [0, 1, 0])
            checks.append(
                at_most(
                    f"step {step}: angle in degrees between the branch and an order-3 maximum",
                    circular_distance(np.array([np.pi / 2]), up)[0],
                    2.0,
                    "g_3 is a multiple of y^3",
                )
            )
        numbers[step] = {"strength of order 3 over order 2 at the junction": ratios[-1]}
        scenes.append((step, surface.mesh(job.pick(16, 96, 160)), field))
    checks += [
        at_most("order 3 over order 2 on the ridge", ratios[0], 1e-3, "a ridge is symmetric"),
        Check(
            "smallest gain of order 3 over order 2 from step to step",
            float(np.min(np.diff(ratios))),
            1e-2,
            float("inf"),
            "order 3 slowly takes over from order 2",
        ),
    ]
    parameters = {"samples": count, "radius": _RADIUS, "degree": _DEGREE, "seed": job.seed}
    return Outcome(checks, parameters, numbers, scenes)


def draw(job: Job, outcome: Outcome, folder: Path) -> list[Path]:
    """Draw order 2 above and order 3 below, lengths by strength on one scale for each row."""
    panels = []
    for order in (2, 3):
        strengths = [field[order].strength for _, _, field in outcome.scene]
        full = float(np.quantile(np.concatenate(strengths), 0.92))
        panels += [
            Panel(
                mesh,
                [
                    Strokes(
                        field,
                        [order],
                        0.08,
                        full=full,
                        width=0.16,
                        least=0.22 * full,
                        minima=order == 2,
                    )
                ],
                f"order {order}, step {step}",
                azimuth=203,
                elevation=46,
            )
            for step, mesh, field in outcome.scene
        ]
    return sheet(job, panels, folder, "ridge2junction", columns=3, size=(560, 440))


FIGURE = Figure(
    "ridge2junction",
    "order 2 and 3 principal directions on a surface evolving from a ridge to a smooth T-junction",
    "Orders 2 (top, minima thin) and 3 (bottom) while a branch grows out of a ridge; length by "
    "strength. On the ridge order 3 vanishes; at the junction it points along the branch.",
    compute,
    draw,
)
