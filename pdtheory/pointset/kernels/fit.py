"""The fit at one point: weights, frame, regression, and the jet in the tangent frame."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from pdtheory.conventions import Status
from pdtheory.pointset.kernels.frames import face, principal_frame, tilt
from pdtheory.pointset.kernels.jit import Array, inner
from pdtheory.pointset.kernels.moments import (
    subtract_polynomial,
    sum_moments,
    sum_normal_equations,
)
from pdtheory.pointset.kernels.regression import (
    coefficient_count,
    degree_start,
    factor,
    fill_gram,
    fill_right_hand_side,
    shift,
    solve_lower,
    solve_transposed,
)
from pdtheory.pointset.kernels.tables import Scratch

#: Frames: tangent to the fitted surface, principal axes, normal to the given vectors.
FRAME_TANGENT, FRAME_PRINCIPAL, FRAME_GIVEN = 0, 1, 2
#: Degree of the fit that tilts the frame first.
PREFIT_DEGREE = 4
#: Neighbours that a fit must have for each coefficient.
MARGIN = 1.25
#: Smallest relative pivot that leaves correct digits; the degree is lowered until it is reached.
WORST_PIVOT = 1e-9
#: The pivots of a degree as a fraction of those of a full disc: below the first the points do not
#: tell its monomials apart (scan lines, a lattice) and the degree is lowered; below the second the
#: fit is flagged. Half a disc has 2e-3 at degree 10, a quarter 2e-2.
DEFICIENT, DOUBTFUL = 1e-4, 1e-3
#: Below this pivot the solution is refined against the samples.
REFINE_PIVOT = 1e-4
#: Tilts with the full fit.
RETILTS = 8
#: Effect of a remaining tilt that is tolerated, as a fraction of the residual and of the height.
#: With l1 the residual may be that of outliers, so only a tenth of that.
TILT_OF_RESIDUAL, TILT_OF_HEIGHT = 0.3, 1e-13
#: Distance of the weighted centroid, as a fraction of the radius, of a one-sided neighbourhood.
ONE_SIDED = 0.18
#: Iterative reweighting: most rounds, relative change at which it stops, smallest residual as a
#: fraction of the mean.
L1_ROUNDS, L1_CHANGE, L1_FLOOR = 60, 1e-3, 1e-3

_TOO_FEW = int(Status.TOO_FEW_NEIGHBOURS)
_DEGENERATE = int(Status.DEGENERATE_FRAME)
_LOWERED = int(Status.DEGREE_LOWERED)
_ILL = int(Status.ILL_CONDITIONED)
_REFINED = int(Status.REFINED)
_ONE_SIDED = int(Status.ONE_SIDED)
_UNORIENTED = int(Status.UNORIENTED)
_NOT_CONVERGED = int(Status.NOT_CONVERGED)


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
    degree, top, first : int
        Degree used, degree that the coefficients are stored for, index of the first in use.
    cx, cy : float
        Weighted centroid in the fitted axes.
    residual : float
        Weighted root mean square of the residuals.
    pivot : float
        Smallest relative pivot.
    weight : float
        Sum of the weights.
    neighbours : int
        Points inside the radius.
    """

    status: int
    degree: int
    top: int
    first: int
    cx: float
    cy: float
    residual: float
    pivot: float
    weight: float
    neighbours: int


@inner
def gaussian(n: int, squared: Array, w: Array) -> None:
    """Write exp(-9 rho^2 / 2) for squared distances rho^2 <= 1, and 0 beyond.

    The exponential is the 64th power of its Taylor polynomial at 1/64 of the argument, where eight
    terms reach rounding; unlike a library call it runs in vector registers.
    """
    for i in range(n):
        t = squared[i] * (-4.5 / 64.0)
        e = 1.0 + t * (
            1.0
            + t
            / 2.0
            * (
                1.0
                + t
                / 3.0
                * (
                    1.0
                    + t
                    / 4.0
                    * (1.0 + t / 5.0 * (1.0 + t / 6.0 * (1.0 + t / 7.0 * (1.0 + t / 8.0))))
                )
            )
        )
        e = e * e
        e = e * e
        e = e * e
        e = e * e
        e = e * e
        e = e * e
        w[i] = e if squared[i] <= 1.0 else 0.0


