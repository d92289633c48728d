"""The l1 fit by weighted least squares with the weights of a primal-dual Newton step.

The smallest sum of w |r| is sought through that of w sqrt(r^2 + s^2) with s going to zero. Besides
the residuals r, a number y between -w and w is kept for each point, which tends to w r / |r|, or to
what balances the others where r tends to zero. Newton's equation for both is one weighted fit a
round (Chan, Golub and Mulet, A nonlinear primal-dual method for total variation-based image
restoration, SIAM J. Sci. Comput. 20, 1999). With y = 0 it is plain reweighting by 1 / |r|, which is
slower.
"""

from __future__ import annotations

from typing import Any

from pdtheory.conventions import Status
from pdtheory.pointset.kernels.fit import Fit
from pdtheory.pointset.kernels.jit import Array, inner
from pdtheory.pointset.kernels.lanes import LANES, Lanes, Rows, emit
from pdtheory.pointset.kernels.moments import DUAL, GAP, HEIGHT, RESIDUAL, REWEIGHT, WEIGHT, Z
from pdtheory.pointset.kernels.regression import (
    degree_start,
    fill_residuals,
    misfit,
    set_up,
    solve,
)
from pdtheory.pointset.kernels.tilting import shift

#: Most rounds, and relative change of the sum at which they end.
ROUNDS, CHANGE = 60, 3e-3
#: s as a fraction of the mean of |r|: at first, from round to round, and at least; and the least s
#: in units of the radius.
SMOOTH, SMOOTHER, SMOOTHEST, ROUNDING = 0.2, 0.2, 1e-3, 1e-16
#: Steps towards the next solution that are tried.
STEPS = (0.5, 1.0, 1.5, 2.0, 3.0)
#: How near y may come to w: as a fraction of its way there in one round, and of w in the weights.
NEAR, LEAST = 0.97, 1e-2

_NOT_CONVERGED = int(Status.NOT_CONVERGED)


@emit
def _pose(to: Lanes, cloud: Rows, n: Any, smooth: Any) -> None:
    """Write weights and heights of the fit that gives the step from the residuals in GAP.

    With p = sqrt(r^2 + s^2), the weights are (w - y r / p) s / p, and the heights times the
    weights are w s r / p, s times the slope of the sum that is to become smallest.
    """
    s = to.spread(smooth)
    square = to.times(s, s)
    tiny = to.constant(1e-300)
    with to.count(0, n, LANES) as i:
        w, r, y = (to.load(cloud.at(row, i)) for row in (WEIGHT, GAP, DUAL))
        inverse = to.divide(to.constant(1.0), to.root(to.add(to.times(r, r), square)))
        room = to.subtract(w, to.times(y, to.times(r, inverse)))
        room = to.larger(room, to.times(w, to.constant(LEAST)))
        to.store(to.times(to.times(room, inverse), s), cloud.at(REWEIGHT, i))
        # Behind the points, where all is zero, the height is to be finite.
        to.store(to.divide(to.times(w, r), to.larger(room, tiny)), cloud.at(Z, i))


@emit
def _survey(to: Lanes, cloud: Rows, n: Any, smooth: Any, out: Rows) -> None:
    """Write the sums of w |r| after each of the STEPS, then what limits the step of y.

    RESIDUAL holds what the fit leaves of the heights in Z. The limit is the largest step of y as a
    fraction of its way to -w or w.
    """
    zero, tiny = to.constant(0.0), to.constant(1e-300)
    scale = to.spread(to.builder.fdiv(to.real(1.0), smooth))
    totals = [to.variable(zero) for _ in STEPS]
    limit = to.variable(zero)
    with to.count(0, n, LANES) as i:
        w, r, y = (to.load(cloud.at(row, i)) for row in (WEIGHT, GAP, DUAL))
        move, turn = _changes(to, cloud, i, y, scale)
        for step, total in zip(STEPS, totals, strict=True):
            size = to.size(to.add(to.times(move, to.constant(step)), r))
            to.put(to.add(to.times(w, size), to.get(total)), total)
        ahead = to.builder.fcmp_ordered(">", turn, zero)
        way = to.builder.select(ahead, to.subtract(w, y), to.add(w, y))
        part = to.divide(to.size(turn), to.add(way, tiny))
        to.put(to.larger(to.get(limit), part), limit)
    to.store_sums(totals, out)
    to.put(to.largest(to.get(limit)), out.at(len(STEPS)))


