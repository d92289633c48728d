"""What of a field is drawn, and how large: the options that every picture shares."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Final, NamedTuple

import numpy as np
import numpy.typing as npt

from pdtheory.conventions import Kind
from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray
from pdtheory.pointset.field import DirectionField

#: Standard deviation, in radians, up to which a direction is worth drawing: 20 degrees.
CERTAIN: Final = 0.35

KINDS: Final[Mapping[str, tuple[Kind, ...]]] = {
    "max": (Kind.MAXIMUM,),
    "min": (Kind.MINIMUM,),
    "both": (Kind.MAXIMUM, Kind.MINIMUM),
}

#: Pixels of a side of a picture.
_SIDES: Final = (16, 16384)


class Choice(NamedTuple):
    """What is shown of a field.

    Attributes
    ----------
    orders : tuple of int
        The orders that are switched on.
    kind : {"max", "min", "both"}
        The kinds.
    strokes : int
        About how many points carry strokes.
    least_strength : float
        Weaker directions are left out.
    largest_uncertainty : float
        Directions with a larger standard deviation (radians) are left out.
    """

    orders: tuple[int, ...]
    kind: str = "max"
    strokes: int = 800
    least_strength: float = 0.0
    largest_uncertainty: float = CERTAIN

    @property
    def kinds(self) -> tuple[Kind, ...]:
        """The kinds one by one."""
        return KINDS[self.kind]

    def passes(
        self, kind: npt.NDArray[np.generic], strength: FloatArray, angle_std: FloatArray
    ) -> npt.NDArray[np.bool_]:
        """Return which of some directions are of the kinds, strong and certain enough, (M,)."""
        keep = np.isin(kind, [int(kind) for kind in self.kinds])
        keep &= strength >= self.least_strength
        # Without error bars nothing is known against a direction.
        return np.asarray(keep & ~(angle_std > self.largest_uncertainty))


def check_choice(
    field: DirectionField,
    *,
    orders: Iterable[int] | None,
    kind: str,
    strokes: int,
    least_strength: float,
    largest_uncertainty: float,
) -> Choice:
    """Return the choice, if it can be shown.

    Raises
    ------
    InputError
        If an option cannot be used or the field does not hold an order.
    """
    wanted = field.orders if orders is None else tuple(sorted(set(orders)))
    for order in wanted:
        field[order]
    if kind not in KINDS:
        raise InputError(f"kind is {kind!r}; give {', '.join(KINDS)}.")
    if strokes < 1:
        raise InputError(f"strokes is {strokes}; give at least 1.")
    for name, value in (
        ("least_strength", least_strength),
        ("largest_uncertainty", largest_uncertainty),
    ):
        if not value >= 0.0:
            raise InputError(
                f"the {name.replace('_', ' ')} is {value}; give a number of at least 0."
            )
    return Choice(wanted, kind, int(strokes), least_strength, largest_uncertainty)


def refuse_empty(count: int) -> None:
    """Refuse a picture in which no direction is seen.

    Raises
    ------
    InputError
        If `count` is 0.
    """
    if not count:
        raise InputError(
            "no direction is left to show; take more orders or kinds, a lower least strength or a "
            "higher largest uncertainty."
        )


def check_size(size: tuple[int, int]) -> tuple[int, int]:
    """Return the width and height of a picture, if it can be made.

    Raises
    ------
    InputError
        If a side is too short or too long.
    """
    low, high = _SIDES
    if not all(low <= side <= high for side in size):
        raise InputError(f"size is {size[0]} x {size[1]}; give {low} to {high} pixels a side.")
    return size
