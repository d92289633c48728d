"""Quartic surfaces: Goursat's, with the symmetry of the cube, and Dupin's ring cyclide."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from pdtheory.errors import InputError
from synthetic_surfaces.base import Surface
from synthetic_surfaces.chart import Chart, Evaluate, from_map
from synthetic_surfaces.classics import Direction, cube_directions
from synthetic_surfaces.description import Description
from synthetic_surfaces.parameters import Parameter
from synthetic_surfaces.truth import Site


class Goursat(Surface):
    """x^4 + y^4 + z^4 + a s^2 + b s + c = 0 with s = x^2 + y^2 + z^2, where it is star-shaped."""

    name = "goursat"
    summary = "Goursat's quartic x^4 + y^4 + z^4 + a s^2 + b s + c = 0, s = x^2 + y^2 + z^2"
    parameters = (
        Parameter("a", 0, "factor of s^2, above -1/3", -0.333, 100),
        Parameter("b", -1, "factor of s", -100, 100),
        Parameter("c", -1, "constant, negative", -100, -1e-6),
    )

    def describe(self) -> Description:
        a, b, c = (self.values[name] for name in "abc")
        s = "(x**2 + y**2 + z**2)"
        return Description("implicit", (f"x**4 + y**4 + z**4 + ({a})*{s}**2 + ({b})*{s} + ({c})",))

    def sites(self) -> tuple[Site, ...]:
        a, b, c = (self.values[name] for name in "abc")
        # On an axis (1 + a) r^4 + b r^2 + c = 0.
        radius = f"sqrt((sqrt({b**2 - 4 * (1 + a) * c}) - ({b}))/({2 * (1 + a)}))"
        return (Site("middle of a face", self.describe(), (radius, "0", "0")),)

    def charts(self) -> Sequence[Chart]:
        """Return the six faces of a cube, each direction carried out to the surface."""
        a, b, c = (self.number(name) for name in "abc")

        def carry(direction: Direction) -> Evaluate:
            def position(u: Any, v: Any) -> Any:
                unit = direction(u, v)
                # Along unit the form is A r^4 + b r^2 + c with A > 0 > c: one positive root.
                quartic = np.sum(unit**4, axis=1) + a
                square = (np.sqrt(b**2 - 4 * quartic * c) - b) / (2 * quartic)
                return np.sqrt(square)[:, None] * unit

            return from_map(position)

        return [Chart(carry(direction)) for direction in cube_directions()]


class Cyclide(Surface):
    """Dupin's ring cyclide (s + b^2 - d^2)^2 = 4 (a x - c d)^2 + 4 b^2 y^2 with b^2 = a^2 - c^2."""

    name = "cyclide"
    summary = "Dupin's ring cyclide, whose lines of curvature are circles"
    parameters = (
        Parameter("a", 1, "size of the ring", 1e-6, 1e6),
        Parameter("c", "3/10", "eccentricity; 0 gives a torus", 0, 1e6),
        Parameter("d", "1/2", "mean radius of the tube, between c and a", 1e-6, 1e6),
    )

    def check(self) -> None:
        a, c, d = (self.values[name] for name in "acd")
        if not c < d < a:
            raise InputError(f"cyclide: c = {c}, d = {d}, a = {a} do not ascend; give c < d < a.")

    def describe(self) -> Description:
        a, c, d = (self.values[name] for name in "acd")
        square = a**2 - c**2
        return Description(
            "implicit",
            (
                f"(x**2 + y**2 + z**2 + ({square - d**2}))**2 - 4*(({a})*x - ({c * d}))**2 "
                f"- 4*({square})*y**2",
            ),
        )

    def sites(self) -> tuple[Site, ...]:
        a, c, d = (self.values[name] for name in "acd")
        return (
            Site("where the tube is thick", self.describe(), (str(d + c - a), "0", "0")),
            Site("where the tube is thin", self.describe(), (str(a + c - d), "0", "0")),
        )

    def charts(self) -> Sequence[Chart]:
        a, c, d = (self.number(name) for name in "acd")
        b = np.sqrt(a**2 - c**2)

        def position(u: Any, v: Any) -> Any:
            p, q = 2 * np.pi * u, 2 * np.pi * v
            ring, tube = np.cos(p), np.cos(q)
            points = [
                d * (c - a * ring * tube) + b**2 * ring,
                b * np.sin(p) * (a - d * tube),
                b * np.sin(q) * (c * ring - d),
            ]
            return np.stack(points, axis=1) / (a - c * ring * tube)[:, None]

        return [Chart(from_map(position), (2.0, 1.0))]
