"""Jets moved: the polynomial of a fit about another point, and in a turned frame."""

from __future__ import annotations

from typing import Any

import numpy as np

from pdtheory.pointset.kernels.frames import tilt
from pdtheory.pointset.kernels.jit import Array, inner
from pdtheory.pointset.kernels.lanes import LANES, Lanes, Rows, emit
from pdtheory.pointset.kernels.regression import degree_start
from pdtheory.pointset.kernels.tables import SIDE

#: Effect of a remaining tilt that is tolerated, as a fraction of the residual and of the height.
TILT_OF_RESIDUAL, TILT_OF_HEIGHT = 0.3, 1e-13


@emit
def _spread_out(to: Lanes, c: Rows, degree: Any, table: Rows) -> None:
    """Write coefficients to a table by powers, zeros elsewhere."""
    with to.count(0, SIDE) as a:
        for b in range(0, SIDE, LANES):
            to.store(to.constant(0.0), table.at(a, b))
    row = to.variable(to.integer(1))
    with to.count(0, to.plus(degree, 1)) as lower:
        d = to.minus(degree, lower)
        with to.count(0, to.plus(d, 1)) as b:
            at = to.get(row)
            to.put(to.get(c.at(at)), table.at(to.minus(d, b), b))
            to.put(to.plus(at, 1), row)


@emit
def _shift_rows(to: Lanes, table: Rows, degree: Any, centre: Any) -> None:
    """Replace the powers x^a of the rows by those of x - centre."""
    by = to.spread(centre)
    parts = range(0, SIDE, LANES)
    with to.count(0, degree) as low:
        last = [to.variable(to.load(table.at(degree, part))) for part in parts]
        with to.count(0, to.minus(degree, low)) as step:
            row = to.minus(to.plus(degree, -1), step)
            for part, value in zip(parts, last, strict=True):
                at = table.at(row, part)
                moved = to.subtract(to.load(at), to.times(by, to.get(value)))
                to.put(moved, value)
                to.store(moved, at)


@emit
def _transpose(to: Lanes, table: Rows, degree: Any, out: Rows) -> None:
    """Write the transpose of a table, zeros above the degree."""
    with to.count(0, to.plus(degree, 1)) as b:
        for part in range(0, SIDE, LANES):
            to.store(to.constant(0.0), out.at(b, part))
        with to.count(0, to.plus(to.minus(degree, b), 1)) as a:
            to.put(to.get(table.at(a, b)), out.at(b, a))


@inner
def shift(c: Array, degree: int, cx: float, cy: float, table: Array, turned: Array) -> None:
    """Re-expand sum c_ab (x - cx)^a (y - cy)^b about the origin, in place and exactly.

    Parameters
    ----------
    c : (> coefficient count,) float64
        Coefficients, by descending degree from index 1 on.
    degree : int
        The degree.
    cx, cy : float
        The old centre.
    table, turned : (SIDE, >= SIDE) float64
        Scratch.
    """
    _spread_out(c, degree, table)
    _shift_rows(table, degree, cx)
    _transpose(table, degree, turned)
    _shift_rows(turned, degree, cy)
    row = 1
    for d in range(degree, -1, -1):
        for b in range(d + 1):
            c[row] = turned[b, d - b]
            row += 1


@inner
def gradient(c: Array, degree: int, x: float, y: float, powers: Array) -> tuple[float, float]:
    """Return the derivatives of sum c_ab x^a y^b by x and y.

    Parameters
    ----------
    c, degree
        The coefficients, as for `shift`.
    x, y : float
        Where.
    powers : (2, > degree) float64
        Scratch.
    """
    powers[0, 0] = 1.0
    powers[1, 0] = 1.0
    for i in range(degree):
        powers[0, i + 1] = powers[0, i] * x
        powers[1, i + 1] = powers[1, i] * y
    by_x = 0.0
    by_y = 0.0
    row = 1
    for d in range(degree, -1, -1):
        for b in range(d + 1):
            if b < d:
                by_x += c[row] * (d - b) * powers[0, d - b - 1] * powers[1, b]
            if b > 0:
                by_y += c[row] * b * powers[0, d - b] * powers[1, b - 1]
            row += 1
    return by_x, by_y


