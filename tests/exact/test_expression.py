"""Formulas from text: what is read, and what is refused without running anything."""

import pytest
import sympy as sp

from pdtheory.errors import ExpressionError
from pdtheory.exact import parse_expression

x, y, a = sp.symbols("x y a")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("x**3 - 3*x*y**2", x**3 - 3 * x * y**2),
        ("0.1*x", x / 10),
        ("1e-3 * y", y / 1000),
        ("-(x + 2)/3", -(x + 2) / 3),
        ("sqrt(2)*x + pi", sp.sqrt(2) * x + sp.pi),
        ("exp(x)*sin(y)", sp.exp(x) * sp.sin(y)),
        ("x**(1/2)", sp.sqrt(x)),
        ("  x  ", x),
        ("+".join(["x"] * 1500), 1500 * x),
    ],
)
def test_reads(text, expected):
    assert parse_expression(text) == expected


def test_parameters_and_other_variables():
    assert parse_expression("a*x", parameters=["a"]) == a * x
    assert parse_expression("u*v", variables=("u", "v")) == sp.Symbol("u") * sp.Symbol("v")


@pytest.mark.parametrize(
    "text",
    [
        "__import__('os')",
        "__import__('os').system('true')",
        "x.__class__",
        "(lambda: x)()",
        "[x for x in (1, 2)]",
        "exec('1')",
        "open('f')",
        "x if x else y",
        "a := 1",
        "f'{x}'",
        "'x'",
        "x[0]",
        "sin(x, y)",
        "sin(*x)",
        "sin(x=1)",
        "True",
        "1j",
        "0x10",
        "x and y",
        "x < y",
        "x // y",
        "x % y",
        "x ^ 2",
        "x ** y",
        "z",
        "import os",
        "",
        "   ",
        "x +",
        "2x",
        "1/0",
        "x/(1 - 1)",
        "0**(-1)",
        "log(0)",
        "9**9**9",
        "((2**256)**256)**256",
        "1e999999999",
        "sqrt(1e400 + x)",
        "cbrt(1e400)",
        "(1 + 1e-400)**(1/2)",
        "x**1000",
        "(" * 150 + "x" + ")" * 150 + "*" * 3,
        "-" * 500 + "x",
        "x" * 20_000,
    ],
)
def test_refuses_with_the_operand(text):
    with pytest.raises(ExpressionError) as caught:
        parse_expression(text)
    message = str(caught.value)
    assert "\n" not in message
    assert len(message) < 400


def test_nothing_is_run(tmp_path):
    target = tmp_path / "made"
    with pytest.raises(ExpressionError, match="__import__"):
        parse_expression(f"__import__('pathlib').Path({str(target)!r}).touch()")
    assert not target.exists()


def test_the_message_names_the_culprit_and_the_remedy():
    with pytest.raises(ExpressionError, match=r"'q'.*x, y"):
        parse_expression("x*q")
    with pytest.raises(ExpressionError, match=r"\^.*x\*\*2"):
        parse_expression("x^2")
