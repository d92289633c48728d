"""Exact results as plain data for JSON."""

from __future__ import annotations

from collections.abc import Iterable
from math import inf, isfinite
from typing import Any

import sympy as sp

from pdtheory.errors import ComputationError, InputError
from pdtheory.exact.characteristic import characteristic_polynomial
from pdtheory.exact.coefficients import MAX_ORDER, check_order
from pdtheory.exact.complexpairs import complex_eigenpairs
from pdtheory.exact.constantroots import RealConstant
from pdtheory.exact.eigenpairs import EigenPairs, real_eigenpairs
from pdtheory.exact.enclosing import nearest_double
from pdtheory.exact.faces import BinaryForm, Face
from pdtheory.exact.realnumber import to_float
from pdtheory.exact.taylor import taylor_forms
from pdtheory.exact.texts import text_within
from pdtheory.exact.zeros import is_zero


def degree_bound(expression: Any, variables: Iterable[Any]) -> int | None:
    """Return an upper bound on the total degree of a polynomial, None if it is no polynomial.

    Nothing is expanded, so a large power costs nothing.
    """
    symbols = set(variables)
    if not expression.free_symbols & symbols:
        return 0
    if expression in symbols:
        return 1
    parts = [degree_bound(a, symbols) for a in expression.args]
    if expression.is_Add or expression.is_Mul:
        known = [d for d in parts if d is not None]
        if len(known) < len(parts):
            return None
        return max(known) if expression.is_Add else sum(known)
    if expression.is_Pow and expression.exp.is_Integer and expression.exp > 0:
        return None if parts[0] is None else parts[0] * int(expression.exp)
    return None


def orders_of(
    expression: Any,
    variables: tuple[Any, Any],
    *,
    order: int | None = None,
    max_order: int = 8,
    at: tuple[Any, Any] = (0, 0),
) -> list[BinaryForm]:
    """Return the forms to report: one order, or every order k >= 1 that does not vanish.

    Parameters
    ----------
    expression
        The function of two variables.
    variables
        The variables.
    order
        The one order asked for; None for all, up to the degree of a polynomial.
    max_order
        Largest order for expressions that are no polynomials.
    at
        The point of expansion.

    Raises
    ------
    InputError
        If every order from 1 on vanishes, or an order is out of bounds.
    """
    if order is not None:
        check_order(order, 1)
        return [taylor_forms(expression, variables, order, at)[order]]
    bound = degree_bound(expression, variables)
    if bound is not None and bound > MAX_ORDER:
        raise InputError(
            f"The polynomial has degree up to {bound}; all orders are listed up to {MAX_ORDER}, "
            "so ask for one order."
        )
    if bound is None and max_order < 1:
        raise InputError(f"The largest order is {max_order}; it must be at least 1.")
    degree = max_order if bound is None else bound
    forms = [f for f in taylor_forms(expression, variables, degree, at)[1:] if not f.is_zero]
    if not forms:
        raise InputError(
            f"Every order from 1 to {max(degree, 1)} of {expression} vanishes at "
            f"({at[0]}, {at[1]}), so there are no directions to list."
        )
    return forms


def order_report(pairs: EigenPairs, *, rounded: bool = False) -> dict[str, Any]:
    """Return one order as plain data: Wavejets row, pairs and status.

    Parameters
    ----------
    pairs
        The pairs of the order.
    rounded
        True if the row was rounded before, so that exact forms of its pairs would say nothing:
        ``exact`` gives enclosures then.
    """
    row = pairs.form.row
    return {
        "wavejets": {str(n): [_double(re), _double(im)] for n, (re, im) in row.parts.items()},
        "pairs": [
            {
                "angle_deg": float(p.angle_degrees(17)),
                "eigenvalue": _double(p.eigenvalue_float(17)),
                "kind": p.kind.label,
                "multiplicity": p.multiplicity,
                "exact": p.enclosure_text() if rounded else p.exact_text,
            }
            for p in pairs
        ],
        "status": pairs.status,
    }


def _double(value: Any) -> float:
    """Return a real number, exact or a SymPy float, in double precision.

    Raises
    ------
    ComputationError
        If it is beyond the range of doubles, as an eigenvalue of high order may be.
    """
    try:
        number = float(value) if value.is_Float else nearest_double(value)
    except OverflowError:
        number = inf
    if not isfinite(number):
        raise ComputationError(
            f"The number {short_number(value)} is beyond double precision; ask for the table, "
            "which has any range, or for a lower order."
        )
    return number


