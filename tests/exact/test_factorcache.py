"""Roots of numbers whose large factors are near each other."""

from __future__ import annotations

import pytest
import sympy as sp

from pdtheory.exact import parse_expression, real_eigenpairs, taylor_forms

#: Products of two composite numbers near each other, without small factors but for the first.
NEAR = [
    978188756923448938700236182276357436,
    100433627766186896990756600421092392239752396140872399152689,
]


@pytest.mark.parametrize("number", NEAR)
def test_the_root_of_a_product_of_near_numbers(number):
    root = parse_expression(f"sqrt({number})")
    assert root**2 == number
    assert sp.sqrt(49 * number) == 7 * root


@pytest.mark.parametrize("number", NEAR)
def test_eigenvalues_with_such_roots(number):
    formula = parse_expression(f"sqrt({number})*x**2 + y**2")
    form = taylor_forms(formula, sp.symbols("x y"), 2)[2]
    values = sorted({pair.eigenvalue_float(17) for pair in real_eigenpairs(form)})
    assert values == pytest.approx([2.0, 2.0 * number**0.5], rel=1e-15)
