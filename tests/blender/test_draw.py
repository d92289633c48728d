"""From a field to a picture or a Blender file, in a process apart."""

from __future__ import annotations

import signal
import subprocess
import sys
import tempfile
import time
from contextlib import nullcontext

import numpy as np
import pytest
from blender_fields import torus
from typer.testing import CliRunner

from pdtheory.blender import draw_field
from pdtheory.cli.main import app
from pdtheory.errors import Cancelled, FileAccessError, InputError, MissingDependencyError

SMALL = {"size": (96, 72), "rays": 4}


def pixels(path):
    bpy = pytest.importorskip("bpy", exc_type=ImportError)
    image = bpy.data.images.load(str(path))
    try:
        return np.array(image.pixels[:]).reshape(image.size[1], image.size[0], 4)[..., :3]
    finally:
        bpy.data.images.remove(image)


def solid(picture):
    """Return where the surface is: grey, and neither white nor in shadow."""
    light = picture.mean(axis=-1)
    return (np.ptp(picture, axis=-1) < 0.05) & (light < 0.88) & (light > 0.45)


def share(picture, colour):
    """Return the share of pixels in which one component (0 to 2) stands out clearly."""
    others = [c for c in range(3) if c != colour]
    return float((picture[..., colour] > picture[..., others].max(axis=-1) + 0.15).mean())


@pytest.mark.blender
def test_picture_shows_the_surface_on_white_with_blue_and_green_strokes(tmp_path, torus_field):
    cloud, field = torus_field
    output = tmp_path / "torus.png"
    said = []
    draw_field(
        field, cloud, output, strokes=150, progress=lambda f, text: said.append((f, text)), **SMALL
    )
    picture = pixels(output)
    assert picture.shape == (72, 96, 3)
    corners = picture[[0, 0, -1, -1], [0, -1, 0, -1]]
    assert corners == pytest.approx(np.ones((4, 3)), abs=0.02)
    assert 0.15 < solid(picture).mean() < 0.7
    assert share(picture, 2) > 0.01
    assert share(picture, 1) > 0.01
    fractions = [fraction for fraction, _ in said]
    assert fractions == sorted(fractions)
    assert fractions[-1] == 1.0
    assert list(tmp_path.iterdir()) == [output]


@pytest.mark.blender
def test_orders_that_are_not_wanted_are_not_drawn(tmp_path, torus_field):
    output = tmp_path / "torus.png"
    draw_field(torus_field[1], torus_field[0], output, orders=(3,), strokes=150, **SMALL)
    picture = pixels(output)
    assert share(picture, 2) == 0.0
    assert share(picture, 1) > 0.01


@pytest.mark.blender
def test_points_alone_show_the_shape(tmp_path, torus_field):
    output = tmp_path / "points.png"
    draw_field(torus_field[1], None, output, strokes=60, **SMALL)
    with_mesh = tmp_path / "mesh.png"
    draw_field(torus_field[1], torus_field[0], with_mesh, strokes=60, **SMALL)
    alone, below = (solid(pixels(path)) for path in (output, with_mesh))
    assert (alone & below).sum() > 0.95 * below.sum()
    assert alone.sum() < 1.3 * below.sum()


@pytest.mark.blender
def test_blend_file_holds_surface_and_strokes(tmp_path, torus_field, scene):
    import bpy

    output = tmp_path / "torus.blend"
    for _ in range(2):
        draw_field(torus_field[1], torus_field[0], output, kind="both")
        assert list(tmp_path.iterdir()) == [output]
    bpy.ops.wm.open_mainfile(filepath=str(output))
    strokes = bpy.data.objects["Principal directions"]
    assert strokes.parent.name == "torus"
    assert len(strokes.data.vertices) == sum(len(torus_field[1][k]) for k in (2, 3))
    from pdtheory.blender import compat

    assert compat.get_input(strokes.modifiers[0], "Minima")
    assert not compat.get_input(strokes.modifiers[0], "Order 4")


@pytest.mark.blender
@pytest.mark.parametrize("factor", [1e-6, 1e7])
def test_size_and_place_do_not_matter(tmp_path, torus_field, factor):
    import dataclasses

    cloud, field = torus_field
    moved = field.points * factor + factor * 1e5
    far_cloud = dataclasses.replace(cloud, points=moved)
    phi = field.phi * factor ** (1.0 - field.phi_order)
    far_field = dataclasses.replace(field, points=moved, phi=phi)
    draw_field(far_field, far_cloud, tmp_path / "far.png", strokes=60, **SMALL)
    draw_field(field, cloud, tmp_path / "near.png", strokes=60, **SMALL)
    far, near = pixels(tmp_path / "far.png"), pixels(tmp_path / "near.png")
    assert np.abs(far - near).mean() < 0.02


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"output": "picture.jpg"}, "suffix .jpg is not known"),
        ({"kind": "all"}, "kind is 'all'"),
        ({"orders": (7,)}, "order 7 was not computed"),
        ({"orders": ()}, "no directions of order"),
        ({"strokes": 0}, "strokes is 0"),
        ({"rays": 0}, "rays is 0"),
        ({"size": (8, 72)}, "8 x 72"),
        ({"up": "w"}, "'w'; give x, y or z"),
        ({"elevation": -100.0}, "elevation is -100"),
        ({"least_strength": -1.0}, "least strength is -1"),
        ({"largest_uncertainty": float("nan")}, "uncertainty is nan"),
    ],
)
def test_bad_arguments_are_refused_in_a_sentence(tmp_path, torus_field, changes, message):
    output = tmp_path / changes.pop("output", "picture.png")
    with pytest.raises(InputError, match=message):
        draw_field(torus_field[1], torus_field[0], output, **changes)
    assert not list(tmp_path.iterdir())


