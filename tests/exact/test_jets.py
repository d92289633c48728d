"""Exact jets of surfaces against classical formulas, and against each other."""

import mpmath
import numpy as np
import pytest
import sympy as sp

from pdtheory.conventions import wavejets_table
from pdtheory.errors import ExpressionError, InputError
from pdtheory.exact import explicit_jet, implicit_jet, parametric_jet

x, y, z, u, v = sp.symbols("x y z u v")
half, third = sp.Rational(1, 2), sp.Rational(1, 3)

TORUS = (x**2 + y**2 + z**2 + 3) ** 2 - 16 * (x**2 + y**2)
ELLIPSOID = x**2 + y**2 / 4 + z**2 / 9 - 1
GOURSAT = x**4 + y**4 + z**4 - (x**2 + y**2 + z**2) + sp.Rational(3, 16)
ENNEPER = (u - u**3 / 3 + u * v**2, v - v**3 / 3 + v * u**2, u**2 - v**2)
TORUS_PATCH = ((2 + sp.cos(v)) * sp.cos(u), (2 + sp.cos(v)) * sp.sin(u), sp.sin(v))

IMPLICIT = [
    (x**2 + y**2 + z**2 - 1, (third, 2 * third, 2 * third)),
    (x**2 + y**2 - 4, (sp.Rational(6, 5), sp.Rational(8, 5), 7)),
    (TORUS, (3, 0, 0)),
    (TORUS, (sp.Rational(39, 25), sp.Rational(52, 25), sp.Rational(4, 5))),
    (TORUS, (sp.Rational(5, 4) * sp.sqrt(2), sp.Rational(5, 4) * sp.sqrt(2), sp.sqrt(3) / 2)),
    (ELLIPSOID, (third, 4 * third, 2)),
    (GOURSAT, (1, 1, half)),
    (x**2 + y**2 - z, (1, 2, 5)),
    (z - sp.exp(x) * sp.sin(y), (0, 0, 0)),
]


def hessian_curvatures(F, at):
    """Gaussian and mean curvature of an implicit surface by the bordered Hessian (Goldman 2005)."""
    place = dict(zip((x, y, z), at, strict=True))
    gradient = sp.Matrix([F.diff(w) for w in (x, y, z)]).subs(place)
    hessian = sp.hessian(F, (x, y, z)).subs(place)
    square = (gradient.T * gradient)[0]
    gauss = (gradient.T * hessian.adjugate() * gradient)[0] / square**2
    mean = ((gradient.T * hessian * gradient)[0] - square * hessian.trace()) / (
        2 * square ** sp.Rational(3, 2)
    )
    return sp.simplify(gauss), sp.simplify(mean)


def fundamental_curvatures(X, at):
    """Gaussian and mean curvature of a patch by its two fundamental forms."""
    place = {u: at[0], v: at[1]}
    X = sp.Matrix(X)
    Xu, Xv = X.diff(u), X.diff(v)
    n = Xu.cross(Xv)
    E, F, G = (a.dot(b).subs(place) for a, b in ((Xu, Xu), (Xu, Xv), (Xv, Xv)))
    length = sp.sqrt(n.dot(n).subs(place))
    L, M, N = (d.dot(n).subs(place) / length for d in (X.diff(u, 2), X.diff(u, v), X.diff(v, 2)))
    det = E * G - F**2
    return sp.simplify((L * N - M**2) / det), sp.simplify((E * N - 2 * F * M + G * L) / (2 * det))


def assert_right_handed(jet):
    frame = sp.Matrix(jet.frame)
    assert sp.simplify(frame * frame.T - sp.eye(3)) == sp.zeros(3)
    assert sp.simplify(frame.det()) == 1


@pytest.mark.parametrize(("F", "at"), IMPLICIT)
def test_implicit_curvatures_by_the_bordered_hessian(F, at):
    jet = implicit_jet(F, (x, y, z), 3, at)
    first, second = jet.principal_curvatures()
    gauss, mean = hessian_curvatures(F, at)
    assert sp.simplify(first * second - gauss) == 0
    assert sp.simplify((first + second) / 2 - mean) == 0
    assert sp.N(first - second) >= 0
    assert_right_handed(jet)


