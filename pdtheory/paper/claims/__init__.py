"""Every statement of the paper as a claim with a certificate that is computed when it is run.

>>> from pdtheory.paper.claims import claim
>>> result = claim("lemma-gradient").run()
>>> result.verdict.value, result.scope, result.holds
('proved', 'all orders', True)

One module per section of the paper; the theorems that correct it follow in modules of their own.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from pdtheory.paper.claims import (
    cones,
    corrected_counts,
    corrected_pairs,
    corrected_psi,
    corrected_rosy,
    directions,
    estimation,
    experiments,
    limitations,
    outside,
    properties,
    regularity,
    related_work,
    tensors,
)
from pdtheory.paper.claims.core import Claim, Orders, Result, Shows, Step, Verdict, judge, select

__all__ = [
    "CLAIMS",
    "DEFAULT_ORDERS",
    "Claim",
    "Result",
    "Shows",
    "Step",
    "Verdict",
    "claim",
    "judge",
    "run_claims",
    "select",
]

#: Orders of the steps that reach only a bound, unless others are asked for.
DEFAULT_ORDERS: Orders = tuple(range(2, 13))

#: All claims, in the order of the paper; the corrected theorems and outside cases follow.
CLAIMS: tuple[Claim, ...] = tuple(
    entry
    for module in (
        related_work,
        tensors,
        directions,
        properties,
        regularity,
        estimation,
        experiments,
        limitations,
        corrected_rosy,
        corrected_counts,
        corrected_pairs,
        corrected_psi,
        cones,
        outside,
    )
    for entry in module.section
)


def claim(name: str) -> Claim:
    """Return the claim with an id.

    Raises
    ------
    InputError
        If there is none; the message names the nearest.
    """
    return select(CLAIMS, [name])[0]


def run_claims(
    ids: Iterable[str] = (),
    orders: Orders = DEFAULT_ORDERS,
    progress: Callable[[float, str], None] | None = None,
) -> Iterator[Result]:
    """Run the claims with the given ids, all of them if none is given, one after the other.

    Parameters
    ----------
    ids
        Ids of claims.
    orders
        Orders for the steps that reach only a bound; every one at least 2.
    progress
        Called with the fraction done and the id of the claim at work; may raise `Cancelled`.

    Yields
    ------
    Result
        Each as soon as it is computed.

    Raises
    ------
    InputError
        If an id is unknown.
    """
    chosen = select(CLAIMS, ids)
    for done, entry in enumerate(chosen):
        if progress:
            progress(done / len(chosen), entry.id)
        yield entry.run(orders)
