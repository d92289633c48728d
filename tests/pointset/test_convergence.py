"""Convergence to exact jets on smooth surfaces, and to the exact prediction on cones."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sp
from scipy.stats import qmc

from pdtheory.conventions import wavejets_table
from pdtheory.exact.cones import Cone
from pdtheory.exact.jets import implicit_jet
from pdtheory.exact.prediction import predict
from pdtheory.pointset import estimate_directions
from tests.pointset.surfaces import disc

X, Y, Z = VARIABLES = sp.symbols("x y z")
Q = sp.Rational

#: Implicit surface and a point of it with rational coordinates.
SURFACES = {
    "torus": (
        (X**2 + Y**2 + Z**2 + 1 - Q(1, 4)) ** 2 - 4 * (X**2 + Y**2),
        (Q(13, 10), 0, Q(4, 10)),
    ),
    "ellipsoid": (
        X**2 + Y**2 / Q(9, 4) + Z**2 / Q(16, 9) - 1,
        (Q(2, 3), Q(1, 1), Q(4, 9)),
    ),
    "sphere": (X**2 + Y**2 + Z**2 - 1, (Q(2, 3), Q(1, 3), Q(2, 3))),
    "goursat": (X**4 + Y**4 + Z**4 - X**2 - Y**2 - Z**2 + Q(3, 16), (Q(1, 2), Q(0), Q(1))),
    "monge": (Z - sp.exp(X) * sp.cos(Y) / 4 - X * Y**2 / 8, (Q(0), Q(0), Q(1, 4))),
}


def _samples(expression, jet, radius, count):
    """Points of the surface over a disc in the tangent plane, by Newton along the normal."""
    frame = jet.numeric_frame()
    centre = np.array([float(c) for c in jet.point])
    value = sp.lambdify(VARIABLES, expression)
    slopes = sp.lambdify(VARIABLES, [sp.diff(expression, v) for v in VARIABLES])
    points = centre + 1.1 * radius * disc(count, 1.0, 8) @ frame[:2]
    for _ in range(60):
        slope = sum(np.asarray(s) * frame[2, i] for i, s in enumerate(slopes(*points.T)))
        step = value(*points.T) / slope
        points = points - step[:, None] * frame[2]
        if np.abs(step).max() < 1e-15:
            break
    return points


@pytest.mark.parametrize(("degree", "radii"), [(4, (0.12, 0.06)), (10, (0.3, 0.2))])
@pytest.mark.parametrize("name", SURFACES)
def test_smooth_surfaces(name, degree, radii):
    expression, point = SURFACES[name]
    jet = implicit_jet(expression, VARIABLES, 4, point)
    frame, exact = jet.numeric_frame(), jet.numeric_phi()
    errors = []
    for radius in radii:
        points = _samples(expression, jet, radius, 600)
        field = estimate_directions(
            points,
            radius=radius,
            degree=degree,
            orders=(2, 3, 4),
            queries=[0],
            normals=np.tile(frame[2], (len(points), 1)),
        )
        turn = np.arctan2(field.frames[0, 0] @ frame[1], field.frames[0, 0] @ frame[0])
        table = wavejets_table(4)
        difference = [
            abs(field.coefficient(k, n)[0] - exact[c] * np.exp(1j * n * turn))
            for c, (k, n) in enumerate(table)
        ]
        errors.append([max(d for d, (k, _) in zip(difference, table, strict=True) if k == order)
                       for order in (2, 3, 4)])  # fmt: skip
    slope = np.log(np.array(errors[0]) / errors[1]) / np.log(radii[0] / radii[1])
    for i, order in enumerate((2, 3, 4)):
        resolved = 1e-12 / radii[1] ** order
        assert errors[1][i] < resolved or slope[i] > degree + 1 - order - 0.5, (errors, slope)


def _cone_points(cone, power, measure):
    """Samples of z = r h(theta), even in the plane or on the surface, well beyond the radius 1.

    A low-discrepancy sequence of 2^power points, so that their sums are close to integrals.
    """
    u, v, w = qmc.Sobol(3, seed=1).random_base2(power).T
    xy = 3 * np.column_stack([u, v]) - 1.5
    edges = np.array([float(a) for a, _ in cone.rays])
    angle = np.degrees(np.arctan2(xy[:, 1], xy[:, 0]))
    sector = np.searchsorted(edges, (angle - edges[0]) % 360 + edges[0], side="right") - 1
    gradient = np.array([[float(c) for c in g] for g in cone.gradients])[sector]
    points = np.column_stack([xy, np.sum(gradient * xy, axis=1)])
    if measure == "surface":
        area = np.sqrt(1 + np.sum(gradient**2, axis=1))
        points = points[w < area / area.max()]
    return points


@pytest.mark.parametrize("degree", [pytest.param(7, marks=pytest.mark.slow), 10])
@pytest.mark.parametrize(("distance", "measure"), [("planar", "flat"), ("3d", "surface")])
@pytest.mark.parametrize(
    "cone",
    [
        pytest.param(Cone.ridge(Q(1, 2)), id="ridge"),
        pytest.param(Cone.t_junction(Q(1, 3)), id="t"),
        pytest.param(Cone.corner(), id="corner"),
        pytest.param(
            Cone(((0, Q(1, 4)), (80, -Q(1, 5)), (150, 0), (220, Q(1, 3)), (290, -Q(1, 4)))),
            id="planes",
            marks=pytest.mark.slow,
        ),
    ],
)
def test_cones(cone, distance, measure, degree):
    expected = predict(cone, degree, range(2, 8), measure=measure).numeric_phi()
    table = wavejets_table(degree)
    known = [c for c, (k, _) in enumerate(table) if 2 <= k <= 7]
    gaps = []
    for power in (13, 17):
        points = _cone_points(cone, power, measure)
        field = estimate_directions(
            points,
            radius=1.0,
            degree=degree,
            orders=(2,),
            queries=[[0.0, 0.0, 0.0]],
            normals=np.tile([0.0, 0.0, 1.0], (len(points), 1)),
            frame="given",
            weight_distance=distance,
        )
        gaps.append(np.abs(field.phi[0] - expected)[known].max())
    scale = np.abs(expected[known]).max()
    assert gaps[1] < 0.01 * scale, (gaps, scale)
    assert gaps[1] < 0.5 * gaps[0], (gaps, scale)
