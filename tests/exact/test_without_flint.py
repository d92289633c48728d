"""The exact side without python-flint: the same answers from SymPy and mpmath alone."""

import json
import subprocess
import sys

import pytest

PROGRAM = """
import json, sys
if sys.argv[1] == "blocked":
    sys.modules["flint"] = None
import sympy as sp
from pdtheory.exact import *
from pdtheory.exact import balls
from pdtheory.exact.report import order_report
root = sp.sqrt(2)
forms = [BinaryForm(c) for c in (
    [6, 0, -18, 0], [0, 0, 0, 1], [1, root, 1, 3], [root, sp.sqrt(3), 1], [1, 2, 3, 4, 5, 6, 7],
    [sp.pi, 0, 2 * sp.pi], [1, 0, 2, 0, 1],
)]
x, y, z = sp.symbols("x y z")
jet = implicit_jet(x**2 + y**2 / 4 - z, (x, y, z), 4, (1, 2, 2))
print(json.dumps({
    "engine": balls.engine().name,
    "orders": [order_report(f.eigenpairs()) for f in [*forms, jet.form(3), jet.form(4)]],
    "psi": [str(characteristic_polynomial(f).polynomial.as_expr()) for f in forms[:5]],
    "complex": [str(p.eigenvalue(12)) for p in complex_eigenpairs(forms[4])],
    "digits": str(forms[4].eigenpairs()[0].angle_degrees(300)),
}))
"""


def answers(mode):
    result = subprocess.run(
        [sys.executable, "-c", PROGRAM, mode], capture_output=True, text=True, check=True
    )
    return json.loads(result.stdout)


def test_same_answers():
    own, without = answers("free"), answers("blocked")
    assert without.pop("engine") == "sympy"
    assert own.pop("engine") == "python-flint"
    for with_flint, plain in zip(own.pop("orders"), without.pop("orders"), strict=True):
        for p, q in zip(with_flint["pairs"], plain["pairs"], strict=True):
            assert p["angle_deg"] == pytest.approx(q["angle_deg"], abs=1e-12)
            assert p["eigenvalue"] == pytest.approx(q["eigenvalue"], rel=1e-14)
            assert (p["kind"], p["multiplicity"]) == (q["kind"], q["multiplicity"])
        assert with_flint["status"] == plain["status"]
    assert own == without
