"""The benchmarks refuse a Python that lacks their peers."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

BENCHMARKS = Path(__file__).parents[1] / "benchmarks"


@pytest.mark.parametrize("python", ["no-such-python", "lacking"])
@pytest.mark.parametrize(
    ("script", "options", "module"),
    [
        ("pointset.py", ["--peers"], "igl"),
        ("meshlab.py", ["--peers"], "pymeshlab"),
        ("accuracy.py", ["peers", "--python"], "igl"),
    ],
)
def test_a_python_without_the_peer_is_refused(tmp_path, script, options, module, python):
    place = tmp_path / python
    if python == "lacking":
        place.write_text("#!/bin/sh\nexit 1\n", encoding="utf-8")
        place.chmod(0o755)
    done = subprocess.run(
        [sys.executable, BENCHMARKS / script, *options, place],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert str(place) in done.stderr
    assert module in done.stderr
    assert len(done.stderr.splitlines()) == 1
