"""Estimation of any number of points straight to a folder, in parts, to be resumed at will."""

from __future__ import annotations

import hashlib
import os
import threading
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any, Unpack

import numpy as np
import numpy.typing as npt

from pdtheory.errors import InputError
from pdtheory.pointset.assemble import Collector
from pdtheory.pointset.cloud import IntArray, PointCloud
from pdtheory.pointset.estimate import PREPARING, refuse_nothing
from pdtheory.pointset.options import Options, shows_options_of
from pdtheory.pointset.parts import discard_run, load_column, open_folder, part_path, write_part
from pdtheory.pointset.pool import Flag, chunk_size, run_spans, shrinking_spans, spans
from pdtheory.pointset.prepare import Run, prepare

#: Queries in one part.
PART = 16_384


@shows_options_of(prepare)
def estimate_to_disk(
    points: npt.ArrayLike | PointCloud,
    folder: str | os.PathLike[str],
    *,
    resume: bool = False,
    **options: Unpack[Options],
) -> int:
    """Estimate directions into a folder instead of memory.

    The folder is that of docs/formats.md. Parts are written while the next ones are computed, and
    memory does not grow with what is written.

    Parameters
    ----------
    points, **options
        As for :func:`pdtheory.pointset.estimate_directions`.
    folder
        Where the parts go; created if its parent exists.
    resume : bool
        Go on with a folder that an earlier run with the same input left, to the same bits; without
        it the folder must not hold a run. An empty or new folder is no obstacle.

    Returns
    -------
    int
        Number of parts in the folder.

    Raises
    ------
    InputError
        If the input cannot be used, the folder holds a run of other input, or no query has enough
        neighbours; then the folder is left as if there had been no run.
    FileAccessError
        If the folder cannot be written to.
    Cancelled
        If `progress` raised it; the parts written so far stay.
    """
    run = prepare(points, **options)
    place = Path(folder)
    # Without queries there is one part without points, which says what the field would hold.
    blocks = spans(0, len(run.places), PART) or [(0, 0)]
    plan = {
        "queries": len(run.places),
        "parts": len(blocks),
        "degree": run.degree,
        "orders": [int(order) for order in run.orders],
        "input": _digest(run),
    }
    created = open_folder(place, plan, resume)
    missing = [i for i in range(len(blocks)) if not part_path(place, i).exists()]
    before = 1.0 - len(missing) / max(len(blocks), 1)
    if run.progress is not None:
        run.progress(before, PREPARING if missing else "every part is there")
    if missing:
        run.engine.warm_up()

    def report(fraction: float, text: str) -> None:
        if run.progress is not None:
            run.progress(before + fraction * (1.0 - before), text)

    writer = ThreadPoolExecutor(1, thread_name_prefix="pdtheory-writer")
    writing: Future[None] | None = None
    try:
        for number, where, collector in _computed(run, blocks, missing, report):
            if writing is not None:
                writing.result()
            writing = writer.submit(_write, place, number, where, collector)
        if writing is not None:
            writing.result()
    finally:
        writer.shutdown(wait=True, cancel_futures=True)
    try:
        refuse_nothing(load_column(place, "status"), load_column(place, "neighbours"), run.engine)
    except InputError:
        discard_run(place, created=created)
        raise
    return len(blocks)


def _computed(
    run: Run, blocks: list[tuple[int, int]], missing: list[int], report: Any
) -> Iterator[tuple[int, IntArray, Collector]]:
    """Yield number, queries and results of each missing part as soon as all its chunks are done."""
    engine = run.engine
    most = chunk_size(engine.choice.neighbours)
    owner: dict[tuple[int, int], int] = {}
    lock = threading.Lock()
    left: dict[int, int] = {}
    for number in missing:
        chunks = spans(*blocks[number], most)
        if number == missing[-1]:
            chunks = shrinking_spans(*blocks[number], run.threads, most)
        if not chunks:
            yield number, engine.visit, Collector(engine, run.places, run.degree)
        owner |= dict.fromkeys(chunks, number)
        left[number] = len(chunks)
    open_parts: dict[int, Collector] = {}

    def work(start: int, stop: int, flag: Flag) -> None:
        number = owner[start, stop]
        first, last = blocks[number]
        with lock:
            if number not in open_parts:
                places = run.places[engine.visit[first:last]]
                open_parts[number] = Collector(engine, places, run.degree)
        slots = np.arange(start - first, stop - first)
        open_parts[number].compute(engine.visit[start:stop], flag, slots)

    for span in run_spans(work, list(owner), run.threads, report, "estimating directions"):
        number = owner[span]
        left[number] -= 1
        if not left[number]:
            yield number, engine.visit[slice(*blocks[number])], open_parts.pop(number)


def _write(folder: Path, number: int, where: IntArray, collector: Collector) -> None:
    write_part(folder, number, collector.field(), where)


def _digest(run: Run) -> str:
    """Return a digest of everything that the result depends on."""
    engine = run.engine
    digest = hashlib.sha256()
    for array in (engine.points, engine.queries, engine.references, engine.orders):
        digest.update(repr((array.shape, array.dtype.str)).encode())
        digest.update(np.ascontiguousarray(array).data)
    digest.update(repr((run.asked, PART)).encode())
    return digest.hexdigest()
