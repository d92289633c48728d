"""Real E-eigenpairs: exact values, proved counts, kinds, multiplicities, statuses."""

from fractions import Fraction

import mpmath
import numpy as np
import pytest
import sympy as sp
from hypothesis import assume, given

from pdtheory.conventions import Kind
from pdtheory.errors import InputError
from pdtheory.exact import BinaryForm, RealAlgebraic, WavejetsRow, real_eigenpairs
from pdtheory.exact.enclosing import enclose_real
from pdtheory.testing.profiles import examples
from pdtheory.testing.strategies import any_forms, forms, forms_with_repeated_roots

x, y, t = sp.symbols("x y t")


def value_at(form, pair, digits=60):
    """Return f(v) by mpmath from the angle alone."""
    with mpmath.workdps(digits):
        angle = mpmath.mpf(str(pair.angle_degrees(digits + 5))) * mpmath.pi / 180
        c, s = mpmath.cos(angle), mpmath.sin(angle)
        return sum(
            mpmath.mpf(int(a.p)) / int(a.q) * c ** (form.order - j) * s**j
            for j, a in enumerate(form.coefficients)
        )


def test_monkey_saddle():
    pairs = real_eigenpairs(BinaryForm([6, 0, -18, 0]))
    half, root = sp.Rational(1, 2), sp.sqrt(3) / 2
    assert pairs.status == "ok"
    assert [p.vector for p in pairs] == [
        (1, 0), (half, root), (-half, root), (-1, 0), (-half, -root), (half, -root),
    ]  # fmt: skip
    assert [p.eigenvalue for p in pairs] == [6, -6, 6, -6, 6, -6]
    assert [p.kind.label for p in pairs] == ["max", "min"] * 3
    assert [float(p.angle_degrees()) for p in pairs] == [0, 60, 120, 180, 240, 300]
    assert all(p.multiplicity == 1 for p in pairs)
    assert pairs[1].exact_text == "v = (1/2, sqrt(3)/2), lambda = -6"


def test_inflection_is_neither_maximum_nor_minimum():
    pairs = real_eigenpairs(BinaryForm([0, 0, 0, 1]))
    assert [(float(p.angle_degrees()), p.kind, p.multiplicity, p.eigenvalue) for p in pairs] == [
        (0, Kind.INFLECTION, 2, 0),
        (90, Kind.MAXIMUM, 1, 1),
        (180, Kind.INFLECTION, 2, 0),
        (270, Kind.MINIMUM, 1, -1),
    ]


def test_algebraic_coefficients():
    # (x + sqrt(2) y)^2: lambda = 3 along (1, sqrt 2), and 0 along (sqrt 2, -1).
    root = sp.sqrt(2)
    pairs = real_eigenpairs(BinaryForm([1, 2 * root, 2]))
    assert len(pairs) == 4
    top, flat = pairs[0], pairs[1]
    assert (top.eigenvalue, top.kind, top.t) == (3, Kind.MAXIMUM, root)
    assert (flat.eigenvalue, flat.kind, flat.t) == (0, Kind.MINIMUM, -root / 2)
    # A repeated factor over Q(sqrt 2) is found exactly.
    double = BinaryForm.from_expression(sp.expand((x - root * y) ** 3 * (x + y)), (x, y))
    multiple = [p for p in real_eigenpairs(double) if p.multiplicity > 1]
    assert [(p.multiplicity, p.eigenvalue, p.kind) for p in multiple] == [
        (2, 0, Kind.INFLECTION),
        (2, 0, Kind.INFLECTION),
    ]


def test_algebraic_agrees_with_rational_after_scaling():
    # y -> sqrt(2) y is not a rotation, but multiplying the form by sqrt(3) keeps the directions.
    form = BinaryForm([1, -2, 3, 5, -1])
    for p, q in zip(form.eigenpairs(), (form * sp.sqrt(3)).eigenpairs(), strict=True):
        assert p.tangent == q.tangent
        assert p.kind == q.kind
        assert abs(q.eigenvalue_float(30) - sp.N(sp.sqrt(3), 40) * p.eigenvalue_float(40)) < 1e-27


