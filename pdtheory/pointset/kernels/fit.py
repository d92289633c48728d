"""The fit at one point: weights, frame, regression, and the jet in the tangent frame."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from pdtheory.conventions import Status
from pdtheory.pointset.kernels.frames import face, principal_frame, tilt
from pdtheory.pointset.kernels.jit import Array, inner
from pdtheory.pointset.kernels.moments import WEIGHT
from pdtheory.pointset.kernels.regression import (
    degree_start,
    doubtful,
    regress,
    settle,
)
from pdtheory.pointset.kernels.tilting import gradient, shift, tilt_matters, untilt
from pdtheory.pointset.kernels.weighing import project, weigh

#: Frames: tangent to the fitted surface, principal axes, normal to the given vectors.
FRAME_TANGENT, FRAME_PRINCIPAL, FRAME_GIVEN = 0, 1, 2
#: Degree of the fit that tilts the frame first; that of a fit of no higher degree is one less.
PREFIT_DEGREE = 4
#: Neighbours that a fit must have for each coefficient.
MARGIN = 1.25
#: Tilts with the full fit.
RETILTS = 8
#: A tilt must leave less than the first part of the slope, and no more than the second multiple of
#: the residual.
STEADY, WORSE = 0.5, 2.0
#: With l1 the residual may be that of outliers, so a tenth of it decides about another tilt.
TRUST_L1 = 0.1
#: Distance of the weighted centroid, as a fraction of the radius, of a one-sided neighbourhood.
ONE_SIDED = 0.18

_TOO_FEW = int(Status.TOO_FEW_NEIGHBOURS)
_DEGENERATE = int(Status.DEGENERATE_FRAME)
_LOWERED = int(Status.DEGREE_LOWERED)
_ILL = int(Status.ILL_CONDITIONED)
_REFINED = int(Status.REFINED)
_ONE_SIDED = int(Status.ONE_SIDED)
_UNORIENTED = int(Status.UNORIENTED)


class Settings(NamedTuple):
    """What is asked for, the same at all points.

    Attributes
    ----------
    degree : int
        K.
    frame : int
        One of the ``FRAME_`` constants.
    planar : bool
        Weights and neighbourhood by distance in the tangent plane instead of in space.
    robust : bool
        l1 instead of l2.
    uncertainty : bool
        Whether standard deviations are computed.
    oriented : bool
        Whether the reference vectors orient the normals.
    """

    degree: int
    frame: int
    planar: bool
    robust: bool
    uncertainty: bool
    oriented: bool


class Fit(NamedTuple):
    """What is known about the fit at one point, in units of the radius.

    Attributes
    ----------
    status : int
        Status flags.
    degree, top : int
        Degree used, degree that the coefficients are stored for.
    cx, cy : float
        Weighted centroid in the fitted axes.
    residual : float
        Weighted root mean square of the residuals.
    pivot : float
        Smallest relative pivot.
    neighbours : int
        Points inside the radius.
    """

    status: int
    degree: int
    top: int
    cx: float
    cy: float
    residual: float
    pivot: float
    neighbours: int


@inner
def affordable_degree(n: int, degree: int) -> int:
    """Largest degree <= `degree` that n points can bear."""
    while degree > 0 and n < MARGIN * ((degree + 1) * (degree + 2) // 2):
        degree -= 1
    return degree


@inner
def choose_frame(cloud: Array, n: int, reference: Array, settings: Settings, w: Any) -> int:
    """Set ``w.frame`` from the principal axes or the given vector; returns the status."""
    frame = w.frame
    if not principal_frame(cloud, n, w.B, w.A, w.Q, w.plane, w.spread, w.weights, frame):
        return _DEGENERATE
    if settings.frame == FRAME_GIVEN:
        side = square = 0.0
        for i in range(3):
            frame[2, i] = reference[i]
            side += frame[0, i] * reference[i]
            square += reference[i] * reference[i]
        if side * side > 0.5 * square:
            # t1 would nearly vanish in projection; any other axis serves as well.
            for i in range(3):
                frame[0, i] = frame[1, i]
        tilt(frame, 0.0, 0.0)
        return 0
    if not face(frame, reference[0], reference[1], reference[2]) or not settings.oriented:
        return _UNORIENTED
    return 0


@inner
def prefit(
    cloud: Array,
    points: int,
    n: int,
    degree: int,
    reference: Array,
    settings: Settings,
    w: Any,
) -> None:
    """Tilt the frame by the gradient of a fit of low degree."""
    cx, cy, _ = project(cloud, points, n, settings.planar, w)
    reached, _ = regress(cloud, WEIGHT, n, degree, w)
    a, b = gradient(w.c, degree, -cx, -cy, w.powers)
    if reached >= 1 and a * a + b * b < 1.0:
        tilt(w.frame, a, b)
        face(w.frame, reference[0], reference[1], reference[2])


@inner
def fit_point(
    cloud: Array, points: int, n: int, reference: Array, settings: Settings, w: Any
) -> Fit:
    """Fit the surface at one point by least squares.

    On return ``w.frame`` is the frame of the fit, ``w.c`` the coefficients about the origin in it,
    ``w.centred`` those about the weighted mean, ``w.G`` the factor; the cloud holds coordinates and
    residuals.

    Parameters
    ----------
    cloud : (CLOUD_ROWS, >= n) float64
        Rows DX to SQUARED are filled, with squares of OUTSIDE behind the points.
    points, n : int
        Number of points, and that rounded up to a multiple of LANES.
    reference : (3,) float64
        Vector that says on which side the normal is.
    settings : Settings
        What is asked for.
    w : record of WORKSPACE
        Working memory.

    Returns
    -------
    Fit
        What is known about the fit.
    """
    inside = int(weigh(cloud, n))
    degree = affordable_degree(inside, settings.degree)
    if degree < min(2, settings.degree):
        return Fit(_TOO_FEW, 0, 0, 0.0, 0.0, np.nan, np.nan, inside)
    status = _LOWERED if degree < settings.degree else 0
    status |= choose_frame(cloud, n, reference, settings, w)
    if status & _DEGENERATE:
        return Fit(status, 0, 0, 0.0, 0.0, np.nan, np.nan, inside)
    tangent = settings.frame == FRAME_TANGENT
    if tangent and degree > 2:
        prefit(cloud, points, n, min(PREFIT_DEGREE, degree - 1), reference, settings, w)
    turns = RETILTS if tangent else 0
    trusted = TRUST_L1 if settings.robust else 1.0
    turn = 0
    slope = before = np.inf
    while True:
        cx, cy, weight = project(cloud, points, n, settings.planar, w)
        reached, pivot = regress(cloud, WEIGHT, n, degree, w)
        if reached < 0:
            return Fit(status | _DEGENERATE, 0, 0, 0.0, 0.0, np.nan, np.nan, inside)
        residual, refined = settle(cloud, WEIGHT, n, degree, weight, pivot, w)
        for i in range(len(w.c)):
            w.centred[i] = w.c[i]
        shift(w.c, degree, cx, cy, w.table)
        if turn == turns:
            break
        last = degree_start(degree, 0)
        size = np.sqrt(w.c[last - 2] * w.c[last - 2] + w.c[last - 1] * w.c[last - 1])
        if turn > 0 and not (size < STEADY * slope and residual < WORSE * before):
            # The samples do not bear this frame; back to the one before, for good.
            w.frame[:] = w.kept
            turn = turns
            continue
        if not tilt_matters(w.c, degree, trusted * residual, w.norms):
            break
        turn += 1
        w.kept[:] = w.frame
        slope = size
        before = residual
        tilt(w.frame, w.c[last - 2], w.c[last - 1])
        face(w.frame, reference[0], reference[1], reference[2])
    if refined:
        status |= _REFINED
    if doubtful(degree, reached, w):
        status |= _ILL
    return Fit(status, reached, degree, cx, cy, residual, pivot, inside)


@inner
def finish(fit: Fit, tangent: bool, w: Any) -> int:
    """Turn frame and jet into the tangent plane; returns the status."""
    if tangent:
        untilt(w.c, fit.top, w.frame, w.table, w.middle, w.slope)
        for i in range(degree_start(fit.top, fit.degree)):
            w.c[i] = 0.0
    status = fit.status
    if fit.degree < fit.top:
        status |= _LOWERED | _ILL
    if fit.cx * fit.cx + fit.cy * fit.cy > ONE_SIDED * ONE_SIDED:
        status |= _ONE_SIDED
    return status
