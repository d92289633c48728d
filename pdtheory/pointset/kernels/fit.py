"""The fit at one point: weights, frame, regression, and the jet in the tangent frame."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from pdtheory.conventions import Status
from pdtheory.pointset.kernels.frames import copy_frame, face, principal_frame, tilt
from pdtheory.pointset.kernels.jit import Array, inner
from pdtheory.pointset.kernels.moments import WEIGHT
from pdtheory.pointset.kernels.regression import (
    degree_start,
    doubtful,
    misfit,
    regress,
    settle,
    typical_residual,
)
from pdtheory.pointset.kernels.tilting import (
    gradient,
    shift,
    slope_spread,
    tilt_matters,
    untilt,
)
from pdtheory.pointset.kernels.weighing import project, weigh

#: Frames: tangent to the fitted surface, principal axes, normal to the given vectors.
FRAME_TANGENT, FRAME_PRINCIPAL, FRAME_GIVEN = 0, 1, 2
#: Degree of the fit that tilts the frame first; that of a fit of no higher degree is one less.
PREFIT_DEGREE = 4
#: Neighbours that a fit must have for each coefficient.
MARGIN = 1.25
#: Tilts with the full fit.
RETILTS = 8
#: Bound on the standard deviation of the slope above which it does not tell the tangent plane. The
#: deviation itself is about 0.7 times that, and errors are carried on to first order only.
UNSURE = 0.3
#: A tilt is taken back if it leaves more than this multiple of the residual.
WORSE = 1.1
#: Distance of the weighted centroid, as a fraction of the radius, of a one-sided neighbourhood.
ONE_SIDED = 0.18

_TOO_FEW = int(Status.TOO_FEW_NEIGHBOURS)
_DEGENERATE = int(Status.DEGENERATE_FRAME)
_LOWERED = int(Status.DEGREE_LOWERED)
_ILL = int(Status.ILL_CONDITIONED)
_REFINED = int(Status.REFINED)
_ONE_SIDED = int(Status.ONE_SIDED)
_UNORIENTED = int(Status.UNORIENTED)
_UNCERTAIN = int(Status.UNCERTAIN_FRAME)


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
    tangent : bool
        Whether the frame is to be tangent to the fitted surface.
    """

    status: int
    degree: int
    top: int
    cx: float
    cy: float
    residual: float
    pivot: float
    neighbours: int
    tangent: bool


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
    if not principal_frame(cloud, n, w.A, w.Q, w.plane, w.spread, w.weights, frame):
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
def noise_of(cloud: Array, n: int, residual: float, settings: Settings) -> float:
    """Return the noise that residuals speak of; with l1, large ones may be those of outliers."""
    if settings.robust:
        return min(residual, typical_residual(cloud, n, 0))
    return residual


@inner
def slope_known(
    degree: int, reached: int, n: int, noise: float, pivot: float, cx: float, cy: float, w: Any
) -> bool:
    """Whether a fit to n points, centred at (cx, cy), tells the gradient at the origin.

    `noise` is that of the residuals, which leaves out what went into the coefficients.
    """
    noise *= np.sqrt(n / (n - (reached + 1) * (reached + 2) // 2))
    return noise * slope_spread(degree, -cx, -cy, pivot, UNSURE / noise, w) < UNSURE


@inner
def prefit(
    cloud: Array,
    points: int,
    n: int,
    degree: int,
    reference: Array,
    settings: Settings,
    inside: int,
    careful: bool,
    w: Any,
) -> None:
    """Tilt the frame by the gradient of a fit of low degree to the points inside the radius.

    If that is to be careful, only where these tell it.
    """
    cx, cy, weight = project(cloud, points, n, settings.planar, w)
    reached, pivot = regress(cloud, WEIGHT, n, degree, w)
    if careful:
        noise = noise_of(cloud, n, misfit(cloud, n, degree, weight, w), settings)
        if not slope_known(degree, reached, inside, noise, pivot, cx, cy, w):
            return
    a, b = gradient(w.c, degree, -cx, -cy, w)
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
        return Fit(_TOO_FEW, 0, 0, 0.0, 0.0, np.nan, np.nan, inside, False)
    status = _LOWERED if degree < settings.degree else 0
    status |= choose_frame(cloud, n, reference, settings, w)
    if status & _DEGENERATE:
        return Fit(_DEGENERATE, 0, 0, 0.0, 0.0, np.nan, np.nan, inside, False)
    tangent = settings.frame == FRAME_TANGENT
    first = min(PREFIT_DEGREE, degree - 1)
    if tangent:
        copy_frame(w.frame, w.kept)
        if first > 1:
            prefit(cloud, points, n, first, reference, settings, inside, False, w)
    turns = RETILTS if tangent else 0
    turn = 0
    before = np.inf
    while True:
        cx, cy, weight = project(cloud, points, n, settings.planar, w)
        reached, pivot = regress(cloud, WEIGHT, n, degree, w)
        if reached < 0:
            return Fit(_DEGENERATE, 0, 0, 0.0, 0.0, np.nan, np.nan, inside, False)
        residual, refined = settle(cloud, WEIGHT, n, degree, weight, pivot, w)
        for i in range(len(w.c)):
            w.centred[i] = w.c[i]
        shift(w.c, degree, cx, cy, w.table)
        if not tangent:
            break
        noise = noise_of(cloud, n, residual, settings)
        known = slope_known(degree, reached, inside, noise, pivot, cx, cy, w)
        if not known or (0 < turn < turns and residual > WORSE * before):
            # Back to the frame before, for good.
            copy_frame(w.kept, w.frame)
            turns = turn
            if not known:
                status |= _UNCERTAIN
                tangent = False
                if turn == 0 and first > 1:
                    # A lower degree may tell the plane, and its principal axes always do.
                    prefit(cloud, points, n, first, reference, settings, inside, True, w)
            continue
        if turn == turns or not tilt_matters(w.c, degree, noise, w.norms):
            break
        turn += 1
        copy_frame(w.frame, w.kept)
        before = residual
        last = degree_start(degree, 0)
        tilt(w.frame, w.c[last - 2], w.c[last - 1])
        face(w.frame, reference[0], reference[1], reference[2])
    if refined:
        status |= _REFINED
    if doubtful(degree, reached, w):
        status |= _ILL
    return Fit(status, reached, degree, cx, cy, residual, pivot, inside, tangent)


@inner
def finish(fit: Fit, w: Any) -> int:
    """Turn frame and jet into the tangent plane if that is wanted; returns the status."""
    if fit.tangent:
        untilt(w.c, fit.top, w.frame, w.table, w.middle, w.slope)
        for i in range(degree_start(fit.top, fit.degree)):
            w.c[i] = 0.0
    status = fit.status
    if fit.degree < fit.top:
        status |= _LOWERED | _ILL
    if fit.cx * fit.cx + fit.cy * fit.cy > ONE_SIDED * ONE_SIDED:
        status |= _ONE_SIDED
    return status