@pytest.mark.parametrize("k", [1, 2, 3, 5, 8, 12])
def test_saddles_have_all_their_directions(k):
    pairs = WavejetsRow(k, {k: sp.Rational(1, 2)}).eigenpairs()
    assert len(pairs) == 2 * k
    for j, p in enumerate(pairs):
        assert abs(p.angle_degrees(20) - sp.Rational(180 * j, k)) < 1e-15
        assert abs(p.eigenvalue_float(20) - (-1) ** j * sp.factorial(k)) < 1e-9
        assert p.kind == (-1) ** j


def test_isotropic_and_vanishing_are_statuses():
    sphere = BinaryForm([1, 0, 2, 0, 1]) * 3
    assert (sphere.eigenpairs().status, sphere.eigenpairs().isotropic_eigenvalue) == (
        "isotropic",
        3,
    )
    zero = BinaryForm([0, 0, 0])
    assert (zero.eigenpairs().status, len(zero.eigenpairs())) == ("vanishing", 0)
    root = sp.sqrt(2)
    hidden = BinaryForm([(1 + root) ** 2 - 2 * root - 3, 0, 0])
    assert hidden.eigenpairs().status == "vanishing"


@examples
@given(any_forms(max_order=12))
def test_certified_against_sympy(form):
    """The number and multiplicity of directions by SymPy's own Sturm sequences."""
    pairs = real_eigenpairs(form)
    assume(pairs.status == "ok")
    derivative = sum(c * t**j for j, c in enumerate(form.angular_derivative().coefficients))
    poly = sp.Poly(derivative, t)
    parts = poly.sqf_list()[1]
    expected = sorted(m for part, m in parts for _ in range(part.count_roots()))
    if form.order > poly.degree():
        expected = sorted([*expected, form.order - poly.degree()])
    assert sorted(p.multiplicity for p in pairs) == sorted(expected * 2)
    assert sum(expected) <= form.order
    assert len(pairs.maxima) == len(pairs.minima)
    angles = [p.angle_enclosure() for p in pairs]
    assert all(a.lower >= 0 and a.upper < 360 for a in angles)


@examples
@given(any_forms(max_order=16))
def test_pairs_satisfy_the_definition_at_fifty_digits(form):
    """T v^(k-1) = lambda v and |v| = 1, with mpmath, and the kind by the sign of derivatives."""
    pairs = real_eigenpairs(form)
    with mpmath.workdps(50):
        scale = max(abs(mpmath.mpf(int(c.p)) / int(c.q)) for c in form.coefficients)
        for p in pairs:
            angle = mpmath.mpf(str(p.angle_degrees(60))) * mpmath.pi / 180
            v = mpmath.cos(angle), mpmath.sin(angle)
            value = mpmath.mpf(str(p.eigenvalue_float(60)))
            for part, component in zip(form.gradient(), v, strict=True):
                total = sum(
                    mpmath.mpf(int(c.p)) / int(c.q) * v[0] ** (form.order - 1 - j) * v[1] ** j
                    for j, c in enumerate(part.coefficients)
                )
                defect = total / form.order - value * component
                assert abs(defect) < mpmath.mpf(10) ** -40 * scale * 2**form.order


@examples
@given(any_forms(max_order=10))
def test_kind_by_the_first_derivative_that_does_not_vanish(form):
    pairs = real_eigenpairs(form)
    for p in pairs:
        derivative = form
        for order in range(1, form.order + 3):
            derivative = derivative.angular_derivative()
            if order == p.multiplicity + 1:
                break
        # Coefficients differ by up to 10^80 here, to the power of the multiplicity.
        value = value_at(derivative, p, digits=1000)
        if p.multiplicity % 2 == 0:
            assert p.kind == Kind.INFLECTION
        else:
            assert p.kind == -int(mpmath.sign(value))


