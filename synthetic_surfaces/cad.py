"""A machined part with curved edges, a crease that dies out, and corners of three smooth faces."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np

from pdtheory.errors import InputError
from synthetic_surfaces.base import Surface
from synthetic_surfaces.chart import Chart, from_map
from synthetic_surfaces.description import Description
from synthetic_surfaces.parameters import Parameter
from synthetic_surfaces.truth import Site


class CadPart(Surface):
    """A sector of a ring whose outer part rises: the step begins at zero and grows with the angle.

    The top is z = height + rise t^2 max(0, (r - middle) / (outer - middle)) with t in [0, 1] along
    the sector. All other faces are planes and circular cylinders.
    """

    name = "cad-part"
    summary = "machined ring sector: planes, cylinders, a crease that dies out, smooth corners"
    parameters = (
        Parameter("inner", "3/5", "inner radius", 1e-6, 1e6),
        Parameter("middle", 1, "radius of the crease on top", 1e-6, 1e6),
        Parameter("outer", "7/5", "outer radius", 1e-6, 1e6),
        Parameter("opening", 140, "angle of the sector in degrees", 10, 350),
        Parameter("height", "1/2", "height of the flat part", 1e-6, 1e6),
        Parameter("rise", "2/5", "largest rise of the outer part above it", 0, 1e6),
    )

    def check(self) -> None:
        inner, middle, outer = (self.values[name] for name in ("inner", "middle", "outer"))
        if not inner < middle < outer:
            raise InputError(
                f"cad-part: inner = {inner}, middle = {middle}, outer = {outer} do not ascend."
            )

    def describe(self) -> Description:
        inner, middle, outer, opening, height, rise = self.values.values()
        return Description(
            "pieces",
            words=(
                f"sector of {opening} degrees of the ring {inner} <= r <= {outer} over z = 0, its "
                f"top at z = {height} + {rise} t^2 max(0, (r - {middle})/({outer} - {middle})), "
                "t from 0 to 1 along the sector"
            ),
        )

    def sites(self) -> tuple[Site, ...]:
        outer, height = self.values["outer"], self.values["height"]
        # A rational point of the circle near the middle of the wall.
        tangent = Fraction(np.tan(np.radians(self.number("opening")) / 4)).limit_denominator(20)
        square = tangent**2
        place = (outer * (1 - square) / (1 + square), outer * 2 * tangent / (1 + square))
        wall = Description("implicit", (f"x**2 + y**2 - ({outer})**2",))
        return (Site("outer wall", wall, (str(place[0]), str(place[1]), str(height / 2))),)

    def charts(self) -> Sequence[Chart]:
        """Return floor, top and both ends in two bands each, and the two round walls.

        A point is given by its place across (0 inner to 1 outer edge of its band), along the sector
        and up (0 to 1); every chart holds one of the three fixed.
        """
        inner, middle, outer = (self.number(name) for name in ("inner", "middle", "outer"))
        opening, height = np.radians(self.number("opening")), self.number("height")
        long, tall = opening * (inner + outer) / 2 / outer, max(0.1, height / outer)

        charts = []
        for low, high, rise in ((inner, middle, 0.0), (middle, outer, self.number("rise"))):
            band = partial(_band, (low, high), opening, height, rise)
            wide = (high - low) / outer
            charts += [
                _chart(band, lambda u, v, one: (u, v, one), (wide, long)),
                _chart(band, lambda u, v, one: (v, u, 0 * one), (long, wide)),
                _chart(band, lambda u, v, one: (u, 0 * one, v), (wide, tall)),
                _chart(band, lambda u, v, one: (v, one, u), (tall, wide)),
            ]
            if low == inner:
                charts.append(_chart(band, lambda u, v, one: (0 * one, v, u), (tall, long)))
            else:
                charts.append(_chart(band, lambda u, v, one: (one, u, v), (long, tall)))
        return charts


def _band(
    ends: tuple[float, float],
    opening: float,
    height: float,
    rise: float,
    across: Any,
    along: Any,
    up: Any,
) -> Any:
    """Return the points of the body over a ring between two radii."""
    radius, angle = ends[0] + (ends[1] - ends[0]) * across, opening * along
    top = height + rise * along**2 * across
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), up * top], axis=1)


def _chart(
    body: Callable[[Any, Any, Any], Any],
    pick: Callable[[Any, Any, Any], tuple[Any, Any, Any]],
    cells: tuple[float, float],
) -> Chart:
    return Chart(from_map(lambda u, v: body(*pick(u, v, 1 + 0 * u))), cells)
