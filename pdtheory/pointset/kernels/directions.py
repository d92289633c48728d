"""The principal directions of one chunk of jets."""

from __future__ import annotations

from typing import Any

import numpy as np

from pdtheory.pointset.kernels import results
from pdtheory.pointset.kernels.jit import Array, IntArray, inner, kernel
from pdtheory.pointset.kernels.lanes import LANES, Lanes, Rows, emit
from pdtheory.pointset.kernels.polishing import polish
from pdtheory.pointset.kernels.results import Found, Traces
from pdtheory.pointset.kernels.roots import (
    ANGLE,
    COEFFICIENTS,
    COSINE,
    CURVATURE,
    DEPTH,
    SINE,
    VALUE,
    bracket_angles,
)
from pdtheory.pointset.kernels.tables import SAMPLES, SIDE, layout

#: Points whose angles are polished together.
BATCH = 32


#: Memory of one thread.
BENCH = layout(
    re=(SIDE,),
    im=(SIDE,),
    samples=(2, SAMPLES + LANES),
    intervals=(SAMPLES + LANES,),
    stack=(DEPTH + 3, 6),
    table=(COEFFICIENTS + SIDE + 2, BATCH * SIDE + LANES),
    kind=(BATCH * SIDE,),
    found=(BATCH,),
    largest=(BATCH,),
    scale=(BATCH,),
    powers=(SIDE,),
    slopes=(SIDE,),
)


@emit
def _square_form(to: Lanes, matrix: Rows, start: Any, count: Any, v: Rows) -> float:
    """Return v^T M v for the square matrix M whose rows follow one another from `start` on."""
    total = to.variable(to.constant(0.0))
    zero = to.constant(0.0)
    with to.count(0, count, LANES) as part:
        line = to.variable(zero)
        with to.count(0, count) as i:
            at = to.plus(start, to.mul(i, count), part)
            term = to.times(to.spread(to.get(v.at(i))), to.load(matrix.at(at)))
            to.put(to.add(term, to.get(line)), line)
        # Behind the end of the rows there may be anything.
        there = to.below(to.minus(count, part))
        term = to.times(to.builder.select(there, to.get(line), zero), to.load(v.at(part)))
        to.put(to.add(term, to.get(total)), total)
    return to.lane(to.sums([to.get(total)] * LANES), 0)


@inner
def _deviations(
    covariance: Array, entry: int, order: int, c: float, s: float, bench: Any
) -> tuple[float, float]:
    """Return the standard deviations of g' and g at an angle, given its cosine and sine."""
    power = 1.0
    for b in range(order + 1):
        bench.powers[b] = power
        power *= s
    power = 1.0
    for b in range(order, -1, -1):
        bench.powers[b] *= power
        power *= c
    for b in range(order + 1):
        # d/dtheta of c^(k-b) s^b, in the same products.
        slope = 0.0
        if b < order:
            slope -= (order - b) * bench.powers[b + 1]
        if b > 0:
            slope += b * bench.powers[b - 1]
        bench.slopes[b] = slope
    of_slope = _square_form(covariance, entry, order + 1, bench.slopes)
    of_value = _square_form(covariance, entry, order + 1, bench.powers)
    return np.sqrt(max(of_slope, 0.0)), np.sqrt(max(of_value, 0.0))


