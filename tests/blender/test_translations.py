"""Translations: of texts that the extension shows, and none of them empty."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

pytestmark = pytest.mark.blender

ROOT = Path(__file__).parents[2]


def texts():
    """Return every text in the source of the extension, and of the modifier that it shows."""
    sources = [ROOT / "pdtheory" / "blender" / "needles.py", *(ROOT / "blender_addon").glob("*.py")]
    return {
        node.value
        for path in sources
        if path.name != "translations.py"
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    }


def test_what_is_translated_is_shown_and_says_something():
    pytest.importorskip("bpy", exc_type=ImportError)
    from blender_addon.translations import TABLES

    assert TABLES
    shown = texts()
    for locale, table in TABLES.items():
        assert table, locale
        assert {english for _, english in table} - shown == set()
        assert not [english for (_, english), other in table.items() if not other.strip()]
