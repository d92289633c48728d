"""Weighted sums of products of powers, the only thing a polynomial fit needs of its samples."""

from __future__ import annotations

from pdtheory.pointset.kernels.jit import Array, inner

#: Points per block of the power tables, so that these stay in the nearer caches.
BLOCK = 256


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
def _multiply_up(x: Array, start: int, m: int, padded: int, rows: int, table: Array) -> None:
    """Fill rows 1.. of `table` with row 0 times the powers of x; zeros behind the m points."""
    for i in range(m, padded):
        table[0, i] = 0.0
    for row in range(1, rows):
        for i in range(m):
            table[row, i] = table[row - 1, i] * x[start + i]
        for i in range(m, padded):
            table[row, i] = 0.0


@inner
def _add_products(X: Array, V: Array, m: int, top: int, out: Array) -> None:
    """Add the dot products of rows a of X and b of V to out[a + b, b] for a + b <= top."""
    for a in range(0, top + 1, 3):
        for b in range(0, top - a + 1, 6):
            _tile(X, V, a, b, m, out)


@inner
def _clear(out: Array, top: int) -> None:
    for i in range(top + 1):
        for j in range(i + 1):
            out[i, j] = 0.0


@inner
def block_length(n: int) -> int:
    """Length of the blocks into which n points are divided evenly."""
    blocks = max((n + BLOCK - 1) // BLOCK, 1)
    return ((n + blocks - 1) // blocks + 7) // 8 * 8


@inner
def sum_moments(
    x: Array, y: Array, w: Array, n: int, top: int, X: Array, V: Array, out: Array
) -> None:
    """Sum w x^a y^b over n points for all a + b <= top into out[a + b, b].

    Parameters
    ----------
    x, y, w : (>= n,) float64
        Centred coordinates and weights.
    n, top : int
        Number of points and largest total degree.
    X, V : (rows, > BLOCK) float64
        Scratch for the powers, at least ``table_rows(K)`` rows for ``2 K >= top``.
    out : (>= top + 8, >= top + 8) float64
        The sums; entries beyond `top` are scratch.
    """
    _clear(out, top)
    length = block_length(n)
    rows = (top + 6) // 6 * 6
    for start in range(0, n, length):
        m = min(length, n - start)
        padded = (m + 7) // 8 * 8
        for i in range(m):
            X[0, i] = 1.0
            V[0, i] = w[start + i]
        _multiply_up(x, start, m, padded, rows, X)
        _multiply_up(y, start, m, padded, rows, V)
        _add_products(X, V, padded, top, out)


@inner
def sum_normal_equations(
    x: Array,
    y: Array,
    w: Array,
    z: Array,
    n: int,
    degree: int,
    X: Array,
    V: Array,
    moments: Array,
    heights: Array,
) -> None:
    """Sum w x^a y^b to degree 2 K into `moments` and w z x^a y^b to degree K into `heights`."""
    _clear(moments, 2 * degree)
    _clear(heights, degree)
    length = block_length(n)
    rows = table_rows(degree)
    low_rows = (degree + 6) // 6 * 6
    for start in range(0, n, length):
        m = min(length, n - start)
        padded = (m + 7) // 8 * 8
        for i in range(m):
            X[0, i] = 1.0
            V[0, i] = w[start + i]
        _multiply_up(x, start, m, padded, rows, X)
        _multiply_up(y, start, m, padded, rows, V)
        _add_products(X, V, padded, 2 * degree, moments)
        for i in range(m):
            V[0, i] = w[start + i] * z[start + i]
        _multiply_up(y, start, m, padded, low_rows, V)
        _add_products(X, V, padded, degree, heights)


@inner
def subtract_polynomial(
    x: Array, y: Array, z: Array, n: int, degree: int, c: Array, X: Array, line: Array, out: Array
) -> None:
    """Write z - sum c_ab x^a y^b for n points; `c` has the coefficients by descending degree."""
    length = block_length(n)
    for start in range(0, n, length):
        m = min(length, n - start)
        for i in range(m):
            X[0, i] = 1.0
            line[i] = 0.0
        for row in range(1, degree + 1):
            for i in range(m):
                X[row, i] = X[row - 1, i] * x[start + i]
        for b in range(degree, -1, -1):
            # c_ab stands at (K - d)(K + d + 3) / 2 + b with d = a + b.
            a = 0
            f0 = c[(degree - b) * (degree + b + 3) // 2 + b]
            for i in range(m):
                line[i] = line[i] * y[start + i] + f0
            a = 1
            while a + 3 <= degree - b:
                d = a + b
                f0 = c[(degree - d) * (degree + d + 3) // 2 + b]
                f1 = c[(degree - d - 1) * (degree + d + 4) // 2 + b]
                f2 = c[(degree - d - 2) * (degree + d + 5) // 2 + b]
                f3 = c[(degree - d - 3) * (degree + d + 6) // 2 + b]
                for i in range(m):
                    line[i] += f0 * X[a, i] + f1 * X[a + 1, i] + f2 * X[a + 2, i] + f3 * X[a + 3, i]
                a += 4
            while a <= degree - b:
                d = a + b
                f0 = c[(degree - d) * (degree + d + 3) // 2 + b]
                for i in range(m):
                    line[i] += f0 * X[a, i]
                a += 1
        for i in range(m):
            out[start + i] = z[start + i] - line[i]