@examples
@given(forms_with_repeated_roots(max_order=10))
def test_vanishing_eigenvalues_are_exact_zeros(form):
    for p in real_eigenpairs(form):
        scale = max(abs(c) for c in form.coefficients)
        assert p.vanishing == (abs(value_at(form, p)) < 1e-40 * float(scale))
        assert (float(p.eigenvalue_float()) == 0) == p.vanishing


@examples
@given(forms(min_order=1, max_order=6))
def test_exact_values_are_the_enclosed_ones(form):
    for p in real_eigenpairs(form):
        assert abs(sp.N(p.eigenvalue, 40) - p.eigenvalue_float(40)) < 1e-30 * (
            1 + abs(p.eigenvalue_float(40))
        )
        c, s = (sp.N(e, 40) for e in p.vector)
        assert abs(c**2 + s**2 - 1) < 1e-35
        assert p.unit_vector() == pytest.approx((float(c), float(s)), abs=1e-15)
        angle = p.angle_degrees(40) * sp.N(sp.pi, 50) / 180
        assert abs(sp.cos(angle) - c) + abs(sp.sin(angle) - s) < 1e-33


@examples
@given(forms(min_order=1, max_order=16))
def test_parity(form):
    pairs = list(real_eigenpairs(form))
    half = len(pairs) // 2
    sign = (-1) ** form.order
    for p, q in zip(pairs[:half], pairs[half:], strict=True):
        assert float(q.angle_degrees()) == pytest.approx(float(p.angle_degrees()) + 180)
        assert q.kind == sign * p.kind
        assert float(q.eigenvalue_float()) == pytest.approx(sign * float(p.eigenvalue_float()))


def test_a_thousand_digits():
    pair = real_eigenpairs(BinaryForm([1, 2, 1, 3]))[0]
    enclosure = pair.angle_enclosure(1000)
    assert enclosure.width < 1e-300
    assert enclosure.width * 10**1000 <= 360
    with mpmath.workdps(1020):
        tangent = mpmath.findroot(lambda s: s**3 - 5 * s**2 + s - 2, 4.879)
        angle = mpmath.degrees(mpmath.atan(tangent))
        assert abs(angle - mpmath.mpf(str(pair.angle_degrees(1010)))) < mpmath.mpf(10) ** -1000
    assert pair.eigenvalue_enclosure(1000).width * 10**1000 <= 4


def test_close_directions_are_told_apart():
    # g' = sin(t) (sin t cos e - cos t sin e) ... : two directions 1e-40 apart in tangent.
    tiny = sp.Rational(1, 10**40)
    form = BinaryForm([0, 0, 1, 0]) + BinaryForm([tiny, 0, 0, 0])
    counted = len(real_eigenpairs(form))
    poly = sp.Poly(sum(c * t**j for j, c in enumerate(form.angular_derivative().coefficients)), t)
    assert counted == 2 * (poly.count_roots() + 3 - poly.degree())


def test_latex_for_notebooks():
    assert r"\frac{\sqrt{3}}{2}" in real_eigenpairs(BinaryForm([6, 0, -18, 0]))._repr_latex_()
    assert "isotropic" in real_eigenpairs(BinaryForm([1, 0, 1]))._repr_latex_()


def test_de_lathauwer_2000():
    entries = [sp.Rational(s) for s in ("1.5578", "-2.4443", "-1.0982", "1.1226")]
    form = BinaryForm([entries[0], 3 * entries[1], 3 * entries[2], entries[3]])
    pairs = form.eigenpairs()
    best = max(pairs, key=lambda p: float(p.eigenvalue_float()))
    assert float(best.eigenvalue_float()) == pytest.approx(3.1155, abs=5e-5)
    assert [float(c) for c in best.vector] == pytest.approx([0.9264, -0.3764], abs=1e-4)
    values = sorted(abs(float(p.eigenvalue_float())) for p in pairs)
    assert values[::2] == pytest.approx([1.4020, 2.8311, 3.1155], abs=1e-4)


