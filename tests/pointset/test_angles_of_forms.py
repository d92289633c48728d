"""The angles of given forms against polynomial roots with 60 digits."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest

from pdtheory.pointset.kernels.directions import BENCH, find_directions
from pdtheory.pointset.kernels.results import ANGLE, DEGREE, PLAIN, RADIUS, Traces, make_found
from pdtheory.pointset.kernels.tables import make_record, make_tables

FORMS = 24


def frequencies(order):
    return np.arange(order % 2, order + 1, 2)


def forms(order, seed):
    """Random phi_n; where possible g' and g'' nearly vanish together somewhere."""
    rng = np.random.default_rng(seed)
    n = frequencies(order)
    c = rng.normal(size=(FORMS, len(n))) + 1j * rng.normal(size=(FORMS, len(n)))
    c *= 10.0 ** rng.integers(-4, 1, size=c.shape)
    c[:, n == 0] = c[:, n == 0].real
    if len(n) > 2:
        theta = rng.uniform(0, np.pi, FORMS)
        wave = c * np.exp(1j * np.outer(theta, n))
        first, second = -2 * wave.imag @ n, -2 * wave.real @ n**2
        # Beside the zero of both, there are two zeros of g' close together, or none.
        miss = rng.choice([-1.0, 1.0], FORMS) * 10.0 ** rng.uniform(-9, -4, FORMS)
        change = second / (2 * order**2) + 1j * (first / (2 * order) + miss)
        near = rng.random(FORMS) < 0.7
        c[near, -1] += (change * np.exp(-1j * order * theta))[near]
    return c / np.abs(c[:, n > 0]).max(axis=1, keepdims=True)


def angles_of(order, c):
    """The angles that the engine finds, form by form."""
    columns = sum(k // 2 + 1 for k in range(order))
    found = make_found(len(c), 1, columns + c.shape[1])
    found.numbers[:] = 0.0
    found.numbers[:, RADIUS], found.numbers[:, DEGREE] = 1.0, order
    found.phi[:] = 0.0
    found.phi[:, columns:] = c
    turn = np.tile([1.0, 0.0], (len(c), 1))
    traces = Traces(turn, np.zeros((len(c), 1)), np.empty((len(c), 0)))
    rows = np.empty((len(c) * order, PLAIN))
    orders, slots = np.array([order]), np.arange(len(c))
    stop = np.zeros(1, np.uint8)
    bench, tables = make_record(BENCH), make_tables()
    count = find_directions(orders, tables, bench, stop, traces, slots, found, rows)
    return np.split(rows[:count, ANGLE], np.cumsum(found.counts[0])[:-1])


def wanted_of(order, c):
    """Angles in [0, pi) where g' vanishes: roots of modulus 1 of a polynomial in e^(2 i theta)."""
    n = frequencies(order)
    upper = [mpmath.mpc(x) * int(k) * 1j for x, k in zip(c, n, strict=True) if k > 0]
    lower = [mpmath.conj(x) for x in upper]
    middle = [] if order % 2 else [mpmath.mpf(0)]
    roots = mpmath.polyroots([*upper[::-1], *middle, *lower], maxsteps=500, extraprec=400)
    on = [mpmath.arg(z) / 2 for z in roots if abs(abs(z) - 1) < mpmath.mpf(10) ** -25]
    return np.sort([float(angle % mpmath.pi) for angle in on])


def product_of_sines(zeros):
    """phi_n of the form of odd order whose derivative is the product of sin(theta - zero)."""
    wave = {0: 1.0 + 0.0j}
    for zero in zeros:
        terms = {}
        for n, c in wave.items():
            for step in (1, -1):
                part = step * np.exp(-1j * step * zero) / 2j
                terms[n + step] = terms.get(n + step, 0.0) + c * part
        wave = terms
    n = frequencies(len(zeros))
    return np.array([wave[k] / (1j * k) for k in n])


@pytest.mark.parametrize("place", [0.0, np.pi, 38 * np.pi / 64, 11 * np.pi / 64])
@pytest.mark.parametrize("order", [3, 5, 9, 13])
def test_two_zeros_that_nearly_agree_are_where_they_are(order, place):
    """Also at the ends of the intervals that are looked at, and at the end of the half circle."""
    rng = np.random.default_rng(order)
    gaps = 10.0 ** rng.uniform(-8.0, -5.5, 200)
    starts = place + gaps * rng.uniform(-1.5, 0.5, 200)
    others = np.linspace(0.4, 2.6, order - 2)[None, :] + rng.uniform(-0.1, 0.1, (200, order - 2))
    others = place + others
    zeros = np.column_stack([starts, starts + gaps, others])
    c = np.array([product_of_sines(row) for row in zeros])
    for row, gap, found in zip(zeros, gaps, angles_of(order, c), strict=True):
        apart = np.abs((found[:, None] - row[None, :] + np.pi / 2) % np.pi - np.pi / 2)
        assert apart.min(axis=1).max() < max(10 * gap, 1e-6)
        assert apart.min(axis=0)[2:].max() < 1e-9
        assert apart.min(axis=0)[:2].max() < max(10 * gap, 1e-6)


@pytest.mark.parametrize("order", range(3, 13))
def test_no_angle_is_missed_and_none_is_made_up(order):
    c = forms(order, seed=order)
    close = 0
    with mpmath.workdps(60):
        for form, found in zip(c, angles_of(order, c), strict=True):
            wanted = wanted_of(order, form)
            gaps = np.append(np.diff(wanted), np.pi) if len(wanted) else np.array([np.pi])
            close += gaps.min() < 1e-2
            assert len(found) == len(wanted)
            # Two zeros of g' that are a gap d apart are as well known as rounding over d.
            assert np.abs(found - wanted).max(initial=0.0) < 1e-13 / gaps.min()
    assert close > 3 or order == 3
