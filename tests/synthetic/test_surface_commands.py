"""``pdtheory sample`` and ``pdtheory surfaces``."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import typer
from typer.testing import CliRunner

import synthetic_surfaces
from pdtheory.cli.sample import sample, surfaces
from pdtheory.errors import PdtheoryError
from pdtheory.io import read_cloud

APP = typer.Typer()
APP.command("sample")(sample)
APP.command("surfaces")(surfaces)


def run(*arguments: str) -> str:
    result = CliRunner().invoke(APP, arguments, catch_exceptions=False)
    assert result.exit_code == 0, result.output
    return result.output


def test_sample_writes_what_the_library_samples(tmp_path: Path) -> None:
    path = tmp_path / "torus.ply"
    said = run(
        "sample", "torus", "-n", "500", "--noise", "0.1", "--seed", "4", "-p", "minor=1/4",
        "-p", "major=2", "-o", str(path),
    )  # fmt: skip
    assert "500 points of torus" in said
    expected = synthetic_surfaces.get("torus", major=2, minor="1/4").sample(500, noise=0.1, seed=4)
    cloud = read_cloud(path)
    np.testing.assert_array_equal(cloud.points, expected.points)
    np.testing.assert_allclose(cloud.normals, expected.normals, rtol=1e-15)


def test_sample_writes_a_mesh(tmp_path: Path) -> None:
    run("sample", "cube", "--resolution", "4", "-o", str(tmp_path / "cube.ply"))
    faces = read_cloud(tmp_path / "cube.ply").faces
    assert faces is not None
    assert len(faces) == 6 * 4 * 4 * 2


def test_surfaces_lists_every_name_and_every_parameter() -> None:
    everything = run("surfaces")
    for name in synthetic_surfaces.names():
        assert name in everything
        told = " ".join(run("surfaces", name).split())
        for parameter in synthetic_surfaces.get(name).parameters:
            assert f"{parameter.name} (" in told


@pytest.mark.blender
def test_thumbnails(tmp_path: Path) -> None:
    pytest.importorskip("bpy")
    run("surfaces", "cube", "--thumbnails", str(tmp_path / "pictures"))
    assert (tmp_path / "pictures" / "cube.png").stat().st_size > 2000


@pytest.mark.parametrize(
    "arguments",
    [
        ("sample", "nothing", "-o", "x.ply"),
        ("sample", "torus", "-p", "minor", "-o", "x.ply"),
        ("sample", "torus", "-p", "minor=9", "-o", "x.ply"),
        ("sample", "torus", "-n", "0", "-o", "x.ply"),
        ("sample", "torus", "-p", "minor=1e99999999", "-o", "x.ply"),
        ("sample", "torus", "-o", "x.abc"),
        ("sample", "torus", "-o", "no-such-folder/x.ply"),
        ("sample", "torus", "-o", "x.stl"),
        ("sample", "torus", "-o", "x.ply", "--resolution", "4", "-n", "20000"),
        ("sample", "torus", "-o", "x.ply", "--resolution", "4", "--noise", "0.1"),
        ("sample", "torus", "-o", "x.ply", "--resolution", "4", "--noise-along", "position"),
        ("sample", "torus", "-o", "x.ply", "--resolution", "4", "--outliers", "0.1"),
        ("sample", "torus", "-o", "x.ply", "--resolution", "4", "--method", "grid"),
        ("sample", "torus", "-o", "x.ply", "--resolution", "4", "--seed", "1"),
        ("surfaces", "nothing"),
    ],
)
def test_refusals(
    arguments: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(PdtheoryError):
        CliRunner().invoke(APP, arguments, catch_exceptions=False)
    assert list(tmp_path.iterdir()) == []
