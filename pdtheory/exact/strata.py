"""How many principal directions: exact counts, discriminants, and where the count changes.

The number of maxima of a row changes where two directions meet, on the zero set of the discriminant
of F. For two frequencies p < q with phi_q = 1 that is a hypocycloid in the plane of phi_p: the
deltoid for order 3, the astroid for order 4.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt
import sympy as sp

from pdtheory.errors import InputError
from pdtheory.exact.characteristic import sylvester_resultant
from pdtheory.exact.coefficients import check_order, exact
from pdtheory.exact.faces import Face
from pdtheory.exact.realcoefficients import Coefficients
from pdtheory.exact.roots import form_roots
from pdtheory.exact.wavejets import WavejetsRow
from pdtheory.exact.zeros import sign

_T = sp.Symbol("t")


def count_maxima(face: Face) -> int:
    """Return the number of maxima on the full circle by Sturm sequences, without finding any.

    Parameters
    ----------
    face
        A tensor, form or row of order k >= 1 with real coefficients that can be enclosed.

    Returns
    -------
    int
        The number of maxima, equal to that of minima; 0 where g_k is constant.

    Notes
    -----
    F changes sign exactly at its real zeros of odd multiplicity, on the half circle and, by parity,
    at their opposites, so that they number as many as the maxima on the circle. The squarefree
    parts of odd multiplicity are counted by the sign variations of their Sturm sequences; where
    the coefficients lie in no small number field, by isolating all complex roots in balls.
    """
    form = face.form
    check_order(form.order, 1)
    derivative = form.angular_derivative()
    numbers = Coefficients(derivative.coefficients)
    numbers.check_real_numbers()
    if not numbers.in_field:
        if derivative.is_zero:
            return 0
        return sum(root.multiplicity % 2 for root in form_roots(derivative.coefficients))
    field, elements = numbers.field_elements
    poly = sp.Poly.from_list(elements[::-1], _T, domain=field)
    if poly.is_zero:
        return 0
    odd = [part for part, multiplicity in poly.sqf_list()[1] if multiplicity % 2]
    at_infinity = (form.order - poly.degree()) % 2
    return sum(_sturm_count(part) for part in odd) + at_infinity


def _sturm_count(poly: Any) -> int:
    """Return the number of real roots of a squarefree polynomial from its Sturm sequence."""
    sequence = poly.sturm()
    signs = [(sign(p.LC()), p.degree()) for p in sequence]
    at_plus = [s for s, _ in signs]
    at_minus = [s * (-1) ** d for s, d in signs]
    return _variations(at_minus) - _variations(at_plus)


def _variations(signs: list[int]) -> int:
    return sum(a != b for a, b in pairwise(signs))


def count_bounds(face: Face) -> tuple[int, int]:
    """Return n_min and n_max, between which the number of maxima lies (Sturm-Hurwitz).

    They are the least and the largest n > 0 with phi_n != 0; (0, 0) where g_k is constant.
    """
    support = face.row.support
    return (support[0], support[-1]) if support else (0, 0)


def parametric_discriminant(face: Face) -> Any:
    """Return the discriminant of F = x f_y - y f_x, also for symbolic coefficients.

    It vanishes exactly where two directions, real or complex, meet.

    Parameters
    ----------
    face
        A tensor, form or row of order k >= 2.

    Returns
    -------
    sympy.Expr
        The resultant of F_x and F_y, which is the discriminant times +-k^(k-2).
    """
    derivative = face.form.angular_derivative()
    check_order(derivative.order, 2)
    first, second = derivative.gradient()
    return sylvester_resultant(first, second)


def order3_discriminant(face: Face) -> Any:
    """Return D3; three maxima if it is negative, else one (unless the row vanishes).

    D3 = |p1|^4 + 162 |p1|^2 |p3|^2 - 2187 |p3|^4 + 24 Re(p1^3 conj p3).
    """
    row = _row_of_order(face, 3)
    (a, b), (c, d) = row.parts[1], row.parts[3]
    p1, p3 = a**2 + b**2, c**2 + d**2
    cube = (a**3 - 3 * a * b**2) * c + (3 * a**2 * b - b**3) * d
    return sp.expand(p1**2 + 162 * p1 * p3 - 2187 * p3**2 + 24 * cube)


def order4_discriminant(face: Face) -> Any:
    """Return D4; four maxima if it is negative, else two (unless p2 = p4 = 0).

    D4 = (|p2|^2 - 16 |p4|^2)^3 + 108 (Im p2^2 conj p4)^2.
    """
    row = _row_of_order(face, 4)
    (a, b), (c, d) = row.parts[2], row.parts[4]
    imaginary = 2 * a * b * c - (a**2 - b**2) * d
    return sp.expand((a**2 + b**2 - 16 * (c**2 + d**2)) ** 3 + 108 * imaginary**2)


def _row_of_order(face: Face, order: int) -> WavejetsRow:
    if face.order != order:
        raise InputError(f"The order is {face.order}; this discriminant is for order {order}.")
    return face.row


def hypocycloid(low: int, high: int, parameter: Any) -> Any:
    """Return the point phi_low of the curve where the count changes, for phi_high = 1.

    a(t) = -(q / 2 p^2) ((q+p) e^{i(q-p)t} + (q-p) e^{-i(q+p)t}) for frequencies p < q. Inside
    |a| < q/p there are q maxima on the circle of the two frequencies, outside |a| > (q/p)^2 there
    are p.

    Parameters
    ----------
    low, high
        The frequencies p < q.
    parameter
        The parameter t, exact or symbolic.
    """
    _check_frequencies(low, high)
    p, q, t = sp.Integer(low), sp.Integer(high), exact(parameter)
    wave = (q + p) * sp.exp(sp.I * (q - p) * t) + (q - p) * sp.exp(-sp.I * (q + p) * t)
    return -q / (2 * p**2) * wave


def deltoid(parameter: Any) -> Any:
    """Return phi_1 = -3 (2 e^{is} + e^{-2is}): the boundary for order 3 with phi_3 = 1."""
    s = exact(parameter)
    return -3 * (2 * sp.exp(sp.I * s) + sp.exp(-2 * sp.I * s))


def astroid(parameter: Any) -> Any:
    """Return phi_2 = -4 (cos^3 s + i sin^3 s): the boundary for order 4 with phi_4 = 1."""
    s = exact(parameter)
    return -4 * (sp.cos(s) ** 3 + sp.I * sp.sin(s) ** 3)


def phase_diagram(
    low: int, high: int, *, extent: float | None = None, size: int = 201
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]:
    """Return the number of maxima over a square of phi_low, for phi_high = 1.

    The count comes from the sign changes of g' on a fine grid of angles, so that a pair of
    directions closer than the grid, next to the boundary, may be missed; `count_maxima` is exact.

    Parameters
    ----------
    low, high
        The frequencies p < q.
    extent
        Half the side of the square; by default a little beyond the cusps at (q/p)^2.
    size
        Number of samples along a side.

    Returns
    -------
    axis : (size,) float
        The real, and likewise the imaginary, parts of phi_low.
    maxima : (size, size) int
        The number of maxima on the circle, by imaginary and then real part.
    """
    _check_frequencies(low, high)
    if size < 2:
        raise InputError(f"The size is {size}; a diagram needs at least 2 samples along a side.")
    reach = 1.1 * (high / low) ** 2 if extent is None else float(extent)
    if not (np.isfinite(reach) and reach > 0):
        raise InputError(f"The extent is {extent}; it must be a positive number.")
    axis = np.linspace(-reach, reach, size)
    # An irrational offset keeps the grid off the symmetric angles, where g' often vanishes.
    angles = 2 * np.pi * (np.arange(256 * high) + np.sqrt(0.5)) / (256 * high)
    wave, fixed = np.exp(1j * low * angles), high * np.sin(high * angles)
    maxima = np.empty((size, size), dtype=np.int64)
    for i, imaginary in enumerate(axis):
        # g' / 2 = -sum n Im(phi_n e^{int}).
        moving = low * np.imag((axis + 1j * imaginary)[:, None] * wave)
        falling = -(moving + fixed) < 0
        maxima[i] = (falling & ~np.roll(falling, 1, axis=1)).sum(axis=1)
    return axis, maxima


def _check_frequencies(low: int, high: int) -> None:
    if not 1 <= low < high <= 64:
        raise InputError(
            f"The frequencies are {low} and {high}; they must be ascending, from 1 to 64."
        )
