"""What compiling the kernels asks of Numba, and leaves behind in it."""

from __future__ import annotations

import operator
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
