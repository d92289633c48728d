"""The commands eigen, inverse and cone of the exact side."""

import json

import mpmath
import pytest
import typer
from typer.testing import CliRunner

from pdtheory.cli.cone import cone
from pdtheory.cli.eigen import eigen
from pdtheory.cli.inverse import inverse
from pdtheory.errors import PdtheoryError

app = typer.Typer()
for command in (eigen, inverse, cone):
    app.command(command.__name__)(command)


def run(*arguments):
    result = CliRunner().invoke(app, list(arguments))
    assert result.exit_code == 0, result.output
    return result.stdout


def load(*arguments):
    return json.loads(run(*arguments, "--json"))


def angles(order, kind=None):
    return [p["angle_deg"] for p in order["pairs"] if kind in (None, p["kind"])]


def test_expansion_at_a_point():
    found = load("eigen", "x**2*y", "--at", "1,0")["orders"]
    assert list(found) == ["1", "2", "3"]
    # At (1, 0) the terms are y + 2 x y + x^2 y.
    assert angles(found["1"], "max") == [90]
    assert angles(found["2"], "max") == pytest.approx([45, 225])


@pytest.mark.parametrize("formula", ["sin(x)*y", "exp(x)*sin(y)", "sqrt(1+sqrt(2+x))+x*y**2"])
def test_expansion_at_a_point_of_constants(formula):
    found = load("eigen", formula, "--at", "1,1", "--max-order", "3", "--complex")["orders"]
    assert list(found) == ["1", "2", "3"]
    for order in found.values():
        assert order["status"] == "ok"
        kinds = [p["kind"] for p in order["pairs"] if p["kind"] != "inflection"]
        assert kinds in (["max", "min"] * (len(kinds) // 2), ["min", "max"] * (len(kinds) // 2))
        assert sum(c["multiplicity"] for c in order["complex"]["classes"]) in (1, 2, 3)
    text = run("eigen", formula, "--at", "1,1", "--order", "2", "--digits", "200")
    assert max(len(word) for word in text.split()) > 200
    assert r"\begin{array}" in run("eigen", formula, "--at", "1,1", "--order", "2", "--latex")


def test_exponents_with_large_denominators():
    f = "exp(-16*y**2) + exp(-16*x**2)*tanh(4*y)"
    order = load("eigen", f, "--at", "617/5000,1/4", "--order", "4")["orders"]["4"]
    assert len(order["pairs"]) in (4, 8)


def test_implicit_surface_at_a_point_of_constants():
    at = ["--implicit", "cosh(x)*y - exp(z)", "--at", "1,2,log(2*cosh(1))", "--order", "3"]
    assert len(load("eigen", *at)["orders"]["3"]["pairs"]) in (2, 4, 6)
    refused = CliRunner().invoke(app, ["eigen", *at, "--characteristic"])
    assert "psi is computed with at most 3" in str(refused.exception)


def test_implicit_surface():
    found = load("eigen", "--implicit", "x**2+y**2+z**2-9", "--at", "1,2,2", "--max-order", "4")
    assert [(k, v["status"]) for k, v in found["orders"].items()] == [
        ("2", "isotropic"),
        ("4", "isotropic"),
    ]
    assert found["orders"]["2"]["wavejets"]["0"] == pytest.approx([-1 / 6, 0])
    assert found["frame"][2] == ["1/3", "2/3", "2/3"]
    torus = "(x**2+y**2+z**2+3)**2-16*(x**2+y**2)"
    order = load("eigen", "--implicit", torus, "--at", "3,0,0", "--order", "2")["orders"]["2"]
    assert sorted({p["eigenvalue"] for p in order["pairs"]}) == pytest.approx([-1, -1 / 3])


def test_complex_and_characteristic():
    order = load("eigen", "x**3/6 + x*y**2/8", "--complex", "--characteristic")["orders"]["3"]
    assert [c["real"] for c in order["complex"]["classes"]] == [True, False, False]
    assert order["characteristic"]["factors"] == [
        ["lambda - 1", 1],
        ["lambda + 1", 1],
        ["4*lambda**2 + 1", 2],
    ]
    text = run("eigen", "x**3/6 + x*y**2/8", "--complex", "--characteristic")
    assert "psi(lambda) ~" in text
    irregular = run("eigen", "x*(x**2+y**2)**2", "--complex", "--characteristic")
    assert "irregular" in irregular
    assert "Isotropic eigenvectors" in irregular


def test_latex():
    text = run("eigen", "x**3 - 3*x*y**2", "--latex", "--characteristic")
    assert r"T_{3}v^{3}" in text
    assert r"\frac{\sqrt{3}}{2}" in text
    assert text.count(r"\begin{array}") == text.count(r"\end{array}") == 1


def test_latex_has_the_digits_that_are_asked_for():
    lines = run("eigen", "x**4 + x*y**3", "--latex", "--digits", "30").splitlines()
    angles = [line.split("&")[0].strip() for line in lines if r"\text{m" in line and "&" in line]
    # F(1, t) = -4 + 3 t - t^3 up to a sign.
    with mpmath.workdps(50):
        t = mpmath.findroot(lambda t: t**3 - 3 * t + 4, -2.2)
        theta = mpmath.nstr(mpmath.degrees(mpmath.atan(t)) + 180, 30)
        turned = mpmath.nstr(mpmath.degrees(mpmath.atan(t)) + 360, 30)
        cosine = 1 / mpmath.sqrt(1 + t**2)
        value = mpmath.nstr(24 * cosine**4 * (1 + t**3), 30)
    expected = [r"\theta", r"0^\circ", rf"{theta}^\circ", r"180^\circ", rf"{turned}^\circ"]
    assert angles == expected
    assert sum(f"& {value} &" in line for line in lines) == 2
    large = run("eigen", "1e60*x**4 + x*y**3", "--latex", "--digits", "3")
    assert r"2.4 \cdot 10^{61}" in large


def test_inverse():
    found = load("inverse", "--order", "3", "--maxima", "0,110,250")
    assert found["realizable"]
    assert angles(found["orders"]["3"], "max") == pytest.approx([0, 110, 250])
    refused = load("inverse", "--order", "3", "--maxima", "0,90,180")
    assert not refused["realizable"]
    assert "opposite" in refused["reason"]
    assert "Not realizable" in run("inverse", "--order", "3", "--maxima", "0,90,180")
    family = load("inverse", "--order", "4", "--critical", "0,30")
    assert family["dimension"] == len(family["basis"]) == 3
    assert "dimension 3" in run("inverse", "--order", "4", "--critical", "0,30")
    exact = found["orders"]["3"]["pairs"][0]["exact"]
    assert exact.startswith("v = (1, 0), lambda = the root of 8*t**3 + 24*t**2 - 30*t - 19 in")
    assert "Realizable" in run("inverse", "--order", "3", "--maxima", "0,110,250")


def test_inverse_of_eight_maxima_by_its_exact_row():
    maxima = [5, 17, 60, 100, 185, 197, 240, 280]
    arguments = ("inverse", "--order", "8", "--maxima", ",".join(map(str, maxima)))
    found = load(*arguments)
    assert angles(found["orders"]["8"], "max") == maxima
    assert found["exact_wavejets"]["8"] == "-cos(pi/45)/256 + I*sin(pi/45)/256"
    assert "phi_2 = -0.00200856 - 0.0244919*I" in " ".join(run(*arguments).split())


def test_cone():
    found = load("cone", "corner", "--orders", "2:3")["orders"]
    assert found["2"]["status"] == "isotropic"
    assert angles(found["3"], "max") == [0, 120, 240]
    rays = "0:0,90:-1,180:0,270:-1"
    ridge = load("cone", "planes", "--rays", rays, "--orders", "2")
    assert ridge == load("cone", "ridge", "--orders", "2")
    half = load("cone", "ridge", "--slope", "1/2", "--orders", "2", "--weight", "uniform")
    assert angles(half["orders"]["2"], "max") == [0, 180]
    assert "Order 3" in run("cone", "t-junction", "--orders", "3", "--degree", "5")


def test_a_flat_cone_says_why_nothing_is_listed():
    assert "The cone is a plane" in run("cone", "ridge", "--slope", "0", "--orders", "2:3")
    assert "The cone is a plane" not in run("cone", "ridge", "--orders", "2")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["eigen"], "Give either"),
        (["eigen", "x", "--implicit", "x"], "Give either"),
        (["eigen", "x", "--at", "1"], "2 coordinates"),
        (["eigen", "x", "--at", "1,x"], "'x'"),
        (["eigen", "--implicit", "x+y+z"], "--at"),
        (["eigen", "--implicit", "x+y+z-1", "--at", "0,0,0"], "not on the surface"),
        (["eigen", "--implicit", "x*y*z", "--at", "0,0,0"], "singular"),
        (["eigen", "--implicit", "x+y+z", "--at", "0,0,0"], "flat"),
        (["eigen", "x", "--json", "--latex"], "exclude"),
        (["eigen", "x", "--digits", "0"], "--digits is 0"),
        (["eigen", "x**200*y**200"], "400"),
        (["eigen", "x", "--order", "-1"], "-1"),
        (["eigen", "x", "--order", "100000"], "100000"),
        (["eigen", "7"], "vanishes"),
        (["eigen", "x**200", "--order", "200", "--json"], "beyond double precision"),
        (["eigen", "10**200*10**200*(x + sqrt(2)*y)", "--json"], "beyond double precision"),
        (["eigen", "sqrt(-2)*x"], "not real"),
        (["eigen", "x + (4*atan(1/5) - atan(1/239) - pi/4)*y"], "could not be proved"),
        (["eigen", "log(x)"], "no derivative"),
        (["eigen", "log(x)*y", "--at", "-1,1"], "log(x) is not real at x = -1, y = 1"),
        (["eigen", "acos(2*x)+y", "--at", "1,0"], "where its argument is 2; choose another point"),
        (["eigen", "--implicit", "sqrt(x)*y+z", "--at", "-1,0,0"], "sqrt(x) is not real"),
        (["inverse", "--order", "3"], "Give either"),
        (["inverse", "--order", "3", "--maxima", "0,a"], "'a'"),
        (["inverse", "--order", "0", "--maxima", "0"], "order is 0"),
        (["cone", "planes"], "--rays"),
        (["cone", "planes", "--rays", "0,1,2"], "angle:slope"),
        (["cone", "planes", "--rays", "0:0,90:0,180:0"], "spans 180"),
        (["cone", "planes", "--rays", "0:0,90:0,180:0,270:1", "--slope", "1"], "--slope"),
        (["cone", "ridge", "--rays", "0:0"], "planes"),
        (["cone", "ridge", "--orders", "2:11"], "order is 11"),
    ],
)
def test_bad_input_is_one_sentence(arguments, message):
    result = CliRunner().invoke(app, arguments)
    assert isinstance(result.exception, PdtheoryError), result.output
    text = str(result.exception)
    assert message in text
    assert "\n" not in text
