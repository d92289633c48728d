"""``pdtheory estimate``, as a user meets it."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from typer.testing import Result

from pdtheory import DirectionField, PointCloud
from pdtheory.io import write_cloud

Run = Callable[..., Result]
Refused = Callable[..., str]


def test_files_and_summary(cli: Run, bumpy_cloud: Path, tmp_path: Path) -> None:
    npz, ply = tmp_path / "field.npz", tmp_path / "field.ply"
    result = cli(
        "estimate", bumpy_cloud, "-o", npz, "-o", ply,
        "--neighbours", 60, "--degree", 4, "--orders", "2:4",
    )  # fmt: skip
    assert result.exit_code == 0, result.output
    assert "600 of 600 points answered." in result.stdout
    field = DirectionField.load(npz)
    assert field.orders == (2, 3, 4)
    assert len(field) == 600
    assert ply.read_bytes().startswith(b"ply")


def test_quiet_prints_nothing(cli: Run, bumpy_cloud: Path, tmp_path: Path) -> None:
    target = tmp_path / "field.npz"
    result = cli("estimate", bumpy_cloud, "-o", target, "--degree", 2, "--orders", 2, "--quiet")
    assert (result.exit_code, result.output) == (0, "")
    assert target.exists()


def test_documented_keys(cli: Run, bumpy_cloud: Path, tmp_path: Path) -> None:
    target = tmp_path / "field.npz"
    cli("estimate", bumpy_cloud, "-o", target, "--degree", 4, "--orders", "2,3", "-q")
    with np.load(target, allow_pickle=False) as data:
        count, columns = len(data["points"]), len(data["phi_order"])
        assert int(data["schema"]) == 1
        assert data["points"].shape == (count, 3)
        assert data["frames"].shape == (count, 3, 3)
        for name in ("radius", "degree", "neighbours", "residual_rms", "condition", "status"):
            assert data[name].shape == (count,), name
        assert "TOO_FEW_NEIGHBOURS" in "".join(data["status_names"])
        assert data["phi"].shape == (count, columns)
        assert np.iscomplexobj(data["phi"])
        assert data["phi_frequency"].shape == (columns,)
        for order in (2, 3):
            rows = int(data[f"order{order}_offsets"][-1])
            assert data[f"order{order}_offsets"].shape == (count + 1,)
            assert data[f"order{order}_vector"].shape == (rows, 3)
            assert data[f"order{order}_kind"].dtype == np.int8
            for name in ("angle", "eigenvalue", "strength"):
                assert data[f"order{order}_{name}"].shape == (rows,)


def test_samples_need_and_use_faces(
    cli: Run, refused: Refused, bumpy_cloud: Path, tmp_path: Path
) -> None:
    target = tmp_path / "field.npz"
    assert "faces" in refused("estimate", bumpy_cloud, "-o", target, "--samples", 100)
    square = PointCloud(
        np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]),
        faces=np.array([[0, 1, 2], [0, 2, 3]]),
    )
    write_cloud(square, tmp_path / "square.ply")
    result = cli(
        "estimate", tmp_path / "square.ply", "-o", target, "--samples", 500, "--degree", 2,
        "--orders", 2, "--seed", 3, "-q",
    )  # fmt: skip
    assert result.exit_code == 0, result.output
    assert len(DirectionField.load(target)) == 500


def points_file(folder: Path, points: object, name: str = "points.xyz") -> Path:
    np.savetxt(folder / name, np.asarray(points, dtype=float))
    return folder / name


def test_unreadable_input(refused: Refused, tmp_path: Path) -> None:
    target = tmp_path / "field.npz"
    assert "no such file" in refused("estimate", tmp_path / "absent.ply", "-o", target)
    (tmp_path / "empty.ply").touch()
    assert "empty" in refused("estimate", tmp_path / "empty.ply", "-o", target)
    (tmp_path / "broken.ply").write_bytes(b"ply\nformat binary_little_endian 1.0\nelement vert")
    assert "broken.ply" in refused("estimate", tmp_path / "broken.ply", "-o", target)
    spoilt = points_file(tmp_path, [[0, 0, 0], [1, np.nan, 0], [0, 1, 0]])
    assert "NaN" in refused("estimate", spoilt, "-o", target)
    assert not target.exists()


@pytest.mark.parametrize("degree", [2, 10])
def test_unanswerable_input(refused: Refused, tmp_path: Path, degree: int) -> None:
    target = tmp_path / "field.npz"
    three = points_file(tmp_path, np.eye(3), "three.xyz")
    refused("estimate", three, "-o", target, "--orders", 2, "--degree", degree)
    equal = points_file(tmp_path, np.ones((500, 3)), "equal.xyz")
    refused("estimate", equal, "-o", target, "--orders", 2, "--degree", degree)
    assert not target.exists()


def test_radius_that_catches_nobody(refused: Refused, bumpy_cloud: Path, tmp_path: Path) -> None:
    target = tmp_path / "field.npz"
    message = refused("estimate", bumpy_cloud, "-o", target, "--radius", 1e-6)
    assert "catches at most 1 points" in message
    for radius in ("0", "-1", "nan", "inf"):
        assert "radius" in refused("estimate", bumpy_cloud, "-o", target, "--radius", radius)


def test_contradictory_options(refused: Refused, bumpy_cloud: Path, tmp_path: Path) -> None:
    target = tmp_path / "field.npz"
    run = ("estimate", bumpy_cloud, "-o", target)
    assert "exclude" in refused(*run, "--radius", 1, "--neighbours", 30)
    assert "5" in refused(*run, "--degree", 4, "--orders", "2:5")
    assert "degree" in refused(*run, "--degree", -1, "--orders", 2)
    assert "degree" in refused(*run, "--degree", 1000, "--orders", 2)
    assert "neighbours" in refused(*run, "--neighbours", 0)
    assert "threads" in refused(*run, "--threads", 0)
    assert not target.exists()


def test_targets(refused: Refused, bumpy_cloud: Path, tmp_path: Path) -> None:
    assert ".txt" in refused("estimate", bumpy_cloud, "-o", tmp_path / "field.txt")
    assert "create it" in refused("estimate", bumpy_cloud, "-o", tmp_path / "no" / "field.npz")


def test_interruption_leaves_what_was_there(
    cli: Run, bumpy_cloud: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    target = tmp_path / "field.npz"
    target.write_bytes(b"precious")

    def interrupt(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(np, "savez", interrupt)
    result = cli("estimate", bumpy_cloud, "-o", target, "--degree", 2, "--orders", 2, "-q")
    assert result.exit_code == 130
    assert target.read_bytes() == b"precious"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["bumpy.xyz", "field.npz"]
