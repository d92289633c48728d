"""The inverse problem: Wavejets rows with given directions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cmp_to_key
from itertools import pairwise
from math import factorial, prod
from typing import Any

import sympy as sp

from pdtheory.errors import InputError
from pdtheory.exact.coefficients import check_order, exact
from pdtheory.exact.faces import BinaryForm
from pdtheory.exact.wavejets import WavejetsRow
from pdtheory.exact.zeros import is_zero, sign

Coefficients = list[Any]


def _compare(a: Any, b: Any) -> int:
    """Return the proved sign of a - b."""
    return sign(a - b)


_ORDER = cmp_to_key(_compare)


@dataclass(frozen=True)
class Realization:
    """Whether given angles are the maxima of some row, with a certificate or the reason why not.

    Attributes
    ----------
    order : int
        The order k.
    angles : tuple
        The angles in degrees, exact, ascending in [0, 360).
    row : WavejetsRow or None
        A row whose maxima are exactly these angles; None if there is none.
    reason : str
        Why it exists, or why it cannot.
    """

    order: int
    angles: tuple[Any, ...]
    row: WavejetsRow | None
    reason: str

    @property
    def is_realizable(self) -> bool:
        """True if a row exists."""
        return self.row is not None


def realize_maxima(order: int, angles: Sequence[Any]) -> Realization:
    """Decide whether a set of angles is the set of maxima of a row of one order, and build the row.

    k odd: iff their number is odd and at most k and they interlace with their opposites. k even:
    iff they come in opposite pairs, at most k/2 of them.

    Parameters
    ----------
    order
        The order k >= 1.
    angles
        Angles in degrees, exact; all maxima on the full circle.

    Returns
    -------
    Realization
        The verdict with its certificate.

    Raises
    ------
    InputError
        If the order is below 1, there is no angle, or one is no real number.

    Examples
    --------
    >>> realize_maxima(3, [0, 120, 240]).row
    WavejetsRow(order=3, {1: 0, 3: 1/24})
    >>> realize_maxima(3, [0, 90, 180]).reason
    '0 and 180 degrees are opposite, where a maximum of odd order faces a minimum'
    """
    k = check_order(order, 1)
    chosen = _ascending(angles)
    refusal = _refuse_odd(k, chosen) if k % 2 else _refuse_even(k, chosen)
    if refusal:
        return Realization(k, chosen, None, refusal)
    if k % 2:
        row = _odd_row(k, chosen)
        reason = f"the {len(chosen)} angles interlace with their opposites"
    else:
        row = _even_row(k, chosen[: len(chosen) // 2])
        reason = f"the angles are {len(chosen) // 2} opposite pairs, at most {k // 2}"
    return Realization(k, chosen, row, reason)


def _ascending(angles: Sequence[Any]) -> tuple[Any, ...]:
    values = [exact(a) for a in angles]
    if not values:
        raise InputError("No angle is given; give at least one, in degrees.")
    for a in values:
        if not a.is_real:
            raise InputError(f"The angle {a} is not a real number of degrees.")
    return tuple(sorted({a - 360 * sp.floor(a / 360) for a in values}, key=_ORDER))


def _refuse_odd(order: int, angles: tuple[Any, ...]) -> str | None:
    for i, a in enumerate(angles):
        for b in angles[i + 1 :]:
            if b - a == 180:
                return (
                    f"{a} and {b} degrees are opposite, "
                    "where a maximum of odd order faces a minimum"
                )
    if len(angles) % 2 == 0:
        return f"the number of maxima of odd order is odd, not {len(angles)}"
    if len(angles) > order:
        return f"order {order} has at most {order} maxima, not {len(angles)}"
    if len(angles) == 1:
        return None
    # Interlacing: going round, angles and opposites alternate.
    marked = sorted(
        [(a, 0) for a in angles] + [((a + 180) % 360, 1) for a in angles],
        key=lambda pair: _ORDER(pair[0]),
    )
    for (a, first), (b, second) in pairwise([*marked, marked[0]]):
        if first == second:
            low, high = (a, b) if not first else ((a + 180) % 360, (b + 180) % 360)
            return (
                f"no opposite of another angle lies between {low} and {high} degrees, "
                "but between two maxima there is a minimum, which is the opposite of a maximum"
            )
    return None


def _refuse_even(order: int, angles: tuple[Any, ...]) -> str | None:
    present = set(angles)
    for a in angles:
        if (a + 180) % 360 not in present:
            return f"{a} degrees is given without its opposite, but g of even order has period 180"
    if len(angles) > order:
        return f"order {order} has at most {order} maxima, not {len(angles)}"
    return None


def _odd_row(order: int, angles: tuple[Any, ...]) -> WavejetsRow:
    """Integrate F = +-prod sin(theta - a_j), which on the circle needs no factor x^2 + y^2."""
    # F falls at the first angle, which is below the others.
    falling = prod((-sign(b - angles[0] - 180) for b in angles[1:]), start=-1)
    falling *= (-1) ** (len(angles) - 1)
    row = WavejetsRow(order, {})
    for n, turns in _product_of_sines(angles).items():
        if n > 0:
            # (2 i)^-m times the sum of c exp(-i b), over i n: m + 1 is even.
            scale = sp.Rational(falling * (-1) ** ((len(angles) + 1) // 2), 2 ** len(angles) * n)
            waves = [(c, sp.pi * b / 180) for b, c in turns.items()]
            row.parts[n] = (
                scale * sp.Add(*(c * sp.cos(b) for c, b in waves)),
                scale * sp.Add(*(-c * sp.sin(b) for c, b in waves)),
            )
    return row


def _product_of_sines(angles: Sequence[Any]) -> dict[int, dict[Any, int]]:
    """Return (2 i)^m prod sin(theta - a_j) = sum_n exp(i n theta) sum_b c exp(-i b).

    Returns
    -------
    dict
        By n the integer coefficients c by b, in degrees.
    """
    total: dict[int, dict[Any, int]] = {0: {sp.Integer(0): 1}}
    for a in angles:
        longer: dict[int, dict[Any, int]] = {}
        for n, turns in total.items():
            for b, c in turns.items():
                for step in (1, -1):
                    row, turned = longer.setdefault(n + step, {}), (b + step * a) % 360
                    row[turned] = row.get(turned, 0) + step * c
        total = longer
    return {n: {b: c for b, c in turns.items() if c} for n, turns in total.items()}


def _even_row(order: int, angles: tuple[Any, ...]) -> WavejetsRow:
    """Build F = (maxima) (minima) (x^2+y^2)^j with mean zero.

    Two choices of minima, just after and just before the maxima, give means of opposite sign; the
    combination of both with mean zero still has one sign change in each gap, because a form of
    degree m has no more than m zeros.
    """
    ends = [_unit(a) for a in (*angles, angles[0] + 180)]
    maxima = _through(ends[:-1])
    if len(angles) == 1:
        ((c, s),) = ends[:-1]
        minima = _through([(-s, c)])
    else:
        minima = _minima(maxima, ends)
    form = _times_circle(_multiply(maxima, minima), order)
    row = _integrate(form)
    return row if _slope(form, ends[0]) < 0 else -row


def _minima(maxima: Coefficients, ends: list[tuple[Any, Any]]) -> Coefficients:
    share = sp.Rational(1, 8)
    while True:
        first, second = (
            _through(
                [
                    ((1 - part) * a[0] + part * b[0], (1 - part) * a[1] + part * b[1])
                    for a, b in pairwise(ends)
                ]
            )
            for part in (share, 1 - share)
        )
        means = [_mean(_multiply(maxima, m)) for m in (first, second)]
        if sign(means[0]) * sign(means[1]) < 0:
            return [
                sp.expand(means[1] * p - means[0] * q) for p, q in zip(first, second, strict=True)
            ]
        share /= 2


def _unit(degrees: Any) -> tuple[Any, Any]:
    return sp.cos(sp.pi * degrees / 180), sp.sin(sp.pi * degrees / 180)


def _through(vectors: Sequence[tuple[Any, Any]]) -> Coefficients:
    """Return the form that vanishes along the vectors: the product of c y - s x."""
    product: Coefficients = [sp.Integer(1)]
    for c, s in vectors:
        product = _multiply(product, [-s, c])
    return product


def _multiply(a: Coefficients, b: Coefficients) -> Coefficients:
    result = [sp.Integer(0)] * (len(a) + len(b) - 1)
    for i, p in enumerate(a):
        for j, q in enumerate(b):
            result[i + j] += p * q
    return [sp.expand(c) for c in result]


def _times_circle(form: Coefficients, order: int) -> BinaryForm:
    while len(form) - 1 < order:
        form = _multiply(form, [sp.Integer(1), sp.Integer(0), sp.Integer(1)])
    return BinaryForm(form)


def _mean(form: Coefficients) -> Any:
    """Return the mean of a form of even order over the circle."""
    return factorial(len(form) - 1) * BinaryForm(form).row[0]


def _slope(form: BinaryForm, v: tuple[Any, Any]) -> int:
    """Return the sign of the derivative of a form along the circle at v."""
    return sign(form.angular_derivative()(*v))


def _integrate(derivative: BinaryForm) -> WavejetsRow:
    """Return the row with g' = F on the circle, for a form F of mean zero."""
    phi, scale = {}, factorial(derivative.order)
    for n, (real, imaginary) in derivative.row.parts.items():
        if n:
            # F has the coefficients k! Phi_n in the convention of rows, and they are i n phi_n.
            phi[n] = scale * (imaginary - sp.I * real) / n
    return WavejetsRow(derivative.order, phi)


