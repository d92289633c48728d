"""Make figures: compute, check, draw, and write down what was done."""

from __future__ import annotations

import json
import platform
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from pdtheory import __version__
from pdtheory.atomic import atomic_path
from pdtheory.errors import FileAccessError
from pdtheory.paper.figures import catalogue
from pdtheory.paper.figures.models import find
from pdtheory.paper.figures.outcome import Figure, Job, Outcome

_LIBRARIES = ("numpy", "scipy", "numba", "sympy", "python-flint", "trimesh", "matplotlib", "bpy")


@dataclass(frozen=True)
class Made:
    """One figure that was made, or the reason why it was not.

    Attributes
    ----------
    figure : Figure
        The figure.
    outcome : Outcome or None
        What it computed; None if it was skipped.
    pictures : list of Path
        What was drawn, the main picture first.
    skipped : str
        Why it was skipped; empty otherwise.
    seconds : float
        How long it took.
    """

    figure: Figure
    outcome: Outcome | None = None
    pictures: list[Path] = field(default_factory=list)
    skipped: str = ""
    seconds: float = 0.0

    @property
    def holds(self) -> bool:
        """Whether every check holds; a skipped figure has none."""
        return self.outcome is None or self.outcome.holds


def make(
    names: Iterable[str], job: Job, folder: Path, *, data_only: bool = False
) -> Iterator[Made]:
    """Make figures one by one.

    Parameters
    ----------
    names
        Names of figures.
    job
        How they are made.
    folder
        Where pictures and numbers go, ``NAME.json`` and ``NAME.png``; made if needed.
    data_only
        Whether to stop before the drawing.

    Yields
    ------
    Made
        Each figure as soon as it is done. A figure whose scan is absent is skipped.

    Raises
    ------
    InputError
        If there is no figure of one of the names.
    FileAccessError
        If the folder cannot be made or written to.
    """
    figures = [catalogue.get(name) for name in names]
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileAccessError(f"cannot make the folder {folder}: {error.strerror}.") from error
    for figure in figures:
        start = time.perf_counter()
        try:
            for scans in figure.models:
                find(*scans, folder=job.models)
        except FileAccessError as error:
            yield Made(figure, skipped=str(error))
            continue
        outcome = figure.compute(job)
        pictures = [] if data_only else figure.draw(job, outcome, folder)
        _write_numbers(figure, outcome, job, folder)
        yield Made(figure, outcome, pictures, seconds=time.perf_counter() - start)


def record(figure: Figure, outcome: Outcome, job: Job) -> dict[str, Any]:
    """Return what is written down about a figure; equal runs give equal records."""
    return {
        "figure": figure.name,
        "redraws": figure.redraws,
        "quality": job.quality,
        "holds": outcome.holds,
        "checks": [
            {
                "statement": check.statement,
                "value": check.value,
                "range": [_finite(check.low), _finite(check.high)],
                "because": check.because,
                "holds": check.holds,
            }
            for check in outcome.checks
        ],
        "parameters": outcome.parameters,
        "numbers": outcome.numbers,
    }


def versions() -> dict[str, str]:
    """Return the versions that the numbers were made with."""
    found = {"pdtheory": __version__, "python": platform.python_version()}
    for name in _LIBRARIES:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            continue
    return found


def _write_numbers(figure: Figure, outcome: Outcome, job: Job, folder: Path) -> None:
    with atomic_path(folder / f"{figure.name}.json") as temporary:
        text = json.dumps(record(figure, outcome, job), indent=1, default=float)
        temporary.write_text(text + "\n", encoding="utf-8")


def _finite(value: float) -> float | None:
    return None if value in (float("inf"), float("-inf")) else value