@inner
def project(cloud: Array, n: int, frame: Array, planar: bool) -> tuple[float, float, float]:
    """Write local x, y, z (rows 5..7), weights (row 4), and centre x and y on the weighted mean.

    Returns
    -------
    (float, float, float)
        The mean (cx, cy) and the sum of the weights.
    """
    total = sx = sy = 0.0
    if planar:
        for i in range(n):
            x = cloud[0, i] * frame[0, 0] + cloud[1, i] * frame[0, 1] + cloud[2, i] * frame[0, 2]
            y = cloud[0, i] * frame[1, 0] + cloud[1, i] * frame[1, 1] + cloud[2, i] * frame[1, 2]
            cloud[3, i] = x * x + y * y
        gaussian(n, cloud[3], cloud[4])
    for i in range(n):
        x = cloud[0, i] * frame[0, 0] + cloud[1, i] * frame[0, 1] + cloud[2, i] * frame[0, 2]
        y = cloud[0, i] * frame[1, 0] + cloud[1, i] * frame[1, 1] + cloud[2, i] * frame[1, 2]
        z = cloud[0, i] * frame[2, 0] + cloud[1, i] * frame[2, 1] + cloud[2, i] * frame[2, 2]
        cloud[5, i] = x
        cloud[6, i] = y
        cloud[7, i] = z
        w = cloud[4, i]
        total += w
        sx += w * x
        sy += w * y
    cx = sx / total
    cy = sy / total
    for i in range(n):
        cloud[5, i] -= cx
        cloud[6, i] -= cy
    return cx, cy, total


@inner
def regress(cloud: Array, weights: Array, n: int, degree: int, s: Scratch) -> tuple[int, float]:
    """Fit the heights with the given weights; the coefficients about the centroid go to ``s.c``.

    Returns
    -------
    (int, float)
        The degree reached and its smallest relative pivot.
    """
    size = coefficient_count(degree)
    sum_normal_equations(
        cloud[5], cloud[6], weights, cloud[7], n, degree, s.X, s.V, s.moments, s.heights
    )
    fill_gram(s.moments, degree, s.offsets, s.G)
    fill_right_hand_side(s.heights, degree, s.c)
    factor(s.G, size, s.diagonal, s.pivots)
    reached = -1
    worst = 1.0
    for d in range(degree + 1):
        low = 1.0
        for i in range(degree_start(degree, d), degree_start(degree, d) + d + 1):
            low = min(low, s.pivots[i])
        if low < WORST_PIVOT or low < DEFICIENT * s.full_disc[d]:
            break
        worst = min(worst, low)
        reached = d
    first = degree_start(degree, reached) if reached >= 0 else size
    solve_transposed(s.G, first, size, s.c)
    solve_lower(s.G, first, size, s.c)
    for i in range(first):
        s.c[i] = 0.0
    return reached, worst


@inner
def doubtful(degree: int, reached: int, s: Scratch) -> bool:
    """Whether some degree up to the one reached has far smaller pivots than on a full disc."""
    for d in range(reached + 1):
        start = degree_start(degree, d)
        for i in range(start, start + d + 1):
            if s.pivots[i] < DOUBTFUL * s.full_disc[d]:
                return True
    return False


@inner
def refine(cloud: Array, weights: Array, n: int, degree: int, first: int, s: Scratch) -> None:
    """Improve ``s.c`` by solving for the residuals of the samples once more."""
    subtract_polynomial(cloud[5], cloud[6], cloud[7], n, degree, s.c, s.X, s.line, cloud[8])
    products = cloud[9]
    for i in range(n):
        products[i] = weights[i] * cloud[8, i]
    sum_moments(cloud[5], cloud[6], products, n, degree, s.X, s.V, s.heights)
    fill_right_hand_side(s.heights, degree, s.step)
    size = coefficient_count(degree)
    solve_transposed(s.G, first, size, s.step)
    solve_lower(s.G, first, size, s.step)
    for i in range(first, size):
        s.c[i] += s.step[i]


@inner
def _turn(
    source: Array, target: Array, degree: int, step: float, a: float, b: float, square: Array
) -> None:
    """Add `step` times the rate of change of the jet `source`, when its frame turns, to `target`.

    Turning the frame about the origin towards the unit direction (a, b) changes the heights h at
    the rate -(a d/dx + b d/dy)(h^2) / 2 - (a x + b y). Coefficients stand at the powers of x and y.
    """
    for i in range(degree + 2):
        for j in range(degree + 2 - i):
            square[i, j] = 0.0
    for i1 in range(degree + 1):
        for j1 in range(degree + 1 - i1):
            f = source[i1, j1]
            left = degree + 1 - i1 - j1
            for i2 in range(min(left, degree) + 1):
                for j2 in range(min(left, degree) - i2 + 1):
                    square[i1 + i2, j1 + j2] += f * source[i2, j2]
    half = 0.5 * step
    for i in range(degree + 1):
        for j in range(degree + 1 - i):
            target[i, j] -= half * (a * (i + 1) * square[i + 1, j] + b * (j + 1) * square[i, j + 1])
    target[1, 0] -= step * a
    target[0, 1] -= step * b


