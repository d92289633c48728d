"""Weights of the points around a query, and their coordinates in a local frame."""

from __future__ import annotations

from typing import Any

from pdtheory.pointset.kernels.jit import Array, inner
from pdtheory.pointset.kernels.lanes import LANES, Lanes, Rows, emit
from pdtheory.pointset.kernels.moments import DX, DY, DZ, SQUARED, WEIGHT, X, Y, Z

#: Squared distance, in units of the radius, of what fills up a vector.
OUTSIDE = 2.0


@emit
def weigh(to: Lanes, cloud: Rows, n: Any) -> float:
    """Write exp(-9 rho^2 / 2) for squared distances rho^2 <= 1, and 0 beyond; count the former.

    The exponential is the 64th power of its Taylor polynomial at 1/64 of the argument, where eight
    terms reach rounding.
    """
    zero, one = to.constant(0.0), to.constant(1.0)
    inside = to.variable(zero)
    with to.count(0, n, LANES) as i:
        squared = to.load(cloud.at(SQUARED, i))
        t = to.times(squared, to.constant(-4.5 / 64.0))
        value = one
        for k in range(8, 0, -1):
            value = to.add(to.times(to.times(t, to.constant(1.0 / k)), value), one)
        for _ in range(6):
            value = to.times(value, value)
        near = to.builder.fcmp_ordered("<=", squared, one)
        to.store(to.builder.select(near, value, zero), cloud.at(WEIGHT, i))
        to.put(to.add(to.get(inside), to.builder.select(near, one, zero)), inside)
    return to.lane(to.sums([to.get(inside)]), 0)


@emit
def _square_in_plane(to: Lanes, cloud: Rows, n: Any, frame: Rows) -> None:
    """Replace the squared distances by those in the plane of the frame."""
    axes = [[to.spread(to.get(frame.at(r, k))) for k in range(3)] for r in range(2)]
    with to.count(0, n, LANES) as i:
        p = [to.load(cloud.at(row, i)) for row in (DX, DY, DZ)]
        x, y = (_dot(to, p, axis) for axis in axes)
        to.store(to.add(to.times(x, x), to.times(y, y)), cloud.at(SQUARED, i))


@emit
def _sum_weights(to: Lanes, cloud: Rows, n: Any, out: Rows) -> None:
    """Sum w, w x, w y and w z."""
    totals = [to.variable(to.constant(0.0)) for _ in range(4)]
    with to.count(0, n, LANES) as i:
        w, *p = (to.load(cloud.at(row, i)) for row in (WEIGHT, DX, DY, DZ))
        for total, value in zip(totals, (to.constant(1.0), *p), strict=True):
            to.put(to.add(to.times(w, value), to.get(total)), total)
    to.store_sums(totals, out)


@emit
def _turn_into(to: Lanes, cloud: Rows, n: Any, frame: Rows, cx: Any, cy: Any) -> None:
    """Write the coordinates in the frame, x and y about a centre."""
    axes = [[to.spread(to.get(frame.at(r, k))) for k in range(3)] for r in range(3)]
    centre = (to.spread(cx), to.spread(cy), to.constant(0.0))
    with to.count(0, n, LANES) as i:
        p = [to.load(cloud.at(row, i)) for row in (DX, DY, DZ)]
        for row, axis, middle in zip((X, Y, Z), axes, centre, strict=True):
            to.store(to.subtract(_dot(to, p, axis), middle), cloud.at(row, i))


def _dot(to: Lanes, p: list[Any], axis: list[Any]) -> Any:
    total = to.times(p[0], axis[0])
    for a, b in zip(p[1:], axis[1:], strict=True):
        total = to.add(to.times(a, b), total)
    return total


@inner
def project(cloud: Array, points: int, n: int, planar: bool, w: Any) -> tuple[float, float, float]:
    """Write local coordinates, x and y centred on their weighted mean, and the weights if planar.

    ``w.weights`` holds the sums of w, w x, w y and w z in the axes of the world.

    Returns
    -------
    (float, float, float)
        The mean (cx, cy) and the sum of the weights.
    """
    if planar:
        _square_in_plane(cloud, n, w.frame)
        for i in range(points, n):
            cloud[SQUARED, i] = OUTSIDE
        weigh(cloud, n)
        _sum_weights(cloud, n, w.weights)
    total = w.weights[0]
    cx = 0.0
    cy = 0.0
    for i in range(3):
        cx += w.weights[1 + i] * w.frame[0, i]
        cy += w.weights[1 + i] * w.frame[1, i]
    cx /= total
    cy /= total
    _turn_into(cloud, n, w.frame, cx, cy)
    return cx, cy, total
