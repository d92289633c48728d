"""How the size of a neighbourhood is chosen, and whether it can be computed at all."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np

from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray
from pdtheory.pointset.intake import FEWEST
from pdtheory.pointset.kernels.fit import MARGIN
from pdtheory.pointset.trees import kd_tree

#: Most neighbours of one point.
MAX_NEIGHBOURS = 100_000
#: Largest radius, in diagonals of the bounding box. One that holds the whole cloud is of use for a
#: single patch; one much larger is a mistake in the units, and singles out no part of the surface.
MOST_DIAGONALS = 10.0
#: Most neighbours, at half of the points, within a radius that is tried unasked.
AUTO_NEIGHBOURS = 1_000


class Choice(NamedTuple):
    """Exactly one way to choose the neighbourhood; the others are None."""

    radius: float | None
    neighbours: int | None

    @property
    def text(self) -> str:
        """The choice in words, for messages."""
        if self.neighbours is not None:
            return f"{self.neighbours} neighbours"
        return f"the radius {self.radius:g}"


def choose(
    radius: Any,
    neighbours: Any,
    radius_relative: Any,
    diagonal: float,
    count: int,
) -> Choice:
    """Check the three ways to ask for a neighbourhood and reduce them to two.

    Parameters
    ----------
    radius, neighbours, radius_relative
        As given by the user; exactly one must not be None.
    diagonal : float
        Diagonal of the bounding box, positive.
    count : int
        Number of finite points.

    Raises
    ------
    InputError
        If not exactly one is given, or it cannot be used.
    """
    radius, neighbours, radius_relative = map(_plain, (radius, neighbours, radius_relative))
    given = sum(value is not None for value in (radius, neighbours, radius_relative))
    if given != 1:
        raise InputError(
            f"give exactly one of radius, neighbours and radius_relative; {given} were given."
        )
    if neighbours is not None:
        if not isinstance(neighbours, (int, np.integer)) or isinstance(neighbours, bool):
            raise InputError(f"neighbours must be a whole number, not {neighbours!r}.")
        if neighbours < FEWEST:
            raise InputError(
                f"{neighbours} neighbours are too few; the smallest fit needs {FEWEST}."
            )
        if neighbours > MAX_NEIGHBOURS:
            raise InputError(
                f"{neighbours} neighbours are too many; give at most {MAX_NEIGHBOURS}."
            )
        return Choice(None, min(int(neighbours), count))
    size = radius if radius is not None else radius_relative
    name = "the radius" if radius is not None else "the relative radius"
    if not isinstance(size, (int, float, np.integer, np.floating)) or isinstance(size, bool):
        raise InputError(f"{name} must be a number, not {size!r}.")
    if not np.isfinite(size) or size <= 0:
        raise InputError(f"{name} must be positive and finite, not {size}.")
    chosen = float(size) if radius is not None else float(size) * diagonal
    if chosen > MOST_DIAGONALS * diagonal:
        unit = " diagonals of the bounding box" if radius is None else ""
        raise InputError(
            f"{name} of {size:g}{unit} is far larger than the cloud, whose bounding box has a "
            f"diagonal of {diagonal:.3g}; give one that reaches over a small part of the surface, "
            f"such as {diagonal / 20.0:.2g} in the units of the points."
        )
    return Choice(chosen, None)


def choose_radii(
    radius: float | str | Sequence[float],
    points: FloatArray,
    diagonal: float,
    degree: int,
) -> list[Choice]:
    """Return the radii to choose from at each point, largest first; one if one is given.

    Parameters
    ----------
    radius
        A number, several, or "auto" for radii at which half of the points have 1.5, 4.5, 13.5, ...
        neighbours for each coefficient, up to 1,000 neighbours.
    points : (P, 3) float64
        Finite points.
    diagonal : float
        Diagonal of their bounding box.
    degree : int
        The degree that the neighbours are to bear.

    Raises
    ------
    InputError
        If they cannot be used.
    """
    radius = _plain(radius)
    if isinstance(radius, str):
        if radius != "auto":
            raise InputError(f"radius must be a number or 'auto', not {radius!r}.")
        size = (degree + 1) * (degree + 2) // 2
        wanted = [int(1.5 * size)]
        while 3 * wanted[-1] <= min(AUTO_NEIGHBOURS, len(points)):
            wanted.append(3 * wanted[-1])
        radii = _median_radii(points, [min(count, len(points)) for count in wanted])
    else:
        radii = list(radius) if isinstance(radius, Iterable) else [radius]
    if not radii:
        raise InputError("no radius is given; give at least one.")
    given = [choose(value, None, None, diagonal, len(points)) for value in radii]
    return sorted(set(given), key=lambda choice: -(choice.radius or 0.0))


def refuse_crowd(occupancy: int, choice: Choice) -> None:
    """Refuse a radius that catches more points than can be worked on.

    All points of a cell of half the radius are neighbours of one another, so the fullest cell is a
    lower bound that costs nothing.

    Raises
    ------
    InputError
        If the bound exceeds the limit.
    """
    if occupancy > MAX_NEIGHBOURS:
        raise InputError(
            f"{choice.text} catches at least {occupancy} points around one point, and the limit is "
            f"{MAX_NEIGHBOURS}; give a smaller radius, or thin the points."
        )


def nearest(tree: Any, queries: FloatArray, count: int) -> tuple[FloatArray, Any]:
    """Return distance to the `count`-th nearest point (Q,) and the indices of all (Q, count)."""
    distances, indices = tree.query(queries, k=count)
    if count == 1:
        distances, indices = distances[:, None], indices[:, None]
    return distances[:, -1], np.ascontiguousarray(indices, dtype=np.int64)


def _plain(value: Any) -> Any:
    """Return the number that an array without axes holds, and anything else as it is."""
    return value[()] if isinstance(value, np.ndarray) and value.ndim == 0 else value


def _median_radii(points: FloatArray, counts: Sequence[int]) -> list[float]:
    """Return the radii that hold so many points at half of the points, from a sample of these."""
    sample = points[:: max(1, len(points) // 1000)]
    distances, _ = kd_tree(points).query(sample, k=list(counts))
    return [float(value) for value in np.median(distances, axis=0)]


def suggest_radius(points: FloatArray, degree: int) -> str:
    """Return advice in words: a radius that holds twice the coefficients at half of the points.

    Or all points, if they are fewer and still bear the degree. Degree 2 is borne by the fewest
    points that are taken, so a lower degree is never proposed there.
    """
    size = (degree + 1) * (degree + 2) // 2
    if len(points) < MARGIN * size:
        return (
            f"there are {len(points)} points in all, few for degree {degree}: give more, or a "
            "lower degree and a larger radius"
        )
    wanted = min(2 * size, len(points))
    (radius,) = _median_radii(points, [wanted])
    # Half a percent more, so that rounding to three digits loses none of them.
    return f"a radius of {1.005 * radius:.3g} holds {wanted} at half of the points"
