"""Cones: closed forms against integrals and against least squares on dense samples."""

from itertools import pairwise

import mpmath
import numpy as np
import pytest
import sympy as sp

from pdtheory.conventions import wavejets_table
from pdtheory.errors import InputError
from pdtheory.exact import Cone, cone_coefficient, predict, radial_moment

half = sp.Rational(1, 2)
IRREGULAR = Cone(((0, 1), (60, -half), (150, sp.Rational(1, 3)), (210, 0), (285, -1)))
SEVENTY = Cone(((0, 1), (70, -half), (150, 0), (250, -1)))
CONES = {
    "ridge": Cone.ridge(half),
    "corner": Cone.corner(),
    "t-junction": Cone.t_junction(),
    "irregular": IRREGULAR,
}


@pytest.mark.parametrize("weight", ["gaussian", "uniform"])
def test_moments_by_quadrature(weight):
    with mpmath.workdps(40):
        for m in range(0, 21, 3):
            w = (lambda r: mpmath.exp(-4.5 * r * r)) if weight == "gaussian" else (lambda r: 1)
            value = mpmath.quad(lambda r, m=m, w=w: w(r) * r**m, [0, 0.5, 1])
            assert abs(value - mpmath.mpf(sp.N(radial_moment(m, weight), 40))) < 1e-30


@pytest.mark.parametrize("name", CONES)
def test_fourier_coefficients_by_quadrature(name):
    cone = CONES[name]
    edges = [float(a) for a, _ in cone.rays]
    edges.append(edges[0] + 360)
    abscissae, weights = np.polynomial.legendre.leggauss(30)
    for n in range(7):
        total = 0
        for a, b in pairwise(edges):
            angles = (a + b) / 2 + (b - a) / 2 * abscissae
            h = np.array([cone(t) for t in angles])
            total += (
                np.deg2rad(b - a) / 2 * weights * h * np.exp(-1j * n * np.deg2rad(angles))
            ).sum()
        assert complex(cone.fourier(n)) == pytest.approx(total / (2 * np.pi), abs=1e-13)
        assert complex(cone.fourier(-n)) == pytest.approx(np.conj(total) / (2 * np.pi), abs=1e-13)


def test_angles_without_radicals():
    prediction = predict(SEVENTY, 4)
    fitted = least_squares(SEVENTY, 4, "flat", "gaussian")
    own = prediction.numeric_phi()
    assert np.abs(own - fitted)[~np.isnan(own)].max() < 1e-9


def test_jumps_close():
    # sum_j J_j e^{i a_j} = 0: h'' + h has no frequency 1.
    for cone in CONES.values():
        total = sum(
            j * sp.exp(sp.I * sp.pi * a / 180)
            for j, (a, _) in zip(cone.jumps, cone.rays, strict=True)
        )
        assert abs(sp.N(total, 30)) < 1e-25


def test_known_coefficient():
    assert cone_coefficient(3, 3, 10, "uniform") == sp.Rational(28, 3)
    assert cone_coefficient(3, 3, 3, "uniform") == sp.Rational(4, 3)
    assert [cone_coefficient(k, 1, 10) for k in (1, 3, 5)] == [1, 0, 0]


def least_squares(cone, degree, measure, weight):
    """Fit by NumPy on a polar product rule that integrates the measure: no part of the theory."""
    radial, radial_weight = np.polynomial.legendre.leggauss(60)
    edges = [float(a) for a, _ in cone.rays]
    edges.append(edges[0] + 360)
    nodes, node_weights = np.polynomial.legendre.leggauss(40)
    rows, values = [], []
    for (a, b), gradient in zip(pairwise(edges), cone.gradients, strict=True):
        p, q = (float(c) for c in gradient)
        angle = np.deg2rad((a + b) / 2 + (b - a) / 2 * nodes)[:, None]
        h = p * np.cos(angle) + q * np.sin(angle)
        reach = 1 / np.sqrt(1 + h**2) if measure == "surface" else np.ones_like(h)
        r = reach * (1 + radial) / 2
        distance = r * np.sqrt(1 + h**2) if measure == "surface" else r
        area = np.sqrt(1 + p * p + q * q) if measure == "surface" else 1.0
        w = np.exp(-4.5 * distance**2) if weight == "gaussian" else np.ones_like(r)
        w = w * r * area * reach * radial_weight * node_weights[:, None] * (b - a)
        columns = []
        for k, n in wavejets_table(degree):
            columns.append((r**k * np.cos(n * angle)).ravel())
            if n:
                columns.append((r**k * np.sin(n * angle)).ravel())
        root = np.sqrt(w).ravel()
        rows.append(np.stack(columns, axis=1) * root[:, None])
        values.append((r * h).ravel() * root)
    solution = np.linalg.lstsq(np.concatenate(rows), np.concatenate(values), rcond=None)[0]
    phi, i = [], 0
    for _, n in wavejets_table(degree):
        phi.append(complex(solution[i], -solution[i + 1]) / 2 if n else complex(solution[i]))
        i += 2 if n else 1
    return np.array(phi)


