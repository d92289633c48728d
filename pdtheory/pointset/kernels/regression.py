"""The normal equations of a polynomial fit z = sum c_ab x^a y^b: matrix, factor, solution, shift.

Coefficients are kept by descending degree and, within a degree, by ascending power of y. The
factorization runs backwards through the matrix (G = L^T L), so the fit of every lower degree uses
the trailing block of the same factor.
"""

from __future__ import annotations

import numpy as np

from pdtheory.pointset.kernels.jit import Array, IntArray, inner

#: Rows eliminated together: their products with the rows before are added in one pass.
PANEL = 4


@inner
def coefficient_count(degree: int) -> int:
    """Number of monomials of degree <= `degree`."""
    return (degree + 1) * (degree + 2) // 2


@inner
def degree_start(top: int, degree: int) -> int:
    """Index of the first coefficient of `degree` in a vector for degree `top`."""
    return coefficient_count(top) - coefficient_count(degree)


@inner
def fill_gram(moments: Array, degree: int, offsets: IntArray, gram: Array) -> None:
    """Fill the lower triangle of the Gram matrix from the moments.

    Degrees and powers of y of two monomials add up to those of their product, so with them encoded
    as one offset into the table of moments, the offsets add up as well.
    """
    stride = moments.shape[1]
    row = 0
    for d in range(degree, -1, -1):
        for b in range(d + 1):
            offsets[row] = d * stride + b
            row += 1
    flat = moments.reshape(moments.size)
    for i in range(row):
        base = offsets[i]
        for j in range(i + 1):
            gram[i, j] = flat[base + offsets[j]]


@inner
def fill_right_hand_side(heights: Array, degree: int, vector: Array) -> None:
    """Fill the right-hand side from the sums of w z x^a y^b."""
    row = 0
    for d in range(degree, -1, -1):
        for b in range(d + 1):
            vector[row] = heights[d, b]
            row += 1


@inner
def _eliminate_panel(G: Array, j: int) -> None:
    """Subtract the products of the rows j - 3..j from all rows before them, two at a time."""
    low = j - PANEL + 1
    i = 0
    while i + 1 < low:
        a0 = G[j, i]
        a1 = G[j - 1, i]
        a2 = G[j - 2, i]
        a3 = G[j - 3, i]
        b0 = G[j, i + 1]
        b1 = G[j - 1, i + 1]
        b2 = G[j - 2, i + 1]
        b3 = G[j - 3, i + 1]
        for k in range(i + 1):
            g0 = G[j, k]
            g1 = G[j - 1, k]
            g2 = G[j - 2, k]
            g3 = G[j - 3, k]
            G[i, k] -= a0 * g0 + a1 * g1 + a2 * g2 + a3 * g3
            G[i + 1, k] -= b0 * g0 + b1 * g1 + b2 * g2 + b3 * g3
        G[i + 1, i + 1] -= b0 * b0 + b1 * b1 + b2 * b2 + b3 * b3
        i += 2
    if i < low:
        a0 = G[j, i]
        a1 = G[j - 1, i]
        a2 = G[j - 2, i]
        a3 = G[j - 3, i]
        for k in range(i + 1):
            G[i, k] -= a0 * G[j, k] + a1 * G[j - 1, k] + a2 * G[j - 2, k] + a3 * G[j - 3, k]


@inner
def factor(G: Array, n: int, diagonal: Array, pivots: Array) -> None:
    """Factor G = L^T L in place, from the last row to the first.

    Parameters
    ----------
    G : (n, n) float64
        Lower triangle of a symmetric matrix; replaced by L.
    n : int
        Size.
    diagonal : (n,) float64
        Receives the diagonal of G.
    pivots : (n,) float64
        Receives the relative pivots: what is left of each diagonal entry after the elimination of
        the later rows, as a fraction of it. Zero from the first failure on.
    """
    for i in range(n):
        diagonal[i] = G[i, i]
    for j in range(n - 1, -1, -PANEL):
        low = max(j - PANEL + 1, 0)
        for p in range(j, low - 1, -1):
            for q in range(p + 1, j + 1):
                f = G[q, p]
                for k in range(p + 1):
                    G[p, k] -= f * G[q, k]
            pivot = G[p, p]
            relative = pivot / diagonal[p] if diagonal[p] > 0.0 else 0.0
            if not relative > 1e-15:
                for i in range(p + 1):
                    pivots[i] = 0.0
                return
            pivots[p] = relative
            root = np.sqrt(pivot)
            inverse = 1.0 / root
            for k in range(p):
                G[p, k] *= inverse
            G[p, p] = root
        if low > 0:
            _eliminate_panel(G, j)


@inner
def solve_transposed(L: Array, s: int, n: int, v: Array) -> None:
    """Solve L^T y = v in place for the indices s..n - 1."""
    for j in range(n - 1, s - 1, -1):
        t = v[j] / L[j, j]
        v[j] = t
        for i in range(j - s):
            v[s + i] -= L[j, s + i] * t


@inner
def solve_lower(L: Array, s: int, n: int, v: Array) -> None:
    """Solve L c = v in place for the indices s..n - 1."""
    for j in range(s, n):
        t = v[j]
        for i in range(j - s):
            t -= L[j, s + i] * v[s + i]
        v[j] = t / L[j, j]


@inner
def shift(c: Array, degree: int, cx: float, cy: float, table: Array) -> None:
    """Re-expand sum c_ab (x - cx)^a (y - cy)^b about the origin, in place and exactly.

    Parameters
    ----------
    c : (coefficient_count,) float64
        Coefficients, by descending degree.
    degree : int
        The degree.
    cx, cy : float
        The old centre.
    table : (degree + 1, degree + 1) float64
        Scratch.
    """
    row = 0
    for d in range(degree, -1, -1):
        for b in range(d + 1):
            table[d - b, b] = c[row]
            row += 1
    for b in range(degree + 1):
        top = degree - b
        for low in range(top):
            for a in range(top - 1, low - 1, -1):
                table[a, b] -= cx * table[a + 1, b]
    for a in range(degree + 1):
        top = degree - a
        for low in range(top):
            for b in range(top - 1, low - 1, -1):
                table[a, b] -= cy * table[a, b + 1]
    row = 0
    for d in range(degree, -1, -1):
        for b in range(d + 1):
            c[row] = table[d - b, b]
            row += 1
