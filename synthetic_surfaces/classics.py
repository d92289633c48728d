"""The classics of differential geometry, as parametric charts with implicit forms."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, ClassVar

import numpy as np

from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray
from synthetic_surfaces.base import Surface
from synthetic_surfaces.chart import Chart, Evaluate, from_map
from synthetic_surfaces.description import Description
from synthetic_surfaces.parameters import Parameter, Parameters
from synthetic_surfaces.truth import Site

#: (u, v) of shape (m,), real or complex, to unit vectors (m, 3).
Direction = Callable[[Any, Any], Any]


def cube_directions() -> list[Direction]:
    """Return six maps of the unit square to directions: the faces of a cube, seen from its centre.

    Equal steps are equal angles along the middle lines of a face, which keeps cells of one size.
    """

    def face(normal: FloatArray, first: FloatArray, second: FloatArray) -> Direction:
        def direction(u: Any, v: Any) -> Any:
            a, b = np.tan((u - 0.5) * np.pi / 2)[:, None], np.tan((v - 0.5) * np.pi / 2)[:, None]
            return (normal + a * first + b * second) / np.sqrt(1 + a**2 + b**2)

        return direction

    unit = np.eye(3)
    return [
        face(sign * unit[i], unit[(i + 1) % 3], sign * unit[(i + 2) % 3])
        for i in range(3)
        for sign in (1.0, -1.0)
    ]


class Plane(Surface):
    """A square of the plane z = 0."""

    name = "plane"
    summary = "square of the plane z = 0, isotropic in every order"
    parameters: ClassVar[Parameters] = (Parameter("side", 2, "side of the square", 1e-6, 1e6),)

    def describe(self) -> Description:
        return Description("implicit", ("z",))

    def sites(self) -> tuple[Site, ...]:
        return (Site("centre", self.describe(), ("0", "0", "0")),)

    def charts(self) -> Sequence[Chart]:
        side = self.number("side")

        def position(u: Any, v: Any) -> Any:
            return np.stack([side * (u - 0.5), side * (v - 0.5), 0 * u], axis=1)

        return [Chart(from_map(position))]


class Ellipsoid(Surface):
    """The ellipsoid (x/a)^2 + (y/b)^2 + (z/c)^2 = 1."""

    name = "ellipsoid"
    summary = "ellipsoid (x/a)^2 + (y/b)^2 + (z/c)^2 = 1"
    parameters: ClassVar[Parameters] = (
        Parameter("a", "3/2", "semi-axis along x", 1e-6, 1e6),
        Parameter("b", 1, "semi-axis along y", 1e-6, 1e6),
        Parameter("c", "3/4", "semi-axis along z", 1e-6, 1e6),
    )

    def axes(self) -> tuple[str, str, str]:
        """Return the exact semi-axes as text."""
        return str(self.values["a"]), str(self.values["b"]), str(self.values["c"])

    def describe(self) -> Description:
        parts = (f"({x}/({axis}))**2" for x, axis in zip("xyz", self.axes(), strict=True))
        return Description("implicit", (" + ".join(parts) + " - 1",))

    def sites(self) -> tuple[Site, ...]:
        return (Site("tip on x", self.describe(), (self.axes()[0], "0", "0")),)

    def charts(self) -> Sequence[Chart]:
        """Return the six faces of a cube, blown up to the ellipsoid: no poles."""
        axes = np.array([self.number(name) for name in self._axis_names()])

        def stretch(direction: Direction) -> Evaluate:
            return from_map(lambda u, v: axes * direction(u, v))

        return [Chart(stretch(direction)) for direction in cube_directions()]

    def _axis_names(self) -> tuple[str, str, str]:
        return ("a", "b", "c")


class Sphere(Ellipsoid):
    """A sphere around the origin."""

    name = "sphere"
    summary = "sphere, isotropic in every order"
    parameters: ClassVar[Parameters] = (Parameter("radius", 1, "radius", 1e-6, 1e6),)

    def axes(self) -> tuple[str, str, str]:
        radius = str(self.values["radius"])
        return radius, radius, radius

    def _axis_names(self) -> tuple[str, str, str]:
        return ("radius", "radius", "radius")


class Cylinder(Surface):
    """An open circular cylinder around the z axis."""

    name = "cylinder"
    summary = "open circular cylinder around the z axis"
    parameters: ClassVar[Parameters] = (
        Parameter("radius", 1, "radius", 1e-6, 1e6),
        Parameter("length", 2, "length", 1e-6, 1e6),
    )

    def describe(self) -> Description:
        return Description("implicit", (f"x**2 + y**2 - ({self.values['radius']})**2",))

    def sites(self) -> tuple[Site, ...]:
        return (Site("side", self.describe(), (str(self.values["radius"]), "0", "0")),)

    def charts(self) -> Sequence[Chart]:
        radius, length = self.number("radius"), self.number("length")

        def position(u: Any, v: Any) -> Any:
            angle = 2 * np.pi * u
            return np.stack(
                [radius * np.cos(angle), radius * np.sin(angle), length * (v - 0.5)], axis=1
            )

        return [Chart(from_map(position), (2.0, max(0.1, length / (np.pi * radius))))]


class Torus(Surface):
    """A torus around the z axis."""

    name = "torus"
    summary = "torus around the z axis"
    parameters: ClassVar[Parameters] = (
        Parameter("major", 1, "radius of the centre circle", 1e-6, 1e6),
        Parameter("minor", "2/5", "radius of the tube, below the major one", 1e-6, 1e6),
    )

    def check(self) -> None:
        if self.values["minor"] >= self.values["major"]:
            raise InputError(
                f"torus: minor = {self.values['minor']} is not below major = "
                f"{self.values['major']}; the tube would cut itself."
            )

    def describe(self) -> Description:
        major, minor = self.values["major"], self.values["minor"]
        square = f"(x**2 + y**2 + z**2 + ({major})**2 - ({minor})**2)**2"
        return Description("implicit", (f"{square} - 4*({major})**2*(x**2 + y**2)",))

    def sites(self) -> tuple[Site, ...]:
        major, minor = self.values["major"], self.values["minor"]
        return (
            Site("outer equator", self.describe(), (str(major + minor), "0", "0")),
            Site("inner equator", self.describe(), (str(major - minor), "0", "0")),
            Site("top", self.describe(), (str(major), "0", str(minor))),
        )

    def charts(self) -> Sequence[Chart]:
        major, minor = self.number("major"), self.number("minor")

        def position(u: Any, v: Any) -> Any:
            around, tube = 2 * np.pi * u, 2 * np.pi * v
            ring = major + minor * np.cos(tube)
            return np.stack(
                [ring * np.cos(around), ring * np.sin(around), minor * np.sin(tube)], axis=1
            )

        return [Chart(from_map(position), (2.0, max(0.1, 2 * minor / major)))]


class Enneper(Surface):
    """Enneper's minimal surface over a square of its parameters."""

    name = "enneper"
    summary = "Enneper's minimal surface, order-2 trace zero"
    parameters: ClassVar[Parameters] = (
        Parameter(
            "size", "4/5", "half side of the parameter square; it cuts itself above 1", 0.01, 2
        ),
    )

    def describe(self) -> Description:
        return Description(
            "parametric",
            ("u - u**3/3 + u*v**2", "-v + v**3/3 - v*u**2", "u**2 - v**2"),
        )

    def sites(self) -> tuple[Site, ...]:
        return (Site("u = 1/4, v = 1/8", self.describe(), ("1/4", "1/8")),)

    def charts(self) -> Sequence[Chart]:
        size = self.number("size")

        def position(u: Any, v: Any) -> Any:
            p, q = size * (2 * u - 1), size * (2 * v - 1)
            return np.stack(
                [p - p**3 / 3 + p * q**2, -q + q**3 / 3 - q * p**2, p**2 - q**2], axis=1
            )

        return [Chart(from_map(position))]
