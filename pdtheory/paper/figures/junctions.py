"""Fits at the apex of cones, against the exact prediction for dense samples."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pdtheory.paper.figures.measure import angles_of, worst_angle
from pdtheory.paper.figures.outcome import Check, at_most, equal
from pdtheory.pointset import estimate_directions
from pdtheory.pointset.cloud import FloatArray
from pdtheory.pointset.field import DirectionField
from synthetic_surfaces import Surface

#: Degree of the fits.
DEGREE = 10


def fit_apex(surface: Surface, orders: Sequence[int], count: int) -> DirectionField:
    """Fit a cone at its apex, over the whole disc under it.

    Samples on a planar grid with weights by the planar distance are what the closed-form prediction
    of a cone assumes.

    Parameters
    ----------
    surface
        A cone over a disc.
    orders
        The orders wanted.
    count
        Number of samples.
    """
    cloud = surface.sample(count, method="grid")
    return estimate_directions(
        cloud.points,
        normals=np.tile([0.0, 0.0, 1.0], (len(cloud), 1)),
        radius=surface.number("extent"),
        degree=DEGREE,
        orders=orders,
        frame="given",
        weight_distance="planar",
        queries=np.zeros((1, 3)),
    )


def compare(
    surface: Surface, field: DirectionField, tolerance: float
) -> tuple[list[Check], dict[int, FloatArray], dict[int, int]]:
    """Compare a fit at the apex with the exact prediction.

    Parameters
    ----------
    surface
        A cone over a disc of radius R.
    field
        Its fit, from :func:`fit_apex`.
    tolerance
        Largest error of phi_{k,n} R^(k-1), relative to the largest coefficient of the order, or to
        the slope of the cone where the order vanishes.

    Returns
    -------
    checks
        One check of the coefficients and one of the number of maxima for each order.
    angles
        The predicted angles of the maxima in radians, by order.
    counts
        The number of maxima on the samples, by order.
    """
    site = surface.sites()[0]
    exact = site.prediction(DEGREE, field.orders, radius=surface.values["extent"])
    turn = np.arctan2(field.frames[0, 0, 1], field.frames[0, 0, 0])
    because = f"the exact fit of degree {DEGREE} to the cone"
    checks, angles, counts = [], {}, {}
    for order in field.orders:
        row = exact.row(order)
        values = row.to_complex()
        size = max(abs(value) for value in values.values())
        worst = max(
            abs(field.coefficient(order, n)[0] * np.exp(-1j * n * turn) - value)
            for n, value in values.items()
        )
        checks.append(
            at_most(
                f"order {order}: relative error of phi", worst / (size or 1.0), tolerance, because
            )
        )
        vector = field[order].maxima.vector
        found = np.sort(np.arctan2(vector[:, 1], vector[:, 0]) % (2 * np.pi))
        counts[order] = len(found)
        angles[order] = angles_of(exact.eigenpairs(order).maxima)
        if size:
            expected = angles[order]
            checks.append(
                equal(f"order {order}: number of maxima", len(found), len(expected), because)
            )
            if len(found) == len(expected):
                checks.append(
                    at_most(f"order {order}: worst angle of the maxima in degrees",
                            worst_angle(found, expected), 0.5, because)
                )  # fmt: skip
    return checks, angles, counts
