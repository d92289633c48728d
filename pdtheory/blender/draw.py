"""A direction field as a picture or a Blender file, drawn by Blender in a process of its own.

Blender as a module cannot be interrupted while it renders, writes to the terminal, keeps its memory
and may fall over at the end of a process. Apart, none of that reaches the caller.
"""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO, Final, cast

import numpy as np

from pdtheory.atomic import atomic_path
from pdtheory.drawing.choice import CERTAIN, Choice, check_choice, check_size, refuse_empty
from pdtheory.drawing.view import View, natural_view, on_fitted_surface
from pdtheory.errors import ComputationError, InputError
from pdtheory.pointset.cloud import PointCloud
from pdtheory.pointset.field import DirectionField

Progress = Callable[[float, str], None]

SUFFIXES: Final = (".png", ".blend")


@dataclass(frozen=True)
class DrawingJob:
    """All that the drawing process needs to know.

    Attributes
    ----------
    field : DirectionField
        The directions.
    cloud : PointCloud or None
        The surface below them; its faces if it has some, else its points; None for the points of
        the field.
    target : str
        The file to write, PNG or .blend by its suffix.
    choice : Choice
        What to draw of the field.
    view : View
        Where the camera stands.
    size : (int, int)
        Width and height of the picture in pixels.
    rays : int
        Rays for each pixel.
    """

    field: DirectionField
    cloud: PointCloud | None
    target: str
    choice: Choice
    view: View
    size: tuple[int, int]
    rays: int


def draw_field(
    field: DirectionField,
    cloud: PointCloud | None,
    output: str | os.PathLike[str],
    *,
    orders: Iterable[int] | None = None,
    kind: str = "max",
    strokes: int = 800,
    least_strength: float = 0.0,
    largest_uncertainty: float = CERTAIN,
    up: str | None = None,
    azimuth: float | None = None,
    elevation: float | None = None,
    size: tuple[int, int] = (1200, 900),
    rays: int = 12,
    progress: Progress | None = None,
) -> None:
    """Draw directions on their surface with Blender, as a picture on white or as a Blender file.

    Of a dense field an even selection of points carries strokes; where several orders are drawn
    the points are dealt to them in turn. In a .blend all of it can still be changed in the
    modifier.

    Parameters
    ----------
    field
        The directions.
    cloud
        The surface they lie on, if it is known; otherwise the points of the field are drawn, each
        where its fit puts the surface.
    output
        The file to write: ``.png`` or ``.blend``.
    orders
        Orders to draw; all of the field by default.
    kind
        ``max``, ``min`` or ``both``; minima are thinner where both are drawn.
    strokes
        About how many points carry strokes.
    least_strength
        Weaker directions are left out.
    largest_uncertainty
        Directions whose standard deviation is larger (radians) are left out.
    up, azimuth, elevation
        The axis of the data that points up, and the camera's place in degrees; chosen from the
        shape by default (:func:`pdtheory.drawing.view.natural_view`).
    size
        Width and height of the picture in pixels.
    rays
        Rays for each pixel.
    progress
        Called with a fraction and a text; it may raise :class:`pdtheory.errors.Cancelled`.

    Raises
    ------
    InputError
        If an argument cannot be used or there is nothing to draw.
    FileAccessError
        If the file cannot be written.
    MissingDependencyError
        If Blender's Python module is not installed.
    ComputationError
        If Blender fails.
    """
    choice = check_choice(
        field,
        orders=orders,
        kind=kind,
        strokes=strokes,
        least_strength=least_strength,
        largest_uncertainty=largest_uncertainty,
    )
    job = _job(field, cloud, Path(output), choice, (up, azimuth, elevation), size, rays)
    with (
        atomic_path(output) as temporary,
        # Blender leaves files of its own beside the one it saves.
        tempfile.TemporaryDirectory(prefix=".", dir=temporary.parent) as folder,
    ):
        drawn = Path(folder) / job.target
        # A folder of its own: what Blender leaves behind in it, killed or not, goes with it.
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as scratch:
            _run(job, drawn, scratch, progress or (lambda fraction, text: None))
        drawn.replace(temporary)


def _job(
    field: DirectionField,
    cloud: PointCloud | None,
    output: Path,
    choice: Choice,
    place: tuple[str | None, float | None, float | None],
    size: tuple[int, int],
    rays: int,
) -> DrawingJob:
    if output.suffix.lower() not in SUFFIXES:
        raise InputError(
            f"cannot draw into {output}: the suffix {output.suffix or '(none)'} is not known; "
            f"use {' or '.join(SUFFIXES)}."
        )
    if rays < 1:
        raise InputError(f"rays is {rays}; give at least 1.")
    kinds = [int(kind) for kind in choice.kinds]
    if not any(np.isin(field[order].kind, kinds).any() for order in choice.orders):
        named = ", ".join(map(str, choice.orders)) or "(none)"
        raise InputError(
            f"the field holds no directions of order {named} to draw (kind {choice.kind})."
        )
    rows = [field[order] for order in choice.orders]
    refuse_empty(sum(choice.passes(r.kind, r.strength, r.angle_std).sum() for r in rows))
    up, azimuth, elevation = place
    field = on_fitted_surface(field) if cloud is None else field
    view = natural_view(field, cloud, up=up, azimuth=azimuth, elevation=elevation)
    return DrawingJob(field, cloud, output.name, choice, view, check_size(size), rays)


def _run(job: DrawingJob, path: Path, scratch: str, progress: Progress) -> None:
    """Let a process of its own draw `job` into `path`; it is killed if this one is interrupted.

    Its temporary files go to the folder `scratch`.
    """
    import pdtheory

    progress(0.0, "starting Blender")
    home = str(Path(pdtheory.__file__).parents[1])
    search = os.pathsep.join(filter(None, (home, os.environ.get("PYTHONPATH"))))
    worker = subprocess.Popen(
        [sys.executable, "-m", "pdtheory.blender.worker", str(path)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env={
            **os.environ,
            **dict.fromkeys(("TMPDIR", "TEMP", "TMP"), scratch),
            "PYTHONPATH": search,
        },
    )
    try:
        finished = _converse(worker, job, progress)
        # What happens while Blender tidies up does not matter any more.
        if finished:
            return
        code = worker.wait()
        raise ComputationError(
            f"Blender stopped without a picture (exit code {code}); is there enough memory?"
        )
    finally:
        worker.kill()
        worker.wait()
        for pipe in (worker.stdin, worker.stdout):
            # Closing sends what is left, which a dead process does not take.
            with suppress(OSError):
                cast(BinaryIO, pipe).close()


def _converse(worker: subprocess.Popen[bytes], job: DrawingJob, progress: Progress) -> bool:
    """Send the job, pass on what the worker reports; return whether it finished."""
    asked, told = cast(BinaryIO, worker.stdin), cast(BinaryIO, worker.stdout)
    try:
        pickle.dump(job, asked, protocol=pickle.HIGHEST_PROTOCOL)
        asked.flush()
    except OSError:
        # It ended before it listened; what it said, if anything, follows.
        pass
    while True:
        try:
            message = pickle.load(told)
        except (EOFError, pickle.UnpicklingError):
            return False
        if message is None:
            return True
        if isinstance(message, Exception):
            raise message
        progress(*message)
