"""What a claim is, what its certificate is made of, and how a verdict follows from the certificate.

A claim knows what the paper prints, what is true instead, and a check. The check computes the
certificate step by step; each step says what it shows and whether the computation came out so.
The verdict is computed from the steps (:func:`judge`) and compared with the recorded one.

The ingredients of the statement (a factor, a sign, a hypothesis, an example) are keyword arguments
of the check, so that a wrong statement can be fed to it and must be refused.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

from pdtheory.errors import InputError

Orders = tuple[int, ...]


class Verdict(StrEnum):
    """The verdict on a statement of the paper.

    PROVED
        The statement as printed holds.
    PROVED_STRONGER
        It holds under a hypothesis that the paper does not state, and fails without it.
    REFUTED
        It fails inside its own hypotheses; the corrected statement is proved.
    MISPRINT
        The formula or wording contradicts itself or its use; the correction is evident and proved.
    CONFIGURATION
        It holds for some configurations and fails for others.
    NOT_ESTABLISHED
        The computation did not come out as the claim says; never a recorded verdict.
    """

    PROVED = "proved"
    PROVED_STRONGER = "proved with a stronger hypothesis"
    REFUTED = "refuted"
    MISPRINT = "misprint"
    CONFIGURATION = "configuration-dependent"
    NOT_ESTABLISHED = "not established"


class Shows(StrEnum):
    """What one step of a certificate shows."""

    #: Part of the proof of the statement that is recorded as true.
    PROOF = "proof"
    #: The printed statement fails although its hypotheses hold.
    COUNTEREXAMPLE = "counterexample"
    #: The statement fails where the added hypothesis does not hold.
    NEEDED = "the hypothesis is needed"
    #: The print contradicts itself.
    MISPRINT = "misprint"
    #: A configuration for which the statement holds.
    HAPPENS = "it happens"
    #: A configuration for which it does not.
    FAILS = "it fails"


@dataclass(frozen=True, slots=True)
class Step:
    """One computed fact.

    Parameters
    ----------
    shows
        Its part in the certificate.
    text
        What was computed, in words, with mathematics as LaTeX between dollar signs.
    holds
        Whether the computation came out as the text says.
    data
        The identity, the exact numbers or the counts, as text in SymPy's notation: enough for a
        third party to repeat the step.
    """

    shows: Shows
    text: str
    holds: bool
    data: Mapping[str, str] = field(default_factory=dict)

    def as_json(self) -> dict[str, Any]:
        """Return the step as plain JSON data."""
        return {
            "shows": self.shows.value,
            "text": self.text,
            "holds": self.holds,
            "data": dict(self.data),
        }


Check = Callable[..., Iterable[Step]]


@dataclass(frozen=True, slots=True)
class Result:
    """The outcome of running a claim: the computed verdict and the certificate behind it."""

    claim: Claim
    orders: Orders
    steps: tuple[Step, ...]

    @property
    def verdict(self) -> Verdict:
        """The verdict that follows from the steps."""
        return judge(self.steps)

    @property
    def holds(self) -> bool:
        """True if the computed verdict is the recorded one."""
        return self.verdict is self.claim.verdict

    @property
    def scope(self) -> str:
        """How far the certificate reaches."""
        return self.claim.scope.format(orders=describe_orders(self.orders))

    def as_json(self) -> dict[str, Any]:
        """Return the six entries of the JSON report."""
        return {
            "id": self.claim.id,
            "place": self.claim.place,
            "verdict": self.verdict.value,
            "scope": self.scope,
            "holds": self.holds,
            "certificate": {
                "printed": self.claim.printed,
                "statement": self.claim.statement,
                "steps": [step.as_json() for step in self.steps],
            },
        }


@dataclass(frozen=True, slots=True)
class Claim:
    """A statement of the paper, or the theorem that corrects one.

    Parameters
    ----------
    id
        Short name, unique.
    place
        Section and number in the paper as printed.
    printed
        What the paper says, in our words; empty for a theorem that is ours.
    statement
        What is true, in our words. The certificate is about this.
    verdict
        The recorded verdict on `printed` (on `statement` where nothing is printed).
    scope
        ``all orders``, ``orders {orders}`` (filled in when run), ``configuration``, or the one
        order that the statement is about.
    check
        Called with the orders and, as keywords, the ingredients of the statement.
    section
        Heading under which reports list the claim.
    """

    id: str
    place: str
    printed: str
    statement: str
    verdict: Verdict
    scope: str
    check: Check
    section: str

    def run(self, orders: Orders = tuple(range(2, 13)), **ingredients: Any) -> Result:
        """Compute the certificate.

        Parameters
        ----------
        orders
            Orders for the steps that reach only a bound.
        ingredients
            Replacements for ingredients of the statement; with a wrong one the result must not
            hold.
        """
        return Result(self, orders, tuple(self.check(orders, **ingredients)))


def judge(steps: Iterable[Step]) -> Verdict:
    """Return the verdict that a certificate supports.

    Every step must have come out. Then a counterexample refutes, a step that needs the added
    hypothesis or shows a misprint decides so, and examples both ways make the statement
    configuration-dependent; all of these but the last also need a proof of the corrected statement.
    """
    steps = tuple(steps)
    shown = {step.shows for step in steps}
    if not all(step.holds for step in steps):
        return Verdict.NOT_ESTABLISHED
    if shown >= {Shows.HAPPENS, Shows.FAILS}:
        return Verdict.CONFIGURATION
    if Shows.PROOF not in shown or shown & {Shows.HAPPENS, Shows.FAILS}:
        return Verdict.NOT_ESTABLISHED
    for kind, verdict in (
        (Shows.COUNTEREXAMPLE, Verdict.REFUTED),
        (Shows.NEEDED, Verdict.PROVED_STRONGER),
        (Shows.MISPRINT, Verdict.MISPRINT),
    ):
        if kind in shown:
            return verdict
    return Verdict.PROVED


def describe_orders(orders: Orders) -> str:
    """Write orders in words: ``2 to 12``, or ``2, 3, 7``."""
    if len(orders) > 2 and orders == tuple(range(orders[0], orders[-1] + 1)):
        return f"{orders[0]} to {orders[-1]}"
    return ", ".join(map(str, orders))


ALL_ORDERS = "all orders"
UP_TO = "orders {orders}"
CONFIGURATION = "configuration"


class Section:
    """The claims of one section, in order; used as a decorator factory by the modules.

    Parameters
    ----------
    title
        Heading of the section.
    """

    def __init__(self, title: str) -> None:
        self.title = title
        self.claims: list[Claim] = []

    def __iter__(self) -> Iterator[Claim]:
        return iter(self.claims)

    def claim(
        self,
        id: str,
        *,
        place: str,
        statement: str,
        printed: str = "",
        verdict: Verdict = Verdict.PROVED,
        scope: str = ALL_ORDERS,
    ) -> Callable[[Check], Check]:
        """Make the decorated check the certificate of a new claim."""

        def register(check: Check) -> Check:
            self.claims.append(
                Claim(id, place, printed, statement, verdict, scope, check, self.title)
            )
            return check

        return register


def select(claims: Iterable[Claim], ids: Iterable[str]) -> tuple[Claim, ...]:
    """Return the claims with the given ids, all of them if none is given.

    Raises
    ------
    InputError
        If an id is unknown; the message names the nearest known ones.
    """
    from difflib import get_close_matches

    known = {claim.id: claim for claim in claims}
    wanted = tuple(ids) or tuple(known)
    for name in wanted:
        if name not in known:
            near = get_close_matches(name, known, n=3, cutoff=0.4)
            hint = (
                f"did you mean {' or '.join(near)}?"
                if near
                else "without an id all are checked and listed."
            )
            raise InputError(f"there is no claim {name!r}; {hint}")
    return tuple(known[name] for name in dict.fromkeys(wanted))
