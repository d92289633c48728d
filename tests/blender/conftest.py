"""Blender for the tests: a fresh file for each, and nothing registered when Python ends."""

from __future__ import annotations

import pytest
from blender_fields import torus


@pytest.fixture(scope="session")
def torus_field():
    return torus()


@pytest.fixture
def scene():
    pytest.importorskip("bpy", exc_type=ImportError)
    from pdtheory.blender.scene import new_file

    return new_file()


@pytest.fixture(scope="session")
def _registered():
    """The extension, switched on for the session: some Blenders crash if it still is at the end."""
    pytest.importorskip("bpy", exc_type=ImportError)
    import blender_addon

    blender_addon.register()
    yield
    blender_addon.unregister()


@pytest.fixture
def operators(_registered, scene):
    """The operators of the extension, in a fresh file."""
    import bpy

    return bpy.ops.principal_directions
