"""The properties stand in the package; their assertions are to be explained as well."""

import pytest

pytest.register_assert_rewrite("pdtheory.testing.test_forms", "pdtheory.testing.test_samples")
