"""The viewer off-screen: what is seen, where it lies, and how it refuses."""

from __future__ import annotations

import json
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from pdtheory.conventions import order_colour
from pdtheory.drawing.choice import Choice, check_choice
from pdtheory.drawing.view import natural_view
from pdtheory.errors import ComputationError, InputError, MissingDependencyError
from pdtheory.pointset import DirectionField, PointCloud, estimate_directions
from pdtheory.viewer.scene import FieldView
from pdtheory.viewer.strokes import Strokes, cells, discs
from pdtheory.viewer.window import view_field, widget
from tests.pointset.surfaces import torus

needs_pyvista = pytest.mark.skipif(
    find_spec("pyvista") is None,
    reason="PyVista is not installed (extra viewer)",
)


@pytest.fixture(scope="module")
def field() -> DirectionField:
    """A torus, without noise."""
    return estimate_directions(torus(3000, 1.0, 0.4, 3)[0], radius=0.3, degree=5, orders=(2, 3, 4))


@pytest.fixture(scope="module")
def strokes(field) -> Strokes:
    return Strokes.of_field(field)


@pytest.fixture
def scene(field):
    """A view of the torus, off-screen."""
    pyvista = pytest.importorskip("pyvista", reason="PyVista is not installed (extra viewer)")
    plotter = pyvista.Plotter(off_screen=True, window_size=[320, 240])
    place = natural_view(field, None)
    yield FieldView(field, None, Choice((2, 3), strokes=200), place, plotter)
    plotter.close()


def share(picture, order: int) -> float:
    """Share of the pixels whose hue is that of an order."""
    colour = np.array(order_colour(order))
    pixels = np.asarray(picture, float)[..., :3]
    norm = np.linalg.norm(pixels, axis=-1)
    cosine = pixels @ colour / np.linalg.norm(colour) / np.maximum(norm, 1e-9)
    return float(((cosine > 0.97) & (norm > 30)).mean())


def test_a_choice_decides_what_is_seen(field, strokes):
    values = strokes.data.attributes
    every = strokes.seen(Choice((3,), "both", 10**9, 0.0, np.inf))
    assert every.sum() == len(field[3].maxima) + len(field[3].minima)
    maxima = strokes.seen(Choice((3,), "max", 10**9, 0.0, np.inf))
    assert maxima.sum() == len(field[3].maxima)
    strong = strokes.seen(Choice((3,), "max", 10**9, 0.05, np.inf))
    assert strong.sum() == (field[3].maxima.strength >= 0.05).sum()
    sure = strokes.seen(Choice((3,), "max", 10**9, 0.0, 0.01))
    assert sure.sum() == (field[3].maxima.angle_std <= 0.01).sum()
    some = strokes.seen(Choice((2,), "max", 150, 0.0, np.inf))
    # The levels of the sample differ by a factor of 2^(1/3) in number.
    assert 150 / 1.3 <= len(np.unique(values["point"][some])) <= 150 * 1.3
    assert not strokes.seen(Choice(())).any()


def test_points_are_dealt_to_the_orders_that_are_on(strokes):
    seen = strokes.seen(Choice((2, 3, 4), "max", 400, 0.0, np.inf))
    point, order = (strokes.data.attributes[name][seen] for name in ("point", "order"))
    for number in np.unique(point):
        assert len(set(order[point == number].tolist())) == 1
    counts = [len(np.unique(point[order == k])) for k in (2, 3, 4)]
    assert min(counts) > 60


def test_strokes_lie_on_the_torus(strokes):
    choice = Choice((2, 3), "both", 300, 0.0, np.inf)
    lines = strokes.lines(strokes.seen(choice), choice)
    length = np.linalg.norm(lines[:, -1] - lines[:, 0], axis=1)
    ring = np.hypot(np.hypot(lines[..., 0], lines[..., 1]) - 1.0, lines[..., 2]) - 0.4
    # They float above it and follow its curvature: straight ones would leave it by s^2 / (2 r).
    assert (ring[:, 0] > 0.0).all()
    assert np.abs(ring).max() < 0.12 * length.max()
    again = cells(lines)
    assert again[:6].tolist() == [5, 0, 1, 2, 3, 4]
    assert len(again) == 6 * len(lines)


