"""One name for one thing: the options of the commands are those of the functions."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any

import pytest

from pdtheory.blender.draw import draw_field
from pdtheory.cli.draw import draw
from pdtheory.cli.estimate import estimate
from pdtheory.cli.sample import sample
from pdtheory.cli.view import view
from pdtheory.io import read_cloud
from pdtheory.pointset.options import Options
from pdtheory.viewer import view_field, widget
from synthetic_surfaces import Surface

#: What a command reads from a file, shows or asks for by itself.
OWN = {"context", "mesh", "quiet", "source", "output", "surface", "parameter"}


def names(function: Callable[..., Any]) -> set[str]:
    return set(inspect.signature(function).parameters)


@pytest.mark.parametrize(
    ("command", "known"),
    [
        (draw, names(draw_field)),
        (view, names(view_field)),
        (estimate, {*Options.__annotations__, *names(read_cloud), "resume"}),
        (sample, {*names(Surface.sample), *names(Surface.mesh), "samples"}),
    ],
)
def test_options_of_commands_are_those_of_functions(
    command: Callable[..., Any], known: set[str]
) -> None:
    assert names(command) - OWN <= known


def test_pictures_share_their_options() -> None:
    shared = names(draw_field) & names(view_field)
    assert {"orders", "kind", "strokes", "least_strength", "largest_uncertainty", "size"} <= shared
    assert names(widget) <= names(view_field)
    assert names(draw) - names(view) == {"output", "rays", "quiet"}
    assert names(view) - names(draw) == {"screenshot"}


@pytest.mark.blender
def test_settings_of_the_panel_are_options_of_the_functions() -> None:
    pytest.importorskip("bpy", exc_type=ImportError)
    from blender_addon.properties import SETTING_NAMES
    from pdtheory.blender.source import read_object

    of_the_panel = {"source", "neighbourhood"}
    assert set(SETTING_NAMES) - of_the_panel <= {*Options.__annotations__, *names(read_object)}
