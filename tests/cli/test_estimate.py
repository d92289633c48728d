"""``pdtheory estimate``, as a user meets it."""

import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from typer.testing import Result

from pdtheory import DirectionField, PointCloud
from pdtheory.conventions import Status
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


def test_too_little_memory_is_one_sentence(cli: Run, refused: Refused, tmp_path: Path) -> None:
    resource = pytest.importorskip("resource")
    mesh = tmp_path / "torus.ply"
    assert cli("sample", "torus", "--resolution", 8, "-o", mesh).exit_code == 0
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    # Some systems promise any amount of memory and kill whoever uses it; this one shall refuse.
    resource.setrlimit(resource.RLIMIT_AS, (1 << 40, hard))
    try:
        for arguments in (
            ("sample", "torus", "-n", 10**12, "-o", tmp_path / "x.ply"),
            ("sample", "torus", "--resolution", 10**6, "-o", tmp_path / "x.ply"),
            ("estimate", mesh, "--samples", 10**12, "-o", tmp_path / "x.npz"),
        ):
            assert "not enough memory (Unable to allocate" in refused(*arguments)
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))
    assert list(tmp_path.iterdir()) == [mesh]


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


@pytest.mark.parametrize("radius", [1e-6, 0.5])
def test_folder_takes_another_run_after_one_that_answers_nothing(
    cli: Run, refused: Refused, tmp_path: Path, radius: float
) -> None:
    line = points_file(tmp_path, np.outer(np.linspace(0, 1, 300), [1, 2, 3]), "line.xyz")
    folder = tmp_path / "run"
    run = ("estimate", line, "-o", folder, "--degree", 2, "--orders", 2)
    for _ in range(2):
        assert "holds a run" not in refused(*run, "--radius", radius)
        assert not folder.exists()
    folder.mkdir()
    for _ in range(2):
        assert "holds a run" not in refused(*run, "--radius", radius)
        assert not list(folder.iterdir())
    plane = points_file(
        tmp_path, np.random.default_rng(0).random((300, 3)) * [1, 1, 0], "plane.xyz"
    )
    assert cli("estimate", plane, *run[2:], "--radius", 0.5, "-q").exit_code == 0


def test_radius_that_catches_nobody(refused: Refused, bumpy_cloud: Path, tmp_path: Path) -> None:
    target = tmp_path / "field.npz"
    message = refused("estimate", bumpy_cloud, "-o", target, "--radius", 1e-6)
    assert "catches at most 1 point anywhere" in message
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

    monkeypatch.setattr(np.lib.format, "write_array", interrupt)
    result = cli("estimate", bumpy_cloud, "-o", target, "--degree", 2, "--orders", 2, "-q")
    assert result.exit_code == 130
    assert target.read_bytes() == b"precious"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["bumpy.xyz", "field.npz"]


def fields_equal(one: DirectionField, two: DirectionField) -> bool:
    return (
        np.array_equal(one.points, two.points)
        and np.array_equal(one.phi, two.phi, equal_nan=True)
        and all(
            np.array_equal(one[k].vector, two[k].vector)
            and np.array_equal(one[k].angle_std, two[k].angle_std)
            for k in one.orders
        )
    )


