"""The polar plot of g_k: one panel for each order, with its directions and their error bars."""

from __future__ import annotations

import io
import os
from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, degrees, isfinite, nan, pi, radians, tau
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
import numpy.typing as npt

from pdtheory.atomic import atomic_path
from pdtheory.conventions import Kind, frequencies, order_colour
from pdtheory.errors import InputError, MissingDependencyError

if TYPE_CHECKING:
    from pdtheory.exact.faces import Face

SUFFIXES: Final = (".png", ".svg", ".pdf")

#: Panels side by side before a new row begins.
_COLUMNS: Final = 5
#: Inches of a panel.
_PANEL: Final = 2.4
#: Inches above it for what it shows.
_HEADING: Final = 0.3
#: g_k = 0 lies on the circle of radius 1, its largest modulus so far from it.
_AMPLITUDE: Final = 0.55
#: Radii at which the error bars of maxima and of all else lie, beyond the largest maximum.
_RIM: Final = 1.76
_INNER_RIM: Final = 1.66
#: Radius at which the angles are written, and that of the whole panel.
_WRITING: Final = 2.2
_EDGE: Final = 2.6

#: A term without directions is constant if it changes by no more than this part of itself.
_FLAT: Final = 1e-9

#: What names inside an SVG are made from. matplotlib takes it from the settings of the whole
#: process only; they are put back once the file is written.
_SVG: Final[dict[str, Any]] = {"svg.hashsalt": "pdtheory"}
#: Without dates and versions inside, equal numbers give equal files.
_METADATA: Final[dict[str, dict[str, Any]]] = {
    ".png": {"Software": None},
    ".svg": {"Date": None, "Creator": None},
    ".pdf": {"CreationDate": None, "Producer": None, "Creator": None},
}


