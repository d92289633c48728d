"""An interactive view of a direction field with PyVista, for people without Blender.

:func:`view_field` opens a window, or writes a picture of what it would show; :func:`widget` does
the same inside a notebook.
"""

from pdtheory.viewer.window import view_field, widget

__all__ = ["view_field", "widget"]
