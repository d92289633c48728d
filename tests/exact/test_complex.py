"""Complex E-eigenpairs and the E-characteristic polynomial, each against the other and by hand."""

import mpmath
import pytest
import sympy as sp
from hypothesis import assume, given

from pdtheory.errors import InputError
from pdtheory.exact import (
    BinaryForm,
    WavejetsRow,
    balls,
    characteristic_polynomial,
    complex_eigenpairs,
    is_irregular,
    real_eigenpairs,
)
from pdtheory.exact.characteristic import LAMBDA
from pdtheory.exact.enclosing import enclose_real
from pdtheory.testing.profiles import examples
from pdtheory.testing.strategies import forms, forms_with_repeated_roots

x, y, a, b = sp.symbols("x y a b")
HAND = BinaryForm([1, 0, sp.Rational(3, 4), 0])
HIDDEN = BinaryForm.from_expression(sp.expand(x * (x**2 + y**2) ** 2))


def test_by_hand():
    psi = characteristic_polynomial(HAND)
    expected = (LAMBDA**2 - 1) * (4 * LAMBDA**2 + 1) ** 2
    assert sp.expand(psi.polynomial.as_expr() - expected) == 0
    pairs = complex_eigenpairs(HAND)
    assert [(p.is_real, p.multiplicity) for p in pairs] == [(True, 1), (False, 1), (False, 1)]
    assert pairs.isotropic_multiplicity == 0


def test_irregular():
    assert is_irregular(HIDDEN)
    assert characteristic_polynomial(HIDDEN).is_irregular
    assert complex_eigenpairs(HIDDEN).isotropic_multiplicity == 2
    assert not is_irregular(HAND)


@pytest.mark.parametrize("entries", [(1, 0, 1), (1, 0, -1), (2, 3, -5), (0, 1, 0), (0, 0, 0)])
def test_of_matrices_zero_alone_is_irregular(entries):
    """By definition: T v = 0 for v = (1, +-i); and psi of a matrix is never the zero polynomial."""
    p, q, r = entries
    matrix = sp.Matrix([[p, q], [q, r]])
    annihilates = any(matrix * sp.Matrix([1, s * sp.I]) == sp.zeros(2, 1) for s in (1, -1))
    form = BinaryForm([p, 2 * q, r])
    assert is_irregular(form) == annihilates == (matrix == sp.zeros(2, 2))
    assert not characteristic_polynomial(form).is_irregular


def test_matrices_have_the_characteristic_polynomial_of_linear_algebra():
    matrix = sp.Matrix([[2, 3], [3, -5]])
    psi = characteristic_polynomial(BinaryForm([2, 6, -5])).polynomial.as_expr()
    assert sp.expand(psi - matrix.charpoly(LAMBDA).as_expr()) == 0
    symbolic = characteristic_polynomial(BinaryForm([a, 0, b])).polynomial.as_expr()
    assert sp.expand(symbolic - (LAMBDA - a) * (LAMBDA - b)) == 0


def test_algebraic_coefficients():
    form = BinaryForm([1, 0, sp.sqrt(2), 0, 1])
    psi = characteristic_polynomial(form).polynomial.as_expr()
    for pair in real_eigenpairs(form):
        assert abs(sp.N(psi.subs(LAMBDA, pair.eigenvalue), 30)) < 1e-25


