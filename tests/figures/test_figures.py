"""Every figure's check at small size, and what a run writes down."""

from __future__ import annotations

import json
import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pdtheory.errors import FileAccessError, InputError
from pdtheory.paper.figures import catalogue
from pdtheory.paper.figures.index import write_index
from pdtheory.paper.figures.models import find
from pdtheory.paper.figures.outcome import Check, Figure, Job, Outcome, at_most, equal
from pdtheory.paper.figures.run import Made, make, record

ROOT = Path(__file__).resolve().parents[2]
MODELS = Path(os.environ.get("PDTHEORY_MODELS", ROOT.parent / "shared" / "models"))

#: Figures whose small size still takes several seconds.
_LONG = {"armadillo", "head", "rocker-arm", "fandisk", "cube-noise", "error-bars", "five-planes"}


def job(**options: object) -> Job:
    return Job("small", MODELS, **options)  # type: ignore[arg-type]


def named(name: str) -> Figure:
    figure = catalogue.get(name)
    for names in figure.models:
        if not any(any(MODELS.glob(f"{model}.*")) for model in names):
            pytest.skip(f"{' or '.join(names)} is not in {MODELS}; set PDTHEORY_MODELS")
    return figure


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=[pytest.mark.slow] if name in _LONG else [])
        for name in catalogue.NAMES
    ],
)
def test_every_check_holds(name: str) -> None:
    figure = named(name)
    outcome = figure.compute(job())
    assert outcome.checks
    assert not [str(check) for check in outcome.checks if not check.holds]
    # What is written down must be plain JSON.
    json.dumps(record(figure, outcome, job()), default=float, allow_nan=False)


@pytest.mark.parametrize("name", ["saddles", "deltoid", "noise-gain"])
def test_a_seed_fixes_the_numbers(name: str) -> None:
    figure = catalogue.get(name)
    first, again = (record(figure, figure.compute(job(seed=5)), job()) for _ in range(2))
    assert json.dumps(first, default=float) == json.dumps(again, default=float)


def test_checks_can_fail() -> None:
    assert at_most("a", 1.0, 2.0, "b").holds
    assert not at_most("a", 3.0, 2.0, "b").holds
    assert not at_most("a", float("nan"), 2.0, "b").holds
    assert equal("a", 3, 3, "b").holds
    assert not equal("a", 4, 3, "b").holds
    assert "FAILS" in str(Check("a", 9.0, 0.0, 1.0, "b"))


def test_a_wrong_surface_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    from pdtheory.paper.figures import order3, saddles

    monkeypatch.setattr(saddles, "_SADDLES", (("monkey", 4, "2/5", 0.5),))
    assert not saddles.compute(job()).holds
    monkeypatch.setattr(order3, "discriminant", lambda p1, p3: -1.0)
    assert not order3.compute(job()).holds


def test_a_run_writes_numbers_pictures_and_index(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    made = list(make(["deltoid", "head"], Job("small", tmp_path / "none"), tmp_path / "out"))
    assert [each.figure.name for each in made] == ["deltoid", "head"]
    assert {path.suffix for path in made[0].pictures} == {".png", ".pdf"}
    assert all(path.stat().st_size > 1000 for path in made[0].pictures)
    numbers = json.loads((tmp_path / "out" / "deltoid.json").read_text())
    assert numbers["holds"] is True
    assert numbers["parameters"]["seed"] == 0
    page = write_index(made, Job("small"), tmp_path / "out").read_text()
    assert '<img src="deltoid.png"' in page
    assert "Skipped" in page or '<img src="head.png"' in page


def test_absent_scans_are_skipped_with_a_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("pdtheory.paper.figures.models._fetch", lambda name: None)
    monkeypatch.delenv("PDTHEORY_MODELS", raising=False)
    (made,) = make(["head"], Job("small", tmp_path), tmp_path / "out")
    assert made.outcome is None
    assert "david or igea was not found" in made.skipped
    assert made.skipped.endswith(".")
    assert isinstance(made, Made)


def test_a_scan_of_ones_own_is_found_in_the_folder_given(tmp_path: Path) -> None:
    own = tmp_path / "david.off"
    own.write_text("OFF\n")
    assert find("david", folder=tmp_path) == own
    with pytest.raises(FileAccessError, match="david was not found"):
        find("david", folder=tmp_path / "elsewhere")


def test_a_preferred_scan_takes_the_place_of_the_public_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("pdtheory.paper.figures.models._fetch", lambda name: None)
    monkeypatch.delenv("PDTHEORY_MODELS", raising=False)
    needed = catalogue.get("head").models
    assert needed == (("david", "igea"),)
    for own in ("igea.obj", "david.obj"):
        (tmp_path / own).write_text("v 0 0 0\n")
        assert find(*needed[0], folder=tmp_path).name == own
    # It is enough alone.
    (tmp_path / "igea.obj").unlink()
    shown = replace(catalogue.get("head"), compute=lambda job: Outcome([], {}, {}, None))
    monkeypatch.setattr(catalogue, "get", lambda name: shown)
    (made,) = make(["head"], Job("small", tmp_path), tmp_path / "out", data_only=True)
    assert not made.skipped


def test_unknown_figures_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="choose one of teaser"):
        list(make(["nothing"], Job("small"), tmp_path))


@pytest.mark.blender
def test_a_picture_shows_surface_and_strokes(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("bpy")
    plt = pytest.importorskip("matplotlib.pyplot")
    figure = catalogue.get("saddles")
    outcome = figure.compute(job())
    paths = figure.draw(job(), outcome, tmp_path)
    assert capfd.readouterr().out == ""  # nothing of Blender's log
    assert [path.name for path in paths] == ["saddles.png", "saddles-1.png", "saddles-2.png"]
    monkey = plt.imread(paths[1])[..., :3]
    red, green, blue = monkey[..., 0], monkey[..., 1], monkey[..., 2]
    assert share((green > red + 0.15) & (green > blue + 0.15)) > 0.005  # strokes of order 3
    assert share((abs(red - green) < 0.03) & (red > 0.4) & (red < 0.92)) > 0.1  # matt grey
    assert share(monkey.min(axis=2) > 0.97) > 0.3  # white


def share(mask: object) -> float:
    return float(np.mean(np.asarray(mask)))


def test_outcomes_hold_only_if_all_checks_do() -> None:
    good, bad = equal("a", 1, 1, "b"), equal("a", 2, 1, "b")
    assert Outcome([good], {}).holds
    assert not Outcome([good, bad], {}).holds
