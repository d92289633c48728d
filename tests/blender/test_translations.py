"""Translations: of all that the extension shows, and of nothing else."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

pytestmark = pytest.mark.blender

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def tables():
    pytest.importorskip("bpy", exc_type=ImportError)
    from blender_addon.translations import TABLES

    assert TABLES
    return TABLES


def texts():
    """Return every text in the source of the extension, and of the modifier that it shows."""
    from pdtheory.drawing.glyphs import ORDERS

    sources = [ROOT / "pdtheory" / "blender" / "needles.py", *(ROOT / "blender_addon").glob("*.py")]
    found = {
        node.value
        for path in sources
        if path.name != "translations.py"
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    }
    return found | {f"Order {order}" for order in ORDERS}


def looked_up():
    """Return (context, text) of what Blender looks up: names and tips of what is registered."""
    import bpy

    from blender_addon.add_mesh import AddSynthetic
    from blender_addon.panels import _CHOICE, _LIMITS, _LOOK
    from blender_addon.translations import CONTEXT

    found = {(CONTEXT, text) for text in (*_LOOK, *_CHOICE, *_LIMITS)}
    for name in dir(bpy.types):
        each = getattr(bpy.types, name)
        # The surfaces have names of their own.
        if not getattr(each, "__module__", "").startswith("blender_addon") or issubclass(
            each, AddSynthetic
        ):
            continue
        operator = issubclass(each, bpy.types.Operator)
        found.add(("Operator" if operator else "*", getattr(each, "bl_label", "")))
        found.add(("*", each.__doc__ if operator else getattr(each, "bl_category", "")))
        for base in each.__mro__:
            for deferred in vars(base).get("__annotations__", {}).values():
                found |= of_property(getattr(deferred, "keywords", {}))
    # What is put together, such as "Order 2", is tried below.
    known = texts()
    return {(context, text) for context, text in found if text in known and text.strip("23")}


def of_property(about):
    """Return (context, text) of a property, of which those without a name are not shown."""
    if "name" not in about:
        return set()
    context = about.get("translation_context", "*")
    items = about.get("items", ())
    named = [(about["name"], about.get("description", ""))]
    named += [item[1:3] for item in (items if isinstance(items, tuple) else ())]
    return {(context, name) for name, _ in named} | {("*", tip) for _, tip in named}


def test_all_that_is_shown_is_translated(tables, operators):
    from blender_addon.translations import CONTEXT

    wanted = looked_up() | {
        (CONTEXT, text) for text in ("Order 2", "Order 8", "Kind", "Angle (°)", "Eigenvalue")
    }
    assert {("Operator", "Compute Directions"), ("*", "Fast; for clean surfaces")} <= wanted
    for locale, table in tables.items():
        assert sorted(wanted - set(table)) == [], locale


def test_what_is_translated_is_shown_and_says_something(tables):
    known = texts()
    for locale, table in tables.items():
        assert table, locale
        assert {english for _, english in table} - known == set()
        assert not [english for (_, english), other in table.items() if not other.strip()]
