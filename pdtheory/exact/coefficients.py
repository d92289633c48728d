"""Coefficients: exact numbers and expressions, and bounds on the order."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any, Final

import numpy as np
import sympy as sp

from pdtheory.errors import InputError

#: Largest order of a form; a longer row would not be an answer that anyone could read.
MAX_ORDER: Final = 256


def check_order(order: int, least: int = 0) -> int:
    """Return the order if it is an integer within the bounds.

    Raises
    ------
    InputError
        If it is below `least` or above `MAX_ORDER`.
    """
    try:
        if int(order) == order and least <= order <= MAX_ORDER:
            return int(order)
    except (TypeError, ValueError, OverflowError):
        pass
    raise InputError(f"The order is {order!r}; it must be an integer from {least} to {MAX_ORDER}.")


def exact_tuple(values: Sequence[Any], count: int, what: str) -> tuple[Any, ...]:
    """Return exact coordinates, or variables, if their number is right.

    Raises
    ------
    InputError
        If it is not.
    """
    listed = tuple(values)
    if len(listed) != count:
        shown = ", ".join(str(v) for v in listed)
        raise InputError(f"The {what} needs {count} entries, but ({shown}) has {len(listed)}.")
    return tuple(exact(v) for v in listed)


def exact(value: Any) -> Any:
    """Return a number or expression as exact SymPy; a float becomes the rational that it is.

    Raises
    ------
    InputError
        If the value is not finite or is no number.
    """
    if isinstance(value, (float, np.floating)):
        if not np.isfinite(value):
            raise InputError(f"The coefficient {value} is not finite.")
        return sp.Rational(*float(value).as_integer_ratio())
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, str):
        raise InputError(f"The coefficient {value!r} is text; read it with parse_expression first.")
    try:
        expression = sp.sympify(value, strict=True)
    except (sp.SympifyError, TypeError) as error:
        raise InputError(f"The coefficient {value!r} is not a number or an expression.") from error
    if not isinstance(expression, sp.Expr):
        raise InputError(f"The coefficient {value!r} is not a number or an expression.")
    if expression.has(sp.oo, -sp.oo, sp.zoo, sp.nan):
        raise InputError(f"The coefficient {expression} is not finite.")
    if expression.has(sp.Float):
        expression = expression.replace(
            lambda e: e.is_Float, lambda e: sp.Rational(*_float_ratio(e))
        )
    return expression


def _float_ratio(value: Any) -> tuple[int, int]:
    sign, mantissa, exponent, _ = value._mpf_
    mantissa = -int(mantissa) if sign else int(mantissa)
    return (mantissa << exponent, 1) if exponent >= 0 else (mantissa, 1 << -exponent)


def as_fraction(rational: Any) -> Fraction:
    """Return a rational number of SymPy, of its domain QQ or of FLINT as a fraction."""
    return Fraction(int(rational.numerator), int(rational.denominator))


def tidy(value: Any) -> Any:
    """Return an exact expression expanded, so that equal coefficients look alike.

    Denominators and roots that are sums of transcendental numbers stay as they are: their powers
    would fill pages.
    """
    if value.is_Rational:
        return value
    hidden = {e: sp.Dummy() for e in value.atoms(sp.Pow) if _is_long_power(e)}
    if not hidden:
        return sp.expand(value)
    back = {dummy: e for e, dummy in hidden.items()}
    return sp.expand(value.xreplace(hidden)).xreplace(back)


def _is_long_power(power: Any) -> bool:
    plain = power.exp.is_Integer and power.exp > 0
    return bool(power.base.is_Add and not plain and not power.base.is_algebraic)
