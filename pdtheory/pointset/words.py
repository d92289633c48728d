"""Numbers and flags in words, for summaries that people read."""

from __future__ import annotations

from math import floor, isfinite, log10

from pdtheory.conventions import Status

#: Significant digits that double precision carries.
_DIGITS = 15

#: What each flag says, as in "the point has ...".
STATUS_WORDS = {
    Status.NON_FINITE: "a coordinate that is not finite",
    Status.TOO_FEW_NEIGHBOURS: "too few neighbours; enlarge the radius",
    Status.DEGENERATE_FRAME: "neighbours that span no plane",
    Status.DEGREE_LOWERED: "a lower degree than asked for, which the samples could not bear",
    Status.ILL_CONDITIONED: "an ill-conditioned fit; trust the standard deviations",
    Status.REFINED: "a solution that was refined once more",
    Status.ONE_SIDED: "neighbours on one side only, as at a boundary",
    Status.UNORIENTED: "a normal whose side is not known, so that signs are open",
    Status.NOT_CONVERGED: "no convergence in the l1 norm",
}


def status_words(status: Status) -> list[str]:
    """Return a phrase for every flag that is set; none for OK.

    Examples
    --------
    >>> status_words(Status.ONE_SIDED)
    ['neighbours on one side only, as at a boundary']
    """
    return [words for flag, words in STATUS_WORDS.items() if flag & status]


def with_error(value: float, error: float, *, digits: int = 6) -> str:
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

    Examples
    --------
    >>> with_error(12.3456, 0.0237)
    '12.346 ± 0.024'
    >>> with_error(-1.23456e8, 4.2e5)
    '(-1.2346 ± 0.0042)e+08'
    >>> with_error(0.25, float("nan"))
    '0.25'
    """
    if not isfinite(value):
        return "-"
    if not isfinite(error) or error <= 0.0:
        return f"{value:.{digits}g}"
    leading = floor(log10(max(abs(value), error)))
    power = 0 if -4 <= leading < 6 else leading
    wanted, carried = 1 - floor(log10(error)), _DIGITS - 1 - leading
    places = min(wanted, carried) + power
    scale = 10.0**-power
    shown = [f"{round(number * scale, places):.{max(places, 0)}f}" for number in (value, error)]
    if wanted > carried:
        # The deviation is finer than the digits of a double.
        shown[1] = f"{error * scale:.2g}"
    text = " ± ".join(shown)
    return text if power == 0 else f"({text})e{power:+03d}"
