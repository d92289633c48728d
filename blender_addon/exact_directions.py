# SPDX-License-Identifier: GPL-3.0-or-later
"""The exact directions of a synthetic surface, beside the estimated ones."""

import json
import re
from dataclasses import replace
from fractions import Fraction

import bpy
import numpy as np

from pdtheory.blender import compat
from pdtheory.blender.glyphs import add_modifier, find_modifier
from pdtheory.blender.result import STROKES, field_of, show_result, strokes_of
from pdtheory.blender.source import read_object
from pdtheory.comparison import compare_fields, field_of_jets
from pdtheory.drawing.glyphs import glyph_data
from pdtheory.drawing.thinning import choose_spots
from pdtheory.errors import InputError

from .jobs import JobOperator, prepare, surface_object

#: Points of the surface, beside its distinguished ones, at which the exact jets are worked out.
_POINTS = 12

#: Coordinates are taken to this denominator, so that the exact arithmetic stays quick.
_DENOMINATOR = 2**16

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
        thing = surface_object(context)
        if not thing.principal_directions.surface:
            cls.poll_message_set("Only a surface from Add > Mesh > Principal Directions has them")
            return False
        return strokes_of(thing) is not None

    def prepared(self, context):
        thing = surface_object(context)
        source = read_object(thing, evaluated=False)
        recipe = json.loads(thing.principal_directions.surface)
        orders = field_of(strokes_of(thing)).orders
        gram = source.linear.T @ source.linear
        if np.abs(gram - gram[0, 0] * np.eye(3)).max() > 1e-5 * gram[0, 0]:
            raise InputError(
                f"{thing.name} is scaled unevenly, which changes its directions; apply no scale "
                "or the same along all axes."
            )
        points = source.cloud.points @ np.linalg.inv(source.linear).T
        return prepare(thing, lambda report: _exact_field(recipe, points, orders, report), source)

    def apply(self, thing, source, exact):
        strokes = show_result(
            thing, replace(source, linear=np.eye(3), vertex=None), exact, suffix=_SUFFIX
        )
        modifier = find_modifier(strokes)
        compat.set_input(modifier, "Style", "Arrows")
        compat.set_input(modifier, "One Order Per Point", False)
        compat.set_input(modifier, "Spacing", 0.0)
        compat.set_input(modifier, "Lift", 0.15)
        mine = strokes_of(thing)
        # The estimated ones are to be seen beside them.
        estimated = find_modifier(mine) or add_modifier(mine, glyph_data(field_of(mine)), STROKES)
        scale = float(np.cbrt(abs(np.linalg.det(source.linear))))
        compat.set_input(modifier, "Length", 1.5 * compat.get_input(estimated, "Length") / scale)
        found = compare_fields(field_of(strokes_of(thing)), exact, source.linear)
        lines = [agreement.in_words() for agreement in found]
        thing.principal_directions.comparison = "\n".join(lines)
        return lines[0]


def _exact_field(recipe, points, orders, report):
    """Return the field of exact directions at the distinguished points and some others."""
    import synthetic_surfaces

    surface = synthetic_surfaces.get(recipe["name"], **recipe["parameters"])
    smooth = [site for site in surface.sites() if site.smooth]
    if not smooth:
        raise InputError(
            f"{recipe['name']} has no derivatives at its {surface.sites()[0].name}, so it has no "
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
    return [
        tuple(Fraction(round(float(c) * _DENOMINATOR), _DENOMINATOR) for c in points[i, :2])
        for i in chosen
    ]


register, unregister = bpy.utils.register_classes_factory((ShowExact,))
