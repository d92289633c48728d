"""A cube: order 3 vanishes on the edges, the direction of order 2 at the corners."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

import synthetic_surfaces
from pdtheory.paper.figures.measure import angles_in, angles_of, anisotropy, worst_angle
from pdtheory.paper.figures.outcome import Check, Figure, Job, Outcome, at_most
from pdtheory.paper.figures.stage import Panel, Strokes, sheet
from pdtheory.pointset import estimate_directions
from pdtheory.pointset.cloud import FloatArray, PointCloud
from pdtheory.pointset.field import DirectionField

RADIUS = 0.3
DEGREE = 10
SIDE = 2.0

#: Places along an edge of length 2 at which directions are computed, apart from its ends.
_ALONG = np.linspace(-0.66, 0.66, 5)


def places() -> tuple[FloatArray, FloatArray]:
    """Return points on all edges (60, 3) and the corners (8, 3) of the cube."""
    edges = []
    for axis in range(3):
        for s in (-1.0, 1.0):
            for t in (-1.0, 1.0):
                for along in _ALONG:
                    edges.append(np.roll([along, s, t], axis))
    signs = np.array([[s, t, u] for s in (-1, 1) for t in (-1, 1) for u in (-1, 1)], dtype=float)
    return np.array(edges), signs


def estimate(samples: PointCloud, **options: Any) -> DirectionField:
    """Estimate orders 2 and 3 at all places; edges come first."""
    edges, corners = places()
    return estimate_directions(
        samples,
        radius=RADIUS,
        degree=DEGREE,
        orders=[2, 3],
        queries=np.concatenate([edges, corners]),
        **options,
    )


def compute(job: Job) -> Outcome:
    """Estimate on edges and corners, and compare with what cones predict."""
    surface = synthetic_surfaces.get("cube")
    count = 6 * job.pick(100, 260, 400) ** 2
    field = estimate(surface.sample(count, method="grid"), weight_distance="planar")
    edges = len(places()[0])
    two, three = anisotropy(field, 2), anisotropy(field, 3)
    edge, corner, _ = surface.sites()
    predicted = {
        "edge": edge.prediction(DEGREE, [2, 3], radius=Fraction(3, 10)),
        "corner": corner.prediction(DEGREE, [2, 3], radius=Fraction(3, 10)),
    }
    edge_2 = 2 * abs(predicted["edge"].row(2).to_complex()[2]) * RADIUS
    corner_3 = 2 * abs(predicted["corner"].row(3).to_complex()[3]) * RADIUS**2
    because = "the two faces, or the three, are alike"
    bound = job.pick(2e-2, 2e-3, 2e-3)
    checks: list[Check] = [
        at_most("edges: order 3 against order 2 on the edges (largest)",
                three[:edges].max() / edge_2, bound, because),
        at_most("corners: direction of order 2 against order 2 on the edges (largest)",
                two[edges:].max() / edge_2, bound, because),
        at_most("edges: relative error of the amplitude of order 2 (largest)",
                np.max(np.abs(two[:edges] / edge_2 - 1)), bound, "exact prediction of a ridge"),
        at_most("corners: relative error of the amplitude of order 3 (largest)",
                np.max(np.abs(three[edges:] / corner_3 - 1)), 5 * bound,
                "exact prediction of a corner"),
    ]  # fmt: skip
    angles = angles_of(predicted["corner"].eigenpairs(3).maxima)
    worst = []
    for index, place in enumerate(places()[1]):
        normal = place / np.linalg.norm(place)
        first = np.array([-place[0], 0, 0]) - normal * (-place[0] * normal[0])
        first /= np.linalg.norm(first)
        found = angles_in(field[3].maxima, edges + index, first, np.cross(normal, first))
        worst.append(worst_angle(found, angles))
    checks.append(
        at_most("corners: worst angle in degrees between order-3 maxima and the edges",
                max(worst), 0.5, "the edges are a 3-RoSy")
    )  # fmt: skip
    numbers = {
        "amplitude of order 2, edges and corners": [float(np.median(two[:edges])),
                                                    float(np.median(two[edges:]))],
        "amplitude of order 3, edges and corners": [float(np.median(three[:edges])),
                                                    float(np.median(three[edges:]))],
    }  # fmt: skip
    parameters = {"samples": count, "radius": RADIUS, "degree": DEGREE, "samples on": "a grid"}
    return Outcome(checks, parameters, numbers, (surface.mesh(job.pick(8, 60, 60)), field))


def panels(mesh: PointCloud, field: DirectionField, title: str = "") -> list[Panel]:
    """Return one panel of order 2 and one of order 3, lengths by what depends on the angle."""
    result = []
    for order in (2, 3):
        swing = anisotropy(field, order)
        full = float(np.quantile(swing, 0.9))
        strokes = Strokes(
            field,
            [order],
            0.2,
            full=full,
            width=0.14,
            minima=order == 2,
            least=0.08 * full,
            amplitude=swing,
        )
        result.append(Panel(mesh, [strokes], f"order {order}{title}", azimuth=35, elevation=28))
    return result


def draw(job: Job, outcome: Outcome, folder: Path) -> list[Path]:
    """Draw orders 2 and 3 on the edges and corners."""
    mesh, field = outcome.scene
    return sheet(job, panels(mesh, field), folder, "cube", columns=2, size=(600, 520))


FIGURE = Figure(
    "cube",
    "order 2 and 3 principal directions on the edges and corners of a cube",
    "Order 2 lies along and across the edges and loses its direction at the corners, where only "
    "its isotropic part is left; order 3 vanishes on the edges and finds all three at a corner.",
    compute,
    draw,
)
