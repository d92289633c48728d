"""Weighted polynomial regression z = sum c_ab x^a y^b of degree K through moments.

The normal equations of a polynomial fit of degree K hold only the moments of degree <= 2K, so
those are summed and the matrix is filled from them. Coefficients are kept by descending degree and,
within a degree, by ascending power of y: the factorization runs backwards through the matrix
(G = L^T L), so the fit of every lower degree uses the trailing block of the same factor.
"""

from __future__ import annotations

import numpy as np

from pdtheory.pointset.kernels.jit import Array, inner

#: Points per block of the power tables, so that these stay in the first-level cache.
BLOCK = 128


@inner
def coefficient_count(degree: int) -> int:
    """Number of monomials of degree <= `degree`."""
    return (degree + 1) * (degree + 2) // 2


@inner
def degree_start(top: int, degree: int) -> int:
    """Index of the first coefficient of `degree` in a vector for degree `top`."""
    return coefficient_count(top) - coefficient_count(degree)


@inner
def table_rows(degree: int) -> int:
    """Rows of the power tables, rounded up to whole tiles."""
    return (2 * degree + 1 + 5) // 6 * 6


@inner
def _tile(X: Array, V: Array, a: int, b: int, m: int, out: Array) -> None:
    """Add the 3 x 6 dot products of rows a.. of X and b.. of V to out[a + b, b]."""
    s00 = s01 = s02 = s03 = s04 = s05 = 0.0
    s10 = s11 = s12 = s13 = s14 = s15 = 0.0
    s20 = s21 = s22 = s23 = s24 = s25 = 0.0
    for i in range(m):
        v0 = V[b, i]
        v1 = V[b + 1, i]
        v2 = V[b + 2, i]
        v3 = V[b + 3, i]
        v4 = V[b + 4, i]
        v5 = V[b + 5, i]
        x0 = X[a, i]
        s00 += x0 * v0
        s01 += x0 * v1
        s02 += x0 * v2
        s03 += x0 * v3
        s04 += x0 * v4
        s05 += x0 * v5
        x1 = X[a + 1, i]
        s10 += x1 * v0
        s11 += x1 * v1
        s12 += x1 * v2
        s13 += x1 * v3
        s14 += x1 * v4
        s15 += x1 * v5
        x2 = X[a + 2, i]
        s20 += x2 * v0
        s21 += x2 * v1
        s22 += x2 * v2
        s23 += x2 * v3
        s24 += x2 * v4
        s25 += x2 * v5
    d = a + b
    out[d, b] += s00
    out[d + 1, b + 1] += s01
    out[d + 2, b + 2] += s02
    out[d + 3, b + 3] += s03
    out[d + 4, b + 4] += s04
    out[d + 5, b + 5] += s05
    out[d + 1, b] += s10
    out[d + 2, b + 1] += s11
    out[d + 3, b + 2] += s12
    out[d + 4, b + 3] += s13
    out[d + 5, b + 4] += s14
    out[d + 6, b + 5] += s15
    out[d + 2, b] += s20
    out[d + 3, b + 1] += s21
    out[d + 4, b + 2] += s22
    out[d + 5, b + 3] += s23
    out[d + 6, b + 4] += s24
    out[d + 7, b + 5] += s25


@inner
def _powers(x: Array, first: Array, start: int, stop: int, rows: int, table: Array) -> int:
    """Fill rows of `table` with first * x^row over the points start..stop; zeros up to 8 points."""
    m = stop - start
    padded = (m + 7) // 8 * 8
    for i in range(m):
        table[0, i] = first[start + i]
    for i in range(m, padded):
        table[0, i] = 0.0
    for row in range(1, rows):
        for i in range(m):
            table[row, i] = table[row - 1, i] * x[start + i]
        for i in range(m, padded):
            table[row, i] = 0.0
    return padded


@inner
def _block_length(n: int) -> int:
    blocks = (n + BLOCK - 1) // BLOCK
    per_block = (n + blocks - 1) // blocks
    return (per_block + 7) // 8 * 8


