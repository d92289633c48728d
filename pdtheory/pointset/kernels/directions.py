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
#: Angles beyond this one are pi within rounding.
_HALF_CIRCLE = np.pi - 1e-15

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
    cosines=(2 * SIDE,),
    sines=(SIDE,),
    forms=(2, 2 * SIDE),
    variances=(LANES,),
)


@emit
def _square_forms(
    to: Lanes, matrix: Rows, start: Any, count: Any, vectors: Rows, out: Rows
) -> None:
    """Write v^T M v for the two rows v of `vectors` to `out`.

    The rows of the square matrix M follow one another from `start` on.
    """
    zero = to.constant(0.0)
    totals = [to.variable(zero) for _ in range(2)]
    with to.count(0, count, LANES) as part:
        lines = [to.variable(zero) for _ in totals]
        with to.count(0, count) as i:
            row = to.load(matrix.at(to.plus(start, to.mul(i, count), part)))
            for v, line in enumerate(lines):
                term = to.times(to.spread(to.get(vectors.at(v, i))), row)
                to.put(to.add(term, to.get(line)), line)
        # Behind the end of the rows there may be anything.
        there = to.below(to.minus(count, part))
        for v, (line, total) in enumerate(zip(lines, totals, strict=True)):
            known = to.builder.select(there, to.get(line), zero)
            term = to.times(known, to.load(vectors.at(v, part)))
            to.put(to.add(term, to.get(total)), total)
    to.store_sums(totals, out)


@emit
def _fill_forms(
    to: Lanes, order: Any, c: Any, s: Any, cosines: Rows, sines: Rows, forms: Rows
) -> None:
    """Write the derivatives of c^(k-b) s^b by the angle, b = 0..k, to row 0, and these to row 1.

    Parameters
    ----------
    order : int
        The order k.
    c, s : float
        Cosine and sine of the angle.
    cosines : (2 SIDE,) float64
        Scratch for c^a at SIDE - 1 - a.
    sines : (SIDE,) float64
        Scratch for s^b.
    forms : (2, 2 SIDE) float64
        Receives the rows, and zeros behind them up to SIDE; zeros in the second half.
    """
    zero = to.constant(0.0)
    powers = [to.variable(to.real(1.0)) for _ in range(2)]
    with to.count(0, to.plus(order, 1)) as i:
        for power, factor, at in (
            (powers[0], c, cosines.at(to.minus(SIDE - 1, i))),
            (powers[1], s, sines.at(i)),
        ):
            to.put(to.get(power), at)
            to.put(to.times(to.get(power), factor), power)
    parts = range(0, SIDE, LANES)
    for b in parts:
        by_c = to.load(cosines.at(to.plus(to.minus(SIDE - 1, order), b)))
        product = to.times(by_c, to.load(sines.at(b)))
        there = to.below(to.minus(to.plus(order, 1), b))
        to.store(to.builder.select(there, product, zero), forms.at(1, b))
    whole = to.spread(to.builder.sitofp(order, to.real(0.0).type))
    for b in parts:
        number = to.sequence(b)
        behind = to.times(to.subtract(whole, number), to.load(forms.at(1, b + 1)))
        before = to.times(number, to.load(forms.at(1, b - 1)))
        to.store(to.subtract(before, behind), forms.at(0, b))


@inner
def _deviations(
    covariance: Array, entry: int, order: int, c: float, s: float, bench: Any
) -> tuple[float, float]:
    """Return the standard deviations of g' and g at an angle, given its cosine and sine."""
    _fill_forms(order, c, s, bench.cosines, bench.sines, bench.forms)
    _square_forms(covariance, entry, order + 1, bench.forms, bench.variances)
    return np.sqrt(max(bench.variances[0], 0.0)), np.sqrt(max(bench.variances[1], 0.0))


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
        scale = results.scale_of_order(out.numbers[slot, results.RADIUS], order)
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
    order: int,
    entry: int,
    factorial: float,
    traces: Traces,
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
        largest = bench.largest[q - start]
        # What rounding has put at pi is the opposite of a direction at 0, and comes first.
        wraps = table[ANGLE, at + count - 1] > _HALF_CIRCLE
        for i in range(count):
            j = at + i
            way = 1.0
            if wraps:
                j = at + (i + count - 1) % count
                way = 1.0 if i else -1.0
            sign = way if order % 2 else 1.0
            c = way * table[COSINE, j]
            s = way * table[SINE, j]
            rows[row, results.ANGLE] = max(table[ANGLE, j], 0.0) if way > 0.0 else 0.0
            rows[row, results.COSINE] = c
            rows[row, results.SINE] = s
            rows[row, results.VALUE] = sign * table[VALUE, j] * largest
            rows[row, results.KIND] = sign * bench.kind[j]
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
                curvature = abs(table[CURVATURE, j]) * largest
                rows[row, results.ANGLE_STD] = slope / curvature if curvature > 0.0 else np.inf
                rows[row, results.EIGENVALUE_STD] = g_std * factorial / bench.scale[q - start]
            row += 1
        at += count
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
    rows : (>= C sum of orders, PLAIN or COLUMNS) float64
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
            row = _store(start, end, order, entry, factorial, traces, bench, row, rows)
        entry += (order + 1) * (order + 1)
    return row