@inner
def untilt(c: Array, degree: int, frame: Array, table: Array, middle: Array, square: Array) -> None:
    """Turn frame and jet so that the gradient at the origin vanishes.

    The jet follows the rotation by one midpoint step, so the error is of third order in the slope.
    """
    size = coefficient_count(degree)
    slope = np.hypot(c[size - 3], c[size - 2])
    a = c[size - 3] / slope if slope > 0.0 else 0.0
    b = c[size - 2] / slope if slope > 0.0 else 0.0
    tilt(frame, c[size - 3], c[size - 2])
    angle = np.arctan(slope)
    row = 0
    for d in range(degree, -1, -1):
        for j in range(d + 1):
            table[d - j, j] = c[row]
            middle[d - j, j] = c[row]
            row += 1
    _turn(table, middle, degree, 0.5 * angle, a, b, square)
    _turn(middle, table, degree, angle, a, b, square)
    row = 0
    for d in range(degree, -1, -1):
        for j in range(d + 1):
            c[row] = table[d - j, j]
            row += 1
    c[size - 3] = 0.0
    c[size - 2] = 0.0


@inner
def tilt_matters(c: Array, degree: int, residual: float) -> bool:
    """Whether the gradient at the origin disturbs the fit by more than is tolerated.

    A tilt adds (a d/dx + b d/dy)(h^2) / 2 to the heights, of which the terms above the degree
    cannot be undone after the fit, nor the effects of third order; both are bounded at half the
    radius.
    """
    size = coefficient_count(degree)
    slope = np.hypot(c[size - 3], c[size - 2])
    norms = np.zeros(degree + 1)
    height = 0.0
    for d in range(degree + 1):
        start = degree_start(degree, d)
        for i in range(start, start + d + 1):
            norms[d] += abs(c[i])
        norms[d] *= 0.5**d
        height += norms[d]
    beyond = 0.0
    for d1 in range(2, degree + 1):
        for d2 in range(max(2, degree + 2 - d1), degree + 1):
            beyond += (d1 + d2) * norms[d1] * norms[d2]
    effect = slope * (beyond + slope * slope * height)
    return effect > max(TILT_OF_RESIDUAL * residual, TILT_OF_HEIGHT * height)


@inner
def misfit(cloud: Array, weights: Array, n: int, degree: int, total: float, s: Scratch) -> float:
    """Write the residuals to row 8; return their weighted root mean square."""
    subtract_polynomial(cloud[5], cloud[6], cloud[7], n, degree, s.c, s.X, s.line, cloud[8])
    squares = 0.0
    for i in range(n):
        squares += weights[i] * cloud[8, i] * cloud[8, i]
    return np.sqrt(squares / total)


@inner
def reweigh(
    cloud: Array, n: int, degree: int, reached: int, pivot: float, s: Scratch
) -> tuple[int, int, float]:
    """Go on from the l2 fit to the l1 fit by iterative reweighting.

    Row 10 of the cloud receives the last weights, w / |r| up to a factor.

    Returns
    -------
    (int, int, float)
        Status flags, degree reached, smallest relative pivot.
    """
    before = np.inf
    for _ in range(L1_ROUNDS):
        subtract_polynomial(cloud[5], cloud[6], cloud[7], n, degree, s.c, s.X, s.line, cloud[8])
        total = 0.0
        weight = 0.0
        for i in range(n):
            total += cloud[4, i] * abs(cloud[8, i])
            weight += cloud[4, i]
        if before - total <= L1_CHANGE * total and before < np.inf:
            return 0, reached, pivot
        before = total
        floor = max(L1_FLOOR * total / weight, 1e-16)
        for i in range(n):
            cloud[10, i] = cloud[4, i] * floor / max(abs(cloud[8, i]), floor)
        reached, pivot = regress(cloud, cloud[10], n, degree, s)
        if reached < 0:
            return 0, reached, pivot
        refine(cloud, cloud[10], n, degree, degree_start(degree, reached), s)
    return _NOT_CONVERGED, reached, pivot


@inner
def affordable_degree(n: int, degree: int) -> int:
    """Largest degree <= `degree` that n points can bear."""
    while degree > 0 and n < MARGIN * coefficient_count(degree):
        degree -= 1
    return degree


@inner
def choose_frame(cloud: Array, n: int, reference: Array, settings: Settings, s: Scratch) -> int:
    """Set ``s.frame`` from the principal axes or the given vector; returns the status."""
    status = 0
    if not principal_frame(cloud[0], cloud[1], cloud[2], cloud[4], n, s.A, s.Q, s.frame):
        return _DEGENERATE
    if settings.frame == FRAME_GIVEN:
        for i in range(3):
            s.frame[2, i] = reference[i]
        side = s.frame[0, 0] * reference[0]
        side += s.frame[0, 1] * reference[1] + s.frame[0, 2] * reference[2]
        size = reference[0] ** 2 + reference[1] ** 2 + reference[2] ** 2
        if side * side > 0.5 * size:
            # t1 would nearly vanish in projection; any other axis serves as well.
            for i in range(3):
                s.frame[0, i] = s.frame[1, i]
        tilt(s.frame, 0.0, 0.0)
        return status
    if not face(s.frame, reference[0], reference[1], reference[2]) or not settings.oriented:
        status |= _UNORIENTED
    return status


