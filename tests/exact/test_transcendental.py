"""Jets at points with several transcendental constants, against mpmath alone."""

from fractions import Fraction

import mpmath
import pytest
import sympy as sp

import synthetic_surfaces
from pdtheory.exact import explicit_jet, implicit_jet, parametric_jet, taylor_forms
from pdtheory.exact.named import NamedConstant
from pdtheory.exact.zeros import is_zero

x, y, z, u, v = sp.symbols("x y z u v")
half, third = sp.Rational(1, 2), sp.Rational(1, 3)
JUNCTION_AT = (Fraction(1234, 10000), Fraction(1, 4))


def junction(p, q):
    ridge = mpmath.exp(-16 * q * q)
    branch = mpmath.exp(-16 * p * p) * (1 + mpmath.tanh(4 * q)) / 2
    return (ridge + branch * (1 - ridge)) / 4


def height_along(F, point, frame, angle, degree):
    """Taylor coefficients of r -> h(r cos, r sin) with F(point + local) = 0, by mpmath alone.

    Newton's method at every sample, differentiation by mpmath's differences.
    """

    def height(r):
        c, s = r * mpmath.cos(angle), r * mpmath.sin(angle)
        h = mpmath.mpf(0)
        for _ in range(200):

            def along(w):
                q = [p + c * a + s * b + w * n for p, a, b, n in zip(point, *frame, strict=True)]
                return F(*q)

            value = along(h)
            step = value / mpmath.diff(along, h)
            h -= step
            if abs(step) <= mpmath.eps * 8 * max(1, abs(h)):
                break
        return h

    return mpmath.taylor(height, 0, degree)


def frame_of(normal):
    """t1 along the projection of the x axis, t2 = n x t1."""
    length = mpmath.sqrt(sum(c * c for c in normal))
    n = [c / length for c in normal]
    t = [int(i == 0) - n[0] * n[i] for i in range(3)]
    size = mpmath.sqrt(sum(c * c for c in t))
    t = [c / size for c in t]
    other = [n[1] * t[2] - n[2] * t[1], n[2] * t[0] - n[0] * t[2], n[0] * t[1] - n[1] * t[0]]
    return t, other, n


def check(jet, F, point, normal, digits=50):
    """Compare g_k along three directions with mpmath's."""
    degree = jet.degree
    with mpmath.workdps(digits + 40):
        point, normal = [mpmath.mpf(c) for c in point], [mpmath.mpf(c) for c in normal]
        frame = frame_of(normal)
        ours = [[mpmath.mpmathify(sp.N(c, digits + 20)) for c in row] for row in jet.frame]
        for row, other in zip(ours, frame, strict=True):
            assert all(abs(a - b) < mpmath.mpf(10) ** -digits
                       for a, b in zip(row, other, strict=True))  # fmt: skip
        for angle in (mpmath.mpf("0.3"), mpmath.mpf(2)):
            expected = height_along(F, point, frame, angle, degree)
            c, s = mpmath.cos(angle), mpmath.sin(angle)
            for k in range(2, degree + 1):
                terms = [mpmath.mpmathify(sp.N(a, digits + 20)) for a in jet.form(k).coefficients]
                value = sum(a * c ** (k - j) * s**j for j, a in enumerate(terms))
                value /= mpmath.factorial(k)
                assert abs(value - expected[k]) <= mpmath.mpf(10) ** -digits * (1 + abs(value))


def test_smooth_junction_at_a_general_point():
    site = synthetic_surfaces.get("ridge-to-junction").sites()[0]
    jet = site.jet(4, at=JUNCTION_AT)
    with mpmath.workdps(90):
        p, q = (mpmath.mpf(c.numerator) / c.denominator for c in JUNCTION_AT)
        slopes = [mpmath.diff(junction, (p, q), order) for order in ((1, 0), (0, 1))]
        point = (p, q, junction(p, q))
        normal = (-slopes[0], -slopes[1], 1)
        check(jet, lambda a, b, c: c - junction(a, b), point, normal)


def roofs(p, q):
    """The smoothed T-junction by its definition: the upper hull of three roofs, rounded."""
    w = mpmath.mpf(1) / 20

    def rounded(a):
        return mpmath.sqrt(a * a + w * w)

    first, second = rounded(q), rounded(p) - q
    other = (second + mpmath.sqrt((rounded(p) + q) ** 2 + 3 * w * w)) / 2
    return -(first + other - mpmath.sqrt((first - other) ** 2 + 2 * w * w)) / 2


def test_a_tower_of_roots():
    """Four roots over each other: nobody can wait for the field of degree 32."""
    at = (Fraction(1, 8), Fraction(1, 4))
    jet = synthetic_surfaces.get("smooth-t-junction").sites()[0].jet(3, at=at)
    with mpmath.workdps(90):
        p, q = (mpmath.mpf(c.numerator) / c.denominator for c in at)
        normal = [-mpmath.diff(roofs, (p, q), order) for order in ((1, 0), (0, 1))]
        check(jet, lambda a, b, c: c - roofs(a, b), (p, q, roofs(p, q)), (*normal, 1))
    curvatures = [float(sp.N(c)) for c in jet.principal_curvatures()]
    values = {round(float(p.eigenvalue_float()), 9) for p in jet.eigenpairs(2)}
    assert sorted(values) == pytest.approx(sorted(curvatures), abs=1e-8)