@pytest.mark.parametrize("weight", ["gaussian", "uniform"])
@pytest.mark.parametrize("measure", ["flat", "surface"])
@pytest.mark.parametrize("name", CONES)
def test_prediction_is_the_least_squares_fit(name, measure, weight):
    degree = 6
    prediction = predict(CONES[name], degree, weight=weight, measure=measure)
    fitted = least_squares(CONES[name], degree, measure, weight)
    own = prediction.numeric_phi()
    asked = ~np.isnan(own)
    assert asked.sum() == sum(k >= 2 for k, _ in wavejets_table(degree))
    assert np.abs(own - fitted)[asked].max() < 1e-9 * (1 + np.abs(fitted).max())


def test_order_three_of_any_cone_is_a_3_rosy():
    prediction = predict(IRREGULAR, 10, [3])
    angles = [float(p.angle_degrees(12)) for p in prediction.eigenpairs(3).maxima]
    assert np.diff(angles) == pytest.approx([120, 120])


def test_corner_and_edge():
    corner = predict(Cone.corner(), 10)
    assert [corner.eigenpairs(k).status for k in (2, 3, 4)] == ["isotropic", "ok", "isotropic"]
    # The edges of the corner are the maxima of order 3.
    assert [float(p.angle_degrees()) for p in corner.eigenpairs(3).maxima] == [0, 120, 240]
    edge = predict(Cone.ridge(), 10)
    assert [edge.eigenpairs(k).status for k in (3, 5, 7)] == ["vanishing"] * 3
    assert [float(p.angle_degrees()) for p in edge.eigenpairs(2).maxima] == [0, 180]


def test_perfect_t_is_out_of_reach_for_order_three():
    maxima = predict(Cone.t_junction(), 10, [3]).eigenpairs(3).maxima
    assert [float(p.angle_degrees()) for p in maxima] == [90, 210, 330]


def test_radius_scales_by_its_power():
    unit, wide = (predict(IRREGULAR, 5, [4], radius=r).row(4) for r in (1, 2))
    assert wide * 8 == unit


def test_constant_term_matters_for_frequency_zero_only():
    with_it, without = (predict(IRREGULAR, 6, [4], constant=c).row(4) for c in (True, False))
    assert with_it[2] == without[2]
    assert with_it[4] == without[4]
    assert with_it[0] != without[0]


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Cone(((0, 1), (90, 1))), "at least three"),
        (lambda: Cone(((0, 1), (0, 2), (120, 1), (240, 1))), "angle 0"),
        (lambda: Cone(((0, 1), (90, 1), (180, 1))), "spans 180"),
        (lambda: Cone(((0, sp.I), (120, 1), (240, 1))), "not a real"),
        (lambda: Cone(((0, sp.Symbol("a")), (120, 1), (240, 1))), "not a real"),
        (lambda: predict(Cone.ridge(), 0), "degree is 0"),
        (lambda: predict(Cone.ridge(), 31), "31"),
        (lambda: predict(Cone.ridge(), 4, [5]), "order is 5"),
        (lambda: predict(Cone.ridge(), 4, radius=0), "radius is 0"),
        (lambda: predict(Cone.ridge(), 4, weight="box"), "box"),
        (lambda: predict(Cone.ridge(), 4, measure="box"), "box"),
        (lambda: predict(Cone.ridge(), 17, [2], measure="surface"), "up to 16"),
        (lambda: predict(Cone.ridge(), 4, [2]).row(3), "not predicted"),
        (lambda: cone_coefficient(3, 2, 10), "frequency 2"),
    ],
)
def test_bad_input(make, message):
    with pytest.raises(InputError, match=message):
        make()


def test_general_azimuths_are_predicted_from_balls():
    """The rounded rows against the closed forms, which take seconds."""
    cone = Cone(((10, 0), (83, -1), (191, -2), (277, -1)))
    prediction = predict(cone, 4, (3, 4))
    for k, n in ((3, 3), (4, 2)):
        exact = sp.N(cone_coefficient(k, n, 4), 64) * sp.N(cone.fourier(n), 64)
        assert abs(exact - prediction.row(k)[n]) <= abs(exact) * sp.Float("1e-57", 60)


def test_zero_frequencies_of_general_azimuths_are_exact():
    """Three-fold symmetry turned by 17 degrees leaves the multiples of 3 alone."""
    cone = Cone(tuple((17 + 120 * j, -1) for j in range(3)))
    row = predict(cone, 6, (4, 5)).row(4)
    assert row[2] == row[4] == 0
    assert row[0] != 0
    assert predict(cone, 6, (5,)).row(5).support == [3]


def test_an_order_above_the_degree_names_both():
    with pytest.raises(InputError, match="order is 5; a fit of degree 4 has the orders 1 to 4"):
        predict(Cone.ridge(), 4, [2, 5])
