"""The conventions that every part of pdtheory shares.

Heights z are measured along the unit normal n of a right-handed frame (t1, t2, n), the rows of a
3x3 array. Angles theta run from t1 towards t2, in radians. The term of order k is

    g_k(theta) = sum_n phi_{k,n} exp(i n theta) = T_k v^k / k!,   v = (cos theta, sin theta),

and an E-eigenvalue is lambda = T_k v^k = k! g_k(theta_e), signed. phi_{k,n} and lambda have the
unit length^(1-k); strength = |g_k| R^(k-1) has none.
"""

from __future__ import annotations

from enum import IntEnum, IntFlag
from typing import Final, NamedTuple

#: The Gaussian weight of the regression is exp(-r^2 / (2 sigma^2)) with sigma = R / SIGMA_RATIO.
SIGMA_RATIO: Final = 3.0

#: Degree of the regression used in the paper.
DEFAULT_DEGREE: Final = 10


class Kind(IntEnum):
    """What the signed g_k does at an E-eigenvector."""

    MINIMUM = -1
    INFLECTION = 0
    MAXIMUM = 1

    @property
    def label(self) -> str:
        """Short name used in tables and JSON: ``max``, ``min`` or ``inflection``."""
        return {1: "max", -1: "min", 0: "inflection"}[int(self)]


class Status(IntFlag):
    """Why the answer at a point is missing or weaker than asked for; OK is 0."""

    OK = 0
    NON_FINITE = 1
    TOO_FEW_NEIGHBOURS = 2
    DEGENERATE_FRAME = 4
    DEGREE_LOWERED = 8
    ILL_CONDITIONED = 16
    REFINED = 32
    ONE_SIDED = 64
    UNORIENTED = 128
    NOT_CONVERGED = 256
    UNCERTAIN_FRAME = 512

    @property
    def unanswered(self) -> bool:
        """True if no directions could be computed at the point."""
        return bool(self & UNANSWERED)


#: Flags under which a point has no directions at all.
UNANSWERED: Final = Status.NON_FINITE | Status.TOO_FEW_NEIGHBOURS | Status.DEGENERATE_FRAME


class Colour(NamedTuple):
    """An sRGB colour with components in [0, 1]."""

    red: float
    green: float
    blue: float


#: Colours of the paper for orders 2 to 6, continued with a series that stays apart for
#: colour-blind readers.
ORDER_COLOURS: Final[dict[int, Colour]] = {
    2: Colour(0.10, 0.22, 0.80),
    3: Colour(0.10, 0.62, 0.18),
    4: Colour(0.05, 0.72, 0.82),
    5: Colour(0.93, 0.32, 0.66),
    6: Colour(0.47, 0.28, 0.14),
    7: Colour(0.90, 0.60, 0.00),
    8: Colour(0.84, 0.37, 0.00),
    9: Colour(0.35, 0.35, 0.35),
    10: Colour(0.58, 0.44, 0.86),
}

#: Colour of the orders beyond the series.
_OTHER_ORDERS: Final = Colour(0.20, 0.20, 0.20)


def order_colour(order: int) -> Colour:
    """Return the colour of an order; all beyond the series share a dark grey."""
    return ORDER_COLOURS.get(order, _OTHER_ORDERS)


def frequencies(order: int) -> range:
    """Return the stored frequencies n of one order: 0 <= n <= k with n = k mod 2, ascending."""
    return range(order % 2, order + 1, 2)


def wavejets_table(degree: int) -> list[tuple[int, int]]:
    """Return the pairs (k, n) of a Wavejets table in storage order: k ascending, then n ascending.

    Parameters
    ----------
    degree
        Largest order K in the table.

    Returns
    -------
    list of (int, int)
        All (k, n) with 0 <= k <= K, 0 <= n <= k and n = k mod 2; phi_{k,-n} is the conjugate.
    """
    return [(k, n) for k in range(degree + 1) for n in frequencies(k)]
