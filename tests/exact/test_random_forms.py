"""Expected numbers of real eigenlines of random forms (Draisma and Horobet 2016)."""

from math import comb, sqrt

import numpy as np
import pytest
import sympy as sp

from pdtheory.exact import BinaryForm, real_eigenpairs


def counts(order, samples, seed):
    """Numbers of real eigenlines of forms that are Gaussian in the Bombieri norm."""
    rng = np.random.default_rng(seed)
    # Integers keep the arithmetic short; 2^20 steps a standard deviation change no probability
    # that a sample of this size could show.
    spread = np.array([sqrt(comb(order, j)) for j in range(order + 1)]) * 2.0**20
    found = []
    for row in rng.normal(size=(samples, order + 1)) * spread:
        pairs = real_eigenpairs(BinaryForm([sp.Integer(int(c)) for c in row]))
        found.append(len(pairs) // 2)
    return np.array(found)


def check(order, samples, seed):
    found = counts(order, samples, seed)
    error = found.std() / sqrt(samples)
    assert abs(found.mean() - sqrt(3 * order - 2)) < 3 * error
    assert found.max() <= order
    assert (found % 2 == order % 2).all()
    return found


@pytest.mark.parametrize("order", [3, 4, 7])
def test_expected_number_of_eigenlines(order):
    check(order, 600, seed=order)


@pytest.mark.slow
@pytest.mark.parametrize(("order", "most"), [(3, (sqrt(7) - 1) / 2), (4, (sqrt(10) - 2) / 2)])
def test_ten_thousand_forms(order, most):
    found = check(order, 10_000, seed=100 + order)
    # As only two counts are possible, the mean fixes how often the larger one occurs.
    share = (found == order).mean()
    assert abs(share - most) < 3 * sqrt(most * (1 - most) / len(found))