def rows_with_critical_lines(order: int, angles: Sequence[Any]) -> list[WavejetsRow]:
    """Return a basis of all rows of an order that have given lines as E-eigenvectors.

    Parameters
    ----------
    order
        The order k >= 1.
    angles
        Angles in degrees, exact; a line is an angle modulo 180.

    Returns
    -------
    list of WavejetsRow
        For m <= k distinct lines k + 1 - m rows; the constant row, which has every line, is among
        them for even k.

    Raises
    ------
    InputError
        If the order is below 1 or an angle is no real number.

    Notes
    -----
    F must be the product of the m lines and any form of degree k - m; for even k its mean over the
    circle must vanish too, as that of every derivative along the circle.
    """
    k = check_order(order, 1)
    lines = sorted({a - 180 * sp.floor(a / 180) for a in _ascending(angles)}, key=_ORDER)
    free = k - len(lines)
    product = _through([_unit(a) for a in lines])
    monomials = [[sp.Integer(int(i == j)) for i in range(free + 1)] for j in range(free + 1)]
    forms = [BinaryForm(_multiply(product, m)) for m in monomials]
    if k % 2:
        return [_integrate(f) for f in forms]
    means = [f.row[0] for f in forms]
    pivot = next((i for i, m in enumerate(means) if not is_zero(m)), None)
    rows = [WavejetsRow(k, {0: 1})]
    for i, (form, mean) in enumerate(zip(forms, means, strict=True)):
        if pivot is None or is_zero(mean):
            rows.append(_integrate(form))
        elif i != pivot:
            rows.append(_integrate(form * means[pivot] - forms[pivot] * mean))
    return rows