@pytest.mark.parametrize(("F", "at"), IMPLICIT)
def test_the_height_function_solves_the_equation(F, at):
    """F(p + s t1 + t t2 + z n) = O(|(s, t)|^(K+1)): shrinking by 10 shrinks it by 10^(K+1)."""
    degree = 6
    jet = implicit_jet(F, (x, y, z), degree, at)
    equation = sp.lambdify((x, y, z), F, "mpmath")
    with mpmath.workdps(60):
        frame = [[mpmath.mpf(sp.N(c, 60)) for c in row] for row in jet.frame]
        point = [mpmath.mpf(sp.N(c, 60)) for c in jet.point]
        phi = {kn: mpmath.mpmathify(sp.N(c, 60)) for kn, c in jet.wavejets.items()}

        def defect(r):
            angle = mpmath.mpf("0.7")
            height = sum(
                (1 if n == 0 else 2) * (c * mpmath.expj(n * angle)).real * r**k
                for (k, n), c in phi.items()
            )
            local = r * mpmath.cos(angle), r * mpmath.sin(angle), height
            q = [
                p + sum(c * row[i] for c, row in zip(local, frame, strict=True))
                for i, p in enumerate(point)
            ]
            return abs(equation(*q))

        coarse, fine = defect(mpmath.mpf(10) ** -4), defect(mpmath.mpf(10) ** -5)
        assert fine < mpmath.mpf(10) ** -50 or coarse / fine > 10 ** (degree + 1) / 2


@pytest.mark.parametrize(
    ("X", "at"),
    [
        (ENNEPER, (half, third)),
        (ENNEPER, (0, 0)),
        (TORUS_PATCH, (sp.pi / 4, sp.pi / 3)),
        (TORUS_PATCH, (0, 0)),
        ((u * sp.cos(v), u * sp.sin(v), v), (1, sp.pi / 3)),
        ((sp.cosh(v) * sp.cos(u), sp.cosh(v) * sp.sin(u), v), (sp.pi / 6, 0)),
        ((u, v, u * v), (2, 3)),
    ],
)
def test_patch_curvatures_by_the_fundamental_forms(X, at):
    jet = parametric_jet(X, (u, v), 4, at)
    first, second = jet.principal_curvatures()
    gauss, mean = fundamental_curvatures(X, at)
    assert sp.simplify(first * second - gauss) == 0
    assert sp.simplify((first + second) / 2 - mean) == 0
    assert_right_handed(jet)


def test_patch_and_implicit_surface_have_the_same_jet():
    at = (
        TORUS_PATCH[0].subs({u: sp.pi / 4, v: sp.pi / 3}),
        *(c.subs({u: sp.pi / 4, v: sp.pi / 3}) for c in TORUS_PATCH[1:]),
    )
    patch = parametric_jet(TORUS_PATCH, (u, v), 5, (sp.pi / 4, sp.pi / 3))
    level = implicit_jet(TORUS, (x, y, z), 5, at)
    assert patch.forms == level.forms
    assert [sp.simplify(a - b) for r, s in zip(patch.frame, level.frame, strict=True)
            for a, b in zip(r, s, strict=True)] == [0] * 9  # fmt: skip


def test_graph_and_its_patch_have_the_same_jet():
    f = x**2 - x * y + y**3 + x
    graph = explicit_jet(f, (x, y), 6, (1, 2))
    patch = parametric_jet((u, v, f.subs({x: u, y: v})), (u, v), 6, (1, 2))
    assert graph.forms == patch.forms
    assert graph.frame == patch.frame


def test_a_flat_gradient_leaves_the_taylor_expansion():
    f = x**3 - 3 * x * y**2 + x**2 * y**2
    jet = explicit_jet(f, (x, y), 5)
    assert jet.frame == ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    assert jet.form(3).expression == sp.expand(6 * (x**3 - 3 * x * y**2))
    assert jet.form(4).expression == 24 * x**2 * y**2
    assert jet.form(5).is_zero


