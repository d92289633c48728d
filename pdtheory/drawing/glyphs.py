"""Directions laid out for drawing: flat, with what thins, bends and scales the strokes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np
import numpy.typing as npt

from pdtheory.conventions import ORDER_COLOURS
from pdtheory.drawing.choice import Choice
from pdtheory.drawing.thinning import SPOTS, Spots, choose_spots
from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray
from pdtheory.pointset.field import DirectionField

#: The orders that have a colour to be drawn in.
ORDERS: Final = tuple(sorted(ORDER_COLOURS))

#: Stands for what single precision cannot hold.
_HUGE: Final = 3e38

#: Of the points whose directions are shown at first, so many are evenly spread.
_SHOWN: Final = 5_000

#: A stroke reaches this part of the way to the next spot.
REACH: Final = 0.46


@dataclass(frozen=True)
class GlyphData:
    """Directions of several orders, flat: one row for each direction.

    Attributes
    ----------
    position : (M, 3) float64
        Where each direction stands.
    attributes : mapping of str to (M,) or (M, 3) array
        What is drawn, in single precision and finite: `direction` and `surface_normal` (unit
        vectors), `order`, `kind`, `point` (index in the field), `eigenvalue`, `eigenvalue_std`,
        `strength`, `angle_std`, `relative_strength` (by the 90 % quantile of its order, at most
        1.5), `bend` (half the normal curvature in the direction, 1/length), `spacing` and `turn`
        of the point (:mod:`pdtheory.drawing.thinning`).
    spots : Spots
        Spacing and turn of every point of the field.
    """

    position: FloatArray
    attributes: Mapping[str, npt.NDArray[np.generic]]
    spots: Spots

    def __len__(self) -> int:
        return len(self.position)


def glyph_data(
    field: DirectionField,
    orders: Iterable[int] | None = None,
    choice: Choice | None = None,
) -> GlyphData:
    """Lay out the directions of a field for drawing.

    Parameters
    ----------
    field
        The directions.
    orders
        The orders to take; all of the field by default.
    choice
        What is seen at first. Strokes are spread over the points with such directions; maxima and
        minima of all orders that are worth drawing by default.

    Raises
    ------
    InputError
        If the field does not hold one of the orders, or an order has no colour to draw it in.
    """
    wanted = tuple(field.orders if orders is None else orders)
    for order in wanted:
        if order not in ORDERS:
            raise InputError(
                f"order {order} cannot be drawn; choose from {ORDERS[0]} to {ORDERS[-1]}."
            )
    seen = Choice(wanted, "both") if choice is None else choice
    rows = [field[order] for order in wanted]
    usable = np.zeros(len(field), dtype=bool)
    passing = np.zeros((len(field), len(wanted)), dtype=bool)
    for i, row in enumerate(rows):
        usable |= row.counts > 0
        if row.order in seen.orders:
            keep = seen.passes(row.kind, row.strength, row.angle_std)
            passing[row.point_index[keep], i] = True
    spots = _spots(field.points, usable, passing)
    columns: dict[str, list[npt.NDArray[np.generic]]] = {}

    def put(name: str, values: npt.NDArray[np.generic]) -> None:
        columns.setdefault(name, []).append(values)

    for row in rows:
        point = row.point_index
        typical = np.quantile(row.strength, 0.9) if len(row) else 1.0
        above = np.where(row.strength > 0.0, np.inf, 0.0)
        put("position", field.points[point])
        put("direction", row.vector)
        put("surface_normal", field.frames[point, 2])
        put("order", np.full(len(row), row.order))
        put("kind", row.kind)
        put("point", point)
        put("eigenvalue", row.eigenvalue)
        put("eigenvalue_std", row.eigenvalue_std)
        put("strength", row.strength)
        put("angle_std", row.angle_std)
        put("relative_strength", np.minimum(row.strength / typical if typical else above, 1.5))
        put("bend", _bend(field, point, row.angle))
        put("spacing", spots.spacing[point])
        put("turn", spots.turn[point])
    position = np.concatenate(columns.pop("position", [np.empty((0, 3))]))
    attributes = {name: single(np.concatenate(parts)) for name, parts in columns.items()}
    return GlyphData(np.asarray(position, dtype=np.float64), attributes, spots)


def spread(
    points: FloatArray, passing: npt.NDArray[np.bool_], *, most: int = SPOTS, finest: float = 0.0
) -> Spots:
    """Choose spots among the points of which something is seen.

    Parameters
    ----------
    points : (P, 3) float64
        Positions.
    passing : (P, m) bool
        Whether a direction of each of the m orders is seen there. Spots are dealt to these only.
    most, finest
        As for :func:`pdtheory.drawing.thinning.choose_spots`.
    """
    count = passing.sum(axis=1)
    spots = choose_spots(points, count > 0, preference=count, most=most, finest=finest)
    return Spots(spots.spacing, _deal(spots.turn, passing))


def _spots(
    points: FloatArray, usable: npt.NDArray[np.bool_], passing: npt.NDArray[np.bool_]
) -> Spots:
    """Choose spots among all points with directions, and anew among those seen at first."""
    count = passing.sum(axis=1)
    every = choose_spots(points, usable, preference=count)
    first = count > 0
    if not first.any() or np.array_equal(first, usable):
        return Spots(every.spacing, _deal(every.turn, passing))
    some = spread(points, passing, most=_SHOWN)
    return Spots(
        np.where(first, some.spacing, every.spacing),
        np.where(first, some.turn, every.turn),
        every.spacing,
    )


def _deal(turn: FloatArray, passing: npt.NDArray[np.bool_]) -> FloatArray:
    """Return turns with which ``floor(turn * m)`` names an order that passes, where one does."""
    held = passing.sum(axis=1)
    pick, rest = np.divmod(turn * held, 1.0)
    nth = np.cumsum(passing, axis=1) == pick[:, None] + 1
    order = np.argmax(nth & passing, axis=1) if passing.shape[1] else np.zeros(len(turn))
    # Away from the next order, whatever single precision makes of it.
    dealt = (order + np.clip(rest, 1e-3, 1.0 - 1e-3)) / max(1, passing.shape[1])
    return np.where((held > 0) & (held < passing.shape[1]), dealt, turn)


def single(values: npt.NDArray[np.generic]) -> npt.NDArray[np.generic]:
    """Return 32-bit numbers in place of 64-bit ones; what is not finite becomes 0 or huge."""
    if not np.issubdtype(values.dtype, np.floating):
        return np.ascontiguousarray(values, dtype=np.int32)
    tamed = np.nan_to_num(values, nan=0.0, posinf=_HUGE, neginf=-_HUGE)
    return np.clip(tamed, -_HUGE, _HUGE).astype(np.float32)


def _bend(field: DirectionField, point: npt.NDArray[np.int64], angle: FloatArray) -> FloatArray:
    """Return g_2 at the angle of each direction, the height of the surface per squared length."""
    constant = field.coefficient(2, 0)[point].real
    turning = field.coefficient(2, 2)[point]
    return np.asarray(constant + 2.0 * (turning * np.exp(2j * angle)).real)
