"""What the commands share: reading option values, checking targets, the progress bar."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from pdtheory.errors import FileAccessError, InputError

if TYPE_CHECKING:
    from pdtheory.pointset.field import DirectionField

#: Largest order the command line accepts; beyond it double precision carries nothing.
MAX_ORDER = 64

#: Most points of a run that a picture is drawn from; a picture shows thousands of strokes.
DRAWABLE = 200_000

Report = Callable[[float, str], None]

#: Options of every command that makes a picture.
Strokes = Annotated[int, typer.Option(help="About how many points carry strokes.", min=1)]
LeastStrength = Annotated[
    float, typer.Option(help="Leave out weaker directions; strength is |g_k| R^(k-1).", min=0.0)
]
LargestUncertainty = Annotated[
    float,
    typer.Option(help="Leave out directions less certain than this, in degrees.", min=0.0),
]
Up = Annotated[
    str | None, typer.Option(help="Axis that points up: x, y or z; by the shape if left out.")
]
Azimuth = Annotated[
    float | None, typer.Option(help="Degrees the camera goes round to the right of the front.")
]
Elevation = Annotated[
    float | None,
    typer.Option(help="Degrees the camera stands above the horizon, or below: -90 to 90."),
]


def parse_orders(text: str, *, smallest: int = 1) -> tuple[int, ...]:
    """Read orders written as ``2,3,4``, as ``2:7`` (both ends included), or mixed.

    Parameters
    ----------
    text
        The option's value.
    smallest
        The smallest order that makes sense to the caller.

    Returns
    -------
    tuple of int
        The orders, ascending and without repetition.

    Raises
    ------
    InputError
        If the text is not such a list, or an order lies outside smallest..64.
    """
    orders: set[int] = set()
    for part in text.split(","):
        first, colon, last = part.strip().partition(":")
        try:
            low = int(first)
            high = int(last) if colon else low
        except ValueError:
            raise InputError(
                f"cannot read the orders {text!r}; write them as 2,3,4 or 2:7."
            ) from None
        if not smallest <= low <= high <= MAX_ORDER:
            raise InputError(
                f"orders {part.strip()!r} are out of range; "
                f"give ascending orders between {smallest} and {MAX_ORDER}."
            )
        orders.update(range(low, high + 1))
    return tuple(sorted(orders))


def parse_size(text: str) -> tuple[int, int]:
    """Read the size of a picture written as ``1280x960``.

    Raises
    ------
    InputError
        If the text is not such a size.
    """
    width, times, height = text.lower().partition("x")
    if not times or not width.strip().isdecimal() or not height.strip().isdecimal():
        raise InputError(f"cannot read the size {text!r}; write it as 1280x960.")
    return int(width), int(height)


def check_target(path: Path, suffixes: tuple[str, ...], *inputs: Path | None) -> None:
    """Refuse an output before the work that would be lost with it.

    Parameters
    ----------
    path
        What is to be written.
    suffixes
        What it may end in.
    *inputs
        Files that are read and must not be written over, under whatever name or link.

    Raises
    ------
    InputError
        If the suffix is none of `suffixes`, or the path is one of `inputs`.
    FileAccessError
        If the folder does not exist or cannot be written to, or the path is a folder.
    """
    if path.suffix.lower() not in suffixes:
        raise InputError(
            f"cannot write {path}: the suffix {path.suffix or '(none)'} is not known; "
            f"use one of {', '.join(suffixes)}."
        )
    if path.is_dir():
        raise FileAccessError(f"cannot write {path}: it is a folder; give a file name.")
    for source in inputs:
        if source is not None and path.exists() and source.exists() and path.samefile(source):
            raise InputError(
                f"cannot write {path}: it is the input {source}, which would be lost; give another "
                "file."
            )
    folder = path.parent
    if not folder.is_dir():
        raise FileAccessError(
            f"cannot write {path}: the folder {folder} does not exist; create it first."
        )
    if not os.access(folder, os.W_OK) or (path.exists() and not os.access(path, os.W_OK)):
        raise FileAccessError(
            f"cannot write {path}: permission denied; choose a place you may write to."
        )


def refuse_given(context: typer.Context, names: tuple[str, ...], reason: str) -> None:
    """Refuse options that would be passed over, if one of them was given.

    Parameters
    ----------
    context
        The call of the command.
    names
        The options, by the names of their parameters.
    reason
        What follows the option in the sentence.

    Raises
    ------
    InputError
        If one was given.
    """
    for name in names:
        source = context.get_parameter_source(name)
        if source is not None and source.name == "COMMANDLINE":
            raise InputError(f"--{name.replace('_', '-')} {reason}")


def load_drawable(path: Path) -> DirectionField:
    """Read a field to be drawn: an NPZ file, or the folder of a run, thinned if that is large.

    Raises
    ------
    FileAccessError, FileFormatError
        If it cannot be read.
    """
    if not path.is_dir():
        from pdtheory.io.write import read_field

        return read_field(path)
    from pdtheory.pointset.parts import load_points, read_plan

    total = int(read_plan(path)["queries"])
    step = -(-total // DRAWABLE)
    return load_points(path, range(0, total, max(step, 1)))


@contextmanager
def progress_bar(title: str, *, quiet: bool = False) -> Iterator[Report]:
    """Show a progress bar on standard error and yield the callback that moves it.

    Parameters
    ----------
    title
        Text before the bar until the work reports its own.
    quiet
        If true, show nothing.
    """
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeElapsedColumn

    with Progress(
        TextColumn("{task.description:<32}"),
        BarColumn(),
        TaskProgressColumn(),
        TimeElapsedColumn(),
        console=Console(stderr=True),
        disable=quiet,
        transient=False,
    ) as progress:
        task = progress.add_task(title, total=1.0)

        def report(fraction: float, text: str) -> None:
            progress.update(task, completed=fraction, description=text or title)

        try:
            yield report
        except BaseException:
            # An error speaks for itself; a bar that stopped halfway would only surround it, and an
            # empty line would follow where this is no terminal.
            progress.live.transient = True
            progress.live.stop()
            progress.disable = True
            raise
        progress.update(task, completed=1.0)