def test_sphere_is_isotropic_at_every_even_order():
    jet = implicit_jet(x**2 + y**2 + z**2 - 9, (x, y, z), 8, (1, 2, 2))
    assert jet.principal_curvatures() == (-sp.Rational(1, 3), -sp.Rational(1, 3))
    # z = sqrt(9 - r^2) - 3: the order-k term is binom(1/2, k/2) (-1)^(k/2) 9^(1/2 - k/2) r^k.
    for k in range(2, 9):
        status = "isotropic" if k % 2 == 0 else "vanishing"
        assert jet.eigenpairs(k).status == status
        if k % 2 == 0:
            g = sp.binomial(half, k // 2) * (-1) ** (k // 2) * sp.Integer(3) ** (1 - k)
            assert jet.row(k)[0] == g


def test_order_two_directions_are_the_principal_curvature_directions():
    # On a torus they are the meridian and the parallel.
    jet = implicit_jet(
        TORUS, (x, y, z), 2, (sp.Rational(39, 25), sp.Rational(52, 25), sp.Rational(4, 5))
    )
    t1, t2, _ = (sp.Matrix(row) for row in jet.frame)
    parallel = sp.Matrix([-sp.Rational(4, 5), sp.Rational(3, 5), 0])
    lines = set()
    for pair in jet.eigenpairs(2):
        c, s = pair.vector
        along = sp.simplify((c * t1 + s * t2).dot(parallel))
        lines.add((abs(along), pair.eigenvalue))
    assert lines == {(1, -sp.Rational(3, 13)), (0, -1)}


def test_tangent_option_turns_the_frame():
    at = (third, 4 * third, 2)
    first = implicit_jet(ELLIPSOID, (x, y, z), 4, at)
    second = implicit_jet(ELLIPSOID, (x, y, z), 4, at, tangent=(0, 1, 0))
    t1, t2 = (sp.Matrix(first.frame[i]) for i in (0, 1))
    new = sp.Matrix(second.frame[0])
    cosine, sine = sp.simplify(new.dot(t1)), sp.simplify(new.dot(t2))
    for k in range(2, 5):
        turned = first.form(k).turn_frame(cosine=cosine, sine=sine)
        assert turned == second.form(k)


def test_free_parameters():
    a, b = sp.symbols("a b")
    jet = explicit_jet(a * x**2 + b * y**3, (x, y), 3)
    assert jet.form(2).coefficients == (2 * a, 0, 0)
    assert jet.form(3).coefficients == (0, 0, 0, 6 * b)


def test_numeric_tables():
    jet = implicit_jet(ELLIPSOID, (x, y, z), 4, (third, 4 * third, 2))
    phi = jet.numeric_phi()
    assert phi.shape == (len(wavejets_table(4)),)
    frame = jet.numeric_frame()
    assert np.allclose(frame @ frame.T, np.eye(3), atol=1e-15)
    index = wavejets_table(4).index((2, 2))
    assert phi[index] == pytest.approx(complex(jet.wavejets[2, 2]))


@pytest.mark.parametrize(
    ("make", "error", "message"),
    [
        (lambda: implicit_jet(TORUS, (x, y, z), 3, (1, 1, 1)), InputError, "not on the surface"),
        (lambda: implicit_jet(x**2 + y**2 - z**2, (x, y, z), 3, (0, 0, 0)), InputError, "singular"),
        (lambda: implicit_jet(TORUS, (x, y, z), 3, (3, 0)), InputError, "needs 3 entries"),
        (lambda: implicit_jet(TORUS, (x, y), 3, (3, 0, 0)), InputError, "needs 3 entries"),
        (lambda: implicit_jet(TORUS, (x, y, z), 0, (3, 0, 0)), InputError, "0"),
        (lambda: implicit_jet(TORUS, (x, y, z), 2, (3, 0, 0), tangent=(1, 0, 0)), InputError,
         "normal to the surface"),
        (lambda: parametric_jet((u, u, u), (u, v), 3, (0, 0)), InputError, "not regular"),
        (lambda: explicit_jet(sp.log(x), (x, y), 3), ExpressionError, "no value"),
        (lambda: explicit_jet(sp.sqrt(x**2 + y**2), (x, y), 3), ExpressionError, "no derivative"),
        (lambda: implicit_jet(TORUS, (x, y, z), 3, (3, 0, 0)).form(4), InputError, "orders 0 to 3"),
    ],
)  # fmt: skip
def test_bad_input(make, error, message):
    with pytest.raises(error, match=message):
        make()
