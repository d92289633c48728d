"""Compare eigenvectors and E-eigenvalues with Macaulay2.

For ten random integer forms of each order from 3 to 6, and for one with a multiple direction and
one with isotropic eigenvectors, Macaulay2 computes

- the ideal of eigenvectors, the 2 x 2 minors of (T v^(k-1) | v): its degree, the degree of its
  radical, and the degrees and multiplicities of its primary parts over Q;
- the polynomial of the E-eigenvalues, by eliminating v from T v^(k-1) = lambda v, v.v = 1.

They must be the factors of F with their multiplicities, and the squarefree part of psi unless the
form is irregular (psi = 0).
Run ``python benchmarks/peers/macaulay2.py``; it needs the program M2 (Debian package macaulay2).
"""

from __future__ import annotations

import random
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import sympy as sp

from pdtheory.exact import (
    BinaryForm,
    characteristic_polynomial,
    complex_eigenpairs,
    is_irregular,
)
from pdtheory.exact.balls import engine

ORDERS = range(3, 7)
FORMS = 10

PROGRAM = """
R = QQ[x, y, l, MonomialOrder => Eliminate 2];
S = QQ[x, y];
report = (k, f) -> (
    fS := sub(f, S);
    I := minors(2, matrix {{diff(S_0, fS), diff(S_1, fS)}, {S_0, S_1}});
    parts := sort apply(primaryDecomposition I, p -> {degree radical p, degree p});
    J := ideal(diff(R_0, f) - k * R_2 * R_0, diff(R_1, f) - k * R_2 * R_1, R_0^2 + R_1^2 - 1);
    E := eliminate({R_0, R_1}, J);
    << "RESULT " << degree I << " | " << degree radical I << " | " << toString parts
       << " | " << toString (radical E)_0 << endl;
    );
"""


def script(forms: list[BinaryForm]) -> str:
    """Return the Macaulay2 program for some forms."""
    lines = [PROGRAM]
    for form in forms:
        text = sp.sstr(form.expression).replace("**", "^")
        lines.append(f"use R; report({form.order}, {text});")
    return "\n".join([*lines, "exit 0", ""])


def run(forms: list[BinaryForm]) -> list[list[str]]:
    """Run Macaulay2 and return the four fields of every result."""
    program = shutil.which("M2")
    if program is None:
        sys.exit("Macaulay2 (the program M2) is not installed.")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "forms.m2"
        path.write_text(script(forms))
        output = subprocess.run(
            [program, "--script", str(path)],
            capture_output=True,
            text=True,
            timeout=900,
            check=False,
        )
    results = [
        [part.strip() for part in line.removeprefix("RESULT").split("|")]
        for line in output.stdout.splitlines()
        if line.startswith("RESULT")
    ]
    if len(results) != len(forms):
        sys.exit(f"Macaulay2 answered {len(results)} of {len(forms)} forms:\n{output.stderr}")
    return results


def own_parts(form: BinaryForm) -> list[list[int]]:
    """Degrees of the irreducible factors of F and of their powers, ascending."""
    derivative = [int(c) for c in form.angular_derivative().coefficients]
    while derivative[-1] == 0:
        derivative.pop()
    parts = [[len(p) - 1, (len(p) - 1) * m] for p, m in engine().factor(tuple(derivative))]
    if len(derivative) <= form.order:
        parts.append([1, form.order + 1 - len(derivative)])
    return sorted(parts)


def check(form: BinaryForm, result: list[str]) -> list[str]:
    """Return what disagrees between the two programs."""
    degree, reduced, parts, polynomial = result
    problems = []
    own = own_parts(form)
    theirs = sorted([int(a), int(b)] for a, b in re.findall(r"\{(\d+), (\d+)\}", parts))
    if own != theirs:
        problems.append(f"primary parts {theirs} against factors {own}")
    if int(degree) != form.order or int(reduced) != sum(p[0] for p in own):
        problems.append(f"degrees {degree}, {reduced} against {form.order}")
    pairs = complex_eigenpairs(form)
    if pairs.count + 2 * pairs.isotropic_multiplicity != int(degree):
        problems.append(f"count {pairs.count}")
    psi = characteristic_polynomial(form)
    if psi.is_irregular:
        # psi says nothing then; the form must be irregular by its definition.
        return problems if is_irregular(form) else [*problems, "psi vanishes without reason"]
    value = sp.Symbol("lambda")
    eliminated = sp.Poly(
        sp.Poly(_read(polynomial), sp.Symbol("l")).as_expr().subs("l", value), value
    )
    squarefree = sp.Poly(sp.Mul(*(p.as_expr() for p, _ in psi.factors())), value)
    if sp.expand(squarefree.monic().as_expr() - eliminated.monic().as_expr()) != 0:
        problems.append(f"E-eigenvalues {eliminated.as_expr()} against {squarefree.as_expr()}")
    return problems


def _read(text: str) -> Any:
    """Read a polynomial in l from Macaulay2's own notation, term by term."""
    total = sp.Integer(0)
    for sign, number, power, exponent in re.findall(
        r"([+-]?)(\d+(?:/\d+)?)?\*?(l(?:\^(\d+))?)?", text.replace(" ", "")
    ):
        if number or power:
            factor = sp.Rational(number or 1) * (-1 if sign == "-" else 1)
            total += factor * sp.Symbol("l") ** (int(exponent or 1) if power else 0)
    return total


def main() -> None:
    """Compare and print the outcome by order."""
    rng = random.Random(2024)
    failures = 0
    for order in ORDERS:
        forms = [BinaryForm([rng.randint(-9, 9) for _ in range(order + 1)]) for _ in range(FORMS)]
        # One form with a double direction and one with isotropic eigenvectors.
        forms.append(BinaryForm([0] * order + [1]))
        x, y = sp.symbols("x y")
        forms.append(
            BinaryForm.from_expression(
                sp.expand((x**2 + y**2) ** ((order - 1) // 2) * (x + 2 * y) ** (2 - order % 2))
            )
        )
        problems = [check(f, r) for f, r in zip(forms, run(forms), strict=True)]
        for form, found in zip(forms, problems, strict=True):
            for text in found:
                print(f"order {order}, {form.expression}: {text}")
        failures += sum(bool(p) for p in problems)
        print(f"order {order}: {sum(not p for p in problems)} of {len(forms)} forms agree")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
