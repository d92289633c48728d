"""One object, three faces: conversions, contraction, rotation, gradient."""

from math import cos, factorial, inf, nan, sin

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from pdtheory.errors import InputError
from pdtheory.exact import (
    BinaryForm,
    SymmetricTensor,
    WavejetsRow,
    complex_eigenpairs,
    explicit_jet,
    implicit_jet,
    parametric_jet,
)
from pdtheory.exact.coefficients import MAX_ORDER, check_order
from pdtheory.testing.profiles import examples
from pdtheory.testing.strategies import any_forms, forms

x, y, a, b, c = sp.symbols("x y a b c", real=True)


@examples
@given(any_forms(max_order=16))
def test_conversions_round_trip(form):
    assert form.tensor.form == form
    assert form.row.form == form
    assert form.row == form == form.tensor


@examples
@given(forms(max_order=9), st.floats(0, 6.28))
def test_all_faces_are_the_same_function(form, angle):
    k, v = form.order, (cos(angle), sin(angle))
    direct = sum(float(q) * v[0] ** (k - j) * v[1] ** j for j, q in enumerate(form.coefficients))
    array = np.array(form.tensor.to_array().tolist(), dtype=float)
    for _ in range(k):
        array = array @ np.array(v)
    wave = factorial(k) * sum(
        (1 if n == 0 else 2) * (phi * complex(cos(n * angle), sin(n * angle))).real
        for n, phi in form.row.to_complex().items()
    )
    scale = 1e-9 * (1 + sum(abs(float(q)) for q in form.coefficients))
    assert abs(float(array) - direct) < scale
    assert abs(wave - direct) < scale


def test_row_by_fourier_integral():
    form = BinaryForm([2, -1, 0, 5])
    t = sp.Symbol("t", real=True)
    g = form(sp.cos(t), sp.sin(t)) / 6
    for n in (1, 3):
        phi = sp.integrate(sp.expand(g * sp.exp(-sp.I * n * t)), (t, 0, 2 * sp.pi)) / (2 * sp.pi)
        assert sp.simplify(phi - form.row[n]) == 0


def test_contraction_for_symbolic_vectors():
    tensor = SymmetricTensor([a, b, c])
    assert tensor.contract((x, y), 2).components[0] == sp.expand(
        a * x**2 + 2 * b * x * y + c * y**2
    )
    assert tensor.contract((x, y)).components == (a * x + b * y, b * x + c * y)
    with pytest.raises(InputError, match="3 times"):
        tensor.contract((x, y), 3)


@examples
@given(forms(min_order=1, max_order=8))
def test_the_lemma(form):
    k = form.order
    gradient = [sp.diff(form.expression, s) for s in sp.symbols("x y")]
    by_contraction = form.tensor.contract(sp.symbols("x y"), k - 1).components
    for partial, own, entry in zip(gradient, form.gradient(), by_contraction, strict=True):
        assert sp.expand(partial - own.expression) == 0
        assert sp.expand(partial - k * entry) == 0


@examples
@given(forms(max_order=10))
def test_turning_the_frame_multiplies_by_a_phase(form):
    cosine, sine = sp.Rational(3, 5), sp.Rational(-4, 5)
    turned = form.turn_frame(cosine=cosine, sine=sine)
    for n, phi in form.row.phi.items():
        phase = sp.expand((cosine + sp.I * sine) ** n)
        assert sp.expand(turned.row[n] - phi * phase) == 0
    assert turned.turn_frame(cosine=cosine, sine=-sine) == form


def test_symbolic_rotation():
    angle = sp.Symbol("alpha", real=True)
    turned = WavejetsRow(3, {1: a + sp.I * b, 3: 1}).turn_frame(angle)
    expected = (a + sp.I * b) * (sp.cos(angle) + sp.I * sp.sin(angle))
    assert sp.simplify(turned[1] - expected) == 0
    with pytest.raises(InputError, match="unit circle"):
        BinaryForm([1, 2]).turn_frame(cosine=1, sine=1)


