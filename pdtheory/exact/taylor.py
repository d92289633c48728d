"""Taylor expansions of any expression, exactly and to any degree.

The expression tree is walked once with truncated power series instead of numbers. The constants
that appear on the way (function values at the point) are collected first, so that all arithmetic is
done in one field or ring (`fields`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from pdtheory.errors import InputError
from pdtheory.exact.coefficients import check_order, exact
from pdtheory.exact.expansion import Expansion
from pdtheory.exact.faces import BinaryForm
from pdtheory.exact.fields import Field
from pdtheory.exact.powerseries import Series
from pdtheory.exact.tensor import SymmetricTensor


def expand(
    expressions: Sequence[Any],
    point: Mapping[Any, Any],
    degree: int,
    *,
    constant_matters: bool = True,
) -> tuple[list[Series], Field]:
    """Return the Taylor series of some expressions about one point, and their field.

    Parameters
    ----------
    expressions
        SymPy expressions, smooth at the point.
    point
        Exact value of each variable.
    degree
        The degree K of the series.
    constant_matters
        Whether the constant terms will be used; if not, they may come out wrong.
    """
    expansions = [
        Expansion(e, point, degree, constant_matters=constant_matters) for e in expressions
    ]
    field = Field(
        (c for e in expansions for c in e.constants), ",".join(f"x{i}" for i in range(len(point)))
    )
    needed = set().union(*(e.needed for e in expansions))
    arguments = {
        symbol: field.series(degree, field.element(value if symbol in needed else 0), variable)
        for (symbol, value), variable in zip(point.items(), field.variables, strict=True)
    }
    return [e.evaluate(field, arguments) for e in expansions], field


def taylor_forms(
    f: Any, variables: Sequence[Any], degree: int, at: Sequence[Any] = (0, 0)
) -> list[BinaryForm]:
    """Return the forms T_k v^k of an expression for k = 0 to K, about a point of the plane.

    Parameters
    ----------
    f
        A SymPy expression, smooth at the point.
    variables
        The two variables (x, y).
    degree
        The largest order K.
    at
        The point, with exact coordinates.

    Raises
    ------
    ExpressionError
        If the expression is not smooth there.
    InputError
        If the degree is negative or too large, or a coordinate is no number.
    """
    degree = check_order(degree)
    if len(variables) != 2 or len(at) != 2:
        raise InputError(
            f"Two variables and a point of the plane are needed, not {variables}, {at}."
        )
    (x, y), (x0, y0) = variables, (exact(c) for c in at)
    series, field = expand([f], {x: x0, y: y0}, degree)
    return field.forms(series[0])


def differential_tensor(
    f: Any, variables: Sequence[Any], order: int, at: Sequence[Any] = (0, 0)
) -> SymmetricTensor:
    """Return the differential tensor T_k of an expression at a point (definition 4 of the paper).

    Its component t_j is the derivative d^k f / dx^(k-j) dy^j.

    Parameters
    ----------
    f
        A SymPy expression, smooth at the point.
    variables
        The two variables (x, y).
    order
        The order k.
    at
        The point, with exact coordinates; the origin by default.

    Raises
    ------
    ExpressionError
        If the expression is not smooth at the point.
    InputError
        If the order is negative or too large.

    Examples
    --------
    >>> import sympy as sp
    >>> x, y = sp.symbols("x y")
    >>> differential_tensor(x**3 - 3 * x * y**2, (x, y), 3)
    SymmetricTensor(order=3, [6, 0, -6, 0])
    """
    return taylor_forms(f, variables, order, at)[order].tensor
