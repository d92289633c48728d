"""The weighted polynomial fit z = sum c_ab x^a y^b of the points of a cloud.

Coefficients stand by descending degree and, within a degree, by ascending power of y, from index 1
on; index 0 belongs to the height (see `cholesky`).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from pdtheory.pointset.kernels.cholesky import factor, fill_gram, solve_lower, solve_transposed
from pdtheory.pointset.kernels.jit import Array, inner
from pdtheory.pointset.kernels.moments import (
    PRODUCT,
    RESIDUAL,
    WEIGHT,
    multiply_rows,
    subtract_polynomial,
    sum_moments,
)
from pdtheory.pointset.kernels.tables import make_tables

#: Smallest relative pivot that leaves correct digits; the degree is lowered until it is reached.
WORST_PIVOT = 1e-9
#: The pivots of a degree as a fraction of those of a full disc: below the first the points do not
#: tell its monomials apart (scan lines, a lattice) and the degree is lowered; below the second the
#: fit is flagged. Half a disc has 2e-3 at degree 10, a quarter 2e-2.
DEFICIENT, DOUBTFUL = 1e-4, 1e-3
#: Smallest relative pivot of each degree for points that fill the disc evenly.
FULL_DISC = make_tables()["full_disc"].copy()
#: Below the first pivot the solution is refined against the samples; below the second if these lie
#: so close to the surface that rounding counts: it changes the coefficients by about 1 / pivot
#: roundings, the misfit by itself over the root of the pivot, of which that may be a thousandth.
REFINE_PIVOT, EXACT_PIVOT, ROUNDING = 1e-5, 1e-4, 1e3 * 2.2e-16

#: Halvings of an interval after which a number in it is known to rounding, if it is not 1e-4 of it.
_HALVINGS = 64


@inner
def degree_start(top: int, degree: int) -> int:
    """Index of the first coefficient of `degree` in a vector for degree `top`."""
    return 1 + ((top + 1) * (top + 2) - (degree + 1) * (degree + 2)) // 2


@inner
def assemble(
    cloud: Array,
    weights: int,
    n: int,
    degree: int,
    heights: int,
    gram: Array,
    diagonal: Array,
    pivots: Array,
    inverses: Array,
    w: Any,
) -> None:
    """Factor a Gram matrix with the given row of weights; `heights` is their degree, or -1."""
    # The code of the factorization is long, so all that need it call this function.
    sum_moments(cloud, weights, n, 2 * degree, heights, w)
    fill_gram(w.sums, w.heights, degree, w.ordered, gram)
    factor(gram, (degree + 1) * (degree + 2) // 2, diagonal, pivots, inverses)


@inner
def set_up(cloud: Array, weights: int, n: int, degree: int, w: Any) -> None:
    """Factor the normal equations of a fit with the given row of weights."""
    assemble(cloud, weights, n, degree, degree, w.G, w.diagonal, w.pivots, w.inverses, w)


@inner
def solve(degree: int, most: int, w: Any) -> None:
    """Write the coefficients up to the degree `most` to ``w.c``; those above it are zero."""
    count = (degree + 1) * (degree + 2) // 2
    for i in range(1, degree_start(degree, most)):
        w.inverses[i] = 0.0
    for i in range(1, count + 1):
        w.y[i] = w.G[i, 0]
    solve_lower(w.G, count, w.inverses, w.y, w.c)


@inner
def regress(cloud: Array, weights: int, n: int, degree: int, w: Any) -> tuple[int, float]:
    """Fit the heights with the given row of weights; the coefficients go to ``w.c``.

    Returns
    -------
    (int, float)
        The degree reached and its smallest relative pivot.
    """
    set_up(cloud, weights, n, degree, w)
    reached = -1
    worst = 1.0
    start = degree_start(degree, 0)
    for d in range(degree + 1):
        low = 1.0
        for i in range(start, start + d + 1):
            low = min(low, w.pivots[i])
        if low < WORST_PIVOT or low < DEFICIENT * FULL_DISC[d]:
            break
        worst = min(worst, low)
        reached = d
        start -= d + 2
    solve(degree, reached, w)
    return reached, worst


@inner
def doubtful(degree: int, reached: int, w: Any) -> bool:
    """Whether some degree up to the one reached has far smaller pivots than on a full disc."""
    for d in range(reached + 1):
        start = degree_start(degree, d)
        for i in range(start, start + d + 1):
            if w.pivots[i] < DOUBTFUL * FULL_DISC[d]:
                return True
    return False


@inner
def fill_residuals(cloud: Array, n: int, degree: int, w: Any) -> None:
    """Write the residuals of the points to their row."""
    i = 0
    for b in range(degree, -1, -1):
        for d in range(degree, b - 1, -1):
            w.horner[i] = w.c[degree_start(degree, d) + b]
            i += 1
    subtract_polynomial(cloud, n, degree, w.horner)


@inner
def refine(cloud: Array, weights: int, n: int, degree: int, w: Any) -> None:
    """Improve ``w.c`` by solving for the residuals of the samples, which are in their row."""
    multiply_rows(cloud, weights, RESIDUAL, n, PRODUCT)
    sum_moments(cloud, PRODUCT, n, degree, -1, w)
    row = 1
    for d in range(degree, -1, -1):
        for b in range(d + 1):
            w.v[row] = w.sums[d - b, b]
            row += 1
    solve_transposed(w.G, row - 1, w.inverses, w.v, w.y)
    solve_lower(w.G, row - 1, w.inverses, w.y, w.step)
    for i in range(1, row):
        w.c[i] += w.step[i]


@inner
def misfit(cloud: Array, n: int, degree: int, total: float, w: Any) -> float:
    """Fill the residuals; return their root mean square with the weights of the cloud."""
    fill_residuals(cloud, n, degree, w)
    squares = 0.0
    for i in range(n):
        squares += cloud[WEIGHT, i] * cloud[RESIDUAL, i] * cloud[RESIDUAL, i]
    return np.sqrt(squares / total)


@inner
def typical_residual(cloud: Array, n: int, passed: int) -> float:
    """Return the standard deviation of normal noise with the median of the absolute residuals.

    `passed` residuals are left out, the smallest ones: those of points that the fit passes through.
    """
    sizes = cloud[PRODUCT]
    inside = 0
    high = 0.0
    for i in range(n):
        if cloud[WEIGHT, i] > 0.0:
            sizes[inside] = abs(cloud[RESIDUAL, i])
            high = max(high, sizes[inside])
            inside += 1
    if inside <= passed:
        return np.inf
    # Halving finds the median to rounding; a sort of Numba takes seconds to compile.
    rank = passed + (inside - passed) // 2
    low = 0.0
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        below = 0
        for i in range(inside):
            below += int(sizes[i] <= middle)
        if below > rank:
            high = middle
        else:
            low = middle
    return high / 0.6744897501960817


@inner
def settle(
    cloud: Array, weights: int, n: int, degree: int, total: float, pivot: float, w: Any
) -> tuple[float, bool]:
    """Refine a fit with the given row of weights if rounding counts, and fill the residuals.

    Returns
    -------
    (float, bool)
        The misfit, and whether the fit was refined.
    """
    residual = misfit(cloud, n, degree, total, w)
    close = residual * np.sqrt(pivot) < ROUNDING
    refined = pivot < REFINE_PIVOT or (pivot < EXACT_PIVOT and close)
    if refined:
        refine(cloud, weights, n, degree, w)
        residual = misfit(cloud, n, degree, total, w)
    return residual, refined
