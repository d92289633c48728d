"""The tools of the certificates against the exact side and mpmath: no code is shared."""

import random
from fractions import Fraction

import mpmath
import pytest
import sympy as sp

from pdtheory.exact import BinaryForm, WavejetsRow, cone_coefficient
from pdtheory.paper.claims.fits import basis, fit, gaussian_moment, gaussian_values, uniform_moment
from pdtheory.paper.claims.kit import (
    circle_point,
    count_maxima,
    form_of_expression,
    form_of_row,
    identity,
    is_maximum,
    lines_are_maxima,
    random_row,
    real_lines,
    row_of_lines,
    vanish,
    x,
    y,
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
    row = row_of_lines(5, points)
    p = form_of_row(5, row)
    assert count_maxima(5, p) == 3
    assert all(is_maximum(5, p, point) for point in points)
    assert not any(is_maximum(5, p, (-c, -s)) for c, s in points)
    with pytest.raises(ValueError, match="mean"):
        row_of_lines(4, points[:2])


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
