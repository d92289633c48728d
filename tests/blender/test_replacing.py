"""The extension replaced by another version while Blender runs."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.blender

ROOT = Path(__file__).parents[2]

#: What Blender does: the files of the wheel are new, the modules of the extension are forgotten.
SCRIPT = """
import importlib.metadata, sys
import bpy, blender_addon, pdtheory, synthetic_surfaces

blender_addon.register()
blender_addon.unregister()
again = sys.argv[-2]
if sys.argv[-1] == "unmarked":
    del pdtheory.loaded_by_blender_as
importlib.metadata.version = lambda name: again
for name in [n for n in sys.modules if n.partition(".")[0] == "blender_addon"]:
    sys.modules.pop(name)
names = "pdtheory", "synthetic_surfaces", "pdtheory.conventions"
before = [sys.modules[name] for name in names]
import blender_addon as new

new.register()
after = [sys.modules[name] for name in names]
assert new.inspect_point.Status is after[2].Status
new.unregister()
print("kept", sum(a is b for a, b in zip(before, after)))
"""


@pytest.mark.parametrize(
    ("version", "mark", "kept"),
    [
        ("0.1.0+other", "marked", 0),
        ("0.1.0+other", "unmarked", 0),
        ("as before", "marked", 3),
        ("as before", "unmarked", 3),
    ],
)
def test_the_library_of_another_version_is_forgotten(version, mark, kept):
    pytest.importorskip("bpy", exc_type=ImportError)
    script = SCRIPT
    if kept:
        script = script.replace("lambda name: again", "importlib.metadata.version")
    done = subprocess.run(
        [sys.executable, "-c", script, version, mark], cwd=ROOT, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    assert f"kept {kept}" in done.stdout
