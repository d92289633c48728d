"""A field in a few numbers for each order."""

from __future__ import annotations

import os
from html import escape
from math import isfinite
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from pdtheory.conventions import UNANSWERED, Status, order_colour
from pdtheory.pointset.cloud import FloatArray, IntArray
from pdtheory.pointset.field import DirectionField
from pdtheory.pointset.parts import load_rows, read_plan
from pdtheory.pointset.words import LARGEST_ANGLE_ERROR, STATUS_WORDS, UNDETERMINED

#: Flags that a person should know of; the others are no defect or said elsewhere.
_REPORTED = tuple(flag for flag in STATUS_WORDS if flag not in (Status.REFINED, Status.UNORIENTED))

#: What stands above the cells of a summary.
HEADINGS = ("order", "maxima", "minima", "median strength", "median std (degrees)")
#: Points that a median needs.
_ENOUGH = 200_000


class OrderSummary(NamedTuple):
    """One order of a field.

    Attributes
    ----------
    order : int
        The order k.
    maxima, minima : int
        Number of directions of each kind at all points.
    strength : float
        Median strength; NaN if there is none.
    angle_std : float
        Median standard deviation of the angles, in degrees; NaN if there is none.
    """

    order: int
    maxima: int
    minima: int
    strength: float
    angle_std: float

    @property
    def undetermined(self) -> bool:
        """Whether the angles have errors that say nothing about half of them."""
        return self.angle_std > LARGEST_ANGLE_ERROR

    @property
    def cells(self) -> tuple[str, str, str, str, str]:
        """All in words, for the row of a table."""
        strength, angle_std = (
            f"{value:.3g}" if isfinite(value) else "-" for value in (self.strength, self.angle_std)
        )
        return (
            str(self.order),
            f"{self.maxima:,}",
            f"{self.minima:,}",
            strength,
            UNDETERMINED if self.undetermined else angle_std,
        )


def order_summaries(field: DirectionField) -> list[OrderSummary]:
    """Return the summary of every order, ascending."""
    return [
        _summary(order, rows.kind, rows.strength, rows.angle_std)
        for order, rows in ((order, field[order]) for order in field.orders)
    ]


def run_summaries(folder: str | os.PathLike[str]) -> list[OrderSummary]:
    """Return the summary of every order of a finished run in a folder, ascending.

    The medians are those of some directions where there are more than 200,000 queries: each is
    drawn by itself, with a probability of 200,000 / number of queries, so that not all need be in
    memory.

    Raises
    ------
    FileAccessError, FileFormatError
        As for :func:`pdtheory.pointset.load_parts`.
    """
    plan = read_plan(folder)
    share = _ENOUGH / max(1, int(plan["queries"]))
    return [
        _summary(
            order,
            load_rows(folder, order, "kind"),
            load_rows(folder, order, "strength", share),
            load_rows(folder, order, "angle_std", share),
        )
        for order in plan["orders"]
    ]


def _summary(
    order: int, kind: npt.NDArray[Any], strength: FloatArray, angle_std: FloatArray
) -> OrderSummary:
    return OrderSummary(
        order,
        int((kind == 1).sum()),
        int((kind == -1).sum()),
        _median(strength),
        _median(np.degrees(angle_std)),
    )


def status_sentences(status: IntArray) -> list[str]:
    """Say in words how many points could not be answered or are weaker than asked for, and why."""
    answered = int(((status & int(UNANSWERED)) == 0).sum())
    sentences = [f"{answered:,} of {len(status):,} points answered."]
    for flag in _REPORTED:
        count = int(((status & int(flag)) != 0).sum())
        if count:
            sentences.append(
                f"{count:,} {'points have' if count > 1 else 'point has'} {STATUS_WORDS[flag]}."
            )
    return sentences


def field_html(field: DirectionField) -> str:
    """Return a field as a small HTML table, for notebooks."""
    head = "".join(f"<th>{heading}</th>" for heading in HEADINGS)
    rows = "".join(
        f"<tr><td>{coloured_order(row.order)}</td>"
        + "".join(f"<td>{cell}</td>" for cell in row.cells[1:])
        + "</tr>"
        for row in order_summaries(field)
    )
    notes = escape(" ".join(status_sentences(field.status)))
    return (
        f"<div><strong>DirectionField</strong>, {len(field):,} points<br>{notes}"
        f"<table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table></div>"
    )


def coloured_order(order: int) -> str:
    """Return an order as HTML with its colour before it."""
    red, green, blue = (round(255 * part) for part in order_colour(order))
    return f'<span style="color:rgb({red},{green},{blue})">&#9632;</span> {order}'


def _median(values: FloatArray) -> float:
    finite = values[np.isfinite(values)]
    return float(np.median(finite)) if len(finite) else float("nan")
