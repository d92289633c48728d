"""Objects to compute on, and refusals, for the tests of the extension."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

QUICK = {"neighbours": 40, "degree": 4, "orders": {"2", "3"}}


def refused(operator, message, **settings):
    with pytest.raises(RuntimeError) as caught:
        operator(**settings)
    assert message in str(caught.value)
    assert "Traceback" not in str(caught.value)


def add_mesh(points, faces=(), name="object"):
    import bpy

    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(p) for p in points], [], [tuple(f) for f in faces])
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    return thing


class _Paper:
    """A layout that only notes the texts that are written on it."""

    def __init__(self):
        self.texts = []

    def __getattr__(self, name):
        return self._write

    def _write(self, *_, text=None, **__):
        if text is not None:
            self.texts.append(text)
        return self


def written(panel):
    """Return the texts of a panel, as it is drawn in a narrow sidebar."""
    import bpy

    paper = _Paper()
    context = SimpleNamespace(
        active_object=bpy.context.object,
        scene=bpy.context.scene,
        window_manager=bpy.context.window_manager,
        preferences=SimpleNamespace(system=SimpleNamespace(ui_scale=1.0)),
        region=SimpleNamespace(width=240),
        space_data=SimpleNamespace(shading=SimpleNamespace(type="SOLID")),
    )
    getattr(bpy.types, panel).draw(SimpleNamespace(layout=paper), context)
    return paper.texts
