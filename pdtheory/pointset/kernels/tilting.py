"""Jets moved: the polynomial of a fit about another point, and in a turned frame.

Here the coefficients stand in tables (JET) by degree d and power b of y, from row ROWS and column
SIDE on; before them there are zeros, and behind the powers of each degree.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from pdtheory.pointset.kernels.cholesky import solve_transposed
from pdtheory.pointset.kernels.frames import tilt
from pdtheory.pointset.kernels.jit import Array, inner
from pdtheory.pointset.kernels.lanes import LANES, Lanes, Rows, emit
from pdtheory.pointset.kernels.regression import degree_start
from pdtheory.pointset.kernels.tables import ROWS, SIDE

#: Effect of a remaining tilt that is tolerated, as a fraction of the residual and of the height.
TILT_OF_RESIDUAL, TILT_OF_HEIGHT = 0.3, 1e-13

#: Margin of a rough bound on a spread.
ROUGH = 10.0

_PARTS = range(0, SIDE, LANES)


@emit
def spread_out(to: Lanes, c: Rows, degree: Any, table: Rows) -> None:
    """Write coefficients to a table by degree, with zeros one degree above them."""
    place = to.variable(to.integer(1))
    for part in _PARTS:
        to.store(to.constant(0.0), _entry(to, table, to.plus(degree, 1), part))
    with to.count(0, to.plus(degree, 1)) as lower:
        d = to.minus(degree, lower)
        at = to.get(place)
        for part in _PARTS:
            own = to.below(to.minus(to.plus(d, 1), part))
            value = to.builder.select(own, to.load(c.at(to.plus(at, part))), to.constant(0.0))
            to.store(value, _entry(to, table, d, part))
        to.put(to.plus(at, d, 1), place)


@emit
def _gather_in(to: Lanes, table: Rows, degree: Any, c: Rows) -> None:
    """Write a table back to the coefficients, and zeros behind them."""
    place = to.variable(to.integer(1))
    with to.count(0, to.plus(degree, 1)) as lower:
        d = to.minus(degree, lower)
        at = to.get(place)
        for part in _PARTS:
            # What goes beyond the degree is written over by the next one.
            value = to.load(_entry(to, table, d, part))
            to.store(value, c.at(to.plus(at, part)))
        to.put(to.plus(at, d, 1), place)


@emit
def _shift_table(to: Lanes, table: Rows, degree: Any, cx: Any, cy: Any) -> None:
    """Replace the powers of x - cx by those of x, and the powers of y - cy by those of y.

    Horner's scheme in x, for all powers of y at once, then in y along the powers of y: what stands
    at (d, b) takes part in a round as long as there are enough powers left.
    """
    for centre, by_x in ((cx, True), (cy, False)):
        by = to.spread(centre)
        with to.count(0, degree) as low:
            last = [to.variable(to.load(_entry(to, table, degree, part))) for part in _PARTS]
            with to.count(0, to.minus(degree, low)) as step:
                d = to.minus(to.plus(degree, -1), step)
                above = [to.get(place) for place in last]
                if not by_x:
                    behind = [*above[1:], to.constant(0.0)]
                    above = [to.next(u, v) for u, v in zip(above, behind, strict=True)]
                for number, part in enumerate(_PARTS):
                    at = _entry(to, table, d, part)
                    old = to.load(at)
                    new = to.subtract(old, to.times(by, above[number]))
                    if by_x:
                        own = to.below(to.minus(to.plus(d, 1), to.plus(low, part)))
                        new = to.builder.select(own, new, old)
                    else:
                        done = to.below(to.minus(low, part))
                        new = to.builder.select(done, old, new)
                    to.store(new, at)
                    to.put(new, last[number])


def _entry(to: Lanes, table: Rows, d: Any, column: Any) -> Any:
    """Address of an entry of a table."""
    return table.at(to.plus(d, ROWS), to.plus(column, SIDE))


@inner
def shift(c: Array, degree: int, cx: float, cy: float, table: Array) -> None:
    """Re-expand sum c_ab (x - cx)^a (y - cy)^b about the origin, in place and exactly.

    Parameters
    ----------
    c : (> coefficient count,) float64
        Coefficients, by descending degree from index 1 on.
    degree : int
        The degree.
    cx, cy : float
        The old centre.
    table : JET float64
        Scratch.
    """
    spread_out(c, degree, table)
    _shift_table(table, degree, cx, cy)
    _gather_in(table, degree, c)


@inner
def _fill_gradients(degree: int, x: float, y: float, w: Any) -> None:
    """Write the derivatives of the monomials at a point by x to ``w.v``, and by y to ``w.y``."""
    powers = w.powers
    powers[0, 0] = powers[1, 0] = 1.0
    powers[2, 0] = powers[3, 0] = 0.0
    for i in range(degree):
        powers[0, i + 1] = powers[0, i] * x
        powers[1, i + 1] = powers[1, i] * y
        powers[2, i + 1] = (i + 1) * powers[0, i]
        powers[3, i + 1] = (i + 1) * powers[1, i]
    row = 1
    for d in range(degree, -1, -1):
        for b in range(d + 1):
            w.v[row] = powers[2, d - b] * powers[1, b]
            w.y[row] = powers[0, d - b] * powers[3, b]
            row += 1


@inner
def gradient(c: Array, degree: int, x: float, y: float, w: Any) -> tuple[float, float]:
    """Return the derivatives of sum c_ab x^a y^b by x and y at a point."""
    by_x = 0.0
    by_y = 0.0
    _fill_gradients(degree, x, y, w)
    for i in range(1, degree_start(degree, 0)):
        by_x += c[i] * w.v[i]
        by_y += c[i] * w.y[i]
    return by_x, by_y


@inner
def slope_spread(degree: int, x: float, y: float, pivot: float, enough: float, w: Any) -> float:
    """Bound the standard deviation of the gradient at a point for noise of 1 in the heights.

    As no weight is above 1, the covariance of the coefficients is at most the inverse of the normal
    equations, G^-1 = L^-1 L^-T. That is worked out only if rougher bounds, from the diagonal of L
    and the smallest relative pivot, are above `enough`. The point is to be in the unit disc, where
    the gradient of a monomial is at most its degree.
    """
    count = degree_start(degree, 0)
    inverses = w.inverses
    # The least eigenvalue of a scaled matrix may be somewhat below its smallest pivot.
    rough = ROUGH / pivot
    total = 0.0
    for i in range(1, count + 1):
        total += inverses[i] * inverses[i]
    total *= rough * degree * degree
    if total < enough * enough:
        return np.sqrt(total)
    _fill_gradients(degree, x, y, w)
    by_x = w.v
    by_y = w.y
    total = 0.0
    for i in range(1, count + 1):
        total += (by_x[i] * by_x[i] + by_y[i] * by_y[i]) * inverses[i] * inverses[i]
    total *= rough
    if total < enough * enough:
        return np.sqrt(total)
    solve_transposed(w.G, count, inverses, by_x, w.step)
    solve_transposed(w.G, count, inverses, by_y, by_x)
    first = w.step
    total = 0.0
    for i in range(1, count + 1):
        total += first[i] * first[i] + by_x[i] * by_x[i]
    return np.sqrt(total)


@emit
def add_product(
    to: Lanes, first: Rows, second: Rows, degree: Any, factor: Any, target: Rows
) -> None:
    """Add `factor` times the product of two polynomials, up to a degree, to a third.

    The arrays are tables; `target` is to be another one, whose entries above the degree are
    scratch.
    """
    with to.count(0, to.plus(degree, 1), ROWS) as d:
        top = to.least(to.plus(d, ROWS - 1), degree)
        with to.count(0, to.plus(top, 1), LANES) as part:
            sums = [to.variable(to.constant(0.0)) for _ in range(ROWS)]
            with (
                to.count(0, to.plus(top, 1)) as d1,
                to.count(0, to.least(to.plus(d1, 1), to.plus(part, LANES))) as b1,
            ):
                f = to.spread(to.get(_entry(to, first, d1, b1)))
                column = to.minus(part, b1)
                for offset, total in enumerate(sums):
                    row = to.minus(to.plus(d, offset), d1)
                    term = to.times(f, to.load(_entry(to, second, row, column)))
                    to.put(to.add(term, to.get(total)), total)
            for offset, total in enumerate(sums):
                at = _entry(to, target, to.plus(d, offset), part)
                value = to.times(to.get(total), to.spread(factor))
                to.store(to.add(to.load(at), value), at)


@emit
def _fill_slope(to: Lanes, source: Rows, degree: Any, a: Any, b: Any, slope: Rows) -> None:
    """Write the derivative of a jet in the direction (a, b) to another table.

    The terms above the degree are taken to be zero.
    """
    across, along = to.spread(a), to.spread(b)
    with to.count(0, degree) as d:
        count = to.spread(to.builder.sitofp(to.plus(d, 1), to.real(0.0).type))
        terms = [to.load(_entry(to, source, to.plus(d, 1), part)) for part in _PARTS]
        for part, term, behind in zip(_PARTS, terms, [*terms[1:], to.constant(0.0)], strict=True):
            by_x = to.times(to.times(across, to.subtract(count, to.sequence(part))), term)
            by_y = to.times(to.times(along, to.sequence(part + 1)), to.next(term, behind))
            to.store(to.add(by_x, by_y), _entry(to, slope, d, part))
    for part in _PARTS:
        to.store(to.constant(0.0), _entry(to, slope, degree, part))


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
    target[ROWS + 1, SIDE] -= step * a
    target[ROWS + 1, SIDE + 1] -= step * b


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
    table, middle, slope : JET float64
        Scratch.
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
    _gather_in(table, degree, c)
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
