"""Critical angles improved to rounding, many at a time."""

from __future__ import annotations

from math import factorial, pi
from typing import Any

from pdtheory.pointset.kernels.lanes import LANES, Lanes, Rows, emit
from pdtheory.pointset.kernels.roots import (
    ANGLE,
    COEFFICIENTS,
    COSINE,
    CURVATURE,
    HIGH,
    LOW,
    RISING,
    SINE,
    VALUE,
)

#: Most rounds of Newton steps and bisections, and the step at which they end: the next one would be
#: h'' / (2 h') times its square, less than what rounding of h does to the angle.
ROUNDS, LAST_STEP = 100, 1e-10
#: Terms of the Taylor series of sine and cosine up to a quarter turn.
_TERMS = 12


@emit
def polish(to: Lanes, table: Rows, order: Any, count: Any) -> None:
    """Improve the first `count` angles of a table to rounding, and write g, g'' and sines there.

    Newton steps, or bisections where a step leaves the interval; those with RISING 0 stay. Columns
    behind `count`, up to a whole vector, are overwritten.
    """
    build = to.builder
    parity = to.minus(order, to.mul(to.div(order, 2), 2))
    odd = build.icmp_signed("==", parity, to.integer(1))
    with to.count(0, count, LANES) as i:
        theta = to.variable(to.load(table.at(ANGLE, i)))
        low = to.variable(to.load(table.at(LOW, i)))
        high = to.variable(to.load(table.at(HIGH, i)))
        rising = to.load(table.at(RISING, i))
        zero = to.constant(0.0)
        # An angle that is done stays, whatever the others in its vector do.
        moves = to.variable(build.fcmp_ordered("!=", rising, zero))
        with to.count(0, ROUNDS), build.if_then(to.any(to.get(moves))):
            at = to.get(theta)
            _, first, second, _, _ = _terms(to, table, i, order, parity, odd, at)
            ahead = build.fcmp_ordered("<", to.times(first, rising), zero)
            to.put(build.select(ahead, at, to.get(low)), low)
            to.put(build.select(ahead, to.get(high), at), high)
            step = to.divide(first, second)
            guess = to.subtract(at, step)
            inside = build.and_(
                build.fcmp_ordered("<=", to.get(low), guess),
                build.fcmp_ordered("<=", guess, to.get(high)),
            )
            half = to.times(to.constant(0.5), to.add(to.get(low), to.get(high)))
            guess = build.select(inside, guess, half)
            moved = build.and_(to.get(moves), build.fcmp_ordered("!=", first, zero))
            guess = build.select(moved, guess, at)
            size = to.subtract(guess, at)
            large = build.fcmp_ordered(
                ">", to.times(size, size), to.constant(LAST_STEP * LAST_STEP)
            )
            to.put(guess, theta)
            to.put(build.and_(moved, large), moves)
        at = to.get(theta)
        value, _, second, c, s = _terms(to, table, i, order, parity, odd, at)
        rows = (ANGLE, VALUE, CURVATURE, COSINE, SINE)
        for row, result in zip(rows, (at, value, second, c, s), strict=True):
            to.store(result, table.at(row, i))


def _terms(
    to: Lanes, table: Rows, i: Any, order: Any, parity: Any, odd: Any, theta: Any
) -> tuple[Any, Any, Any, Any, Any]:
    """g, g', g'', cosine and sine at LANES angles in [0, pi]."""
    build = to.builder
    # cos(theta) = -sin(x), sin(theta) = cos(x) with x = theta - pi / 2, pi in two parts.
    x = to.subtract(theta, to.constant(pi / 2))
    x = to.subtract(x, to.constant(6.123233995736766e-17))
    square = to.times(x, x)
    c, s = to.constant(0.0), to.constant(0.0)
    for k in range(_TERMS - 1, -1, -1):
        sign = -1.0 if k % 2 else 1.0
        c = to.add(to.times(c, square), to.constant(-sign / factorial(2 * k + 1)))
        s = to.add(to.times(s, square), to.constant(sign / factorial(2 * k)))
    c1, s1 = to.times(c, x), s
    c2 = to.subtract(to.times(c1, c1), to.times(s1, s1))
    s2 = to.times(to.add(c1, c1), s1)
    cn = to.variable(build.select(odd, c1, to.constant(1.0)))
    sn = to.variable(build.select(odd, s1, to.constant(0.0)))
    zero = to.constant(0.0)
    value, first, second = (to.variable(zero) for _ in range(3))
    with to.count(0, to.plus(to.div(order, 2), 1)) as j:
        n = to.plus(j, j, parity)
        real = to.spread(build.sitofp(n, to.real(0.0).type))
        row = to.plus(COEFFICIENTS, j, j)
        re, im = to.load(table.at(row, i)), to.load(table.at(to.plus(row, 1), i))
        c, s = to.get(cn), to.get(sn)
        even = to.subtract(to.times(re, c), to.times(im, s))
        slope = to.times(real, to.add(to.times(re, s), to.times(im, c)))
        # phi_0 counts once, the others together with their conjugates.
        single = build.icmp_signed("==", n, to.integer(0))
        weight = to.spread(build.select(single, to.real(1.0), to.real(2.0)))
        to.put(to.add(to.times(weight, even), to.get(value)), value)
        to.put(to.subtract(to.get(first), to.times(weight, slope)), first)
        bend = to.times(to.times(real, real), even)
        to.put(to.subtract(to.get(second), to.times(weight, bend)), second)
        to.put(to.subtract(to.times(c, c2), to.times(s, s2)), cn)
        to.put(to.add(to.times(s, c2), to.times(c, s2)), sn)
    return to.get(value), to.get(first), to.get(second), c1, s1
