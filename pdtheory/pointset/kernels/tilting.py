"""Jets moved: the polynomial of a fit about another point, and in a turned frame."""

from __future__ import annotations

from typing import Any

import numpy as np

from pdtheory.pointset.kernels.frames import tilt
from pdtheory.pointset.kernels.jit import Array, inner
from pdtheory.pointset.kernels.lanes import LANES, Lanes, Rows, emit
from pdtheory.pointset.kernels.regression import degree_start
from pdtheory.pointset.kernels.tables import ROWS, SIDE

#: Effect of a remaining tilt that is tolerated, as a fraction of the residual and of the height.
TILT_OF_RESIDUAL, TILT_OF_HEIGHT = 0.3, 1e-13


@emit
def spread_out(to: Lanes, c: Rows, degree: Any, table: Rows) -> None:
    """Write coefficients to a table by powers, with zeros one degree above them."""
    above = to.plus(degree, 2)
    with to.count(0, above) as a, to.count(0, above, LANES) as b:
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
    with to.count(0, to.plus(degree, 1), LANES) as part, to.count(0, degree) as low:
        last = to.variable(to.load(table.at(degree, part)))
        with to.count(0, to.minus(degree, low)) as step:
            at = table.at(to.minus(to.plus(degree, -1), step), part)
            to.put(to.subtract(to.load(at), to.times(by, to.get(last))), last)
            to.store(to.get(last), at)


@emit
def _transpose(to: Lanes, table: Rows, degree: Any, out: Rows) -> None:
    """Write the transpose of a table, zeros above the degree."""
    with to.count(0, to.plus(degree, 1)) as b:
        with to.count(0, to.plus(degree, 1), LANES) as part:
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
    spread_out(c, degree, table)
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
        Coefficients by powers; those above the degree are not looked at.
    second : (SIDE + 2 ROWS, 2 SIDE) float64
        The same, SIDE columns further right and ROWS rows further down, with zeros before.
    target : (SIDE, >= SIDE) float64
        Receives the sum; entries above the degree are scratch.
    """
    with to.count(0, to.plus(degree, 1), ROWS) as i:
        left = to.minus(degree, i)
        with to.count(0, to.plus(left, 1), LANES) as part:
            sums = [to.variable(to.constant(0.0)) for _ in range(ROWS)]
            with to.count(0, to.least(to.plus(i, ROWS), to.plus(degree, 1))) as i1:
                most = to.minus(degree, to.greatest(i, i1))
                with to.count(0, to.least(to.plus(most, 1), to.plus(part, LANES))) as j1:
                    f = to.spread(to.get(first.at(i1, j1)))
                    column = to.plus(SIDE, to.minus(part, j1))
                    for offset, total in enumerate(sums):
                        row = to.plus(ROWS + offset, to.minus(i, i1))
                        term = to.times(f, to.load(second.at(row, column)))
                        to.put(to.add(term, to.get(total)), total)
            for offset, total in enumerate(sums):
                at = target.at(to.plus(i, offset), part)
                value = to.times(to.get(total), to.spread(factor))
                to.store(to.add(to.load(at), value), at)


@emit
def _fill_slope(to: Lanes, source: Rows, degree: Any, a: Any, b: Any, slope: Rows) -> None:
    """Write the derivative of a jet in the direction (a, b), as `add_product` wants it.

    What it would need of the terms above the degree is zero.
    """
    along = to.spread(b)
    with to.count(0, to.plus(degree, 1)) as i:
        times = to.builder.sitofp(to.plus(i, 1), to.real(0.0).type)
        across = to.spread(to.builder.fmul(a, times))
        powers = to.variable(to.times(along, to.sequence(1)))
        with to.count(0, to.plus(degree, 1), LANES) as part:
            by_x = to.times(across, to.load(source.at(to.plus(i, 1), part)))
            by_y = to.times(to.get(powers), to.load(source.at(i, to.plus(part, 1))))
            to.store(to.add(by_x, by_y), slope.at(to.plus(i, ROWS), to.plus(SIDE, part)))
            to.put(to.add(to.get(powers), to.times(along, to.constant(float(LANES)))), powers)
        to.put(to.real(0.0), slope.at(to.plus(i, ROWS), to.plus(SIDE, to.minus(degree, i))))


@inner
def _turn(
    source: Array, target: Array, degree: int, step: float, a: float, b: float, slope: Array
) -> None:
    """Add `step` times the rate of change of the jet `source`, when its frame turns, to `target`.

    Turning the frame about the origin towards the unit direction (a, b) changes the heights h at
    the rate -h (a d/dx + b d/dy) h - (a x + b y).
    """
    _fill_slope(source, degree, a, b, slope)
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
    table, middle : (SIDE + 1, >= SIDE + LANES) float64
        Scratch.
    slope : (SIDE + 2 ROWS, 2 SIDE) float64
        Scratch whose left half and first rows are zero.
    """
    last = degree_start(degree, 0)
    size = np.sqrt(c[last - 2] * c[last - 2] + c[last - 1] * c[last - 1])
    if size == 0.0:
        return
    a = c[last - 2] / size
    b = c[last - 1] / size
    tilt(frame, c[last - 2], c[last - 1])
    angle = np.arctan(size)
    spread_out(c, degree, table)
    spread_out(c, degree, middle)
    _turn(table, middle, degree, 0.5 * angle, a, b, slope)
    _turn(middle, table, degree, angle, a, b, slope)
    row = 1
    for d in range(degree, -1, -1):
        for j in range(d + 1):
            c[row] = table[d - j, j]
            row += 1
    c[last - 2] = 0.0
    c[last - 1] = 0.0


@inner
def tilt_matters(c: Array, degree: int, residual: float, norms: Array) -> bool:
    """Whether the gradient at the origin disturbs the fit by more than is tolerated.

    A tilt adds (a d/dx + b d/dy)(h^2) / 2 to the heights, of which the terms above the degree
    cannot be undone after the fit, nor the effects of third order; both are bounded at half the
    radius.
    """
    last = degree_start(degree, 0)
    slope = np.sqrt(c[last - 2] * c[last - 2] + c[last - 1] * c[last - 1])
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
