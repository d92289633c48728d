"""When an exact constant is zero, and its sign: decided, or refused, never guessed.

A constant that is not zero shows it in an enclosure. Zero itself needs a proof: for algebraic
numbers that the enclosure is smaller than they can be (`separation`), for exponentials the theorem
of Lindemann and Weierstrass (`exponentials`). Where neither applies, as for most relations between
logarithms and powers of pi, nobody knows a procedure, and the answer is an error.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any, Final

import sympy as sp

from pdtheory.errors import ComputationError, InputError
from pdtheory.exact.enclosing import enclose
from pdtheory.exact.exponentials import Term, numerator_terms
from pdtheory.exact.realnumber import precisions
from pdtheory.exact.separation import separation_bits
from pdtheory.exact.sums import Root, TooLong
from pdtheory.exact.texts import size_of

#: Bits of the enclosures in which a constant may show that it is not zero, before a proof of zero
#: is tried, and after.
FIRST_BITS: Final = (64, 256)
LATER_BITS: Final = (1024, 4096, 1 << 14)
#: Largest precision at which an algebraic number is compared with its separation bound.
MOST_BITS: Final = 1 << 20
#: Longest expression that is handed to SymPy's simplification, in operations.
LONGEST_SIMPLIFIED: Final = 400

#: Rational values of free symbols at which a function shows that it is not zero.
_SAMPLES: Final = (sp.Rational(355, 113), sp.Rational(-271, 197), sp.Rational(89, 233))


def is_zero(value: Any) -> bool:
    """Decide whether an exact coefficient vanishes; with free symbols, whether it does identically.

    Raises
    ------
    ComputationError
        If a constant is too close to zero to be told from it and no proof is known either way, as
        for 4 atan(1/5) - atan(1/239) - pi/4.
    """
    if value.is_Rational:
        return bool(value == 0)
    if value.free_symbols:
        return _vanishes_identically(value)
    if any(_excludes_zero(value, bits) for bits in FIRST_BITS):
        return False
    if _is_short(value) and sp.expand(value) == 0:
        return True
    bits = separation_bits(value)
    if bits is not None and bits <= MOST_BITS:
        return _is_below(value, bits)
    proved = _by_exponentials(value)
    if proved is not None:
        return proved
    if any(_excludes_zero(value, bits) for bits in LATER_BITS):
        return False
    if _is_short(value) and sp.simplify(value) == 0:
        return True
    raise ComputationError(
        f"The number {_shown(value)} is below {_bound(value)} in size, and whether it is zero "
        "could not be proved; choose another point or other coefficients."
    )


def sign(value: Any) -> int:
    """Return the sign of a real constant: proved, or refused.

    Raises
    ------
    ComputationError
        As for :func:`is_zero`, and if the number is not real.
    """
    if value.is_Rational:
        return int(sp.sign(value))
    if is_zero(value):
        return 0
    for bits in precisions():
        found = enclose(value, bits)
        if found is not None and found.real.sign:
            return found.real.sign
        if found is not None and found.imaginary.sign:
            break
    raise ComputationError(f"The number {_shown(value)} is not real and has no sign.")


def is_real(number: Any) -> bool:
    """Decide whether a constant is real.

    Raises
    ------
    InputError
        If it could not be proved.
    """
    if number.is_real is not None:
        return bool(number.is_real)
    for bits in (128, 512):
        found = enclose(number, bits)
        if found is not None and found.imaginary.sign is not None:
            # An imaginary part that is an exact zero comes from real functions of real numbers.
            return found.imaginary.sign == 0
    try:
        return is_zero(sp.im(number))
    except ComputationError as error:
        raise InputError(
            f"Whether the coefficient {number} is real could not be proved."
        ) from error


def _excludes_zero(value: Any, bits: int) -> bool:
    found = enclose(value, bits)
    return found is not None and found.excludes_zero


def _is_below(value: Any, separation: int) -> bool:
    """Compare an algebraic number with the least size that it has if it is not zero."""
    bits = max(FIRST_BITS[-1], separation)
    while bits <= 4 * MOST_BITS:
        found = enclose(value, bits)
        if found is not None:
            if found.excludes_zero:
                return False
            # Both parts below half of the bound: so is the modulus below the bound.
            if all(max(-p.lower, p.upper) < Fraction(1, 2 << separation) for p in found):
                return True
        bits *= 2
    raise ComputationError(f"The number {_shown(value)} could not be enclosed near zero.")


def _by_exponentials(value: Any) -> bool | None:
    """Decide by the theorem of Lindemann and Weierstrass; None where it does not apply."""
    try:
        terms = numerator_terms(value)
    except TooLong:
        return None
    if not terms:
        return True
    root = next((r for t in terms for r in t.roots), None)
    if root is not None:
        return _by_conjugate(terms, root) if root.order == 2 else None
    # A relation among other constants (pi, logarithms) may still hide in the coefficients.
    if any(not t.exponent.is_algebraic or separation_bits(t.coefficient) is None for t in terms):
        return None
    merged: list[tuple[Any, Any]] = []
    for term in terms:
        for i, (known, total) in enumerate(merged):
            if is_zero(term.exponent - known):
                merged[i] = (known, total + term.coefficient)
                break
        else:
            merged.append((term.exponent, term.coefficient))
    return all(is_zero(c) for _, c in merged)


def _by_conjugate(terms: list[Term], root: Root) -> bool | None:
    """Decide a + b sqrt(B) by (a + b sqrt(B)) (a - b sqrt(B)) = a^2 - b^2 B."""
    a, b = (
        sp.Add(*(t.without(root) for t in terms if (root in t.roots) == there))
        for there in (False, True)
    )
    if not _excludes_zero(a - b * sp.sqrt(root.base), FIRST_BITS[-1]):
        return None
    try:
        return is_zero(a**2 - b**2 * root.base)
    except ComputationError:
        return None


def _vanishes_identically(value: Any) -> bool:
    expanded = sp.expand(value)
    if expanded == 0:
        return True
    symbols = sorted(expanded.free_symbols, key=str)
    for shift in range(2):
        place = {s: _SAMPLES[(i + shift) % 3] + i for i, s in enumerate(symbols)}
        sample = expanded.xreplace(place)
        if not sample.has(sp.zoo, sp.nan, sp.oo) and _excludes_zero(sample, FIRST_BITS[-1]):
            return False
    try:
        if not numerator_terms(expanded):
            return True
    except TooLong:
        pass
    return bool(sp.simplify(expanded) == 0)


def _is_short(value: Any) -> bool:
    return size_of(value, LONGEST_SIMPLIFIED) <= LONGEST_SIMPLIFIED


def _shown(value: Any) -> str:
    text = str(value) if _is_short(value) else "of the computation"
    return text if len(text) <= 80 else text[:77] + "..."


def _bound(value: Any) -> str:
    found = enclose(value, LATER_BITS[-1])
    if found is None:
        return "any size that could be told"
    size = max(max(-p.lower, p.upper) for p in found)
    return f"10^{-int((size.denominator // max(size.numerator, 1)).bit_length() * 0.30103)}"
