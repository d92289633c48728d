"""The compiled part of the engine: what happens at one point, and chunks of points."""

from pdtheory.errors import MissingDependencyError

try:
    import numba  # noqa: F401
except ImportError as error:
    raise MissingDependencyError(
        f"estimating directions needs Numba, which cannot be loaded here ({error}); install it, "
        "for instance with pip install numba."
    ) from error