def test_missing_folder_is_refused(tmp_path, torus_field):
    with pytest.raises(FileAccessError, match="does not exist"):
        draw_field(torus_field[1], torus_field[0], tmp_path / "nowhere" / "picture.png")


@pytest.mark.parametrize("quiet", [False, True])
def test_the_command_says_what_it_wrote(tmp_path, torus_field, monkeypatch, quiet):
    monkeypatch.setattr("pdtheory.blender.draw.draw_field", lambda *given, **options: None)
    torus_field[1].save(tmp_path / "field.npz")
    output = tmp_path / "picture.png"
    arguments = ["draw", str(tmp_path / "field.npz"), "-o", str(output), *["-q"][: int(quiet)]]
    done = CliRunner().invoke(app, arguments)
    assert done.exit_code == 0
    assert done.stdout == ("" if quiet else f"Wrote {output}\n")


@pytest.mark.blender
@pytest.mark.parametrize("cancelled", [False, True])
def test_nothing_stays_in_the_temporary_folder(tmp_path, torus_field, monkeypatch, cancelled):
    folder = tmp_path / "temporary"
    folder.mkdir()
    for name in ("TMPDIR", "TEMP", "TMP"):
        monkeypatch.setenv(name, str(folder))
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    seen = []

    def watch(fraction, text):
        seen.extend(folder.glob("*/*"))
        if cancelled and "rendering" in text:
            raise Cancelled("stopped on request.")

    with pytest.raises(Cancelled) if cancelled else nullcontext():
        draw_field(torus_field[1], None, tmp_path / "torus.png", progress=watch, **SMALL)
    # Blender did make files of its own, in the folder that was removed.
    assert seen
    assert not list(folder.iterdir())


@pytest.mark.blender
@pytest.mark.parametrize(("suffix", "moment"), [(".png", "rendering"), (".blend", "saving")])
def test_cancelling_leaves_what_was_there(tmp_path, torus_field, suffix, moment):
    output = tmp_path / f"torus{suffix}"
    output.write_bytes(b"before")

    def cancel(fraction, text):
        if moment in text:
            raise Cancelled("stopped on request.")

    with pytest.raises(Cancelled):
        draw_field(torus_field[1], torus_field[0], output, progress=cancel)
    assert output.read_bytes() == b"before"
    assert list(tmp_path.iterdir()) == [output]


@pytest.mark.blender
@pytest.mark.skipif(sys.platform == "win32", reason="there is no SIGINT to send on Windows")
def test_interrupting_ends_at_once_and_leaves_nothing(tmp_path, torus_field):
    torus_field[1].save(tmp_path / "field.npz")
    output = tmp_path / "out" / "picture.png"
    output.parent.mkdir()
    script = (
        "import sys\n"
        "from pdtheory.blender import draw_field\n"
        "from pdtheory.pointset.field import DirectionField\n"
        "field = DirectionField.load(sys.argv[1])\n"
        "say = lambda fraction, text: print(text, flush=True)\n"
        "draw_field(field, None, sys.argv[2], rays=4000, progress=say)\n"
    )
    drawing = subprocess.Popen(
        [sys.executable, "-c", script, str(tmp_path / "field.npz"), str(output)],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    with drawing:
        for line in drawing.stdout:
            if "rendering" in line:
                break
        time.sleep(0.5)
        started = time.monotonic()
        drawing.send_signal(signal.SIGINT)
        drawing.wait(timeout=20)
    assert time.monotonic() - started < 5.0
    assert drawing.returncode != 0
    assert not list(output.parent.iterdir())


@pytest.mark.parametrize(
    ("module", "message"),
    [
        ("raise ModuleNotFoundError(\"No module named 'bpy'\", name='bpy')", "3.11 and 3.13"),
        ("raise ImportError('libXi.so.6: cannot open shared object file')", "libXi.so.6.*libxi6"),
        ("raise ImportError('undefined symbol')", "does not load .undefined symbol."),
    ],
)
def test_without_blender_one_sentence_says_what_to_install(
    tmp_path, torus_field, monkeypatch, module, message
):
    (tmp_path / "fake").mkdir()
    (tmp_path / "fake" / "bpy.py").write_text(module)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path / "fake"))
    with pytest.raises(MissingDependencyError, match=message):
        draw_field(torus_field[1], torus_field[0], tmp_path / "picture.png")
    assert not (tmp_path / "picture.png").exists()


def test_a_crash_of_blender_is_a_sentence(tmp_path, torus_field, monkeypatch):
    from pdtheory.errors import ComputationError

    (tmp_path / "bpy.py").write_text("import os\nos.abort()\n")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    with pytest.raises(ComputationError, match="exit code"):
        draw_field(torus_field[1], torus_field[0], tmp_path / "picture.png")


def test_a_process_that_ends_before_it_listens_is_a_sentence(tmp_path, monkeypatch):
    from pdtheory.errors import ComputationError

    class Ended(subprocess.Popen):
        def __init__(self, command, **rest):
            super().__init__([sys.executable, "-c", "raise SystemExit(3)"], **rest)
            self.wait()

    monkeypatch.setattr(subprocess, "Popen", Ended)
    # Large enough that Python still holds a part of it when the writing has failed.
    _, field = torus(count=(100, 50))
    with pytest.raises(ComputationError, match="exit code 3"):
        draw_field(field, None, tmp_path / "picture.png")
    assert not list(tmp_path.iterdir())