@dataclass(frozen=True)
class PolarTerm:
    """The term of one order, to be drawn.

    Attributes
    ----------
    order : int
        The order k.
    phi : (F,) array_like of complex
        phi_{k,n} for n = k mod 2, ..., k, ascending.
    directions : sequence of (float, Kind, float)
        Angle, kind and standard deviation of the angle of each direction, in radians; NaN where the
        deviation is not known.
    quantity : str
        What the plot shows the modulus of: ``|g|``, or ``strength`` where phi_{k,n} was multiplied
        by R^(k-1) so that orders can be compared.
    """

    order: int
    phi: npt.ArrayLike
    directions: Sequence[tuple[float, Kind, float]] = ()
    quantity: str = "|g|"

    @classmethod
    def of_face(cls, face: Face) -> PolarTerm:
        """Return the term of an exact tensor, form or row, rounded, with its exact directions.

        Parameters
        ----------
        face
            A tensor, form or row with numbers for coefficients.
        """
        row = face.row.to_complex()
        return cls(
            face.order,
            [row.get(n, 0j) for n in frequencies(face.order)],
            [
                (radians(float(pair.angle_degrees(17))), pair.kind, nan)
                for pair in face.form.eigenpairs()
            ],
        )

    def values(self, theta: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Return g_k at some angles in radians, in the shape of these."""
        turns = np.multiply.outer(np.asarray(theta, np.float64), np.array(frequencies(self.order)))
        phi = np.asarray(self.phi, np.complex128)
        weight = np.where(np.array(frequencies(self.order)) == 0, 1.0, 2.0)
        return np.real(np.exp(1j * turns) @ (weight * phi))


def polar_figure(terms: Sequence[PolarTerm], *, title: str = "", figure: Any | None = None) -> Any:
    """Draw the terms side by side as r = 1 + c g_k(theta), each to its own scale.

    The dashed circle is g_k = 0: maxima bulge out, minima go in. A thick ray ends in a maximum, a
    thin one in a minimum, a dotted one in an inflection. The arc outside is the angle with its
    standard deviation to both sides. The largest |g_k|, or strength, stands above each panel.

    Parameters
    ----------
    terms
        The terms, in the order of the panels.
    title
        Text above all panels.
    figure : matplotlib.figure.Figure, optional
        An empty figure to draw into, which gets the size of the panels, such as ``plt.figure()``;
        one that belongs to no window by default.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Raises
    ------
    MissingDependencyError
        If matplotlib is not installed.
    InputError
        If there is no term, or one is not finite.
    """
    figure_class = _figure_class()
    if not terms:
        raise InputError("there is no order to plot; compute some, or choose another point.")
    for term in terms:
        if not np.isfinite(np.asarray(term.phi)).all():
            raise InputError(f"the coefficients of order {term.order} are not finite.")
    columns = min(len(terms), _COLUMNS)
    rows = ceil(len(terms) / columns)
    margin = 0.35 if title else 0.0
    width, height = columns * _PANEL, rows * (_PANEL + _HEADING) + margin
    if figure is None:
        figure = figure_class(facecolor="white")
    figure.set_size_inches(width, height)
    for i, term in enumerate(terms):
        left = (i % columns) * _PANEL
        bottom = height - margin - (i // columns + 1) * (_PANEL + _HEADING)
        place = (left / width, bottom / height, _PANEL / width, _PANEL / height)
        _panel(figure.add_axes(place, projection="polar"), term)
    if title:
        figure.suptitle(title, fontsize=9.0, y=1.0 - 0.1 / height, va="top")
    return figure


def save_figure(figure: Any, path: str | os.PathLike[str]) -> None:
    """Write a figure, whole or not at all.

    Parameters
    ----------
    figure
        A matplotlib figure.
    path
        The file; its suffix is .png, .svg or .pdf.

    Raises
    ------
    InputError
        If the suffix is another one.
    FileAccessError
        If the file cannot be written.
    """
    target = Path(path)
    suffix = target.suffix.lower()
    if suffix not in SUFFIXES:
        raise InputError(
            f"cannot write {target}: the suffix {suffix or '(none)'} is not known; "
            f"use one of {', '.join(SUFFIXES)}."
        )
    from matplotlib import rc_context

    with rc_context(_SVG), atomic_path(target) as temporary:
        figure.savefig(temporary, dpi=200, metadata=_METADATA[suffix])


def figure_pixels(figure: Any, dpi: float) -> npt.NDArray[np.uint8]:
    """Return a figure as a picture, without a file; any thread may ask for it.

    Parameters
    ----------
    figure
        A matplotlib figure.
    dpi
        Pixels for each inch of the figure.

    Returns
    -------
    (H, W, 4) uint8
        Red, green, blue and opacity, the top row first.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    figure.set_dpi(dpi)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return np.array(canvas.buffer_rgba(), np.uint8)


def figure_svg(figure: Any) -> str:
    """Return a figure as an SVG element that can stand inside an HTML page."""
    from matplotlib import rc_context

    stream = io.StringIO()
    with rc_context(_SVG | {"svg.fonttype": "none"}):
        figure.savefig(stream, format="svg", metadata=_METADATA[".svg"])
    text = stream.getvalue()
    return text[text.index("<svg") :]


def _panel(axes: Any, term: PolarTerm) -> None:
    colour = order_colour(term.order)
    theta = np.linspace(0.0, tau, 720 + 1)
    values = term.values(theta)
    largest = float(np.abs(values).max())
    scale = _AMPLITUDE / largest if largest > 0.0 else 0.0
    radius = 1.0 + scale * values
    axes.set_ylim(0.0, _EDGE)
    axes.set_yticks([])
    axes.grid(False)
    axes.spines["polar"].set_visible(False)
    axes.set_xticks([0.0, pi / 2])
    axes.set_xticklabels([])
    grey = "0.55"
    for angle, name in ((0.0, "$t_1$"), (pi / 2, "$t_2$")):
        axes.plot([angle, angle], [0.0, 1.0], color="0.85", linewidth=0.8, zorder=1)
        axes.text(angle, 1.13, name, color=grey, fontsize=6.5, ha="center", va="center")
    axes.plot(theta, np.ones_like(theta), color=grey, linewidth=0.7, linestyle=(0, (3, 2)))
    ones = np.ones_like(theta)
    axes.fill_between(theta, ones, radius, where=values >= 0, color=colour, alpha=0.28, linewidth=0)
    axes.fill_between(theta, ones, radius, where=values <= 0, color=colour, alpha=0.10, linewidth=0)
    axes.plot(theta, radius, color=colour, linewidth=1.3)
    for angle, kind, deviation in term.directions:
        _ray(axes, colour, angle, 1.0 + scale * float(term.values(angle)), kind, deviation)
    text = f"largest {term.quantity} {largest:.3g}"
    if not term.directions and float(np.ptp(values)) <= _FLAT * largest:
        text = "every direction"
    place = {"transform": axes.transAxes, "ha": "center", "va": "bottom"}
    axes.text(0.5, 1.06, f"order {term.order}", color=colour, weight="bold", fontsize=9.0, **place)
    axes.text(0.5, 0.99, text, fontsize=7.0, color="0.35", **place)


def _ray(axes: Any, colour: Any, angle: float, reach: float, kind: Kind, deviation: float) -> None:
    """Draw one direction from the middle to the curve, and its angle outside."""
    width, line, face = {
        Kind.MAXIMUM: (2.0, "-", colour),
        Kind.MINIMUM: (0.7, "-", "white"),
        Kind.INFLECTION: (0.9, ":", "white"),
    }[kind]
    axes.plot([angle, angle], [0.0, reach], color=colour, linewidth=width, linestyle=line, zorder=3)
    axes.plot(
        [angle],
        [reach],
        marker="o" if kind else "s",
        markersize=4.0 if kind is Kind.MAXIMUM else 3.2,
        markerfacecolor=face,
        markeredgecolor=colour,
        markeredgewidth=0.9,
        zorder=4,
    )
    if isfinite(deviation) and deviation > 0.0:
        rim = _RIM if kind is Kind.MAXIMUM else _INNER_RIM
        arc = np.linspace(angle - min(deviation, pi), angle + min(deviation, pi), 61)
        axes.plot(arc, np.full(arc.shape, rim), color=colour, linewidth=width, zorder=3)
        for end in (arc[0], arc[-1]):
            axes.plot([end, end], [rim - 0.04, rim + 0.04], color=colour, linewidth=0.7)
    if kind is Kind.MAXIMUM:
        text = f"{degrees(angle):.1f}°"
        axes.text(angle, _WRITING, text, fontsize=6.5, ha="center", va="center", color="0.25")


def _figure_class() -> Any:
    """Return matplotlib's class of figures, which belong to no window."""
    try:
        from matplotlib import figure
    except ImportError as error:
        raise MissingDependencyError(
            "plots need matplotlib; install it with `pip install matplotlib` (extra figures)."
        ) from error
    return figure.Figure