def report(faces: Iterable[Face]) -> dict[str, Any]:
    """Return several orders as plain data, keyed by order."""
    return {"orders": {str(f.order): order_report(real_eigenpairs(f)) for f in faces}}


def complex_report(face: Face) -> dict[str, Any]:
    """Return the complex E-eigenpairs of one order as plain data, [re, im] for every number."""
    pairs = complex_eigenpairs(face)
    return {
        "classes": [
            {
                "vector": [_split(c) for c in p.vector(17)],
                "eigenvalue": _split(p.eigenvalue(17)),
                "real": p.is_real,
                "multiplicity": p.multiplicity,
            }
            for p in pairs
        ],
        "isotropic_multiplicity": pairs.isotropic_multiplicity,
    }


def _split(value: Any) -> list[float]:
    real, imaginary = value.as_real_imag()
    return [_double(real), _double(imaginary)]


def characteristic_report(face: Face) -> dict[str, Any]:
    """Return the E-characteristic polynomial of one order as plain data."""
    psi = characteristic_polynomial(face)
    return {
        "polynomial": sp.sstr(psi.polynomial.as_expr()),
        "factors": [[sp.sstr(p.as_expr()), m] for p, m in psi.factors()],
        "irregular": psi.is_irregular,
    }


def latex_pairs(pairs: EigenPairs, digits: int = 12) -> str:
    """Return the real E-eigenpairs of one order as a LaTeX array.

    Parameters
    ----------
    pairs
        The pairs of the order.
    digits
        Significant digits of the angles and of what has no short exact form.
    """
    if pairs.status != "ok":
        return rf"\[ \text{{order {pairs.order}: {pairs.status}}} \]"
    rows = []
    for p in pairs:
        angle = _decimal_latex(p.angle_degrees(digits)) + r"^\circ"
        if p.tangent is None or p.tangent.is_short:
            vector = ", ".join(sp.latex(c) for c in p.vector)
        else:
            vector = rf"\cos {angle}, \sin {angle}"
        value = (
            sp.latex(p.eigenvalue)
            if p.eigenvalue_number.is_short
            else _decimal_latex(p.eigenvalue_float(digits))
        )
        kind = rf"\text{{{p.kind.label}}}"
        rows.append(rf"  {angle} & ({vector}) & {value} & {kind} & {p.multiplicity} \\")
    head = r"  \theta & v & \lambda & \text{kind} & \text{mult.} \\ \hline"
    body = "\n".join(rows)
    return f"\\[ \\begin{{array}}{{rcccc}}\n{head}\n{body}\n\\end{{array}} \\]"


def decimal_text(value: Any) -> str:
    """Return a SymPy float in decimals, without zeros at the end that say nothing."""
    mantissa, exponent, power = str(value).partition("e")
    if "." in mantissa:
        mantissa = mantissa.rstrip("0").rstrip(".")
    return mantissa + exponent + power


def _decimal_latex(value: Any) -> str:
    mantissa, exponent, power = decimal_text(value).partition("e")
    return rf"{mantissa} \cdot 10^{{{int(power)}}}" if exponent else mantissa


def short_form(form: BinaryForm, length: int = 60) -> str:
    """Return the text of a form; where too long, with rounded coefficients, and then cut."""
    text = text_within(form.expression, length)
    if not text:
        near = BinaryForm([0] * (form.order + 1))
        near.coefficients = tuple(_rounded(c) for c in form.coefficients)
        text = str(sp.sstr(near.expression))
    return text if len(text) <= length else text[: length - 3] + "..."


def short_number(real: Any, imaginary: Any = sp.S.Zero, length: int = 40) -> str:
    """Return the text of a complex number; where too long, that of the rounded one."""
    return text_within(real + sp.I * imaginary, length) or str(
        sp.sstr(_rounded(real) + sp.I * _rounded(imaginary))
    )


def _rounded(value: Any, digits: int = 6) -> Any:
    if value.is_Integer and abs(value) < 10**digits:
        return value
    if is_zero(value):
        return sp.Integer(0)
    return to_float(RealConstant(value).enclosure, digits)