@inner
def _scale_term(phi: Any, column: int, order: int, unit: float, bench: Any) -> tuple[float, float]:
    """Write the coefficients of one order in units of the largest; returns its size and the sum."""
    largest = 0.0
    swing = 0.0
    for j in range(order // 2 + 1):
        re = phi[column + j].real * unit
        im = phi[column + j].imag * unit
        bench.re[j] = re
        bench.im[j] = im
        if 2 * j + order % 2 > 0:
            size = np.sqrt(re * re + im * im)
            swing += size
            largest = max(largest, size)
    if largest > 0.0:
        for j in range(order // 2 + 1):
            bench.re[j] /= largest
            bench.im[j] /= largest
    return largest, swing


@inner
def _bracket(
    start: int,
    end: int,
    j: int,
    order: int,
    column: int,
    traces: Traces,
    slots: IntArray,
    out: Found,
    tables: Any,
    bench: Any,
) -> int:
    """Write the brackets of the angles of some points to the table; returns their number.

    Counting the references of whole tuples takes time, so these are handed to a function for many
    points at once.
    """
    total = 0
    for q in range(start, end):
        bench.found[q - start] = 0
        slot = slots[q]
        out.counts[j, slot] = 0
        if not out.numbers[slot, results.DEGREE] >= order:
            continue
        scale = 1.0
        for _ in range(order - 1):
            scale *= out.numbers[slot, results.RADIUS]
        bench.scale[q - start] = scale
        largest, swing = _scale_term(out.phi[slot], column, order, scale, bench)
        bench.largest[q - start] = largest
        if swing <= traces.blur[q, j]:
            out.counts[j, slot] = -1
            continue
        found = bracket_angles(
            bench.re,
            bench.im,
            order,
            tables.cosines,
            tables.sines,
            bench.samples,
            bench.intervals,
            bench.stack,
            bench.table,
            bench.kind,
            total,
        )
        bench.found[q - start] = found
        out.counts[j, slot] = found
        total += found
    return total


@inner
def _store(
    start: int,
    end: int,
    j: int,
    order: int,
    entry: int,
    factorial: float,
    traces: Traces,
    slots: IntArray,
    out: Found,
    bench: Any,
    row: int,
    rows: Array,
) -> int:
    """Write the directions of some points from `row` on; returns the first row behind them."""
    table = bench.table
    uncertain = traces.covariance.shape[1] > 0
    at = 0
    for q in range(start, end):
        count = int(bench.found[q - start])
        if count == 0:
            continue
        numbers = out.numbers[slots[q]]
        unit = factorial / bench.scale[q - start]
        largest = bench.largest[q - start]
        for _ in range(count):
            c = table[COSINE, at]
            s = table[SINE, at]
            g = table[VALUE, at] * largest
            angle_std = np.nan
            g_std = np.nan
            if uncertain:
                turn_c = traces.turn[q, 0]
                turn_s = traces.turn[q, 1]
                slope, g_std = _deviations(
                    traces.covariance[q],
                    entry,
                    order,
                    c * turn_c - s * turn_s,
                    s * turn_c + c * turn_s,
                    bench,
                )
                curvature = abs(table[CURVATURE, at]) * largest
                angle_std = slope / curvature if curvature > 0.0 else np.inf
            rows[row, results.ANGLE] = table[ANGLE, at]
            for axis in range(3):
                first = numbers[results.FRAME + axis]
                rows[row, results.VECTOR + axis] = c * first + s * numbers[results.FRAME + 3 + axis]
            rows[row, results.EIGENVALUE] = g * unit
            rows[row, results.STRENGTH] = abs(g)
            rows[row, results.ANGLE_STD] = angle_std
            rows[row, results.EIGENVALUE_STD] = g_std * unit
            rows[row, results.KIND] = bench.kind[at]
            row += 1
            at += 1
    return row


@kernel
def find_directions(
    orders: IntArray,
    tables: Any,
    bench: Any,
    stop: Any,
    traces: Traces,
    slots: IntArray,
    out: Found,
    rows: Array,
) -> int:
    """Find the directions at the C points of a chunk.

    Parameters
    ----------
    orders : (J,) int64
        Orders, ascending.
    tables, bench : records of TABLES and BENCH
        Constants and working memory.
    stop : (1,) uint8
        Set to non-zero by another thread to end the work.
    traces, slots, out
        As `fit_chunk` leaves them; ``counts`` are filled in.
    rows : (>= C sum of orders, COLUMNS) float64
        Receives the directions of the half circle, order by order and, in each, point by point.

    Returns
    -------
    int
        Number of rows.
    """
    entry = 0
    row = 0
    for j in range(len(orders)):
        order = orders[j]
        column = 0
        for k in range(order):
            column += k // 2 + 1
        for start in range(0, len(slots), BATCH):
            if stop[0] != 0:
                return row
            end = min(start + BATCH, len(slots))
            total = _bracket(start, end, j, order, column, traces, slots, out, tables, bench)
            polish(bench.table, order, total)
            factorial = tables.factorial[order]
            row = _store(
                start, end, j, order, entry, factorial, traces, slots, out, bench, row, rows
            )
        entry += (order + 1) * (order + 1)
    return row
