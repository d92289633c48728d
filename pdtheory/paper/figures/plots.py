"""Line plots with matplotlib: one look, PNG and PDF, the same bytes for the same numbers."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Any

from pdtheory.atomic import atomic_path
from pdtheory.conventions import ORDER_COLOURS
from pdtheory.errors import MissingDependencyError

#: Without dates and versions inside, equal numbers give equal files.
_METADATA: dict[str, dict[str, Any]] = {
    ".png": {"Software": None},
    ".pdf": {"CreationDate": None, "Producer": None, "Creator": None},
}


def pyplot() -> Any:
    """Return matplotlib's pyplot on a backend without a window.

    Raises
    ------
    MissingDependencyError
        If matplotlib is not installed.
    """
    try:
        import matplotlib
    except ImportError as error:
        raise MissingDependencyError(
            "figures need matplotlib; install it with `pip install matplotlib` (extra figures)."
        ) from error
    matplotlib.use("Agg")
    # It warns that a file without a date has no date.
    logging.getLogger("fontTools").setLevel(logging.ERROR)
    import matplotlib.pyplot as plt

    plt.rcParams.update(
        {
            "font.size": 9.0,
            "axes.spines.top": False,
            "axes.spines.right": False,
            "axes.linewidth": 0.6,
            "lines.linewidth": 1.2,
            "legend.frameon": False,
            "mathtext.fontset": "cm",
            "pdf.fonttype": 42,
        }
    )
    return plt


def new_plot(width: float, height: float) -> Any:
    """Return an empty figure of so many inches."""
    return pyplot().figure(figsize=(width, height), facecolor="white")


def colour(order: int) -> tuple[float, float, float]:
    """Return the colour of an order, as in all pictures."""
    red, green, blue = ORDER_COLOURS[order]
    return red, green, blue


def save(figure: Any, target: Path, *, dots: float = 200.0, vector: bool = False) -> list[Path]:
    """Write a figure as PNG, and as PDF where it is made of lines.

    Parameters
    ----------
    figure
        A matplotlib figure; it is closed.
    target
        The PNG; the PDF stands beside it.
    dots
        Dots per inch of the PNG.
    vector
        Whether to write the PDF.

    Returns
    -------
    list of Path
        What was written.
    """
    written = []
    for suffix in (".png", ".pdf") if vector else (".png",):
        path = target.with_suffix(suffix)
        with atomic_path(path) as temporary:
            figure.savefig(temporary, dpi=dots, metadata=_METADATA[suffix])
        written.append(path)
    pyplot().close(figure)
    return written
