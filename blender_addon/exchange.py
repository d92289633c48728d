# SPDX-License-Identifier: GPL-3.0-or-later
"""Direction fields to and from files."""

from pathlib import Path

import bpy
from bpy.props import StringProperty
from bpy_extras.io_utils import ExportHelper, ImportHelper

from pdtheory.blender.result import describe, field_of, show_result, source_for, strokes_of
from pdtheory.errors import InputError, PdtheoryError

from .jobs import redraw, surface_object


class ExportField(ExportHelper, bpy.types.Operator):
    """Write the directions of the active object: NPZ (all of it), PLY, VTP or CSV"""

    bl_idname = "principal_directions.export_field"
    bl_label = "Export Directions"

    filename_ext = ".npz"
    check_extension = None
    filter_glob: StringProperty(default="*.npz;*.ply;*.csv;*.vtp", options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        return strokes_of(surface_object(context)) is not None

    def execute(self, context):
        from pdtheory.io import write_field

        try:
            write_field(field_of(strokes_of(surface_object(context))), _chosen(self))
        except PdtheoryError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, f"Wrote {self.filepath}")
        return {"FINISHED"}


class ImportField(ImportHelper, bpy.types.Operator):
    """Show a direction field (NPZ) that was computed on the same object elsewhere"""

    bl_idname = "principal_directions.import_field"
    bl_label = "Import Directions"
    bl_options = {"UNDO"}  # noqa: RUF012

    filename_ext = ".npz"
    filter_glob: StringProperty(default="*.npz", options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        return surface_object(context) is not None

    def execute(self, context):
        from pdtheory.io import read_field

        thing = surface_object(context)
        try:
            field = read_field(_chosen(self))
            show_result(thing, source_for(thing, field), field)
        except PdtheoryError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        thing.principal_directions.summary = "\n".join(describe(field))
        thing.principal_directions.comparison = ""
        redraw()
        return {"FINISHED"}


def _chosen(operator):
    """Return the file that was chosen.

    Raises
    ------
    InputError
        If there is none.
    """
    if not operator.filepath:
        raise InputError("no file is chosen; choose one.")
    return Path(operator.filepath)


register, unregister = bpy.utils.register_classes_factory((ExportField, ImportField))