def test_discs_hide_the_back(field):
    points, faces = discs(field, None)
    assert faces.shape == (len(field), 8)
    assert points.shape == (8 * len(field), 3)
    corner = points.reshape(-1, 8, 3)
    middle = corner.mean(axis=1)
    normal = field.frames[:, 2]
    np.testing.assert_allclose(
        np.einsum("pcj,pj->pc", corner - middle[:, None], normal), 0.0, atol=1e-12
    )
    radius = np.linalg.norm(corner[:, 0] - middle, axis=1)
    assert (radius > 0.0).all()
    # Octagons about overlapping neighbours cover more area than there is.
    assert 2 * np.sqrt(2) * (radius**2).sum() > 1.5 * 4 * np.pi**2 * 0.4


def test_discs_of_a_cloud_take_the_planes_of_the_field(field):
    cloud = PointCloud(field.points[::3] * [1.0, 1.0, 1.01])
    points, faces = discs(field, cloud)
    assert faces.shape == (len(cloud), 8)
    middle = points.reshape(-1, 8, 3).mean(axis=1)
    spread = points.reshape(-1, 8, 3) - middle[:, None]
    flat = np.einsum("pcj,pj->pc", spread, field.frames[::3, 2])
    assert np.median(np.abs(flat).max(axis=1)) < 0.05 * np.abs(spread).max()
    assert np.linalg.norm(middle - cloud.points, axis=1).max() < 0.05


@needs_pyvista
def test_picture_has_the_colours_of_its_orders(field, tmp_path):
    import pyvista

    target = tmp_path / "view.png"
    view_field(field, orders=[2, 3], size=(400, 300), strokes=300, screenshot=target)
    picture = pyvista.read(target).point_data.active_scalars.reshape(300, 400, -1)
    assert share(picture, 2) > 0.003
    assert share(picture, 3) > 0.003
    # Where a blue and a green stroke meet, smoothing mixes a few cyan pixels.
    assert share(picture, 4) < 0.1 * share(picture, 2)
    assert [path.name for path in tmp_path.iterdir()] == ["view.png"]


@needs_pyvista
def test_a_mesh_is_drawn_below(field, tmp_path):
    import pyvista

    ring = pyvista.ParametricTorus(ringradius=1.0, crosssectionradius=0.4).triangulate()
    cloud = PointCloud(np.array(ring.points, float), faces=ring.regular_faces.astype(np.int64))
    target = tmp_path / "mesh.png"
    view_field(field, cloud, orders=[2], kind="both", size=(400, 300), screenshot=target)
    picture = pyvista.read(target).point_data.active_scalars.reshape(300, 400, -1)
    # The torus fills the picture from side to side, with white around it and in its hole.
    grey = (np.ptp(picture.astype(int), axis=-1) < 60) & (picture.min(axis=-1) < 250)
    columns = np.flatnonzero(grey.any(axis=0))
    assert columns[0] < 40
    assert columns[-1] > 360
    assert 0.2 < grey.mean() < 0.8


