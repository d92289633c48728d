"""``pdtheory eigen``, as a user meets it."""

import json
import subprocess
import sys
from collections.abc import Callable
from typing import Any

import mpmath
import pytest
from typer.testing import Result

Run = Callable[..., Result]
Refused = Callable[..., str]


def orders(cli: Run, *arguments: object) -> dict[str, Any]:
    result = cli("eigen", *arguments, "--json")
    assert result.exit_code == 0, result.output
    found: dict[str, Any] = json.loads(result.stdout)["orders"]
    return found


def test_monkey_saddle(cli: Run) -> None:
    (order, term), *others = orders(cli, "x**3 - 3*x*y**2").items()
    assert (order, others, term["status"]) == ("3", [], "ok")
    assert term["wavejets"] == {"1": [0, 0], "3": [0.5, 0]}
    angles = [pair["angle_deg"] for pair in term["pairs"]]
    assert angles == pytest.approx([0, 60, 120, 180, 240, 300], abs=1e-13)
    assert [pair["eigenvalue"] for pair in term["pairs"]] == [6, -6, 6, -6, 6, -6]
    assert [pair["kind"] for pair in term["pairs"]] == ["max", "min"] * 3
    assert {pair["multiplicity"] for pair in term["pairs"]} == {1}


def test_every_order_that_does_not_vanish(cli: Run) -> None:
    assert list(orders(cli, "x*y + x**5")) == ["2", "5"]
    assert list(orders(cli, "exp(x) - 1 - x", "--max-order", 4)) == ["2", "3", "4"]


def test_statuses(cli: Run) -> None:
    assert orders(cli, "(x**2 + y**2)**2", "--order", 4)["4"]["status"] == "isotropic"
    assert orders(cli, "x**2", "--order", 5)["5"] == {
        "wavejets": {"1": [0, 0], "3": [0, 0], "5": [0, 0]},
        "pairs": [],
        "status": "vanishing",
    }


def test_inflections_are_listed(cli: Run) -> None:
    pairs = orders(cli, "y**3")["3"]["pairs"]
    assert [(pair["angle_deg"], pair["kind"]) for pair in pairs] == [
        (0, "inflection"),
        (90, "max"),
        (180, "inflection"),
        (270, "min"),
    ]
    assert [pair["multiplicity"] for pair in pairs] == [2, 1, 2, 1]


def test_digits_agree_with_mpmath(cli: Run) -> None:
    # x^3 + x^2 y: F(1, t) = 1 - 3 t - 2 t^2 has the roots (-3 +- sqrt 17)/4.
    output = cli("eigen", "x**3 + x**2*y", "--digits", 40).stdout
    with mpmath.workdps(60):
        theta = mpmath.degrees(mpmath.atan((mpmath.sqrt(17) - 3) / 4))
        assert mpmath.nstr(theta, 40) in output


def test_formula_with_a_leading_minus(cli: Run) -> None:
    assert orders(cli, "-x**3 + 3*x*y**2")["3"]["pairs"][0]["eigenvalue"] == -6


@pytest.mark.parametrize(
    ("formula", "reason"),
    [
        ("__import__('os')", "not allowed"),
        ("().__class__", "not allowed"),
        ("lambda: 1", "not allowed"),
        ("x + q", "'q'"),
        ("x**", "syntax"),
        ("", "empty"),
        ("x**3\x00", ""),
        ("x**10**10", "exponent"),
        ("1/x", "choose another point"),
        ("I*x**2", ""),
        ("2", "vanishes"),
        ("x" + "+x" * 10_000, ""),
    ],
)
def test_bad_formulas(refused: Refused, formula: str, reason: str) -> None:
    assert reason in refused("eigen", formula)


def test_bad_options(refused: Refused) -> None:
    for option in ("--order", "--max-order", "--digits"):
        refused("eigen", "exp(x)", option, 0)
        refused("eigen", "exp(x)", option, 10**9)


def test_the_frame_on_a_surface_can_be_read(cli: Run) -> None:
    result = cli("eigen", "--implicit", "x**2+y**2+z**2-1", "--at", "1/3,2/3,2/3", "--order", 2)
    assert result.exit_code == 0, result.output
    assert result.stdout.splitlines()[:4] == [
        "At (1/3, 2/3, 2/3), in the frame",
        "  x      (2*sqrt(2)/3, -sqrt(2)/6, -sqrt(2)/6)",
        "  y      (0, sqrt(2)/2, -sqrt(2)/2)",
        "  normal (1/3, 2/3, 2/3)",
    ]


def test_numbers_of_more_digits_than_python_writes() -> None:
    """The installed command lifts the limit of Python, in a process of its own."""
    code = "import sys; from pdtheory.cli.main import run; sys.argv[0] = 'pdtheory'; run()"
    result = subprocess.run(
        [sys.executable, "-c", code, "eigen", "1e5000*x**2", "--latex", "--digits", "3"],
        capture_output=True,
        text=True,
        check=True,
        timeout=120,
    )
    assert f"T_{{2}}v^{{2}} = 2{'0' * 5000} x^{{2}}" in result.stdout
    assert r"& 2 \cdot 10^{5000} &" in result.stdout
