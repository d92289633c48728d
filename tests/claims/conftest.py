"""All claims, run once for the tests of this folder."""

import pytest

from pdtheory.paper.claims import run_claims


@pytest.fixture(scope="session")
def results():
    """Results of all claims at the default orders, by id."""
    return {result.claim.id: result for result in run_claims()}
