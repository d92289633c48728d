"""Chunks of work: all points, each once, and small ones at the end."""

from __future__ import annotations

import pytest

from pdtheory.pointset.pool import shrinking_spans


@pytest.mark.parametrize("threads", [1, 2, 16])
@pytest.mark.parametrize("count", [0, 1, 127, 128, 5_000, 100_001])
def test_shrinking_chunks_follow_one_another_and_end_small(count, threads):
    chunks = shrinking_spans(3, 3 + count, threads)
    assert [start for start, _ in chunks] == [3, *(stop for _, stop in chunks)][: len(chunks)]
    assert sum(stop - start for start, stop in chunks) == count
    sizes = [stop - start for start, stop in chunks]
    assert sizes == sorted(sizes, reverse=True)
    assert all(0 < size <= 2048 for size in sizes)
    if count > 256:
        assert sizes[-1] <= 128
        # No thread is left with more than half of its share when the others run out.
        assert sizes[0] <= max(128, count / (2 * threads))
