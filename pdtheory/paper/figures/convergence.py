"""How the errors of phi and of the angles fall with the radius."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

import synthetic_surfaces
from pdtheory.conventions import frequencies
from pdtheory.exact import real_eigenpairs
from pdtheory.paper.figures.measure import angles_in, angles_of, worst_angle
from pdtheory.paper.figures.outcome import Check, Figure, Job, Outcome
from pdtheory.paper.figures.plots import colour, new_plot, pyplot, save
from pdtheory.pointset import estimate_directions
from synthetic_surfaces.height import HeightSurface

#: A surface of much higher degree than the fits, without symmetry.
_PARAMETERS = {"degree": 12, "seed": 3, "roughness": "1/8"}
_DEGREE = 5
_ORDERS = (1, 2, 3, 4, 5)


def compute(job: Job) -> Outcome:
    """Fit lattices of one shape and ever smaller size, so that only the radius changes."""
    surface = synthetic_surfaces.get("polynomial", **_PARAMETERS)
    assert isinstance(surface, HeightSurface)
    jet = surface.sites()[0].jet(_DEGREE)
    place = np.array([[float(c) for c in jet.point]])
    t1, t2, normal = jet.numeric_frame()
    radii = np.geomspace(0.32, 0.08, job.pick(4, 7, 9))
    half = job.pick(14, 24, 32)
    ticks = np.arange(-half, half + 1) / half
    x, y = (part.ravel() for part in np.meshgrid(ticks, ticks))
    errors: dict[tuple[int, int], list[float]] = {}
    turns: dict[int, list[float]] = {order: [] for order in _ORDERS[1:]}
    for radius in radii:
        wide = 1.5 * radius
        px, py = place[0, 0] + wide * x, place[0, 1] + wide * y
        points = np.stack([px, py, surface.height(px, py)], axis=1)
        field = estimate_directions(
            points,
            normals=np.tile(normal, (len(points), 1)),
            radius=float(radius),
            degree=_DEGREE,
            orders=_ORDERS,
            frame="given",
            queries=place,
        )
        turn = np.arctan2(field.frames[0, 0] @ t2, field.frames[0, 0] @ t1)
        for order in _ORDERS:
            exact = jet.row(order).to_complex()
            for n in frequencies(order):
                found = field.coefficient(order, n)[0] * np.exp(-1j * n * turn)
                errors.setdefault((order, n), []).append(abs(found - exact[n]))
            if order > 1:
                expected = angles_of(real_eigenpairs(jet.row(order)).maxima)
                turns[order].append(
                    worst_angle(angles_in(field[order].maxima, 0, t1, t2), expected)
                )
    checks: list[Check] = []
    numbers: dict[str, Any] = {}
    for order in _ORDERS:
        total = np.sqrt(np.sum([np.square(errors[order, n]) for n in frequencies(order)], axis=0))
        slope = float(np.polyfit(np.log(radii), np.log(total), 1)[0])
        theory = _DEGREE + 1 - order
        numbers[f"slope of phi of order {order}"] = slope
        # On a full disc the leading error of order k vanishes by symmetry when K - k is even.
        gain = 1 if (_DEGREE - order) % 2 == 0 else 0
        best = theory + gain
        checks.append(
            Check(
                f"slope of the error of phi of order {order}",
                slope,
                best - 0.35,
                best + 0.6,
                f"O(R^(K+1-k)), K = {_DEGREE}" + (", one better by symmetry" if gain else ""),
            )
        )
    parameters = {"surface": repr(surface), "degree": _DEGREE, "radii": radii.tolist()}
    return Outcome(checks, parameters, numbers, (radii, errors, turns))


def draw(job: Job, outcome: Outcome, folder: Path) -> list[Path]:
    """Plot the errors of phi and of the worst angle against the radius."""
    radii, errors, turns = outcome.scene
    pyplot()
    figure = new_plot(7.2, 3.4)
    left = figure.add_axes((0.09, 0.15, 0.39, 0.80))
    right = figure.add_axes((0.59, 0.15, 0.39, 0.80))
    styles = {0: "-", 1: "-", 2: "--", 3: "--", 4: ":", 5: ":"}
    for (order, n), values in errors.items():
        shade = colour(order) if order > 1 else (0.4, 0.4, 0.4)
        label = rf"$\phi_{{{order},{n}}}$"
        left.loglog(radii, values, styles[n], marker=".", color=shade, label=label)
    left.set_ylabel("error of the coefficient")
    for order, values in turns.items():
        usable = np.array(values) < 90
        right.loglog(
            radii[usable], np.array(values)[usable], marker=".", color=colour(order),
            label=f"order {order}",
        )  # fmt: skip
    right.set_ylabel("worst angle of a maximum, degrees")
    for axes in (left, right):
        axes.set_xlabel("radius R")
        axes.legend(fontsize=7, ncol=2)
    return save(figure, folder / "convergence.png", vector=True)


FIGURE = Figure(
    "convergence",
    "beyond the paper",
    "Error of the coefficients (left) and of the worst maximum (right) against the radius, for "
    f"fits of degree K = {_DEGREE} to a polynomial surface of degree 12. The slopes are K + 1 - k, "
    "or one better.",
    compute,
    draw,
)
