"""The l1 fit by iterative reweighting."""

from __future__ import annotations

from typing import Any

import numpy as np

from pdtheory.conventions import Status
from pdtheory.pointset.kernels.fit import Fit
from pdtheory.pointset.kernels.jit import Array, inner
from pdtheory.pointset.kernels.lanes import LANES, Lanes, Rows, emit
from pdtheory.pointset.kernels.moments import BEFORE, RESIDUAL, REWEIGHT, WEIGHT
from pdtheory.pointset.kernels.regression import (
    misfit,
    regress,
    settle,
)
from pdtheory.pointset.kernels.tilting import shift

#: Most rounds, relative change at which they stop, smallest residual as a fraction of the mean.
ROUNDS, CHANGE, FLOOR = 60, 2e-3, 1e-3

#: Steps towards the next solution that are tried: reweighting alone halves the number of rounds if
#: it goes twice as far, and often farther is better.
STEPS = (1.0, 1.5, 2.0, 3.0, 4.0)

_NOT_CONVERGED, _DEGENERATE = int(Status.NOT_CONVERGED), int(Status.DEGENERATE_FRAME)


@inner
def _along(before: float, now: float, step: float) -> float:
    """Value on the line through the last one and the present one."""
    return before + step * (now - before)


@emit
def _sum_along(to: Lanes, cloud: Rows, n: Any, out: Rows) -> None:
    """Write the weighted sums of the absolute residuals after each of the STEPS."""
    build, zero = to.builder, to.constant(0.0)
    totals = [to.variable(zero) for _ in STEPS]
    with to.count(0, n, LANES) as i:
        weight, before, now = (to.load(cloud.at(row, i)) for row in (WEIGHT, BEFORE, RESIDUAL))
        move = to.subtract(now, before)
        for step, total in zip(STEPS, totals, strict=True):
            r = to.add(to.times(move, to.constant(step)), before)
            size = build.select(build.fcmp_ordered("<", r, zero), to.subtract(zero, r), r)
            to.put(to.add(to.times(weight, size), to.get(total)), total)
    to.store_sums(totals, out)


@inner
def fit_robustly(cloud: Array, n: int, fit: Fit, w: Any) -> Fit:
    """Go on from the least squares fit to that with the smallest sum of absolute residuals.

    The row REWEIGHT of the cloud receives the last weights, w / |r| up to a factor. ``w.c`` is
    about the origin afterwards; coordinates, residuals and ``w.centred`` are those of `fit_point`.
    """
    degree = fit.top
    weight = 0.0
    for i in range(n):
        weight += cloud[WEIGHT, i]
    for i in range(len(w.c)):
        w.c[i] = w.centred[i]
    reached = fit.degree
    pivot = fit.pivot
    status = fit.status | _NOT_CONVERGED
    total = 0.0
    for i in range(n):
        total += cloud[WEIGHT, i] * abs(cloud[RESIDUAL, i])
    for _ in range(ROUNDS):
        floor = max(FLOOR * total / weight, 1e-16)
        for i in range(n):
            cloud[BEFORE, i] = cloud[RESIDUAL, i]
            cloud[REWEIGHT, i] = cloud[WEIGHT, i] * floor / max(abs(cloud[RESIDUAL, i]), floor)
        for i in range(len(w.c)):
            w.spare[i] = w.c[i]
        reached, pivot = regress(cloud, REWEIGHT, n, degree, w)
        if reached < 0:
            return Fit(
                fit.status | _DEGENERATE, 0, degree, 0.0, 0.0, np.nan, np.nan, fit.neighbours
            )
        settle(cloud, REWEIGHT, n, degree, weight, pivot, w)
        _sum_along(cloud, n, w.spread)
        best = STEPS[0]
        after = np.inf
        for number, step in enumerate(STEPS):
            if w.spread[number] < after:
                after = w.spread[number]
                best = step
        for i in range(n):
            cloud[RESIDUAL, i] = _along(cloud[BEFORE, i], cloud[RESIDUAL, i], best)
        for i in range(len(w.c)):
            w.c[i] = _along(w.spare[i], w.c[i], best)
        converged = total - after <= CHANGE * after
        total = after
        if converged:
            status = fit.status
            break
    residual = misfit(cloud, n, degree, weight, w)
    shift(w.c, degree, fit.cx, fit.cy, w.table, w.middle)
    return Fit(status, reached, degree, fit.cx, fit.cy, residual, pivot, fit.neighbours)
