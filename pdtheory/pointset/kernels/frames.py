"""Local frames: robust centred principal axes, tilting, and the choice of t1."""

from __future__ import annotations

import numpy as np

from pdtheory.pointset.kernels.jit import Array, inner

#: Below this ratio of the middle to the largest variance the neighbours lie on a line.
COLLINEAR = 1e-14
#: Rounds of reweighting of the principal axes.
ROUNDS = 2


@inner
def symmetric_axes(A: Array, Q: Array) -> None:
    """Diagonalize a symmetric 3x3 matrix by Jacobi rotations.

    `A` is left diagonal; the columns of `Q` are the axes.
    """
    for i in range(3):
        for j in range(3):
            Q[i, j] = 1.0 if i == j else 0.0
    for _ in range(30):
        off = abs(A[0, 1]) + abs(A[0, 2]) + abs(A[1, 2])
        if off <= 1e-18 * (abs(A[0, 0]) + abs(A[1, 1]) + abs(A[2, 2])):
            break
        for p in range(2):
            for q in range(p + 1, 3):
                if A[p, q] == 0.0:
                    continue
                half = (A[q, q] - A[p, p]) / (2.0 * A[p, q])
                t = 1.0 / (abs(half) + np.sqrt(half * half + 1.0))
                if half < 0.0:
                    t = -t
                c = 1.0 / np.sqrt(t * t + 1.0)
                s = t * c
                for r in range(3):
                    u = A[r, p]
                    v = A[r, q]
                    A[r, p] = c * u - s * v
                    A[r, q] = s * u + c * v
                for r in range(3):
                    u = A[p, r]
                    v = A[q, r]
                    A[p, r] = c * u - s * v
                    A[q, r] = s * u + c * v
                for r in range(3):
                    u = Q[r, p]
                    v = Q[r, q]
                    Q[r, p] = c * u - s * v
                    Q[r, q] = s * u + c * v


@inner
def principal_frame(
    dx: Array, dy: Array, dz: Array, w: Array, n: int, A: Array, Q: Array, frame: Array
) -> bool:
    """Write the robust principal axes of n weighted points, centred on their mean.

    The plane is fitted again `ROUNDS` times with weights w / (1 + d^2 / s^2), d being the distance
    from the plane before and s^2 its weighted mean square, so that outliers pull less.

    Parameters
    ----------
    dx, dy, dz, w : (>= n,) float64
        Points relative to the origin of the frame, and their weights.
    n : int
        Number of points.
    A, Q : (3, 3) float64
        Scratch.
    frame : (3, 3) float64
        Rows t1 (largest spread), t2, n: right-handed, n of either sign.

    Returns
    -------
    bool
        False if the points lie on a line or in one place.
    """
    nx = ny = nz = height = scale = 0.0
    for _ in range(ROUNDS + 1):
        s = sx = sy = sz = 0.0
        sxx = sxy = sxz = syy = syz = szz = 0.0
        for i in range(n):
            x = dx[i]
            y = dy[i]
            z = dz[i]
            d = x * nx + y * ny + z * nz - height
            u = w[i] / (1.0 + d * d * scale)
            s += u
            sx += u * x
            sy += u * y
            sz += u * z
            sxx += u * x * x
            sxy += u * x * y
            sxz += u * x * z
            syy += u * y * y
            syz += u * y * z
            szz += u * z * z
        if not s > 0.0:
            return False
        mx = sx / s
        my = sy / s
        mz = sz / s
        A[0, 0] = sxx / s - mx * mx
        A[1, 1] = syy / s - my * my
        A[2, 2] = szz / s - mz * mz
        A[0, 1] = A[1, 0] = sxy / s - mx * my
        A[0, 2] = A[2, 0] = sxz / s - mx * mz
        A[1, 2] = A[2, 1] = syz / s - my * mz
        symmetric_axes(A, Q)
        low = 0
        high = 0
        for i in range(1, 3):
            if A[i, i] < A[low, low]:
                low = i
            if A[i, i] > A[high, high]:
                high = i
        if low == high:
            return False
        middle = 3 - low - high
        if not A[middle, middle] > COLLINEAR * A[high, high]:
            return False
        nx = Q[0, low]
        ny = Q[1, low]
        nz = Q[2, low]
        height = mx * nx + my * ny + mz * nz
        if not A[low, low] > 1e-24 * A[high, high]:
            break
        scale = 1.0 / A[low, low]
    for i in range(3):
        frame[0, i] = Q[i, high]
        frame[2, i] = Q[i, low]
    complete(frame)
    return True


@inner
def complete(frame: Array) -> None:
    """Make row 0 orthogonal to row 2, both unit, and set row 1 = row 2 x row 0."""
    size = np.sqrt(frame[2, 0] ** 2 + frame[2, 1] ** 2 + frame[2, 2] ** 2)
    for i in range(3):
        frame[2, i] /= size
    along = frame[0, 0] * frame[2, 0] + frame[0, 1] * frame[2, 1] + frame[0, 2] * frame[2, 2]
    for i in range(3):
        frame[0, i] -= along * frame[2, i]
    size = np.sqrt(frame[0, 0] ** 2 + frame[0, 1] ** 2 + frame[0, 2] ** 2)
    for i in range(3):
        frame[0, i] /= size
    frame[1, 0] = frame[2, 1] * frame[0, 2] - frame[2, 2] * frame[0, 1]
    frame[1, 1] = frame[2, 2] * frame[0, 0] - frame[2, 0] * frame[0, 2]
    frame[1, 2] = frame[2, 0] * frame[0, 1] - frame[2, 1] * frame[0, 0]


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
def output_frame(frame: Array, out: Array) -> float:
    """Write the frame with the same normal and a t1 that depends on the normal only.

    t1 is the direction of the projection of the x axis onto the tangent plane, or of the y axis
    where the normal is within 26 degrees of the x axis.

    Returns
    -------
    float
        Angle of that t1 in the old frame.
    """
    axis = 0 if abs(frame[2, 0]) <= 0.9 else 1
    for i in range(3):
        out[2, i] = frame[2, i]
        out[0, i] = 1.0 if i == axis else 0.0
    complete(out)
    c = out[0, 0] * frame[0, 0] + out[0, 1] * frame[0, 1] + out[0, 2] * frame[0, 2]
    s = out[0, 0] * frame[1, 0] + out[0, 1] * frame[1, 1] + out[0, 2] * frame[1, 2]
    return np.arctan2(s, c)
