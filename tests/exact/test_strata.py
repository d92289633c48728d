"""How many directions: Sturm counts, discriminants and hypocycloids, each checked by the others."""

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from pdtheory.errors import InputError
from pdtheory.exact import BinaryForm, WavejetsRow, real_eigenpairs
from pdtheory.exact.strata import (
    astroid,
    count_bounds,
    count_maxima,
    deltoid,
    hypocycloid,
    order3_discriminant,
    order4_discriminant,
    parametric_discriminant,
    phase_diagram,
)
from pdtheory.testing.profiles import examples
from pdtheory.testing.strategies import any_forms, forms, forms_with_repeated_roots, rationals

a, b, c, d = sp.symbols("a b c d")
complex_numbers = st.builds(lambda p, q: p + sp.I * q, rationals(), rationals())


@examples
@given(any_forms(max_order=12))
def test_sturm_counts_what_the_pairs_list(form):
    assert count_maxima(form) == len(real_eigenpairs(form).maxima)


def test_high_order():
    rng = np.random.default_rng(5)
    for order in (23, 24):
        form = BinaryForm([int(c) for c in rng.integers(-9, 10, order + 1)])
        assert count_maxima(form) == len(real_eigenpairs(form).maxima)


def test_sturm_counts_over_algebraic_numbers():
    row = WavejetsRow(3, {1: sp.sqrt(2), 3: sp.sqrt(3)})
    assert count_maxima(row) == len(row.eigenpairs().maxima) == 3


@examples
@given(any_forms(max_order=14))
def test_sturm_hurwitz_bounds(form):
    low, high = count_bounds(form)
    assert low <= count_maxima(form) <= high <= form.order


@examples
@given(complex_numbers, complex_numbers)
def test_order_three(p1, p3):
    row = WavejetsRow(3, {1: p1, 3: p3})
    if row.is_zero:
        return
    assert count_maxima(row) == (3 if order3_discriminant(row) < 0 else 1)


@examples
@given(rationals(), complex_numbers, complex_numbers)
def test_order_four(p0, p2, p4):
    row = WavejetsRow(4, {0: p0, 2: p2, 4: p4})
    if not row.support:
        return
    assert count_maxima(row) == (4 if order4_discriminant(row) < 0 else 2)


def test_closed_discriminants_are_the_resultants():
    cubic = WavejetsRow(3, {1: a + sp.I * b, 3: c + sp.I * d})
    ratio = sp.cancel(parametric_discriminant(cubic) / order3_discriminant(cubic))
    assert ratio.is_Rational
    assert ratio != 0
    quartic = WavejetsRow(4, {2: a + sp.I * b, 4: c + sp.I * d})
    ratio = sp.cancel(parametric_discriminant(quartic) / order4_discriminant(quartic))
    assert ratio.is_Rational
    assert ratio != 0


@examples
@given(forms(min_order=2, max_order=7) | forms_with_repeated_roots(max_order=7))
def test_discriminant_vanishes_where_directions_meet(form):
    derivative = form.angular_derivative()
    if form.order < 2 or derivative.is_zero:
        return
    t = sp.Symbol("t")
    poly = sp.Poly(sum(q * t**j for j, q in enumerate(derivative.coefficients)), t)
    at_infinity = derivative.order - poly.degree()
    squarefree = at_infinity <= 1 and poly.is_sqf
    assert (parametric_discriminant(form) != 0) == squarefree


@pytest.mark.parametrize("s", [sp.pi / 7, sp.Integer(1), sp.Integer(4)])
def test_curves_lie_on_the_discriminants(s):
    real, imaginary = sp.expand_complex(deltoid(s)).as_real_imag()
    value = order3_discriminant(WavejetsRow(3, {1: a + sp.I * b, 3: 1}))
    assert abs(sp.N(value.subs({a: real, b: imaginary}), 30)) < 1e-20
    value = order4_discriminant(WavejetsRow(4, {2: a + sp.I * b, 4: 1}))
    real, imaginary = astroid(s).as_real_imag()
    assert abs(sp.N(value.subs({a: real, b: imaginary}), 30)) < 1e-20
    assert abs(sp.N(hypocycloid(1, 3, s / 2) - deltoid(s), 30)) < 1e-25
    # The astroid is the hypocycloid of 2 and 4 in another parameter: -4 cos^3 = -3 cos - cos 3.
    assert abs(sp.N(hypocycloid(2, 4, s / 2) - astroid(s), 30)) < 1e-25


@pytest.mark.parametrize(("low", "high"), [(1, 3), (2, 4), (1, 5), (3, 5), (2, 6), (1, 2)])
def test_hypocycloid_is_where_g_prime_and_g_second_vanish(low, high):
    t = sp.Symbol("t", real=True)
    point = hypocycloid(low, high, t)
    value = {high: sp.Integer(1), low: point}
    # g' = sum i n phi_n e^{int} + conjugate, at the angle t itself up to a shift by pi / q.
    for angle in (0.3, 1.1, 2.9):
        phi = {n: complex(sp.N(v.subs(t, angle))) for n, v in value.items()}
        grid = np.linspace(0, 2 * np.pi, 200_001)
        first = sum(-2 * n * np.imag(p * np.exp(1j * n * grid)) for n, p in phi.items())
        second = sum(-2 * n * n * np.real(p * np.exp(1j * n * grid)) for n, p in phi.items())
        assert np.min(np.abs(first) + np.abs(second)) < 1e-2 * high**2


@pytest.mark.parametrize(("order", "low", "high"), [(3, 1, 3), (4, 2, 4), (5, 1, 5), (5, 3, 5)])
def test_diagram_agrees_with_exact_counts(order, low, high):
    axis, maxima = phase_diagram(low, high, size=9)
    for i in (0, 2, 3, 6):
        for j in (0, 1, 3, 4, 7):
            phi = sp.Rational(axis[j]) + sp.I * sp.Rational(axis[i])
            assert maxima[i, j] == count_maxima(WavejetsRow(order, {low: phi, high: 1}))
    radius = np.hypot(axis[:, None], axis[None, :])
    assert (maxima[radius < 0.99 * high / low] == high).all()
    assert (maxima[radius > 1.01 * (high / low) ** 2] == low).all()


def test_bad_input():
    with pytest.raises(InputError, match="order 3"):
        order3_discriminant(BinaryForm([1, 2, 3]))
    with pytest.raises(InputError, match="3 and 3"):
        hypocycloid(3, 3, 0)
    with pytest.raises(InputError, match="size is 1"):
        phase_diagram(1, 3, size=1)
    with pytest.raises(InputError, match="extent is -1"):
        phase_diagram(1, 3, extent=-1)
    with pytest.raises(InputError, match="order is 0"):
        count_maxima(BinaryForm([1]))
    with pytest.raises(InputError, match=r"depends on a|not known to be algebraic"):
        count_maxima(BinaryForm([a, 1]))


@pytest.mark.parametrize(("nudge", "count"), [(1, 1), (-1, 3)])
def test_a_count_right_beside_the_cusp(nudge, count):
    """Beside the cusp -9 of the deltoid, nearer than 100 digits can tell."""
    near = sp.Rational(str(sp.N(sp.sqrt(2), 150))) - sp.Rational(nudge, 10**140)
    assert count_maxima(WavejetsRow(3, {1: -9 * sp.sqrt(2) / near, 3: 1})) == count