@needs_pyvista
@pytest.mark.parametrize("elevation", [-90.0, -20.0, 0.0, 55.0, 90.0])
@pytest.mark.parametrize("size", [(400, 300), (300, 400), (600, 200)])
def test_the_object_fills_the_picture_and_lies_in_its_middle(tmp_path, elevation, size):
    import pyvista

    # A long cone is far from symmetric in perspective.
    along, turn = np.random.default_rng(8).uniform(0.0, 1.0, (2, 4000))
    radius = 0.05 + 0.6 * along
    cone = np.column_stack(
        [radius * np.cos(2 * np.pi * turn), 3 * along, radius * np.sin(2 * np.pi * turn)]
    )
    shape = estimate_directions(cone, neighbours=30, degree=3, orders=(2,))
    target = tmp_path / "view.png"
    view_field(shape, up="z", elevation=elevation, azimuth=60.0, size=size, screenshot=target)
    picture = pyvista.read(target).point_data.active_scalars.reshape(*size[::-1], -1)
    inked = picture[..., :3].min(axis=-1) < 250
    margins = []
    for axis in (0, 1):
        found = np.flatnonzero(inked.any(axis=axis))
        low, high = found[0], inked.shape[1 - axis] - 1 - found[-1]
        # Discs reach a little farther than their points.
        assert abs(low - high) <= 12
        margins.append(min(low, high) / inked.shape[1 - axis])
    assert 0.0 < min(margins) <= 0.06


def test_switches_and_threshold_change_the_picture(field, scene):
    scene.add_controls()
    both = scene.plotter.screenshot(return_img=True)
    assert share(both, 2) > 0.003 < share(both, 3)
    first = scene.count()
    scene.switch(3, False)
    assert scene.choice.orders == (2,)
    scene.switch(4, True)
    assert scene.choice.orders == (2, 4)
    scene.switch(2, False)
    scene.switch(4, False)
    assert scene.count() == 0
    assert not any(name.startswith("order") for name in scene.plotter.actors)
    scene.switch(2, True)
    scene.switch(3, True)
    assert scene.count() == first
    low, high = Strokes.of_field(field).strengths()
    scene.threshold((low * high) ** 0.5)
    assert 0 < scene.count() < first
    scene.threshold(1e9)
    assert scene.count() == 0


def test_pressing_a_switch_changes_what_is_seen(scene):
    scene.add_controls()
    # PyVista moved its widgets into a place of their own.
    buttons = getattr(scene.plotter, "widgets", scene.plotter).button_widgets
    # From the bottom upwards: the highest order first.
    for button, orders in zip(buttons, [(2, 3, 4), (2, 4), (4,)], strict=True):
        state = button.GetRepresentation()
        state.SetState(1 - state.GetState())
        button.InvokeEvent("StateChangedEvent")
        assert scene.choice.orders == orders
    assert share(scene.plotter.screenshot(return_img=True), 4) > 0.003


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"orders": [7]}, "order 7 was not computed"),
        ({"kind": "most"}, "kind is 'most'"),
        ({"strokes": 0}, "strokes is 0"),
        ({"least_strength": -1.0}, "least strength is -1"),
        ({"largest_uncertainty": float("nan")}, "largest uncertainty is nan"),
        ({"size": (5, 5)}, "16 to 16384"),
        ({"screenshot": "a.jpg"}, r"\.png"),
        ({"up": "w"}, "give x, y or z"),
    ],
)
def test_bad_options_are_named(field, tmp_path, options, words):
    with pytest.raises(InputError, match=words):
        view_field(field, **{"screenshot": tmp_path / "a.png", **options})
    assert not list(tmp_path.iterdir())


@needs_pyvista
def test_nothing_left_to_show_is_said(field, tmp_path):
    with pytest.raises(InputError, match="no direction is left to show"):
        view_field(field, least_strength=1e9, screenshot=tmp_path / "a.png")
    assert not list(tmp_path.iterdir())


def test_a_field_without_directions_is_refused():
    sphere = np.random.default_rng(1).normal(size=(500, 3))
    sphere /= np.linalg.norm(sphere, axis=1, keepdims=True)
    flat = sphere * [1.0, 1.0, 0.0]
    field = estimate_directions(flat, radius=0.6, degree=2, orders=(2,))
    with pytest.raises(InputError, match="holds no directions to show"):
        Strokes.of_field(field.take(field[2].counts == 0))
    assert check_choice(
        field, orders=None, kind="max", strokes=1, least_strength=0.0, largest_uncertainty=0.1
    ).orders == (2,)


