"""One chunk of points, from neighbours to directions, without the interpreter lock."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from pdtheory.conventions import Status
from pdtheory.pointset.kernels.fit import Fit, Settings, fit_point
from pdtheory.pointset.kernels.frames import output_frame
from pdtheory.pointset.kernels.grid import COLUMNS, Grid, find_runs, gather, gather_listed, locate
from pdtheory.pointset.kernels.jit import Array, IntArray, inner, kernel
from pdtheory.pointset.kernels.moments import sum_moments
from pdtheory.pointset.kernels.regression import (
    coefficient_count,
    degree_start,
    factor,
    fill_gram,
)
from pdtheory.pointset.kernels.roots import critical_angles, evaluate, value
from pdtheory.pointset.kernels.tables import Scratch, Tables, make_scratch
from pdtheory.pointset.kernels.uncertainty import (
    coefficient_spread,
    direction_variances,
    fill_shift_powers,
    order_covariance,
    spread,
)

_UNANSWERED = int(Status.TOO_FEW_NEIGHBOURS | Status.DEGENERATE_FRAME)
_NON_FINITE = int(Status.NON_FINITE)


class Output(NamedTuple):
    """Results of one chunk of Q points, J orders, M rows for all directions together.

    `noise` is the standard deviation of the heights that the error bars rest on. Directions of
    order j of all points follow one another from row ``base[j]``.
    """

    frames: Any
    degree: Any
    neighbours: Any
    residual: Any
    noise: Any
    condition: Any
    status: Any
    phi: Any
    counts: Any
    isotropic: Any
    angle: Any
    vector: Any
    eigenvalue: Any
    strength: Any
    kind: Any
    angle_std: Any
    eigenvalue_std: Any


def make_output(size: int, orders: Any, columns: int) -> Output:
    """Allocate results for `size` points."""
    rows = size * int(2 * orders.sum())
    return Output(
        np.full((size, 3, 3), np.nan),
        np.zeros(size, np.int64),
        np.zeros(size, np.int64),
        np.full(size, np.nan),
        np.full(size, np.nan),
        np.full(size, np.nan),
        np.zeros(size, np.int64),
        np.full((size, columns), np.nan, np.complex128),
        np.zeros((len(orders), size), np.int64),
        np.zeros((len(orders), size), np.bool_),
        np.empty(rows),
        np.empty((rows, 3)),
        np.empty(rows),
        np.empty(rows),
        np.empty(rows, np.int8),
        np.empty(rows),
        np.empty(rows),
    )


@inner
def _write_phi(c: Array, fit: Fit, alpha: float, radius: float, tables: Tables, phi: Array) -> None:
    """Write all Wavejets coefficients in world units, in a frame turned by alpha."""
    column = 0
    scale = radius
    for k in range(fit.top + 1):
        start = degree_start(fit.top, k)
        for j in range(k // 2 + 1):
            re = 0.0
            im = 0.0
            for b in range(k + 1):
                re += tables.real[k, j, b] * c[start + b]
                im += tables.imaginary[k, j, b] * c[start + b]
            n = 2 * j + k % 2
            turn_re = np.cos(n * alpha)
            turn_im = np.sin(n * alpha)
            phi[column] = complex(
                (re * turn_re - im * turn_im) * scale, (re * turn_im + im * turn_re) * scale
            )
            column += 1
        scale /= radius
    for i in range(column, len(phi)):
        phi[i] = 0.0


@inner
def _insert(
    found: Array, count: int, angle: float, g: float, kind: float, angle_std: float, g_std: float
) -> None:
    """Insert a direction among the `count` rows of `found`, by ascending angle."""
    at = count
    while at > 0 and found[at - 1, 0] > angle:
        for i in range(5):
            found[at, i] = found[at - 1, i]
        at -= 1
    found[at, 0] = angle
    found[at, 1] = g
    found[at, 2] = kind
    found[at, 3] = angle_std
    found[at, 4] = g_std


@inner
def _rounding(fit: Fit, order: int, level: float, s: Scratch) -> float:
    """Size that rounding of the heights by `level` may give to the coefficients of one order."""
    start = degree_start(fit.top, order)
    total = 0.0
    for i in range(start, start + order + 1):
        total += 1.0 / s.diagonal[i]
    return 8.0 * level * np.sqrt(total / fit.pivot)


@inner
def _find_directions(
    order: int,
    fit: Fit,
    noise: float,
    level: float,
    alpha: float,
    settings: Settings,
    tables: Tables,
    s: Scratch,
) -> tuple[int, bool]:
    """Write the directions of one order at one point to ``s.found``, in units of the radius.

    Returns
    -------
    (int, bool)
        Number of directions, and whether g is constant.
    """
    start = degree_start(fit.top, order)
    swing = 0.0
    largest = 0.0
    for j in range(order // 2 + 1):
        re = 0.0
        im = 0.0
        for b in range(order + 1):
            re += tables.real[order, j, b] * s.c[start + b]
            im += tables.imaginary[order, j, b] * s.c[start + b]
        s.re[j] = re
        s.im[j] = im
        if 2 * j + order % 2 > 0:
            swing += np.hypot(re, im)
            largest = max(largest, np.hypot(re, im))
    if swing <= _rounding(fit, order, level, s):
        return 0, True
    for j in range(order // 2 + 1):
        s.re[j] /= largest
        s.im[j] /= largest
    found = critical_angles(
        s.re, s.im, order, tables.cosines, tables.sines, s.samples, s.stack, s.angle, s.kind
    )
    if settings.uncertainty:
        order_covariance(
            s.S,
            s.G,
            fit.first,
            coefficient_count(fit.top),
            fit.top,
            order,
            tables.binomial,
            s.powers,
            s.square,
            s.gradient,
            s.step,
            s.spreads,
            s.covariance,
        )
    mirror = -1.0 if order % 2 else 1.0
    for i in range(found):
        theta = s.angle[i]
        g = value(s.re, s.im, order, theta) * largest
        angle_std = np.nan
        g_std = np.nan
        if settings.uncertainty:
            slope, height = direction_variances(s.covariance, order, theta, s.spreads)
            curvature = abs(evaluate(s.re, s.im, order, theta)[1]) * largest
            angle_std = noise * np.sqrt(slope) / curvature if curvature > 0.0 else np.inf
            g_std = noise * np.sqrt(height)
        for turn in range(2):
            angle = (theta - alpha + turn * np.pi) % (2.0 * np.pi)
            sign = mirror if turn else 1.0
            _insert(s.found, 2 * i + turn, angle, sign * g, sign * s.kind[i], angle_std, g_std)
    return 2 * found, False


@inner
def _store(found: Array, count: int, row: int, unit: float, frame: Array, out: Output) -> None:
    """Copy directions to the output from row `row` on; `unit` turns g into lambda."""
    for i in range(count):
        angle = found[i, 0]
        c = np.cos(angle)
        s = np.sin(angle)
        out.angle[row + i] = angle
        for axis in range(3):
            out.vector[row + i, axis] = c * frame[0, axis] + s * frame[1, axis]
        out.eigenvalue[row + i] = found[i, 1] * unit
        out.strength[row + i] = abs(found[i, 1])
        out.kind[row + i] = np.int8(found[i, 2])
        out.angle_std[row + i] = found[i, 3]
        out.eigenvalue_std[row + i] = found[i, 4] * unit


@inner
def _noise_of_l1(cloud: Array, n: int, used: int) -> float:
    """Return the scale that stands for the noise in the covariance of an l1 fit.

    That is 1 / (2 f(0)) with the density f of the noise, taken to be normal about zero, where its
    standard deviation follows from the median of the absolute residuals. An l1 fit passes through
    as many points as it has coefficients, so that many residuals are left out.
    """
    sizes = cloud[9]
    inside = 0
    for i in range(n):
        if cloud[4, i] > 0.0:
            sizes[inside] = abs(cloud[8, i])
            inside += 1
    if inside <= used:
        return np.inf
    ordered = np.sort(sizes[:inside])
    return np.sqrt(np.pi / 2.0) * ordered[used + (inside - used) // 2] / 0.6744897501960817


@inner
def _prepare_uncertainty(
    cloud: Array, n: int, fit: Fit, settings: Settings, tables: Tables, s: Scratch
) -> float:
    """Set up ``s.S`` for the covariances; returns the standard deviation of the heights."""
    size = coefficient_count(fit.top)
    weights = cloud[4]
    squared = cloud[9]
    if settings.robust:
        # The covariance of an l1 fit holds the Gram matrix of the weights before reweighting.
        sum_moments(cloud[5], cloud[6], weights, n, 2 * fit.top, s.X, s.V, s.moments)
        fill_gram(s.moments, fit.top, s.offsets, s.G)
        factor(s.G, size, s.diagonal, s.pivots)
    total = 0.0
    squares = 0.0
    for i in range(n):
        squared[i] = weights[i] * weights[i]
        total += weights[i]
        squares += weights[i] * cloud[8, i] * cloud[8, i]
    sum_moments(cloud[5], cloud[6], squared, n, 2 * fit.top, s.X, s.V, s.moments)
    fill_gram(s.moments, fit.top, s.offsets, s.S)
    # The diagonal of G stays for the rounding bound.
    used = spread(s.G, s.S, fit.first, size, s.step, s.spare)
    fill_shift_powers(fit.cx, fit.cy, fit.top, s.powers)
    for axis in range(2):
        coefficient_spread(
            s.S,
            s.G,
            fit.first,
            size,
            fit.top,
            1 - axis,
            axis,
            tables.binomial,
            s.powers,
            s.step,
            s.gradient[axis],
        )
    if settings.robust:
        return _noise_of_l1(cloud, n, size - fit.first)
    left = total - used
    return np.sqrt(squares / left) if left > 0.0 else np.inf


@kernel
def run_chunk(
    grid: Grid,
    queries: Array,
    radii: Array,
    references: Array,
    lists: IntArray,
    valid: Any,
    orders: IntArray,
    base: IntArray,
    reach: float,
    coordinate_rounding: float,
    settings: Settings,
    tables: Tables,
    stop: Any,
    out: Output,
) -> int:
    """Compute a chunk of points.

    Parameters
    ----------
    grid : Grid
        All points.
    queries : (Q, 3) float64
        Where to compute.
    radii : (Q,) float64
        Radius at each.
    references : (Q, 3) float64
        Vectors that say on which side the normals are.
    lists : (Q, N) int64 or (0, 0)
        Neighbours as indices of ``grid.points``; empty to look them up within the radius.
    valid : (Q,) bool
        False where the query is not finite.
    orders, base : (J,) int64
        Orders to compute, and the first row of each in the output.
    reach : float
        Points are collected within `reach` radii.
    coordinate_rounding : float
        Rounding error of the coordinates.
    settings : Settings
        What is asked for.
    tables : Tables
        Constants.
    stop : (1,) uint8
        Set to non-zero by another thread to end the work.
    out : Output
        The results.

    Returns
    -------
    int
        Points completed.
    """
    scratch = make_scratch(max(settings.degree, 4), tables.full_disc)
    capacity = 1024
    cloud = np.empty((11, capacity))
    runs = np.empty((COLUMNS, 2), dtype=np.int64)
    count = total = 0
    last = np.array([-(2**60), 0, 0], dtype=np.int64)
    here = np.empty(3, dtype=np.int64)
    filled = np.empty(len(base), dtype=np.int64)
    for j in range(len(base)):
        filled[j] = base[j]
    for q in range(len(queries)):
        if stop[0] != 0:
            return q
        if not valid[q]:
            out.status[q] = _NON_FINITE
            continue
        qx = queries[q, 0]
        qy = queries[q, 1]
        qz = queries[q, 2]
        radius = radii[q]
        if lists.shape[0] > 0:
            total = lists.shape[1]
        else:
            locate(grid, queries[q], here)
            if here[0] != last[0] or here[1] != last[1] or here[2] != last[2]:
                for axis in range(3):
                    last[axis] = here[axis]
                count, total = find_runs(grid, here[0], here[1], here[2], runs)
        if total + 1 > capacity:
            capacity = 2 * (total + 1)
            cloud = np.empty((11, capacity))
        if not radius > 0.0:
            out.neighbours[q] = total
            out.status[q] = _UNANSWERED
            continue
        if lists.shape[0] > 0:
            n = gather_listed(grid.points, lists[q], qx, qy, qz, 1.0 / radius, cloud)
        else:
            n = gather(grid.points, runs, count, qx, qy, qz, reach * radius, 1.0 / radius, cloud)
        fit = fit_point(cloud, n, references[q], settings, scratch)
        out.neighbours[q] = fit.neighbours
        out.status[q] = fit.status
        if fit.status & _UNANSWERED:
            continue
        alpha = output_frame(scratch.frame, out.frames[q])
        out.degree[q] = fit.degree
        out.residual[q] = fit.residual * radius
        out.condition[q] = fit.pivot
        _write_phi(scratch.c, fit, alpha, radius, tables, out.phi[q])
        level = 2.3e-16 + coordinate_rounding / radius
        noise = np.nan
        if settings.uncertainty:
            noise = _prepare_uncertainty(cloud, n, fit, settings, tables, scratch)
            out.noise[q] = noise * radius
        for j in range(len(orders)):
            if orders[j] > fit.degree:
                continue
            written, isotropic = _find_directions(
                orders[j], fit, noise, level, alpha, settings, tables, scratch
            )
            unit = tables.factorial[orders[j]] * radius ** (1.0 - orders[j])
            _store(scratch.found, written, filled[j], unit, out.frames[q], out)
            out.counts[j, q] = written
            out.isotropic[j, q] = isotropic
            filled[j] += written
    return len(queries)
