"""What is certain about a function on an interval, from its values and slopes at both ends.

On an interval of width d the linear interpolant of a function h differs from it by at most d^2 / 8
times the maximum of h'', and the cubic one, of values and slopes, by d^4 / 384 times that of the
fourth derivative. The cubic lies between its least and largest coefficient over Bernstein's
polynomials. `third`, `fourth` and `fifth` bound those derivatives of g, where h = g'; what is not
larger than `floor` cannot be told from zero.
"""

from __future__ import annotations

from pdtheory.pointset.kernels.jit import inner


@inner
def empty(
    ha: float, hb: float, da: float, db: float, d: float, third: float, fifth: float, floor: float
) -> bool:
    """Whether h certainly has no zero on an interval of width d."""
    if (ha < 0.0) != (hb < 0.0):
        return False
    if min(abs(ha), abs(hb)) > third * d * d / 8.0:
        return True
    a = ha + da * d / 3.0
    b = hb - db * d / 3.0
    error = fifth * d * d * d * d / 384.0 + floor
    return min(min(ha, hb), min(a, b)) > error or max(max(ha, hb), max(a, b)) < -error


@inner
def monotone_on(
    ha: float, hb: float, da: float, db: float, d: float, fourth: float, fifth: float, floor: float
) -> bool:
    """Whether h' certainly has no zero on an interval of width d.

    The error of the interpolant vanishes at both ends, so its derivative does there and, by Rolle's
    theorem, somewhere between: it is at most max |h''''| / 6 times the maximum of the product of
    the three distances, 4 d^3 / 27.
    """
    if not da * db > 0.0:
        return False
    least = min(abs(da), abs(db))
    if least > fourth * d * d / 8.0:
        return True
    middle = 3.0 * (hb - ha) / d - da - db
    error = fifth * d * d * d * 2.0 / 81.0 + 6.0 * floor / d
    return da * middle > 0.0 and min(least, abs(middle)) > error
