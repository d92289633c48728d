"""Exact directions as a field, and the angles between two fields."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np
from scipy.spatial import cKDTree

from pdtheory.conventions import wavejets_table
from pdtheory.pointset.cloud import FloatArray, IntArray
from pdtheory.pointset.directions import OrderDirections
from pdtheory.pointset.field import DirectionField

if TYPE_CHECKING:
    from pdtheory.exact import SurfaceJet

#: An estimate this far away, in radii of its neighbourhood, counts as one at the point itself.
_NEAR: Final = 1e-3


def field_of_jets(
    jets: Sequence[SurfaceJet],
    orders: Sequence[int],
    report: Callable[[float, str], None] | None = None,
) -> DirectionField:
    """Return exact jets and their E-eigenpairs, rounded, as a direction field.

    Parameters
    ----------
    jets
        Exact jets of degree at least the largest order.
    orders
        Orders of the directions.
    report
        Called with a fraction and a text, if given; may raise to stop.
    """
    frames = np.stack([jet.numeric_frame() for jet in jets])
    places = np.array([[float(c) for c in jet.point] for jet in jets])
    degree = min(jet.degree for jet in jets)
    pairs = wavejets_table(degree)
    nothing = np.zeros(len(jets))
    directions = {}
    for done, order in enumerate(orders):
        if report is not None:
            report(done / len(orders), "exact directions")
        directions[order] = _directions(jets, frames, order)
    return DirectionField(
        points=places,
        frames=frames,
        radius=nothing + 1.0,
        degree=np.full(len(jets), degree),
        neighbours=np.zeros(len(jets), dtype=np.int64),
        residual_rms=nothing,
        condition=nothing + 1.0,
        status=np.zeros(len(jets), dtype=np.int64),
        phi=np.stack([jet.numeric_phi()[: len(pairs)] for jet in jets]),
        phi_order=np.array([k for k, _ in pairs]),
        phi_frequency=np.array([n for _, n in pairs]),
        directions=directions,
    )


def _directions(jets: Sequence[SurfaceJet], frames: FloatArray, order: int) -> OrderDirections:
    from math import factorial

    counts, angle, value, kind, isotropic = [0], [], [], [], []
    for jet in jets:
        found = jet.eigenpairs(order)
        isotropic.append(found.status != "ok")
        counts.append(len(found))
        for pair in found:
            angle.append(np.radians(float(pair.angle_degrees(17))))
            value.append(float(pair.eigenvalue_float(17)))
            kind.append(int(pair.kind))
    offsets = np.cumsum(counts)
    point = np.repeat(np.arange(len(jets)), np.diff(offsets))
    theta = np.array(angle)
    vector = (
        np.cos(theta)[:, None] * frames[point, 0] + np.sin(theta)[:, None] * frames[point, 1]
    ).reshape(-1, 3)
    values = np.array(value)
    return OrderDirections(
        order=order,
        offsets=offsets.astype(np.int64),
        angle=theta,
        vector=vector,
        eigenvalue=values,
        strength=np.abs(values) / factorial(order),
        kind=np.array(kind, dtype=np.int8),
        angle_std=np.zeros(len(theta)),
        eigenvalue_std=np.zeros(len(theta)),
        isotropic=np.array(isotropic, dtype=bool),
    )


@dataclass(frozen=True)
class Agreement:
    """How far the estimated directions of one order are from the exact ones.

    Attributes
    ----------
    order : int
        The order k.
    angle : (M,) float64
        For each exact direction at a point with an estimate the angle in radians to the nearest
        estimated one of its kind; NaN where the point has none.
    eigenvalue : (M,) float64
        The difference of their eigenvalues, over the largest exact one at the point; NaN there.
    estimated : int
        Number of estimated directions at these points.
    apart : int
        Number of exact points that have no estimate on them, and are left out.
    """

    order: int
    angle: FloatArray
    eigenvalue: FloatArray
    estimated: int
    apart: int

    def in_words(self) -> str:
        """Return the median and the worst angle, and how many were not found, as a line."""
        found = np.degrees(self.angle[np.isfinite(self.angle)])
        text = "nothing to compare"
        if len(found):
            text = f"median {np.median(found):.2g}°, worst {found.max():.2g}°"
        missing = len(self.angle) - len(found)
        return f"Order {self.order}: {text}" + (f", {missing} not found" if missing else "")


def compare_fields(
    estimated: DirectionField, exact: DirectionField, linear: FloatArray | None = None
) -> list[Agreement]:
    """Compare each exact direction with the nearest estimated one of the same kind.

    Parameters
    ----------
    estimated
        A field. Exact points that have no point of it within a thousandth of its radius are left
        out: directions turn from place to place, and that is no error.
    exact
        The exact field.
    linear : (3, 3) float64, optional
        A similarity that takes the coordinates of the exact field to those of the estimated one;
        the identity if left out.

    Returns
    -------
    list of Agreement
        One for each order of the exact field.
    """
    linear = np.eye(3) if linear is None else linear
    scale = np.cbrt(abs(np.linalg.det(linear)))
    finite = np.flatnonzero(np.isfinite(estimated.frames).all(axis=(1, 2)))
    away, near = cKDTree(estimated.points[finite]).query(exact.points @ linear.T)
    # Where nothing is found at all, the tree gives the number after the last, far away.
    near = np.append(finite, -1)[near]
    point = np.where(away <= _NEAR * estimated.radius[near], near, -1)
    return [
        _agreement(estimated[order], exact[order], point, linear / scale, scale ** (1 - order))
        for order in exact.orders
    ]


def _agreement(
    rows: OrderDirections, truth: OrderDirections, point: IntArray, turn: FloatArray, factor: float
) -> Agreement:
    """Compare one order; `point` names the estimate of each exact point, -1 if it has none."""
    value = factor * truth.eigenvalue
    largest = np.zeros(len(point))
    np.maximum.at(largest, truth.point_index, np.abs(value))
    answered = np.flatnonzero(point[truth.point_index] >= 0)
    angle = np.full(len(answered), np.nan)
    error = np.full(len(answered), np.nan)
    for row, i in enumerate(answered):
        at = truth.point_index[i]
        part = rows.rows_of(int(point[at]))
        same = np.flatnonzero(rows.kind[part] == truth.kind[i])
        if not len(same):
            continue
        # The chord keeps the digits that the cosine of a tiny angle loses.
        chord = np.linalg.norm(rows.vector[part][same] - turn @ truth.vector[i], axis=1)
        nearest = int(chord.argmin())
        angle[row] = 2.0 * np.arcsin(min(1.0, chord[nearest] / 2.0))
        error[row] = abs(rows.eigenvalue[part][same[nearest]] - value[i]) / largest[at]
    met = point[point >= 0]
    return Agreement(truth.order, angle, error, int(rows.counts[met].sum()), len(point) - len(met))
