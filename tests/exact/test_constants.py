"""E-eigenpairs of forms with constants as coefficients, against mpmath and closed forms."""

import mpmath
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

import synthetic_surfaces
from pdtheory.conventions import Kind
from pdtheory.errors import ComputationError, InputError
from pdtheory.exact import (
    BinaryForm,
    RealRoot,
    balls,
    characteristic_polynomial,
    complex_eigenpairs,
    count_maxima,
    explicit_jet,
    implicit_jet,
    real_eigenpairs,
    taylor_forms,
)
from pdtheory.exact.independent import Independent
from pdtheory.exact.squarefree import squarefree_parts
from pdtheory.exact.texts import text_within
from pdtheory.exact.zeros import is_zero
from pdtheory.testing.profiles import examples

x, y, z, t = sp.symbols("x y z t")
pi, e = sp.pi, sp.E
#: e once more, so that no polynomial arithmetic sees it.
HIDDEN_E = sp.sinh(1) + sp.cosh(1)
#: Zero, so that the sum of squares is not seen as 1.
HIDDEN_ZERO = sp.sin(1) ** 2 + sp.cos(1) ** 2 - 1
MACHIN = 4 * sp.atan(sp.Rational(1, 5)) - sp.atan(sp.Rational(1, 239)) - pi / 4


def form_of(expression):
    return BinaryForm.from_expression(sp.expand(expression), (x, y))


def derivative_at(form, digits):
    """The coefficients of F(1, t), constant term first, by SymPy's evaluation and mpmath."""
    a = [mpmath.mpmathify(sp.N(c, digits)) if c else mpmath.mpf(0) for c in form.coefficients]
    k = form.order
    padded = [mpmath.mpf(0), *a, mpmath.mpf(0)]
    return a, [(j + 1) * padded[j + 2] - (k - j + 1) * padded[j] for j in range(k + 1)]


def check(form, digits=50):
    """All angles, kinds and eigenvalues of simple directions, against mpmath's roots."""
    pairs = real_eigenpairs(form)
    tiny = mpmath.mpf(10) ** -digits
    with mpmath.workdps(3 * digits + 20):
        a, F = derivative_at(form, 3 * digits + 20)
        kept = list(F)
        while abs(kept[-1]) < tiny:
            kept.pop()
        roots = mpmath.polyroots(kept[::-1], maxsteps=1000, extraprec=2000)
        angles = [mpmath.degrees(mpmath.atan(r.real)) % 180 for r in roots if abs(r.imag) < tiny]
        if len(kept) < len(F):
            angles.append(mpmath.mpf(90))
        assert len(pairs) == 2 * len(angles)
        for p, expected in zip(pairs, sorted(angles) + sorted(b + 180 for b in angles),
                               strict=True):  # fmt: skip
            angle = mpmath.mpf(str(p.angle_degrees(digits + 10)))
            assert abs(angle - expected) < 1000 * tiny
            v = mpmath.cos(mpmath.radians(expected)), mpmath.sin(mpmath.radians(expected))

            def g(theta, a=a, k=form.order):
                c, s = mpmath.cos(theta), mpmath.sin(theta)
                return sum(b * c ** (k - j) * s**j for j, b in enumerate(a))

            value = sum(b * v[0] ** (form.order - j) * v[1] ** j for j, b in enumerate(a))
            assert abs(mpmath.mpf(str(p.eigenvalue_float(digits))) - value) < 10 * tiny * (
                1 + abs(value)
            )
            second = mpmath.diff(g, mpmath.radians(expected), 2)
            assert p.kind == -int(mpmath.sign(second))
            assert p.multiplicity == 1
    assert count_maxima(form) == len(pairs.maxima) == len(pairs.minima)
    return pairs


@pytest.mark.parametrize("order", [1, 2, 3, 4, 5, 6])
@pytest.mark.parametrize("f", [sp.exp(x) * sp.sin(y), sp.sin(x * y) + sp.cos(x), sp.log(x + y * y)])
def test_taylor_terms_at_general_points(f, order):
    check(taylor_forms(f, (x, y), order, (1, 1))[order])


