"""Zero decisions: identities that are hidden, near misses, and what nobody can decide."""

import mpmath
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from pdtheory.errors import ComputationError
from pdtheory.exact import BinaryForm, enclosing, taylor_forms
from pdtheory.exact.enclosing import enclose, nearest_double
from pdtheory.exact.named import NamedConstant
from pdtheory.exact.separation import separation_bits
from pdtheory.exact.zeros import is_zero
from pdtheory.testing.profiles import examples

half, third = sp.Rational(1, 2), sp.Rational(1, 3)
a, x, y = sp.symbols("a x y")

ZEROS = [
    sp.cosh(1) ** 2 - sp.sinh(1) ** 2 - 1,
    # Identities that simplification misses.
    sp.tanh(half) - (sp.E - 1) / (sp.E + 1),
    sp.exp(half) * sp.cosh(half) - (sp.E + 1) / 2,
    sp.tan(half) - sp.sin(1) / (1 + sp.cos(1)),
    sp.tanh(third) * (3 + sp.tanh(third) ** 2) / (1 + 3 * sp.tanh(third) ** 2) - sp.tanh(1),
    sp.cos(sp.pi / 7) - sp.cos(2 * sp.pi / 7) + sp.cos(3 * sp.pi / 7) - half,
    # Powers of exponentials that are written apart.
    NamedConstant("c", sp.E) ** 2 - NamedConstant("d", sp.exp(2)),
    NamedConstant("c", sp.exp(half)) ** 2 - sp.E,
    # Roots of exponentials, also below each other.
    NamedConstant("r", sp.sqrt(1 + sp.E)) ** 2 - sp.E - 1,
    1 / sp.sqrt(1 + sp.tanh(1) ** 2) - sp.sqrt(1 + sp.tanh(1) ** 2) / (1 + sp.tanh(1) ** 2),
    sp.sqrt(sp.exp(2) + 2 + sp.exp(-2)) - sp.E - sp.exp(-1),
    sp.sin(sp.sqrt(2) + 1) - sp.sin(sp.sqrt(2)) * sp.cos(1) - sp.cos(sp.sqrt(2)) * sp.sin(1),
    sp.sqrt(5 + 2 * sp.sqrt(6)) - sp.sqrt(2) - sp.sqrt(3),
    sp.CRootOf(x**5 - x - 1, 0) ** 5 - sp.CRootOf(x**5 - x - 1, 0) - 1,
    sp.log(6) - sp.log(2) - sp.log(3),
    sp.cosh(a) ** 2 - sp.sinh(a) ** 2 - 1,
    sp.tanh(a / 2) - (sp.exp(a) - 1) / (sp.exp(a) + 1),
]
NEAR = [
    sp.exp(-100) / 10**50,
    sp.cosh(40) - sp.sinh(40),
    sp.exp(sp.pi * sp.sqrt(163)) - 262537412640768744,
    sp.cosh(1) ** 2 - sp.sinh(1) ** 2 - 1 + sp.exp(-900),
    sp.sqrt(2) + sp.sqrt(3) - sp.Rational(str(sp.N(sp.sqrt(2) + sp.sqrt(3), 200))),
    sp.cosh(a) ** 2 - sp.sinh(a) ** 2 - 1 + sp.Rational(1, 10**30),
]


@pytest.mark.parametrize("value", ZEROS, ids=str)
def test_zero_is_proved(value):
    assert is_zero(value)


@pytest.mark.parametrize("value", NEAR, ids=str)
def test_a_near_miss_is_no_zero(value):
    assert not is_zero(value)


@pytest.mark.parametrize(
    "value",
    [
        4 * sp.atan(sp.Rational(1, 5)) - sp.atan(sp.Rational(1, 239)) - sp.pi / 4,
        sp.log(sp.E + 1) + sp.log(sp.E - 1) - sp.log(sp.exp(2) - 1),
    ],
)
def test_what_cannot_be_proved_is_refused(value):
    with pytest.raises(ComputationError, match="could not be proved"):
        is_zero(value)


roots = st.builds(
    lambda p, q, r: sp.Rational(p, q) * sp.root(abs(r) + 1, 2 + r % 3),
    st.integers(-9, 9),
    st.integers(1, 9),
    st.integers(-9, 9),
)


@examples
@given(st.lists(roots, min_size=2, max_size=3), st.lists(roots, min_size=1, max_size=2))
def test_the_separation_bound_holds(first, second):
    """What is not zero is larger than its bound, and (a + b)^2 - a^2 - 2ab - b^2 is zero."""
    value = sp.Add(*first) / (1 + sp.Add(*second) ** 2)
    bits = separation_bits(value)
    if value != 0:
        size = abs(sp.N(value, 60, maxn=4000))
        assert size == 0 or size > sp.Float(2) ** -bits
    p, q = NamedConstant("p", sp.Add(*first)).definition, sp.Add(*second)
    hidden = sp.Pow(p + q, 2, evaluate=False) - p**2 - 2 * p * q - q**2
    assert is_zero(hidden)


@pytest.mark.parametrize(
    "value",
    [sp.atanh(half), sp.asin(third) + sp.acos(third), sp.erf(1), sp.cbrt(-2 + sp.pi), sp.log(3),
     sp.gamma(third), sp.asinh(2) * sp.acosh(3), sp.cot(1) * sp.coth(1), sp.E**sp.sqrt(2)],
)  # fmt: skip
def test_enclosures_hold_the_number(value):
    with mpmath.workdps(80):
        found = enclose(value, 200)
        expected = mpmath.mpmathify(sp.N(value, 80))
        lower, upper = (mpmath.mpf(e.numerator) / e.denominator for e in found.real)
        assert lower <= expected <= upper
        assert upper - lower < mpmath.mpf(10) ** -50
    assert nearest_double(value) == float(sp.N(value, 40))


def test_a_constant_without_a_value_is_refused():
    hidden = sp.cosh(1) ** 2 - sp.sinh(1) ** 2 - 1
    with pytest.raises(ComputationError, match="could not be enclosed"):
        enclosing.enclose_real(1 / hidden, 128)
    with pytest.raises(Exception, match="no finite value"):
        taylor_forms(x / hidden + y, (x, y), 2)


def test_hidden_zeros_do_not_reach_the_coefficients():
    # sin(2 u) = 2 sin u cos u, sinh + cosh = exp and tan(u/2) = sin u / (1 + cos u), at u = 1.
    f = (
        sp.sin(2 * x) - 2 * sp.sin(x) * sp.cos(x)
        + y * (sp.sinh(x) + sp.cosh(x) - sp.exp(x))
        + y**2 * (sp.tan(x / 2) - sp.sin(x) / (1 + sp.cos(x)))
        + y**3
    )  # fmt: skip
    forms = taylor_forms(f, (x, y), 5, (1, 0))
    assert [f.coefficients for f in forms] == [
        (0,), (0, 0), (0, 0, 0), (0, 0, 0, 6), (0,) * 5, (0,) * 6,
    ]  # fmt: skip
    assert BinaryForm([1, ZEROS[1], 0, 0]) == BinaryForm([1, 0, 0, 0])
