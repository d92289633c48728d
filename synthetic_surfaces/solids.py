"""Solids with edges and corners: the cube, sharp and rounded."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, ClassVar

import numpy as np

from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray
from synthetic_surfaces.base import Surface
from synthetic_surfaces.chart import Chart, from_map
from synthetic_surfaces.description import Description
from synthetic_surfaces.parameters import Parameter, Parameters
from synthetic_surfaces.truth import Site

_UNIT = np.eye(3)


class RoundedCube(Surface):
    """A cube whose edges are quarter cylinders and whose corners are octants of spheres."""

    name = "rounded-cube"
    summary = "cube with rounded edges and corners"
    parameters: ClassVar[Parameters] = (
        Parameter("side", 2, "side of the cube", 1e-6, 1e6),
        Parameter("rounding", "1/5", "radius of edges and corners, below half the side", 1e-9, 1e6),
    )

    def check(self) -> None:
        if 2 * self.values["rounding"] >= self.values["side"]:
            raise InputError(
                f"{self.name}: rounding = {self.values['rounding']} is not below half the side "
                f"{self.values['side']}."
            )

    def describe(self) -> Description:
        return Description(
            "pieces",
            words=(
                f"cube of side {self.values['side']} around the origin with edges and corners "
                f"rounded by radius {self.values['rounding']}: 6 squares, 12 quarter cylinders "
                "and 8 octants of spheres"
            ),
        )

    def sites(self) -> tuple[Site, ...]:
        radius = self.values["rounding"]
        inner = self.values["side"] / 2 - radius
        x, y, z = (f"({name} - {inner})**2" for name in "xyz")
        on_edge, on_corner = (f"{inner} + {radius}/sqrt({n})" for n in (2, 3))
        corner = Description("implicit", (f"{x} + {y} + {z} - ({radius})**2",))
        edge = Description("implicit", (f"{x} + {y} - ({radius})**2",))
        face = Description("implicit", (f"x - {inner + radius}",))
        return (
            Site("edge", edge, (on_edge, on_edge, "0")),
            Site("corner", corner, (on_corner, on_corner, on_corner)),
            Site("face", face, (str(inner + radius), "0", "0")),
        )

    def charts(self) -> Sequence[Chart]:
        half, radius = self.number("side") / 2, self.number("rounding")
        inner = half - radius
        round_cells = max(0.1, radius / (2 * inner))
        charts = []
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            for s in (1.0, -1.0):
                charts.append(_square(s * half * _UNIT[i], inner * _UNIT[j], s * inner * _UNIT[k]))
                for t in (1.0, -1.0):
                    # The edge along axis i between the faces across j and k.
                    centre = inner * (s * _UNIT[j] + t * _UNIT[k])
                    charts.append(
                        _quarter_cylinder(
                            centre,
                            s * t * inner * _UNIT[i],
                            radius * s * _UNIT[j],
                            radius * t * _UNIT[k],
                            round_cells,
                        )
                    )
        for s in (1.0, -1.0):
            for t in (1.0, -1.0):
                for w in (1.0, -1.0):
                    signs = np.array([s, t, w])
                    legs = radius * np.diag(signs)
                    if s * t * w < 0:
                        legs = legs[[1, 0, 2]]
                    charts.append(_octant(inner * signs, legs, round_cells))
        return charts


class Cube(Surface):
    """A cube with sharp edges, around the origin."""

    name = "cube"
    summary = "cube with sharp edges and corners"
    parameters: ClassVar[Parameters] = (Parameter("side", 2, "side of the cube", 1e-6, 1e6),)

    def describe(self) -> Description:
        side = self.values["side"]
        return Description("pieces", words=f"cube of side {side} around the origin: 6 squares")

    def sites(self) -> tuple[Site, ...]:
        half = self.number("side") / 2
        ridge = (("0", "0"), ("90", "-1"), ("180", "0"), ("270", "-1"))
        corner = tuple((angle, "-1/sqrt(2)") for angle in ("0", "120", "240"))
        # The crest of the edge lies along t1; an edge at the corner runs along t1.
        along, across = np.array([[0, 0, 1], [1, 1, 0] / np.sqrt(2)])
        down, diagonal = np.array([[-2, 1, 1] / np.sqrt(6), [1, 1, 1] / np.sqrt(3)])
        return (
            Site(
                "edge",
                Description("cone", rays=ridge),
                place=half * np.array([1.0, 1.0, 0.0]),
                frame=np.stack([along, np.cross(across, along), across]),
            ),
            Site(
                "corner",
                Description("cone", rays=corner),
                place=half * np.ones(3),
                frame=np.stack([down, np.cross(diagonal, down), diagonal]),
            ),
            Site(
                "face",
                Description("implicit", (f"x - {self.values['side'] / 2}",)),
                (str(self.values["side"] / 2), "0", "0"),
            ),
        )

    def charts(self) -> Sequence[Chart]:
        half = self.number("side") / 2
        return [
            _square(s * half * _UNIT[i], half * _UNIT[(i + 1) % 3], s * half * _UNIT[(i + 2) % 3])
            for i in range(3)
            for s in (1.0, -1.0)
        ]


def _square(centre: FloatArray, first: FloatArray, second: FloatArray) -> Chart:
    """The parallelogram centre + [-1, 1] first + [-1, 1] second."""

    def position(u: Any, v: Any) -> Any:
        return centre + np.outer(2 * u - 1, first) + np.outer(2 * v - 1, second)

    return Chart(from_map(position))


def _quarter_cylinder(
    centre: FloatArray, axis: FloatArray, first: FloatArray, second: FloatArray, cells: float
) -> Chart:
    """From `first` to `second` around the segment centre + [-1, 1] axis."""

    def position(u: Any, v: Any) -> Any:
        angle = np.pi / 2 * u
        around = np.outer(np.cos(angle), first) + np.outer(np.sin(angle), second)
        return centre + around + np.outer(2 * v - 1, axis)

    return Chart(from_map(position), (cells, 1.0))


def _octant(centre: FloatArray, legs: FloatArray, cells: float) -> Chart:
    """The octant of a sphere between the rows of `legs`, orthogonal and right-handed."""
    first, second, third = legs

    def position(u: Any, v: Any) -> Any:
        a, b = np.pi / 2 * u, np.pi / 2 * v
        ring = np.outer(np.cos(a), first) + np.outer(np.sin(a), second)
        return centre + np.cos(b)[:, None] * ring + np.outer(np.sin(b), third)

    return Chart(from_map(position), (cells, cells))
