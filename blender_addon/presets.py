# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets of the computation settings."""

import bpy
from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel

from .properties import SETTING_NAMES

_FOLDER = "principal_directions"


class DIRECTIONS_PT_presets(PresetPanel, bpy.types.Panel):  # noqa: N801
    """The presets: to take, to add, to remove."""

    bl_label = "Directions Presets"
    preset_subdir = _FOLDER
    preset_operator = "script.execute_preset"
    preset_add_operator = "principal_directions.preset_add"

    def draw(self, context):
        # Blender would say "Missing Paths" of a folder that is not there yet.
        bpy.utils.user_resource("SCRIPTS", path=f"presets/{_FOLDER}", create=True)
        super().draw(context)


class AddPreset(AddPresetBase, bpy.types.Operator):
    """Add or remove a preset of the settings"""

    bl_idname = "principal_directions.preset_add"
    bl_label = "Add Directions Preset"
    preset_menu = "DIRECTIONS_PT_presets"
    preset_subdir = _FOLDER
    preset_defines = ("settings = bpy.context.scene.principal_directions",)
    preset_values = tuple(f"settings.{name}" for name in SETTING_NAMES)


register, unregister = bpy.utils.register_classes_factory((DIRECTIONS_PT_presets, AddPreset))