@examples
@given(forms(min_order=2, max_order=6))
def test_even_orders_by_the_other_resultant(form):
    """Res(F/k, f - lambda (x^2+y^2)^(k/2)) = +- psi |f(1,i)|^2 for even k."""
    k = form.order
    assume(k % 2 == 0)
    derivative = sp.expand((x * form.expression.diff(y) - y * form.expression.diff(x)) / k)
    other = sp.expand(form.expression - LAMBDA * (x**2 + y**2) ** (k // 2))
    # The resultant of two forms of degree k, by SymPy's determinant of Sylvester's matrix.
    matrix = sp.zeros(2 * k, 2 * k)
    for i in range(k):
        for j in range(k + 1):
            matrix[i, i + j] = derivative.coeff(x, k - j).coeff(y, j)
            matrix[k + i, i + j] = other.coeff(x, k - j).coeff(y, j)
    isotropic = sp.expand(form(1, sp.I) * form(1, -sp.I))
    psi = characteristic_polynomial(form)
    for value in (sp.Rational(1, 3), sp.Integer(-2)):
        resultant = matrix.subs(LAMBDA, value).det(method="bareiss")
        ours = psi.polynomial.as_expr().subs(LAMBDA, value) * isotropic
        if ours == 0:
            assert resultant == 0
        elif value == sp.Rational(1, 3):
            ratio = resultant / ours
        else:
            # psi is normalized: equal up to one constant.
            assert sp.simplify(resultant / ours - ratio) == 0


@examples
@given(forms(min_order=2, max_order=9) | forms_with_repeated_roots(max_order=8))
def test_eigenvalues_are_the_roots_of_psi(form):
    pairs = complex_eigenpairs(form)
    assume(pairs.status == "ok" and form.order > 1)
    psi = characteristic_polynomial(form)
    assert psi.is_irregular == (form.order > 2 and is_irregular(form))
    assume(not psi.is_irregular)
    poly = psi.polynomial
    for pair in pairs:
        value = pair.eigenvalue(60)
        size = sum(abs(c) * max(1, abs(value)) ** i for (i,), c in poly.terms())
        assert abs(sp.N(poly.as_expr().subs(LAMBDA, value), 60)) <= size * sp.Float("1e-25")
    degree = form.order if form.order % 2 == 0 else 2 * form.order
    if pairs.isotropic_multiplicity == 0:
        assert poly.degree() == degree
    else:
        assert poly.degree() < degree


@examples
@given(forms(min_order=1, max_order=16) | forms_with_repeated_roots(max_order=12))
def test_the_count_theorem(form):
    """With multiplicity the classes number n_max, the largest frequency present."""
    pairs = complex_eigenpairs(form)
    support = form.row.support
    if pairs.status != "ok":
        assert support == []
        return
    assert pairs.count == max(support)
    assert (pairs.isotropic_multiplicity > 0) == (form.row[form.order] == 0)
    assert pairs.count + 2 * pairs.isotropic_multiplicity == form.order
    own_real = sum(p.multiplicity for p in pairs if p.is_real)
    assert 2 * own_real == sum(p.multiplicity for p in real_eigenpairs(form))


@examples
@given(forms(min_order=2, max_order=8))
def test_the_definition_holds(form):
    for pair in complex_eigenpairs(form):
        v, value = pair.vector(40), pair.eigenvalue(40)
        assert abs(sp.N(v[0] ** 2 + v[1] ** 2 - 1, 40)) <= 1e-25 * (1 + abs(v[0]) ** 2)
        scale = sum(abs(c) for c in form.coefficients) * (1 + abs(v[0]) + abs(v[1])) ** form.order
        for part, component in zip(form.gradient(), v, strict=True):
            assert abs(sp.N(part(*v) / form.order - value * component, 40)) <= 1e-25 * scale


root2, root3 = sp.sqrt(2), sp.sqrt(3)


@pytest.mark.parametrize(
    "coefficients",
    [
        [1, root2, 1],
        [1, 0, root2, 0, 1],
        [root2, root3, -1, 2, root2 + root3],
        [sp.cos(sp.pi / 7), 1, 0, -2],
        [sp.pi, 0, sp.pi * root2, 1 * sp.pi, -sp.pi],
        [sp.cbrt(2), 1, sp.cbrt(4), 0, 3, -1, 2],
    ],
)
def test_algebraic_coefficients_against_mpmath(coefficients):
    """Every root of F(1, tau) that mpmath finds with 60 digits lies in one enclosure."""
    form = BinaryForm(coefficients)
    pairs = complex_eigenpairs(form)
    assert pairs.count == max(form.row.support)
    with mpmath.workdps(70):
        derivative = [mpmath.mpmathify(sp.N(c, 70))
                      for c in form.angular_derivative().coefficients]  # fmt: skip
        while abs(derivative[-1]) < mpmath.mpf(10) ** -60:
            derivative.pop()
        zeros = mpmath.polyroots(derivative[::-1], maxsteps=500, extraprec=400)
        boxes = [p.tangent_enclosure(45) for p in pairs if p.polynomial is not None]
        for box in boxes:
            near = [z for z in zeros if _distance(box.real, z.real) < mpmath.mpf(10) ** -40
                    and _distance(box.imaginary, z.imag) < mpmath.mpf(10) ** -40]  # fmt: skip
            assert len(near) == 1
        assert len(boxes) + 2 * bool(pairs.isotropic_multiplicity) == len(zeros)


def _distance(side, value):
    lower, upper = (mpmath.mpf(e.numerator) / e.denominator for e in side)
    return max(lower - value, value - upper, 0)


def test_algebraic_multiplicities_are_exact():
    # F is made of (t^2 - sqrt(2) t + 1)^2, whose zeros are no real numbers, and of t.
    base = x**2 - root2 * x * y + y**2
    form = BinaryForm.from_expression(sp.expand(base**3))
    pairs = complex_eigenpairs(form)
    double = [p for p in pairs if p.multiplicity == 2]
    assert len(double) == 2
    assert not any(p.is_real for p in double)
    assert all(p.vanishing and p.eigenvalue(30) == 0 for p in double)
    assert pairs.count == 6
    assert not any(p.vanishing for p in pairs if p.multiplicity == 1)


def test_vectors_and_eigenvalues_are_certified():
    """At two precisions the enclosures of one member overlap and satisfy the definition."""
    engine = balls.engine()
    # x^3 + 3/4 x y^2 has tau = +-2i, on the cut of the root of 1 + tau^2.
    for form in (HAND, BinaryForm([1, 2, -1, 3, 1]), BinaryForm([1, root2, 0, 3])):
        for pair in complex_eigenpairs(form):
            wide, narrow = pair.eigenvalue_enclosure(10), pair.eigenvalue_enclosure(40)
            assert all(p.overlaps(q) for p, q in zip(wide, narrow, strict=True))
            assert narrow.width < sp.Rational(1, 10**39)
            v = pair.vector_enclosure(40)
            again = pair.vector_enclosure(5)
            for p, q in zip(v, again, strict=True):
                assert all(r.overlaps(s) for r, s in zip(p, q, strict=True))
            with engine.precision(200):
                X, Y = (engine.complex_interval(c) for c in v)
                value = engine.complex_interval(narrow)
                # |v| = 1 and T v^(k-1) = lambda v: zero is inside the intervals.
                one = engine.rectangle(X * X + Y * Y - 1)
                assert not one.excludes_zero
                assert one.width < sp.Rational(1, 10**35)
                k = form.order
                for part, component in zip(form.gradient(), (X, Y), strict=True):
                    terms = (
                        engine.interval(enclose_real(sp.sympify(c), 200)) * X ** (k - 1 - j) * Y**j
                        for j, c in enumerate(part.coefficients)
                    )
                    defect = engine.rectangle(sum(terms, 0 * X) - k * value * component)
                    assert not defect.excludes_zero


def test_statuses_and_bad_input():
    assert complex_eigenpairs(BinaryForm([1, 0, 1])).status == "isotropic"
    assert complex_eigenpairs(BinaryForm([0, 0])).status == "vanishing"
    with pytest.raises(InputError, match="depends on a"):
        complex_eigenpairs(BinaryForm([1, a, 1]))
    with pytest.raises(InputError, match="order is 1"):
        characteristic_polynomial(BinaryForm([1, 1]))
    with pytest.raises(InputError, match="41"):
        characteristic_polynomial(WavejetsRow(41, {1: 1}))
    with pytest.raises(InputError, match="vertical"):
        complex_eigenpairs(BinaryForm([1, 0, 2]))[1].tangent_enclosure()
