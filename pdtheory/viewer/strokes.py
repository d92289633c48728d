"""Which strokes are seen, and their lines in space."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from pdtheory.drawing.choice import Choice
from pdtheory.drawing.discs import disc_radii
from pdtheory.drawing.glyphs import REACH, GlyphData, glyph_data, spread
from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray, IntArray, PointCloud
from pdtheory.pointset.field import DirectionField

#: Points on a stroke, which follows the curvature of the surface.
_STEPS: Final = 5
#: A stroke floats so far above the surface, as a part of its length.
_LIFT: Final = 0.06
#: It is bent no farther than this part of its length, whatever the curvature.
_LARGEST_BEND: Final = 0.5

#: A disc lies so far below its point, as a part of its radius.
_SUNK: Final = 0.15


@dataclass(frozen=True)
class Strokes:
    """The directions of a field as they can be drawn.

    Attributes
    ----------
    data : GlyphData
        All directions, flat.
    points : (P, 3) float64
        The points of the field.
    """

    data: GlyphData
    points: FloatArray

    @classmethod
    def of_field(cls, field: DirectionField) -> Strokes:
        """Lay out the orders of a field.

        Raises
        ------
        InputError
            If the field holds no direction, or an order without a colour.
        """
        data = glyph_data(field)
        if not len(data):
            raise InputError(
                "the field holds no directions to show; its points were not answered, or every "
                "direction is an E-eigenvector."
            )
        return cls(data, field.points)

    def strengths(self) -> tuple[float, float]:
        """Return the 2 % and 98 % quantiles of the strengths that are not 0."""
        strength = self._column("strength")
        strength = strength[np.isfinite(strength) & (strength > 0.0)]
        if not len(strength):
            return 1e-6, 1.0
        low, high = np.quantile(strength, [0.02, 0.98])
        return float(low), float(high)

    def seen(self, choice: Choice) -> npt.NDArray[np.bool_]:
        """Return the directions that a choice shows, shape (M,).

        Where several orders are switched on the points are dealt to them in turn, so that strokes
        do not lie on top of each other.
        """
        keep = choice.passes(
            self._column("kind"), self._column("strength"), self._column("angle_std")
        )
        keep &= np.isin(self._column("order"), choice.orders)
        # The attributes are in single precision, the spots are not.
        point = self.data.attributes["point"].astype(np.int64)
        index = np.searchsorted(choice.orders, self._column("order"))
        passing = np.zeros((len(self.points), len(choice.orders)), dtype=bool)
        passing[point[keep], index[keep]] = True
        apart = self.data.spots.spacing_for(choice.strokes)
        spots = spread(self.points, passing, finest=apart)
        if choice.strokes < np.count_nonzero(self.data.spots.spacing):
            keep &= spots.spacing[point] >= apart
        turn = np.floor(spots.turn[point] * len(choice.orders)).astype(np.int64)
        return keep & (turn == index)

    def lines(self, rows: npt.NDArray[np.bool_], choice: Choice) -> FloatArray:
        """Return the chosen directions as polylines, shape (m, 5, 3).

        Parameters
        ----------
        rows : (M,) bool
            The directions.
        choice
            Decides the length, which is nearly half the distance between neighbours that carry
            strokes.
        """
        length = REACH * self.data.spots.spacing_for(choice.strokes) or REACH * self._extent()
        along = np.linspace(0.0, length, _STEPS)[None, :, None]
        limit = _LARGEST_BEND / length
        bend = np.clip(np.nan_to_num(self._column("bend")[rows]), -limit, limit)
        direction = self._column("direction")[rows][:, None, :]
        normal = self._column("surface_normal")[rows][:, None, :]
        height = _LIFT * length + bend[:, None, None] * along**2
        return self.data.position[rows][:, None, :] + along * direction + height * normal

    def _column(self, name: str) -> FloatArray:
        return np.asarray(self.data.attributes[name], dtype=np.float64)

    def _extent(self) -> float:
        span = self.data.position.max(axis=0) - self.data.position.min(axis=0)
        return float(np.linalg.norm(span)) / 50.0 or 1.0


def cells(lines: FloatArray) -> IntArray:
    """Return the connectivity of polylines of shape (m, s, 3) as VTK wants it, flat."""
    count, steps = lines.shape[:2]
    numbers = np.arange(count * steps, dtype=np.int64).reshape(count, steps)
    return np.column_stack([np.full(count, steps, dtype=np.int64), numbers]).ravel()


def discs(field: DirectionField, cloud: PointCloud | None) -> tuple[FloatArray, IntArray]:
    """Return an octagon in the tangent plane of every point, so that they hide the back.

    Parameters
    ----------
    field
        The field.
    cloud
        The points, each of which takes the plane of the nearest answered point of the field; the
        answered points themselves if it is not known.

    Returns
    -------
    points : (8 A, 3) float64
        Corners of the octagons of the A points.
    faces : (A, 8) int64
        Octagons as indices of corners.
    """
    places, frames = field.points[field.answered], field.frames[field.answered]
    centres = places
    if cloud is not None:
        centres = cloud.points
        frames = frames[cKDTree(places).query(centres)[1]]
    count = len(centres)
    size = disc_radii(centres)[:, None, None]
    turn = np.arange(8) * (np.pi / 4.0)
    circle = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    # A little below the points, or noise would bury their strokes.
    centres = centres - _SUNK * size[:, 0] * frames[:, 2]
    corners = centres[:, None, :] + size * np.einsum("ci,pij->pcj", circle, frames[:, :2])
    return corners.reshape(-1, 3), np.arange(8 * count, dtype=np.int64).reshape(-1, 8)
