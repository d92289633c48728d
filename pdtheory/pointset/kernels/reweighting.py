"""The l1 fit by iterative reweighting."""

from __future__ import annotations

from typing import Any

import numpy as np

from pdtheory.conventions import Status
from pdtheory.pointset.kernels.fit import Fit, Settings, project
from pdtheory.pointset.kernels.jit import Array, inner
from pdtheory.pointset.kernels.moments import RESIDUAL, REWEIGHT, WEIGHT
from pdtheory.pointset.kernels.regression import (
    misfit,
    refine,
    regress,
    rounding_counts,
)
from pdtheory.pointset.kernels.tilting import shift

#: Most rounds, relative change at which they stop, smallest residual as a fraction of the mean.
ROUNDS, CHANGE, FLOOR = 60, 1e-3, 1e-3

_NOT_CONVERGED, _DEGENERATE = int(Status.NOT_CONVERGED), int(Status.DEGENERATE_FRAME)


@inner
def fit_robustly(cloud: Array, points: int, n: int, fit: Fit, settings: Settings, w: Any) -> Fit:
    """Go on from the least squares fit to that with the smallest sum of absolute residuals.

    The row REWEIGHT of the cloud receives the last weights, w / |r| up to a factor. ``w.c`` is
    about the origin before and after.
    """
    degree = fit.top
    cx, cy, weight = project(cloud, points, n, settings.planar, w)
    reached, pivot = regress(cloud, WEIGHT, n, degree, w)
    residual = misfit(cloud, n, degree, weight, w)
    status = fit.status | _NOT_CONVERGED
    before = np.inf
    for _ in range(ROUNDS):
        total = 0.0
        for i in range(n):
            total += cloud[WEIGHT, i] * abs(cloud[RESIDUAL, i])
        if before - total <= CHANGE * total and before < np.inf:
            status = fit.status
            break
        before = total
        floor = max(FLOOR * total / weight, 1e-16)
        for i in range(n):
            cloud[REWEIGHT, i] = cloud[WEIGHT, i] * floor / max(abs(cloud[RESIDUAL, i]), floor)
        reached, pivot = regress(cloud, REWEIGHT, n, degree, w)
        if reached < 0:
            return Fit(fit.status | _DEGENERATE, 0, degree, cx, cy, np.nan, np.nan, fit.neighbours)
        residual = misfit(cloud, n, degree, weight, w)
        if rounding_counts(pivot, residual):
            refine(cloud, REWEIGHT, n, degree, w)
            residual = misfit(cloud, n, degree, weight, w)
    shift(w.c, degree, cx, cy, w.table, w.middle)
    return Fit(status, reached, degree, cx, cy, residual, pivot, fit.neighbours)
