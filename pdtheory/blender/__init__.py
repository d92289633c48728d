"""Directions in Blender: surfaces in, strokes out, scene, camera, light and render.

:func:`draw_field` makes a picture or a Blender file from any Python. The modules below it work
inside Blender, and in any process that has imported `bpy`; only they and the extension import it.
"""

from pdtheory.blender.draw import draw_field
from pdtheory.drawing.view import View

__all__ = ["View", "draw_field"]
