"""The usage lines of all commands, and how the process ends."""

from __future__ import annotations

import re
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import Result

Run = Callable[..., Result]


@pytest.mark.parametrize(
    ("command", "arguments"),
    [
        ("estimate", "INPUT"),
        ("point", "FIELD INDEX"),
        ("draw", "FIELD"),
        ("view", "FIELD"),
        ("sample", "SURFACE"),
        ("surfaces", "[NAME]"),
        ("cone", "SHAPE"),
        ("inverse", ""),
        ("verify", "[ID]..."),
        ("figure", "[NAME|all]"),
        ("eigen", "[FORMULA]"),
        ("demo", ""),
        ("addon install", "[PACKAGE]"),
    ],
)
def test_usage_is_in_the_usual_notation(cli: Run, command: str, arguments: str) -> None:
    usage = cli(*command.split(), "--help").stdout.splitlines()[0]
    assert usage.rpartition("[OPTIONS]")[2].strip() == arguments


def test_what_help_speaks_of_is_in_the_usage(cli: Run) -> None:
    for command in ("estimate", "point"):
        text = cli(command, "--help").stdout
        (name,) = set(re.findall(r"of ([A-Z]{3,})", text))
        assert name in text.splitlines()[0]


#: Stands in for a command that works on a file, with a process of its own beside it.
WAITING = """
import signal, subprocess, sys, time
from pdtheory.atomic import atomic_path
from pdtheory.cli import main

@main.app.command()
def wait(target: str) -> None:
    worker = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"])
    try:
        with atomic_path(target) as temporary:
            temporary.write_text("half")
            print("working", flush=True)
            time.sleep(60)
    finally:
        worker.kill()
        print("tidied", worker.wait(), flush=True)

# As in a terminal, also where the tests themselves run under nohup.
for name in ("SIGTERM", "SIGHUP"):
    signal.signal(getattr(signal, name), signal.SIG_DFL)
main.run()
"""


@pytest.mark.skipif(sys.platform == "win32", reason="Windows knows no such signals")
@pytest.mark.parametrize("name", ["SIGTERM", "SIGHUP"])
def test_a_process_that_is_told_to_end_tidies_up(tmp_path: Path, name: str) -> None:
    number = getattr(signal, name)
    target = tmp_path / "picture.png"
    with subprocess.Popen(
        [sys.executable, "-c", WAITING, "wait", target], stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "working\n"
        assert len(list(tmp_path.iterdir())) == 1
        process.send_signal(number)
        assert process.stdout.readline().startswith("tidied")
        assert process.wait(timeout=20) == 128 + number
    assert not list(tmp_path.iterdir())
