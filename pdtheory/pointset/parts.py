"""The folder of a run whose results go to disk (docs/formats.md).

It holds ``plan.json`` - what was asked for, with a digest of points and options - and a direction
field ``part-000000.npz`` for every block of queries in visiting order, each with the numbers of its
queries. A part is written whole or not at all, so after an interruption those that exist are
complete.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from pdtheory.atomic import atomic_path
from pdtheory.errors import FileAccessError, FileFormatError, InputError
from pdtheory.pointset.cloud import IntArray
from pdtheory.pointset.directions import ROW_ARRAYS, OrderDirections
from pdtheory.pointset.field import NOT_BY_POINT, DirectionField
from pdtheory.pointset.npz import read_array, save_npz

#: Version of the layout of the folder.
SCHEMA = 1
_PLAN = "plan.json"


def part_path(folder: Path, number: int) -> Path:
    """Return the file of one part."""
    return folder / f"part-{number:06d}.npz"


def write_part(folder: Path, number: int, field: DirectionField, where: IntArray) -> None:
    """Write the field at the queries `where` as one part.

    Raises
    ------
    FileAccessError
        If it cannot be written.
    """
    save_npz(field, part_path(folder, number), query=where)


def holds_run(folder: Path) -> bool:
    """Return whether a folder holds a run, finished or not."""
    return (folder / _PLAN).exists()


def check_parent(folder: Path) -> None:
    """Refuse a folder that cannot be made because there is no folder to hold it.

    Raises
    ------
    FileAccessError
        If so.
    """
    if not folder.parent.is_dir():
        raise FileAccessError(
            f"cannot create {folder}: the folder {folder.parent} does not exist; create it first."
        )


def open_folder(folder: Path, plan: dict[str, Any], resume: bool) -> bool:
    """Create the folder with its plan, or check that it belongs to the same run.

    Returns
    -------
    bool
        Whether the folder was created.

    Raises
    ------
    InputError
        If it holds another run, or this one and `resume` is false.
    FileAccessError
        If it cannot be made.
    """
    check_parent(folder)
    created = not folder.exists()
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise FileAccessError(
            f"cannot create {folder}: {error.strerror}; choose another place."
        ) from error
    plan = {"schema": SCHEMA} | plan
    if not holds_run(folder):
        with atomic_path(folder / _PLAN) as temporary:
            temporary.write_text(json.dumps(plan, indent=1) + "\n", encoding="utf-8")
        return created
    old = read_plan(folder)
    if not resume:
        raise InputError(
            f"{folder} holds a run already; resume it (--resume on the command line), or give "
            "another folder."
        )
    if old != plan:
        changed = ", ".join(key for key in plan if old.get(key) != plan[key])
        raise InputError(
            f"{folder} holds a run of other input ({changed} differ); give another folder."
        )
    for left in folder.glob(".part-*.npz"):
        # What a run that was killed was writing.
        left.unlink(missing_ok=True)
    return created


def discard_run(folder: Path, *, created: bool) -> None:
    """Take a finished run out of its folder, so that the folder can take another.

    Parameters
    ----------
    folder
        The folder.
    created
        Whether it was made for the run; then it goes too.

    Raises
    ------
    FileAccessError, FileFormatError
        If it holds no finished run, or it cannot be removed.
    """
    try:
        # The plan goes last: parts without one would be taken for parts of the next run.
        for path in (*_finished(folder), folder / _PLAN):
            path.unlink()
        if created:
            # Unless somebody has put something into it.
            with suppress(OSError):
                folder.rmdir()
    except (FileAccessError, FileFormatError):
        raise
    except OSError as error:
        raise FileAccessError(f"cannot empty {folder}: {error.strerror}.") from error


def read_plan(folder: str | os.PathLike[str]) -> dict[str, Any]:
    """Return the plan of a run.

    Raises
    ------
    FileAccessError
        If the folder holds no run.
    FileFormatError
        If the plan cannot be understood.
    """
    path = Path(folder) / _PLAN
    if not path.exists():
        raise FileAccessError(f"{folder} holds no run: there is no {_PLAN} in it.")
    try:
        plan = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise FileFormatError(f"{path} cannot be read ({error}).") from error
    if not isinstance(plan, dict) or plan.get("schema") != SCHEMA:
        raise FileFormatError(f"{path} is not the plan of a run of this version.")
    return plan


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
    for path in _finished(folder):
        yield read_array(path, "query"), DirectionField.load(path)


def load_column(folder: str | os.PathLike[str], name: str) -> npt.NDArray[Any]:
    """Return one array of the field, such as ``status``, at all queries of a finished run.

    Raises
    ------
    FileAccessError, FileFormatError
        As for :func:`load_parts`, or if there is no such array.
    """
    paths = _finished(folder)
    where = np.concatenate([read_array(path, "query") for path in paths])
    values = np.concatenate([read_array(path, name) for path in paths])
    return values[np.argsort(where)]


def load_rows(
    folder: str | os.PathLike[str], order: int, name: str, share: float = 1.0
) -> npt.NDArray[Any]:
    """Return one array of the directions of an order, such as ``strength``, of a finished run.

    Parameters
    ----------
    folder
        The folder of the run.
    order
        The order.
    name
        The array.
    share
        Part of the directions to take, drawn at random; all from 1 upwards.

    Raises
    ------
    FileAccessError, FileFormatError
        As for :func:`load_parts`, or if there is no such array.
    """
    draw = np.random.default_rng(0)
    chosen = []
    for path in _finished(folder):
        rows = read_array(path, f"order{order}_{name}")
        chosen.append(rows[draw.random(len(rows)) < share])
    return np.concatenate(chosen)


def load_points(
    folder: str | os.PathLike[str], points: npt.ArrayLike | None = None
) -> DirectionField:
    """Return the field at some queries of a finished run, or at all, in memory.

    Parameters
    ----------
    folder
        The folder of the run.
    points : (Q,) int array_like, optional
        Numbers of the queries, each once. Default: all.

    Returns
    -------
    DirectionField
        The field, in the order asked for.

    Raises
    ------
    InputError
        If a number is outside the run, or something is no number of a point.
    FileAccessError, FileFormatError
        As for :func:`load_parts`.
    """
    paths = _finished(folder)
    total = int(read_plan(folder)["queries"])
    chosen = np.arange(total) if points is None else _numbers(points)
    outside = chosen[(chosen < 0) | (chosen >= total)]
    if len(outside):
        raise InputError(
            f"there is no point {outside[0]}; the run has {total} points, counted from 0."
        )
    rank = np.full(total, -1, np.int64)
    rank[chosen] = np.arange(len(chosen))
    places: list[IntArray] = []
    found: list[DirectionField] = []
    for path in paths:
        row = rank[read_array(path, "query")]
        if (row >= 0).any() or not found:
            places.append(row[row >= 0])
            found.append(DirectionField.load(path).take(row >= 0))
    return join(found).take(np.argsort(np.concatenate(places)))


def _numbers(points: npt.ArrayLike) -> IntArray:
    """Return numbers of queries as an array."""
    try:
        numbers = np.asarray(points)
        if numbers.ndim != 1 or (numbers.size and numbers.dtype.kind not in "iu"):
            raise ValueError
    except (TypeError, ValueError):
        raise InputError("points must be a list of numbers of points, such as [0, 7].") from None
    return numbers.astype(np.int64)


def join(parts: Sequence[DirectionField]) -> DirectionField:
    """Return one field of all points of several, which hold the same orders and coefficients."""
    columns = {
        entry.name: np.concatenate([getattr(part, entry.name) for part in parts])
        for entry in fields(DirectionField)
        if entry.name not in NOT_BY_POINT
    }
    directions = {}
    for order in parts[0].orders:
        rows = {
            name: np.concatenate([getattr(part[order], name) for part in parts])
            for name in (*ROW_ARRAYS, "isotropic")
        }
        counts = np.concatenate([part[order].counts for part in parts])
        offsets = np.concatenate(([0], np.cumsum(counts))).astype(np.int64)
        directions[order] = OrderDirections(order=order, offsets=offsets, **rows)
    return DirectionField(
        phi_order=parts[0].phi_order,
        phi_frequency=parts[0].phi_frequency,
        directions=directions,
        **columns,
    )


def _finished(folder: str | os.PathLike[str]) -> list[Path]:
    """Return the files of all parts."""
    place = Path(folder)
    paths = [part_path(place, number) for number in range(int(read_plan(place)["parts"]))]
    missing = [path.name for path in paths if not path.exists()]
    if missing:
        raise FileFormatError(
            f"{place} is unfinished: {missing[0]} is missing ({len(missing)} of {len(paths)} "
            "parts); resume the run (--resume on the command line)."
        )
    return paths
