"""The inverse problem: Wavejets rows with given directions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cmp_to_key
from itertools import pairwise
from math import prod
from typing import Any

import sympy as sp

from pdtheory.errors import InputError
from pdtheory.exact.coefficients import check_order, exact
from pdtheory.exact.constantroots import RealConstant
from pdtheory.exact.realnumber import precisions
from pdtheory.exact.wavejets import WavejetsRow
from pdtheory.exact.waves import Wave
from pdtheory.exact.zeros import is_real, is_zero, sign


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
    ComputationError
        If whether two angles are equal could not be proved (`zeros.is_zero`).

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


def _ascending(angles: Sequence[Any], period: int = 360) -> tuple[Any, ...]:
    """Return the different angles in [0, period), ascending; a number may be written in many ways.

    Raises
    ------
    InputError
        If there is no angle, or one is no real number.
    """
    values = [exact(a) for a in angles]
    if not values:
        raise InputError("No angle is given; give at least one, in degrees.")
    for a in values:
        if a.free_symbols or not is_real(a):
            raise InputError(f"The angle {a} is not a real number of degrees.")
    folded = sorted((_folded(a, period) for a in values), key=_ORDER)
    return tuple(b for i, b in enumerate(folded) if i == 0 or not is_zero(b - folded[i - 1]))


def _folded(angle: Any, period: int) -> Any:
    """Return an angle up to whole periods, in [0, period)."""
    ratio = RealConstant(angle / period)
    near = next(e for e in map(ratio.at_precision, precisions()) if e.width < Fraction(1, 2))
    # The rest is below three quarters of a period on either side of zero.
    rest = angle - round(near.middle) * period
    side = sign(rest)
    return (rest if side > 0 else rest + period) if side else sp.Integer(0)


def _refuse_odd(order: int, angles: tuple[Any, ...]) -> str | None:
    for i, a in enumerate(angles):
        for b in angles[i + 1 :]:
            if is_zero(b - a - 180):
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
        [(a, 0) for a in angles] + [(_folded(a + 180, 360), 1) for a in angles],
        key=lambda pair: _ORDER(pair[0]),
    )
    for (a, first), (b, second) in pairwise([*marked, marked[0]]):
        if first == second:
            low, high = (a, b) if not first else (_folded(c + 180, 360) for c in (a, b))
            return (
                f"no opposite of another angle lies between {low} and {high} degrees, "
                "but between two maxima there is a minimum, which is the opposite of a maximum"
            )
    return None


def _refuse_even(order: int, angles: tuple[Any, ...]) -> str | None:
    for a in angles:
        opposite = _folded(a + 180, 360)
        if not any(is_zero(b - opposite) for b in angles):
            return f"{a} degrees is given without its opposite, but g of even order has period 180"
    if len(angles) > order:
        return f"order {order} has at most {order} maxima, not {len(angles)}"
    return None


def _odd_row(order: int, angles: tuple[Any, ...]) -> WavejetsRow:
    """Integrate F = +-prod sin(theta - a_j), which on the circle needs no factor x^2 + y^2."""
    # F falls at the first angle, which is below the others.
    falling = prod((-sign(b - angles[0] - 180) for b in angles[1:]), start=-1)
    falling *= (-1) ** (len(angles) - 1)
    sines = Wave.product_of_sines(angles)
    return _integrate(sines, order, 90 * len(angles), sp.Rational(falling, 2 ** len(angles)))


def _even_row(order: int, angles: tuple[Any, ...]) -> WavejetsRow:
    """Return g = -P^2 without its mean, P = prod sin(theta - a_j) for m lines a_j.

    At the lines alone g is 0 and not negative. Its other critical points are the zeros of P': one
    in each of the m gaps by Rolle, and a form of degree m has no more.
    """
    sines = Wave.product_of_sines(angles)
    # The square of (2 i)^m is (-4)^m.
    return _row(order, sines * sines, lambda n: -(sp.Rational(-1, 4) ** len(angles)))


def _integrate(derivative: Wave, order: int, turn: int, scale: Any = 1) -> WavejetsRow:
    """Return the row with g' = scale exp(-i turn) F, turn in degrees, for F of mean zero."""
    return _row(order, derivative, lambda n: scale / sp.Integer(n), turn + 90)


def _row(order: int, wave: Wave, scale: Callable[[int], Any], turn: int = 0) -> WavejetsRow:
    """Return the row with phi_n = scale(n) exp(-i turn) times the coefficients, and no mean."""
    row = WavejetsRow(order, {})
    for n in row.parts:
        if n:
            real, imaginary = wave.parts(n, turn=turn)
            row.parts[n] = scale(n) * real, scale(n) * imaginary
    return row


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
        If the order is below 1, there is no angle, or one is no real number.
    ComputationError
        If whether two angles are equal could not be proved (`zeros.is_zero`).

    Notes
    -----
    F must be the product of the m lines and any form of degree k - m; for even k its mean over the
    circle must vanish too, as that of every derivative along the circle.
    """
    k = check_order(order, 1)
    lines = _ascending(angles, 180)
    sines = Wave.product_of_sines(lines)
    # All forms and the turn of their coefficients belong to (2 i)^m F.
    forms, turn = [sines * factor for factor in _basis(k - len(lines))], 90 * len(lines)
    if k % 2:
        return [_integrate(form, k, turn) for form in forms]
    flat = [form for form in forms if not any(form.parts(0))]
    tilted = [form for form in forms if any(form.parts(0))]
    rows = [WavejetsRow(k, {0: 1}), *(_integrate(form, k, turn) for form in flat)]
    for form in tilted[1:]:
        means = [Wave.constant(f.terms[0]) for f in (tilted[0], form)]
        rows.append(_integrate(form * means[0] - tilted[0] * means[1], k, 2 * turn))
    return rows


def _basis(degree: int) -> list[Wave]:
    """Return a real basis of the forms of a degree on the circle; none of a negative degree."""
    return [
        Wave.cosine(n, shift)
        for n in range(degree % 2, degree + 1, 2)
        for shift in ((0, 90) if n else (0,))
    ]
