"""A correction of SymPy 1.14, which remembers composite numbers as prime factors.

SymPy divides what stands under a root by small primes only. Where the rest is a product of two
numbers near each other, version 1.14 hands these to its store of prime factors without asking
whether they are prime, and the store raises ValueError: the root of such a number ends in a
traceback (issue 28621 of SymPy, corrected after 1.14).
"""

from __future__ import annotations

import sympy as sp
from sympy.ntheory import factor_, isprime


def remember_primes_only() -> None:
    """Let SymPy 1.14 pass over composite numbers instead of raising; leave other versions alone."""
    store = factor_.factor_cache
    # A store of the user's own class is the user's to correct.
    if not sp.__version__.startswith("1.14") or type(store) is not factor_.FactorCache:
        return

    class PrimeFactors(factor_.FactorCache):
        """Numbers and one prime factor of each."""

        def __setitem__(self, number: int, factor: int) -> None:
            if isprime(factor):
                super().__setitem__(number, factor)

    # The store is public: whoever holds it keeps it, with what it holds.
    store.__class__ = PrimeFactors
