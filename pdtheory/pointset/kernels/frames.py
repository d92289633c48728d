"""Local frames: robust centred principal axes, tilting, and the choice of t1."""

from __future__ import annotations

from typing import Any

import numpy as np

from pdtheory.pointset.kernels.jit import Array, inner
from pdtheory.pointset.kernels.lanes import LANES, Lanes, Rows, emit
from pdtheory.pointset.kernels.moments import DX, DY, DZ, WEIGHT

#: Below this ratio of the middle to the largest variance the neighbours lie on a line.
COLLINEAR = 1e-14
#: Rounds of reweighting of the principal axes.
ROUNDS = 2
#: Residual of an axis, as a fraction of the sum of the variances, that is rounding.
CONVERGED = 1e-15


@inner
def _rotate(A: Array, Q: Array, p: int, q: int, r: int) -> None:
    """Make entry (p, q) of a symmetric 3x3 matrix zero by a rotation; r is the third index."""
    between = A[p, q]
    if between == 0.0:
        return
    half = 0.5 * (A[q, q] - A[p, p])
    t = abs(between) / (abs(half) + np.sqrt(half * half + between * between))
    if (half < 0.0) != (between < 0.0):
        t = -t
    c = 1.0 / np.sqrt(t * t + 1.0)
    s = t * c
    A[p, p] -= t * between
    A[q, q] += t * between
    A[p, q] = A[q, p] = 0.0
    u = A[p, r]
    v = A[q, r]
    A[p, r] = A[r, p] = c * u - s * v
    A[q, r] = A[r, q] = s * u + c * v
    for i in range(3):
        u = Q[i, p]
        v = Q[i, q]
        Q[i, p] = c * u - s * v
        Q[i, q] = s * u + c * v


@inner
def symmetric_axes(S: Array, A: Array, Q: Array) -> None:
    """Diagonalize a symmetric 3x3 matrix by Jacobi rotations.

    `A` is left diagonal, its axes are the columns of `Q`.
    """
    for i in range(3):
        for j in range(3):
            A[i, j] = S[i, j]
            Q[i, j] = 1.0 if i == j else 0.0
    for _ in range(30):
        off = abs(A[0, 1]) + abs(A[0, 2]) + abs(A[1, 2])
        if off <= 1e-16 * (abs(A[0, 0]) + abs(A[1, 1]) + abs(A[2, 2])):
            break
        _rotate(A, Q, 0, 1, 2)
        _rotate(A, Q, 0, 2, 1)
        _rotate(A, Q, 1, 2, 0)


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
    rest = [to.constant(0.0)] * (-len(sums) % LANES)
    found = [*map(to.get, sums), *rest]
    for i in range(0, len(found), LANES):
        to.store(to.sums(found[i : i + LANES]), out.at(i))


@inner
def _sort_axes(A: Array, Q: Array) -> None:
    """Bring the axes into the order of descending variance."""
    for i, j in ((0, 1), (1, 2), (0, 1)):
        if A[i, i] < A[j, j]:
            A[i, i], A[j, j] = A[j, j], A[i, i]
            for r in range(3):
                Q[r, i], Q[r, j] = Q[r, j], Q[r, i]


