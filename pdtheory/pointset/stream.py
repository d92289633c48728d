"""Estimation of any number of points straight to a folder, in chunks, to be resumed at will.

The folder holds ``plan.json`` (what was asked for, and a digest of points and options) and one
``part-000000.npz`` (a direction field) for every block of queries in visiting order, with the
numbers of these queries in ``part-000000.index.npy``. A part is written whole or not at
all, so after an interruption the parts that exist are complete, and a new run with the same input
computes the others to the same bits.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from pdtheory.atomic import atomic_path
from pdtheory.conventions import DEFAULT_DEGREE
from pdtheory.errors import FileAccessError, FileFormatError, InputError
from pdtheory.pointset.assemble import Collector
from pdtheory.pointset.cloud import IntArray, PointCloud
from pdtheory.pointset.engine import Engine
from pdtheory.pointset.estimate import CHUNK, PREPARING, Orient, check_orders, make_engine
from pdtheory.pointset.field import DirectionField
from pdtheory.pointset.intake import take_in
from pdtheory.pointset.pool import Progress, run_chunks, thread_count

#: Version of the layout of the folder.
SCHEMA = 1
#: Queries in one part.
PART = 65_536


def estimate_to_disk(
    points: npt.ArrayLike | PointCloud,
    folder: str | os.PathLike[str],
    *,
    resume: bool = False,
    radius: float | None = None,
    neighbours: int | None = None,
    radius_relative: float | None = None,
    degree: int = DEFAULT_DEGREE,
    orders: Sequence[int] = (2, 3),
    norm: Literal["l2", "l1"] = "l2",
    normals: npt.ArrayLike | None = None,
    queries: npt.ArrayLike | None = None,
    orient: Orient | npt.ArrayLike = "auto",
    frame: Literal["tangent", "principal", "given"] = "tangent",
    weight_distance: Literal["3d", "planar"] = "3d",
    uncertainty: bool = True,
    non_finite: Literal["refuse", "drop"] = "refuse",
    threads: int | None = None,
    progress: Progress | None = None,
) -> int:
    """Estimate directions into a folder instead of memory.

    Parameters
    ----------
    folder
        Where the parts go; created if its parent exists.
    resume : bool
        Go on with a folder that an earlier run with the same input left; without it the folder must
        not hold a run.
    points, radius, neighbours, radius_relative, degree, orders, norm, normals, queries, orient, \
frame, weight_distance, uncertainty, non_finite, threads, progress
        As for :func:`pdtheory.pointset.estimate_directions`.

    Returns
    -------
    int
        Number of parts in the folder.

    Raises
    ------
    InputError
        If the input cannot be used, or the folder holds a run of other input.
    FileAccessError
        If the folder cannot be written to.
    Cancelled
        If `progress` raised it; the parts written so far stay.
    """
    wanted = check_orders(orders, degree)
    intake = take_in(points, normals, queries, non_finite, orient)
    engine = make_engine(
        intake,
        radius=radius,
        neighbours=neighbours,
        radius_relative=radius_relative,
        degree=degree,
        orders=wanted,
        norm=norm,
        frame=frame,
        weight_distance=weight_distance,
        uncertainty=uncertainty,
    )
    total = len(intake.places)
    parts = -(-total // PART)
    plan = {
        "schema": SCHEMA,
        "queries": total,
        "parts": parts,
        "degree": int(degree),
        "orders": [int(order) for order in wanted],
        "input": _digest(engine),
    }
    place = _open_folder(Path(folder), plan, resume)
    missing = [i for i in range(parts) if not _part(place, i).exists()]
    if progress is not None:
        progress(1.0 - len(missing) / max(parts, 1), PREPARING)
    engine.warm_up()
    workers = thread_count(threads)
    for done, number in enumerate(missing):
        first, last = number * PART, min((number + 1) * PART, total)
        where = engine.visit[first:last]
        collector = Collector(intake.places[where], int(degree), wanted)
        before = parts - len(missing) + done

        def report(fraction: float, text: str, before: int = before) -> None:
            if progress is not None:
                progress((before + fraction) / parts, text)

        def work(start: int, stop: int, flag: Any, first: int = first) -> Any:
            return engine.work(first + start, first + stop, flag)

        chunks = run_chunks(work, last - first, CHUNK, workers, report, "estimating directions")
        for start, stop, (radii, output) in chunks:
            collector.add(np.arange(start, stop), radii, output, engine.rows(stop - start))
        _write_part(place, number, collector.field(), where)
    return parts


def load_parts(
    folder: str | os.PathLike[str],
) -> Iterator[tuple[IntArray, DirectionField]]:
    """Yield the parts of a finished run: the numbers of their queries, and the field at these.

    Raises
    ------
    FileAccessError
        If there is no such folder.
    FileFormatError
        If it is not a run, or parts are missing.
    """
    place = Path(folder)
    plan = _read_plan(place)
    if plan is None:
        raise FileAccessError(f"{place} holds no run: there is no plan.json in it.")
    for number in range(int(plan["parts"])):
        path = _part(place, number)
        if not path.exists():
            raise FileFormatError(
                f"{place} is unfinished: {path.name} is missing; run again with resume."
            )
        yield np.load(_index(place, number), allow_pickle=False), DirectionField.load(path)


def _part(folder: Path, number: int) -> Path:
    return folder / f"part-{number:06d}.npz"


def _index(folder: Path, number: int) -> Path:
    return folder / f"part-{number:06d}.index.npy"


def _read_plan(folder: Path) -> dict[str, Any] | None:
    path = folder / "plan.json"
    if not path.exists():
        return None
    try:
        plan = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise FileFormatError(f"{path} cannot be read ({error}).") from error
    if not isinstance(plan, dict) or plan.get("schema") != SCHEMA:
        raise FileFormatError(f"{path} is not the plan of a run of this version.")
    return plan


def _open_folder(folder: Path, plan: dict[str, Any], resume: bool) -> Path:
    """Create the folder with its plan, or check that it belongs to the same run."""
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise FileAccessError(f"cannot create {folder}: {error.strerror}.") from error
    old = _read_plan(folder)
    if old is None:
        with atomic_path(folder / "plan.json") as temporary:
            temporary.write_text(json.dumps(plan, indent=1), encoding="utf-8")
    elif not resume:
        raise InputError(
            f"{folder} holds a run already; pass resume to go on with it, or give another folder."
        )
    elif old != plan:
        changed = ", ".join(key for key in plan if old.get(key) != plan[key])
        raise InputError(
            f"{folder} holds a run of other input ({changed} differ); give another folder."
        )
    return folder


def _digest(engine: Engine) -> str:
    """Return a digest of everything that the result depends on."""
    digest = hashlib.sha256()
    for array in (engine.points, engine.queries, engine.references, engine.orders):
        digest.update(repr((array.shape, array.dtype.str)).encode())
        digest.update(np.ascontiguousarray(array).data)
    digest.update(repr((tuple(engine.choice), tuple(engine.settings), PART)).encode())
    return digest.hexdigest()


def _write_part(folder: Path, number: int, field: DirectionField, where: IntArray) -> None:
    """Write the numbers of the queries, then the field, whose file says that the part is done."""
    with atomic_path(_index(folder, number)) as temporary, temporary.open("wb") as stream:
        np.save(stream, where)
    field.save(_part(folder, number))
