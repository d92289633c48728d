"""The result of the sampled side: principal directions of several orders at many points."""

from __future__ import annotations

import os
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import numpy.typing as npt

from pdtheory.atomic import atomic_path
from pdtheory.conventions import Kind, Status
from pdtheory.errors import FileAccessError, FileFormatError, InputError
from pdtheory.pointset.cloud import FloatArray, IntArray

#: Version of the NPZ layout, documented in docs/formats.md.
SCHEMA = 1


@dataclass(frozen=True)
class OrderDirections:
    """All directions of one order, flat, with CSR offsets by point.

    The directions of point i are the rows ``offsets[i]:offsets[i + 1]``, by ascending angle.

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

    @property
    def point_index(self) -> IntArray:
        """(M,) index of the point that each direction belongs to."""
        return np.repeat(np.arange(len(self.offsets) - 1), np.diff(self.offsets))

    def of_kind(self, kind: Kind) -> OrderDirections:
        """Return the directions of one kind only, for all points."""
        return self._take(self.kind == int(kind))

    @property
    def maxima(self) -> OrderDirections:
        """The maximum principal directions."""
        return self.of_kind(Kind.MAXIMUM)

    @property
    def minima(self) -> OrderDirections:
        """The minimum principal directions."""
        return self.of_kind(Kind.MINIMUM)

    def at(self, point: int) -> slice:
        """Return the slice of rows that belong to one point."""
        return slice(int(self.offsets[point]), int(self.offsets[point + 1]))

    def _take(self, keep: npt.NDArray[np.bool_]) -> OrderDirections:
        running = np.concatenate(([0], np.cumsum(keep)))
        return OrderDirections(
            order=self.order,
            offsets=running[self.offsets].astype(np.int64),
            angle=self.angle[keep],
            vector=self.vector[keep],
            eigenvalue=self.eigenvalue[keep],
            strength=self.strength[keep],
            kind=self.kind[keep],
            angle_std=self.angle_std[keep],
            eigenvalue_std=self.eigenvalue_std[keep],
            isotropic=self.isotropic,
        )


@dataclass(frozen=True)
class DirectionField:
    """Principal directions of several orders at P points, with what is needed to judge them.

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

    def __getitem__(self, order: int) -> OrderDirections:
        try:
            return self.directions[order]
        except KeyError:
            raise InputError(
                f"order {order} was not computed; this field holds the orders "
                f"{', '.join(map(str, self.orders))}."
            ) from None

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

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the field as NPZ (schema 1, docs/formats.md), whole or not at all.

        Raises
        ------
        FileAccessError
            If the file cannot be written.
        """
        arrays: dict[str, npt.NDArray[np.generic]] = {
            "schema": np.array(SCHEMA),
            "status_names": np.array([f"{flag.value}:{flag.name}" for flag in Status]),
            "orders": np.array(self.orders, dtype=np.int64),
        }
        for name in _POINT_ARRAYS:
            arrays[name] = getattr(self, name)
        for order, rows in self.directions.items():
            for name in _ORDER_ARRAYS:
                arrays[f"order{order}_{name}"] = getattr(rows, name)
        with atomic_path(path) as temporary, temporary.open("wb") as stream:
            np.savez(stream, **arrays)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> DirectionField:
        """Read a field written by :meth:`save`.

        Raises
        ------
        FileAccessError
            If the file does not exist or cannot be read.
        FileFormatError
            If it is not a direction field, or of a newer schema.
        """
        source = Path(path)
        try:
            with np.load(source, allow_pickle=False) as data:
                if not isinstance(data, np.lib.npyio.NpzFile) or "schema" not in data:
                    raise FileFormatError(f"{source} is not a direction field of pdtheory.")
                if int(data["schema"]) > SCHEMA:
                    raise FileFormatError(
                        f"{source} has schema {int(data['schema'])}; this version reads up to "
                        f"{SCHEMA}, please upgrade pdtheory."
                    )
                directions = {
                    int(order): OrderDirections(
                        order=int(order),
                        **{name: data[f"order{order}_{name}"] for name in _ORDER_ARRAYS},
                    )
                    for order in data["orders"]
                }
                return cls(
                    **{name: data[name] for name in _POINT_ARRAYS},
                    directions=directions,
                )
        except FileNotFoundError as error:
            raise FileAccessError(f"no such file: {source}.") from error
        except OSError as error:
            raise FileAccessError(f"cannot read {source}: {error.strerror or error}.") from error
        except (zipfile.BadZipFile, EOFError, KeyError, ValueError) as error:
            if isinstance(error, FileFormatError):
                raise
            raise FileFormatError(
                f"{source} is not a direction field of pdtheory, or it is damaged ({error})."
            ) from error


_POINT_ARRAYS = (
    "points",
    "frames",
    "radius",
    "degree",
    "neighbours",
    "residual_rms",
    "condition",
    "status",
    "phi",
    "phi_order",
    "phi_frequency",
)
_ORDER_ARRAYS = (
    "offsets",
    "angle",
    "vector",
    "eigenvalue",
    "strength",
    "kind",
    "angle_std",
    "eigenvalue_std",
    "isotropic",
)
