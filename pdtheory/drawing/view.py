"""Where the camera stands, chosen from the shape where nothing is said."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray, PointCloud
from pdtheory.pointset.field import DirectionField
from pdtheory.pointset.trees import kd_tree

#: Rows right, back, up of the stage for each axis that may point up. The front is -y where z is up,
#: as in Blender, and +z where y is up, as in most scans.
_STAGE = {
    "x": [[0, 1, 0], [0, 0, 1], [1, 0, 0]],
    "y": [[1, 0, 0], [0, 0, -1], [0, 1, 0]],
    "z": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
}

#: Shapes flatter than this lie on the ground.
_FLAT = 0.6

#: Above this length of the mean normal a surface is seen from one side only, like a graph z(x, y).
_ONE_SIDED = 0.5


@dataclass(frozen=True)
class View:
    """Where the camera stands.

    Attributes
    ----------
    up : str
        The axis of the data that points up in the picture: ``x``, ``y`` or ``z``.
    azimuth : float
        Degrees by which the camera goes around to the right of the front.
    elevation : float
        Degrees by which it stands above the horizon, or below it where negative.

    Raises
    ------
    InputError
        If the axis is not one of the three, or an angle is out of range.
    """

    up: str = "z"
    azimuth: float = 30.0
    elevation: float = 16.0

    def __post_init__(self) -> None:
        if self.up not in _STAGE:
            raise InputError(f"the axis that points up is {self.up!r}; give x, y or z.")
        if not -90.0 <= self.elevation <= 90.0:
            raise InputError(f"the elevation is {self.elevation:g}; give -90 to 90 degrees.")
        if not np.isfinite(self.azimuth):
            raise InputError(f"the azimuth is {self.azimuth}; give degrees.")

    def axes(self) -> FloatArray:
        """Return the rows right, back, up of the stage in data coordinates, (3, 3)."""
        return np.array(_STAGE[self.up], dtype=np.float64)


def surface_points(field: DirectionField, cloud: PointCloud | None) -> FloatArray:
    """Return the (N, 3) finite points of a surface, those of the field if it is not known."""
    points = field.points if cloud is None else cloud.points
    return points[np.isfinite(points).all(axis=1)]


def on_fitted_surface(field: DirectionField) -> DirectionField:
    """Return a field whose points lie where their fits put the surface, without their noise.

    Discs at noisy points cover each other, and the strokes of half of them.
    """
    height = np.where(field.answered, field.coefficient(0, 0).real, 0.0)
    normal = np.where(field.answered[:, None], field.frames[:, 2], 0.0)
    return replace(field, points=field.points + height[:, None] * normal)


def natural_view(
    field: DirectionField,
    cloud: PointCloud | None,
    *,
    up: str | None = None,
    azimuth: float | None = None,
    elevation: float | None = None,
) -> View:
    """Choose a three-quarter view from the shape; what is given is kept.

    Graphs are seen from the side their normals point to, from below if that is the lower one; flat
    things lie down, and all else stands with y up, as scans do.

    Parameters
    ----------
    field
        The directions, with the normals of the surface.
    cloud
        The surface; that of the points of the field if it is not known.
    up, azimuth, elevation
        As in :class:`View`.

    Raises
    ------
    InputError
        If the surface has fewer than three finite points or lies elsewhere than the field, so that
        no picture shows both, or what is given is no :class:`View`.
    """
    points = surface_points(field, cloud)
    if len(points) < 3:
        raise InputError("the surface has fewer than three finite points; nothing to draw.")
    if cloud is not None:
        _refuse_apart(field, cloud)
    mean = np.nan_to_num(field.frames[:, 2]).mean(axis=0) if len(field) else np.zeros(3)
    graph = float(np.linalg.norm(mean)) > _ONE_SIDED
    extent = points.max(axis=0) - points.min(axis=0)
    thin = np.argsort(extent)
    flat = bool(extent[thin[0]] < _FLAT * extent[thin[1]])
    if up is None:
        if graph:
            up = "xyz"[int(np.argmax(np.abs(mean)))]
        elif flat:
            up = "xyz"[int(thin[0])]
        else:
            up = "y"
    view = View(up, 30.0 if azimuth is None else azimuth)
    if elevation is None:
        elevation = 42.0 if graph else 30.0 if flat else 16.0
        if graph and float(view.axes()[2] @ mean) < -_ONE_SIDED:
            elevation = -elevation
    return replace(view, elevation=elevation)


def _refuse_apart(field: DirectionField, cloud: PointCloud) -> None:
    """Refuse a surface that is nowhere within a neighbourhood of the field."""
    places = field.points[field.answered]
    if not len(places):
        return
    middles, reach = surface_points(field, cloud), 0.0
    if cloud.faces is not None:
        corners = cloud.points[cloud.faces]
        corners = corners[np.isfinite(corners).all(axis=(1, 2))]
        if len(corners):
            middles = corners.mean(axis=1)
            reach = float(np.linalg.norm(corners - middles[:, None], axis=2).max())
    # No triangle is nearer than its middle less its size.
    within = float(field.radius[field.answered].max()) + reach
    tree = kd_tree(middles)
    if np.isfinite(tree.query(places, distance_upper_bound=within)[0]).any():
        return
    apart = tree.query(places[:: max(1, len(places) // 1000)])[0].min() - reach
    here, there = (np.linalg.norm(np.ptp(x, axis=0)) for x in (places, middles))
    raise InputError(
        "the surface lies elsewhere than the points of the field: they are "
        f"{apart:.4g} apart (the field is {here:.4g} across, the surface {there:.4g}); give "
        "the surface that the directions were computed on."
    )
