"""Runs inside a real Blender with a window: acts as a user would, and writes down what happened.

Usage: blender --python drive.py -- FOLDER SCENARIO
The folder receives screenshots and `report.json`. Mouse and keys come from xdotool, so that every
event goes through the window system.
"""

import json
import os
import subprocess
import sys
import time
import traceback
from pathlib import Path

import bpy
from mathutils import Euler

FOLDER = Path(sys.argv[sys.argv.index("--") + 1])
SCENARIO = sys.argv[sys.argv.index("--") + 2]
LOUD = (1.0, 0.0, 1.0)
report = {"gaps": []}


def stolen():
    """Seconds that the host of a virtual machine took from its processors, all together."""
    try:
        return int(Path("/proc/stat").read_text().split()[8]) / os.sysconf("SC_CLK_TCK")
    except OSError:
        return 0.0


def paint_buttons(colour):
    """Give all operator buttons a colour that can be found in a screenshot."""
    bpy.context.preferences.themes[0].user_interface.wcol_tool.inner = (*colour, 1.0)


def shot(name):
    path = FOLDER / f"{name}.png"
    subprocess.run(["import", "-window", "root", str(path)], check=True)
    return path


def pixels(path):
    image = bpy.data.images.load(str(path))
    import numpy as np

    values = np.array(image.pixels[:]).reshape(image.size[1], image.size[0], 4)[::-1, :, :3]
    bpy.data.images.remove(image)
    return values


def loud_button():
    """Return the place of the highest button in the loud colour, None if there is none."""
    import numpy as np

    picture = pixels(shot("search"))
    loud = (picture[..., 0] > 0.8) & (picture[..., 1] < 0.25) & (picture[..., 2] > 0.8)
    rows = loud.sum(axis=1)
    best, height = None, 0
    start = None
    for y, wide in enumerate([*(rows > 60), False]):
        if wide and start is None:
            start = y
        elif not wide and start is not None:
            if y - start > height:
                best, height = (start + y) // 2, y - start
            start = None
    if best is None or height < 24:
        return None
    columns = np.flatnonzero(loud[best])
    return int(columns.mean()), best


def xdotool(*words):
    subprocess.run(["xdotool", *map(str, words)], check=True)


def view():
    area = next(a for a in bpy.context.window.screen.areas if a.type == "VIEW_3D")
    return area, next(r for r in area.regions if r.type == "WINDOW")


def open_tab():
    """Open the sidebar and click along its tabs until the Compute button shows."""
    area, _ = view()
    area.spaces.active.show_region_ui = True
    area.tag_redraw()
    yield 1.0
    sidebar = next(r for r in area.regions if r.type == "UI")
    # Blender counts from the bottom of its window, the screen from the top.
    edge = sidebar.x + sidebar.width - 12
    top = bpy.context.window.height - (sidebar.y + sidebar.height)
    for down in (250, 230, 210, 270, 290, 190, 170, 310, 150, 330):
        xdotool("mousemove", edge, top + down)
        yield 0.3
        xdotool("click", 1)
        # A second click on the same tab would close it again: leave time to see the first.
        for _ in range(6):
            yield 0.5
            if loud_button() is not None:
                return
    raise RuntimeError("the tab is not to be found")


def prepare(resolution):
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    bpy.ops.principal_directions.add_monkey(resolution=resolution)
    area, region = view()
    area.spaces.active.overlay.show_floor = False
    area.spaces.active.shading.light = "STUDIO"
    area.spaces.active.shading.color_type = "MATERIAL"
    area.spaces.active.shading.show_object_outline = False
    with bpy.context.temp_override(area=area, region=region):
        bpy.ops.view3d.view_selected()
    space = area.spaces.active
    space.overlay.show_axis_x = space.overlay.show_axis_y = False
    space.overlay.show_cursor = False
    space.region_3d.view_rotation = Euler((0.75, 0.0, 0.5)).to_quaternion()
    space.region_3d.view_distance *= 1.25
    settings = bpy.context.scene.principal_directions
    settings.degree = 6
    settings.neighbours = 80
    settings.orders = {"2", "3", "4"}


def running():
    return bpy.context.window_manager.principal_directions.running


def strokes():
    return [o.name for o in bpy.data.objects if "pdtheory_points" in o]


def wait_for(condition, seconds=400.0):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise RuntimeError("waited in vain")
        yield 0.02


def click():
    place = loud_button()
    if place is None:
        raise RuntimeError("the Compute button is not to be seen")
    # A button must be under the mouse before it can be pressed.
    xdotool("mousemove", *place)
    yield 0.5
    xdotool("click", 1)


def compute():
    """Click Compute and wait for the result."""
    yield from click()
    yield from wait_for(running, 20.0)
    report["gaps"].clear()
    started, taken = time.monotonic(), stolen()
    pictured = False
    while running():
        if not pictured and bpy.context.window_manager.principal_directions.fraction > 0.3:
            pictured = True
            shot("progress")
            report["gaps"].append(None)
        yield 0.02
    report["seconds"] = time.monotonic() - started - (stolen() - taken)


def prepare_large():
    """Set up a hundred thousand vertices, with the kernels compiled."""
    prepare(16)
    bpy.ops.principal_directions.compute()
    prepare(183)


def large_under_way():
    """Click Compute on a large object and return in the middle of it."""
    prepare_large()
    yield from open_tab()
    yield from click()
    yield from wait_for(running, 20.0)
    yield from wait_for(lambda: bpy.context.window_manager.principal_directions.fraction > 0.1)


