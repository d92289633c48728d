"""Covariances of the terms of a jet that follow from the fit itself.

The heights are taken to carry independent noise of one variance s^2. The weighted estimate
c = G^-1 A^T W z then has the covariance s^2 G^-1 S G^-1 with S = A^T W^2 A, and
sum w r^2 has the mean s^2 (sum w - tr G^-1 S), which gives s^2 from the residuals r.

With G = L^T L and S = M^T M, the matrix X = M L^-1 gives the covariance of two coefficients e, f as
the inner product of X L^-T e and X L^-T f, and tr G^-1 S as the sum of its squares.
"""

from __future__ import annotations

from functools import reduce
from typing import Any

import numpy as np

from pdtheory.pointset.kernels.cholesky import PANEL
from pdtheory.pointset.kernels.fit import Fit
from pdtheory.pointset.kernels.jit import Array, inner
from pdtheory.pointset.kernels.lanes import LANES, Lanes, Rows, emit
from pdtheory.pointset.kernels.moments import (
    PRODUCT,
    RESIDUAL,
    WEIGHT,
    multiply_rows,
)
from pdtheory.pointset.kernels.regression import assemble, degree_start, typical_residual
from pdtheory.pointset.kernels.tables import ROWS, SIDE
from pdtheory.pointset.kernels.tilting import add_product, spread_out


@emit
def _solve_rows(
    to: Lanes, V: Rows, count: Any, tops: Any, step: Any, L: Rows, inverses: Rows, out: Rows
) -> float:
    """Solve L^T y = v for rows v, PANEL at a time, and write y to the columns of `out`.

    Parameters
    ----------
    V : (>= count + PANEL, columns) float64
        Right-hand sides in the rows 1..count; overwritten. Rows behind them are taken along.
    count : int
        Number of rows.
    tops, step : int
        The first PANEL rows have zeros behind index `tops`, a multiple of PANEL, the next behind
        tops + step, and so on.
    L, inverses
        The factor, and its inverse pivots.
    out : (> last top, > count + PANEL) float64
        out[j, i] receives entry j of the solution for row i.

    Returns
    -------
    float
        Sum of the squares of all solutions.
    """
    # One for each row of a group, since a sum waits for the one before.
    totals = [to.variable(to.real(0.0)) for _ in range(PANEL)]
    groups = to.div(to.plus(count, PANEL - 1), PANEL)
    with to.count(0, groups) as group:
        line = [to.plus(to.mul(group, PANEL), 1 + r) for r in range(PANEL)]
        panels = to.div(to.plus(tops, to.mul(group, step)), PANEL)
        with to.count(0, panels) as panel:
            top = to.mul(to.minus(panels, panel), PANEL)
            row = [to.minus(top, p) for p in range(PANEL)]
            scale = [to.get(inverses.at(j)) for j in row]
            corner = [[to.get(L.at(row[q], row[p])) for q in range(p)] for p in range(PANEL)]
            found: list[list[Any]] = []
            for i, total in zip(line, totals, strict=True):
                squares = to.get(total)
                known: list[Any] = []
                for p in range(PANEL):
                    value = to.get(V.at(i, row[p]))
                    for q in range(p):
                        value = to.subtract(value, to.times(known[q], corner[p][q]))
                    value = to.times(value, scale[p])
                    to.put(value, out.at(row[p], i))
                    squares = to.add(to.times(value, value), squares)
                    known.append(value)
                to.put(squares, total)
                found.append([to.spread(value) for value in known])
            with to.count(0, to.minus(top, PANEL - 1), LANES) as k:
                lines = [to.load(L.at(j, k)) for j in row]
                for i, known in zip(line, found, strict=True):
                    value = to.load(V.at(i, k))
                    for f, part in zip(known, lines, strict=True):
                        value = to.subtract(value, to.times(f, part))
                    to.store(value, V.at(i, k))
    return reduce(to.add, map(to.get, totals))


