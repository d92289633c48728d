"""The property tests that others run with ``pytest --pyargs pdtheory.testing``."""

from pdtheory.testing.test_forms import *  # noqa: F403
from pdtheory.testing.test_samples import *  # noqa: F403
