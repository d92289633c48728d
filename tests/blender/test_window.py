"""A real Blender with its window: the zip installed, the button clicked, the picture looked at.

The environment variable PDTHEORY_REAL_BLENDER names a program that runs Blenders on a virtual
screen: ``PROGRAM root SUITE`` prints the folder of one, ``PROGRAM run SUITE ARG...`` runs its
Blender with ``srv`` below that folder as home, and ``PROGRAM shell SUITE COMMAND`` a command there.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from pdtheory.conventions import order_colour

pytestmark = [pytest.mark.gui, pytest.mark.blender]

PROGRAM = os.environ.get("PDTHEORY_REAL_BLENDER")
DRIVER = Path(__file__).parent / "gui" / "drive.py"


def call(*words, timeout=900):
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, timeout=timeout)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module", params=["sid", "trixie"])
def blender(request, tmp_path_factory):
    """A Blender with the freshly built extension; gives its name and its home."""
    if not PROGRAM:
        pytest.skip("PDTHEORY_REAL_BLENDER is not set")
    from pdtheory.blender.packaging import build_zip, runtime_for

    suite = request.param
    home = Path(call("root", suite).strip()) / "srv"
    if not (home.parent / "usr" / "bin" / "blender").exists():
        pytest.skip(f"there is no Blender in {suite}")
    python = call(
        "shell", suite, "python3 -c 'import sys; print(\"%d.%d\" % sys.version_info[:2])'"
    ).strip()
    runtime = runtime_for(python)
    if suite == "trixie":
        # Blender 4.3 with the Python of a later one.
        from dataclasses import replace

        runtime = replace(runtime, blender_min="4.2.0")
    package = build_zip(runtime, "linux-x64", tmp_path_factory.mktemp("dist"))
    shutil.copy(package, home / "extension.zip")
    call(
        "shell",
        suite,
        "blender --command extension install-file --repo user_default --enable /srv/extension.zip",
    )
    shutil.copy(DRIVER, home / "drive.py")
    return suite, home


def play(blender, scenario):
    """Let the driver act, and return its report and the folder of its screenshots."""
    suite, home = blender
    folder = home / "pdtheory-out"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    window = ("--window-geometry", "0", "0", "1280", "800")
    call("run", suite, *window, "--python", "/srv/drive.py", "--", "/srv/pdtheory-out", scenario)
    report = json.loads((folder / "report.json").read_text())
    assert "error" not in report, report["error"]
    return report, folder


def picture(path):
    bpy = pytest.importorskip("bpy", exc_type=ImportError)
    image = bpy.data.images.load(str(path))
    try:
        return np.array(image.pixels[:]).reshape(image.size[1], image.size[0], 4)[::-1, :, :3]
    finally:
        bpy.data.images.remove(image)


def tinted(pixels):
    """Return the share of clearly blue, and of clearly green, pixels of the 3D view."""
    inside = pixels[100:700, 60:700]
    red, green, blue = np.moveaxis(inside, -1, 0)
    return (
        float((blue > np.maximum(red, green) + 0.08).mean()),
        float((green > np.maximum(red, blue) + 0.04).mean()),
    )


def test_compute_by_mouse_undo_and_redo(blender):
    report, folder = play(blender, "compute")
    assert "points answered" in report["summary"]
    assert report["strokes"] == ["monkey directions"]
    assert report["after_undo"] == []
    assert report["after_redo"] == ["monkey directions"]
    blue, green = tinted(picture(folder / "result.png"))
    assert blue > 0.002
    assert green > 0.002


def test_the_window_lives_while_a_hundred_thousand_vertices_are_computed(blender):
    report, _ = play(blender, "large")
    assert report["vertices"] > 100_000
    assert report["strokes"]
    gaps = [gap for gap in report["gaps"] if gap is not None]
    assert max(gaps) < 0.5
    assert report["seconds"] < 20.0


def test_eevee_renders_surface_and_strokes(blender):
    report, folder = play(blender, "eevee")
    assert report["strokes"] == ["monkey directions"]
    red, green, blue = np.moveaxis(picture(folder / "eevee.png"), -1, 0)
    assert (blue > np.maximum(red, green) + 0.08).mean() > 0.002
    assert (green > np.maximum(red, blue) + 0.04).mean() > 0.002


def test_the_panel_shows_the_polar_plots_of_a_vertex(blender):
    report, folder = play(blender, "polar")
    left, top, right, bottom = report["sidebar"]

    def share(name, order):
        inside = picture(folder / f"{name}.png")[top:bottom, left:right]
        # Curves and rays have the colour of their order, a thousandth of the pixels; the rest is
        # white, grey and pale.
        off = np.abs(inside - np.array(order_colour(order))).max(axis=-1)
        return float((off < 0.2).mean())

    for name in ("saddle", "elsewhere"):
        assert share(name, 2) > 5e-4
        assert share(name, 3) > 5e-4
    for name in ("nowhere", "no_vertex"):
        assert share(name, 2) == share(name, 3) == 0.0
    assert picture(folder / "image.png").shape == (610, 960, 3)


def test_escape_ends_it_within_a_second(blender):
    report, _ = play(blender, "escape")
    assert report["escape_seconds"] < 1.0
    assert not report["strokes"]


@pytest.mark.parametrize("scenario", ["deleted", "new_file"])
def test_what_happens_meanwhile_does_no_harm(blender, scenario):
    report, _ = play(blender, scenario)
    assert not report["strokes"]
