"""``pdtheory verify``."""

import json

import pytest
import typer
from typer.testing import CliRunner

from pdtheory.cli.verify import verify
from pdtheory.errors import FileAccessError, InputError
from pdtheory.paper import claims
from pdtheory.paper.claims.plain import plain_text

QUICK = ["parity-odd", "lemma-gradient"]


@pytest.fixture
def run():
    app = typer.Typer()
    app.command()(verify)

    def call(*arguments):
        return CliRunner().invoke(app, [*arguments, "--quiet"])

    return call


def test_table_and_exit_code(run):
    result = run(*QUICK)
    assert result.exit_code == 0
    assert "lemma-gradient" in result.output
    assert "2 of 2 claims come out as recorded" in result.output
    # Claims that are named are shown with their certificates.
    assert "Derivative(x**i*y**(-i + k)*binomial(k, i), x)" in result.output.replace("\n", "")


def test_formulas_are_printed_in_plain_characters(run):
    output = " ".join(run("krosy-iff").output.split())
    assert "if and only if phi_{k,n} = 0 for all n != +- k." in output
    assert "cos 4 theta + 1/2 cos 2 theta" in output
    assert "u_j = e^(2 i theta_j), because 2 is invertible mod k" in output


def test_no_claim_leaves_latex_in_the_terminal():
    # Lone braces would be those of a command that was not read with its argument.
    for claim in claims.CLAIMS:
        for text in (claim.printed, claim.statement):
            plain = plain_text(text)
            assert not set(plain) & set("$\\"), plain
            assert plain.count("(") == plain.count(")") or text.count("(") != text.count(")")


@pytest.mark.parametrize(
    ("formula", "plain"),
    [
        (r"$\frac{a+b}{2}$", "(a+b)/2"),
        (r"$\frac12 \cos\theta$", "1/2 cos theta"),
        (r"$2\pi i$", "2 pi i"),
        (r"$\sqrt{x^{k-1}}$", "sqrt(x^(k-1))"),
        (r"$e^{-i s} x^k y^{10}$", "e^(-i s) x^k y^10"),
        (r"$\overline{\phi_{k,n}}$", "conj(phi_{k,n})"),
        (r"$\binom{k}{i}$ of $\{0, \pm k\}$", "binomial(k, i) of {0, +- k}"),
        (r"$60^\circ$", "60 degrees"),
        ("no formula, 5_3 and {a}", "no formula, 5_3 and {a}"),
    ],
)
def test_plain_text(formula, plain):
    assert plain_text(formula) == plain


def test_json(run):
    result = run(*QUICK, "--json")
    entries = json.loads(result.output)
    assert [entry["id"] for entry in entries] == QUICK
    assert all(entry["holds"] for entry in entries)


def test_orders_reach_the_claims(run):
    found = json.loads(run("e-characteristic-polynomial", "--orders", "2:5", "--json").output)
    data = [step["data"] for step in found[0]["certificate"]["steps"]]
    assert "[2, 3, 4, 5]" in [entry.get("orders") for entry in data]


def test_a_different_verdict_gives_exit_code_1(run, monkeypatch):
    from dataclasses import replace

    changed = [replace(claims.claim(QUICK[0]), verdict=claims.Verdict.REFUTED)]
    monkeypatch.setattr(claims, "CLAIMS", tuple(changed))
    result = run()
    assert result.exit_code == 1
    assert "recorded as refuted" in result.output
    assert "its steps show: proved" in result.output


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["no-such-claim"], "no claim 'no-such-claim'"),
        (["qqqq"], "without an id all are checked and listed"),
        (["--orders", "1:4"], "between 2 and"),
        (["--orders", "two"], "cannot read the orders"),
        (["--report", "paper.docx"], "docx"),
        (["--report", "nowhere/paper.md"], "nowhere"),
    ],
)
def test_bad_input_is_one_sentence(run, arguments, sentence):
    result = run(*arguments)
    assert isinstance(result.exception, InputError | OSError)
    assert sentence in str(result.exception)


@pytest.mark.parametrize("suffix", ["md", "tex"])
def test_a_file_in_place_of_the_folder_of_figures_is_refused_at_once(
    run, tmp_path, monkeypatch, suffix
):
    pytest.importorskip("matplotlib")
    monkeypatch.setattr("pdtheory.paper.claims.run_claims", lambda *_: pytest.fail("too late"))
    (tmp_path / "paper_figures").write_text("mine")
    result = run(*QUICK, "--report", str(tmp_path / f"paper.{suffix}"))
    assert isinstance(result.exception, FileAccessError)
    assert "paper_figures is a file" in str(result.exception)
    assert [path.name for path in tmp_path.iterdir()] == ["paper_figures"]


def test_report_is_written(run, tmp_path):
    pytest.importorskip("matplotlib")
    target = tmp_path / "paper.md"
    result = run(*QUICK, "--report", str(target))
    assert result.exit_code == 0
    assert "### lemma-gradient" in target.read_text(encoding="utf-8")
