"""The directions of one order at many points, flat or point by point."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, overload

import numpy as np
import numpy.typing as npt

from pdtheory.conventions import Kind
from pdtheory.pointset.cloud import FloatArray, IntArray


class Ragged(Sequence[FloatArray]):
    """Rows of a flat array point by point: a sequence of P arrays of different lengths.

    Nothing is copied: ``ragged[i]`` is a view of the rows of point i, of shape (n_i,) or (n_i, 3).

    Parameters
    ----------
    flat : (M,) or (M, 3) float64
        The rows of all points, one after the other.
    offsets : (P + 1,) int64
        Where the rows of each point begin.

    Attributes
    ----------
    flat, offsets
        The parameters.

    Examples
    --------
    >>> rows = Ragged(np.array([10.0, 11.0, 30.0]), np.array([0, 2, 2, 3]))
    >>> [part.tolist() for part in rows]
    [[10.0, 11.0], [], [30.0]]
    >>> rows.padded().tolist()
    [[10.0, 11.0], [nan, nan], [30.0, nan]]
    """

    def __init__(self, flat: FloatArray, offsets: IntArray) -> None:
        self.flat = flat
        self.offsets = offsets

    @property
    def counts(self) -> IntArray:
        """(P,) number of rows of each point."""
        return np.diff(self.offsets)

    def __len__(self) -> int:
        return len(self.offsets) - 1

    @overload
    def __getitem__(self, point: int) -> FloatArray: ...
    @overload
    def __getitem__(self, point: slice) -> list[FloatArray]: ...
    def __getitem__(self, point: int | slice) -> FloatArray | list[FloatArray]:
        if isinstance(point, slice):
            return [self[i] for i in range(*point.indices(len(self)))]
        index = range(len(self))[point]
        return self.flat[self.offsets[index] : self.offsets[index + 1]]

    def __iter__(self) -> Iterator[FloatArray]:
        return (self[i] for i in range(len(self)))

    def padded(self, fill: float = np.nan) -> FloatArray:
        """Return a regular array of shape (P, n) or (P, n, 3), n the largest count.

        Parameters
        ----------
        fill
            What stands in the places that a point does not use.
        """
        counts = self.counts
        shape = (len(self), int(counts.max(initial=0)), *self.flat.shape[1:])
        result = np.full(shape, fill)
        point = np.repeat(np.arange(len(self)), counts)
        result[point, np.arange(len(self.flat)) - self.offsets[point]] = self.flat
        return result

    def __repr__(self) -> str:
        counts = self.counts
        if not len(counts):
            return "<no points>"
        low, high = int(counts.min()), int(counts.max())
        each = f"{low}" if low == high else f"{low} to {high}"
        return f"<{len(self.flat):,} rows at {len(self):,} points, {each} each>"


@dataclass(frozen=True, eq=False, repr=False)
class OrderDirections:
    """All directions of one order, flat, with CSR offsets by point.

    The directions of point i are the rows ``offsets[i]:offsets[i + 1]``, by ascending angle. Names
    in the singular are flat columns; those in the plural are the same numbers point by point.

    Attributes
    ----------
    order : int
        The order k.
    offsets : (P + 1,) int64
        Start of each point's rows.
    angle : (M,) float64
        Angle from t1 towards t2 in radians, in [0, 2 pi).
    vector : (M, 3) float64
        The unit tangent vector cos(angle) t1 + sin(angle) t2.
    eigenvalue : (M,) float64
        E-eigenvalue lambda = k! g_k(angle), in length^(1-k).
    strength : (M,) float64
        |g_k| R^(k-1), dimensionless.
    kind : (M,) int8
        +1 maximum, -1 minimum, 0 inflection of the signed g_k.
    angle_std, eigenvalue_std : (M,) float64
        Standard deviations that follow from the residuals of the fit (radians; unit of lambda).
        NaN, and not to be written to, where none were asked for.
    isotropic : (P,) bool
        True where g_k is constant to within rounding, so that every direction is an E-eigenvector
        and none is listed.
    """

    order: int
    offsets: IntArray
    angle: FloatArray
    vector: FloatArray
    eigenvalue: FloatArray
    strength: FloatArray
    kind: npt.NDArray[np.int8]
    angle_std: FloatArray
    eigenvalue_std: FloatArray
    isotropic: npt.NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.angle)

    def __repr__(self) -> str:
        return (
            f"<OrderDirections: order {self.order}, {len(self):,} directions "
            f"at {len(self.offsets) - 1:,} points>"
        )

    @property
    def point_index(self) -> IntArray:
        """(M,) index of the point that each direction belongs to."""
        return np.repeat(np.arange(len(self.offsets) - 1), np.diff(self.offsets))

    @property
    def counts(self) -> IntArray:
        """(P,) number of directions of each point."""
        return np.diff(self.offsets)

    @property
    def vectors(self) -> Ragged:
        """Unit tangent vectors point by point: ``vectors[i]`` has shape (n_i, 3)."""
        return Ragged(self.vector, self.offsets)

    @property
    def angles(self) -> Ragged:
        """Angles point by point, in radians: ``angles[i]`` has shape (n_i,)."""
        return Ragged(self.angle, self.offsets)

    @property
    def eigenvalues(self) -> Ragged:
        """E-eigenvalues point by point: ``eigenvalues[i]`` has shape (n_i,)."""
        return Ragged(self.eigenvalue, self.offsets)

    @property
    def strengths(self) -> Ragged:
        """Strengths point by point: ``strengths[i]`` has shape (n_i,)."""
        return Ragged(self.strength, self.offsets)

    def of_kind(self, kind: Kind) -> OrderDirections:
        """Return the directions of one kind only, for all points."""
        keep = self.kind == int(kind)
        running = np.concatenate(([0], np.cumsum(keep)))
        offsets = running[self.offsets].astype(np.int64)
        return self._rows(keep, offsets, self.isotropic)

    @property
    def maxima(self) -> OrderDirections:
        """The maximum principal directions."""
        return self.of_kind(Kind.MAXIMUM)

    @property
    def minima(self) -> OrderDirections:
        """The minimum principal directions."""
        return self.of_kind(Kind.MINIMUM)

    def rows_of(self, point: int) -> slice:
        """Return which rows of the flat columns belong to one point."""
        return slice(int(self.offsets[point]), int(self.offsets[point + 1]))

    def take(self, points: IntArray) -> OrderDirections:
        """Return the directions of some points, in the order of these.

        Parameters
        ----------
        points : (Q,) int64
            Indices from 0; :meth:`DirectionField.take` accepts masks and slices too.
        """
        counts = self.counts[points]
        offsets = np.concatenate(([0], np.cumsum(counts))).astype(np.int64)
        shift = np.repeat(self.offsets[points] - offsets[:-1], counts)
        return self._rows(np.arange(offsets[-1]) + shift, offsets, self.isotropic[points])

    def _rows(
        self, rows: npt.NDArray[Any], offsets: IntArray, isotropic: npt.NDArray[np.bool_]
    ) -> OrderDirections:
        columns = {name: getattr(self, name)[rows] for name in ROW_ARRAYS}
        return replace(self, offsets=offsets, isotropic=isotropic, **columns)


#: The arrays with a row for each direction.
ROW_ARRAYS = tuple(
    entry.name
    for entry in fields(OrderDirections)
    if entry.name not in ("order", "offsets", "isotropic")
)
