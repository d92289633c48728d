# SPDX-License-Identifier: GPL-3.0-or-later
"""The tab "Directions" in the sidebar of the 3D view."""

import textwrap
from itertools import groupby
from operator import itemgetter

import bpy

from pdtheory.blender import compat
from pdtheory.blender.glyphs import ORDERS_KEY, find_modifier
from pdtheory.blender.matching import changed_since
from pdtheory.blender.result import strokes_of
from pdtheory.errors import PdtheoryError

from .inspect_point import active_point, active_vertex, table
from .jobs import surface_object
from .polar_plot import plots_of
from .presets import DIRECTIONS_PT_presets
from .translations import CONTEXT

_LOOK = ("Style", "Length", "By Strength", "Width", "Taper", "Lift", "Follow Surface")
_CHOICE = ("Spacing", "One Order Per Point", "Maxima", "Minima", "Inflections")

#: Their names are too long to stand beside them in a narrow sidebar.
_LIMITS = ("Least Strength", "Largest Uncertainty")

#: Buttons of Blender that a polar plot is wide at least, where there is room for two.
_PLOT = 11


class _DirectionsPanel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Directions"


class DIRECTIONS_PT_compute(_DirectionsPanel, bpy.types.Panel):  # noqa: N801
    """What to compute on, how, and the button that does it."""

    bl_label = "Principal Directions"

    def draw_header_preset(self, context):
        DIRECTIONS_PT_presets.draw_panel_header(self.layout)

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        settings = context.scene.principal_directions
        thing = surface_object(context)
        layout.label(text=thing.name if thing else "Select an object", icon="OBJECT_DATA")

        column = layout.column()
        column.row().prop(settings, "source", expand=True)
        if settings.source == "SAMPLES":
            column.prop(settings, "samples")
            column.prop(settings, "seed")
        column.prop(settings, "evaluated")

        column = layout.column()
        column.row().prop(settings, "neighbourhood", expand=True)
        if settings.neighbourhood == "RADIUS":
            row = column.row(align=True)
            row.prop(settings, "radius")
            row.operator("principal_directions.propose_radius", text="", icon="EYEDROPPER")
        else:
            column.prop(settings, "neighbours")
        column.prop(settings, "degree")
        column.row().prop(settings, "orders", expand=True)
        column.prop(settings, "norm")

        progress = context.window_manager.principal_directions
        if progress.running:
            row = layout.row(align=True)
            row.progress(factor=progress.fraction, text=f"{progress.fraction:.0%}")
            row.operator("principal_directions.cancel", text="", icon="X")
            _sentence(context, layout, progress.text)
        else:
            row = layout.row()
            row.scale_y = 1.5
            row.operator("principal_directions.compute", icon="ORIENTATION_NORMAL")
            layout.operator("principal_directions.import_field", icon="IMPORT")


class DIRECTIONS_PT_result(_DirectionsPanel, bpy.types.Panel):  # noqa: N801
    """What came out, in words."""

    bl_label = "Result"

    @classmethod
    def poll(cls, context):
        return strokes_of(surface_object(context)) is not None

    def draw(self, context):
        layout = self.layout
        thing = surface_object(context)
        if changed_since(thing, strokes_of(thing)):
            changed = layout.column()
            changed.alert = True
            _sentence(context, changed, f"{thing.name} has changed since; compute again.")
        for line in thing.principal_directions.summary.splitlines():
            _sentence(context, layout, line)
        if thing.principal_directions.surface:
            layout.operator("principal_directions.show_exact", icon="CHECKMARK")
            for line in thing.principal_directions.comparison.splitlines():
                _sentence(context, layout, line)
        layout.operator("principal_directions.export_field", icon="EXPORT")
        layout.operator_menu_enum(
            "principal_directions.show_strength", "order", icon="SHADING_RENDERED"
        )


class DIRECTIONS_PT_drawing(_DirectionsPanel, bpy.types.Panel):  # noqa: N801
    """How the strokes look: everything acts at once."""

    bl_label = "Drawing"

    @classmethod
    def poll(cls, context):
        return _modifier(context) is not None

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        modifier = _modifier(context)
        inputs = compat.interface_inputs(modifier.node_group)
        for names in (_LOOK, _CHOICE):
            column = layout.column()
            for name in names:
                _prop(column, modifier, inputs, name)
        column = layout.column(align=True)
        column.use_property_split = False
        for name in _LIMITS:
            _prop(column, modifier, inputs, name)
        column = layout.column(align=True)
        if context.space_data.shading.type == "SOLID":
            # The dark outline of Solid shading swallows the colours of thin strokes.
            column.prop(context.space_data.shading, "show_object_outline", text="Outline in View")
        for order in modifier.id_data.get(ORDERS_KEY, ()):
            material = compat.get_input(modifier, f"Material {order}")
            row = column.row(align=True)
            _prop(row, modifier, inputs, f"Order {order}")
            if material is not None:
                colour = row.row(align=True)
                colour.ui_units_x = 2.0
                colour.prop(material, "principal_directions_colour", text="")


