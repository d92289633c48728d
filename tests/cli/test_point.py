"""``pdtheory point``, as a user meets it."""

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from typer.testing import Result

from pdtheory import DirectionField, estimate_directions, read_cloud

Run = Callable[..., Result]
Refused = Callable[..., str]


@pytest.fixture
def npz(bumpy_cloud: Path, tmp_path: Path) -> Path:
    cloud = read_cloud(bumpy_cloud)
    path = tmp_path / "field.npz"
    estimate_directions(cloud, neighbours=60, degree=4, orders=(2, 3), queries=[0, 1, 2]).save(path)
    return path


def test_table(cli: Run, npz: Path) -> None:
    result = cli("point", npz, 1)
    assert result.exit_code == 0, result.output
    assert result.stdout.strip() == str(DirectionField.load(npz).at(1))
    only = cli("point", npz, 1, "--orders", 3)
    assert {line.split()[0] for line in only.stdout.splitlines()[4:]} == {"3"}


def test_json(cli: Run, npz: Path) -> None:
    data = json.loads(cli("point", npz, 2, "--json").stdout)
    assert data == json.loads(json.dumps(DirectionField.load(npz).at(2).to_dict()))


def test_plot(cli: Run, npz: Path, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib", reason="matplotlib is not installed (extra figures)")
    target = tmp_path / "point.png"
    result = cli("point", npz, 0, "--plot", target)
    assert result.exit_code == 0, result.output
    assert f"Wrote {target}" in result.stdout
    assert target.read_bytes().startswith(b"\x89PNG")
    silent = cli("point", npz, 0, "--plot", target, "--json")
    json.loads(silent.stdout)


def test_bad_input_is_one_sentence(refused: Refused, npz: Path, tmp_path: Path) -> None:
    assert "there is no point 3; the field has 3 points" in refused("point", npz, 3)
    assert "counted from 0" in refused("point", npz, "--", "-1")
    assert "order 7 was not computed" in refused("point", npz, 0, "--orders", 7)
    assert "no such file" in refused("point", tmp_path / "absent.npz", 0)
    assert ".jpg is not known" in refused("point", npz, 0, "--plot", tmp_path / "a.jpg")
    assert "does not exist" in refused("point", npz, 0, "--plot", tmp_path / "absent" / "a.png")
    for name in ("text.npz", "text.obj", "empty.npz", "short.npz", "array.npz", "pickle.bin"):
        path = tmp_path / name
        if name.startswith("text"):
            path.write_text("no field")
        elif name == "empty.npz":
            path.touch()
        elif name == "short.npz":
            path.write_bytes(npz.read_bytes()[:3000])
        else:
            with path.open("wb") as stream:
                np.save(stream, np.array([{}] if name == "pickle.bin" else [1.0]))
        message = refused("point", path, 0)
        assert message.endswith(
            f"{name} is not a direction field of pdtheory, or it is damaged; give an .npz file "
            "that pdtheory wrote."
        )
    (tmp_path / "field.csv").write_text("point,x,y,z")
    assert "give the .npz file" in refused("point", tmp_path / "field.csv", 0)
    picture = tmp_path / "field.svg"
    picture.symlink_to(npz)
    assert "is the input" in refused("point", npz, 0, "--plot", picture)
    assert not list(tmp_path.glob("*.png"))
