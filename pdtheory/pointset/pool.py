"""Chunks of work on threads, with progress, cancelling and bounded memory."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait

import numpy as np
import numpy.typing as npt

from pdtheory.errors import InputError

Progress = Callable[[float, str], None]
Flag = npt.NDArray[np.uint8]

#: Seconds between looks at the callback and at Ctrl-C while the threads work.
_PULSE = 0.1
#: Most points in a chunk, since handing one out takes up to a millisecond of Python, and fewest
#: where many small ones let all threads end together.
CHUNK, _FEWEST = 2048, 128
#: Most neighbours that are listed at a time: 16 MB a thread, with their distances.
_LISTED = 2**20


def thread_count(threads: int | None) -> int:
    """Return the number of threads to use; None means the cores that this process may use."""
    if threads is None:
        try:
            return max(1, len(os.sched_getaffinity(0)))
        except AttributeError:  # not on this platform
            return max(1, os.cpu_count() or 1)
    if not isinstance(threads, (int, np.integer)) or isinstance(threads, bool):
        raise InputError(f"threads must be a whole number or None, not {threads!r}.")
    if threads < 1:
        raise InputError(
            f"threads is {threads}; give at least 1, or leave it out to use all cores."
        )
    return int(threads)


def chunk_size(neighbours: int | None) -> int:
    """Return the most points in a chunk: fewer where each comes with a list of many neighbours."""
    return CHUNK if neighbours is None else max(1, min(CHUNK, _LISTED // neighbours))


def spans(first: int, last: int, size: int) -> list[tuple[int, int]]:
    """Return (start, stop) of the chunks of `size` that ``range(first, last)`` falls into."""
    return [(start, min(start + size, last)) for start in range(first, last, size)]


def shrinking_spans(first: int, last: int, threads: int, most: int) -> list[tuple[int, int]]:
    """Return (start, stop) of chunks of at most `most`; small ones let all threads end together."""
    chunks = []
    while first < last:
        size = min(most, max(_FEWEST, (last - first) // (2 * threads)))
        chunks.append((first, min(first + size, last)))
        first += size
    return chunks


def run_spans(
    work: Callable[[int, int, Flag], None],
    chunks: Sequence[tuple[int, int]],
    threads: int,
    progress: Progress | None,
    text: str,
) -> Iterator[tuple[int, int]]:
    """Call work(start, stop, flag) for all chunks; yield (start, stop) of each as it finishes.

    At most three chunks for each thread are under way or waiting to be taken. If the consumer
    stops, the callback raises, or Ctrl-C is pressed, `flag[0]` becomes 1; the work must look at it
    often.

    Parameters
    ----------
    work
        Called in a thread.
    chunks
        Start and stop of each chunk.
    threads
        Number of threads.
    progress
        Called in this thread with the fraction done and `text`.
    text
        What is being done.
    """
    flag: Flag = np.zeros(1, np.uint8)
    total = sum(stop - start for start, stop in chunks)
    waiting = iter(chunks)
    pending: dict[Future[None], tuple[int, int]] = {}
    done = 0
    pool = ThreadPoolExecutor(threads, thread_name_prefix="pdtheory")
    try:
        while True:
            while len(pending) < 3 * threads and (span := next(waiting, None)) is not None:
                pending[pool.submit(work, *span, flag)] = span
            if not pending:
                break
            finished, _ = wait(pending, timeout=_PULSE, return_when=FIRST_COMPLETED)
            for future in finished:
                start, stop = pending.pop(future)
                done += stop - start
                future.result()
                yield start, stop
            if progress is not None:
                progress(done / total, text)
    finally:
        flag[0] = 1
        pool.shutdown(wait=True, cancel_futures=True)