@pytest.mark.parametrize(
    "coefficients",
    [
        [pi, e, 1, -2],
        [sp.log(2), -3, 0, sp.sqrt(2) * pi, 1],
        [1, pi, HIDDEN_ZERO],
        [HIDDEN_ZERO, pi, 0, 1],
        [sp.cbrt(2), sp.cbrt(3), sp.cbrt(5), 1],
        [sp.sqrt(1 + sp.sqrt(2 + sp.sqrt(3))), sp.root(7, 5), -1, sp.root(3, 4), sp.cbrt(10)],
        [sp.cos(j + 1) for j in range(11)],
        [sp.gamma(sp.Rational(1, 3)), sp.erf(1), -sp.besselj(0, 1), sp.EulerGamma],
    ],
    ids=str,
)
def test_against_mpmath(coefficients):
    check(BinaryForm(coefficients))


CONSTANTS = (sp.Integer(1), pi, e, sp.sin(1), sp.cos(1), sp.sqrt(2), sp.log(3))
numbers = st.builds(
    lambda c, p, q: c * sp.Rational(p, q),
    st.sampled_from(CONSTANTS),
    st.integers(-9, 9),
    st.integers(1, 5),
)
constants = st.builds(lambda a, b: a + b, numbers, numbers)


@examples
@given(st.lists(constants, min_size=2, max_size=8))
def test_number_of_directions_of_random_forms(coefficients):
    """The number of real roots of F by mpmath, which sees none of the decisions."""
    form = BinaryForm(coefficients)
    pairs = real_eigenpairs(form)
    if pairs.status != "ok" or any(p.multiplicity > 1 for p in pairs):
        return
    with mpmath.workdps(150):
        _, F = derivative_at(form, 150)
        while abs(F[-1]) < mpmath.mpf(10) ** -100:
            F.pop()
        roots = mpmath.polyroots(F[::-1], maxsteps=2000, extraprec=3000)
        real = sum(abs(r.imag) < mpmath.mpf(10) ** -40 for r in roots)
    assert len(pairs) == 2 * (real + (len(F) <= form.order))