@emit
def _advance(to: Lanes, cloud: Rows, n: Any, smooth: Any, step: Any, turn: Any) -> None:
    """Go on by `step` with the residuals in GAP, by `turn` with y."""
    by, part = to.spread(step), to.spread(turn)
    scale = to.spread(to.builder.fdiv(to.real(1.0), smooth))
    with to.count(0, n, LANES) as i:
        r, y = (to.load(cloud.at(row, i)) for row in (GAP, DUAL))
        move, whole = _changes(to, cloud, i, y, scale)
        to.store(to.add(to.times(move, by), r), cloud.at(GAP, i))
        to.store(to.add(to.times(whole, part), y), cloud.at(DUAL, i))


def _changes(to: Lanes, cloud: Rows, i: Any, y: Any, scale: Any) -> tuple[Any, Any]:
    """What a whole step changes in r and y; `scale` is 1 / s."""
    weight, z, left = (to.load(cloud.at(row, i)) for row in (REWEIGHT, Z, RESIDUAL))
    target = to.times(to.times(weight, left), scale)
    return to.subtract(left, z), to.subtract(target, y)


@inner
def fit_robustly(cloud: Array, n: int, fit: Fit, w: Any) -> Fit:
    """Go on from the least squares fit to that with the smallest sum of absolute residuals.

    ``w.c`` is about the origin afterwards, ``w.centred`` about the weighted mean; coordinates and
    residuals are those of `fit_point`. The pivot of the result is that of the last weights.
    """
    degree = fit.top
    weight = 0.0
    total = 0.0
    for i in range(n):
        cloud[HEIGHT, i] = cloud[Z, i]
        cloud[GAP, i] = cloud[RESIDUAL, i]
        cloud[DUAL, i] = 0.0
        weight += cloud[WEIGHT, i]
        total += cloud[WEIGHT, i] * abs(cloud[RESIDUAL, i])
    status = fit.status | _NOT_CONVERGED
    part = SMOOTH
    plain = True
    for _ in range(ROUNDS):
        smooth = max(part * total / weight, ROUNDING)
        part = max(part * SMOOTHER, SMOOTHEST)
        _pose(cloud, n, smooth)
        set_up(cloud, REWEIGHT, n, degree, w)
        solve(degree, fit.degree, w)
        fill_residuals(cloud, n, degree, w)
        _survey(cloud, n, smooth, w.spread)
        step = 0.0
        after = total
        for number, length in enumerate(STEPS):
            if w.spread[number] < after:
                after = w.spread[number]
                step = length
        turn = min(1.0, NEAR / max(w.spread[len(STEPS)], NEAR))
        # Where no step helps, y starts again: plain reweighting cannot fail.
        _advance(cloud, n, smooth, step, turn)
        for i in range(len(w.c)):
            w.centred[i] += step * w.c[i]
        settled = total - after <= CHANGE * after
        total = after
        if settled and (step > 0.0 or plain):
            status = fit.status
            break
        plain = step == 0.0
        if plain:
            for i in range(n):
                cloud[DUAL, i] = 0.0
    pivot = 1.0
    for i in range(degree_start(degree, fit.degree), degree_start(degree, 0) + 1):
        pivot = min(pivot, w.pivots[i])
    if pivot == 0.0:
        status |= _NOT_CONVERGED
    for i in range(n):
        cloud[Z, i] = cloud[HEIGHT, i]
    for i in range(len(w.c)):
        w.c[i] = w.centred[i]
    residual = misfit(cloud, n, degree, weight, w)
    shift(w.c, degree, fit.cx, fit.cy, w.table)
    return Fit(
        status, fit.degree, degree, fit.cx, fit.cy, residual, pivot, fit.neighbours, fit.tangent
    )
