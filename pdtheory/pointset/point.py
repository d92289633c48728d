"""One point of a direction field, to look at."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from math import degrees, isfinite
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from pdtheory.conventions import Kind, Status, frequencies
from pdtheory.errors import InputError
from pdtheory.pointset.cloud import FloatArray
from pdtheory.pointset.pointtext import point_html, point_text
from pdtheory.pointset.words import status_words

if TYPE_CHECKING:
    from pdtheory.plots.polar import PolarTerm
    from pdtheory.pointset.field import DirectionField

#: A constant is known if it is so many times larger than what rounding left beside it.
_ABOVE_ROUNDING = 1e3


class Direction(NamedTuple):
    """One principal direction.

    Attributes
    ----------
    order : int
        The order k.
    kind : Kind
        Maximum, minimum or inflection of the signed g_k.
    angle, angle_std : float
        Angle from t1 towards t2 and its standard deviation, in radians.
    vector : (3,) float64
        Unit tangent vector.
    eigenvalue, eigenvalue_std : float
        E-eigenvalue lambda and its standard deviation, in length^(1-k).
    strength : float
        |g_k| R^(k-1), dimensionless.
    """

    order: int
    kind: Kind
    angle: float
    angle_std: float
    vector: FloatArray
    eigenvalue: float
    eigenvalue_std: float
    strength: float


@dataclass(frozen=True, eq=False, repr=False)
class PointDirections:
    """Everything a direction field says about one point; ``print`` it for a table.

    Attributes
    ----------
    index : int
        Number of the point in its field.
    position : (3,) float64
        The point.
    frame : (3, 3) float64
        Rows t1, t2, n; NaN where there is none.
    radius : float
        Neighbourhood radius R in world units.
    degree, neighbours : int
        Degree of the regression and number of points inside the radius.
    residual_rms, condition : float
        Weighted root mean square of the residuals, and smallest relative pivot.
    status : Status
        Why the answer is missing or weaker than asked for.
    phi : mapping of (int, int) to complex
        Wavejets coefficients phi_{k,n} by (k, n), n >= 0.
    directions : mapping of int to tuple of Direction
        The directions of every order, by ascending angle.
    isotropic : tuple of int
        The orders in which every direction is an E-eigenvector and none is listed.
    """

    index: int
    position: FloatArray
    frame: FloatArray
    radius: float
    degree: int
    neighbours: int
    residual_rms: float
    condition: float
    status: Status
    phi: Mapping[tuple[int, int], complex]
    directions: Mapping[int, tuple[Direction, ...]]
    isotropic: tuple[int, ...]

    @property
    def orders(self) -> tuple[int, ...]:
        """The orders of the field, ascending."""
        return tuple(self.directions)

    def __getitem__(self, order: int) -> tuple[Direction, ...]:
        try:
            return self.directions[order]
        except KeyError:
            raise InputError(
                f"order {order} was not computed; this point holds the orders "
                f"{', '.join(map(str, self.orders))}."
            ) from None

    def __repr__(self) -> str:
        counts = ", ".join(f"{len(rows)} of order {order}" for order, rows in self._listed())
        return f"<PointDirections: point {self.index}, {counts or 'no directions'}>"

    def __str__(self) -> str:
        return point_text(self)

    def _repr_html_(self) -> str:
        return point_html(self)

    def plot(self, path: str | os.PathLike[str] | None = None) -> Any:
        """Draw g_k of every order in polar form, with the directions and their error bars.

        Parameters
        ----------
        path : path, optional
            Where to write the plot (.png, .svg or .pdf), whole or not at all.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.

        Raises
        ------
        MissingDependencyError
            If matplotlib is not installed.
        InputError
            If the point has no answer, or the suffix is another one.
        FileAccessError
            If the file cannot be written.
        """
        from pdtheory.plots.polar import polar_figure, save_figure

        title = f"point {self.index},  R = {self.radius:.4g},  degree {self.degree}"
        figure = polar_figure(self.polar_terms(), title=title)
        if path is not None:
            save_figure(figure, path)
        return figure

    def polar_terms(self) -> list[PolarTerm]:
        """Return the terms of all orders that the fit reached, as the polar plot takes them.

        They are without unit, phi_{k,n} R^(k-1), so that orders can be compared.

        Raises
        ------
        InputError
            If the point has no answer.
        """
        from pdtheory.plots.polar import PolarTerm

        if self.status.unanswered:
            raise InputError(
                f"point {self.index} has {' and '.join(status_words(self.status))}: "
                "there is nothing to plot; choose another point."
            )
        return [
            PolarTerm(
                order,
                self._row(order) * self.radius ** (order - 1),
                [(row.angle, row.kind, row.angle_std) for row in rows],
                "strength",
            )
            for order, rows in self.directions.items()
            if order <= self.degree
        ]

    def to_dict(self) -> dict[str, Any]:
        """Return everything in terms of JSON: angles in degrees, unknown numbers as None."""
        return {
            "point": self.index,
            "position": _json(self.position),
            "frame": _json(self.frame),
            "radius": self.radius,
            "degree": self.degree,
            "neighbours": self.neighbours,
            "residual_rms": _json(self.residual_rms),
            "condition": _json(self.condition),
            "status": [flag.name for flag in Status if flag & self.status],
            "isotropic": list(self.isotropic),
            "directions": [
                {
                    "order": row.order,
                    "kind": row.kind.label,
                    "angle_degrees": degrees(row.angle),
                    "angle_std_degrees": _json(degrees(row.angle_std)),
                    "vector": _json(row.vector),
                    "eigenvalue": row.eigenvalue,
                    "eigenvalue_std": _json(row.eigenvalue_std),
                    "strength": row.strength,
                }
                for rows in self.directions.values()
                for row in rows
            ],
            "phi": [
                {"order": k, "frequency": n, "re": _json(value.real), "im": _json(value.imag)}
                for (k, n), value in self.phi.items()
            ],
        }

    def _row(self, order: int) -> npt.NDArray[np.complex128]:
        """Return phi_{k,n} of one order, without the rounding where every direction is one."""
        row = np.array([self.phi[order, n] for n in frequencies(order)])
        if order in self.isotropic:
            turning = row[1:] if order % 2 == 0 else row
            # On a plane the constant is nothing else either.
            if abs(row[0]) < _ABOVE_ROUNDING * np.abs(turning).sum():
                row[0] = 0.0
            turning[:] = 0.0
        return row

    def _listed(self) -> list[tuple[int, tuple[Direction, ...]]]:
        return [(order, rows) for order, rows in self.directions.items() if rows]


def point_directions(field: DirectionField, index: int) -> PointDirections:
    """Return the point with this index, counted from 0, of a field."""
    keys = zip(field.phi_order.tolist(), field.phi_frequency.tolist(), strict=True)
    directions = {}
    for order in field.orders:
        rows = field[order]
        part = rows.rows_of(index)
        directions[order] = tuple(
            Direction(
                order,
                Kind(int(rows.kind[i])),
                float(rows.angle[i]),
                float(rows.angle_std[i]),
                rows.vector[i],
                float(rows.eigenvalue[i]),
                float(rows.eigenvalue_std[i]),
                float(rows.strength[i]),
            )
            for i in range(part.start, part.stop)
        )
    return PointDirections(
        index=index,
        position=field.points[index],
        frame=field.frames[index],
        radius=float(field.radius[index]),
        degree=int(field.degree[index]),
        neighbours=int(field.neighbours[index]),
        residual_rms=float(field.residual_rms[index]),
        condition=float(field.condition[index]),
        status=Status(int(field.status[index])),
        phi=dict(zip(keys, field.phi[index].tolist(), strict=True)),
        directions=directions,
        isotropic=tuple(order for order in field.orders if field[order].isotropic[index]),
    )


def _json(value: Any) -> Any:
    """Return a number or an array as JSON has it: what is not finite becomes None."""
    if isinstance(value, np.ndarray):
        return [_json(part) for part in value.tolist()]
    if isinstance(value, list):
        return [_json(part) for part in value]
    return value if isfinite(value) else None
