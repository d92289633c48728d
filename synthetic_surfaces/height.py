"""Height functions z = f(x, y) over a disc around the origin."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence

import numpy as np

from pdtheory.pointset.cloud import FloatArray, IntArray
from synthetic_surfaces.base import Surface
from synthetic_surfaces.chart import Chart, Evaluate, weld
from synthetic_surfaces.parameters import Parameter
from synthetic_surfaces.truth import Site

#: How far from a crease, in radians, its sides are looked at, and how far from an apex in extents.
_INSIDE = 1e-9

EXTENT = Parameter("extent", 1, "radius of the disc under the surface", 1e-6, 1e6)


class HeightSurface(Surface):
    """The graph of a function over the disc x^2 + y^2 <= extent^2, with upward normals."""

    @abstractmethod
    def height(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Return z at x, y, all of the same shape."""

    @abstractmethod
    def gradient(self, x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return dz/dx and dz/dy at x, y, all of the same shape."""

    def sites(self) -> tuple[Site, ...]:
        return (Site("origin", self.describe(), ("0", "0")),)

    @property
    def creases(self) -> tuple[float, ...]:
        """Angles in radians of rays from the origin along which the gradient jumps."""
        return ()

    def points_at(self, x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the points above x, y of shape (m,), and their unit normals, both (m, 3)."""
        dx, dy = self.gradient(x, y)
        normals = np.stack([-dx, -dy, np.ones_like(x)], axis=1)
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        return np.stack([x, y, self.height(x, y)], axis=1), normals

    def charts(self) -> Sequence[Chart]:
        """Return one chart in polar coordinates for each sector between creases."""
        return [
            Chart(self._sector(start, stop)) for start, stop in zip(*self._sectors(), strict=True)
        ]

    def _sectors(self) -> tuple[list[float], list[float]]:
        """Return the starts and ends of sectors of at most 60 degrees that end at the creases."""
        turns = sorted(angle % (2 * np.pi) for angle in self.creases) or [0.0]
        marks = []
        for start, stop in zip(turns, [*turns[1:], turns[0] + 2 * np.pi], strict=True):
            pieces = max(1, int(np.ceil((stop - start) / (np.pi / 3) - 1e-9)))
            marks += [start + (stop - start) * piece / pieces for piece in range(pieces)]
        return marks, [*marks[1:], marks[0] + 2 * np.pi]

    def _sector(self, start: float, stop: float) -> Evaluate:
        extent = self.number("extent")

        def evaluate(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
            angle = start + (stop - start) * v
            cosine, sine = np.cos(angle), np.sin(angle)
            x, y = extent * u * cosine, extent * u * sine
            slope_x, slope_y = self._inner_gradient(start, stop, extent * u, angle)
            along_x, along_y = extent * cosine, extent * sine
            across_x, across_y = -(stop - start) * y, (stop - start) * x
            return (
                np.stack([x, y, self.height(x, y)], axis=1),
                np.stack([along_x, along_y, along_x * slope_x + along_y * slope_y], axis=1),
                np.stack([across_x, across_y, across_x * slope_x + across_y * slope_y], axis=1),
            )

        return evaluate

    def _inner_gradient(
        self, start: float, stop: float, radius: FloatArray, angle: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the gradient on this side of the sector's edges, and near the apex."""
        inner = np.clip(angle, start + _INSIDE, stop - _INSIDE)
        away = np.maximum(radius, _INSIDE * self.number("extent"))
        return self.gradient(away * np.cos(inner), away * np.sin(inner))

    def _grid(self, count: int) -> tuple[FloatArray, FloatArray]:
        extent = self.number("extent")
        half = round(np.sqrt(count / np.pi))
        ticks = np.arange(-half, half + 1) * (extent * np.sqrt(np.pi / count))
        x, y = (part.ravel() for part in np.meshgrid(ticks, ticks, indexing="ij"))
        inside = x**2 + y**2 <= extent**2
        return self.points_at(x[inside], y[inside])

    def _mesh(self, resolution: int) -> tuple[FloatArray, FloatArray, IntArray]:
        """Cut each sector into near-equilateral triangles, so that creases are edges."""
        ring = np.repeat(np.arange(resolution + 1), np.arange(1, resolution + 2))
        first = np.cumsum(np.arange(resolution + 1))
        place = np.arange(len(ring)) - first[ring]
        inner = ring < resolution
        corner, below = np.flatnonzero(inner), first[ring[inner] + 1] + place[inner]
        upward = np.stack([corner, below, below + 1], axis=1)
        between = inner & (place < ring)
        corner, below = np.flatnonzero(between), first[ring[between] + 1] + place[between]
        faces = np.concatenate([upward, np.stack([corner, below + 1, corner + 1], axis=1)])
        radius = self.number("extent") * ring / resolution
        points, normals, triangles = [], [], []
        for index, (start, stop) in enumerate(zip(*self._sectors(), strict=True)):
            angle = start + (stop - start) * place / np.maximum(ring, 1)
            x, y = radius * np.cos(angle), radius * np.sin(angle)
            dx, dy = self._inner_gradient(start, stop, radius, angle)
            normal = np.stack([-dx, -dy, np.ones_like(dx)], axis=1)
            points.append(np.stack([x, y, self.height(x, y)], axis=1))
            normals.append(normal / np.linalg.norm(normal, axis=1, keepdims=True))
            triangles.append(faces + index * len(ring))
        return weld(np.concatenate(points), np.concatenate(normals), np.concatenate(triangles))
