"""Objects to compute on, and refusals, for the tests of the extension."""

from __future__ import annotations

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
