"""How many examples the property tests try: ``dev`` (few) or ``ci`` (many).

Choose with the environment variable ``HYPOTHESIS_PROFILE``; ``dev`` is the default.
"""

from __future__ import annotations

import os

from hypothesis import HealthCheck, settings

settings.register_profile(
    "dev", max_examples=20, deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.register_profile(
    "ci", max_examples=400, deadline=None, suppress_health_check=[HealthCheck.too_slow]
)

#: Decorator of every property test; it leaves the settings of other tests alone.
examples = settings.get_profile(os.environ.get("HYPOTHESIS_PROFILE", "dev"))