def test_folder_holds_the_same_bits_as_a_file(
    cli: Run, refused: Refused, bumpy_cloud: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("pdtheory.pointset.stream.PART", 250)
    folder, npz = tmp_path / "run", tmp_path / "field.npz"
    options = ("--radius", "0.4", "--degree", 4, "--orders", "2,3")
    result = cli("estimate", bumpy_cloud, "-o", folder, *options)
    assert result.exit_code == 0, result.output
    assert "600 of 600 points answered." in result.stdout
    lines = result.stdout.splitlines()
    assert lines[-1] == f"Wrote 3 parts to {folder}"
    alone = cli("estimate", bumpy_cloud, "-o", npz, *options)
    # The same table and sentences.
    assert lines[:-1] == alone.stdout.splitlines()[:-1]
    assert "median strength" in alone.stdout
    assert fields_equal(DirectionField.load(folder), DirectionField.load(npz))
    shown = cli("point", folder, 431)
    assert shown.exit_code == 0, shown.output
    assert shown.stdout == cli("point", npz, 431).stdout
    assert "no point 600" in refused("point", folder, 600)
    assert "holds a run already" in refused("estimate", bumpy_cloud, "-o", folder, *options)
    message = refused("estimate", bumpy_cloud, "-o", folder, *options[:-1], "2", "--resume")
    assert "other input (orders, input differ)" in message


INTERRUPTED = """
import os, signal, sys, threading, time
from pathlib import Path
from pdtheory.cli.main import app
from pdtheory.pointset import stream

stream.PART = 2048
folder = Path(sys.argv[1])

def interrupt():
    while len(list(folder.glob("part-*.npz"))) < 2:
        time.sleep(0.001)
    print("at", time.perf_counter(), flush=True)
    os.kill(os.getpid(), signal.SIGINT)

if "--resume" not in sys.argv:
    threading.Thread(target=interrupt, daemon=True).start()
try:
    app(["estimate", *sys.argv[2:], "-o", sys.argv[1], "-q"], standalone_mode=False)
finally:
    print("ended", time.perf_counter(), flush=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="sends SIGINT")
def test_interrupted_folder_is_resumed_to_the_same_bits(cli: Run, tmp_path: Path) -> None:
    points = np.random.default_rng(3).normal(size=(12_000, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    source = tmp_path / "sphere.xyz"
    np.savetxt(source, points + 0.01 * np.sin(5 * points))
    options = (str(source), "--radius", "0.2", "--degree", "8", "--orders", "2,3,4")
    run = [sys.executable, "-c", INTERRUPTED, str(tmp_path / "run"), *options]
    stopped = subprocess.run(run, capture_output=True, text=True, timeout=300)
    assert "interrupted" in stopped.stderr, stopped.stderr
    words = stopped.stdout.split()
    assert float(words[3]) - float(words[1]) < 1.0
    before = {path.name: path.stat().st_mtime_ns for path in (tmp_path / "run").iterdir()}
    # The plan and whole parts, and no temporary file. With threads a part may overtake another.
    assert set(before) <= {"plan.json"} | {f"part-{i:06d}.npz" for i in range(6)}
    assert 3 <= len(before) < 7
    for name in sorted(before)[:-1]:
        DirectionField.load(tmp_path / "run" / name)
    subprocess.run([*run, "--resume"], check=True, timeout=300)
    after = {path.name: path.stat().st_mtime_ns for path in (tmp_path / "run").iterdir()}
    assert len(after) == 7
    assert {name: after[name] for name in before} == before
    npz = tmp_path / "field.npz"
    assert cli("estimate", *options, "-o", npz, "-q").exit_code == 0
    assert fields_equal(DirectionField.load(tmp_path / "run"), DirectionField.load(npz))


def test_folder_and_resume_are_used_together(
    refused: Refused, bumpy_cloud: Path, tmp_path: Path
) -> None:
    run = ("estimate", bumpy_cloud, "-o")
    assert "--resume goes on" in refused(*run, tmp_path / "field.npz", "--resume")
    assert "only output" in refused(*run, tmp_path / "run", "-o", tmp_path / "field.npz")
    # At once, before the input is read.
    message = refused("estimate", tmp_path / "absent.xyz", "-o", tmp_path / "no" / "run")
    assert f"the folder {tmp_path / 'no'} does not exist; create it first" in message
    assert "catches at most 1 point anywhere" in refused(*run, tmp_path / "run", "--radius", 1e-6)
    assert not (tmp_path / "run").exists()


def test_the_side_of_the_normals_can_be_asked_for(
    cli: Run, refused: Refused, bumpy_cloud: Path, tmp_path: Path
) -> None:
    npz = tmp_path / "field.npz"
    run = ("estimate", bumpy_cloud, "-o", npz, "--orders", 2, "--degree", 4, "-q")
    for orient, side in (("auto", 1), ("0,0,9", 1), ("0,0,-9", -1)):
        assert cli(*run, "--orient", orient).exit_code == 0
        assert (np.sign(DirectionField.load(npz).frames[:, 2, 2]) == side).all()
    assert cli(*run, "--orient", "none").exit_code == 0
    assert (DirectionField.load(npz).status & Status.UNORIENTED).all()
    assert "needs normals" in refused(*run, "--orient", "normals")
    assert "orient 'up' is not known" in refused(*run, "--orient", "up")
    assert "three numbers" in refused(*run, "--orient", "1,2")
    assert "write a viewpoint as x,y,z" in refused(*run, "--orient", "a,b,c")


def test_degree_and_radius_are_chosen_where_asked(
    cli: Run, refused: Refused, bumpy_cloud: Path, tmp_path: Path
) -> None:
    npz = tmp_path / "field.npz"
    run = ("estimate", bumpy_cloud, "-o", npz, "--orders", "2,3")
    assert cli(*run, "--degree", "auto", "--radius", "0.4,0.6", "-q").exit_code == 0
    field = DirectionField.load(npz)
    assert set(np.unique(field.radius)) == {0.4, 0.6}
    assert len(np.unique(field.degree)) > 1
    assert cli(*run, "--radius", "auto", "--degree", 4, "-q").exit_code == 0
    assert cli(*run, "--degree", "auto", "-q").exit_code == 0
    assert "--degree 'best'" in refused(*run, "--degree", "best")
    assert "--radius 'wide'" in refused(*run, "--radius", "wide")
    assert "write several as" in refused(*run, "--radius", "0.1,x")


def test_input_is_not_written_over(
    refused: Refused, bumpy_cloud: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    scan = tmp_path / "scan.csv"
    scan.write_text("x,y,z\n" + bumpy_cloud.read_text().replace(" ", ","))
    link, hard = tmp_path / "link.npz", tmp_path / "hard.ply"
    link.symlink_to(scan)
    hard.hardlink_to(scan)
    monkeypatch.chdir(tmp_path)
    before = scan.read_bytes()
    for output in (scan, "scan.csv", tmp_path / ".." / tmp_path.name / "scan.csv", link, hard):
        message = refused("estimate", scan, "-o", tmp_path / "field.npz", "-o", output)
        assert "is the input" in message
    assert scan.read_bytes() == before
    assert not (tmp_path / "field.npz").exists()


def test_outputs_need_names_and_folders_of_their_own(
    refused: Refused, bumpy_cloud: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for output in ("", ".", ".npz", ".PLY"):
        assert "has no name" in refused("estimate", bumpy_cloud, "-o", output)
    (tmp_path / "papers").mkdir()
    (tmp_path / "papers" / "letter.txt").touch()
    assert "such as letter.txt" in refused("estimate", bumpy_cloud, "-o", "papers")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["bumpy.xyz", "papers"]
    assert [path.name for path in (tmp_path / "papers").iterdir()] == ["letter.txt"]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full")
@pytest.mark.parametrize("command", ["estimate", "point"])
def test_answers_that_cannot_be_printed(
    cli: Run, bumpy_cloud: Path, tmp_path: Path, command: str
) -> None:
    npz = tmp_path / "field.npz"
    arguments = {
        "estimate": (str(bumpy_cloud), "-o", str(npz), "--degree", "2", "--orders", "2"),
        "point": (str(npz), "3"),
    }
    cli("estimate", *arguments["estimate"], "-q")
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(
            [sys.executable, "-m", "pdtheory", command, *arguments[command]],
            stdout=full, stderr=subprocess.PIPE, text=True, timeout=300,
        )  # fmt: skip
    assert done.returncode == 2
    last = done.stderr.splitlines()[-1]
    assert last == "pdtheory: cannot write the answer: No space left on device."
    assert "Traceback" not in done.stderr
    assert "Exception ignored" not in done.stderr


def test_finished_run_is_resumed_without_preparing(
    cli: Run, bumpy_cloud: Path, tmp_path: Path
) -> None:
    run = ("estimate", bumpy_cloud, "-o", tmp_path / "run", "--degree", 4, "--orders", 2)
    first = cli(*run)
    assert first.stdout.splitlines()[-1] == f"Wrote 1 part to {tmp_path / 'run'}"
    again = cli(*run, "--resume")
    assert again.stdout == first.stdout
    assert "every part is there" in again.stderr
    assert "preparing" not in again.stderr


def test_errors_begin_at_once(cli: Run, bumpy_cloud: Path, tmp_path: Path) -> None:
    run = ("estimate", bumpy_cloud, "-o", tmp_path / "field.npz")
    # Refused before and after the bar has moved.
    for options in (("--neighbours", 5), ("--radius", 1e-6)):
        assert not any(line == "" for line in cli(*run, *options).stderr.splitlines())


def test_a_result_without_directions_is_refused(refused: Refused, tmp_path: Path) -> None:
    corners = np.stack(np.meshgrid([0.0, 1], [0.0, 1], [0.0, 1]), axis=-1).reshape(-1, 3)
    cube = points_file(tmp_path, corners, "cube.xyz")
    (tmp_path / "there").mkdir()
    for target in (tmp_path / "field.npz", tmp_path / "run", tmp_path / "there"):
        # Eight points bear degree 2 at most.
        message = refused("estimate", cube, "-o", target, "--neighbours", 80, "--orders", 3)
        assert re.search("no fit of more than degree [12] at any of the 8 points", message)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["cube.xyz", "there"]
    assert not list((tmp_path / "there").iterdir())


def test_order_one_vanishes_in_the_tangent_frame_and_is_refused(
    refused: Refused, bumpy_cloud: Path, tmp_path: Path
) -> None:
    message = refused("estimate", bumpy_cloud, "-o", tmp_path / "field.npz", "--orders", "1,2")
    assert "give ascending orders between 2 and" in message


def test_options_without_effect_are_refused(
    refused: Refused, bumpy_cloud: Path, tmp_path: Path
) -> None:
    run = ("estimate", bumpy_cloud, "-o", tmp_path / "field.npz")
    # Also where it is the default.
    assert "--seed does nothing without --samples" in refused(*run, "--seed", 0)
