"""Surfaces are what they say: points, normals, areas, noise and seeds."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sp
import trimesh
from scipy import integrate, stats
from scipy.spatial import cKDTree

import synthetic_surfaces
from pdtheory.errors import InputError
from pdtheory.exact.expression import parse_expression
from pdtheory.pointset.cloud import FloatArray, PointCloud
from synthetic_surfaces.height import HeightSurface

NAMES = synthetic_surfaces.names()
VARIANTS = [
    *((name, {}) for name in NAMES),
    ("monkey", {"amplitude": "1/3", "extent": 2}),
    ("saddle", {"folds": 5}),
    ("order3", {"real": 2, "imaginary": -0.5}),
    ("wavejets", {"table": "1,1:0.2-0.1i; 2,0:-1/4; 4,2:1/3i; 5,5:0.1"}),
    ("ellipsoid", {"a": 3, "b": 1, "c": 0.5}),
    ("torus", {"major": 2, "minor": 1.5}),
    ("cylinder", {"radius": 0.5, "length": 4}),
    ("goursat", {"a": -0.25, "b": "1/2", "c": -2}),
    ("cyclide", {"a": 2, "c": 1, "d": 1.25}),
    ("ridge-to-junction", {"step": "1/3", "width": 0.5}),
    ("smooth-t-junction", {"slope": 2, "smoothing": 0.3}),
]


def implicit_form(surface: synthetic_surfaces.Surface) -> sp.Expr:
    """Return F(x, y, z), positive above or outside, from the exact description."""
    description = surface.describe()
    if description.kind not in ("height", "implicit"):
        pytest.skip(f"{description.kind} has no one formula in x, y, z")
    expression = parse_expression(description.expressions[0], description.variables)
    return sp.Symbol("z") - expression if description.kind == "height" else expression


def on_surface(surface: synthetic_surfaces.Surface, cloud: PointCloud) -> None:
    form = implicit_form(surface)
    symbols = sp.symbols("x y z")
    value = sp.lambdify(symbols, form, "numpy")
    gradient = sp.lambdify(symbols, [sp.diff(form, symbol) for symbol in symbols], "numpy")
    slopes = np.empty((len(cloud), 3))
    for axis, part in enumerate(gradient(*cloud.points.T)):
        slopes[:, axis] = part
    lengths = np.linalg.norm(slopes, axis=1)
    assert np.max(np.abs(value(*cloud.points.T)) / lengths) < 1e-12 * surface.diagonal
    assert cloud.normals is not None
    np.testing.assert_allclose(cloud.normals, slopes / lengths[:, None], atol=1e-9)


@pytest.mark.parametrize(("name", "values"), VARIANTS)
def test_samples_and_vertices_satisfy_the_description(name: str, values: dict[str, object]) -> None:
    surface = synthetic_surfaces.get(name, **values)
    on_surface(surface, surface.sample(400, seed=1))
    on_surface(surface, surface.sample(400, method="grid"))
    on_surface(surface, surface.mesh(6))


@pytest.mark.parametrize("name", NAMES)
def test_meshes_are_clean_and_face_outwards(name: str) -> None:
    surface = synthetic_surfaces.get(name)
    cloud = surface.mesh(24)
    assert cloud.faces is not None
    assert cloud.normals is not None
    mesh = trimesh.Trimesh(cloud.points, cloud.faces, process=False)
    assert mesh.is_winding_consistent
    assert np.all(mesh.area_faces > 0)
    assert len(np.unique(cloud.faces)) == len(cloud)
    corner = np.einsum("fij,fj->fi", cloud.normals[cloud.faces], mesh.face_normals)
    # 1/sqrt(3) at the corner of a cube; the part has sharper corners.
    assert corner.min() > (0.1 if name == "cad-part" else 0.5)
    closed = name in ("sphere", "ellipsoid", "torus", "cube", "rounded-cube", "goursat", "cyclide")
    if closed or name == "cad-part":
        assert mesh.is_watertight
        assert mesh.volume > 0
    fine = surface.mesh(48)
    area = trimesh.Trimesh(fine.points, fine.faces, process=False).area
    assert area == pytest.approx(mesh.area, rel=0.01)


def test_exact_volumes_and_areas() -> None:
    for name, volume, area in (
        ("sphere", 4 / 3 * np.pi, 4 * np.pi),
        ("torus", 2 * np.pi**2 * 0.4**2, 4 * np.pi**2 * 0.4),
        ("cube", 8.0, 24.0),
        # Steiner's formula for the parallel body of a cube of side 1.6 at distance 0.2.
        (
            "rounded-cube",
            1.6**3 + 6 * 1.6**2 * 0.2 + 3 * np.pi * 1.6 * 0.2**2 + 4 / 3 * np.pi * 0.2**3,
            6 * 1.6**2 + 6 * np.pi * 1.6 * 0.2 + 4 * np.pi * 0.2**2,
        ),
    ):
        cloud = synthetic_surfaces.get(name).mesh(120)
        mesh = trimesh.Trimesh(cloud.points, cloud.faces, process=False)
        assert mesh.volume == pytest.approx(volume, rel=3e-3)
        assert mesh.area == pytest.approx(area, rel=3e-3)


def test_cones_are_linear_between_their_rays() -> None:
    x, y = np.random.default_rng(1).uniform(-0.7, 0.7, (2, 2000))
    cube_diagonal = np.ones(3) / np.sqrt(3)
    # The octant x_i <= 0 in the frame of its diagonal, its edge against e_1 at azimuth 0.
    across = -np.array([[2, -1, -1], [0, 1, -1]]) / np.sqrt([[6], [2]])
    faces = -np.stack([x, y], axis=1) @ across / cube_diagonal
    for name, expected in (
        ("ridge", -np.abs(y)),
        ("t-junction", -np.minimum(np.abs(y), np.maximum(np.abs(x), -y))),
        ("corner", faces.min(axis=1)),
    ):
        surface = synthetic_surfaces.get(name)
        assert isinstance(surface, HeightSurface)
        np.testing.assert_allclose(surface.height(x, y), expected, atol=1e-14)
    smooth = synthetic_surfaces.get("smooth-t-junction", smoothing=1e-6)
    assert isinstance(smooth, HeightSurface)
    sharp = synthetic_surfaces.get("t-junction")
    assert isinstance(sharp, HeightSurface)
    np.testing.assert_allclose(smooth.height(x, y), sharp.height(x, y), atol=5e-6)


@pytest.mark.parametrize("name", ["ridge", "corner", "planes", "t-junction"])
def test_cones_follow_their_description(name: str) -> None:
    surface = synthetic_surfaces.get(name)
    assert isinstance(surface, HeightSurface)
    rays = [[float(parse_expression(text, ())) for text in ray] for ray in surface.describe().rays]
    angle, slope = np.array(rays).T
    angle = np.radians(angle)
    after, end = np.append(angle[1:], angle[0] + 2 * np.pi), np.roll(slope, -1)
    # On a plane the height at the middle of two points is the mean of their heights.
    for share in (0.0, 0.25, 0.5, 0.9):
        first = (1 - share) * np.stack([np.cos(angle), np.sin(angle)])
        place = first + share * np.stack([np.cos(after), np.sin(after)])
        expected = (1 - share) * slope + share * end
        np.testing.assert_allclose(surface.height(*place), expected, atol=1e-14)
    cloud = surface.sample(500, seed=2)
    dx, dy = surface.gradient(*cloud.points[:, :2].T)
    np.testing.assert_allclose(cloud.points[:, 2], surface.height(*cloud.points[:, :2].T))
    assert cloud.normals is not None
    np.testing.assert_allclose(
        -cloud.normals[:, :2] / cloud.normals[:, 2:], np.stack([dx, dy], axis=1), atol=1e-12
    )


def test_ridge_to_junction_has_the_expansion_it_states() -> None:
    x, y = sp.symbols("x y")
    surface = synthetic_surfaces.get("ridge-to-junction", step="2/3")
    form = parse_expression(surface.describe().expressions[0], ("x", "y"))
    t = sp.Symbol("t")
    ray = form.subs({x: t * x, y: t * y})
    terms = [sp.expand(sp.diff(ray, t, k).subs(t, 0) / sp.factorial(k)) for k in range(4)]
    width, height, step = sp.Rational(1, 4), sp.Rational(1, 4), sp.Rational(2, 3)
    assert terms[0] == height
    assert terms[1] == 0
    assert sp.expand(terms[2] + height * (1 - step / 2) * (y / width) ** 2) == 0
    assert sp.expand(terms[3] - height * step * (y / width) ** 3 / 2) == 0


def test_enneper_is_its_parametric_form() -> None:
    surface = synthetic_surfaces.get("enneper")
    u, v = sp.symbols("u v")
    forms = [parse_expression(text, ("u", "v")) for text in surface.describe().expressions]
    ticks = np.random.default_rng(0).uniform(0, 1, (2, 50))
    chart = surface.charts()[0]
    points, du, dv = chart.evaluate(*ticks)
    at = tuple(0.8 * (2 * ticks - 1))
    value = sp.lambdify((u, v), forms)
    np.testing.assert_allclose(points, np.stack(value(*at), axis=1), atol=1e-14)
    for tangent, symbol in ((du, u), (dv, v)):
        slope = sp.lambdify((u, v), [1.6 * sp.diff(form, symbol) for form in forms])
        np.testing.assert_allclose(
            tangent, np.stack(np.broadcast_arrays(*slope(*at)), axis=1), atol=1e-14
        )


@pytest.mark.parametrize("name", NAMES)
def test_tangents_are_derivatives(name: str) -> None:
    step = 1e-6
    u, v = np.random.default_rng(2).uniform(0.02, 0.98, (2, 40))
    for chart in synthetic_surfaces.get(name).charts():
        _, du, dv = chart.evaluate(u, v)
        for tangent, a, b in ((du, step, 0.0), (dv, 0.0, step)):
            ahead, behind = chart.evaluate(u + a, v + b)[0], chart.evaluate(u - a, v - b)[0]
            np.testing.assert_allclose((ahead - behind) / (2 * step), tangent, atol=1e-7)


def test_samples_are_uniform_by_area() -> None:
    # Archimedes: the height of a uniform point of the sphere is uniform.
    heights = synthetic_surfaces.get("sphere").sample(20_000, seed=5).points[:, 2]
    assert stats.kstest(heights, stats.uniform(-1, 2).cdf).pvalue > 1e-3
    # On a torus the tube angle b has density (1 + q cos b) / (2 pi), q = minor / major.
    torus = synthetic_surfaces.get("torus", major=1, minor="4/5").sample(20_000, seed=5).points
    tube = np.arctan2(torus[:, 2], np.hypot(torus[:, 0], torus[:, 1]) - 1) % (2 * np.pi)
    assert stats.kstest(tube, lambda b: (b + 0.8 * np.sin(b)) / (2 * np.pi)).pvalue > 1e-3
    # On the monkey saddle |grad|^2 = 9 r^4, so the radius has density r sqrt(1 + 9 r^4).
    radius = np.hypot(*synthetic_surfaces.get("monkey").sample(20_000, seed=5).points[:, :2].T)
    ticks = np.linspace(0, 1, 2001)
    mass = integrate.cumulative_simpson(ticks * np.sqrt(1 + 9 * ticks**4), x=ticks, initial=0)
    assert stats.kstest(radius, lambda r: np.interp(r, ticks, mass / mass[-1])).pvalue > 1e-3
    # Flat and round parts of the rounded cube get points by their areas.
    points = synthetic_surfaces.get("rounded-cube").sample(20_000, seed=5).points
    flat = np.sum(np.max(np.abs(points), axis=1) > 1 - 1e-12)
    share = 6 * 1.6**2 / (6 * 1.6**2 + 6 * np.pi * 1.6 * 0.2 + 4 * np.pi * 0.2**2)
    assert stats.binomtest(int(flat), 20_000, share).pvalue > 1e-3


def nearest(points: FloatArray) -> FloatArray:
    return np.asarray(cKDTree(points).query(points, k=2)[0][:, 1])


def test_blue_noise_keeps_its_distance() -> None:
    torus = synthetic_surfaces.get("torus")
    blue, white = torus.sample(1500, method="blue", seed=3), torus.sample(1500, seed=3)
    assert len(blue) == 1500
    on_surface(torus, blue)
    # The radius of the densest packing; elimination reaches about 0.7 of it.
    densest = 2 * np.sqrt(4 * np.pi**2 * 0.4 / (2 * np.sqrt(3) * 1500))
    assert nearest(blue.points).min() > 0.6 * densest
    assert nearest(white.points).min() < 0.1 * densest


def test_grid_of_a_height_function_is_a_lattice_through_the_origin() -> None:
    points = synthetic_surfaces.get("monkey").sample(3000, method="grid").points
    assert abs(len(points) - 3000) < 60
    assert np.any(np.all(points == 0, axis=1))
    steps = np.unique(np.round(np.diff(np.unique(points[:, 0])), 12))
    assert len(steps) == 1


def test_noise_has_the_size_asked_for() -> None:
    torus = synthetic_surfaces.get("torus")
    clean = torus.sample(20_000, seed=4)
    sigma = 0.2 / 100 * np.linalg.norm([2.8, 2.8, 0.8])
    assert torus.diagonal == pytest.approx(np.linalg.norm([2.8, 2.8, 0.8]))
    along = torus.sample(20_000, noise=0.2, seed=4)
    assert clean.normals is not None
    shift = np.einsum("ij,ij->i", along.points - clean.points, clean.normals)
    assert np.std(shift) == pytest.approx(sigma, rel=0.02)
    np.testing.assert_allclose(along.points, clean.points + shift[:, None] * clean.normals)
    spread = torus.sample(20_000, noise=0.2, noise_along="position", seed=4)
    np.testing.assert_allclose(np.std(spread.points - clean.points, axis=0), sigma, rtol=0.02)
    np.testing.assert_array_equal(spread.normals, clean.normals)


def test_outliers_replace_their_share_only() -> None:
    torus = synthetic_surfaces.get("torus")
    clean, dirty = torus.sample(1000, seed=4), torus.sample(1000, outliers=0.1, seed=4)
    moved = np.any(clean.points != dirty.points, axis=1)
    assert moved.sum() == 100
    assert np.all(np.abs(dirty.points) <= 1.2 * np.array([1.4, 1.4, 0.4]) + 1e-12)
    assert dirty.normals is not None
    np.testing.assert_allclose(np.linalg.norm(dirty.normals, axis=1), 1.0)


@pytest.mark.parametrize("method", ["area", "blue", "grid"])
def test_a_seed_fixes_everything(method: synthetic_surfaces.base.Method) -> None:
    surface = synthetic_surfaces.get("ellipsoid")
    options = {"method": method, "noise": 0.1, "outliers": 0.05}
    first, again, other = (
        surface.sample(300, **options, seed=seed)  # type: ignore[arg-type]
        for seed in (1, 1, 2)
    )
    np.testing.assert_array_equal(first.points, again.points)
    assert not np.array_equal(first.points, other.points)


def test_parameters_are_exact() -> None:
    get = synthetic_surfaces.get
    assert "(1/10)**2" in str(get("torus", minor=0.1).describe())
    assert str(get("monkey", amplitude="1/3").describe()) == "z = 1/3*x**3-x*y**2"
    assert str(get("saddle", folds=2).describe()) == "z = x**2-y**2"
    table = get("wavejets", table="3,1:1/3-2i; 3,3:i;2,0:1").values["table"]
    assert {key: tuple(map(str, value)) for key, value in table.items()} == {
        (3, 1): ("1/3", "-2"),
        (3, 3): ("0", "1"),
        (2, 0): ("1", "0"),
    }


@pytest.mark.parametrize(
    ("name", "values", "said"),
    [
        ("nothing", {}, "choose one of monkey"),
        ("torus", {"mayor": 1}, "no parameter 'mayor'"),
        ("torus", {"minor": 1}, "cut itself"),
        ("torus", {"minor": -1}, "out of range"),
        ("torus", {"minor": "nan"}, "cannot be read as a number"),
        ("torus", {"minor": float("inf")}, "cannot be read as a number"),
        ("torus", {"minor": "1/0"}, "cannot be read as a number"),
        ("torus", {"minor": "1e99999999"}, "cannot be read as a number"),
        ("torus", {"minor": "1e-99999999"}, "cannot be read as a number"),
        ("torus", {"minor": "0." + "1" * 10_000}, "at most 10000 are read"),
        ("torus", {"minor": None}, "cannot be read as a number"),
        ("saddle", {"folds": 2.5}, "whole number"),
        ("rounded-cube", {"rounding": 1}, "half the side"),
        ("planes", {"azimuths": "0,90"}, "at least 3"),
        ("planes", {"azimuths": "0,90,270"}, "gaps below 180"),
        ("planes", {"azimuths": "0,200,100"}, "ascend"),
        ("planes", {"slopes": "1,2"}, "2 slopes for 5"),
        ("cyclide", {"d": 2}, "do not ascend"),
        ("cad-part", {"middle": 2}, "do not ascend"),
        ("goursat", {"c": 1}, "out of range"),
        ("wavejets", {"table": ""}, "empty"),
        ("wavejets", {"table": "3,2:1"}, "parity"),
        ("wavejets", {"table": "3,3:__import__('os')"}, "cannot be read as a number"),
        ("wavejets", {"table": "3,3:1e99999999i"}, "cannot be read as a number"),
        ("wavejets", {"table": "3,3=1"}, "cannot read"),
        ("wavejets", {"table": "2,0:i"}, "must be real"),
    ],
)
def test_bad_parameters_get_one_sentence(name: str, values: dict[str, object], said: str) -> None:
    with pytest.raises(InputError, match=said) as caught:
        synthetic_surfaces.get(name, **values)
    assert str(caught.value).endswith(".")


@pytest.mark.parametrize(
    "options",
    [
        {"n": 0},
        {"n": 10**30},
        {"n": 10, "noise": -1.0},
        {"n": 10, "noise": float("nan")},
        {"n": 10, "outliers": 1.0},
        {"n": 10, "method": "other"},
        {"n": 10, "noise_along": "x"},
        {"n": 10, "seed": -1},
    ],
)
def test_bad_sampling_is_refused(options: dict[str, object]) -> None:
    with pytest.raises(InputError):
        synthetic_surfaces.get("torus").sample(**options)  # type: ignore[arg-type]
    with pytest.raises(InputError):
        synthetic_surfaces.get("torus").mesh(1)
    with pytest.raises(InputError):
        synthetic_surfaces.get("torus").mesh(10**20)
