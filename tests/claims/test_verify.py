"""``pdtheory verify``."""

import json

import pytest
import typer
from typer.testing import CliRunner

from pdtheory.cli.verify import verify
from pdtheory.errors import FileAccessError, InputError
from pdtheory.paper import claims

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