@emit
def add_product(
    to: Lanes, first: Rows, second: Rows, degree: Any, factor: Any, target: Rows
) -> None:
    """Add `factor` times the product of two polynomials, up to a degree, to a third.

    Parameters
    ----------
    first : (SIDE, >= SIDE) float64
        Coefficients by powers.
    second : (SIDE, 2 SIDE) float64
        The same, SIDE columns further right, with zeros before.
    target : (SIDE, >= SIDE) float64
        Receives the sum; entries above the degree are scratch.
    """
    with to.count(0, to.plus(degree, 1)) as i:
        parts = range(SIDE // LANES)
        sums = [to.variable(to.constant(0.0)) for _ in parts]
        with to.count(0, to.plus(i, 1)) as i1, to.count(0, to.plus(to.minus(degree, i), 1)) as j1:
            f = to.spread(to.get(first.at(i1, j1)))
            row = to.minus(i, i1)
            for part in parts:
                column = to.minus(SIDE + part * LANES, j1)
                term = to.times(f, to.load(second.at(row, column)))
                to.put(to.add(to.get(sums[part]), term), sums[part])
        for part in parts:
            at = target.at(i, part * LANES)
            value = to.times(to.get(sums[part]), to.spread(factor))
            to.store(to.add(to.load(at), value), at)


@inner
def _turn(
    source: Array, target: Array, degree: int, step: float, a: float, b: float, slope: Array
) -> None:
    """Add `step` times the rate of change of the jet `source`, when its frame turns, to `target`.

    Turning the frame about the origin towards the unit direction (a, b) changes the heights h at
    the rate -h (a d/dx + b d/dy) h - (a x + b y).
    """
    for i in range(degree + 1):
        for j in range(degree + 1):
            slope[i, SIDE + j] = a * (i + 1) * source[i + 1, j] + b * (j + 1) * source[i, j + 1]
    add_product(source, slope, degree, -step, target)
    target[1, 0] -= step * a
    target[0, 1] -= step * b


@inner
def untilt(c: Array, degree: int, frame: Array, table: Array, middle: Array, slope: Array) -> None:
    """Turn frame and jet so that the gradient at the origin vanishes.

    The jet follows the rotation by one midpoint step, so the error is of third order in the slope.

    Parameters
    ----------
    c, degree
        The jet.
    frame : (3, 3) float64
        The frame.
    table, middle : (SIDE + 1, >= SIDE + 1) float64
        Scratch; `table` receives the turned jet by powers.
    slope : (SIDE + 1, 2 SIDE) float64
        Scratch whose left half is zero.
    """
    last = degree_start(degree, 0)
    size = np.hypot(c[last - 2], c[last - 1])
    _spread_out(c, degree, table)
    if size == 0.0:
        return
    a = c[last - 2] / size
    b = c[last - 1] / size
    tilt(frame, c[last - 2], c[last - 1])
    angle = np.arctan(size)
    _spread_out(c, degree, middle)
    _turn(table, middle, degree, 0.5 * angle, a, b, slope)
    _clip(middle, degree)
    _turn(middle, table, degree, angle, a, b, slope)
    _clip(table, degree)
    table[1, 0] = 0.0
    table[0, 1] = 0.0
    row = 1
    for d in range(degree, -1, -1):
        for j in range(d + 1):
            c[row] = table[d - j, j]
            row += 1


@inner
def _clip(table: Array, degree: int) -> None:
    """Set the entries above the degree to zero."""
    for i in range(SIDE):
        for j in range(max(degree + 1 - i, 0), SIDE):
            table[i, j] = 0.0


@inner
def tilt_matters(c: Array, degree: int, residual: float, norms: Array) -> bool:
    """Whether the gradient at the origin disturbs the fit by more than is tolerated.

    A tilt adds (a d/dx + b d/dy)(h^2) / 2 to the heights, of which the terms above the degree
    cannot be undone after the fit, nor the effects of third order; both are bounded at half the
    radius.
    """
    last = degree_start(degree, 0)
    slope = np.hypot(c[last - 2], c[last - 1])
    height = 0.0
    scale = 1.0
    for d in range(degree + 1):
        start = degree_start(degree, d)
        total = 0.0
        for i in range(start, start + d + 1):
            total += abs(c[i])
        norms[d] = total * scale
        height += norms[d]
        scale *= 0.5
    beyond = 0.0
    for d1 in range(2, degree + 1):
        for d2 in range(max(2, degree + 2 - d1), degree + 1):
            beyond += (d1 + d2) * norms[d1] * norms[d2]
    effect = slope * (beyond + slope * slope * height)
    return effect > max(TILT_OF_RESIDUAL * residual, TILT_OF_HEIGHT * height)
