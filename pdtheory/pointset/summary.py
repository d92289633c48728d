"""A field in a few numbers for each order."""

from __future__ import annotations

from html import escape
from typing import NamedTuple

import numpy as np

from pdtheory.conventions import UNANSWERED, Status, order_colour
from pdtheory.pointset.cloud import FloatArray, IntArray
from pdtheory.pointset.field import DirectionField
from pdtheory.pointset.words import STATUS_WORDS

#: Flags that a person should know of; the others are no defect or said elsewhere.
_REPORTED = tuple(flag for flag in STATUS_WORDS if flag not in (Status.REFINED, Status.UNORIENTED))


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


def order_summaries(field: DirectionField) -> list[OrderSummary]:
    """Return the summary of every order, ascending."""
    return [
        OrderSummary(
            order,
            int((rows.kind == 1).sum()),
            int((rows.kind == -1).sum()),
            _median(rows.strength),
            _median(np.degrees(rows.angle_std)),
        )
        for order, rows in ((order, field[order]) for order in field.orders)
    ]


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
    headings = ("order", "maxima", "minima", "median strength", "median std (degrees)")
    head = "".join(f"<th>{heading}</th>" for heading in headings)
    rows = "".join(
        f"<tr><td>{coloured_order(row.order)}</td><td>{row.maxima:,}</td><td>{row.minima:,}</td>"
        f"<td>{row.strength:.3g}</td><td>{row.angle_std:.3g}</td></tr>"
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
