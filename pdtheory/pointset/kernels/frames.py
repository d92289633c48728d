"""Local frames: robust centred principal axes, tilting, and the choice of t1."""

from __future__ import annotations

from typing import Any

import numpy as np

from pdtheory.pointset.kernels.axes import Spread, follow_axes, guess_axes, sorted_axes
from pdtheory.pointset.kernels.jit import Array, inner
from pdtheory.pointset.kernels.lanes import LANES, Lanes, Rows, emit
from pdtheory.pointset.kernels.moments import DX, DY, DZ, WEIGHT

#: Below this ratio of the middle to the largest variance the neighbours lie on a line.
COLLINEAR = 1e-14
#: Rounds of reweighting of the principal axes.
ROUNDS = 2


@emit
def _sum_spread(to: Lanes, cloud: Rows, n: Any, plane: Rows, out: Rows) -> None:
    """Sum u and its products with coordinates: 1, x, y, z, xx, xy, xz, yy, yz, zz.

    u = w / (1 + d^2 scale), d being the distance from the plane (nx, ny, nz, height, scale).
    """
    nx, ny, nz, height, scale = (to.spread(to.get(plane.at(i))) for i in range(5))
    sums = [to.variable(to.constant(0.0)) for _ in range(10)]
    one = to.constant(1.0)
    with to.count(0, n, LANES) as i:
        x, y, z, w = (to.load(cloud.at(row, i)) for row in (DX, DY, DZ, WEIGHT))
        d = to.add(to.times(x, nx), to.times(y, ny))
        d = to.subtract(to.add(to.times(z, nz), d), height)
        u = to.divide(w, to.add(to.times(to.times(d, d), scale), one))
        ux, uy, uz = to.times(u, x), to.times(u, y), to.times(u, z)
        terms = [(u, one), (u, x), (u, y), (u, z), (ux, x), (ux, y), (ux, z), (uy, y), (uy, z)]
        for total, (a, b) in zip(sums, [*terms, (uz, z)], strict=True):
            to.put(to.add(to.times(a, b), to.get(total)), total)
    to.store_sums(sums, out)


@inner
def principal_frame(
    cloud: Array,
    n: int,
    A: Array,
    Q: Array,
    plane: Array,
    sums: Array,
    weights: Array,
    frame: Array,
) -> bool:
    """Write the robust principal axes of n weighted points, centred on their mean.

    The plane is fitted again `ROUNDS` times with weights w / (1 + d^2 / s^2), d being the distance
    from the plane before and s^2 its weighted mean square, so that outliers pull less.

    Parameters
    ----------
    cloud : (CLOUD_ROWS, >= n) float64
        Points relative to the origin of the frame, and their weights.
    n : int
        Number of points, a multiple of LANES.
    A, Q : (3, 3) float64
        Scratch.
    plane, sums : (>= 5,), (>= 10 + LANES,) float64
        Scratch.
    weights : (>= 4,) float64
        Receives the sums of w, w x, w y and w z.
    frame : (3, 3) float64
        Rows t1 (largest spread), t2, n: right-handed, n of either sign.

    Returns
    -------
    bool
        False if the points lie on a line or in one place.
    """
    for i in range(5):
        plane[i] = 0.0
    for turn in range(ROUNDS + 1):
        _sum_spread(cloud, n, plane, sums)
        if not sums[0] > 0.0:
            return False
        if turn == 0:
            for i in range(4):
                weights[i] = sums[i]
        unit = 1.0 / sums[0]
        x = sums[1] * unit
        y = sums[2] * unit
        z = sums[3] * unit
        S = Spread(
            sums[4] * unit - x * x,
            sums[5] * unit - x * y,
            sums[6] * unit - x * z,
            sums[7] * unit - y * y,
            sums[8] * unit - y * z,
            sums[9] * unit - z * z,
        )
        known = turn > 0 or guess_axes(S, Q)
        if not (known and follow_axes(S, A, Q)):
            sorted_axes(S, A, Q)
        if not A[1, 1] > COLLINEAR * A[0, 0]:
            return False
        plane[0] = Q[0, 2]
        plane[1] = Q[1, 2]
        plane[2] = Q[2, 2]
        plane[3] = x * Q[0, 2] + y * Q[1, 2] + z * Q[2, 2]
        if not A[2, 2] > 1e-24 * A[0, 0]:
            break
        plane[4] = 1.0 / A[2, 2]
    for i in range(3):
        frame[0, i] = Q[i, 0]
        frame[2, i] = Q[i, 2]
    complete(frame)
    return True


@inner
def complete(frame: Array) -> None:
    """Make row 0 orthogonal to row 2, both unit, and set row 1 = row 2 x row 0."""
    square = 0.0
    for i in range(3):
        square += frame[2, i] * frame[2, i]
    size = np.sqrt(square)
    along = 0.0
    for i in range(3):
        frame[2, i] /= size
        along += frame[0, i] * frame[2, i]
    square = 0.0
    for i in range(3):
        frame[0, i] -= along * frame[2, i]
        square += frame[0, i] * frame[0, i]
    size = np.sqrt(square)
    for i in range(3):
        frame[0, i] /= size
    for i in range(3):
        j = (i + 1) % 3
        k = (i + 2) % 3
        frame[1, i] = frame[2, j] * frame[0, k] - frame[2, k] * frame[0, j]


@inner
def face(frame: Array, rx: float, ry: float, rz: float) -> bool:
    """Turn the normal to the side of the reference vector; return False if that says nothing."""
    side = frame[2, 0] * rx + frame[2, 1] * ry + frame[2, 2] * rz
    if side < 0.0:
        for i in range(3):
            frame[2, i] = -frame[2, i]
            frame[1, i] = -frame[1, i]
    return side != 0.0


@inner
def tilt(frame: Array, a: float, b: float) -> None:
    """Turn the frame so that the plane z = a x + b y becomes its tangent plane."""
    for i in range(3):
        frame[2, i] -= a * frame[0, i] + b * frame[1, i]
    complete(frame)


@inner
def copy_frame(source: Array, target: Array) -> None:
    """Copy a frame; of a whole assignment Numba would also compile the words of its errors."""
    for axis in range(3):
        for i in range(3):
            target[axis, i] = source[axis, i]


@inner
def output_frame(frame: Array, out: Array) -> tuple[float, float]:
    """Write the frame with the same normal and a t1 that depends on the normal only.

    t1 is the direction of the projection of the x axis onto the tangent plane, or of the y axis
    where the normal is within 26 degrees of the x axis.

    Returns
    -------
    (float, float)
        Cosine and sine of the angle of that t1 in the old frame.
    """
    axis = 0 if abs(frame[2, 0]) <= 0.9 else 1
    for i in range(3):
        out[2, i] = frame[2, i]
        out[0, i] = 1.0 if i == axis else 0.0
    complete(out)
    c = out[0, 0] * frame[0, 0] + out[0, 1] * frame[0, 1] + out[0, 2] * frame[0, 2]
    s = out[0, 0] * frame[1, 0] + out[0, 1] * frame[1, 1] + out[0, 2] * frame[1, 2]
    size = np.sqrt(c * c + s * s)
    return c / size, s / size
