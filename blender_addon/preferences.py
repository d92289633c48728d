# SPDX-License-Identifier: GPL-3.0-or-later
"""Preferences: how many cores to use, and where compiled kernels are kept."""

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


def _keep_kernels() -> None:
    """Let Numba keep its compiled kernels where the extension may write."""
    if "NUMBA_CACHE_DIR" in os.environ or not __package__.startswith("bl_ext."):
        return
    try:
        folder = bpy.utils.extension_path_user(__package__, path="kernels", create=True)
    except (ValueError, OSError):
        # No place to write: the kernels are compiled anew in each session.
        return
    os.environ["NUMBA_CACHE_DIR"] = folder


def register():
    bpy.utils.register_class(DirectionsPreferences)
    _keep_kernels()


def unregister():
    bpy.utils.unregister_class(DirectionsPreferences)
