"""All critical angles of a homogeneous term g_k on the half circle, none missed.

With g(theta) = sum_n phi_n e^{i n theta}, the angles are the zeros of h = g'. On an interval of
width d the linear interpolant of a function differs from it by at most d^2 / 8 times the maximum of
its second derivative, which the coefficients bound. So from the values at both ends one can certify
that h has no zero, or that h' has none and h is monotone. Intervals where neither holds are halved.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from pdtheory.pointset.kernels.jit import Array, inner

#: Sample intervals on the half circle.
SAMPLES = 64
#: Largest number of halvings; below that width two zeros count as a double one.
DEPTH = 18


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


@inner
def value(re: Array, im: Array, order: int, theta: float) -> float:
    """Return g(theta)."""
    c1 = np.cos(theta)
    s1 = np.sin(theta)
    c2 = c1 * c1 - s1 * s1
    s2 = 2.0 * c1 * s1
    c = c1 if order % 2 else 1.0
    s = s1 if order % 2 else 0.0
    total = 0.0
    for j in range(order // 2 + 1):
        total += 2.0 * (re[j] * c - im[j] * s)
        c, s = c * c2 - s * s2, s * c2 + c * s2
    return total if order % 2 else total - re[0]


@inner
def _polish(
    re: Array, im: Array, order: int, low: float, high: float, h_low: float, h_high: float
) -> float:
    """Return the zero of h in [low, high], where h changes sign, by safeguarded Newton steps."""
    theta = low + (high - low) * abs(h_low) / (abs(h_low) + abs(h_high))
    rising = h_high > h_low
    for _ in range(100):
        h, slope = evaluate(re, im, order, theta)
        if h == 0.0:
            break
        if (h < 0.0) == rising:
            low = theta
        else:
            high = theta
        step = -h / slope if slope != 0.0 else np.inf
        guess = theta + step
        if not low <= guess <= high:
            guess = 0.5 * (low + high)
        done = abs(guess - theta) <= 2e-16 * (1.0 + abs(theta))
        theta = guess
        if done:
            break
    return theta


@inner
def critical_angles(
    re: Array,
    im: Array,
    order: int,
    cosines: Array,
    sines: Array,
    samples: Array,
    stack: Array,
    angle: Array,
    kind: Any,
) -> int:
    """Find all critical angles of g on [0, pi).

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
    stack : (DEPTH + 2, 6) float64
        Scratch for the halvings.
    angle : (>= order,) float64
        Receives the angles, ascending.
    kind : (>= order,) int8
        Receives +1 (maximum), -1 (minimum) or 0 (inflection).

    Returns
    -------
    int
        Number of angles.
    """
    parity = order % 2
    third = 0.0  # bound on |h''|
    fourth = 0.0  # bound on |h'''|
    for j in range(order // 2 + 1):
        n = 2.0 * j + parity
        size = 2.0 * np.hypot(re[j], im[j])
        third += n**3 * size
        fourth += n**4 * size
    found = 0
    if third == 0.0:
        return 0
    width = np.pi / SAMPLES
    finest = width * 2.0 ** (-DEPTH)
    for sample in range(SAMPLES + 1):
        samples[0, sample] = 0.0
        samples[1, sample] = 0.0
    for j in range(order // 2 + 1):
        n = 2 * j + parity
        p = -2.0 * n * re[j]
        q = -2.0 * n * im[j]
        for sample in range(SAMPLES):
            samples[0, sample] += p * sines[n, sample] + q * cosines[n, sample]
            samples[1, sample] += n * (p * cosines[n, sample] - q * sines[n, sample])
    # h(theta + pi) = (-1)^k h(theta), to the bit, so that a zero at 0 is found once.
    samples[0, SAMPLES] = -samples[0, 0] if parity else samples[0, 0]
    samples[1, SAMPLES] = -samples[1, 0] if parity else samples[1, 0]
    for sample in range(1, SAMPLES + 1):
        ha = samples[0, sample - 1]
        hb = samples[0, sample]
        change = (ha < 0.0) != (hb < 0.0)
        if not change and sample < SAMPLES and min(abs(ha), abs(hb)) > third * width * width / 8.0:
            continue
        top = 0
        stack[0, 0] = (sample - 1) * width
        stack[0, 1] = sample * width
        stack[0, 2] = ha
        stack[0, 3] = hb
        stack[0, 4] = samples[1, sample - 1]
        stack[0, 5] = samples[1, sample]
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
            if not change and min(abs(ha), abs(hb)) > third * d * d / 8.0:
                continue
            monotone = da * db > 0.0 and min(abs(da), abs(db)) > fourth * d * d / 8.0
            if not monotone and d > finest:
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
            if not change and monotone:
                continue
            merge = found > 0 and low - angle[found - 1] < 4.0 * finest
            if merge and not monotone:
                # The same multiple zero, seen from the next interval.
                if change:
                    kind[found - 1] = 1 if negative_b else -1
                continue
            if found == order:
                break
            if change:
                angle[found] = _polish(re, im, order, low, high, ha, hb)
                kind[found] = 1 if negative_b else -1
            else:
                angle[found] = 0.5 * (low + high)
                kind[found] = 0
            found += 1
    return found
