"""One point of a direction field as a table, in text and in HTML."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from pdtheory.errors import MissingDependencyError
from pdtheory.pointset.summary import coloured_order
from pdtheory.pointset.words import (
    angle_with_error,
    coordinate,
    largest_eigenvalue_error,
    status_words,
    with_error,
)

if TYPE_CHECKING:
    from pdtheory.pointset.point import PointDirections

_HEADINGS = ("order", "kind", "angle (degrees)", "lambda", "strength")


def point_text(point: PointDirections) -> str:
    """Return a point as lines of text: where it is, how it was answered, and its directions."""
    if point.status.unanswered:
        return "\n".join(_heading(point))
    rows = [_HEADINGS, *_rows(point)]
    widths = [max(len(row[i]) for row in rows) for i in range(len(_HEADINGS))]
    lines = [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]
    return "\n".join([*_heading(point), *lines])


def point_html(point: PointDirections) -> str:
    """Return the same as HTML, with the polar plot, for notebooks."""
    head = "".join(f"<th>{escape(text)}</th>" for text in _HEADINGS)
    body = "".join(
        "<tr>"
        + f"<td>{coloured_order(int(row[0]))}</td>"
        + "".join(f"<td>{escape(text)}</td>" for text in row[1:])
        + "</tr>"
        for row in _rows(point)
    )
    lines = "<br>".join(escape(line) for line in _heading(point))
    table = f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"
    if point.status.unanswered:
        return f"<div>{lines}</div>"
    return f"<div>{lines}{table}{_inline_plot(point)}</div>"


def _heading(point: PointDirections) -> list[str]:
    place = ", ".join(coordinate(x, point.radius) for x in point.position.tolist())
    normal = ", ".join(f"{x:.4g}" for x in point.frame[2])
    where = f"within R = {point.radius:.6g}" if point.radius else "at the same place"
    around = f"{point.neighbours} neighbour{'s' * (point.neighbours != 1)} {where}"
    lines = [f"point {point.index} at ({place}), {around}"]
    if not point.status.unanswered:
        lines.append(
            f"normal ({normal}), degree {point.degree}, residuals {point.residual_rms:.2g} (rms)"
        )
    words = status_words(point.status)
    verdict = "no answer: the point has" if point.status.unanswered else "note: the point has"
    lines.append(f"{verdict} {'; '.join(words)}" if words else "answered as asked")
    return lines


def _rows(point: PointDirections) -> list[tuple[str, ...]]:
    rows: list[tuple[str, ...]] = []
    for order, directions in point.directions.items():
        if order in point.isotropic:
            rows.append((str(order), "all", "every direction", "", ""))
        elif not directions:
            rows.append((str(order), "none", f"above degree {point.degree}", "", ""))
        for row in directions:
            value, error = row.eigenvalue, row.eigenvalue_std
            limit = largest_eigenvalue_error(value, error, order, point.radius)
            rows.append(
                (
                    str(order),
                    row.kind.label,
                    angle_with_error(row.angle, row.angle_std),
                    with_error(value, error, limit=limit),
                    f"{row.strength:.3g}",
                )
            )
    return rows


def _inline_plot(point: PointDirections) -> str:
    """Return the polar plot as SVG, or nothing where it cannot be drawn."""
    from pdtheory.plots.polar import figure_svg

    try:
        return figure_svg(point.plot())
    except MissingDependencyError:
        return ""
