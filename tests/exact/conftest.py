"""Profiles of hypothesis: HYPOTHESIS_PROFILE=thorough tries many more examples."""

import os

from hypothesis import settings

# Exact arithmetic takes its time on a busy machine; a slow example is no failure.
settings.register_profile("quick", deadline=None, max_examples=50)
settings.register_profile("thorough", deadline=None, max_examples=1000)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "quick"))