@inner
def fit_point(cloud: Array, n: int, reference: Array, settings: Settings, s: Scratch) -> Fit:
    """Fit the surface at one point.

    On return ``s.frame`` is the frame of the fit, ``s.c`` the coefficients about the origin in it,
    ``s.G`` the factor.

    Parameters
    ----------
    cloud : (11, >= n) float64
        Rows 0..3: coordinates and squared distance in units of the radius. The others are scratch:
        4 weights, 5..7 local x, y, z, 8 residuals, 9 products, 10 weights of l1.
    n : int
        Number of points.
    reference : (3,) float64
        Vector that says on which side the normal is.
    settings : Settings
        What is asked for.
    s : Scratch
        Working memory.

    Returns
    -------
    Fit
        What is known about the fit.
    """
    gaussian(n, cloud[3], cloud[4])
    inside = 0
    for i in range(n):
        if cloud[4, i] > 0.0:
            inside += 1
    degree = affordable_degree(inside, settings.degree)
    if degree < min(2, settings.degree):
        return Fit(_TOO_FEW, 0, 0, 0, 0.0, 0.0, np.nan, np.nan, 0.0, inside)
    status = _LOWERED if degree < settings.degree else 0
    status |= choose_frame(cloud, n, reference, settings, s)
    if status & _DEGENERATE:
        return Fit(status, 0, 0, 0, 0.0, 0.0, np.nan, np.nan, 0.0, inside)

    if settings.frame == FRAME_TANGENT and degree > PREFIT_DEGREE:
        low = min(degree, PREFIT_DEGREE)
        cx, cy, weight = project(cloud, n, s.frame, settings.planar)
        reached, pivot = regress(cloud, cloud[4], n, low, s)
        if reached >= 1:
            shift(s.c, low, cx, cy, s.table)
            size = coefficient_count(low)
            a = s.c[size - 3]
            b = s.c[size - 2]
            if a * a + b * b < 1.0:
                tilt(s.frame, a, b)
                face(s.frame, reference[0], reference[1], reference[2])

    turns = RETILTS if settings.frame == FRAME_TANGENT else 0
    size = coefficient_count(degree)
    trusted = 0.1 if settings.robust else 1.0
    for turn in range(turns + 1):
        cx, cy, weight = project(cloud, n, s.frame, settings.planar)
        reached, pivot = regress(cloud, cloud[4], n, degree, s)
        if reached < 0:
            return Fit(status | _DEGENERATE, 0, 0, 0, 0.0, 0.0, np.nan, np.nan, 0.0, inside)
        first = degree_start(degree, reached)
        refined = pivot < REFINE_PIVOT
        if refined:
            refine(cloud, cloud[4], n, degree, first, s)
        residual = misfit(cloud, cloud[4], n, degree, weight, s)
        shift(s.c, degree, cx, cy, s.table)
        if turn == turns or not tilt_matters(s.c, degree, trusted * residual):
            break
        tilt(s.frame, s.c[size - 3], s.c[size - 2])
        face(s.frame, reference[0], reference[1], reference[2])

    if settings.robust:
        # The l2 fit in the final frame starts the reweighting.
        cx, cy, weight = project(cloud, n, s.frame, settings.planar)
        reached, pivot = regress(cloud, cloud[4], n, degree, s)
        flags, reached, pivot = reweigh(cloud, n, degree, reached, pivot, s)
        status |= flags
        first = degree_start(degree, max(reached, 0))
        residual = misfit(cloud, cloud[4], n, degree, weight, s)
        shift(s.c, degree, cx, cy, s.table)

    if settings.frame == FRAME_TANGENT:
        untilt(s.c, degree, s.frame, s.table, s.middle, s.square)
        for i in range(first):
            s.c[i] = 0.0
    else:
        for i in range(degree + 2):
            for j in range(degree + 2 - i):
                s.square[i, j] = 0.0
    if refined:
        status |= _REFINED
    if reached < degree:
        status |= _LOWERED | _ILL
    if doubtful(degree, reached, s):
        status |= _ILL
    if np.hypot(cx, cy) > ONE_SIDED:
        status |= _ONE_SIDED
    return Fit(status, reached, degree, first, cx, cy, residual, pivot, weight, inside)
