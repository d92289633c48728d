"""Roots of numbers whose large factors are near each other."""

from __future__ import annotations

import os
import subprocess
import sys
from importlib.util import find_spec

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


@pytest.mark.parametrize("ground", ["python", "flint"])
def test_the_public_store_is_kept_with_what_it_holds(ground):
    if ground == "flint" and find_spec("flint") is None:
        pytest.skip("python-flint is not installed (extra exact)")
    lines = (
        "import sympy",
        "from sympy.ntheory import factor_",
        "held = sympy.factor_cache",
        "held[40] = 5",
        "held.maxsize = 7",
        "from pdtheory.exact.factorcache import remember_primes_only",
        "corrected = type(held)",
        "remember_primes_only()",
        "assert type(held) is corrected",
        "assert sympy.factor_cache is factor_.factor_cache is held",
        "assert held[40] == 5 and held.maxsize == 7",
        f"for number in {NEAR}:",
        "    assert sympy.sqrt(number) ** 2 == number",
        "sympy.factorint(1000003 * 1000033 * 1000037)",
        "assert len(held) > 1",
        "held.get_external = lambda n: [3, 7] if n == 3**5 * 7**9 else None",
        "assert held.get(3**5 * 7**9) == 7",
    )
    code = "\n".join(lines)
    environment = {**os.environ, "SYMPY_GROUND_TYPES": ground}
    subprocess.run([sys.executable, "-c", code], check=True, env=environment)