@emit
def _fill_shift(
    to: Lanes, across: Rows, along: Rows, top: Any, used: Any, order: Any, out: Rows
) -> None:
    """Write what the coefficients of one order about the origin take of those about the centre.

    Parameters
    ----------
    across, along
        Powers of the centre with their binomial coefficients, from `_fill_binomials`.
    top, used : int
        Degree that the coefficients are laid out for, and the largest that is not zero.
    order : int
        The order k.
    out : (> k + 1, columns) float64
        Row 1 + b receives the weights of the coefficient of x^(k-b) y^b; those behind the order are
        zero, up to a whole vector.
    """
    after = to.mul(to.plus(used, 1), to.plus(used, 2))
    first = to.plus(to.div(to.minus(to.mul(to.plus(top, 1), to.plus(top, 2)), after), 2), 1)
    with to.count(0, to.plus(order, 1)) as b:
        row = to.plus(b, 1)
        a = to.minus(order, b)
        with to.count(0, first, LANES) as i:
            to.store(to.constant(0.0), out.at(row, i))
        place = to.variable(first)
        with to.count(0, to.plus(to.minus(used, order), 1)) as lower:
            d = to.minus(used, lower)
            # What goes beyond the degree is written over by the next one.
            with to.count(0, to.plus(d, 1), LANES) as j:
                by_x = to.load(across.at(a, to.plus(to.minus(SIDE - 1, d), j)))
                weights = to.times(by_x, to.load(along.at(b, j)))
                to.store(weights, out.at(row, to.plus(to.get(place), j)))
            to.put(to.plus(to.get(place), d, 1), place)
        to.store(to.constant(0.0), out.at(row, to.get(place)))


@inner
def _fill_binomials(cx: float, cy: float, top: int, tables: Any, w: Any) -> None:
    """Write binomial(i, a) (-cx)^(i-a) to across[a, SIDE - 1 - i], that of cy to along[a, i]."""
    power_x = 1.0
    power_y = 1.0
    for i in range(top + 1):
        for a in range(top + 1 - i):
            factor = tables.binomial[a + i, a]
            w.across[a, SIDE - 1 - a - i] = factor * power_x
            w.along[a, a + i] = factor * power_y
        power_x *= -cx
        power_y *= -cy


@emit
def _combine(to: Lanes, Y: Rows, count: Any, last: Any, X: Rows, n: Any, out: Rows) -> None:
    """Write sum_j Y[j, f] X[j, i], 1 <= j <= last, to out[f, i] for f in 1..count, i in 0..n.

    X[j, i] is zero for i < j.
    """
    width = 2
    with to.count(1, to.plus(count, 1), PANEL) as f, to.count(0, to.plus(n, 1), width * LANES) as i:
        sums = [[to.variable(to.constant(0.0)) for _ in range(width)] for _ in range(PANEL)]
        with to.count(1, to.plus(to.least(last, to.plus(i, width * LANES - 1)), 1)) as j:
            parts = [to.load(X.at(j, to.plus(i, v * LANES))) for v in range(width)]
            for r in range(PANEL):
                y = to.spread(to.get(Y.at(j, to.plus(f, r))))
                for v in range(width):
                    to.put(to.add(to.times(y, parts[v]), to.get(sums[r][v])), sums[r][v])
        for r in range(PANEL):
            for v in range(width):
                to.store(to.get(sums[r][v]), out.at(to.plus(f, r), to.plus(i, v * LANES)))


@emit
def _inner_products(
    to: Lanes, U: Rows, count: Any, n: Any, scale: Any, out: Rows, start: Any
) -> None:
    """Write the inner products of the rows 1..count of U, times `scale`, row by row to `out`.

    U has zeros in column 0, and behind column n to the end of the vector. What follows the
    products, up to a whole vector, is overwritten.
    """
    with to.count(1, to.plus(count, 1)) as i, to.count(0, count, LANES) as first:
        sums = [to.variable(to.constant(0.0)) for _ in range(LANES)]
        with to.count(0, to.plus(n, 1), LANES) as k:
            own = to.load(U.at(i, k))
            for j in range(LANES):
                other = to.load(U.at(to.plus(first, 1 + j), k))
                to.put(to.add(to.times(own, other), to.get(sums[j])), sums[j])
        products = to.times(to.sums(list(map(to.get, sums))), to.spread(scale))
        at = to.plus(start, to.mul(to.minus(i, 1), count), first)
        to.store(products, out.at(at))


