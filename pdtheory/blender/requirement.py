"""Find out whether `bpy` can be used, and say in one sentence what is missing where it cannot."""

from __future__ import annotations

import re
import sys

from pdtheory.errors import MissingDependencyError

#: Debian packages that hold the shared libraries the bpy wheel links to.
DEBIAN_PACKAGES = (
    "libx11-6 libxi6 libxxf86vm1 libxfixes3 libxrender1 libxkbcommon0 libsm6 libice6 libgl1 libegl1"
)


def require_bpy() -> None:
    """Import `bpy`, Blender as a Python module.

    Raises
    ------
    MissingDependencyError
        If it is not installed, or one of the shared libraries it links to is missing.
    """
    try:
        import bpy  # noqa: F401
    except ModuleNotFoundError as error:
        if error.name != "bpy":
            raise MissingDependencyError(
                f"Blender's Python module cannot start: it needs {error.name}; "
                "reinstall it with `uv sync --extra blender`."
            ) from error
        running = f"{sys.version_info.major}.{sys.version_info.minor}"
        raise MissingDependencyError(
            f"drawing needs Blender's Python module bpy, which is not installed in this Python "
            f"{running}; it exists for Python 3.11 and 3.13: use one of them and install it with "
            "`uv sync --extra blender` or, in a clone, `pip install '.[blender]'`."
        ) from error
    except ImportError as error:
        library = re.match(r"(lib[\w.+-]+\.so[\w.]*)", str(error))
        if library is None:
            raise MissingDependencyError(
                f"Blender's Python module bpy is installed and does not load ({error}); "
                "reinstall it with `uv sync --extra blender`."
            ) from error
        raise MissingDependencyError(
            f"Blender's Python module bpy needs the shared library {library[1]}, which this system "
            f"lacks; on Debian and Ubuntu: apt-get install {DEBIAN_PACKAGES}."
        ) from error