def test_without_a_display_a_window_is_refused(field, monkeypatch):
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    with pytest.raises(ComputationError, match="no display to open a window on"):
        view_field(field)


def test_absent_libraries_are_named(field, monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "pyvista", None)
    for call in (lambda: view_field(field, screenshot=tmp_path / "a.png"), lambda: widget(field)):
        with pytest.raises(MissingDependencyError, match="extra viewer"):
            call()


@needs_pyvista
def test_widget_says_what_it_needs(field):
    if find_spec("trame") is not None:
        assert "iframe" in widget(field, size=(300, 200)).value
        return
    with pytest.raises(MissingDependencyError, match="extra notebook"):
        widget(field, size=(300, 200))


#: As a kernel does: the loop is running when the widget is made, and goes on. Names are resolved
#: here only for this machine; what is asked for beyond it is written down.
CELL = """
import asyncio, gc, json, socket, sys
import pyvista
from pdtheory.pointset import DirectionField
from pdtheory.viewer import widget

local = {None, "", "localhost", "127.0.0.1", "::1", "0.0.0.0"}
beyond, resolve = [], socket.getaddrinfo

def offline(host, *arguments, **options):
    if host in local:
        return resolve(host, *arguments, **options)
    beyond.append(str(host))
    raise socket.gaierror(socket.EAI_NONAME, "Name or service not known")

socket.getaddrinfo = offline

async def cell():
    from aiohttp import ClientSession
    shared = pyvista.global_theme.trame.jupyter_server_name
    shown = widget(DirectionField.load(sys.argv[1]), size=(300, 200))
    assert pyvista.global_theme.trame.jupyter_server_name == shared
    async with ClientSession() as session, session.get(shown.src) as page:
        text = await page.text()
    await asyncio.sleep(0.5)
    gc.collect()
    print(json.dumps({"page": text, "status": page.status, "shown": shown.value, "beyond": beyond}))

asyncio.run(cell())
"""


@needs_pyvista
def test_widget_needs_no_network(field, tmp_path):
    for library in ("trame", "ipywidgets"):
        pytest.importorskip(library, reason=f"{library} is not installed (extra notebook)")
    field.save(tmp_path / "f.npz")
    # A process of its own: a server is set up once in each.
    done = subprocess.run(
        [sys.executable, "-c", CELL, tmp_path / "f.npz"],
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    assert "Traceback" not in done.stderr
    said = json.loads(done.stdout.splitlines()[-1])
    assert said["beyond"] == []
    assert said["status"] == 200
    # The page brings its own scripts.
    assert "<script" in said["page"]
    assert 'src="http' not in said["page"]
    assert "width: min(300px, 100%); height: 200px" in said["shown"]


@needs_pyvista
def test_widget_checks_its_size(field):
    with pytest.raises(InputError, match="16 to 16384"):
        widget(field, size=(5, 5))


@needs_pyvista
def test_command(field, tmp_path: Path) -> None:
    from typer.testing import CliRunner

    from pdtheory.cli.main import app

    field.save(tmp_path / "f.npz")

    def run(*arguments: object):
        return CliRunner().invoke(app, ["view", *map(str, arguments)])

    target = tmp_path / "a.png"
    shot = ["--screenshot", target, "--size", "200x150"]
    result = run(tmp_path / "f.npz", *shot, "--orders", 2)
    assert result.exit_code == 0, result.output
    assert target.read_bytes().startswith(b"\x89PNG")
    for arguments, words in (
        ([tmp_path / "absent.npz", *shot], "no such file"),
        ([tmp_path / "f.npz", *shot, "--orders", 9], "order 9 was not computed"),
        ([tmp_path / "f.npz", "--screenshot", tmp_path / "a.jpg"], ".jpg is not known"),
        ([tmp_path / "f.npz", *shot, "--mesh", tmp_path / "no.ply"], "no.ply"),
    ):
        refused = run(*arguments)
        assert refused.exit_code == 2
        assert words in refused.stderr
        assert refused.stderr.count("\n") == 1
