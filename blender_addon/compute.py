# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators that compute directions, and those that help to choose the neighbourhood."""

from types import SimpleNamespace

import bpy

from pdtheory.blender.needles import needle_group
from pdtheory.blender.proposal import propose_radius
from pdtheory.blender.result import describe, replaceable_strokes, show_result
from pdtheory.blender.source import fingerprint, read_object
from pdtheory.drawing.glyphs import glyph_data
from pdtheory.errors import InputError, PdtheoryError

from .jobs import JobOperator, has_points, prepare, surface_object
from .preferences import thread_count
from .properties import SETTING_NAMES, ComputeSettings


class Compute(ComputeSettings, JobOperator, bpy.types.Operator):
    """Compute the principal directions of the active object"""

    bl_idname = "principal_directions.compute"
    bl_label = "Compute Directions"

    def prepared(self, context):
        settings = settings_of(self, context.scene.principal_directions)
        if not settings.orders:
            raise InputError("no order is chosen; choose at least one.")
        thing = surface_object(context)
        # Refused now, and not after a while.
        replaceable_strokes(thing)
        source = read_source(thing, settings)
        # Built now and not together with the result: neither step may hold up the window.
        needle_group()
        by_radius = settings.neighbourhood == "RADIUS"
        options = {
            "radius": settings.radius if by_radius else None,
            "neighbours": None if by_radius else settings.neighbours,
            "degree": settings.degree,
            "orders": sorted(int(order) for order in settings.orders),
            "norm": settings.norm,
            "non_finite": "drop",
            "threads": thread_count(),
        }

        def work(report):
            # The import alone takes seconds.
            report(0.0, "loading the libraries")
            from pdtheory.pointset.estimate import estimate_directions

            field = estimate_directions(source.cloud, progress=report, **options)
            report(1.0, "laying out the strokes")
            return field, glyph_data(field)

        read = fingerprint(thing, evaluated=settings.evaluated)
        return prepare(thing, work, (source, settings.evaluated, read))

    def apply(self, thing, extra, result):
        source, evaluated, read = extra
        field, data = result
        edited = fingerprint(thing, evaluated=evaluated) != read
        show_result(thing, source, field, data)
        lines = describe(field, loose=source.loose)
        if edited:
            lines.insert(0, f"{thing.name} was edited meanwhile; compute again.")
        thing.principal_directions.summary = "\n".join(lines)
        thing.principal_directions.comparison = ""
        return lines[0]


class ProposeRadius(bpy.types.Operator):
    """Propose a radius that holds enough points for the degree, from the spacing of the points"""

    bl_idname = "principal_directions.propose_radius"
    bl_label = "Propose Radius"
    bl_options = {"UNDO"}  # noqa: RUF012

    @classmethod
    def poll(cls, context):
        return has_points(cls, context)

    def execute(self, context):
        settings = context.scene.principal_directions
        try:
            source = read_source(surface_object(context), settings)
            settings.radius = propose_radius(source.cloud.points, settings.degree)
        except PdtheoryError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        settings.neighbourhood = "RADIUS"
        return {"FINISHED"}


def read_source(thing, settings):
    """Read the points of an object as the settings say."""
    return read_object(
        thing,
        evaluated=settings.evaluated,
        samples=settings.samples if settings.source == "SAMPLES" else None,
        seed=settings.seed,
    )


def settings_of(operator, panel):
    """Return the settings an operator was given, and those of the panel for the others.

    Giving a radius, a number of neighbours or of samples says that it is meant.
    """
    given = {name for name in SETTING_NAMES if operator.properties.is_property_set(name)}
    values = {name: getattr(operator if name in given else panel, name) for name in SETTING_NAMES}
    if "neighbourhood" not in given:
        if "radius" in given:
            values["neighbourhood"] = "RADIUS"
        elif "neighbours" in given:
            values["neighbourhood"] = "NEIGHBOURS"
    if "source" not in given and "samples" in given:
        values["source"] = "SAMPLES"
    return SimpleNamespace(**values)


register, unregister = bpy.utils.register_classes_factory((Compute, ProposeRadius))