def test_independent_cube_roots():
    """A field of degree 27 is as far out of reach as a tower."""
    f = sp.cbrt(2) * x**2 + sp.cbrt(3) * x * y + sp.cbrt(5) * y**2 + x
    at = (sp.Rational(1, 5), sp.Rational(1, 7))
    jet = explicit_jet(f, (x, y), 3, at)
    with mpmath.workdps(90):
        a, b, c = (mpmath.cbrt(n) for n in (2, 3, 5))

        def height(p, q):
            return a * p * p + b * p * q + c * q * q + p

        p, q = mpmath.mpf(1) / 5, mpmath.mpf(1) / 7
        normal = (-2 * a * p - b * q - 1, -b * p - 2 * c * q, 1)
        check(jet, lambda u, v, w: w - height(u, v), (p, q, height(p, q)), normal)


def test_implicit_surface_with_dependent_functions():
    F = sp.cosh(x) * sp.cos(y) + sp.sinh(x) - sp.exp(z) + y
    at = (1, half, sp.log(sp.cosh(1) * sp.cos(half) + sp.sinh(1) + half))
    jet = implicit_jet(F, (x, y, z), 4, at)
    with mpmath.workdps(90):
        numeric = [mpmath.mpmathify(sp.N(c, 90)) for c in at]
        normal = [mpmath.mpmathify(sp.N(F.diff(w).subs(dict(zip((x, y, z), at, strict=True))), 90))
                  for w in (x, y, z)]  # fmt: skip

        def equation(a, b, c):
            return mpmath.cosh(a) * mpmath.cos(b) + mpmath.sinh(a) - mpmath.exp(c) + b

        check(jet, equation, numeric, normal)


def test_torus_at_angles_in_radians():
    """At u = 1, v = 1/2 the curvatures are those of the formula, exactly."""
    patch = ((2 + sp.cos(v)) * sp.cos(u), (2 + sp.cos(v)) * sp.sin(u), sp.sin(v))
    jet = parametric_jet(patch, (u, v), 4, (1, half))
    a, b, c = jet.tensor(2).components
    meridian, parallel = sp.Integer(1), sp.cos(half) / (2 + sp.cos(half))
    assert is_zero((a + c) ** 2 - (meridian + parallel) ** 2)
    assert is_zero(a * c - b**2 - meridian * parallel)
    with mpmath.workdps(90):
        point = [mpmath.mpmathify(sp.N(w.subs({u: 1, v: half}), 90)) for w in patch]
        one, small = mpmath.mpf(1), mpmath.mpf(1) / 2
        normal = [mpmath.cos(small) * mpmath.cos(one), mpmath.cos(small) * mpmath.sin(one),
                  mpmath.sin(small)]  # fmt: skip

        def equation(p, q, r):
            return (p * p + q * q + r * r + 3) ** 2 - 16 * (p * p + q * q)

        check(jet, equation, point, normal)


def test_sphere_at_angles_in_radians_is_isotropic():
    """Every order is decided: zero off-diagonal terms hidden in sines and cosines of 1 and 1/2."""
    patch = (sp.cos(u) * sp.cos(v), sp.sin(u) * sp.cos(v), sp.sin(v))
    jet = parametric_jet(patch, (u, v), 4, (1, half))
    assert [jet.eigenpairs(k).status for k in (2, 3, 4)] == ["isotropic", "vanishing", "isotropic"]
    assert is_zero(jet.form(2).coefficients[0] + 1)
    assert is_zero(jet.form(4).coefficients[0] + 3)


def test_one_transcendental_number_stays_a_fraction():
    jet = explicit_jet(sp.exp(x) + y, (x, y), 3, (1, 0))
    assert not any(c.atoms(NamedConstant) for form in jet.forms for c in form.coefficients)
    curve = sp.E / (2 + sp.exp(2)) ** sp.Rational(3, 2)
    assert is_zero(sp.Add(*jet.principal_curvatures()) - 2 * curve)


def test_named_constants_are_exact():
    jet = explicit_jet(sp.exp(x) * sp.cos(y) + sp.sinh(y), (x, y), 3, (third, half))
    coefficient = jet.form(3).coefficients[0]
    names = coefficient.atoms(NamedConstant)
    assert names
    assert {str(n) for n in names} <= {"g_200", "g_101", "g_300"}
    plain = coefficient.doit()
    assert not plain.atoms(NamedConstant)
    assert is_zero(coefficient - plain)
    assert abs(sp.N(coefficient, 60) - sp.N(plain, 60)) < sp.Float("1e-58")
    assert r"g_{200}" in jet.form(2).latex()
    assert jet.numeric_phi()[1].real == pytest.approx(float(sp.N(jet.wavejets[1, 1])))


def test_parameters_and_functions_of_them():
    s, t = sp.symbols("s t")
    form = taylor_forms(sp.exp(s * x) * sp.cosh(t + y), (x, y), 2, (1, 0))[2]
    expected = [s**2 * sp.exp(s) * sp.cosh(t), 2 * s * sp.exp(s) * sp.sinh(t),
                sp.exp(s) * sp.cosh(t)]  # fmt: skip
    assert all(is_zero(a - b) for a, b in zip(form.coefficients, expected, strict=True))
