"""From the user's input and options to a run that is ready to start."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import Literal

import numpy as np
import numpy.typing as npt

from pdtheory.conventions import DEFAULT_DEGREE
from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray, IntArray, PointCloud
from pdtheory.pointset.engine import Engine
from pdtheory.pointset.intake import take_in
from pdtheory.pointset.kernels.fit import FRAME_GIVEN, FRAME_PRINCIPAL, FRAME_TANGENT, Settings
from pdtheory.pointset.neighbourhoods import choose, choose_radii
from pdtheory.pointset.options import Orient
from pdtheory.pointset.pool import Progress, thread_count
from pdtheory.pointset.selection import Selector, candidate_degrees

#: Largest degree of a regression.
MAX_DEGREE = 14

_FRAMES = {"tangent": FRAME_TANGENT, "principal": FRAME_PRINCIPAL, "given": FRAME_GIVEN}


@dataclass(frozen=True)
class Run:
    """Input that was checked, and the engine that works on it.

    Attributes
    ----------
    engine : Engine or Selector
        Does the work.
    places : (Q, 3) float64
        The queries as given.
    degree : int
        Largest degree of a regression.
    orders : (J,) int64
        The orders, ascending.
    asked : str
        All that the results depend on beside points, queries, sides and orders.
    threads : int
        Threads to use.
    progress : callable or None
        As given.
    """

    engine: Engine | Selector
    places: FloatArray
    degree: int
    orders: IntArray
    asked: str
    threads: int
    progress: Progress | None


def prepare(
    points: npt.ArrayLike | PointCloud,
    *,
    radius: float | Sequence[float] | Literal["auto"] | None = None,
    neighbours: int | None = None,
    radius_relative: float | None = None,
    degree: int | Literal["auto"] = DEFAULT_DEGREE,
    orders: Sequence[int] = (2, 3),
    norm: Literal["l2", "l1"] = "l2",
    normals: npt.ArrayLike | None = None,
    queries: npt.ArrayLike | None = None,
    orient: Orient | npt.ArrayLike = "auto",
    frame: Literal["tangent", "principal", "given"] = "tangent",
    weight_distance: Literal["3d", "planar"] = "3d",
    uncertainty: bool = True,
    non_finite: Literal["refuse", "drop"] = "refuse",
    threads: int | None = None,
    progress: Progress | None = None,
) -> Run:
    """Check points and options, explained at :func:`pdtheory.pointset.estimate_directions`.

    Raises
    ------
    InputError
        If something cannot be used.
    """
    wanted = _check_orders(orders, MAX_DEGREE if isinstance(degree, str) else degree)
    degrees = _degrees(degree, wanted)
    _check_words(norm, frame, weight_distance)
    workers = thread_count(threads)
    intake = take_in(points, normals, queries, non_finite, orient)
    if frame == "given" and not intake.planes:
        raise InputError("frame='given' takes the planes from normals; give normals.")
    planar = weight_distance == "planar"
    if planar and neighbours is not None:
        raise InputError("weight_distance='planar' needs a radius; neighbours cannot choose it.")
    if radius is None or neighbours is not None or radius_relative is not None:
        choices = [choose(radius, neighbours, radius_relative, intake.diagonal, len(intake.points))]
    else:
        bearing = degrees[0] if len(degrees) == 1 else degrees[0] + 2
        choices = choose_radii(radius, intake.points, intake.diagonal, bearing)
    several = len(choices) * len(degrees) > 1
    settings = Settings(
        degrees[-1],
        _FRAMES[frame],
        planar,
        norm == "l1",
        bool(uncertainty) or several,
        intake.oriented,
    )
    engines: list[Engine] = []
    for choice in choices:
        sides = intake.references if not engines else partial(getattr, engines[0], "references")
        engines.append(
            Engine(
                intake.points,
                intake.queries,
                sides,
                choice,
                wanted,
                settings,
                intake.rounding,
            )
        )
    engine: Engine | Selector = engines[0]
    if several:
        above = degrees[-1] + 2
        engine = Selector(
            [e.at_degree(degree) for degree in degrees for e in engines],
            # Of several degrees, the higher are witnesses themselves.
            [e.at_degree(above) for e in engines if len(degrees) == 1 and above <= MAX_DEGREE],
        )
    asked = repr((choices, degrees, tuple(settings)))
    return Run(engine, intake.places, degrees[-1], wanted, asked, workers, progress)


def _degrees(degree: int | str, orders: IntArray) -> list[int]:
    """Return the degrees to choose from, ascending."""
    if not isinstance(degree, str):
        return [int(degree)]
    if degree != "auto":
        raise InputError(f"degree must be a number or 'auto', not {degree!r}.")
    return candidate_degrees(orders, MAX_DEGREE)


def _check_orders(orders: Sequence[int], degree: int) -> IntArray:
    """Return the orders, ascending and once each."""
    if not isinstance(degree, (int, np.integer)) or not 2 <= degree <= MAX_DEGREE:
        raise InputError(f"degree {degree!r} is not available; give one from 2 to {MAX_DEGREE}.")
    try:
        given = list(orders)
    except TypeError:
        raise InputError(
            f"orders must be a list of orders such as (2, 3), not {orders!r}."
        ) from None
    for order in given:
        if not isinstance(order, (int, np.integer)) or order < 1:
            raise InputError(f"order {order!r} is not available; orders are 1, 2, 3, ...")
        if order > degree:
            raise InputError(
                f"order {order} is above the degree {degree} of the regression; "
                f"give degree {order} or more, or leave that order out."
            )
    return np.array(sorted(set(given)), dtype=np.int64)


def _check_words(norm: str, frame: str, weight_distance: str) -> None:
    """Refuse words that mean nothing."""
    for name, word, known in (
        ("norm", norm, ("l2", "l1")),
        ("frame", frame, tuple(_FRAMES)),
        ("weight_distance", weight_distance, ("3d", "planar")),
    ):
        if not isinstance(word, str) or word not in known:
            raise InputError(f"{name} {word!r} is not known; give one of {', '.join(known)}.")
