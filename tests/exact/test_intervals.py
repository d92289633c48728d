"""Enclosures and their texts."""

from fractions import Fraction

import mpmath
import pytest

from pdtheory.exact import BinaryForm, Enclosure


@pytest.mark.parametrize(
    ("lower", "upper", "text"),
    [
        (Fraction(1, 3), Fraction(2, 3), "[0.333, 0.667]"),
        (Fraction(-2, 3), Fraction(-1, 3), "[-0.667, -0.333]"),
        (Fraction(0), Fraction(0), "[0.000, 0.000]"),
        (Fraction(12345), Fraction(12345), "[12345, 12345]"),
        (Fraction(1, 300), Fraction(1, 300), "[0.00333, 0.00334]"),
    ],
)
def test_ends_are_rounded_outwards(lower, upper, text):
    assert Enclosure(lower, upper).text(3) == text


def test_more_digits_than_python_writes():
    # F(1, t) = -4 + 3 t - t^3 up to a sign.
    text = BinaryForm([1, 0, 0, 1, 0]).eigenpairs()[1].enclosure_text(6000)
    lower = text.removeprefix("theta in [").partition(",")[0]
    assert len(lower) > 6000
    with mpmath.workdps(6020):
        t = mpmath.findroot(lambda t: t**3 - 3 * t + 4, -2.2)
        theta = mpmath.degrees(mpmath.atan(t)) + 180
        assert lower[:5990] == mpmath.nstr(theta, 6010)[:5990]


def test_long_integers():
    number = 10**5000 + 7
    assert Enclosure(Fraction(number), Fraction(number)).text(3) == (
        f"[1{'0' * 4999}7, 1{'0' * 4999}7]"
    )
