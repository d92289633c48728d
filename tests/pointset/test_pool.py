"""Chunks of work: all points, each once, small ones at the end, and of bounded memory."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest

from pdtheory.pointset import estimate_directions, pool
from pdtheory.pointset.pool import CHUNK, chunk_size, shrinking_spans
from tests.pointset.surfaces import torus


@pytest.mark.parametrize("threads", [1, 2, 16])
@pytest.mark.parametrize("count", [0, 1, 127, 128, 5_000, 100_001])
def test_shrinking_chunks_follow_one_another_and_end_small(count, threads):
    chunks = shrinking_spans(3, 3 + count, threads, CHUNK)
    assert [start for start, _ in chunks] == [3, *(stop for _, stop in chunks)][: len(chunks)]
    assert sum(stop - start for start, stop in chunks) == count
    sizes = [stop - start for start, stop in chunks]
    assert sizes == sorted(sizes, reverse=True)
    assert all(0 < size <= 2048 for size in sizes)
    if count > 256:
        assert sizes[-1] <= 128
        # No thread is left with more than half of its share when the others run out.
        assert sizes[0] <= max(128, count / (2 * threads))


@pytest.mark.parametrize("neighbours", [None, 3, 264, 1_000, 20_000, 100_000, 10**7])
def test_chunks_with_many_neighbours_are_smaller(neighbours):
    most = chunk_size(neighbours)
    assert 1 <= most <= CHUNK
    if neighbours in (None, 3, 264):
        assert most == CHUNK
    else:
        assert most == 1 or most * neighbours <= 2**20
    for threads in (1, 16):
        chunks = shrinking_spans(0, 5_000, threads, most)
        assert all(0 < stop - start <= most for start, stop in chunks)
        assert sum(stop - start for start, stop in chunks) == 5_000


def test_many_neighbours_need_little_memory_and_change_no_bit(monkeypatch):
    points = torus(6000, 1.0, 0.4, 3)[0]
    how = {"neighbours": 2000, "degree": 2, "orders": (2,), "queries": np.arange(4100)}

    def peak():
        tracemalloc.start()
        try:
            field = estimate_directions(points, threads=1, **how)
            return field, tracemalloc.get_traced_memory()[1]
        finally:
            tracemalloc.stop()

    estimate_directions(points, threads=1, **(how | {"queries": np.arange(9)}))
    small, low = peak()
    monkeypatch.setattr(pool, "_LISTED", 2**40)
    large, high = peak()
    # Numbers and distances of 2,000 neighbours of 2,048 queries are 66 MB.
    assert high > 65e6
    assert low < 30e6
    np.testing.assert_array_equal(small.phi, large.phi)
    np.testing.assert_array_equal(small[2].angle, large[2].angle)
