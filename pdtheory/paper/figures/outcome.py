"""What a figure is, what it computes, and what is checked about it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal, TypeVar

Quality = Literal["small", "draft", "paper"]
QUALITIES: tuple[Quality, ...] = ("small", "draft", "paper")

#: Called with a fraction in [0, 1] and what is being done.
Report = Callable[[float, str], None]

T = TypeVar("T")


@dataclass(frozen=True)
class Check:
    """One number of a figure, and the range in which it must lie.

    Attributes
    ----------
    statement : str
        What the number is.
    value : float
        The number.
    low, high : float
        The closed range.
    because : str
        Where the range comes from.
    """

    statement: str
    value: float
    low: float
    high: float
    because: str

    @property
    def holds(self) -> bool:
        """Whether the number lies in the range; NaN does not."""
        return self.low <= self.value <= self.high

    def __str__(self) -> str:
        if self.low == self.high:
            wanted = f"is to be {self.low:g}"
        elif self.low == float("-inf"):
            wanted = f"at most {self.high:g}"
        elif self.high == float("inf"):
            wanted = f"at least {self.low:g}"
        else:
            wanted = f"from {self.low:g} to {self.high:g}"
        verdict = "holds" if self.holds else "FAILS"
        return f"{verdict}: {self.statement} = {self.value:.4g} ({wanted}; {self.because})"


def at_most(statement: str, value: float, high: float, because: str) -> Check:
    """Return a check that a number does not exceed a bound."""
    return Check(statement, float(value), float("-inf"), high, because)


def equal(statement: str, value: float, expected: float, because: str) -> Check:
    """Return a check that a count has one value."""
    return Check(statement, float(value), expected, expected, because)


@dataclass(frozen=True)
class Outcome:
    """What a figure computed.

    Attributes
    ----------
    checks : list of Check
        The numeric checks.
    parameters : dict
        What was put in: sizes, radii, degrees, seeds. JSON values.
    numbers : dict
        What came out, besides the checks. JSON values.
    scene : Any
        Arrays for the drawing; known to the figure alone.
    """

    checks: list[Check]
    parameters: dict[str, Any]
    numbers: dict[str, Any] = field(default_factory=dict)
    scene: Any = None

    @property
    def holds(self) -> bool:
        """Whether all checks hold."""
        return all(check.holds for check in self.checks)


@dataclass(frozen=True)
class Job:
    """How figures are made.

    Attributes
    ----------
    quality : {"small", "draft", "paper"}
        ``small`` is for tests.
    models : Path or None
        Folder of scans.
    seed : int
        Seed of all random numbers.
    report : callable or None
        Told about progress.
    """

    quality: Quality = "draft"
    models: Path | None = None
    seed: int = 0
    report: Report | None = None

    def pick(self, small: T, draft: T, paper: T) -> T:
        """Return the value for the quality in force."""
        return {"small": small, "draft": draft, "paper": paper}[self.quality]

    def tell(self, fraction: float, text: str) -> None:
        """Report progress; the listener may raise :class:`pdtheory.errors.Cancelled`."""
        if self.report is not None:
            self.report(fraction, text)


@dataclass(frozen=True)
class Figure:
    """One figure.

    Attributes
    ----------
    name : str
        Name on the command line.
    redraws : str
        The figure of the paper that it redraws, or ``beyond the paper``.
    caption : str
        What it shows, in our words.
    compute : callable
        Computes data and checks.
    draw : callable
        Writes the pictures into a folder and returns their paths, the main one first.
    models : tuple of tuples of str
        Scans that it needs; of each the names that will do, the best first.
    """

    name: str
    redraws: str
    caption: str
    compute: Callable[[Job], Outcome]
    draw: Callable[[Job, Outcome, Path], list[Path]]
    models: tuple[tuple[str, ...], ...] = ()