@inner
def prepare_covariances(cloud: Array, n: int, fit: Fit, robust: Any, tables: Any, w: Any) -> float:
    """Set up ``w.X`` and the gradient for `order_covariance`; returns the noise of the heights.

    `robust` is None for l2.
    """
    top = fit.top
    first = degree_start(top, fit.degree)
    count = degree_start(top, 0)
    if robust is not None:
        # The covariance of an l1 fit holds the Gram matrix of the weights before reweighting.
        assemble(cloud, WEIGHT, n, top, -1, w.G, w.diagonal, w.pivots, w.inverses, w)
        for i in range(1, first):
            w.inverses[i] = 0.0
    multiply_rows(cloud, WEIGHT, WEIGHT, n, PRODUCT)
    assemble(cloud, PRODUCT, n, top, -1, w.S, w.step, w.y, w.spare, w)
    rows = (count + PANEL - 1) // PANEL * PANEL
    for i in range(1, rows + 1):
        behind = rows + 1
        if w.y[i] > 0.0:
            behind = i + 1
        else:
            for j in range(1, rows + 1):
                w.S[i, j] = 0.0
        for j in range(behind, min(i + PANEL, rows + 1)):
            w.S[i, j] = 0.0
    for i in range(count + 1, rows + 1):
        w.S[i, i] = 0.0
    used = _solve_rows(w.S, count, PANEL, PANEL, w.G, w.inverses, w.X)
    _fill_binomials(fit.cx, fit.cy, top, tables, w)
    if fit.tangent:
        spread_out(w.c, top, w.table)
        for i in range(ROWS, ROWS + SIDE):
            for j in range(SIDE, 2 * SIDE):
                w.middle[i, j] = 0.0
        add_product(w.table, w.table, top + 1, 1.0, w.middle)
    total = 0.0
    squares = 0.0
    for i in range(n):
        total += cloud[WEIGHT, i]
        squares += cloud[WEIGHT, i] * cloud[RESIDUAL, i] * cloud[RESIDUAL, i]
    if robust is not None:
        # 1 / (2 f(0)), with the density f of the noise, which is taken to be normal about zero. An
        # l1 fit passes through as many points as it has coefficients: those are left out.
        return np.sqrt(np.pi / 2.0) * typical_residual(cloud, n, count + 1 - first)
    left = total - used
    return np.sqrt(squares / left) if left > 0.0 else np.inf


@inner
def spread_order(order: int, fit: Fit, w: Any) -> None:
    """Write X L^-T e to the rows of ``w.U`` for the coefficients x^(k-b) y^b about the origin.

    Their inner products are the covariances for unit noise.
    """
    top = fit.top
    end = degree_start(top, order) + order
    last = (end + PANEL - 1) // PANEL * PANEL
    _fill_shift(w.across, w.along, top, fit.degree, order, w.V)
    _solve_rows(w.V, order + 1, last, 0, w.G, w.inverses, w.Y)
    _combine(w.Y, order + 1, last, w.X, degree_start(top, 0), w.U)


@inner
def order_covariance(order: int, fit: Fit, noise: float, w: Any, out: Array, start: int) -> None:
    """Write the covariance of c_{k-b,b} about the origin, b = 0..k, to `out` from `start` on.

    Where the frame is tangent to the fitted surface, an error (a, b) of the gradient also turns it,
    which changes the heights h by -(a d/dx + b d/dy)(h^2) / 2. The spreads of the gradient are in
    ``w.gradient``.
    """
    spread_order(order, fit, w)
    count = degree_start(fit.top, 0)
    if fit.tangent:
        for b in range(order + 1):
            by_x = -0.5 * (order - b + 1) * w.middle[ROWS + order + 1, SIDE + b]
            by_y = -0.5 * (b + 1) * w.middle[ROWS + order + 1, SIDE + b + 1]
            for i in range(count + 1):
                w.U[1 + b, i] += by_x * w.gradient[0, i] + by_y * w.gradient[1, i]
    for b in range(1, order + 2):
        for i in range(count + 1, count + 1 + LANES):
            w.U[b, i] = 0.0
    _inner_products(w.U, order + 1, count, noise * noise, out, start)
