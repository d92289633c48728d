"""What every synthetic surface can do: say what it is, be meshed, be sampled."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, ClassVar, Literal

import numpy as np

from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray, IntArray, PointCloud
from synthetic_surfaces import chart as charting
from synthetic_surfaces.chart import Chart
from synthetic_surfaces.description import Description
from synthetic_surfaces.parameters import Parameters
from synthetic_surfaces.spread import OVERSAMPLING, thin
from synthetic_surfaces.truth import Site

Method = Literal["area", "blue", "grid"]
NoiseAlong = Literal["normal", "position"]

#: Outliers fill the bounding box, enlarged by this share of its size on every side.
OUTLIER_MARGIN = 0.1

#: Most points of a sample, and cells along a side of a mesh; no memory holds so many.
MOST_POINTS, MOST_CELLS = 10**12, 10**6


class Surface(ABC):
    """A surface that is known exactly.

    Parameters
    ----------
    **values
        Values of the surface's parameters, as numbers or text; defaults for the others.

    Attributes
    ----------
    name : str
        Name in the registry.
    summary : str
        One sentence.
    parameters : tuple of Parameter
        The parameters with their ranges.
    values : dict
        The exact values: Fraction, int, tuple of Fractions, or a table.

    Raises
    ------
    InputError
        If a parameter is not known or its value out of range.
    """

    name: ClassVar[str]
    summary: ClassVar[str]
    parameters: ClassVar[Parameters] = ()

    def __init__(self, **values: Any) -> None:
        known = {parameter.name: parameter for parameter in self.parameters}
        for name in values:
            if name not in known:
                has = ", ".join(known) if known else "none"
                raise InputError(f"{self.name} has no parameter {name!r}; its parameters: {has}.")
        self.values: Mapping[str, Any] = {
            name: parameter.read(values.get(name, parameter.default))
            for name, parameter in known.items()
        }
        self.check()

    def check(self) -> None:
        """Refuse values that do not go together, with an InputError; by default all do."""
        return

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value}" for name, value in self.values.items())
        return f"<{self.name}({values})>"

    def number(self, name: str) -> float:
        """Return the value of a parameter, rounded to double precision."""
        return float(self.values[name])

    @abstractmethod
    def describe(self) -> Description:
        """Return the exact description, with the values of the parameters in it."""

    @abstractmethod
    def sites(self) -> tuple[Site, ...]:
        """Return points at which the true directions are known, the most telling one first."""

    @abstractmethod
    def charts(self) -> Sequence[Chart]:
        """Return smooth charts that cover the surface once."""

    @cached_property
    def _charts(self) -> Sequence[Chart]:
        return self.charts()

    @property
    def diagonal(self) -> float:
        """Length of the diagonal of the bounding box, to which noise is relative."""
        return float(np.linalg.norm(np.ptp(self._box, axis=0)))

    @cached_property
    def _box(self) -> FloatArray:
        points = np.concatenate([part.probe_points for part in self._charts])
        return np.stack([points.min(axis=0), points.max(axis=0)])

    def mesh(self, resolution: int = 64) -> PointCloud:
        """Return a triangle mesh with exact vertices and normals.

        Parameters
        ----------
        resolution
            Cells along a side, or from the centre to the rim; 2 to 1,000,000.

        Returns
        -------
        PointCloud
            Vertices, unit normals (on a crease the mean of both sides) and triangles.

        Raises
        ------
        InputError
            If `resolution` is out of range.
        """
        if not 2 <= resolution <= MOST_CELLS:
            raise InputError(f"resolution = {resolution}; give a number from 2 to {MOST_CELLS:,}.")
        return PointCloud(*self._mesh(resolution), name=self.name)

    def sample(
        self,
        n: int,
        *,
        method: Method = "area",
        noise: float = 0.0,
        noise_along: NoiseAlong = "normal",
        outliers: float = 0.0,
        seed: int = 0,
    ) -> PointCloud:
        """Return points on the surface, with exact normals.

        Parameters
        ----------
        n
            Number of points; a grid has about as many.
        method
            ``area``: independent and uniform by area; ``blue``: spread evenly by sample
            elimination; ``grid``: a regular grid (of the plane for height functions).
        noise
            Standard deviation of Gaussian noise, in percent of the diagonal of the bounding box.
        noise_along
            ``normal``: a shift along the normal; ``position``: in each of the three coordinates.
        outliers
            Share of the points, in [0, 1), that is replaced by points spread over the bounding box
            (enlarged by a tenth), with random normals.
        seed
            Seed of all random numbers; the same seed gives the same points.

        Returns
        -------
        PointCloud
            The points; the normals are those of the surface before the noise.

        Raises
        ------
        InputError
            If a value is out of range.
        """
        self._check_sampling(n, noise, outliers, seed)
        if method not in ("area", "blue", "grid"):
            raise InputError(f"method = {method!r}; give area, blue or grid.")
        if noise_along not in ("normal", "position"):
            raise InputError(f"noise_along = {noise_along!r}; give normal or position.")
        # Separate streams: noise and outliers do not change with the way the points are drawn.
        placing, shaking, replacing = (
            np.random.default_rng(part) for part in np.random.SeedSequence(seed).spawn(3)
        )
        if method == "grid":
            points, normals = self._grid(n)
        elif method == "area":
            points, normals = self._draw(n, placing)
        else:
            points, normals = self._draw(OVERSAMPLING * n, placing)
            kept = thin(points, n)
            points, normals = points[kept], normals[kept]
        if noise > 0.0:
            sigma = 0.01 * noise * self.diagonal
            if noise_along == "normal":
                points = points + sigma * shaking.standard_normal((len(points), 1)) * normals
            else:
                points = points + sigma * shaking.standard_normal(points.shape)
        if outliers > 0.0:
            self._add_outliers(points, normals, outliers, replacing)
        return PointCloud(points, normals, name=self.name)

    def _check_sampling(self, n: int, noise: float, outliers: float, seed: int) -> None:
        if not 1 <= n <= MOST_POINTS:
            raise InputError(f"n = {n}; give a number of points from 1 to {MOST_POINTS:,}.")
        if not 0.0 <= noise < float("inf"):
            raise InputError(f"noise = {noise}; give a percentage of the diagonal, 0 or above.")
        if not 0.0 <= outliers < 1.0:
            raise InputError(f"outliers = {outliers}; give a share of the points, 0 to below 1.")
        if seed < 0:
            raise InputError(f"seed = {seed}; give 0 or a positive number.")

    def _add_outliers(
        self, points: FloatArray, normals: FloatArray, share: float, rng: np.random.Generator
    ) -> None:
        chosen = rng.choice(len(points), size=round(share * len(points)), replace=False)
        size = np.ptp(self._box, axis=0)
        low, high = self._box[0] - OUTLIER_MARGIN * size, self._box[1] + OUTLIER_MARGIN * size
        points[chosen] = rng.uniform(low, high, (len(chosen), 3))
        directions = rng.standard_normal((len(chosen), 3))
        normals[chosen] = directions / np.linalg.norm(directions, axis=1, keepdims=True)

    def _draw(self, count: int, rng: np.random.Generator) -> tuple[FloatArray, FloatArray]:
        return charting.draw(self._charts, count, rng)

    def _grid(self, count: int) -> tuple[FloatArray, FloatArray]:
        return charting.grid(self._charts, count)

    def _mesh(self, resolution: int) -> tuple[FloatArray, FloatArray, IntArray]:
        return charting.mesh(self._charts, resolution)
