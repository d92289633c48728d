"""Interruptions reach the caller, also while a library is imported that would swallow them."""

import signal
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from pdtheory.interrupts import signals_held

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="sends signals")

#: The signal comes while trimesh imports SciPy, an import that it guards against everything.
AMID_THE_IMPORT = """
import os, signal, sys

# As in a terminal, also where the tests run in the background of a shell.
signal.signal(signal.SIGINT, signal.default_int_handler)
signal.signal(signal.SIGTERM, signal.SIG_DFL)

class Interrupting:
    sent = False

    def find_spec(self, name, path=None, target=None):
        if name == "scipy.spatial" and "trimesh" in sys.modules and not self.sent:
            self.sent = True
            print("sent", flush=True)
            os.kill(os.getpid(), NUMBER)

from pdtheory.cli import main
sys.meta_path.insert(0, Interrupting())
main.run()
"""


@pytest.mark.parametrize(
    ("name", "code", "sentence"), [("SIGINT", 130, "interrupted"), ("SIGTERM", 143, "")]
)
def test_a_command_ends_though_a_library_swallows_what_its_imports_raise(
    tmp_path: Path, name: str, code: int, sentence: str
) -> None:
    source, target = tmp_path / "scan.obj", tmp_path / "scan.ply"
    source.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    target.write_text("kept")
    program = AMID_THE_IMPORT.replace("NUMBER", str(int(getattr(signal, name))))
    arguments = ["estimate", source, "-o", target, "--samples", "100", "--degree", "2"]
    ended = subprocess.run(
        [sys.executable, "-c", program, *arguments, "--orders", "2"],
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert ended.stdout == "sent\n"
    assert ended.returncode == code
    assert sentence in ended.stderr
    assert "Traceback" not in ended.stderr
    assert target.read_text() == "kept"


def test_a_signal_waits_for_the_end_and_the_handlers_return() -> None:
    came = []
    old = signal.signal(signal.SIGTERM, lambda number, frame: came.append(number))
    try:
        before = {number: signal.getsignal(number) for number in (signal.SIGTERM, signal.SIGINT)}
        with signals_held():
            signal.raise_signal(signal.SIGTERM)
            assert not came
        assert came == [signal.SIGTERM]
        with pytest.raises(KeyboardInterrupt):
            _fail_interrupted()
        assert {number: signal.getsignal(number) for number in before} == before
    finally:
        signal.signal(signal.SIGTERM, old)


def _fail_interrupted() -> None:
    with signals_held():
        signal.raise_signal(signal.SIGINT)
        raise ImportError


def test_another_thread_holds_nothing() -> None:
    seen = []

    def work() -> None:
        with signals_held():
            seen.append(signal.getsignal(signal.SIGINT))

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert seen == [signal.getsignal(signal.SIGINT)]


#: The signal comes while the commands are still being loaded.
AT_THE_START = """
import os, signal, sys

signal.signal(signal.SIGINT, signal.default_int_handler)

class Interrupting:
    sent = False

    def find_spec(self, name, path=None, target=None):
        if name == "typer" and not self.sent:
            self.sent = True
            os.kill(os.getpid(), signal.SIGINT)

sys.meta_path.insert(0, Interrupting())
from pdtheory.__main__ import run
run()
"""


def test_a_command_that_is_still_being_loaded_ends_with_a_sentence() -> None:
    done = subprocess.run(
        [sys.executable, "-c", AT_THE_START, "--version"], capture_output=True, text=True
    )
    assert done.returncode == 130
    assert done.stderr == "pdtheory: interrupted; nothing was left half-written.\n"