@examples
@given(
    st.lists(constants, min_size=2, max_size=2).filter(lambda c: not is_zero(c[1])),
    st.lists(constants, min_size=1, max_size=2).filter(lambda c: not all(is_zero(a) for a in c)),
    st.integers(2, 4),
)
def test_planted_multiple_factors(line, rest, power):
    """f = (a x + b y)^m g: the line is a zero of F of multiplicity m - 1 or more."""
    other = sum(c * x ** (len(rest) - 1 - j) * y**j for j, c in enumerate(rest))
    form = form_of((line[0] * x + line[1] * y) ** power * other)
    pairs = real_eigenpairs(form)
    with mpmath.workdps(30):
        wanted = mpmath.atan(mpmath.mpmathify(sp.N(-line[0] / line[1], 30)))
        wanted = mpmath.degrees(wanted) % 180
        found = [p for p in pairs
                 if min(abs(float(p.angle_degrees()) - wanted) % 180,
                        180 - abs(float(p.angle_degrees()) - wanted) % 180) < 1e-9]  # fmt: skip
    assert len(found) == 2
    assert all(p.vanishing and p.eigenvalue == 0 for p in found)
    assert all(p.multiplicity >= power - 1 for p in found)
    assert count_maxima(form) == len(pairs.maxima)


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        # (multiplicity, kind, lambda = 0) by angle on the half circle.
        ((x - pi * y) ** 3, [(2, 0, True), (1, -1, False)]),
        ((x - pi * y) ** 2 * (x + e * y) ** 3 * (x**2 + y**2),
         [(1, 1, False), (1, -1, True), (1, 1, False), (2, 0, True)]),
        ((x - e * y) * (x - HIDDEN_E * y) * (x + pi * y),
         [(1, -1, True), (1, 1, False), (1, -1, False)]),
        ((x - e * y) ** 2 * (x - HIDDEN_E * y) ** 2,
         [(3, -1, True), (1, 1, False)]),
        ((x - e * y) ** 2 * (x - HIDDEN_E * y) * (x + pi * y) ** 2,
         [(2, 0, True), (1, -1, False), (1, 1, True), (1, -1, False)]),
        ((x - sp.sin(1) ** 2 * y) ** 2 * (x - (1 - sp.cos(1) ** 2) * y),
         [(2, 0, True), (1, -1, False)]),
        (pi * x**2 + (pi + e) * x * y + e * y**2, None),
        (pi * (x**2 + y**2) ** 2 * (x + e * y), [(1, 1, False)]),
    ],
    ids=str,
)  # fmt: skip
def test_multiplicities_are_proved(expression, expected):
    pairs = real_eigenpairs(form_of(expression))
    half = [(p.multiplicity, int(p.kind), p.vanishing) for p in pairs][: len(pairs) // 2]
    if expected is None:
        assert [m for m, _, _ in half] == [1, 1]
        return
    assert half == expected


def test_a_constant_factor_changes_no_direction():
    plain = BinaryForm([1, 2, -1, 3, 5]).eigenpairs()
    for factor in (pi, sp.sin(1), pi + e, sp.log(2) / (1 + e)):
        scaled = (BinaryForm([1, 2, -1, 3, 5]) * factor).eigenpairs()
        assert [p.tangent for p in scaled] == [p.tangent for p in plain]
        assert [p.kind for p in scaled] == [p.kind for p in plain]
        for p, q in zip(scaled, plain, strict=True):
            assert is_zero(sp.Integer(0) if p.vanishing else p.eigenvalue - factor * q.eigenvalue)


def test_a_mean_that_is_a_constant_leaves_the_directions_algebraic():
    pairs = form_of(pi * (x**2 + y**2) + x * y).eigenpairs()
    assert [p.t for p in pairs] == [1, -1, 1, -1]
    halves = (sp.Rational(1, 2), -sp.Rational(1, 2)) * 2
    assert all(is_zero(p.eigenvalue - pi - h) for p, h in zip(pairs, halves, strict=True))


def test_closed_forms():
    first, second = form_of(x + pi * y).eigenpairs()
    assert (first.t, first.eigenvalue) == (pi, sp.sqrt(1 + pi**2))
    assert is_zero(second.eigenvalue + sp.sqrt(1 + pi**2))
    pairs = form_of(sp.sin(1) * x**2 - sp.sin(1) * y**2 + 2 * sp.cos(1) * x * y).eigenpairs()
    # cos(2 theta - a) with tan a = cot 1: maxima at 45 degrees - 1/2.
    top = pairs.maxima[0]
    assert is_zero(top.t - sp.tan(pi / 4 - sp.Rational(1, 2)))
    assert is_zero(top.eigenvalue - 1)
    assert top.exact_text.startswith("tan(theta) = ")


def test_a_thousand_digits():
    """sin(x) y at (1, 1), order 3, against mpmath's own root of g' and its own sum."""
    form = taylor_forms(sp.sin(x) * y, (x, y), 3, (1, 1))[3]
    pair = real_eigenpairs(form)[0]
    assert isinstance(pair.tangent, RealRoot)
    assert pair.angle_enclosure(1000).width * 10**1000 <= 360
    with mpmath.workdps(1030):
        c, s = mpmath.cos(1), mpmath.sin(1)

        def g(theta):
            u, w = mpmath.cos(theta), mpmath.sin(theta)
            return -c * u**3 - 3 * s * u**2 * w

        def slope(theta):
            u, w = mpmath.cos(theta), mpmath.sin(theta)
            return 3 * c * u * u * w - 3 * s * (u**3 - 2 * u * w * w)

        theta = mpmath.findroot(slope, mpmath.radians(float(pair.angle_degrees())))
        assert abs(mpmath.degrees(theta) - mpmath.mpf(str(pair.angle_degrees(1010)))) < (
            mpmath.mpf(10) ** -1000
        )
        value = mpmath.mpf(str(pair.eigenvalue_float(1010)))
        assert abs(g(theta) - value) < mpmath.mpf(10) ** -1000
        # The SymPy expressions of the pair are the same numbers.
        assert abs(mpmath.mpf(str(sp.N(pair.eigenvalue, 1000))) - value) < mpmath.mpf(10) ** -995
        u, w = (mpmath.mpf(str(sp.N(k, 1000))) for k in pair.vector)
        assert abs(mpmath.atan2(w, u) - theta) < mpmath.mpf(10) ** -995


@pytest.mark.parametrize("gap", [10, 60])
def test_directions_that_are_nearly_one(gap):
    """Two zeros of f nearly coincide: lambda between them is tiny, and proved not to be zero."""
    form = form_of((x - e * y) * (x - (e + sp.Rational(1, 10**gap)) * y) * (x + pi * y))
    pairs = real_eigenpairs(form)
    assert [p.vanishing for p in pairs] == [False] * 6
    small = abs(float(sp.log(abs(pairs[0].eigenvalue_float(5)), 10)))
    assert 2 * gap < small < 2 * gap + 3


@pytest.mark.parametrize(
    "coefficients",
    [[MACHIN, 1, pi], [1, MACHIN, pi], [1 + MACHIN, 0, 1]],
    ids=["eigenvalue", "ends", "isotropic"],
)
def test_what_cannot_be_decided_is_refused(coefficients):
    with pytest.raises(ComputationError, match="could not be proved"):
        real_eigenpairs(BinaryForm(coefficients))


def test_a_multiplicity_that_cannot_be_decided_is_refused():
    other = pi + MACHIN
    form = BinaryForm([1, -2 * pi - 2 * other, pi**2 + other**2 + 4 * pi * other,
                       -2 * pi * other * (pi + other), pi**2 * other**2])  # fmt: skip
    with pytest.raises(ComputationError, match="could not be proved"):
        real_eigenpairs(form)


def test_numbers_that_are_not_real_are_refused():
    with pytest.raises(InputError, match="not real"):
        real_eigenpairs(BinaryForm([sp.acos(2), 1]))
    with pytest.raises(InputError, match="not real"):
        complex_eigenpairs(BinaryForm([sp.log(-2), pi]))
    with pytest.raises(InputError, match="not real"):
        count_maxima(BinaryForm([sp.I * pi, 1, pi]))


@pytest.mark.parametrize(
    "coefficients",
    [
        [pi, e, 1, -2],
        [1, sp.sin(1), 2, sp.cos(1), 0, 1],
        [sp.cbrt(2), sp.cbrt(3), sp.cbrt(5), 1],
        [pi, 1, 0, e, HIDDEN_ZERO],
        sp.Poly(sp.expand((x**2 + y**2) * (x - pi * y) * (x + e * y) * (x + y)), x, y).coeffs(),
    ],
    ids=str,
)
def test_complex_pairs_against_mpmath(coefficients):
    """Every root of F(1, tau) that mpmath finds with 60 digits lies in one enclosure."""
    form = BinaryForm(coefficients)
    pairs = complex_eigenpairs(form)
    assert pairs.count == max(form.row.support)
    own_real = sum(p.multiplicity for p in pairs if p.is_real)
    assert 2 * own_real == sum(p.multiplicity for p in real_eigenpairs(form))
    with mpmath.workdps(70):
        _, F = derivative_at(form, 70)
        while abs(F[-1]) < mpmath.mpf(10) ** -60:
            F.pop()
        zeros = mpmath.polyroots(F[::-1], maxsteps=500, extraprec=400)
        boxes = [p.tangent_enclosure(45) for p in pairs if p.polynomial is not None]
        for box in boxes:
            assert sum(_distance(box, w) < mpmath.mpf(10) ** -40 for w in zeros) == 1
        assert len(boxes) + 2 * bool(pairs.isotropic_multiplicity) == len(zeros)
        for p in pairs:
            u, w = (mpmath.mpmathify(c) for c in p.vector(40))
            a, _ = derivative_at(form, 60)
            value = sum(b * u ** (form.order - j) * w**j for j, b in enumerate(a))
            assert abs(value - mpmath.mpmathify(p.eigenvalue(40))) < mpmath.mpf(10) ** -35 * (
                1 + abs(value)
            )


def _distance(box, value):
    return max(
        max(lower - part, part - upper, 0)
        for side, part in zip(box, (value.real, value.imag), strict=True)
        for lower, upper in [[mpmath.mpf(q.numerator) / q.denominator for q in side]]
    )


def test_complex_multiplicities_are_proved():
    pairs = complex_eigenpairs(form_of((x**2 + pi * x * y + pi**2 * y**2) ** 3))
    double = [p for p in pairs if p.multiplicity == 2]
    assert len(double) == 2
    assert all(p.vanishing and not p.is_real for p in double)
    assert (pairs.count, pairs.isotropic_multiplicity) == (6, 0)
    irregular = complex_eigenpairs(form_of((x**2 + y**2) ** 2 * (x + e * y)))
    assert (irregular.count, irregular.isotropic_multiplicity) == (1, 2)


def test_roots_with_equal_real_parts_keep_their_order():
    polynomial = tuple(int(c) for c in sp.Poly((t - sp.Rational(1, 3)) ** 4 * 81 + 5 * 9
                       * (t - sp.Rational(1, 3)) ** 2 + 5, t).all_coeffs()[::-1])  # fmt: skip
    first = balls.complex_roots(polynomial, 112)
    assert len(first) == 2
    for bits in range(113, 400, 7):
        for a, b in zip(first, balls.complex_roots(polynomial, bits), strict=True):
            assert a.overlaps(b)


def test_characteristic_polynomial_has_the_real_eigenvalues_as_roots():
    for coefficients in ([sp.sin(1), 2 * sp.cos(1), -sp.sin(1), 1], [pi, e, 1, 2, 3],
                         [sp.cbrt(2), sp.cbrt(3), sp.cbrt(5), 1]):  # fmt: skip
        form = BinaryForm(coefficients)
        psi = characteristic_polynomial(form).polynomial
        size = max(abs(sp.N(c, 20)) for c in psi.all_coeffs())
        for pair in real_eigenpairs(form):
            value = pair.eigenvalue_float(60)
            terms = (sp.N(c, 60) * value**j for j, c in enumerate(psi.all_coeffs()[::-1]))
            assert abs(sum(terms)) < sp.Float("1e-50") * size * (1 + abs(value)) ** psi.degree()
    hidden = characteristic_polynomial(BinaryForm([1, e - HIDDEN_E, 1])).polynomial
    assert all(is_zero(a - b) for a, b in zip(hidden.all_coeffs(), (1, -2, 1), strict=True))


def test_jets_have_directions():
    f = sp.exp(x) * sp.sin(y)
    jet = explicit_jet(f, (x, y), 6, (1, 1))
    for k in range(2, 7):
        check(jet.form(k))
    level = implicit_jet(z - f, (x, y, z), 3, (1, 1, e * sp.sin(1)))
    assert [p.kind for p in level.eigenpairs(3)] == [p.kind for p in jet.eigenpairs(3)]
    curvatures = [float(sp.N(c)) for c in jet.principal_curvatures()]
    values = sorted({round(float(p.eigenvalue_float()), 12) for p in jet.eigenpairs(2)})
    assert values == pytest.approx(sorted(curvatures))


@pytest.mark.parametrize(
    ("name", "at"), [("ridge-to-junction", (sp.Rational(617, 5000), sp.Rational(1, 4))),
                     ("smooth-t-junction", (sp.Rational(1, 8), sp.Rational(1, 4)))]
)  # fmt: skip
def test_smooth_junctions_have_directions(name, at):
    jet = synthetic_surfaces.get(name).sites()[0].jet(3, at=at)
    for k in (2, 3):
        check(jet.form(k))


def test_kinds_of_an_undulation():
    """A zero of multiplicity 3 of F is an extremum: f = (x - pi y)^4 has a minimum there."""
    pairs = real_eigenpairs(form_of((x - pi * y) ** 4))
    flat = [p for p in pairs if p.vanishing]
    assert [(p.multiplicity, p.kind) for p in flat] == [(3, Kind.MINIMUM)] * 2


@pytest.mark.parametrize("other", [HIDDEN_E + 1, sp.sqrt(sp.exp(2) + 2 * e + 1)], ids=str)
def test_squarefree_parts_know_relations(other):
    """The second number equals e + 1 by a relation that only a zero decision finds."""
    line, same = sp.Poly(t - e - 1, t), sp.Poly(t - other, t)
    product = sp.Poly(line * line * same * sp.Poly(t - pi, t), t)
    parts = squarefree_parts(product.all_coeffs()[::-1])
    assert sorted(m for part in parts for m in part.real if m) == [1, 3]
    assert not any(part.upper for part in parts)


@pytest.mark.parametrize(
    "value",
    [sp.exp(sp.Rational(3, 2)) - sp.exp(-1), sp.sin(2) * sp.cos(sp.Rational(1, 3)),
     sp.tanh(sp.sqrt(2) + 1), sp.cot(3) + pi * sp.sinh(2), sp.tan(sp.sqrt(2) - 1) / e,
     sp.cos(-1) + sp.coth(sp.Rational(2, 3)), sp.log(2) * sp.cosh(sp.sqrt(3) / 2)],
    ids=str,
)  # fmt: skip
def test_numbers_in_independent_ones(value):
    numbers = Independent([value, sp.Integer(1)])
    above, below = (numbers.value(p) for p in numbers.polynomials)
    assert abs(sp.N(above / below - value, 60, maxn=400)) < sp.Float("1e-50")


def test_relations_between_exponentials_are_identities():
    for zero in (HIDDEN_ZERO, e - HIDDEN_E, sp.sin(2) - 2 * sp.sin(1) * sp.cos(1),
                 sp.exp(2) - e * sp.exp(sp.Rational(1, 2)) ** 2):  # fmt: skip
        assert Independent([zero]).polynomials == [0]


@pytest.mark.parametrize(
    "value", [-x, 1 / x, sp.sqrt(2), sp.exp(sp.exp(sp.exp(x))), x + 2 * y, -pi, -1 / (x - y)]
)
def test_texts_are_returned_iff_they_fit(value):
    assert text_within(value, len(str(value))) == str(value)
    assert not text_within(value, len(str(value)) - 1)


def test_a_long_expression_is_not_written(monkeypatch):
    value = sp.Add(*(sp.cos(n) for n in range(1, 200)))
    monkeypatch.setattr("pdtheory.exact.texts.sp.sstr", pytest.fail)
    assert not text_within(value, 100)


def test_double_zeros_vanish_whatever_factor_the_form_carries() -> None:
    """A factor so long that it is found in f, but in its derivative no longer."""
    plain = BinaryForm([1, 0, 0, -2, 0, 0, 1])
    long = (sp.pi + sp.E) ** 16
    scaled = BinaryForm([long * c for c in (1, 0, 0, -2, 0, 0, 1)])
    for pairs in (real_eigenpairs, complex_eigenpairs):
        expected = [pair.vanishing for pair in pairs(plain)]
        assert any(expected)
        assert [pair.vanishing for pair in pairs(scaled)] == expected
