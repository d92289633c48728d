# SPDX-License-Identifier: GPL-3.0-or-later
"""Direction fields to and from files."""

from pathlib import Path

import bpy
from bpy.props import StringProperty
from bpy_extras.io_utils import ExportHelper, ImportHelper

from pdtheory.blender import compat
from pdtheory.blender.matching import source_for
from pdtheory.blender.result import describe, field_of, show_result, strokes_of
from pdtheory.errors import InputError, PdtheoryError

from .jobs import has_points, has_result, redraw, surface_object

_FilePath = StringProperty(name="File", subtype="FILE_PATH", options=compat.RELATIVE_PATH)


class ExportField(ExportHelper, bpy.types.Operator):
    """Write the directions of the active object: NPZ (all of it), PLY, VTP or CSV"""

    bl_idname = "principal_directions.export_field"
    bl_label = "Export Directions"

    filepath: _FilePath
    filename_ext = ".npz"
    check_extension = None
    filter_glob: StringProperty(default="*.npz;*.ply;*.csv;*.vtp", options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        return has_result(cls, context)

    def execute(self, context):
        from pdtheory.io import write_field

        try:
            path = _chosen(self)
            if not path.suffix:
                path = path.with_name(path.name + self.filename_ext)
            write_field(field_of(strokes_of(surface_object(context))), path)
        except PdtheoryError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, f"Wrote {path}")
        return {"FINISHED"}


class ImportField(ImportHelper, bpy.types.Operator):
    """Show a direction field (NPZ) that was computed on the same object elsewhere"""

    bl_idname = "principal_directions.import_field"
    bl_label = "Import Directions"
    bl_options = {"UNDO"}  # noqa: RUF012

    filepath: _FilePath
    filename_ext = ".npz"
    filter_glob: StringProperty(default="*.npz", options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        return has_points(cls, context)

    def execute(self, context):
        from pdtheory.io import read_field

        thing = surface_object(context)
        try:
            field = read_field(_chosen(self))
            show_result(thing, source_for(thing, field), field)
        except PdtheoryError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        lines = describe(field)
        thing.principal_directions.summary = "\n".join(lines)
        thing.principal_directions.comparison = ""
        redraw()
        self.report({"INFO"}, lines[0])
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
    # Blender writes // for the folder of its file.
    return Path(bpy.path.abspath(operator.filepath))


def _draw_export(self, context):
    self.layout.operator(
        ExportField.bl_idname, text="Principal Directions (.npz, .ply, .vtp, .csv)"
    )


def _draw_import(self, context):
    self.layout.operator(ImportField.bl_idname, text="Principal Directions (.npz)")


def register():
    bpy.utils.register_class(ExportField)
    bpy.utils.register_class(ImportField)
    bpy.types.TOPBAR_MT_file_export.append(_draw_export)
    bpy.types.TOPBAR_MT_file_import.append(_draw_import)


def unregister():
    bpy.types.TOPBAR_MT_file_import.remove(_draw_import)
    bpy.types.TOPBAR_MT_file_export.remove(_draw_export)
    bpy.utils.unregister_class(ImportField)
    bpy.utils.unregister_class(ExportField)
