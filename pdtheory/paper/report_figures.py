"""The figures of the report: where three or four maxima live, and which triples exist."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from pdtheory.paper.figures.plots import colour, new_plot, pyplot

#: Shade of the region with more maxima.
_INSIDE = 0.25


def _phase(
    curve: np.ndarray[Any, Any], reach: float, names: tuple[str, str], order: int, ratio: str
) -> Any:
    figure = new_plot(3.4, 3.2)
    axes = figure.add_subplot()
    axes.fill(curve.real, curve.imag, color=colour(order), alpha=_INSIDE, linewidth=0)
    axes.plot(curve.real, curve.imag, color=colour(order))
    axes.text(0, 0, names[0], ha="center", va="center")
    axes.text(-0.62 * reach, 0.8 * reach, names[1], ha="center", va="center")
    axes.set(
        aspect="equal",
        xlim=(-reach, reach),
        ylim=(-reach, reach),
        xlabel=rf"Re ${ratio}$",
        ylabel=rf"Im ${ratio}$",
    )
    figure.tight_layout()
    return figure


def deltoid() -> Any:
    """Draw the plane of phi_31 with phi_33 = 1: three maxima inside the deltoid, else one."""
    s = np.linspace(0, 2 * np.pi, 721)
    curve = -3 * (2 * np.exp(1j * s) + np.exp(-2j * s))
    return _phase(curve, 10.5, ("3 maxima", "1 maximum"), 3, r"\phi_{3,1}\,/\,\phi_{3,3}")


def astroid() -> Any:
    """Draw the plane of phi_42 with phi_44 = 1: four maxima inside the astroid, else two."""
    s = np.linspace(0, 2 * np.pi, 721)
    curve = -4 * (np.cos(s) ** 3 + 1j * np.sin(s) ** 3)
    return _phase(curve, 4.8, ("4 maxima", "2 maxima"), 4, r"\phi_{4,2}\,/\,\phi_{4,4}")


def triples() -> Any:
    """Draw the torus of angles: which (0, t2, t3) are the three maxima of an order 3."""
    figure = new_plot(3.4, 3.2)
    axes = figure.add_subplot()
    # Every gap below 180 degrees: t2 < 180 < t3 < t2 + 180, and the same with t2, t3 exchanged.
    for corners in (((0, 180), (180, 180), (180, 360)), ((180, 0), (180, 180), (360, 180))):
        axes.fill(*zip(*corners, strict=True), color=colour(3), alpha=_INSIDE, linewidth=0)
        closed = [*corners, corners[0]]
        axes.plot(*zip(*closed, strict=True), color=colour(3))
    axes.plot([120, 240], [240, 120], "o", color=colour(3), markersize=4)
    axes.annotate("3-RoSy", (120, 240), textcoords="offset points", xytext=(6, -9))
    tees = [(90, 180), (180, 90), (90, 270), (270, 90), (180, 270), (270, 180)]
    axes.plot(*zip(*tees, strict=True), "x", color="black", markersize=5)
    axes.annotate("T", (90, 180), textcoords="offset points", xytext=(-3, -12))
    ticks = range(0, 361, 90)
    axes.set(
        aspect="equal",
        xlim=(0, 360),
        ylim=(0, 360),
        xticks=ticks,
        yticks=ticks,
        xlabel=r"$t_2 - t_1$ (degrees)",
        ylabel=r"$t_3 - t_1$ (degrees)",
    )
    figure.tight_layout()
    return figure


def family() -> Any:
    """Draw g_3 for phi_33 = 1 while phi_31 leaves the deltoid through the fold at 3."""
    figure = new_plot(7.4, 1.9)
    t = np.linspace(0, 2 * np.pi, 721)
    for place, a in enumerate((0.0, 1.0, 2.0, 3.0, 6.0), start=1):
        axes = figure.add_subplot(1, 5, place, projection="polar")
        maxima = _maxima(a)
        axes.plot(t, np.ones_like(t), color="0.8", linewidth=0.6)
        axes.plot(t, _radius(a, t), color=colour(3))
        axes.plot(maxima, _radius(a, maxima), "o", color="black", markersize=3.5)
        axes.set_axis_off()
        axes.set_title(rf"$\phi_{{3,1}} = {a:g}$: {len(maxima)} max", fontsize=8, y=-0.14)
    figure.tight_layout(w_pad=0.2)
    return figure


def _radius(a: float, t: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """Return 1 + 0.9 g / max |g| for g = cos 3t + a cos t."""
    return 1 + 0.9 * (np.cos(3 * t) + a * np.cos(t)) / (1 + a)


def _maxima(a: float) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Return the maxima of cos 3t + a cos t: g' = -sin t (9 + a - 12 sin^2 t), exactly solved."""
    square = (9 + a) / 12
    critical = [0.0, np.pi]
    if square < 1:
        root = float(np.arcsin(np.sqrt(square)))
        critical += [root, np.pi - root, -root, np.pi + root]
    angles = np.array(critical)
    curvature = -9 * np.cos(3 * angles) - a * np.cos(angles)
    return angles[curvature < 0]


@dataclass(frozen=True, slots=True)
class Figure:
    """A figure of the report, shown with one claim."""

    name: str
    claim: str
    caption: str
    draw: Callable[[], Any]
    #: Width on a page, in widths of its lines.
    width: float = 0.5


FIGURES = (
    Figure(
        "deltoid",
        "order3-discriminant",
        r"Order 3 with $\phi_{33} = 1$: three maxima exactly inside the deltoid.",
        deltoid,
    ),
    Figure(
        "family",
        "order3-one-or-three",
        r"Order 3 with $\phi_{33} = 1$ and a real $\phi_{31}$ that leaves the deltoid at 3: "
        r"$g_3$ about a grey zero circle, dots at the maxima.",
        family,
        width=1.0,
    ),
    Figure(
        "astroid",
        "order4-discriminant",
        r"Order 4 with $\phi_{44} = 1$: four maxima exactly inside the astroid.",
        astroid,
    ),
    Figure(
        "triples",
        "order3-maxima",
        r"The torus of angles: three maxima of order 3 at $t_1, t_2, t_3$ exist in the shaded "
        "triangles; the crosses are the perfect T's, on their boundary.",
        triples,
    ),
)


def figures_of(ids: Iterable[str]) -> list[Figure]:
    """Return the figures that belong to the given claims."""
    shown = set(ids)
    return [figure for figure in FIGURES if figure.claim in shown]


def rendered(figure: Figure, kind: str) -> bytes:
    """Return a figure as ``svg`` or ``pdf``, the same bytes for the same drawing."""
    plt = pyplot()
    drawing = figure.draw()
    buffer = io.BytesIO()
    dates = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}[kind]
    with plt.rc_context({"svg.hashsalt": "pdtheory", "pdf.fonttype": 3}):
        drawing.savefig(buffer, format=kind, metadata=dates)
    plt.close(drawing)
    return buffer.getvalue()
