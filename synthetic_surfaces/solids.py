"""Solids with edges and corners: the cube, sharp and rounded."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np

from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray
from synthetic_surfaces.base import Surface
from synthetic_surfaces.chart import Chart
from synthetic_surfaces.description import Description
from synthetic_surfaces.parameters import Parameter, Parameters

_Maps = tuple[FloatArray, FloatArray, FloatArray]
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

    def charts(self) -> Sequence[Chart]:
        half = self.number("side") / 2
        return [
            _square(s * half * _UNIT[i], half * _UNIT[(i + 1) % 3], s * half * _UNIT[(i + 2) % 3])
            for i in range(3)
            for s in (1.0, -1.0)
        ]


def _square(centre: FloatArray, first: FloatArray, second: FloatArray) -> Chart:
    """The parallelogram centre + [-1, 1] first + [-1, 1] second."""

    def evaluate(u: FloatArray, v: FloatArray) -> _Maps:
        points = centre + np.outer(2 * u - 1, first) + np.outer(2 * v - 1, second)
        return points, np.tile(2 * first, (len(u), 1)), np.tile(2 * second, (len(u), 1))

    return Chart(evaluate)


def _quarter_cylinder(
    centre: FloatArray, axis: FloatArray, first: FloatArray, second: FloatArray, cells: float
) -> Chart:
    """From `first` to `second` around the segment centre + [-1, 1] axis."""

    def evaluate(u: FloatArray, v: FloatArray) -> _Maps:
        angle = np.pi / 2 * u
        cosine, sine = np.cos(angle), np.sin(angle)
        points = (
            centre + np.outer(cosine, first) + np.outer(sine, second) + np.outer(2 * v - 1, axis)
        )
        turn = np.pi / 2 * (np.outer(cosine, second) - np.outer(sine, first))
        return points, turn, np.tile(2 * axis, (len(u), 1))

    return Chart(evaluate, (cells, 1.0))


def _octant(centre: FloatArray, legs: FloatArray, cells: float) -> Chart:
    """The octant of a sphere between the rows of `legs`, orthogonal and right-handed."""
    first, second, third = legs

    def evaluate(u: FloatArray, v: FloatArray) -> _Maps:
        a, b = np.pi / 2 * u, np.pi / 2 * v
        ring = np.outer(np.cos(a), first) + np.outer(np.sin(a), second)
        turn = np.outer(np.cos(a), second) - np.outer(np.sin(a), first)
        low, high = np.cos(b)[:, None], np.sin(b)[:, None]
        return (
            centre + low * ring + high * third,
            np.pi / 2 * low * turn,
            np.pi / 2 * (low * third - high * ring),
        )

    return Chart(evaluate, (cells, cells))
