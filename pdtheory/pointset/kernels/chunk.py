"""The fits of one chunk of points, without the interpreter lock."""

from __future__ import annotations

from typing import Any

import numpy as np

from pdtheory.conventions import Status
from pdtheory.pointset.kernels import results
from pdtheory.pointset.kernels.fit import Fit, Settings, finish, fit_point
from pdtheory.pointset.kernels.frames import output_frame
from pdtheory.pointset.kernels.grid import Grid, find_runs, gather, gather_listed, locate
from pdtheory.pointset.kernels.jit import Array, IntArray, inner, kernel
from pdtheory.pointset.kernels.lanes import LANES, Lanes, Rows, emit
from pdtheory.pointset.kernels.moments import SQUARED
from pdtheory.pointset.kernels.regression import degree_start
from pdtheory.pointset.kernels.results import Found, Traces
from pdtheory.pointset.kernels.reweighting import fit_robustly
from pdtheory.pointset.kernels.tables import MAX_DEGREE, SIDE
from pdtheory.pointset.kernels.uncertainty import (
    order_covariance,
    prepare_covariances,
    spread_order,
)
from pdtheory.pointset.kernels.weighing import OUTSIDE

_UNANSWERED = int(Status.TOO_FEW_NEIGHBOURS | Status.DEGENERATE_FRAME)
_NON_FINITE = int(Status.NON_FINITE)


