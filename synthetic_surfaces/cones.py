"""Piecewise linear surfaces around one point: ridges, corners, junctions, planes that meet."""

from __future__ import annotations

from abc import abstractmethod
from functools import cached_property
from typing import ClassVar

import numpy as np

from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray
from synthetic_surfaces.description import Description
from synthetic_surfaces.height import EXTENT, HeightSurface
from synthetic_surfaces.parameters import Parameter, Parameters
from synthetic_surfaces.truth import Site

SLOPE = Parameter("slope", 1, "steepness of the faces, as height over distance", 1e-6, 1e3)


class ConeSurface(HeightSurface):
    """z = r h(theta), with planes between given rays."""

    @abstractmethod
    def rays(self) -> list[tuple[float, float]]:
        """Return angle in radians and slope of h along each ray, by ascending angle."""

    def sites(self) -> tuple[Site, ...]:
        return (Site("apex", self.describe(), place=np.zeros(3), frame=np.eye(3)),)

    @property
    def creases(self) -> tuple[float, ...]:
        return tuple(angle for angle, _ in self.rays())

    @cached_property
    def _planes(self) -> tuple[FloatArray, FloatArray]:
        """The start of every sector and the gradient in it."""
        angle, slope = np.array(self.rays()).T
        after, end = np.roll(angle, -1) + np.eye(len(angle))[-1] * 2 * np.pi, np.roll(slope, -1)
        width = np.sin(after - angle)
        # h = g . (cos, sin) takes the two slopes on the two rays.
        gradient = np.stack(
            [
                (slope * np.sin(after) - end * np.sin(angle)) / width,
                (end * np.cos(angle) - slope * np.cos(after)) / width,
            ],
            axis=1,
        )
        return angle, gradient

    def gradient(self, x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        starts, gradients = self._planes
        turn = (np.arctan2(y, x) - starts[0]) % (2 * np.pi) + starts[0]
        sector = np.searchsorted(starts, turn, side="right") - 1
        return gradients[sector, 0], gradients[sector, 1]

    def height(self, x: FloatArray, y: FloatArray) -> FloatArray:
        dx, dy = self.gradient(x, y)
        return np.asarray(dx * x + dy * y)


class Ridge(ConeSurface):
    """A gable roof z = -slope |y|, with its crest along x: the edge of a cube at slope 1."""

    name = "ridge"
    summary = "gable roof z = -slope |y|, crest along x"
    parameters = (SLOPE, EXTENT)

    def rays(self) -> list[tuple[float, float]]:
        slope = self.number("slope")
        return [(0.0, 0.0), (np.pi / 2, -slope), (np.pi, 0.0), (1.5 * np.pi, -slope)]

    def describe(self) -> Description:
        slope = self.values["slope"]
        return Description(
            "cone", rays=(("0", "0"), ("90", f"-{slope}"), ("180", "0"), ("270", f"-{slope}"))
        )


class Corner(ConeSurface):
    """The corner of a cube, seen along its diagonal: three edges 120 degrees apart."""

    name = "corner"
    summary = "corner of a cube, its diagonal along z"
    parameters = (EXTENT,)

    def rays(self) -> list[tuple[float, float]]:
        return [(turn * 2 * np.pi / 3, -np.sqrt(0.5)) for turn in range(3)]

    def describe(self) -> Description:
        return Description(
            "cone", rays=tuple((angle, "-1/sqrt(2)") for angle in ("0", "120", "240"))
        )


class Planes(ConeSurface):
    """Planes that meet at a point, a pyramid with ridges at given azimuths."""

    name = "planes"
    summary = "planes that meet at a point, with ridges at given azimuths"
    parameters: ClassVar[Parameters] = (
        Parameter(
            "azimuths",
            "0,60,135,210,300",
            "directions of the ridges in degrees, ascending, gaps below 180",
            0,
            360,
            "list",
        ),
        Parameter("slopes", "-3/5", "slope of each ridge, or one for all", -1e3, 1e3, "list"),
        EXTENT,
    )

    def check(self) -> None:
        azimuths, slopes = self.values["azimuths"], self.values["slopes"]
        if len(azimuths) < 3:
            raise InputError(f"planes: {len(azimuths)} azimuths; give at least 3.")
        gaps = [b - a for a, b in zip(azimuths, [*azimuths[1:], azimuths[0] + 360], strict=True)]
        if not all(0 < gap < 180 for gap in gaps):
            raise InputError(
                "planes: the azimuths must ascend with gaps below 180 degrees, the gap back to the "
                f"first one among them; the gaps are {', '.join(str(gap) for gap in gaps)}."
            )
        if len(slopes) not in (1, len(azimuths)):
            raise InputError(
                f"planes: {len(slopes)} slopes for {len(azimuths)} azimuths; give one or as many."
            )

    def _slopes(self) -> list[float]:
        slopes = [float(slope) for slope in self.values["slopes"]]
        return slopes * len(self.values["azimuths"]) if len(slopes) == 1 else slopes

    def rays(self) -> list[tuple[float, float]]:
        angles = [np.radians(float(azimuth)) for azimuth in self.values["azimuths"]]
        return list(zip(angles, self._slopes(), strict=True))

    def describe(self) -> Description:
        azimuths, slopes = self.values["azimuths"], self.values["slopes"]
        if len(slopes) == 1:
            slopes = slopes * len(azimuths)
        return Description(
            "cone", rays=tuple((str(a), str(s)) for a, s in zip(azimuths, slopes, strict=True))
        )


class TJunction(ConeSurface):
    """Three gable roofs that meet in a T: z = -slope min(|y|, max(|x|, -y)).

    Ridges lie at 0, 90 and 180 degrees, valleys at 45 and 135: planes alone cannot make a T, since
    the jumps of the gradient across its three ridges would have to add up to zero.
    """

    name = "t-junction"
    summary = "perfect T-junction of three gable roofs"
    parameters = (SLOPE, EXTENT)

    def rays(self) -> list[tuple[float, float]]:
        slope = self.number("slope")
        valley = -slope * np.sqrt(0.5)
        eighths = [(0, 0.0), (1, valley), (2, 0.0), (3, valley), (4, 0.0), (6, -slope)]
        return [(turn * np.pi / 4, value) for turn, value in eighths]

    def describe(self) -> Description:
        slope = self.values["slope"]
        valley = f"-{slope}/sqrt(2)"
        return Description(
            "cone",
            rays=(
                ("0", "0"),
                ("45", valley),
                ("90", "0"),
                ("135", valley),
                ("180", "0"),
                ("270", f"-{slope}"),
            ),
        )
