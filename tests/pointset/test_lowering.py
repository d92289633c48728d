"""Kernels do what the same functions do in Python."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from pdtheory.pointset.kernels.jit import _compile
from pdtheory.pointset.kernels.linking import Whole, compile_as

RECORD = np.dtype([("side", np.float64, (2, 3)), ("long", np.float64, (7,)), ("n", np.int64, (4,))])


def compiled(function: Any) -> Any:
    return compile_as(Whole, _compile(function, cache=False))


def count_through(start: int, stop: int, step: int, out: Any) -> int:
    rounds = 0
    for i in range(start, stop, step):
        out[rounds] = i
        rounds += 1
    return rounds


@pytest.mark.parametrize("step", [-3, -2, -1, 1, 2, 3])
def test_ranges_have_the_numbers_that_they_have_in_python(step):
    count = compiled(count_through)
    out = np.zeros(40)
    for start in range(-7, 8):
        for stop in range(-7, 8):
            wanted = list(range(start, stop, step))
            assert count(start, stop, step, out) == len(wanted)
            assert out[: len(wanted)].tolist() == wanted


def mix(w: Any, whole: Any, numbers: Any, flags: Any, row: int) -> float:
    total = 0.0
    for j in range(3):
        w.side[row, j] = whole[j, 1] - 2 * whole[0, j]
        w.side[0, 2] += numbers[j] + numbers[3]
        total += w.side[1, j] * whole[row, 2]
    for k in range(len(w.long)):
        w.long[k] = k * total
        if flags[k % 2]:
            w.n[k % 4] = k
    w.n[1] += 3
    return total + w.long[6] + w.n[2]


def test_entries_of_arrays_and_records_are_those_of_python():
    rng = np.random.default_rng(3)
    run = compiled(mix)
    for row in range(2):
        own, other = np.zeros(1, RECORD), np.zeros(1, RECORD)
        whole, numbers = rng.normal(size=(4, 5)), rng.integers(-9, 9, 6)
        flags = np.array([True, False])
        wanted = mix(own.view(np.recarray)[0], whole, numbers, flags, row)
        assert run(other[0], whole, numbers, flags, row) == pytest.approx(wanted, rel=1e-14)
        for name in RECORD.names:
            np.testing.assert_allclose(other[name], own[name], rtol=1e-14)


def test_what_is_not_plain_is_left_to_numba():
    def take(whole: Any, column: Any, number: Any) -> Any:
        return whole[2:][0, 1] + column[3] + number[1].real + whole[:, 2].sum()

    whole = np.arange(20.0).reshape(5, 4)
    values = np.array([1 + 2j, 3 + 4j])
    assert compiled(take)(whole.T, whole[:, 1], values) == take(whole.T, whole[:, 1], values)