@emit
def _transform(
    to: Lanes, c: Rows, degree: Any, real: Rows, imaginary: Rows, turns: Rows, scale: Any, out: Rows
) -> None:
    """Write real and imaginary parts of all phi_{k,n} to the rows of `out`.

    Parameters
    ----------
    c : (> coefficient count,) float64
        Coefficients, by descending degree from index 1 on.
    degree : int
        The degree.
    real, imaginary
        From the tables.
    turns : (4, SIDE / 2) float64
        Cosines of n alpha for n = 0, 2, ..., then sines, then the same for n = 1, 3, ....
    scale : float
        The radius.
    out : (2, > coefficient count / 2 + LANES) float64
        Receives the coefficients in world units, in a frame turned by alpha.
    """
    columns = range(0, SIDE // 2, LANES)
    place = to.variable(to.integer(0))
    unit = to.variable(scale)
    start = to.variable(to.div(to.mul(to.plus(degree, 1), to.plus(degree, 2)), 2))
    with to.count(0, to.plus(degree, 1)) as k:
        turn = to.mul(to.minus(k, to.mul(to.div(k, 2), 2)), 2)
        first, at = to.get(start), to.get(place)
        for j in columns:
            sums = [to.variable(to.constant(0.0)) for _ in range(2)]
            with to.count(0, to.plus(k, 1)) as b:
                value = to.spread(to.get(c.at(to.plus(first, b))))
                row = to.plus(to.mul(k, MAX_DEGREE + 1), b)
                for total, table in zip(sums, (real, imaginary), strict=True):
                    term = to.times(value, to.load(table.at(row, j)))
                    to.put(to.add(term, to.get(total)), total)
            world = to.spread(to.get(unit))
            re, im = (to.times(to.get(total), world) for total in sums)
            cos, sin = to.load(turns.at(turn, j)), to.load(turns.at(to.plus(turn, 1), j))
            # What goes beyond the order is written over by the next one.
            turned = to.subtract(to.times(re, cos), to.times(im, sin))
            to.store(turned, out.at(0, to.plus(at, j)))
            to.store(to.add(to.times(re, sin), to.times(im, cos)), out.at(1, to.plus(at, j)))
        to.put(to.plus(at, to.div(k, 2), 1), place)
        to.put(to.minus(first, to.plus(k, 2)), start)
        to.put(to.builder.fdiv(to.get(unit), scale), unit)


@inner
def _write_phi(
    c: Array, fit: Fit, c1: float, s1: float, radius: float, tables: Any, w: Any, phi: Array
) -> None:
    """Write all Wavejets coefficients in world units, in a frame turned by an angle."""
    re = 1.0
    im = 0.0
    for n in range(SIDE):
        row = 2 * (n % 2)
        w.turns[row, n // 2] = re
        w.turns[row + 1, n // 2] = im
        re, im = re * c1 - im * s1, re * s1 + im * c1
    _transform(c, fit.top, tables.real, tables.imaginary, w.turns, radius, w.planar)
    found = (fit.top + 2) * (fit.top + 2) // 4
    for i in range(found):
        phi[i] = complex(w.planar[0, i], w.planar[1, i])
    for i in range(found, len(phi)):
        phi[i] = 0.0


@inner
def _leave_open(out: Found, slot: int, neighbours: int, status: int) -> None:
    """Write that there is no answer at a point."""
    for i in range(results.NUMBERS):
        if i != results.RADIUS:
            out.numbers[slot, i] = np.nan
    out.numbers[slot, results.DEGREE] = 0.0
    out.numbers[slot, results.NEIGHBOURS] = neighbours
    out.numbers[slot, results.STATUS] = status
    for i in range(out.phi.shape[1]):
        out.phi[slot, i] = complex(np.nan, 0.0)


@inner
def _blur(fit: Fit, order: int, level: float, w: Any) -> float:
    """Size that rounding of the heights by `level` may give to the coefficients of one order."""
    start = degree_start(fit.top, order)
    total = 0.0
    for i in range(start, start + order + 1):
        total += 1.0 / w.diagonal[i]
    return 8.0 * level * np.sqrt(total / fit.pivot)


@inner
def _write_covariances(
    cloud: Array,
    n: int,
    fit: Fit,
    orders: IntArray,
    robust: Any,
    tables: Any,
    w: Any,
    out: Array,
) -> float:
    """Write the covariances of all orders up to the degree used; returns the noise."""
    noise = prepare_covariances(cloud, n, fit, robust, tables, w)
    if fit.tangent:
        spread_order(1, fit, w)
        for axis in range(2):
            for i in range(degree_start(fit.top, 0) + 1):
                w.gradient[axis, i] = w.U[1 + axis, i]
    entry = 0
    for order in orders:
        if order > fit.degree:
            break
        order_covariance(order, fit, noise, w, out, entry)
        entry += (order + 1) * (order + 1)
    return noise


@kernel
def fit_chunk(
    grid: Grid,
    queries: Array,
    references: Array,
    valid: Any,
    where: IntArray,
    lists: IntArray,
    orders: IntArray,
    reach: float,
    coordinate_rounding: float,
    settings: Settings,
    robust: Any,
    tables: Any,
    w: Any,
    cloud: Array,
    stop: Any,
    begin: int,
    traces: Traces,
    slots: IntArray,
    out: Found,
) -> int:
    """Fit the C points of a chunk from number `begin` on.

    Parameters
    ----------
    grid : Grid
        All points.
    queries : (Q, 3) float64
        All queries.
    references : (Q, 3) float64
        Vectors that say on which side the normals are.
    valid : (Q,) bool
        False where the query is not finite.
    where : (C,) int64
        Numbers of the queries of the chunk.
    lists : (C, N) int64 or (0, 0)
        Neighbours as columns of ``grid.columns``; empty to look them up within the radius.
    orders : (J,) int64
        Orders that covariances are wanted for, ascending.
    reach : float
        Points are collected within `reach` radii.
    coordinate_rounding : float
        Rounding error of the coordinates.
    settings : Settings
        What is asked for.
    robust : bool or None
        Not None for l1; with None that is not even compiled.
    tables, w : records of TABLES and WORKSPACE
        Constants and working memory.
    cloud : (CLOUD_ROWS, capacity) float64
        Memory for the neighbours of one point.
    stop : (1,) uint8
        Set to non-zero by another thread to end the work.
    begin : int
        Number of points that are done.
    traces : Traces
        Filled in for the points of the chunk.
    slots : (C,) int64
        Where in `out` their results go.
    out : Found
        Numbers and ``phi`` are filled in for them; the radius is there.

    Returns
    -------
    int
        Points done; or -1 - q if `cloud` is too small for point q: the capacity it needs is among
        its numbers, as its neighbours.
    """
    runs = w.runs
    last = w.cells[0]
    here = w.cells[1]
    last[0] = -(2**60)
    count = total = 0
    for q in range(begin, len(where)):
        if stop[0] != 0:
            return q
        slot = slots[q]
        if not valid[where[q]]:
            _leave_open(out, slot, 0, _NON_FINITE)
            continue
        query = queries[where[q]]
        reference = references[where[q]]
        radius = out.numbers[slot, results.RADIUS]
        if lists.shape[0] > 0:
            total = lists.shape[1]
        else:
            locate(grid, query, here)
            if here[0] != last[0] or here[1] != last[1] or here[2] != last[2]:
                for axis in range(3):
                    last[axis] = here[axis]
                count, total = find_runs(grid, here[0], here[1], here[2], runs)
        if total + LANES > cloud.shape[1]:
            out.numbers[slot, results.NEIGHBOURS] = total + LANES
            return -1 - q
        if not radius > 0.0:
            _leave_open(out, slot, total, _UNANSWERED)
            continue
        if lists.shape[0] > 0:
            points = gather_listed(grid.columns, lists[q], query, radius, cloud)
        else:
            points = int(gather(grid.columns, runs, count, query, reach, radius, cloud))
        n = points
        while n % LANES:
            for axis in range(3):
                cloud[axis, n] = 0.0
            cloud[SQUARED, n] = OUTSIDE
            n += 1
        fit = fit_point(cloud, points, n, reference, settings, w)
        # Numba leaves out a branch on None only if nothing else is asked with it.
        if robust is not None:  # noqa: SIM102
            if not fit.status & _UNANSWERED:
                fit = fit_robustly(cloud, n, fit, w)
        if fit.status & _UNANSWERED:
            _leave_open(out, slot, fit.neighbours, fit.status)
            continue
        numbers = out.numbers[slot]
        numbers[results.NEIGHBOURS] = fit.neighbours
        numbers[results.STATUS] = finish(fit, w)
        c, s = output_frame(w.frame, w.B)
        for axis in range(3):
            for i in range(3):
                numbers[results.FRAME + 3 * axis + i] = w.B[axis, i]
        traces.turn[q, 0] = c
        traces.turn[q, 1] = s
        numbers[results.DEGREE] = fit.degree
        numbers[results.RESIDUAL] = fit.residual * radius
        numbers[results.NOISE] = np.nan
        numbers[results.CONDITION] = fit.pivot
        _write_phi(w.c, fit, c, s, radius, tables, w, out.phi[slot])
        level = 2.3e-16 + coordinate_rounding / radius
        for j in range(len(orders)):
            if orders[j] <= fit.degree:
                traces.blur[q, j] = _blur(fit, orders[j], level, w)
        if settings.uncertainty:
            noise = _write_covariances(
                cloud, n, fit, orders, robust, tables, w, traces.covariance[q]
            )
            numbers[results.NOISE] = noise * radius
    return len(where)
