"""Measures that several figures check: independent of how the directions were found."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import factorial
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from pdtheory.conventions import frequencies
from pdtheory.errors import ComputationError
from pdtheory.pointset.cloud import FloatArray, PointCloud
from pdtheory.pointset.directions import OrderDirections
from pdtheory.pointset.field import DirectionField
from synthetic_surfaces import Surface

TURN: Final = 2.0 * np.pi


def eigen_residual(field: DirectionField, order: int) -> float:
    """Return the largest |T v^(k-1) - lambda v| of all listed directions, relative to |lambda|.

    T v^(k-1) is the gradient of the form divided by k, computed from phi as a polynomial in
    w = x + i y and its conjugate, so that nothing of the search for the angles enters.

    Parameters
    ----------
    field
        Directions.
    order
        The order k.

    Returns
    -------
    float
        The largest residual; relative to the largest |lambda| of the same point. 0 if none is
        listed.
    """
    rows = field[order]
    if not len(rows):
        return 0.0
    point = rows.point_index
    w = np.exp(1j * rows.angle)
    # With f = sum c w^a conj(w)^b over n = a - b of both signs, f_x + i f_y = 2 df/dconj(w).
    slope = np.zeros(len(rows), dtype=complex)
    for n in frequencies(order):
        phi = field.coefficient(order, n)[point] * factorial(order)
        up, down = (order + n) // 2, (order - n) // 2
        slope += 2 * phi * down * w**up * np.conj(w) ** max(down - 1, 0)
        if n:
            slope += 2 * np.conj(phi) * up * w**down * np.conj(w) ** (up - 1)
    scale = np.zeros(len(field))
    np.maximum.at(scale, point, np.abs(rows.eigenvalue))
    return float(np.max(np.abs(slope / order - rows.eigenvalue * w) / scale[point]))


def anisotropy(field: DirectionField, order: int) -> FloatArray:
    """Return the amplitude of what depends on the angle in g_k, times R^(k-1), at each point."""
    rows = field[order]
    highest, lowest = np.full(len(field), -np.inf), np.full(len(field), np.inf)
    np.maximum.at(highest, rows.point_index, rows.eigenvalue)
    np.minimum.at(lowest, rows.point_index, rows.eigenvalue)
    swing = np.where(np.isfinite(highest), (highest - lowest) / 2, 0.0)
    return np.asarray(swing / factorial(order) * field.radius ** (order - 1))


def angles_in(
    rows: OrderDirections, point: int, first: npt.ArrayLike, second: npt.ArrayLike
) -> FloatArray:
    """Return the angles of a point's directions in a given tangent frame, ascending in [0, 2 pi).

    Parameters
    ----------
    rows
        Directions of one order.
    point
        Index of the point.
    first, second : (3,) array_like
        The axes from which and towards which angles run.
    """
    vectors = rows.vectors[point]
    return np.sort(np.arctan2(vectors @ np.asarray(second), vectors @ np.asarray(first)) % TURN)


def circular_distance(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return for each angle in `a` the distance to the nearest angle in `b`, in degrees."""
    if not len(b):
        return np.full(len(a), 180.0)
    gap = np.abs((np.asarray(a)[:, None] - np.asarray(b)[None, :] + np.pi) % TURN - np.pi)
    return np.degrees(gap.min(axis=1))


def worst_angle(found: FloatArray, expected: FloatArray) -> float:
    """Return the largest distance in degrees between two sets of angles; 180 if counts differ."""
    if len(found) != len(expected):
        return 180.0
    both = (circular_distance(found, expected), circular_distance(expected, found))
    return float(max(part.max(initial=0.0) for part in both))


