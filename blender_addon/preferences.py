# SPDX-License-Identifier: GPL-3.0-or-later
"""Preferences: how many cores to use, and where libraries keep what they made."""

import os

import bpy
from bpy.props import IntProperty


class DirectionsPreferences(bpy.types.AddonPreferences):
    """Preferences of the extension."""

    bl_idname = __package__

    threads: IntProperty(
        name="Threads",
        description="Threads that compute; 0 leaves one core to the window, but takes at least two",
        min=0,
        max=256,
        default=0,
    )

    def draw(self, context):
        self.layout.prop(self, "threads")


def thread_count() -> int:
    """Return how many threads may compute."""
    addon = bpy.context.preferences.addons.get(__package__)
    chosen = addon.preferences.threads if addon is not None and addon.preferences else 0
    return chosen or max(2, (os.cpu_count() or 2) - 1)


def _keep_caches() -> None:
    """Let libraries keep what they made where the extension may write: kernels, a list of fonts."""
    if not __package__.startswith("bl_ext."):
        return
    for variable, name in (("NUMBA_CACHE_DIR", "kernels"), ("MPLCONFIGDIR", "plots")):
        if variable in os.environ:
            continue
        try:
            folder = bpy.utils.extension_path_user(__package__, path=name, create=True)
        except (ValueError, OSError):
            # No place to write: it is made anew in each session.
            return
        os.environ[variable] = folder


def register():
    bpy.utils.register_class(DirectionsPreferences)
    _keep_caches()


def unregister():
    bpy.utils.unregister_class(DirectionsPreferences)
