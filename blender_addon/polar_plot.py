# SPDX-License-Identifier: GPL-3.0-or-later
"""The polar plot of g_k at the active vertex: live in the panel, and as an image to keep."""

import bpy
import bpy.utils.previews
import numpy as np

from pdtheory.blender.background import Job
from pdtheory.blender.result import strokes_of
from pdtheory.blender.storage import POINTS_KEY
from pdtheory.errors import PdtheoryError
from pdtheory.plots.polar import figure_pixels, polar_figure

from .inspect_point import active_point
from .jobs import JobOperator, prepare, redraw, surface_object

#: Seconds between two looks at the plots that are being drawn.
_INTERVAL = 0.05

#: Least and most pixels of a plot in the panel; larger icons Blender does not draw.
_SIDES = (64, 2000)

#: Pixels of an inch in an image.
_DPI = 200


class _Plots:
    """The plots in the panel, an icon for each order, drawn again when something else is wanted.

    matplotlib works on a thread, since a panel that is being drawn must not wait.
    """

    def __init__(self):
        self.icons = bpy.utils.previews.new()
        self.shown = None
        self.sentence = ""
        self._job = None
        self._wanted = None
        # Blender knows a timer by the object it was given, and each `self._look` is another one.
        self._timer = self._look

    def want(self, key, field, side):
        """Begin to draw the plots of a point, unless they are there or others are being drawn."""
        if key == self.shown or self._job is not None:
            return
        terms = field.at(key[1]).polar_terms()
        self._wanted = key
        self._job = Job(lambda report: _pictures(terms, side))
        self._job.start()
        bpy.app.timers.register(self._timer, first_interval=_INTERVAL, persistent=True)

    def _look(self):
        """Take the plots over once they are drawn; the panel then asks anew if it wants others."""
        if not self._job.done:
            return _INTERVAL
        job, self._job = self._job, None
        self.shown = self._wanted
        self.icons.clear()
        self.sentence = ""
        try:
            for order, picture in job.result():
                _fill(self.icons.new(str(order)), picture)
        except PdtheoryError as error:
            self.sentence = str(error)
        redraw()
        return None

    def close(self):
        """Give back the icons."""
        if bpy.app.timers.is_registered(self._timer):
            bpy.app.timers.unregister(self._timer)
        bpy.utils.previews.remove(self.icons)


_plots = None


def plots_of(thing, side):
    """Return (icons, sentence) of the plots at the active vertex, and have missing ones drawn.

    Parameters
    ----------
    thing
        The surface.
    side
        Pixels of a plot.

    Raises
    ------
    PdtheoryError
        If there is no vertex, no result at it, or nothing to plot.
    """
    field, point = active_point(thing)
    side = min(max(side, _SIDES[0]), _SIDES[1])
    key = (strokes_of(thing)[POINTS_KEY].session_uid, point, side)
    _plots.want(key, field, side)
    # Plots of another size will do until the new ones are there.
    if _plots.shown is None or _plots.shown[:2] != key[:2]:
        return [], "Drawing ..."
    return [icon.icon_id for icon in _plots.icons.values()], _plots.sentence


def _pictures(terms, side):
    """Return (order, picture) for each term; the longer side of a picture is given."""
    figures = [polar_figure([term]) for term in terms]
    return [
        (term.order, figure_pixels(figure, side / max(figure.get_size_inches())))
        for term, figure in zip(terms, figures, strict=True)
    ]


def _fill(preview, picture):
    """Put a picture into an icon: whole pixels as numbers, from the bottom row upwards."""
    height, width = picture.shape[:2]
    preview.image_size = (width, height)
    preview.image_pixels.foreach_set(np.ascontiguousarray(picture[::-1]).view(np.int32).ravel())


class PlotPoint(JobOperator, bpy.types.Operator):
    """Draw the polar plot of the active vertex into an image, to look at closely and to save"""

    bl_idname = "principal_directions.plot_point"
    bl_label = "Plot as Image"

    def prepared(self, context):
        thing = surface_object(context)
        field, point = active_point(thing)
        found = field.at(point)
        # Refused now, and not after a while.
        found.polar_terms()
        return prepare(thing, lambda report: figure_pixels(found.plot(), _DPI))

    def apply(self, thing, _, picture):
        name = f"{thing.name} polar plot"
        height, width = picture.shape[:2]
        image = bpy.data.images.get(name)
        if image is None:
            image = bpy.data.images.new(name, width, height)
        image.scale(width, height)
        image.pixels.foreach_set((picture[::-1].astype(np.float32) / 255.0).ravel())
        image.pack()
        image.update()
        for window in bpy.context.window_manager.windows:
            for area in window.screen.areas:
                if area.type == "IMAGE_EDITOR":
                    area.spaces.active.image = image
        return f"Drew the image {image.name!r}; look at it in an image editor"


def register():
    global _plots
    _plots = _Plots()
    bpy.utils.register_class(PlotPoint)


def unregister():
    global _plots
    bpy.utils.unregister_class(PlotPoint)
    _plots.close()
    _plots = None
