# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets of the computation settings."""

import bpy
from bl_operators.presets import AddPresetBase

from .properties import SETTING_NAMES

_FOLDER = "principal_directions"


class DIRECTIONS_MT_presets(bpy.types.Menu):  # noqa: N801
    """Menu of the presets."""

    bl_label = "Directions Presets"
    preset_subdir = _FOLDER
    preset_operator = "script.execute_preset"
    draw = bpy.types.Menu.draw_preset


class AddPreset(AddPresetBase, bpy.types.Operator):
    """Add or remove a preset of the settings"""

    bl_idname = "principal_directions.preset_add"
    bl_label = "Add Directions Preset"
    preset_menu = "DIRECTIONS_MT_presets"
    preset_subdir = _FOLDER
    preset_defines = ("settings = bpy.context.scene.principal_directions",)
    preset_values = tuple(f"settings.{name}" for name in SETTING_NAMES)


register, unregister = bpy.utils.register_classes_factory((DIRECTIONS_MT_presets, AddPreset))
