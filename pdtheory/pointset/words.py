"""Numbers and flags in words, for summaries that people read."""

from __future__ import annotations

from math import ceil, degrees, factorial, floor, inf, isfinite, log10

from pdtheory.conventions import Status

#: Significant digits that double precision carries.
_DIGITS = 15

#: Degrees. Lines are never farther apart, so a larger deviation says nothing about an angle.
LARGEST_ANGLE_ERROR = 90.0
#: What stands in place of a deviation that says nothing.
UNDETERMINED = "undetermined"

#: What each flag says, as in "the point has ...", alone or in a list.
STATUS_WORDS = {
    Status.NON_FINITE: "a coordinate that is not finite",
    Status.TOO_FEW_NEIGHBOURS: "too few distinct neighbours (enlarge the neighbourhood)",
    Status.DEGENERATE_FRAME: "neighbours that span no plane",
    Status.DEGREE_LOWERED: "a degree lowered to what the neighbours can bear",
    Status.ILL_CONDITIONED: "an ill-conditioned fit (see the standard deviations)",
    Status.REFINED: "a solution that was refined once more",
    Status.ONE_SIDED: "neighbours on one side only, as at a boundary",
    Status.UNORIENTED: "a normal whose side is not known, so that signs are open",
    Status.NOT_CONVERGED: "no convergence in the l1 norm",
    Status.UNCERTAIN_FRAME: "a tangent plane hidden by an edge or by noise (that of a simpler "
    "fit instead)",
}


def status_words(status: Status) -> list[str]:
    """Return a phrase for every flag that is set; none for OK.

    Examples
    --------
    >>> status_words(Status.ONE_SIDED)
    ['neighbours on one side only, as at a boundary']
    """
    return [words for flag, words in STATUS_WORDS.items() if flag & status]


def with_error(value: float, error: float, *, digits: int = 6, limit: float = inf) -> str:
    """Return a number with its standard deviation, no digit more than this justifies.

    The deviation keeps two significant digits, and the number ends at the same place.

    Parameters
    ----------
    value
        The number.
    error
        Its standard deviation; not finite or 0 if none is known.
    digits
        Significant digits of a number without a deviation.
    limit
        With a larger deviation the number is called undetermined. It is not rounded away then.

    Examples
    --------
    >>> with_error(12.3456, 0.0237)
    '12.346 ± 0.024'
    >>> with_error(-1.23456e8, 4.2e5)
    '(-1.2346 ± 0.0042)e+08'
    >>> with_error(0.25, float("nan"))
    '0.25'
    >>> with_error(40.123, 850.0, limit=90.0)
    '40.1 (undetermined)'
    """
    if not isfinite(value):
        return "-"
    if not isfinite(error) or error <= 0.0:
        return f"{value:.{digits}g}"
    if error > limit:
        return f"{value:.3g} ({UNDETERMINED})"
    leading = floor(log10(max(abs(value), error)))
    power = 0 if -4 <= leading < 6 else leading
    wanted, carried = 1 - floor(log10(error)), _DIGITS - 1 - leading
    places = min(wanted, carried) + power
    scale = 10.0**-power
    # Adding 0 takes the sign from a zero.
    rounded = (round(number * scale, places) + 0.0 for number in (value, error))
    shown = [f"{number:.{max(places, 0)}f}" for number in rounded]
    if wanted > carried:
        # The deviation is finer than the digits of a double.
        shown[1] = f"{error * scale:.2g}"
    text = " ± ".join(shown)
    return text if power == 0 else f"({text})e{power:+03d}"


def angle_with_error(angle: float, error: float) -> str:
    """Return an angle and its standard deviation, both in radians, in degrees and words.

    Examples
    --------
    >>> angle_with_error(0.5, 0.01), angle_with_error(0.5, 3.0)
    ('28.65 ± 0.57', '28.6 (undetermined)')
    """
    return with_error(degrees(angle), degrees(error), limit=LARGEST_ANGLE_ERROR)


def largest_eigenvalue_error(value: float, error: float, order: int, radius: float) -> float:
    """Return the deviation of an eigenvalue beyond which it says nothing.

    Where it leaves no digit, and the term may leave the neighbourhood: at the distance R its height
    is R times the strength.

    Examples
    --------
    >>> largest_eigenvalue_error(0.5, 100.0, 2, 0.1), largest_eigenvalue_error(0.5, 1.0, 2, 0.1)
    (5.0, inf)
    """
    height = error / factorial(order) * radius ** (order - 1)
    return 10.0 * abs(value) if height > 1.0 else inf


def coordinate(value: float, radius: float) -> str:
    """Return a coordinate to six digits, or to a thousandth of a radius where that takes more.

    Examples
    --------
    >>> coordinate(5412375.19631, 8.5), coordinate(0.25, 0.1), coordinate(1.0, 0.0)
    ('5412375.2', '0.25', '1')
    """
    if value == 0.0 or not isfinite(value):
        return f"{value + 0.0:g}"
    digits = ceil(log10(abs(value)) - log10(radius)) + 3 if radius > 0.0 else 12
    return f"{value:.{min(max(6, digits), 17)}g}"
