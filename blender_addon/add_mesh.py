# SPDX-License-Identifier: GPL-3.0-or-later
"""Add > Mesh > Principal Directions: the synthetic surfaces, with their parameters."""

import json
import keyword

import bpy
from bpy.props import FloatProperty, IntProperty, StringProperty
from bpy_extras.object_utils import AddObjectHelper, object_data_add

import synthetic_surfaces
from pdtheory.blender.surface import surface_mesh
from pdtheory.errors import PdtheoryError

#: Blender's floats are single precision: wider ranges than this are not offered.
_LARGEST = 1e6


class AddSynthetic(AddObjectHelper):
    """Base of one operator for each surface; the parameters are its properties."""

    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012
    surface_name = ""

    resolution: IntProperty(
        name="Resolution",
        description="Cells along a side, or from the centre to the rim",
        min=2,
        soft_max=256,
        max=1024,
        default=48,
    )

    def execute(self, context):
        known = synthetic_surfaces.get(self.surface_name).parameters
        values = {p.name: _exactly(getattr(self, _property_name(p.name))) for p in known}
        try:
            surface = synthetic_surfaces.get(self.surface_name, **values)
            mesh = surface_mesh(surface.mesh(self.resolution))
        except PdtheoryError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        edited = context.edit_object
        thing = object_data_add(context, mesh, operator=self)
        if edited is None:
            recipe = {
                "name": self.surface_name,
                "parameters": values,
                "resolution": self.resolution,
            }
            thing.principal_directions.surface = json.dumps(recipe)
        else:
            # Blender has joined the new surface into the edited one, which is not what it was.
            edited.principal_directions.surface = ""
        return {"FINISHED"}


def _exactly(value):
    """Return a value as the user typed it: 0.1, not the single-precision number nearby."""
    return f"{value:.7g}" if isinstance(value, float) else str(value)


def _property_name(name):
    return f"{name}_" if keyword.iskeyword(name) or name == "resolution" else name


def _property_of(parameter):
    about = {
        "name": parameter.name.replace("_", " ").title(),
        "description": parameter.doc[:1].upper() + parameter.doc[1:],
    }
    if parameter.kind == "real":
        return FloatProperty(
            min=max(parameter.low, -_LARGEST),
            max=min(parameter.high, _LARGEST),
            default=float(parameter.read(parameter.default)),
            precision=4,
            step=5,
            **about,
        )
    if parameter.kind == "integer":
        return IntProperty(
            min=max(int(parameter.low), -(2**31)),
            max=min(int(parameter.high), 2**31 - 1),
            default=int(parameter.read(parameter.default)),
            **about,
        )
    return StringProperty(default=str(parameter.default), **about)


def _operator_for(name):
    surface = synthetic_surfaces.get(name)
    properties = {
        _property_name(parameter.name): _property_of(parameter) for parameter in surface.parameters
    }
    identifier = name.replace("-", "_")
    return type(
        f"PRINCIPAL_DIRECTIONS_OT_add_{identifier}",
        (AddSynthetic, bpy.types.Operator),
        {
            "bl_idname": f"principal_directions.add_{identifier}",
            "bl_label": name.replace("-", " ").title(),
            "__doc__": surface.summary[:1].upper() + surface.summary[1:],
            "__module__": __name__,
            "__annotations__": properties,
            "surface_name": name,
        },
    )


class DIRECTIONS_MT_add(bpy.types.Menu):  # noqa: N801
    """The synthetic surfaces."""

    bl_label = "Principal Directions"

    def draw(self, context):
        self.layout.operator_context = "INVOKE_REGION_WIN"
        for each in _operators:
            self.layout.operator(each.bl_idname, text=each.bl_label)


def _draw_menu(self, context):
    self.layout.menu("DIRECTIONS_MT_add", icon="ORIENTATION_NORMAL")


_operators = []


def register():
    _operators.extend(_operator_for(name) for name in synthetic_surfaces.names())
    for each in (*_operators, DIRECTIONS_MT_add):
        bpy.utils.register_class(each)
    bpy.types.VIEW3D_MT_mesh_add.append(_draw_menu)


def unregister():
    bpy.types.VIEW3D_MT_mesh_add.remove(_draw_menu)
    for each in (DIRECTIONS_MT_add, *reversed(_operators)):
        bpy.utils.unregister_class(each)
    _operators.clear()
