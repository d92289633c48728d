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
