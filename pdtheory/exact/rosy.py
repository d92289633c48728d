"""Directions that form a RoSy: k of one kind, 360/k degrees apart."""

from __future__ import annotations

import sympy as sp

from pdtheory.conventions import Kind
from pdtheory.exact.coefficients import check_order
from pdtheory.exact.faces import Face
from pdtheory.exact.strata import count_maxima
from pdtheory.exact.wavejets import WavejetsRow
from pdtheory.exact.zeros import is_zero, sign


def rosy_kinds(face: Face) -> frozenset[Kind]:
    """Return which kinds of directions form a k-RoSy: k of them, 360/k degrees apart.

    k odd: maxima and minima, iff phi_n = 0 for n != k and phi_k != 0. k even: the maxima iff, with
    psi_n = phi_n e^{i n t0} for one maximum t0, psi_k > 0, n psi_n = (k-n) conj(psi_{k-n}) for
    2 <= n <= k-2, and g'' < 0 at all t0 + 2 pi j / k; both kinds iff phi_n = 0 for n not in {0, k}.

    Parameters
    ----------
    face
        A tensor, form or row of order k >= 2 with real algebraic coefficients.

    Returns
    -------
    frozenset of Kind
        Some of `Kind.MAXIMUM` and `Kind.MINIMUM`.
    """
    row = face.row
    k = check_order(row.order, 2)
    if k % 2 or row.support == [k]:
        both = frozenset({Kind.MAXIMUM, Kind.MINIMUM})
        return both if row.support == [k] else frozenset()
    found = set()
    for kind, signed in ((Kind.MAXIMUM, row), (Kind.MINIMUM, -row)):
        if _maxima_are_rosy(signed):
            found.add(kind)
    return frozenset(found)


def _maxima_are_rosy(row: WavejetsRow) -> bool:
    k = row.order
    size = sp.sqrt(row.squared_modulus(k))
    if is_zero(size):
        return False
    for n in range(2, k - 1, 2):
        # psi_k > 0 means e^{-i k t0} = phi_k / |phi_k|.
        defect = sp.expand(n * row[n] * size - (k - n) * row[n - k] * row[k])
        if not all(is_zero(part) for part in defect.as_real_imag()):
            return False
    # Then all t0 + 2 pi j / k are critical. With k maxima all critical points are simple, so that
    # the second derivative decides.
    if count_maxima(row) != k:
        return False
    start = -sp.arg(row[k]) / k
    second = row.form.angular_derivative().angular_derivative()
    angles = (start + 2 * sp.pi * j / k for j in range(k // 2))
    return all(sign(second(sp.cos(a), sp.sin(a))) < 0 for a in angles)