class DIRECTIONS_PT_point(_DirectionsPanel, bpy.types.Panel):  # noqa: N801
    """The directions of one vertex as a table."""

    bl_label = "Selected Point"
    bl_options = {"DEFAULT_CLOSED"}  # noqa: RUF012

    @classmethod
    def poll(cls, context):
        return strokes_of(surface_object(context)) is not None

    def draw(self, context):
        layout = self.layout
        thing = surface_object(context)
        if thing.mode != "EDIT":
            # Through the strokes: what is linked from another file cannot be changed.
            layout.prop(strokes_of(thing).principal_directions, "point")
        try:
            found = active_point(thing)
            if thing.mode == "EDIT":
                layout.label(text=f"Active vertex {active_vertex(thing)}", translate=False)
        except PdtheoryError as error:
            _sentence(context, layout, str(error))
            return
        column = layout.column(align=True)
        _cells(column, ("Kind", "Angle (°)", "Eigenvalue"), text_ctxt=CONTEXT)
        for order, rows in groupby(table(*found), itemgetter(0)):
            column.label(text=f"Order {order}", text_ctxt=CONTEXT)
            for _, *cells in rows:
                _cells(column, cells, translate=False)
        row = layout.row(align=True)
        row.operator("principal_directions.copy_row", icon="COPYDOWN")
        row.operator("principal_directions.show_ball", text="", icon="MESH_UVSPHERE")


class DIRECTIONS_PT_polar(_DirectionsPanel, bpy.types.Panel):  # noqa: N801
    """The polar plot of one vertex; it is drawn only while this panel is open."""

    bl_label = "Polar Plot"
    bl_parent_id = "DIRECTIONS_PT_point"
    bl_options = {"DEFAULT_CLOSED"}  # noqa: RUF012

    @classmethod
    def poll(cls, context):
        try:
            active_point(surface_object(context))
        except PdtheoryError:
            # The panel above says what is amiss.
            return False
        return True

    def draw(self, context):
        layout = self.layout
        unit = 20.0 * context.preferences.system.ui_scale
        width = context.region.width - 3.0 * unit
        columns = max(1, int(width // (_PLOT * unit)))
        try:
            icons, sentence = plots_of(surface_object(context), int(width / columns))
        except PdtheoryError as error:
            icons, sentence = (), str(error)
        if sentence:
            _sentence(context, layout, sentence)
        grid = layout.grid_flow(row_major=True, columns=columns)
        for icon in icons:
            grid.template_icon(icon, scale=width / columns / unit)
        layout.operator("principal_directions.plot_point", icon="IMAGE_DATA")


def _cells(column, texts, **how):
    """Write a row of the table: a narrow column for the kind, wider ones for the numbers."""
    row = column.split(factor=0.16)
    row.label(text=texts[0], **how)
    numbers = row.split(factor=0.43)
    for text in texts[1:]:
        numbers.label(text=text, **how)


def _sentence(context, layout, text):
    """Write a sentence in as many lines as it needs; a label alone would be cut off."""
    # Beside the tabs and margins, at the width of a letter on average and a little more.
    letters = max(
        20, int((context.region.width / context.preferences.system.ui_scale - 46.0) / 6.3)
    )
    column = layout.column(align=True)
    for line in textwrap.wrap(text, letters):
        column.label(text=line, translate=False)


def _modifier(context):
    strokes = strokes_of(context.active_object)
    return None if strokes is None else find_modifier(strokes)


def _prop(layout, modifier, inputs, name):
    owner, path = compat.input_owner(modifier, inputs[name].identifier)
    layout.prop(owner, path, text=name, text_ctxt=CONTEXT)


register, unregister = bpy.utils.register_classes_factory(
    (
        DIRECTIONS_PT_compute,
        DIRECTIONS_PT_result,
        DIRECTIONS_PT_drawing,
        DIRECTIONS_PT_point,
        DIRECTIONS_PT_polar,
    )
)
