# SPDX-License-Identifier: GPL-3.0-or-later
"""One point: its directions as a table, its Wavejets row, its neighbourhood as a ball."""

from math import degrees, isfinite

import bmesh
import bpy

from pdtheory.blender.result import (
    BALL_KEY,
    at_samples,
    collection_of,
    field_of,
    point_of_vertex,
    strokes_of,
)
from pdtheory.blender.storage import POINTS_KEY, VERTICES_KEY
from pdtheory.conventions import Status
from pdtheory.errors import InputError, PdtheoryError
from pdtheory.pointset.words import LARGEST_ANGLE_ERROR, UNDETERMINED, largest_eigenvalue_error

from .jobs import has_result, surface_object

#: Kinds of directions in the table.
_KINDS = {1: "max", -1: "min", 0: "infl."}


def active_vertex(thing):
    """Return the active vertex in edit mode, else the one that the panel names.

    Raises
    ------
    InputError
        If no vertex is active in edit mode.
    """
    if thing.mode == "EDIT" and thing.type == "MESH":
        edited = bmesh.from_edit_mesh(thing.data)
        active = edited.select_history.active
        if not isinstance(active, bmesh.types.BMVert):
            raise InputError("no vertex is active; click one in vertex select mode.")
        # New vertices are not numbered yet.
        edited.verts.index_update()
        return active.index
    return thing.principal_directions.point


def active_point(thing):
    """Return (field, index of the point) of the active vertex.

    Raises
    ------
    InputError
        If there is no result, no active vertex, or no result at it.
    """
    strokes = strokes_of(thing)
    field = field_of(strokes)
    if thing.mode == "EDIT":
        _check_numbers(thing, strokes)
    vertex = active_vertex(thing)
    point = point_of_vertex(strokes, vertex)
    if point is None:
        raise InputError(f"vertex {vertex} has no result; choose another one.")
    return field, point


def _check_numbers(thing, strokes):
    """Refuse to look for a vertex in edit mode where its number says nothing about the result."""
    if at_samples(strokes):
        raise InputError("the result is at samples; leave edit mode and type the number of one.")
    computed = strokes[POINTS_KEY].get(VERTICES_KEY)
    count = len(bmesh.from_edit_mesh(thing.data).verts) if thing.type == "MESH" else computed
    if computed not in (None, count):
        raise InputError(
            f"{thing.name} has {count} vertices in edit mode, and {computed} where the directions "
            "were computed: it was edited since, or has modifiers; compute without them."
        )


def table(field, point):
    """Return the rows of the table: order, kind, angle in degrees and eigenvalue.

    They are short, for a sidebar that is narrow at first.
    """
    rows = []
    for order in field.orders:
        directions = field[order]
        if directions.isotropic[point]:
            rows.append((order, "all", "every angle", ""))
        part = directions.rows_of(point)
        for i in range(part.start, part.stop):
            angle, off = (degrees(a[i]) for a in (directions.angle, directions.angle_std))
            value, by = (a[i] for a in (directions.eigenvalue, directions.eigenvalue_std))
            limit = largest_eigenvalue_error(value, by, order, field.radius[point])
            rows.append(
                (
                    order,
                    _KINDS[int(directions.kind[i])],
                    _with_error(f"{angle:.1f}", off, LARGEST_ANGLE_ERROR),
                    _with_error(_number(value, 4), by, limit),
                )
            )
    return rows


def _with_error(number, error, limit):
    """Return a number and its deviation, alone if none is known, or that the number is unknown."""
    if not isfinite(error):
        return number
    return UNDETERMINED if error > limit else f"{number} ± {_uncertainty(error)}"


def _number(value, digits):
    """Write a number with so many digits, its exponent without sign and zeros that say nothing."""
    mantissa, e, exponent = f"{value:.{digits}g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if e else mantissa


def _uncertainty(value):
    return _number(value, 1 if value < 1.0 else 2 if value < 100.0 else 3)


def wavejets_row(field, point):
    """Return the Wavejets coefficients of a point as text, a line for each order and frequency."""
    lines = [f"# radius {field.radius[point]:.9g}, status {Status(int(field.status[point]))!r}"]
    for k, n, value in zip(field.phi_order, field.phi_frequency, field.phi[point], strict=True):
        lines.append(f"phi_{k}_{n} = {value.real:.12g} {value.imag:+.12g}i")
    return "\n".join(lines)


class CopyRow(bpy.types.Operator):
    """Copy the Wavejets coefficients of the active vertex to the clipboard"""

    bl_idname = "principal_directions.copy_row"
    bl_label = "Copy Wavejets Row"

    @classmethod
    def poll(cls, context):
        return has_result(cls, context)

    def execute(self, context):
        try:
            found = active_point(surface_object(context))
        except PdtheoryError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        context.window_manager.clipboard = wavejets_row(*found)
        self.report({"INFO"}, "The Wavejets row is on the clipboard")
        return {"FINISHED"}


class ShowBall(bpy.types.Operator):
    """Show the neighbourhood of the active vertex as a ball, or hide it again"""

    bl_idname = "principal_directions.show_ball"
    bl_label = "Show Neighbourhood"
    bl_options = {"UNDO"}  # noqa: RUF012

    @classmethod
    def poll(cls, context):
        return has_result(cls, context)

    def execute(self, context):
        thing = surface_object(context)
        strokes = strokes_of(thing)
        for child in [child for child in strokes.children if BALL_KEY in child]:
            bpy.data.objects.remove(child)
            return {"FINISHED"}
        try:
            field, point = active_point(thing)
        except PdtheoryError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        ball = bpy.data.objects.new(f"{thing.name} neighbourhood", None)
        ball[BALL_KEY] = True
        ball.empty_display_type = "SPHERE"
        ball.empty_display_size = float(field.radius[point])
        ball.parent = strokes
        ball.location = field.points[point].tolist()
        collection_of(strokes).objects.link(ball)
        return {"FINISHED"}


register, unregister = bpy.utils.register_classes_factory((CopyRow, ShowBall))
