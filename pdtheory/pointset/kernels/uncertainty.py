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
        for j in range(i, s - 1, -1):
            t = S[i, j] / L[j, j]
            S[i, j] = t
            total += t * t
            for l in range(s, j):  # noqa: E741
                S[i, l] -= t * L[j, l]
    return total


@inner
def order_covariance(
    X: Array,
    L: Array,
    s: int,
    n: int,
    top: int,
    order: int,
    cx: float,
    cy: float,
    binomial: Array,
    work: Array,
    spreads: Array,
    covariance: Array,
) -> None:
    """Write the covariance of the coefficients of one order at the origin, for unit noise.

    Parameters
    ----------
    X, L : (n, n) float64
        From `spread` and `factor`.
    s, n, top : int
        First index in use, size, degree that the indices belong to.
    order : int
        The order k.
    cx, cy : float
        Centre about which the fit was made.
    binomial : (top + 1, top + 1) float64
        Binomial coefficients.
    work : (n,) float64
        Scratch.
    spreads : (>= order + 1, n) float64
        Scratch.
    covariance : (>= order + 1, >= order + 1) float64
        Receives the covariance of c_{k-b,b}, b = 0..k.
    """
    for b in range(order + 1):
        a = order - b
        for i in range(s, n):
            work[i] = 0.0
        for d in range(order, top + 1):
            row = degree_start(top, d)
            if row < s:
                continue
            for j in range(b, d - a + 1):
                work[row + j] = (
                    binomial[d - j, a] * binomial[j, b] * (-cx) ** (d - j - a) * (-cy) ** (j - b)
                )
        solve_transposed(L, s, n, work)
        for i in range(s, n):
            t = 0.0
            for j in range(s, i + 1):
                t += X[i, j] * work[j]
            spreads[b, i] = t
    for b1 in range(order + 1):
        for b2 in range(b1 + 1):
            t = 0.0
            for i in range(s, n):
                t += spreads[b1, i] * spreads[b2, i]
            covariance[b1, b2] = t
            covariance[b2, b1] = t


@inner
def direction_variances(covariance: Array, order: int, theta: float) -> tuple[float, float]:
    """Return the variances of g'(theta) and g(theta) for unit noise."""
    c = np.cos(theta)
    s = np.sin(theta)
    slope = 0.0
    height = 0.0
    for b1 in range(order + 1):
        m1 = c ** (order - b1) * s**b1
        d1 = 0.0
        if b1 < order:
            d1 -= (order - b1) * c ** (order - b1 - 1) * s ** (b1 + 1)
        if b1 > 0:
            d1 += b1 * c ** (order - b1 + 1) * s ** (b1 - 1)
        for b2 in range(order + 1):
            m2 = c ** (order - b2) * s**b2
            d2 = 0.0
            if b2 < order:
                d2 -= (order - b2) * c ** (order - b2 - 1) * s ** (b2 + 1)
            if b2 > 0:
                d2 += b2 * c ** (order - b2 + 1) * s ** (b2 - 1)
            slope += d1 * covariance[b1, b2] * d2
            height += m1 * covariance[b1, b2] * m2
    return max(slope, 0.0), max(height, 0.0)