@inner
def _follow_axes(S: Array, A: Array, Q: Array) -> bool:
    """Find the axes of a matrix that are close to those in `Q`, to which they go.

    The normal is an eigenvector by Rayleigh quotient iteration, whose error is cubed in each step;
    the other two axes need one rotation. The diagonal of `A` receives the variances.

    Returns
    -------
    bool
        False, and nothing is written, if the normal is not so close or not that of least variance.
    """
    r00 = r01 = r02 = r11 = r12 = r22 = 0.0
    for i in range(3):
        x = S[i, 0] * Q[0, 0] + S[i, 1] * Q[1, 0] + S[i, 2] * Q[2, 0]
        y = S[i, 0] * Q[0, 1] + S[i, 1] * Q[1, 1] + S[i, 2] * Q[2, 1]
        z = S[i, 0] * Q[0, 2] + S[i, 1] * Q[1, 2] + S[i, 2] * Q[2, 2]
        r00 += Q[i, 0] * x
        r01 += Q[i, 0] * y
        r02 += Q[i, 0] * z
        r11 += Q[i, 1] * y
        r12 += Q[i, 1] * z
        r22 += Q[i, 2] * z
    low = r22
    x = y = 0.0
    z = 1.0
    square = 1.0
    for _ in range(3):
        p = r00 - low
        q = r11 - low
        x = r01 * r12 - r02 * q
        y = r01 * r02 - r12 * p
        z = p * q - r01 * r01
        square = x * x + y * y + z * z
        if not 4.0 * (x * x + y * y) < z * z:
            return False
        low = r00 * x * x + r11 * y * y + r22 * z * z
        low = (low + 2.0 * (r01 * x * y + r02 * x * z + r12 * y * z)) / square
    size = 1.0 / np.sqrt(square)
    x *= size
    y *= size
    z *= size
    ex = (r00 - low) * x + r01 * y + r02 * z
    ey = r01 * x + (r11 - low) * y + r12 * z
    ez = r02 * x + r12 * y + (r22 - low) * z
    if not abs(ex) + abs(ey) + abs(ez) <= CONVERGED * (r00 + r11 + r22):
        return False
    # Orthogonal to the normal: one axis without a part along the first, and one nearly along it.
    size = 1.0 / np.sqrt(y * y + z * z)
    vy = z * size
    vz = -y * size
    ux = vy * z - vz * y
    uy = vz * x
    uz = -vy * x
    px = r00 * ux + r01 * uy + r02 * uz
    py = r01 * ux + r11 * uy + r12 * uz
    pz = r02 * ux + r12 * uy + r22 * uz
    along = ux * px + uy * py + uz * pz
    between = vy * py + vz * pz
    across = vy * (r11 * vy + r12 * vz) + vz * (r12 * vy + r22 * vz)
    half = 0.5 * (along - across)
    root = np.sqrt(half * half + between * between)
    middle = 0.5 * (along + across) - root
    if not low < middle:
        return False
    t = between / (abs(half) + root) if root > 0.0 else 0.0
    c = 1.0 / np.sqrt(1.0 + t * t)
    s = t * c
    A[0, 0] = middle + 2.0 * root
    A[1, 1] = middle
    A[2, 2] = low
    for i in range(3):
        first = Q[i, 0] * ux + Q[i, 1] * uy + Q[i, 2] * uz
        second = Q[i, 1] * vy + Q[i, 2] * vz
        normal = Q[i, 0] * x + Q[i, 1] * y + Q[i, 2] * z
        if half < 0.0:
            first, second = second, first
        Q[i, 0] = c * first + s * second
        Q[i, 1] = c * second - s * first
        Q[i, 2] = normal
    return True


@inner
def principal_frame(
    cloud: Array, n: int, S: Array, A: Array, Q: Array, plane: Array, sums: Array, frame: Array
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
    S, A, Q : (3, 3) float64
        Scratch.
    plane, sums : (>= 5,), (>= 10 + LANES,) float64
        Scratch.
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
        unit = 1.0 / sums[0]
        k = 4
        for i in range(3):
            for j in range(i, 3):
                S[i, j] = S[j, i] = sums[k] * unit - (sums[1 + i] * unit) * (sums[1 + j] * unit)
                k += 1
        if turn == 0 or not _follow_axes(S, A, Q):
            symmetric_axes(S, A, Q)
            _sort_axes(A, Q)
        if not A[1, 1] > COLLINEAR * A[0, 0]:
            return False
        plane[3] = 0.0
        for i in range(3):
            plane[i] = Q[i, 2]
            plane[3] += sums[1 + i] * unit * Q[i, 2]
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
