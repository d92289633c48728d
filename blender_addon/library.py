# SPDX-License-Identifier: GPL-3.0-or-later
"""The library that the extension brings along, when another version of it was loaded before.

Blender replaces the files of an extension and of its wheels while it runs, and forgets the modules
of the extension alone. The modules of the library would stay those of the version before, and the
new extension would be put together with them.
"""

from __future__ import annotations

import importlib
import sys
from importlib.metadata import PackageNotFoundError, version

_PACKAGES = ("pdtheory", "synthetic_surfaces")
#: Attribute of the loaded library: the version of the wheel that it came from.
_LOADED = "loaded_by_blender_as"


def _installed() -> str:
    """Return the version of the library among the files."""
    importlib.invalidate_caches()
    try:
        return version(_PACKAGES[0])
    except PackageNotFoundError:
        return ""  # a folder of sources on the search path, which nobody replaces


def forget_replaced() -> None:
    """Forget the modules of the library if its files are those of another version by now."""
    installed = _installed()
    # What bears no mark was loaded by an extension that left none, or is no wheel of an extension:
    # only those have a version with a "+".
    unmarked = None if "+" in installed else installed
    loaded = sys.modules.get(_PACKAGES[0])
    if loaded is not None and getattr(loaded, _LOADED, unmarked) != installed:
        for name in list(sys.modules):
            if name.partition(".")[0] in _PACKAGES:
                sys.modules.pop(name)
    setattr(importlib.import_module(_PACKAGES[0]), _LOADED, installed)