def test_numbers_of_thousands_of_digits_are_not_factored():
    """SymPy's square root of such a number takes minutes, and Python does not write it."""
    pairs = BinaryForm([10**5000, 0, 0, 1]).eigenpairs()
    assert [p.multiplicity for p in pairs] == [1] * 6
    texts = [p.exact_text for p in pairs]
    assert texts[0].startswith("v = (1, 0), lambda = a number in [10")
    assert texts[1].startswith("tan(theta) = a number in [1")
    assert "lambda = the root of an irreducible polynomial of degree 2 in [0." in texts[1]
    with mpmath.workdps(50):
        # tan(theta) = 10^5000: all but vertical, where f = y^3.
        assert mpmath.almosteq(mpmath.mpf(pairs[1].eigenvalue_float(40)), 1)


def test_radicals_of_nearly_the_longest_text_are_found():
    # sqrt(a) + sqrt(b) has a minimal polynomial of about twice the digits of a and b.
    a, b = 10**15 + 37, 10**15 + 91
    number = RealAlgebraic.select(
        ((a - b) ** 2, 0, -2 * (a + b), 0, 1),
        lambda bits: enclose_real(sp.sqrt(a) + sp.sqrt(b), bits),
    )
    assert number.is_short
    assert sp.expand(number.radical - sp.sqrt(a) - sp.sqrt(b)) == 0
    fraction = sp.Rational(10**19 + 51, 10**19 + 57)
    assert RealAlgebraic.rational(Fraction(fraction.p, fraction.q)).text() == str(fraction)


@pytest.mark.parametrize("scale", [sp.pi, sp.E * 2, sp.log(2)])
def test_a_common_factor_is_multiplied_out(scale):
    texts = [p.eigenvalue_text() for p in BinaryForm([scale, 0, 0]).eigenpairs()]
    assert texts == [str(scale), "0", str(scale), "0"]
    # Where the other factor is no short number the two stand side by side.
    quartic = BinaryForm([scale, 0, 0, scale, 0]).eigenpairs()
    assert f"{scale} times the root of" in quartic[1].eigenvalue_text()


@pytest.mark.parametrize("d", [3, 4, 5, 6, 7])
def test_sum_of_two_powers(d):
    values = {p.eigenvalue for p in BinaryForm([1] + [0] * (d - 1) + [1]).eigenpairs()}
    magnitudes = {sp.nsimplify(abs(v)) for v in values}
    expected = {sp.Integer(1), sp.sqrt(2) ** (2 - d)}
    assert {sp.radsimp(m) for m in magnitudes} == {sp.radsimp(m) for m in expected}


@pytest.mark.parametrize(
    ("form", "message"),
    [
        (lambda: BinaryForm([1]), "order is 0"),
        (lambda: BinaryForm([sp.Symbol("a"), 1]), "depends on a"),
        (lambda: BinaryForm([sp.I, 1]), "not real"),
        (lambda: BinaryForm([sp.sqrt(-2), 1]), "not real"),
    ],
)
def test_bad_input(form, message):
    with pytest.raises(InputError, match=message):
        real_eigenpairs(form())


def test_against_numpy_companion_roots():
    rng = np.random.default_rng(7)
    for _ in range(30):
        form = BinaryForm([int(c) for c in rng.integers(-50, 50, 8)])
        coefficients = [float(c) for c in form.angular_derivative().coefficients]
        roots = np.roots(coefficients[::-1])
        real = np.sort(roots[abs(roots.imag) < 1e-9 * (1 + abs(roots))].real)
        own = np.sort([float(p.t) for p in list(form.eigenpairs())[: len(form.eigenpairs()) // 2]])
        assert own == pytest.approx(real, rel=1e-7)
