"""All critical angles of a homogeneous term g_k on the half circle, none missed.

With g(theta) = sum_n phi_n e^{i n theta}, the angles are the zeros of h = g'. From values and
slopes at the ends of an interval, and bounds on the derivatives from the coefficients, one can
certify (`certificates`) that h has no zero, or that h' has none and h is monotone. Intervals where
neither holds are halved. Order 2 has one frequency besides the constant, and its angles a formula.
"""

from __future__ import annotations

from math import pi
from typing import Any

import numpy as np

from pdtheory.pointset.kernels.certificates import empty, monotone_on
from pdtheory.pointset.kernels.jit import Array, inner
from pdtheory.pointset.kernels.lanes import LANES, Lanes, Rows, emit
from pdtheory.pointset.kernels.tables import SAMPLES

#: Largest number of halvings; below that width two zeros count as a double one.
DEPTH = 18
_FINEST = pi / SAMPLES * 2.0**-DEPTH
#: Intervals that are closer than this may hold one zero.
_GAP = 3.0 * _FINEST
#: Times what cannot be told from zero: as far as that a multiple zero reaches.
_NEAR = 8.0
#: Rows of a table of brackets: the angle, the ends of the interval that holds it, h rising (1) or
#: falling (-1), then g, g'' and the cosine and sine of the angle; from COEFFICIENTS on, real and
#: imaginary parts of phi_n in turn.
ANGLE, LOW, HIGH, RISING, VALUE, CURVATURE, COSINE, SINE, COEFFICIENTS = range(9)


