"""Standard deviations of coefficients, angles and eigenvalues that follow from the fit itself.

The heights are taken to carry independent noise of one variance s^2. The weighted estimate
c = G^-1 A^T W z then has the covariance s^2 G^-1 S G^-1 with S = A^T W^2 A, and
sum w r^2 has the mean s^2 (sum w - tr G^-1 S), which gives s^2 from the residuals r.
"""

from __future__ import annotations

import numpy as np

from pdtheory.pointset.kernels.jit import Array, inner
from pdtheory.pointset.kernels.regression import (
    degree_start,
    factor,
    solve_transposed,
)


@inner
def spread(L: Array, S: Array, s: int, n: int, diagonal: Array, pivots: Array) -> float:
    """Replace S by X with G^-1 S G^-1 = (X L^-T)^T (X L^-T), for the trailing block from s.

    With S = M^T M this is X = M L^-1, a lower triangle.

    Returns
    -------
    float
        tr(G^-1 S), the squared Frobenius norm of X: the degrees of freedom the fit uses up,
        counted with the weights.
    """
    factor(S, n, diagonal, pivots)
    total = 0.0
    for i in range(s, n):
        if pivots[i] == 0.0:
            for j in range(s, i + 1):
                S[i, j] = 0.0
            continue
        j = i
        while j - 3 >= s:
            t0 = S[i, j] / L[j, j]
            t1 = (S[i, j - 1] - t0 * L[j, j - 1]) / L[j - 1, j - 1]
            t2 = (S[i, j - 2] - t0 * L[j, j - 2] - t1 * L[j - 1, j - 2]) / L[j - 2, j - 2]
            t3 = S[i, j - 3] - t0 * L[j, j - 3] - t1 * L[j - 1, j - 3] - t2 * L[j - 2, j - 3]
            t3 /= L[j - 3, j - 3]
            for k in range(j - 3 - s):
                S[i, s + k] -= (
                    t0 * L[j, s + k]
                    + t1 * L[j - 1, s + k]
                    + t2 * L[j - 2, s + k]
                    + t3 * L[j - 3, s + k]
                )
            S[i, j] = t0
            S[i, j - 1] = t1
            S[i, j - 2] = t2
            S[i, j - 3] = t3
            total += t0 * t0 + t1 * t1 + t2 * t2 + t3 * t3
            j -= 4
        while j >= s:
            t0 = S[i, j] / L[j, j]
            for k in range(s, j):
                S[i, k] -= t0 * L[j, k]
            S[i, j] = t0
            total += t0 * t0
            j -= 1
    return total


@inner
def fill_shift_powers(cx: float, cy: float, top: int, powers: Array) -> None:
    """Write the powers of -cx and -cy up to `top` to the two rows of `powers`."""
    powers[0, 0] = powers[1, 0] = 1.0
    for i in range(top):
        powers[0, i + 1] = -cx * powers[0, i]
        powers[1, i + 1] = -cy * powers[1, i]


@inner
def coefficient_spread(
    X: Array,
    L: Array,
    s: int,
    n: int,
    top: int,
    a: int,
    b: int,
    binomial: Array,
    powers: Array,
    work: Array,
    out: Array,
) -> None:
    """Write X L^-T e to `out`, e taking the coefficients to that of x^a y^b about the origin.

    Its inner products are the covariances of such coefficients for unit noise.

    Parameters
    ----------
    X, L : (n, n) float64
        From `spread` and `factor`.
    s, n, top : int
        First index in use, size, degree that the indices belong to.
    a, b : int
        The powers.
    binomial : (top + 1, top + 1) float64
        Binomial coefficients.
    powers : (2, top + 1) float64
        From `fill_shift_powers`.
    work, out : (n,) float64
        Scratch, and the result in s..n - 1.
    """
    order = a + b
    end = degree_start(top, order) + order + 1
    for i in range(s, end):
        work[i] = 0.0
    for d in range(order, top + 1):
        row = degree_start(top, d)
        if row < s:
            continue
        for j in range(b, d - a + 1):
            work[row + j] = (
                binomial[d - j, a] * binomial[j, b] * powers[0, d - j - a] * powers[1, j - b]
            )
    solve_transposed(L, s, end, work)
    for i in range(s, n):
        t = 0.0
        for j in range(min(i + 1, end) - s):
            t += X[i, s + j] * work[s + j]
        out[i] = t


@inner
def order_covariance(
    X: Array,
    L: Array,
    s: int,
    n: int,
    top: int,
    order: int,
    binomial: Array,
    powers: Array,
    square: Array,
    gradient: Array,
    work: Array,
    spreads: Array,
    covariance: Array,
) -> None:
    """Write the covariance of the coefficients of one order at the origin, for unit noise.

    The frame is tangent to the fitted surface, so an error (a, b) of the gradient also turns it,
    which changes the heights h by -(a d/dx + b d/dy)(h^2) / 2.

    Parameters
    ----------
    X, L, s, n, top, binomial, powers, work
        As for `coefficient_spread`.
    order : int
        The order k.
    square : (> top + 1, > top + 1) float64
        Coefficients of h^2 by powers of x and y; zeros if the frame is not that of the fit.
    gradient : (2, n) float64
        Spreads of the coefficients of x and y.
    spreads : (>= order + 1, n) float64
        Scratch.
    covariance : (>= order + 1, >= order + 1) float64
        Receives the covariance of c_{k-b,b}, b = 0..k.
    """
    for b in range(order + 1):
        a = order - b
        coefficient_spread(X, L, s, n, top, a, b, binomial, powers, work, spreads[b])
        by_x = -0.5 * (a + 1) * square[a + 1, b]
        by_y = -0.5 * (b + 1) * square[a, b + 1]
        for i in range(n - s):
            spreads[b, s + i] += by_x * gradient[0, s + i] + by_y * gradient[1, s + i]
    for b1 in range(order + 1):
        for b2 in range(b1 + 1):
            t = 0.0
            for i in range(n - s):
                t += spreads[b1, s + i] * spreads[b2, s + i]
            covariance[b1, b2] = t
            covariance[b2, b1] = t


@inner
def direction_variances(
    covariance: Array, order: int, theta: float, work: Array
) -> tuple[float, float]:
    """Return the variances of g'(theta) and g(theta) for unit noise.

    `work` is scratch with four rows of at least ``order + 2`` entries.
    """
    c = np.cos(theta)
    s = np.sin(theta)
    work[0, 0] = work[1, 0] = 1.0
    for i in range(order + 1):
        work[0, i + 1] = work[0, i] * c
        work[1, i + 1] = work[1, i] * s
    for b in range(order + 1):
        work[2, b] = work[0, order - b] * work[1, b]
        slope = 0.0
        if b < order:
            slope -= (order - b) * work[0, order - b - 1] * work[1, b + 1]
        if b > 0:
            slope += b * work[0, order - b + 1] * work[1, b - 1]
        work[3, b] = slope
    of_slope = 0.0
    of_value = 0.0
    for b1 in range(order + 1):
        for b2 in range(order + 1):
            of_slope += work[3, b1] * covariance[b1, b2] * work[3, b2]
            of_value += work[2, b1] * covariance[b1, b2] * work[2, b2]
    return max(of_slope, 0.0), max(of_value, 0.0)
