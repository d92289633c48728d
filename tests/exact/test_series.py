"""Taylor terms of expressions against SymPy's own derivatives."""

import pytest
import sympy as sp

from pdtheory.errors import ExpressionError, InputError
from pdtheory.exact import differential_tensor, parse_expression, taylor_forms

x, y, a, b = sp.symbols("x y a b")


@pytest.mark.parametrize(
    ("f", "at"),
    [
        (x**3 - 3 * x * y**2, (0, 0)),
        (x**3 - 3 * x * y**2, (sp.Rational(1, 2), -3)),
        (sp.sqrt(1 - x**2 - y**2), (sp.Rational(1, 2), sp.Rational(1, 3))),
        (sp.exp(x) * sp.sin(y + x**2), (1, sp.pi / 3)),
        (sp.tan(x + y) * sp.atan(x - 2 * y + 1), (0, 0)),
        (sp.asin(x + y + sp.Rational(1, 3)), (0, 0)),
        (sp.log(1 + a * x + b * y**2), (0, 0)),
        ((x + sp.sqrt(2) * y) ** 5 / (1 + x), (sp.sqrt(3), 0)),
        (2**x * sp.cosh(y), (0, 0)),
        (sp.asinh(x) * sp.tanh(y + 1), (0, 0)),
        (sp.cbrt(x + 8) / (y - 3), (0, 1)),
        (sp.erf(x * y + x), (0, 0)),
    ],
)
def test_terms_are_the_partial_derivatives(f, at):
    for k, form in enumerate(taylor_forms(f, (x, y), 4, at)):
        for j, component in enumerate(form.tensor.components):
            expected = sp.diff(f, x, k - j, y, j) if k else f
            expected = expected.subs({x: at[0], y: at[1]})
            assert sp.simplify(component - expected) == 0


def test_differential_tensor():
    assert differential_tensor(x**3 - 3 * x * y**2, (x, y), 3).components == (6, 0, -6, 0)
    assert differential_tensor(x**3, (x, y), 5).is_zero
    u, v = sp.symbols("u v")
    assert differential_tensor(u * v, (u, v), 2, at=(5, 7)).components == (0, 1, 0)


def test_a_large_power_is_not_expanded():
    term = taylor_forms((x + y + 1) ** 200, (x, y), 3)[3]
    assert term.coefficients[0] == 200 * 199 * 198


@pytest.mark.parametrize("text", ["sqrt(x)", "log(x)", "1/x", "sqrt(x**2 + y**2)", "acos(1 + x)"])
def test_not_smooth_at_the_point(text):
    with pytest.raises(ExpressionError, match="no derivative of order"):
        differential_tensor(parse_expression(text), (x, y), 3)


def test_bad_orders():
    for order in (-1, 10_000, 1.5):
        with pytest.raises(InputError, match=str(order)):
            differential_tensor(x, (x, y), order)
    with pytest.raises(InputError, match="Two variables"):
        differential_tensor(x, (x,), 2)