def turned(first: OrderDirections, second: OrderDirections) -> FloatArray:
    """Return how far the strongest maximum of `first` is from the nearest maximum of `second`.

    Parameters
    ----------
    first, second
        Directions of one order at the same points.

    Returns
    -------
    (N,) float64
        Degrees, at the points where `first` has a maximum; 180 where `second` has none.
    """
    a, b = first.maxima, second.maxima
    result = []
    for point in np.flatnonzero(a.counts):
        mine, others = a.vectors[int(point)], b.vectors[int(point)]
        if not len(others):
            result.append(180.0)
            continue
        strongest = mine[np.argmax(a.strengths[int(point)])]
        result.append(float(np.degrees(np.arccos(np.clip(np.max(others @ strongest), -1, 1)))))
    return np.array(result)


def angles_of(pairs: Iterable[Any]) -> FloatArray:
    """Return the angles of exact E-eigenpairs in radians, ascending."""
    return np.sort(np.radians([float(pair.angle_degrees()) for pair in pairs]))


def exact_rows(surface: Surface, orders: Sequence[int]) -> dict[int, Any]:
    """Return the exact Wavejets rows of a height function at the origin, where it is flat.

    Parameters
    ----------
    surface
        A synthetic surface whose description is a height with vanishing gradient at the origin.
    orders
        The orders.
    """
    import sympy as sp

    from pdtheory.exact import parse_expression, taylor_forms

    description = surface.describe()
    expression = parse_expression(description.expressions[0], description.variables)
    forms = taylor_forms(expression, sp.symbols("x y"), max(orders))
    if not forms[1].is_zero:
        raise ComputationError(f"{surface.name} is not flat at the origin; tilt it first.")
    return {order: forms[order].row for order in orders}


def refit(field: DirectionField, cloud: PointCloud, point: int) -> dict[tuple[int, int], complex]:
    """Fit the neighbourhood of one point again, by orthogonal factorization of a plain matrix.

    An independent computation of phi with NumPy alone: monomials in the field's frame and radius,
    weights exp(-9 rho^2 / 2) by distance in space, no moments, no normal equations.

    Parameters
    ----------
    field
        Where the frame, the radius and the degree come from.
    cloud
        The samples that `field` was estimated from.
    point
        Index of the point in the field.

    Returns
    -------
    dict of (int, int) to complex
        phi_{k,n} for n >= 0.
    """
    radius, degree = field.radius[point], int(field.degree[point])
    offset = cloud.points - field.points[point]
    distance = np.linalg.norm(offset, axis=1)
    inside = distance <= radius
    x, y, z = (offset[inside] @ field.frames[point].T / radius).T
    root = np.exp(-2.25 * (distance[inside] / radius) ** 2)
    powers = [(k - j, j) for k in range(degree + 1) for j in range(k + 1)]
    matrix = np.stack([x**i * y**j for i, j in powers], axis=1)
    solution = np.linalg.lstsq(matrix * root[:, None], z * root, rcond=None)[0]
    result = {}
    for k in range(degree + 1):
        terms = [(i, j, c) for (i, j), c in zip(powers, solution, strict=True) if i + j == k]
        for n in frequencies(k):
            # Average of the term times e^{-i n t} over the circle, exact for this many angles.
            t = TURN * np.arange(2 * k + 1) / (2 * k + 1)
            value = sum(c * np.cos(t) ** i * np.sin(t) ** j for i, j, c in terms)
            result[k, n] = complex(np.mean(value * np.exp(-1j * n * t)) * radius ** (1 - k))
    return result


def refit_difference(field: DirectionField, cloud: PointCloud) -> float:
    """Return the largest difference of phi between a field and :func:`refit`, at answered points.

    Each coefficient is taken times R^(k-1), which makes it a slope; the orders of the field count.
    """
    worst = 0.0
    for point in np.flatnonzero(field.degree > 0):
        again = refit(field, cloud, int(point))
        for order in field.orders:
            for n in frequencies(order):
                gap = abs(field.coefficient(order, n)[point] - again[order, n])
                worst = max(worst, float(gap * field.radius[point] ** (order - 1)))
    return worst
