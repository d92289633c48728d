"""Exact directions as a field, and the angles between two fields."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import cKDTree

from pdtheory.conventions import wavejets_table
from pdtheory.pointset.cloud import FloatArray
from pdtheory.pointset.directions import OrderDirections
from pdtheory.pointset.field import DirectionField

if TYPE_CHECKING:
    from pdtheory.exact import SurfaceJet


def field_of_jets(
    jets: Sequence[SurfaceJet], orders: Sequence[int], report: Callable[[float, str], None]
) -> DirectionField:
    """Return exact jets and their E-eigenpairs, rounded, as a direction field.

    Parameters
    ----------
    jets
        Exact jets of degree at least the largest order.
    orders
        Orders of the directions.
    report
        Called with a fraction and a text; may raise to stop.
    """
    frames = np.stack([jet.numeric_frame() for jet in jets])
    places = np.array([[float(c) for c in jet.point] for jet in jets])
    degree = min(jet.degree for jet in jets)
    pairs = wavejets_table(degree)
    nothing = np.zeros(len(jets))
    directions = {}
    for done, order in enumerate(orders):
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


def compare_fields(
    estimated: DirectionField, exact: DirectionField, linear: FloatArray
) -> list[str]:
    """Put into words how far estimated directions are from exact ones.

    Each exact direction is compared with the nearest estimated one of the same kind at the nearest
    point.

    Parameters
    ----------
    estimated
        A field of which every exact point has a point nearby.
    exact
        The exact field.
    linear : (3, 3) float64
        A similarity that takes the coordinates of the exact field to those of the estimated one.
    """
    turn = linear / np.cbrt(abs(np.linalg.det(linear)))
    finite = np.flatnonzero(np.isfinite(estimated.frames).all(axis=(1, 2)))
    _, near = cKDTree(estimated.points[finite]).query(exact.points @ linear.T)
    point = finite[near]
    lines = []
    for order in exact.orders:
        rows, truth = estimated[order], exact[order]
        angles = []
        missing = 0
        for i, vector, kind in zip(truth.point_index, truth.vector, truth.kind, strict=True):
            part = rows.at(int(point[i]))
            same = rows.vector[part][rows.kind[part] == kind]
            if not len(same):
                missing += 1
                continue
            # The chord keeps the digits that the cosine of a tiny angle loses.
            chord = np.linalg.norm(same - turn @ vector, axis=1).min()
            angles.append(2.0 * np.degrees(np.arcsin(min(1.0, chord / 2.0))))
        if angles:
            text = f"median {np.median(angles):.2g}°, worst {max(angles):.2g}°"
        else:
            text = "nothing to compare"
        lines.append(f"Order {order}: {text}" + (f", {missing} not found" if missing else ""))
    return lines
