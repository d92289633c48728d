"""The benchmark beside public Wavejets codes refuses what it cannot measure."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[1] / "benchmarks" / "wavejets.py"

#: In place of a compiler: what it makes answers every question with the same wrong numbers.
COMPILER = f"""#!{sys.executable}
import pathlib, sys
program = pathlib.Path(sys.argv[sys.argv.index("-o") + 1])
program.write_text('''#!{sys.executable}
import sys
print(" ".join(["0.5"] * (9 + (int(sys.argv[1]) + 1) * (int(sys.argv[1]) + 2))))
print(1e-6, file=sys.stderr)
''')
program.chmod(0o755)
"""


def run(folder: Path, *options: str | Path) -> subprocess.CompletedProcess[str]:
    """Run the benchmark with no other programs at hand than those in a folder."""
    command = [sys.executable, SCRIPT, *options, "--build", folder]
    environment = {**os.environ, "PATH": str(folder)}
    return subprocess.run(command, capture_output=True, text=True, env=environment, check=False)


def executable(place: Path, text: str) -> None:
    place.write_text(text, encoding="utf-8")
    place.chmod(0o755)


@pytest.fixture
def checkout(tmp_path) -> Path:
    """A folder with the names of the sources of CPPWaveJets, and nothing in them."""
    here = tmp_path / "checkout"
    for name in ("wavejet.cpp", "phi.cpp"):
        (here / "wavejet" / "src").mkdir(parents=True, exist_ok=True)
        (here / "wavejet" / "src" / name).touch()
    return here


@pytest.fixture
def eigen(tmp_path) -> Path:
    """A folder with the name of Eigen's header."""
    (tmp_path / "Eigen").mkdir()
    (tmp_path / "Eigen" / "Dense").touch()
    return tmp_path


def refused(done: subprocess.CompletedProcess[str], word: str) -> None:
    assert done.returncode == 2
    assert word in done.stderr
    assert len(done.stderr.splitlines()) == 1
    assert not done.stdout


def test_a_folder_without_a_checkout_is_refused(tmp_path):
    refused(run(tmp_path, "--sources", tmp_path / "nowhere"), "nowhere is not a checkout of")


def test_a_missing_compiler_is_said(tmp_path, checkout):
    refused(run(tmp_path, "--sources", checkout), "g++ is not installed")


@pytest.mark.skipif(os.name == "nt", reason="the compiler that stands in is a script")
def test_sources_that_do_not_compile_are_refused(tmp_path, checkout, eigen):
    executable(tmp_path / "g++", f"#!{sys.executable}\nraise SystemExit('fatal error: no such')\n")
    refused(run(tmp_path, "--sources", checkout, "--eigen", eigen), "fatal error: no such")


@pytest.mark.skipif(os.name == "nt", reason="the compiler that stands in is a script")
def test_a_code_that_misses_an_exact_polynomial_is_not_timed(tmp_path, checkout, eigen):
    executable(tmp_path / "g++", COMPILER)
    done = run(tmp_path, "--sources", checkout, "--eigen", eigen)
    assert done.returncode == 1
    assert "CPPWaveJets misses an exact polynomial; no figures for it." in done.stderr
    assert len(done.stdout.splitlines()) == 1
