"""The tools of the certificates against the exact side and mpmath: no code is shared."""

import random
from fractions import Fraction

import mpmath
import pytest
import sympy as sp

from pdtheory.exact import (
    BinaryForm,
    WavejetsRow,
    characteristic_polynomial,
    cone_coefficient,
)
from pdtheory.exact.strata import order3_discriminant, order4_discriminant
from pdtheory.paper.claims.corrected_counts import d3, d4
from pdtheory.paper.claims.fits import basis, fit, gaussian_moment, gaussian_values, uniform_moment
from pdtheory.paper.claims.kit import identity, vanish, x, y
from pdtheory.paper.claims.resultants import psi_value
from pdtheory.paper.claims.sturm import (
    circle_point,
    count_maxima,
    form_of_expression,
    form_of_row,
    is_maximum,
    lines_are_maxima,
    random_row,
    real_lines,
    row_of_lines,
)


def _row(order, row):
    return WavejetsRow(
        order, {n: sp.Rational(a) + sp.I * sp.Rational(b) for n, (a, b) in row.items()}
    )


@pytest.mark.parametrize("order", [2, 3, 4, 5, 8, 13, 20])
def test_sturm_counts_agree_with_certified_eigenpairs(order):
    generator = random.Random(order)
    for _ in range(5):
        row = random_row(order, generator)
        pairs = _row(order, row).eigenpairs()
        assert count_maxima(order, form_of_row(order, row)) == len(pairs.maxima)


def test_discriminants_agree():
    generator = random.Random(5)
    for _ in range(20):
        for order, ours, theirs in ((3, d3, order3_discriminant), (4, d4, order4_discriminant)):
            row = random_row(order, generator)
            low, high = (
                sp.Rational(row[n][0]) + sp.I * sp.Rational(row[n][1]) for n in (order - 2, order)
            )
            value = ours(low, high, sp.conjugate(low), sp.conjugate(high))
            assert sp.expand(value) == theirs(_row(order, row))


@pytest.mark.parametrize("order", [2, 3, 4, 5, 6])
def test_characteristic_polynomials_agree_up_to_a_factor(order):
    coefficients = [3, -1, 4, 1, -5, 9, -2][: order + 1]
    polynomial = characteristic_polynomial(BinaryForm(coefficients)).polynomial
    p = form_of_expression(sum(c * x ** (order - j) * y**j for j, c in enumerate(coefficients)))
    ratios = {
        sp.Rational(str(psi_value(order, p, value))) / polynomial.eval(value)
        for value in range(10, 15)
    }
    assert len(ratios) == 1


def test_rows_become_the_same_forms():
    generator = random.Random(1)
    for order in (1, 2, 5, 8):
        row = random_row(order, generator)
        ours = [Fraction(int(c.p), int(c.q)) for c in form_of_row(order, row).coeffs()]
        theirs = [c / sp.factorial(order) for c in _row(order, row).form.coefficients]
        assert [sp.Rational(c) for c in ours] == theirs[: len(ours)]
        assert not any(theirs[len(ours) :])


@pytest.mark.parametrize("weight", ["uniform", "gaussian"])
def test_fits_agree_with_cone_coefficients(weight):
    moment = {"uniform": uniform_moment, "gaussian": gaussian_moment}[weight]
    for frequency in (1, 2, 3, 4, 7):
        for order, value in fit(moment, basis(10, frequency), 1).items():
            ours = sp.sympify(value).subs(gaussian_values()).evalf(30)
            theirs = sp.N(cone_coefficient(order, frequency, 10, weight=weight), 30)
            assert abs(ours - theirs) < sp.Float("1e-25") * (1 + abs(theirs))


def test_gaussian_moments_agree_with_quadrature():
    with mpmath.workdps(40):
        for power in range(8):
            expected = mpmath.quad(lambda r, m=power: r**m * mpmath.exp(-4.5 * r * r), [0, 1])
            ours = mpmath.mpf(str(gaussian_moment(power).subs(gaussian_values(45)).evalf(40)))
            assert abs(ours - expected) < mpmath.mpf("1e-35")


def test_lines_with_multiplicity_and_at_infinity():
    assert real_lines(3, form_of_expression(3 * x * y**2)) == {2: 1, 1: 1}
    assert real_lines(4, form_of_expression((x**2 + y**2) ** 2)) == {}
    assert count_maxima(4, form_of_expression((x**2 + y**2) ** 2)) is None
    assert real_lines(2, form_of_expression(x**2)) == {2: 1}


def test_row_of_lines_has_those_critical_lines():
    points = [circle_point(Fraction(h)) for h in (0, 2, -3)]
    row = row_of_lines(points)
    p = form_of_row(5, row)
    assert count_maxima(5, p) == 3
    assert all(is_maximum(5, p, point) for point in points)
    assert not any(is_maximum(5, p, (-c, -s)) for c, s in points)
    with pytest.raises(ValueError, match="mean"):
        row_of_lines(points[:2])


def test_lines_are_maxima_sees_each_condition():
    one = Fraction(1)
    assert lines_are_maxima(4, form_of_row(4, {4: (one, 0 * one), 2: (one, 0 * one)}), 2)
    assert not lines_are_maxima(4, form_of_row(4, {4: (one, 0 * one), 2: (5 * one, 0 * one)}), 2)
    assert not lines_are_maxima(4, form_of_row(4, {4: (one, 0 * one), 2: (one, one)}), 2)


def test_vanish_only_vanishes_for_zero():
    assert vanish(sp.sin(x) ** 2 + sp.cos(x) ** 2 - 1) == 0
    assert vanish((x + y) ** 2 - x**2 - y**2) != 0
    assert not identity("wrong", sp.Derivative(x**3, x), 2 * x**2).holds


def test_claims_do_not_import_the_exact_side():
    # The certificates rest on plain SymPy and python-flint; BinaryForm only serves this comparison.
    import ast
    from pathlib import Path

    import pdtheory.paper.claims as package

    for path in Path(package.__file__).parent.glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom):
                assert not (node.module or "").startswith("pdtheory.exact"), path
    assert BinaryForm([1, 0]).order == 1