@inner
def evaluate(re: Array, im: Array, order: int, theta: float) -> tuple[float, float]:
    """Return g'(theta) and g''(theta) for coefficients re + i im at n = order mod 2, +2, ..."""
    c1 = np.cos(theta)
    s1 = np.sin(theta)
    c2 = c1 * c1 - s1 * s1
    s2 = 2.0 * c1 * s1
    c = c1 if order % 2 else 1.0
    s = s1 if order % 2 else 0.0
    first = 0.0
    second = 0.0
    for j in range(order // 2 + 1):
        n = 2 * j + order % 2
        first -= 2.0 * n * (re[j] * s + im[j] * c)
        second -= 2.0 * n * n * (re[j] * c - im[j] * s)
        c, s = c * c2 - s * s2, s * c2 + c * s2
    return first, second


@emit
def _sample(
    to: Lanes, re: Rows, im: Rows, order: Any, cosines: Rows, sines: Rows, samples: Rows
) -> None:
    """Write h and h' at SAMPLES angles to the rows of `samples`."""
    width = 4
    parity = to.minus(order, to.mul(to.div(order, 2), 2))
    with to.count(0, SAMPLES, width * LANES) as first:
        at = [to.plus(first, v * LANES) for v in range(width)]
        h = [to.variable(to.constant(0.0)) for _ in at]
        d = [to.variable(to.constant(0.0)) for _ in at]
        with to.count(0, to.plus(to.div(order, 2), 1)) as j:
            n = to.plus(j, j, parity)
            real = to.builder.sitofp(n, to.real(0.0).type)
            p = to.times(to.times(to.get(re.at(j)), real), to.real(-2.0))
            q = to.times(to.times(to.get(im.at(j)), real), to.real(-2.0))
            dp, dq = to.spread(to.times(p, real)), to.spread(to.times(q, real))
            p, q = to.spread(p), to.spread(q)
            for v in range(width):
                c, s = to.load(cosines.at(n, at[v])), to.load(sines.at(n, at[v]))
                to.put(to.add(to.times(q, c), to.add(to.times(p, s), to.get(h[v]))), h[v])
                slope = to.subtract(to.get(d[v]), to.times(dq, s))
                to.put(to.add(to.times(dp, c), slope), d[v])
        for v in range(width):
            to.store(to.get(h[v]), samples.at(0, at[v]))
            to.store(to.get(d[v]), samples.at(1, at[v]))


@emit
def _find_candidates(to: Lanes, samples: Rows, width: Any, error: Any, intervals: Rows) -> float:
    """Write the numbers of the intervals before the last one that may hold zeros; count them.

    Cubic interpolants are wrong by up to `error`.
    """
    build = to.builder
    third, limit = to.spread(build.fdiv(width, to.real(3.0))), to.spread(error)
    lowest = to.subtract(to.constant(0.0), limit)
    place = to.variable(to.integer(0))
    with to.count(0, SAMPLES, LANES) as i:
        (ha, da), (hb, db) = (
            [to.load(samples.at(row, to.plus(i, end))) for row in range(2)] for end in range(2)
        )
        middle = to.add(to.times(da, third), ha), to.subtract(hb, to.times(db, third))
        above = to.larger(to.larger(ha, hb), to.larger(*middle))
        below = to.smaller(to.smaller(ha, hb), to.smaller(*middle))
        doubtful = build.and_(
            build.fcmp_ordered("<=", below, limit), build.fcmp_ordered(">=", above, lowest)
        )
        doubtful = build.and_(doubtful, to.below(to.minus(SAMPLES - 1, i)))
        numbers = to.add(to.sequence(1), to.spread(build.sitofp(i, to.real(0.0).type)))
        to.pack([numbers], doubtful, [intervals.at(to.get(place))])
        to.put(to.plus(to.get(place), to.number(doubtful)), place)
    return build.sitofp(to.get(place), to.real(0.0).type)


@inner
def _note(
    re: Array,
    im: Array,
    order: int,
    low: float,
    high: float,
    ha: float,
    hb: float,
    change: bool,
    negative: bool,
    table: Array,
    kind: Array,
    found: int,
) -> None:
    """Write down an interval with one zero, where h takes the values ha and hb at the ends."""
    table[ANGLE, found] = 0.5 * (low + high)
    table[LOW, found] = low
    table[HIGH, found] = high
    table[RISING, found] = 0.0
    kind[found] = 0.0
    if change:
        table[ANGLE, found] = low + (high - low) * abs(ha) / (abs(ha) + abs(hb))
        table[RISING, found] = 1.0 if hb > ha else -1.0
        kind[found] = 1.0 if negative else -1.0
    for j in range(order // 2 + 1):
        table[COEFFICIENTS + 2 * j, found] = re[j]
        table[COEFFICIENTS + 2 * j + 1, found] = im[j]


@inner
def _widen(table: Array, kind: Array, at: int, low: float, high: float, change: float) -> None:
    """Let an interval with a multiple zero reach from `low` to `high`.

    `change` is the kind of the change of sign that comes in, or 0. Two of them in turn make none.
    """
    kind[at] += change
    table[ANGLE, at] = max(0.5 * (low + high), 0.0)
    table[LOW, at] = low
    table[HIGH, at] = high
    table[RISING, at] = -kind[at]


@inner
def _note_axes(re: Array, im: Array, table: Array, kind: Array, found: int) -> None:
    """Write down the angles of order 2: g = phi_0 + 2 |phi_2| cos(2 theta + arg phi_2)."""
    high = -0.5 * np.arctan2(im[1], re[1])
    if high < 0.0:
        high += np.pi
        if high >= np.pi:
            high = 0.0
    low = high + 0.5 * np.pi if high < 0.5 * np.pi else high - 0.5 * np.pi
    for angle in (min(high, low), max(high, low)):
        _note(re, im, 2, angle, angle, 0.0, 0.0, False, False, table, kind, found)
        kind[found] = 1.0 if angle == high else -1.0
        found += 1


@inner
def bracket_angles(
    re: Array,
    im: Array,
    order: int,
    cosines: Array,
    sines: Array,
    samples: Array,
    intervals: Array,
    stack: Array,
    table: Array,
    kind: Array,
    begin: int,
) -> int:
    """Find intervals that hold the critical angles of g on [0, pi), one each.

    Parameters
    ----------
    re, im : (order // 2 + 1,) float64
        Coefficients phi_n for n = order mod 2, order mod 2 + 2, ..., order; scaled so that they are
        of the size of one.
    order : int
        The order k.
    cosines, sines : (>= order + 1, SAMPLES + 1) float64
        cos(n theta_j) and sin(n theta_j) at theta_j = j pi / SAMPLES.
    samples : (2, SAMPLES + 1) float64
        Scratch for h and h'.
    intervals : (>= SAMPLES + LANES,) float64
        Scratch for the intervals that may hold zeros.
    stack : (DEPTH + 3, 6) float64
        Scratch for the halvings.
    table : (rows, >= begin + order) float64
        Receives the brackets from column `begin` on, by ascending angle.
    kind : (>= begin + order,) float64
        Receives +1 (maximum), -1 (minimum) or 0 (inflection).
    begin : int
        The first column.

    Returns
    -------
    int
        Number of angles.
    """
    parity = order % 2
    third = 0.0  # bound on |h''|
    fourth = 0.0  # bound on |h'''|
    fifth = 0.0  # bound on |h''''|
    for j in range(order // 2 + 1):
        n = 2.0 * j + parity
        size = 2.0 * n * n * n * np.sqrt(re[j] * re[j] + im[j] * im[j])
        third += size
        fourth += n * size
        fifth += n * n * size
    found = begin
    if third == 0.0:
        return 0
    floor = third * _FINEST * _FINEST / 8.0  # of h that cannot be told from zero
    near = _NEAR * floor
    if order == 2:
        _note_axes(re, im, table, kind, begin)
        return 2
    width = np.pi / SAMPLES
    error = fifth * width * width * width * width / 384.0 + floor
    _sample(re, im, order, cosines, sines, samples)
    # h(theta + pi) = (-1)^k h(theta), to the bit, so that a zero at 0 is found once.
    samples[0, SAMPLES] = -samples[0, 0] if parity else samples[0, 0]
    samples[1, SAMPLES] = -samples[1, 0] if parity else samples[1, 0]
    multiple = open_end = False  # whether there is a multiple zero, and whether it is the last one
    first_open = False  # whether it is the first one
    start = 0.0  # where the last one begins
    count = int(_find_candidates(samples, width, error, intervals))
    intervals[count] = SAMPLES
    for i in range(count + 1):
        if found == begin + order:
            break
        sample = int(intervals[i])
        ha = samples[0, sample - 1]
        hb = samples[0, sample]
        da = samples[1, sample - 1]
        db = samples[1, sample]
        simple = (ha < 0.0) != (hb < 0.0) and sample < SAMPLES
        if simple and monotone_on(ha, hb, da, db, width, fourth, fifth, floor):
            low = (sample - 1) * width
            _note(re, im, order, low, low + width, ha, hb, True, hb < 0.0, table, kind, found)
            found += 1
            open_end = False
            start = low
            continue
        top = 0
        stack[0, 0] = (sample - 1) * width
        stack[0, 1] = sample * width
        stack[0, 2] = ha
        stack[0, 3] = hb
        stack[0, 4] = da
        stack[0, 5] = db
        while top >= 0:
            low = stack[top, 0]
            high = stack[top, 1]
            ha = stack[top, 2]
            hb = stack[top, 3]
            da = stack[top, 4]
            db = stack[top, 5]
            top -= 1
            d = high - low
            negative_a = ha < 0.0
            negative_b = hb < 0.0
            if sample == SAMPLES and high >= SAMPLES * width and hb == 0.0:
                negative_b = parity == 1
            change = negative_a != negative_b
            none = not change and empty(ha, hb, da, db, d, third, fifth, floor)
            monotone = monotone_on(ha, hb, da, db, d, fourth, fifth, floor)
            # Where both ends may be zero, their signs mean nothing.
            monotone = monotone and max(abs(ha), abs(hb)) > floor
            if not none and not monotone and d > _FINEST:
                middle = 0.5 * (low + high)
                hm, dm = evaluate(re, im, order, middle)
                stack[top + 1, 0] = middle
                stack[top + 1, 1] = high
                stack[top + 1, 2] = hm
                stack[top + 1, 3] = hb
                stack[top + 1, 4] = dm
                stack[top + 1, 5] = db
                stack[top + 2, 0] = low
                stack[top + 2, 1] = middle
                stack[top + 2, 2] = ha
                stack[top + 2, 3] = hm
                stack[top + 2, 4] = da
                stack[top + 2, 5] = dm
                top += 2
                continue
            touches = found > begin and low - table[HIGH, found - 1] < _GAP
            if none or (not change and monotone):
                if touches and open_end and abs(hb) <= near:
                    table[HIGH, found - 1] = high
                continue
            if touches and (not monotone or (open_end and abs(ha) <= near)):
                # The same multiple zero, seen from the next interval.
                here = 0.0
                if change:
                    here = 1.0 if negative_b else -1.0
                if not open_end:
                    start = max(start, low - _GAP)
                end = min(high, low + _GAP) if monotone else high
                if open_end or change:
                    _widen(table, kind, found - 1, start, end, here)
                    first_open = first_open or found == begin + 1
                open_end = not monotone
                multiple = True
                continue
            if found == begin + order:
                break
            _note(re, im, order, low, high, ha, hb, change, negative_b, table, kind, found)
            start = low
            open_end = not monotone
            first_open = first_open or (open_end and found == begin)
            multiple = multiple or open_end
            found += 1
    if multiple and found > begin + 1:
        low = table[LOW, begin]
        high = table[HIGH, found - 1] - np.pi
        if low - high < _GAP:
            # A multiple zero at 0, seen from both ends; h(theta - pi) = (-1)^k h(theta).
            found -= 1
            here = -kind[found] if parity else kind[found]
            # Elsewhere in a long interval on either side there is no zero.
            start = start - np.pi if open_end else max(start - np.pi, high - _GAP)
            end = table[HIGH, begin] if first_open else min(table[HIGH, begin], low + _GAP)
            _widen(table, kind, begin, start, end, here)
    return found - begin
