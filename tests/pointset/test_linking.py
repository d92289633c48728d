"""What compiling the kernels asks of Numba, and leaves behind in it."""

from __future__ import annotations

import operator
import subprocess
import sys
from typing import Any

import numba
import pytest
from numba.core.errors import TypingError
from numba.core.registry import cpu_target

from pdtheory.pointset.kernels.jit import inner

CONTEXT = cpu_target.typing_context


def test_an_operator_is_looked_up_once(monkeypatch):
    asked = []
    find = type(CONTEXT).resolve_function_type

    def count(context: Any, function: Any, arguments: Any, keywords: Any) -> Any:
        if getattr(function, "typing_key", function) is operator.mul:
            asked.append(arguments)
        return find(context, function, arguments, keywords)

    monkeypatch.setattr(type(CONTEXT), "resolve_function_type", count)

    @inner
    def polynomial(x: float) -> float:
        return x * x * x + x * x + 2.5 * x

    @numba.njit
    def run(x: float) -> float:
        return polynomial(x)

    assert run(2.0) == 17.0
    assert len(asked) <= 1


def test_numba_is_left_as_it_was():
    @inner
    def wrong(x: float) -> float:
        return x + "one"

    @numba.njit
    def run(x: float) -> float:
        return wrong(x)

    library = cpu_target.target_context.codegen()._library_class
    with pytest.raises(TypingError):
        run(2.0)
    assert "resolve_function_type" not in vars(CONTEXT)
    assert cpu_target.target_context.codegen()._library_class is library


def test_threads_that_compile_leave_numba_as_it_was(tmp_path):
    """Some kernels are first called by several threads; other compilers work in the meantime."""
    script = """
import sys
import threading

import numba
import numpy as np
from numba.core.codegen import JITCodeLibrary
from numba.core.registry import cpu_target

from pdtheory.pointset.kernels.jit import kernel

sys.setswitchinterval(1e-5)
codegen = cpu_target.target_context.codegen()


def compile_ours():
    kernel(lambda x: x + 1.0)(2.0)


def compile_theirs():
    theirs = numba.njit(lambda x: x * 3.0)
    theirs(2.0)
    kinds.add(type(theirs.overloads[theirs.signatures[0]].library))


kinds = set()
threads = [threading.Thread(target=f) for f in 6 * [compile_ours, compile_theirs]]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
print(codegen._library_class is JITCodeLibrary, kinds == {JITCodeLibrary})
"""
    file = tmp_path / "script.py"
    file.write_text(script)
    done = subprocess.run([sys.executable, file], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["True", "True"]
