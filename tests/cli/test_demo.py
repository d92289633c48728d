"""``pdtheory demo`` from end to end, on fewer samples."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
import sympy as sp
from typer.testing import Result

from pdtheory import DirectionField, SymmetricTensor, differential_tensor, real_eigenpairs
from pdtheory.cli import demo
from pdtheory.errors import ComputationError, MissingDependencyError

Run = Callable[..., Result]


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(demo, "TORUS_SAMPLES", 8_000)
    monkeypatch.setattr(demo, "ACROSS", ("1/2",))
    monkeypatch.setattr(demo, "CUBE_SAMPLES", 3_000)


@pytest.mark.usefixtures("small")
def test_demo_without_blender(cli: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def absent(*_: object, **__: object) -> None:
        raise MissingDependencyError("bpy is absent: pip install 'pdtheory[blender]'.")

    monkeypatch.setattr("pdtheory.blender.draw_field", absent)
    result = cli("demo", "--output", tmp_path / "new" / "demo")
    assert result.exit_code == 0, result.output
    assert "Proved" in result.stdout
    assert "3,000 of 3,000 points answered." in result.stdout
    assert "No picture: bpy is absent: pip install 'pdtheory[blender]'." in result.stdout
    field = DirectionField.load(tmp_path / "new" / "demo" / "field.npz")
    assert field.orders == demo.ORDERS
    assert (tmp_path / "new" / "demo" / "field.ply").stat().st_size > 100_000


@pytest.mark.blender
@pytest.mark.usefixtures("small")
def test_demo_draws_a_model(cli: Run, bumpy_cloud: Path, tmp_path: Path) -> None:
    pytest.importorskip("bpy", reason="the bpy wheel is not installed")
    result = cli("demo", "--model", bumpy_cloud, "--output", tmp_path, "--quiet")
    assert result.exit_code == 0, result.output
    assert (tmp_path / "picture.png").read_bytes().startswith(b"\x89PNG")


def test_wrong_model_is_refused_at_once(refused: Callable[..., str], tmp_path: Path) -> None:
    message = refused("demo", "--model", tmp_path / "absent.ply", "--output", tmp_path / "demo")
    assert "no such file" in message
    assert not (tmp_path / "demo").exists()


def test_folder_that_cannot_be_made(refused: Callable[..., str], tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    assert "cannot make the folder" in refused("demo", "--output", tmp_path / "file" / "demo")


def monkey() -> SymmetricTensor:
    x, y = sp.symbols("x y")
    return differential_tensor(x**3 - 3 * x * y**2, (x, y), 3)


def test_proof_of_the_monkey_saddle() -> None:
    assert demo.prove_critical(monkey(), real_eigenpairs(monkey())).degree() == 3


def test_proof_refuses_what_is_false() -> None:
    pairs = real_eigenpairs(monkey())
    turned = monkey().turn_frame(cosine=sp.Rational(3, 5), sine=sp.Rational(4, 5))
    with pytest.raises(ComputationError):
        demo.prove_critical(turned, pairs)
    with pytest.raises(ComputationError):
        demo.prove_critical(monkey(), replace(pairs, pairs=pairs.pairs[:5]))
    with pytest.raises(ComputationError):
        demo.prove_critical(monkey() * 2, pairs)
