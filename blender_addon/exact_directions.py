# SPDX-License-Identifier: GPL-3.0-or-later
"""The exact directions of a synthetic surface, beside the estimated ones."""

import json
import re
from dataclasses import replace
from fractions import Fraction

import bpy
import numpy as np

import synthetic_surfaces
from pdtheory.blender import compat
from pdtheory.blender.glyphs import add_modifier, find_modifier
from pdtheory.blender.matching import is_similarity, on_surface, same_points
from pdtheory.blender.result import STROKES, field_of, show_result, strokes_of
from pdtheory.blender.source import linear_part, read_object
from pdtheory.comparison import compare_fields, field_of_jets
from pdtheory.drawing.glyphs import glyph_data
from pdtheory.drawing.thinning import choose_spots
from pdtheory.errors import InputError

from .jobs import JobOperator, has_result, prepare, surface_object

#: Points of the surface, beside its distinguished ones, at which the exact jets are worked out.
_POINTS = 12

#: Coordinates are taken to so many binary digits, so that the exact arithmetic stays quick.
_DIGITS = 16

_SUFFIX = " exact"

#: Formulas without functions: their jets at rational points are quick.
_POLYNOMIAL = re.compile(r"[0-9xy+\-*/(). ]*")


class ShowExact(JobOperator, bpy.types.Operator):
    """Work out the exact directions at some points and measure how far the estimated ones are"""

    bl_idname = "principal_directions.show_exact"
    bl_label = "Show Exact Directions"

    @classmethod
    def poll(cls, context):
        if not super().poll(context):
            return False
        if not surface_object(context).principal_directions.surface:
            cls.poll_message_set("Only a surface from Add > Mesh > Principal Directions has them")
            return False
        return has_result(cls, context)

    def prepared(self, context):
        thing = surface_object(context)
        strokes = strokes_of(thing)
        estimated = field_of(strokes)
        name = thing.name
        recipe = json.loads(thing.principal_directions.surface)
        if "resolution" not in recipe:
            raise InputError(
                f"{name} was added by an older version of the extension, which did not note its "
                "resolution; add it anew and compute there."
            )
        source = read_object(thing, evaluated=False)
        computed = np.linalg.inv(linear_part(strokes.matrix_parent_inverse))
        if not (is_similarity(source.linear) and is_similarity(computed)):
            raise InputError(
                f"{name} is scaled unevenly, which changes its directions; give it the same "
                "scale along all axes, and compute again."
            )
        mesh = source.cloud.points @ np.linalg.inv(source.linear).T
        places = estimated.points @ np.linalg.inv(computed).T

        def work(report):
            surface = synthetic_surfaces.get(recipe["name"], **recipe["parameters"])
            made = surface.mesh(recipe["resolution"])
            if not same_points(made.points, mesh):
                raise InputError(
                    f"the mesh of {name} is no longer the one that was added: it was edited, "
                    "or a transform or modifier was applied; add it anew and compute there."
                )
            if not on_surface(places, made.points, made.faces):
                raise InputError(
                    f"the directions were not computed on the mesh of {name} as it was "
                    "added; compute again, without modifiers that move vertices."
                )
            exact = _exact_field(surface, mesh, estimated.orders, report)
            return exact, compare_fields(estimated, exact, computed)

        return prepare(thing, work, (source, computed))

    def apply(self, thing, extra, result):
        source, computed = extra
        exact, found = result
        mine = strokes_of(thing)
        field = field_of(mine)
        # The estimated ones are to be seen beside them.
        estimated = find_modifier(mine) or add_modifier(mine, glyph_data(field), STROKES)
        strokes = show_result(
            thing, replace(source, linear=np.eye(3), vertex=None), exact, suffix=_SUFFIX
        )
        modifier = find_modifier(strokes)
        compat.set_input(modifier, "Style", "Arrows")
        compat.set_input(modifier, "One Order Per Point", False)
        compat.set_input(modifier, "Spacing", 0.0)
        compat.set_input(modifier, "Lift", 0.15)
        scale = float(np.cbrt(abs(np.linalg.det(computed))))
        compat.set_input(modifier, "Length", 1.5 * compat.get_input(estimated, "Length") / scale)
        lines = [agreement.in_words() for agreement in found]
        if found[0].apart:
            lines.append(
                f"Without a computed point, left out: {found[0].apart} of {len(exact)} places."
            )
        thing.principal_directions.comparison = "\n".join(lines)
        return lines[0]


def _exact_field(surface, points, orders, report):
    """Return the field of exact directions at the distinguished points and some others."""
    smooth = [site for site in surface.sites() if site.smooth]
    if not smooth:
        raise InputError(
            f"{surface.name} has no derivatives at its {surface.sites()[0].name}, so it has no "
            "exact directions there; compare on a smooth surface."
        )
    wanted = [(site, None) for site in smooth]
    described = smooth[0].description
    if described.kind == "height" and all(map(_POLYNOMIAL.fullmatch, described.expressions)):
        wanted += [(smooth[0], at) for at in _places(points)]
    jets = []
    for i, (site, at) in enumerate(wanted):
        report(i / len(wanted), "exact directions")
        jets.append(site.jet(max(orders), at=at))
    return field_of_jets(jets, orders, report)


def _places(points):
    """Return rational (x, y) of some vertices, spread over the inner part of the surface."""
    centre = (points.min(axis=0) + points.max(axis=0)) / 2.0
    half = np.ptp(points[:, :2], axis=0).max() / 2.0
    inner = np.linalg.norm(points[:, :2] - centre[:2], axis=1) < 0.7 * half
    spots = choose_spots(points, inner)
    chosen = np.argsort(-spots.spacing)[: min(_POINTS, int(inner.sum()))]
    step = Fraction(2) ** (int(np.floor(np.log2(half))) - _DIGITS)
    return [tuple(round(float(c) / float(step)) * step for c in points[i, :2]) for i in chosen]


register, unregister = bpy.utils.register_classes_factory((ShowExact,))