@inner
def sum_moments(
    x: Array, y: Array, w: Array, ones: Array, n: int, top: int, X: Array, V: Array, out: Array
) -> None:
    """Sum w x^a y^b over n points for all a + b <= top into out[a + b, b].

    Parameters
    ----------
    x, y, w, ones : (>= n,) float64
        Centred coordinates, weights, and ones.
    n, top : int
        Number of points and largest total degree.
    X, V : (rows, BLOCK) float64
        Scratch for the powers, at least ``table_rows`` rows for ``2 K >= top``.
    out : (>= top + 8, >= top + 8) float64
        The sums; entries beyond `top` are scratch.
    """
    for i in range(out.shape[0]):
        for j in range(out.shape[1]):
            out[i, j] = 0.0
    if n == 0:
        return
    length = _block_length(n)
    rows = (top + 6) // 6 * 6
    start = 0
    while start < n:
        stop = min(start + length, n)
        m = _powers(x, ones, start, stop, rows, X)
        _powers(y, w, start, stop, rows, V)
        for a in range(0, top + 1, 3):
            for b in range(0, top - a + 1, 6):
                _tile(X, V, a, b, m, out)
        start = stop


@inner
def fill_gram(moments: Array, degree: int, gram: Array) -> None:
    """Fill the lower triangle of the Gram matrix from the moments (by degree and power of y)."""
    row = 0
    for d1 in range(degree, -1, -1):
        for b1 in range(d1 + 1):
            column = 0
            for d2 in range(degree, d1 - 1, -1):
                for b2 in range(d2 + 1):
                    gram[row, column + b2] = moments[d1 + d2, b1 + b2]
                column += d2 + 1
            row += 1


@inner
def fill_right_hand_side(moments: Array, degree: int, vector: Array) -> None:
    """Fill the right-hand side from the moments of w z."""
    row = 0
    for d in range(degree, -1, -1):
        for b in range(d + 1):
            vector[row] = moments[d, b]
            row += 1


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
        Scratch for the diagonal of G.
    pivots : (n,) float64
        Receives the relative pivots: what is left of each diagonal entry after the elimination of
        the later rows, as a fraction of it. Zero from the first failure on.
    """
    for i in range(n):
        diagonal[i] = G[i, i]
    for j in range(n - 1, -1, -1):
        pivot = G[j, j]
        relative = pivot / diagonal[j] if diagonal[j] > 0.0 else 0.0
        if not relative > 1e-15:
            for i in range(j + 1):
                pivots[i] = 0.0
            return
        pivots[j] = relative
        root = np.sqrt(pivot)
        inverse = 1.0 / root
        for i in range(j):
            G[j, i] *= inverse
        G[j, j] = root
        for i in range(j):
            f = G[j, i]
            for l in range(i + 1):  # noqa: E741
                G[i, l] -= f * G[j, l]


@inner
def solve_transposed(L: Array, s: int, n: int, v: Array) -> None:
    """Solve L^T y = v in place for the trailing block from index s."""
    for j in range(n - 1, s - 1, -1):
        t = v[j] / L[j, j]
        v[j] = t
        for i in range(s, j):
            v[i] -= L[j, i] * t


@inner
def solve_lower(L: Array, s: int, n: int, v: Array) -> None:
    """Solve L c = v in place for the trailing block from index s."""
    for j in range(s, n):
        t = v[j]
        for i in range(s, j):
            t -= L[j, i] * v[i]
        v[j] = t / L[j, j]


@inner
def residuals(
    x: Array,
    y: Array,
    z: Array,
    ones: Array,
    n: int,
    degree: int,
    c: Array,
    X: Array,
    scratch: Array,
    out: Array,
) -> None:
    """Write z - sum c_ab x^a y^b for n points; `c` has the coefficients of `degree`."""
    if n == 0:
        return
    length = _block_length(n)
    start = 0
    while start < n:
        stop = min(start + length, n)
        m = stop - start
        _powers(x, ones, start, stop, degree + 1, X)
        for i in range(m):
            scratch[i] = 0.0
        for b in range(degree, -1, -1):
            for i in range(m):
                scratch[i] *= y[start + i]
            for a in range(degree - b + 1):
                f = c[degree_start(degree, a + b) + b]
                for i in range(m):
                    scratch[i] += f * X[a, i]
        for i in range(m):
            out[start + i] = z[start + i] - scratch[i]
        start = stop


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
