"""The truth: sites lie on their surfaces, and agree with closed forms and with samples."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sp

import synthetic_surfaces
from pdtheory.errors import InputError
from pdtheory.exact import parse_expression, real_eigenpairs
from pdtheory.pointset import estimate_directions

NAMES = synthetic_surfaces.names()


def curvatures(name: str, site: int = 0, **values: object) -> list[float]:
    jet = synthetic_surfaces.get(name, **values).sites()[site].jet(2)
    return sorted(float(value) for value in jet.principal_curvatures())


@pytest.mark.parametrize("name", NAMES)
def test_sites_lie_on_the_surface_and_name_their_normal(name: str) -> None:
    surface = synthetic_surfaces.get(name)
    mesh = surface.mesh(48)
    assert mesh.normals is not None
    sites = surface.sites()
    assert sites
    for site in sites:
        if site.smooth:
            jet = site.jet(2)
            place, normal = np.array([float(c) for c in jet.point]), jet.numeric_frame()[2]
        else:
            assert site.place is not None
            assert site.frame is not None
            np.testing.assert_allclose(site.frame @ site.frame.T, np.eye(3), atol=1e-15)
            assert np.linalg.det(site.frame) == pytest.approx(1.0)
            place, normal = site.place, site.frame[2]
        gap = np.linalg.norm(mesh.points - place, axis=1)
        assert gap.min() < 0.05 * surface.diagonal
        # Up to the sign, since a parametric normal may point to either side.
        assert abs(mesh.normals[gap.argmin()] @ normal) > 0.95


def test_curvatures_of_the_classics() -> None:
    assert curvatures("sphere", radius=2) == pytest.approx([-0.5, -0.5])
    assert curvatures("ellipsoid", a=3, b=2, c=1) == pytest.approx([-3.0, -0.75])  # -a/c^2, -a/b^2
    assert curvatures("cylinder", radius=0.5) == pytest.approx([-2.0, 0.0])
    assert curvatures("torus", 0) == pytest.approx([-2.5, -1 / 1.4])
    assert curvatures("torus", 1) == pytest.approx([-2.5, 1 / 0.6])
    assert curvatures("torus", 2) == pytest.approx([-2.5, 0.0])
    assert curvatures("enneper") == pytest.approx([-k, k] if (k := 2 / (1 + 5 / 64) ** 2) else [])
    assert curvatures("rounded-cube", 0) == pytest.approx([-5.0, 0.0])
    assert curvatures("rounded-cube", 1) == pytest.approx([-5.0, -5.0])
    assert curvatures("rounded-cube", 2) == pytest.approx([0.0, 0.0])
    # Where the plane of symmetry cuts the cyclide it cuts circles of radius d + c and d - c.
    assert curvatures("cyclide", 1)[0] == pytest.approx(-1 / (0.5 - 0.3))


@pytest.mark.parametrize(("name", "order"), [("monkey", 3), ("octopus", 8), ("saddle", 3)])
def test_saddles_have_one_order_with_lambda_k_factorial(name: str, order: int) -> None:
    jet = synthetic_surfaces.get(name).sites()[0].jet(order)
    pairs = jet.eigenpairs(order)
    assert [pair.eigenvalue for pair in pairs.maxima] == [sp.factorial(order)] * order
    assert [jet.eigenpairs(k).status for k in range(2, order)] == ["vanishing"] * (order - 2)


def test_wavejets_table_comes_back() -> None:
    surface = synthetic_surfaces.get("wavejets", table="2,0:1/3; 2,2:1/4-i; 3,1:2i; 5,5:1/7")
    jet = surface.sites()[0].jet(5)
    found = {key: value for key, value in jet.wavejets.items() if value != 0}
    half = sp.Rational
    assert found == {
        (2, 0): half(1, 3),
        (2, 2): half(1, 4) - sp.I,
        (3, 1): 2 * sp.I,
        (5, 5): half(1, 7),
    }


@pytest.mark.parametrize(
    ("name", "values", "degree", "radius", "tolerance"),
    [
        ("torus", {}, 10, 0.25, 1e-4),
        ("ellipsoid", {}, 10, 0.3, 1e-4),
        ("goursat", {}, 10, 0.3, 1e-4),
        ("cyclide", {}, 10, 0.15, 1e-4),
        ("enneper", {}, 10, 0.2, 1e-4),
        ("polynomial", {"degree": 6}, 6, 0.3, 1e-8),
        ("ridge-to-junction", {}, 10, 0.12, 1e-4),
    ],
)
def test_samples_agree_with_the_truth(
    name: str, values: dict[str, object], degree: int, radius: float, tolerance: float
) -> None:
    surface = synthetic_surfaces.get(name, **values)
    jet = surface.sites()[0].jet(3)
    place = np.array([[float(c) for c in jet.point]])
    t1, t2, normal = jet.numeric_frame()
    chart_side = surface.sample(200_000, seed=3)
    near = np.linalg.norm(chart_side.points - place, axis=1) < 2 * radius
    points = chart_side.points[near]
    field = estimate_directions(
        points,
        normals=np.tile(normal, (len(points), 1)),
        radius=radius,
        degree=degree,
        orders=[2, 3],
        queries=place,
    )
    turn = np.arctan2(field.frames[0, 0] @ t2, field.frames[0, 0] @ t1)
    assert field.frames[0, 2] @ normal > 1 - 1e-6
    for order in (2, 3):
        for n, exact in jet.row(order).to_complex().items():
            found = field.coefficient(order, n)[0] * np.exp(-1j * n * turn)
            assert abs(found - exact) * radius ** (order - 1) < tolerance


def test_cube_predictions_say_what_vanishes() -> None:
    edge, corner, face = synthetic_surfaces.get("cube").sites()
    at_edge, at_corner = edge.prediction(10, [2, 3]), corner.prediction(10, [2, 3])
    assert real_eigenpairs(at_edge.row(3)).status == "vanishing"
    assert real_eigenpairs(at_corner.row(2)).status == "isotropic"
    assert face.smooth
    crest = real_eigenpairs(at_edge.row(2)).maxima
    assert [float(pair.angle_degrees()) for pair in crest] == [0.0, 180.0]
    edges = real_eigenpairs(at_corner.row(3)).maxima
    assert [float(pair.angle_degrees()) for pair in edges] == pytest.approx([0, 120, 240])


def test_a_prediction_is_met_by_dense_samples() -> None:
    surface = synthetic_surfaces.get("planes")
    prediction = surface.sites()[0].prediction(10, [2, 3, 4, 5])
    cloud = surface.sample(200_000, method="grid")
    field = estimate_directions(
        cloud.points,
        normals=np.tile([0.0, 0.0, 1.0], (len(cloud), 1)),
        radius=1.0,
        degree=10,
        orders=[2, 3, 4, 5],
        frame="given",
        weight_distance="planar",
        queries=np.zeros((1, 3)),
    )
    turn = np.arctan2(field.frames[0, 0, 1], field.frames[0, 0, 0])
    for order in field.orders:
        for n, exact in prediction.row(order).to_complex().items():
            found = field.coefficient(order, n)[0] * np.exp(-1j * n * turn)
            assert abs(found - exact) < 2e-3 * max(1.0, abs(exact))


def test_truth_is_refused_where_there_is_none() -> None:
    ridge, torus = (synthetic_surfaces.get(name).sites()[0] for name in ("ridge", "torus"))
    with pytest.raises(InputError, match="no derivatives at its apex"):
        ridge.jet(3)
    with pytest.raises(InputError, match="smooth"):
        torus.prediction(10, [2])
    with pytest.raises(InputError):
        torus.jet(3, at=("1", "1", "1"))


def test_every_formula_is_one_that_users_may_type() -> None:
    for name in NAMES:
        for site in synthetic_surfaces.get(name).sites():
            for text in site.description.expressions:
                parse_expression(text, site.description.variables)
