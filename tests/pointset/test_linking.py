"""What compiling the kernels asks of Numba, and leaves behind in it."""

from __future__ import annotations

import gc
import operator
import os
import subprocess
import sys
from types import SimpleNamespace
from typing import Any

import numba
import numpy as np
import pytest
from numba.core.compiler import DefaultPassBuilder
from numba.core.errors import TypingError
from numba.core.registry import cpu_target

from pdtheory.pointset.kernels.jit import _compile, inner
from pdtheory.pointset.kernels.linking import NEEDLESS, Whole, compile_as

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


def test_what_is_left_out_are_passes_of_numba():
    """A pass with another name would come back without a word."""
    flags = SimpleNamespace(
        no_rewrites=False, enable_ssa=True, auto_parallel=SimpleNamespace(enabled=False)
    )
    state = SimpleNamespace(func_ir=None, flags=flags)
    passes = DefaultPassBuilder.define_nopython_pipeline(state).passes
    assert {one._name for one, _ in passes} >= NEEDLESS


def test_kernels_count_no_references():
    def take_first(values: Any) -> float:
        own = values
        return own[0]

    # What comes from a cache cannot be looked at.
    first = compile_as(Whole, _compile(take_first, cache=False))
    values = np.array([2.5, 3.5])
    assert first(values) == 2.5
    (code,) = first.inspect_llvm().values()
    assert "NRT_incref" not in code
    before = sys.getrefcount(values)
    first(values)
    assert sys.getrefcount(values) == before


def test_garbage_is_collected_after_compiling_and_not_before():
    seen = []

    def note(phase: str, _: Any) -> None:
        seen.append(phase)

    @inner
    def cube(x: float) -> float:
        return x * x * x

    def sum_up(x: float) -> float:
        total = 0.0
        for i in range(3):
            for j in range(3):
                total += cube(x + i) * cube(x - j)
        return total

    run = compile_as(Whole, _compile(sum_up, cache=False))

    thresholds = gc.get_threshold()
    gc.callbacks.append(note)
    try:
        gc.set_threshold(5000)
        run.compile((numba.float64,))
        during = len(seen)
        assert gc.isenabled()
    finally:
        gc.set_threshold(*thresholds)
        gc.callbacks.remove(note)
    assert during <= 2
    assert gc.get_freeze_count() == 0
    gc.disable()
    try:
        run.compile((numba.int64,))
        assert not gc.isenabled()
    finally:
        gc.enable()
    # Objects that somebody else keeps from being looked through stay so.
    gc.freeze()
    try:
        run.compile((numba.float32,))
        assert gc.get_freeze_count() > 0
    finally:
        gc.unfreeze()


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


@pytest.mark.slow
@pytest.mark.parametrize("asked", [{"NUMBA_CPU_NAME": "generic"}, {"NUMBA_ENABLE_AVX": "0"}])
def test_a_lesser_processor_can_be_asked_for(tmp_path, asked):
    script = """
import numpy as np

from pdtheory.pointset import estimate_directions
from pdtheory.pointset.kernels.lanes import LANES

xy = np.random.default_rng(0).uniform(-1, 1, (500, 2))
points = np.column_stack([xy, xy[:, 0] ** 2 - xy[:, 1] ** 2])
field = estimate_directions(points, radius=0.8, orient="none", queries=[[0, 0, 0]], degree=4)
print(LANES, *np.sort(field[2].eigenvalue).round(9))
"""
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path), **asked}
    done = subprocess.run(
        [sys.executable, "-c", script], env=environment, capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == ["4", "-2.0", "-2.0", "2.0", "2.0"]