@examples
@given(forms(min_order=4, max_order=4), forms(min_order=4, max_order=4), st.integers(-5, 5))
def test_linear(f, g, s):
    assert (f + s * g).row == f.row + g.row * s
    assert (f - g).tensor == f.tensor - g.tensor
    assert f - f == 0 * g


def test_floats_are_taken_exactly():
    assert BinaryForm([0.5, 0.1]).coefficients[1] == sp.Rational(*(0.1).as_integer_ratio())


def test_dense_arrays():
    tensor = SymmetricTensor([1, 2, 3, 4])
    assert SymmetricTensor.from_array(tensor.to_array()) == tensor
    assert SymmetricTensor.from_array(np.array([[1, 2], [2, 3]])).form == BinaryForm([1, 4, 3])
    with pytest.raises(InputError, match=r"not symmetric: entry \(1, 0\)"):
        SymmetricTensor.from_array([[1, 2], [3, 4]])
    with pytest.raises(InputError, match="shape"):
        SymmetricTensor.from_array([[1, 2, 3]])


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: BinaryForm([]), "-1"),
        (lambda: BinaryForm([1] * (MAX_ORDER + 2)), str(MAX_ORDER)),
        (lambda: BinaryForm([float("nan"), 1]), "nan"),
        (lambda: BinaryForm(["1", 1]), "'1'"),
        (lambda: BinaryForm([object(), 1]), "object"),
        (lambda: BinaryForm([sp.zoo, 1]), "zoo"),
        (lambda: WavejetsRow(3, {2: 1}), "frequency 2"),
        (lambda: WavejetsRow(2, {0: sp.I}), "must be real"),
        (lambda: WavejetsRow(-1, {}), "-1"),
        (lambda: BinaryForm([1, 2]) + BinaryForm([1, 2, 3]), "Orders 1 and 2"),
        (lambda: BinaryForm.from_expression(sp.sin(x), (x, y)), "sin"),
        (lambda: BinaryForm.from_expression(x + y**2, (x, y)), "homogeneous"),
    ],
)
def test_bad_input(make, message):
    with pytest.raises(InputError, match=message):
        make()


def test_latex_for_notebooks():
    for face in (BinaryForm([1, 2, 3]), SymmetricTensor([1, 2, 3]), WavejetsRow(2, {2: sp.I})):
        assert face._repr_latex_().startswith("$")
        assert face._repr_latex_().endswith("$")


@pytest.mark.parametrize("order", [None, nan, inf, "3", 2.5, -1, 257, 10**100])
def test_an_order_that_is_none_is_refused(order):
    with pytest.raises(InputError, match=r"The order is .*; it must be an integer from 1 to 256"):
        check_order(order, 1)


@pytest.mark.parametrize("digits", [0, -5])
def test_no_digits_are_refused(digits):
    form = BinaryForm([1, 2, 3, 5])
    real, other = form.eigenpairs()[0], complex_eigenpairs(form)[0]
    for ask in (real.angle_degrees, real.eigenvalue_float, real.angle_enclosure,
                other.vector, other.eigenvalue, other.vector_enclosure):  # fmt: skip
        with pytest.raises(InputError, match=f"number of digits is {digits}"):
            ask(digits)


def test_points_and_vectors_of_another_dimension_are_refused():
    z = sp.Symbol("z")
    tensor = SymmetricTensor([1, 2, 3])
    for wrong in (
        lambda: tensor.contract((1, 0, 5)),
        lambda: explicit_jet(x, (x,), 2),
        lambda: explicit_jet(x, (x, y), 2, (1, 2, 3)),
        lambda: implicit_jet(x, (x, y), 2, (0, 0, 0)),
        lambda: implicit_jet(x, (x, y, z), 2, (0, 0)),
        lambda: parametric_jet((x, y, 0), (x, y), 2, (0,)),
        lambda: parametric_jet((x, y), (x, y), 2, (0, 0)),
    ):
        with pytest.raises(InputError, match=r"needs \d entries, but \(.*\) has \d"):
            wrong()
