"""``pdtheory figure``."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
import typer
from typer.testing import CliRunner

import synthetic_surfaces
from pdtheory.cli.figure import figure
from pdtheory.cli.sample import surfaces
from pdtheory.errors import FileAccessError, InputError, MissingDependencyError
from pdtheory.paper.figures import catalogue
from pdtheory.paper.figures.outcome import equal
from pdtheory.paper.figures.stage import Panel, render

APP = typer.Typer()
APP.command()(figure)


def run(*arguments: str, code: int = 0) -> str:
    result = CliRunner().invoke(APP, arguments, catch_exceptions=False)
    assert result.exit_code == code, result.output
    return result.output


def test_without_a_name_it_lists_all() -> None:
    said = run()
    for name in catalogue.NAMES:
        assert name in said


def test_data_only_writes_numbers_and_no_picture(tmp_path: Path) -> None:
    out = tmp_path / "deep" / "figures"
    said = run("astroid", "--quality", "small", "--data-only", "--quiet", "--output", str(out))
    assert "holds:" in said
    assert [path.name for path in out.iterdir()] == ["astroid.json"]


def test_the_same_seed_gives_the_same_file(tmp_path: Path) -> None:
    for folder in ("a", "b"):
        run("saddles", "--quality", "small", "--data-only", "-q", "-o", str(tmp_path / folder))
    first, second = ((tmp_path / folder / "saddles.json").read_bytes() for folder in "ab")
    assert first == second


def test_a_check_that_fails_sets_the_exit_code(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from pdtheory.paper.figures import diagrams

    monkeypatch.setattr(diagrams, "equal", lambda *rest: equal("made to fail", 1, 2, "a test"))
    said = run("deltoid", "--quality", "small", "--data-only", "-q", "-o", str(tmp_path), code=1)
    assert "FAILS: made to fail" in said


def test_refusals(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no figure 'nothing'"):
        run("nothing", "-o", str(tmp_path))
    with pytest.raises(FileAccessError, match="no folder"):
        run("head", "--models", str(tmp_path / "none"), "-o", str(tmp_path))
    (tmp_path / "file").write_text("")
    with pytest.raises(FileAccessError, match="cannot make the folder"):
        run("deltoid", "--data-only", "-q", "-o", str(tmp_path / "file" / "x"))


def test_without_blender_figures_and_thumbnails_say_what_is_missing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "bpy", None)
    panel = Panel(synthetic_surfaces.get("cube").mesh(2), [])
    with pytest.raises(MissingDependencyError, match="Blender's Python module"):
        render(panel, tmp_path / "panel.png", (8, 8), 1)
    with pytest.raises(MissingDependencyError, match="Blender's Python module"):
        surfaces("cube", tmp_path)
    assert not list(tmp_path.iterdir())


@pytest.mark.blender
def test_a_panel_replaces_the_file_only_when_it_is_done(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("bpy", exc_type=ImportError)
    from pdtheory.blender import scene

    def stop(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    target = tmp_path / "panel.png"
    target.write_text("old")
    panel = Panel(synthetic_surfaces.get("cube").mesh(2), [])
    with monkeypatch.context() as patched:
        patched.setattr(scene, "_write", stop)
        with pytest.raises(KeyboardInterrupt):
            render(panel, target, (8, 8), 1)
    assert target.read_text() == "old"
    render(panel, target, (8, 8), 1)
    assert target.read_bytes().startswith(b"\x89PNG")
    assert list(tmp_path.iterdir()) == [target]
