"""The result of the sampled side: principal directions of several orders at many points."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, fields, replace
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from pdtheory.conventions import UNANSWERED
from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray, IntArray
from pdtheory.pointset.directions import OrderDirections
from pdtheory.pointset.npz import load_npz, save_npz

if TYPE_CHECKING:
    from pdtheory.pointset.point import PointDirections


@dataclass(frozen=True, eq=False, repr=False)
class DirectionField:
    """Principal directions of several orders at P points, with what is needed to judge them.

    Square brackets choose an order, :meth:`take` chooses points, :meth:`at` looks at one point::

        field[3].maxima.vector  # (M, 3): all of them, flat
        field[3].maxima.vectors[7]  # (n, 3): those of point 7
        field.take(slice(10, 20))  # the field of ten points
        print(field.at(7))

    Attributes
    ----------
    points : (P, 3) float64
        Where the directions were computed.
    frames : (P, 3, 3) float64
        Rows t1, t2, n of the right-handed local frame; NaN where there is none.
    radius : (P,) float64
        Neighbourhood radius R in world units.
    degree : (P,) int64
        Degree of the regression that was used (0 where there is none).
    neighbours : (P,) int64
        Number of points inside the radius, the point itself among them.
    residual_rms : (P,) float64
        Weighted root mean square of the residuals, in world units.
    condition : (P,) float64
        Smallest relative pivot of the normal equations; small is bad.
    status : (P,) int64
        Flags of :class:`pdtheory.conventions.Status`.
    phi : (P, C) complex128
        Wavejets coefficients in world units, n >= 0; NaN where there are none, 0 above a lowered
        degree.
    phi_order, phi_frequency : (C,) int64
        Order k and frequency n of each column of `phi`.
    directions : mapping of int to OrderDirections
        The directions, by order.
    """

    points: FloatArray
    frames: FloatArray
    radius: FloatArray
    degree: IntArray
    neighbours: IntArray
    residual_rms: FloatArray
    condition: FloatArray
    status: IntArray
    phi: npt.NDArray[np.complex128]
    phi_order: IntArray
    phi_frequency: IntArray
    directions: Mapping[int, OrderDirections] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.points)

    @property
    def orders(self) -> tuple[int, ...]:
        """The orders present, ascending."""
        return tuple(sorted(self.directions))

    @property
    def answered(self) -> npt.NDArray[np.bool_]:
        """(P,) whether the point has an answer."""
        return (self.status & int(UNANSWERED)) == 0

    def __getitem__(self, order: int) -> OrderDirections:
        if isinstance(order, (slice, list, tuple, np.ndarray)):
            raise InputError(
                "square brackets choose one order, as in field[3]; choose points with "
                "field.take(...)."
            )
        try:
            return self.directions[order]
        except KeyError:
            raise InputError(
                f"order {order} was not computed; this field holds the orders "
                f"{', '.join(map(str, self.orders))}."
            ) from None

    def take(self, points: slice | npt.ArrayLike) -> DirectionField:
        """Return the field of some points, all orders included.

        Parameters
        ----------
        points : slice, (P,) bool or (Q,) int array_like
            A slice, a mask, or indices in any order; negative ones count from the end.

        Returns
        -------
        DirectionField
            The Q points, in the order asked for.

        Raises
        ------
        InputError
            If a mask has another length, an index is outside the field, or it is something else.

        Examples
        --------
        >>> field.take(field.answered)  # doctest: +SKIP
        """
        index = self._indices(points)
        columns = {
            entry.name: getattr(self, entry.name)[index]
            for entry in fields(self)
            if entry.name not in NOT_BY_POINT
        }
        directions = {order: rows.take(index) for order, rows in self.directions.items()}
        return replace(self, directions=directions, **columns)

    def only(self, orders: Iterable[int]) -> DirectionField:
        """Return the field with the directions of some orders only; `phi` stays whole.

        Raises
        ------
        InputError
            If one of them was not computed.
        """
        return replace(self, directions={order: self[order] for order in orders})

    def at(self, point: int) -> PointDirections:
        """Return everything about one point; print it for a table.

        Parameters
        ----------
        point
            Its index; a negative one counts from the end.

        Raises
        ------
        InputError
            If there is no such point.
        """
        from pdtheory.pointset.point import point_directions

        if not isinstance(point, (int, np.integer)) or isinstance(point, bool):
            raise InputError(f"point {point!r} is not an index; give an integer.")
        return point_directions(self, int(self._indices([point])[0]))

    def _indices(self, points: slice | npt.ArrayLike) -> IntArray:
        count = len(self)
        if isinstance(points, slice):
            return np.arange(count)[points]
        try:
            chosen = np.asarray(points)
        except (TypeError, ValueError):
            raise InputError(
                "rows of different lengths choose nothing; give a slice, a mask or a list of "
                "indices."
            ) from None
        if chosen.ndim == 1 and chosen.dtype == np.bool_:
            if len(chosen) != count:
                raise InputError(
                    f"the mask has {len(chosen)} entries for {count} points; give one for each."
                )
            return np.flatnonzero(chosen)
        if chosen.ndim == 1 and chosen.size == 0:
            return np.zeros(0, np.int64)
        if chosen.ndim != 1 or chosen.dtype.kind not in "iu":
            raise InputError(
                f"points of type {chosen.dtype} and shape {chosen.shape} choose nothing; "
                "give a slice, a mask or a list of indices."
            )
        outside = chosen[(chosen < -count) | (chosen >= count)]
        if len(outside):
            raise InputError(
                f"there is no point {outside[0]}; the field has {count} points, counted from 0."
            )
        return np.where(chosen < 0, chosen + count, chosen).astype(np.int64)

    def coefficient(self, order: int, frequency: int) -> npt.NDArray[np.complex128]:
        """Return phi_{k,n} at every point, shape (P,); negative n gives the conjugate.

        Raises
        ------
        InputError
            If the field does not hold that coefficient.
        """
        column = np.flatnonzero((self.phi_order == order) & (self.phi_frequency == abs(frequency)))
        if len(column) == 0:
            raise InputError(
                f"phi of order {order} and frequency {frequency} is not in this field; "
                "frequencies have the parity of the order and do not exceed it."
            )
        values = self.phi[:, column[0]]
        return np.conj(values) if frequency < 0 else values

    def __repr__(self) -> str:
        orders = ", ".join(map(str, self.orders)) or "none"
        return (
            f"<DirectionField: {len(self):,} points, {int(self.answered.sum()):,} answered, "
            f"orders {orders}>"
        )

    def _repr_html_(self) -> str:
        from pdtheory.pointset.summary import field_html

        return field_html(self)

    def to_dataframe(self) -> Any:
        """Return a pandas DataFrame with a row for each direction of every order.

        Returns
        -------
        pandas.DataFrame
            The columns of the CSV format (docs/formats.md).

        Raises
        ------
        MissingDependencyError
            If pandas is not installed.
        """
        from pdtheory.pointset.convert import to_dataframe

        return to_dataframe(self)

    def to_pyvista(self) -> Any:
        """Return a PyVista mesh with one point for each direction, as in a VTP file.

        ``field.to_pyvista().glyph(orient="direction", scale="strength")`` draws arrows.

        Returns
        -------
        pyvista.PolyData
            Points with the arrays of the VTP format (docs/formats.md).

        Raises
        ------
        MissingDependencyError
            If PyVista is not installed.
        """
        from pdtheory.pointset.convert import to_pyvista

        return to_pyvista(self)

    def to_trimesh(self, *, length: float | None = None) -> Any:
        """Return the directions as coloured strokes of trimesh.

        Parameters
        ----------
        length
            Length of a stroke in world units; a third of the median radius if left out.

        Returns
        -------
        trimesh.path.Path3D
            One entity for each direction, from the point outwards, in the colour of its order;
            rows by order, then by point, then by angle.

        Raises
        ------
        InputError
            If the length is not positive and finite.
        """
        from pdtheory.pointset.convert import to_trimesh

        return to_trimesh(self, length=length)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the field as NPZ (schema 1, docs/formats.md), whole or not at all.

        Raises
        ------
        FileAccessError
            If the file cannot be written.
        """
        save_npz(self, path)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> DirectionField:
        """Read a field written by :meth:`save`, or all of a run that went to a folder.

        Raises
        ------
        FileAccessError
            If the file does not exist or cannot be read.
        FileFormatError
            If it is not a direction field, or of a newer schema.
        """
        if os.path.isdir(path):
            from pdtheory.pointset.parts import load_points

            return load_points(path)
        names = tuple(entry.name for entry in fields(cls) if entry.name != "directions")
        return cls(**load_npz(path, names))


#: What does not have one row for each point.
NOT_BY_POINT = ("directions", "phi_order", "phi_frequency")