def scenario_compute():
    prepare(40)
    yield from open_tab()
    yield from compute()
    yield 1.5
    report["summary"] = bpy.context.object.principal_directions.summary
    report["strokes"] = strokes()
    paint_buttons(QUIET)
    yield 1.0
    shot("result")
    paint_buttons(LOUD)
    xdotool("mousemove", 400, 400, "key", "ctrl+z")
    yield 1.5
    report["after_undo"] = strokes()
    xdotool("key", "ctrl+shift+z")
    yield 1.5
    report["after_redo"] = strokes()
    shot("redo")


def plotted():
    """Return the point whose plots are in the panel, None if there are none yet."""
    (module,) = (m for name, m in sys.modules.items() if name.endswith("directions.polar_plot"))
    return module._plots.shown and module._plots.shown[1]


def scenario_polar():
    """Open the panel of the selected point and its plots, and go from one vertex to another."""
    panels = {n: getattr(bpy.types, f"DIRECTIONS_PT_{n}") for n in ("result", "drawing", "polar")}
    for panel in panels.values():
        bpy.utils.unregister_class(panel)
    for panel in (bpy.types.DIRECTIONS_PT_point, panels["polar"]):
        if panel.is_registered:
            bpy.utils.unregister_class(panel)
        panel.bl_options = set()
        bpy.utils.register_class(panel)
    prepare(16)
    yield from open_tab()
    # The panels above it would push the plots out of the window.
    bpy.utils.unregister_class(bpy.types.DIRECTIONS_PT_compute)
    paint_buttons(QUIET)
    # Small enough for two plots below the table.
    bpy.context.preferences.view.ui_scale = 0.7
    yield 1.0
    area, _ = view()
    sidebar = next(r for r in area.regions if r.type == "UI")
    top = bpy.context.window.height - (sidebar.y + sidebar.height)
    report["sidebar"] = [sidebar.x, top, sidebar.x + sidebar.width, top + sidebar.height]
    thing = bpy.context.object
    thing.principal_directions.point = 10**6
    bpy.ops.principal_directions.compute(orders={"2", "3"})
    for name, vertex in (("nowhere", 10**6), ("saddle", 0), ("elsewhere", 40)):
        thing.principal_directions.point = vertex
        area.tag_redraw()
        if name != "nowhere":
            # The first plots ever wait for a list of the fonts.
            yield from wait_for(lambda vertex=vertex: plotted() == vertex, 60.0)
        yield 2.0
        shot(name)
    bpy.ops.principal_directions.plot_point()
    (image,) = (i for i in bpy.data.images if i.name.endswith("polar plot"))
    image.file_format, image.filepath_raw = "PNG", str(FOLDER / "image.png")
    image.save()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    yield 1.0
    shot("no_vertex")


def scenario_eevee():
    prepare(40)
    bpy.ops.principal_directions.compute()
    report["strokes"] = strokes()
    scene = bpy.context.scene
    names = {item.identifier for item in scene.render.bl_rna.properties["engine"].enum_items}
    scene.render.engine = "BLENDER_EEVEE_NEXT" if "BLENDER_EEVEE_NEXT" in names else "BLENDER_EEVEE"
    bpy.ops.object.light_add(type="SUN", rotation=(0.5, 0.2, 0.0))
    bpy.ops.object.camera_add(location=(0.0, 0.0, 6.0))
    scene.camera = bpy.context.object
    scene.render.resolution_x = scene.render.resolution_y = 256
    scene.render.filepath = str(FOLDER / "eevee.png")
    bpy.ops.render.render(write_still=True)
    yield 0.1


def scenario_large():
    prepare_large()
    report["vertices"] = len(bpy.context.object.data.vertices)
    yield from open_tab()
    yield from compute()
    yield 2.0
    report["strokes"] = strokes()
    shot("large")


def scenario_escape():
    yield from large_under_way()
    pressed = time.monotonic()
    xdotool("mousemove", 400, 400, "key", "Escape")
    yield from wait_for(lambda: not running(), 20.0)
    report["escape_seconds"] = time.monotonic() - pressed
    report["strokes"] = strokes()


def scenario_deleted():
    yield from large_under_way()
    bpy.data.objects.remove(bpy.context.object)
    yield from wait_for(lambda: not running())
    yield 0.5
    report["strokes"] = strokes()


def scenario_new_file():
    yield from large_under_way()
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    yield 2.0
    report["running"] = running()
    report["strokes"] = strokes()


def finish():
    (FOLDER / "report.json").write_text(json.dumps(report))
    bpy.ops.wm.quit_blender()


def play():
    steps = globals()[f"scenario_{SCENARIO}"]()
    due, taken = time.monotonic(), stolen()

    def step():
        nonlocal due, taken
        # How long after its time the main loop came to this, without what the machine lost.
        report["gaps"].append(time.monotonic() - due - (stolen() - taken))
        try:
            pause = next(steps)
        except StopIteration:
            finish()
            return None
        except Exception:
            shot("error")
            report["error"] = traceback.format_exc()
            finish()
            return None
        due, taken = time.monotonic() + pause, stolen()
        return pause

    return step


bpy.context.preferences.view.show_splash = False
# Without a graphics card each of the viewport's many smoothing passes is half a second of drawing.
bpy.context.preferences.system.viewport_aa = "OFF"
QUIET = (0.33, 0.33, 0.33)
bpy.context.preferences.use_preferences_save = False
paint_buttons(LOUD)
bpy.app.timers.register(play(), first_interval=2.0, persistent=True)
