"""Axes of least and largest variance of a symmetric 3x3 matrix of covariances."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from pdtheory.pointset.kernels.jit import Array, inner

#: Residual of an axis, as a fraction of the sum of the variances, that is rounding.
CONVERGED = 1e-15
#: Steps towards an axis that is a few degrees away; after two, a point in six is not there.
STEPS = 3


class Spread(NamedTuple):
    """A symmetric 3x3 matrix: the covariances of x, y and z."""

    xx: float
    xy: float
    xz: float
    yy: float
    yz: float
    zz: float


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
def sorted_axes(S: Spread, A: Array, Q: Array) -> None:
    """Diagonalize a matrix by Jacobi rotations.

    `A` is left diagonal, variances descending, and its axes are the columns of `Q`.
    """
    A[0, 0] = S.xx
    A[1, 1] = S.yy
    A[2, 2] = S.zz
    A[0, 1] = A[1, 0] = S.xy
    A[0, 2] = A[2, 0] = S.xz
    A[1, 2] = A[2, 1] = S.yz
    for i in range(3):
        for j in range(3):
            Q[i, j] = 1.0 if i == j else 0.0
    for _ in range(30):
        off = abs(A[0, 1]) + abs(A[0, 2]) + abs(A[1, 2])
        if off <= 1e-16 * (abs(A[0, 0]) + abs(A[1, 1]) + abs(A[2, 2])):
            break
        _rotate(A, Q, 0, 1, 2)
        _rotate(A, Q, 0, 2, 1)
        _rotate(A, Q, 1, 2, 0)
    for i, j in ((0, 1), (1, 2), (0, 1)):
        if A[i, i] < A[j, j]:
            A[i, i], A[j, j] = A[j, j], A[i, i]
            for r in range(3):
                Q[r, i], Q[r, j] = Q[r, j], Q[r, i]


@inner
def guess_axes(S: Spread, Q: Array) -> bool:
    """Write orthogonal axes, the last about that of least variance, to the columns of `Q`.

    In the adjugate matrix an axis counts as much as the product of the other two variances, so the
    longest of its columns points along the normal.

    Returns
    -------
    bool
        False, and nothing is written, if the points lie about a line.
    """
    xx = S.yy * S.zz - S.yz * S.yz
    yy = S.xx * S.zz - S.xz * S.xz
    zz = S.xx * S.yy - S.xy * S.xy
    xy = S.xz * S.yz - S.xy * S.zz
    xz = S.xy * S.yz - S.xz * S.yy
    yz = S.xy * S.xz - S.xx * S.yz
    x, y, z = xz, yz, zz
    if xx > yy and xx > zz:
        x, y, z = xx, xy, xz
    elif yy > zz:
        x, y, z = xy, yy, yz
    square = x * x + y * y + z * z
    total = S.xx + S.yy + S.zz
    total *= total
    if not square > 1e-16 * total * total:
        return False
    size = 1.0 / np.sqrt(square)
    if z < 0.0:
        size = -size
    x *= size
    y *= size
    z *= size
    # The axes of the coordinates, turned about one in the plane z = 0 so that z goes to (x, y, z).
    turn = -1.0 / (1.0 + z)
    Q[0, 0] = 1.0 + x * x * turn
    Q[1, 0] = Q[0, 1] = x * y * turn
    Q[1, 1] = 1.0 + y * y * turn
    Q[2, 0] = -x
    Q[2, 1] = -y
    Q[0, 2] = x
    Q[1, 2] = y
    Q[2, 2] = z
    return True


@inner
def _times(S: Spread, x: float, y: float, z: float) -> tuple[float, float, float]:
    """Return the product of a matrix and a vector."""
    return (
        S.xx * x + S.xy * y + S.xz * z,
        S.xy * x + S.yy * y + S.yz * z,
        S.xz * x + S.yz * y + S.zz * z,
    )


@inner
def follow_axes(S: Spread, A: Array, Q: Array) -> bool:
    """Find the axes of a matrix that are close to those in `Q`, to which they go.

    The normal is an eigenvector by Rayleigh quotient iteration, whose error is cubed in each step;
    the other two axes need one rotation.

    Parameters
    ----------
    S : Spread
        The matrix.
    A : (3, 3) float64
        Its diagonal receives the variances.
    Q : (3, 3) float64
        Orthogonal columns; receives the axes, by descending variance.

    Returns
    -------
    bool
        False, and nothing is written, if the normal is not so close or not that of least variance.
    """
    q00 = Q[0, 0]
    q10 = Q[1, 0]
    q20 = Q[2, 0]
    q01 = Q[0, 1]
    q11 = Q[1, 1]
    q21 = Q[2, 1]
    q02 = Q[0, 2]
    q12 = Q[1, 2]
    q22 = Q[2, 2]
    x, y, z = _times(S, q00, q10, q20)
    r00 = q00 * x + q10 * y + q20 * z
    x, y, z = _times(S, q01, q11, q21)
    r01 = q00 * x + q10 * y + q20 * z
    r11 = q01 * x + q11 * y + q21 * z
    x, y, z = _times(S, q02, q12, q22)
    r02 = q00 * x + q10 * y + q20 * z
    r12 = q01 * x + q11 * y + q21 * z
    r22 = q02 * x + q12 * y + q22 * z
    low = r22
    x = y = 0.0
    z = 1.0
    square = 1.0
    for _ in range(STEPS):
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
