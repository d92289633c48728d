"""The process that draws: reads a job from standard input, reports on standard output."""

from __future__ import annotations

import os
import pickle
import sys
from pathlib import Path
from typing import Any

from pdtheory.blender.draw import DrawingJob, Progress
from pdtheory.errors import ComputationError, PdtheoryError

#: Objects of this size (diagonal of the bounding box) are left as they are.
_COMFORTABLE = (1e-2, 1e4)


def draw(job: DrawingJob, path: Path, progress: Progress) -> None:
    """Draw one job in this process, in a fresh Blender file.

    Parameters
    ----------
    job
        What to draw.
    path
        The file to write; the suffix of the job's target says what it becomes.
    progress
        Called with a fraction and a text.
    """
    from pdtheory.blender.requirement import require_bpy

    require_bpy()
    from pdtheory.blender import scene

    progress(0.05, "building the scene")
    stage = build_scene(job)
    if Path(job.target).suffix.lower() == ".blend":
        progress(0.5, "saving")
        scene.save_blend(path)
    else:
        scene.render_picture(
            stage,
            path,
            samples=job.rays,
            progress=lambda fraction, text: progress(0.1 + 0.9 * fraction, text),
        )
    progress(1.0, "drawn")


def build_scene(job: DrawingJob) -> Any:
    """Put surface, strokes, camera, light and ground of a job into a fresh file.

    Returns
    -------
    bpy.types.Scene
        The scene.
    """
    import numpy as np

    from pdtheory.blender import compat, scene
    from pdtheory.blender.glyphs import add_glyphs, find_modifier
    from pdtheory.blender.surface import add_points, add_surface
    from pdtheory.conventions import Kind
    from pdtheory.drawing.glyphs import glyph_data
    from pdtheory.drawing.view import surface_points

    stage = scene.new_file()
    stage.render.resolution_x, stage.render.resolution_y = job.size
    stage.render.resolution_percentage = 100
    points = surface_points(job.field, job.cloud)
    low, high = points.min(axis=0), points.max(axis=0)
    diagonal = float(np.linalg.norm(high - low))
    centre = (low + high) / 2.0
    # Single precision: what lies far from the origin is brought there, what is tiny or huge scaled.
    origin = centre if np.abs(centre).max() > 100.0 * diagonal else np.zeros(3)
    small, large = _COMFORTABLE
    scale = 1.0 if small <= diagonal <= large else 2.0 / diagonal
    collection = stage.collection
    cloud = job.cloud
    if cloud is not None and cloud.faces is not None and len(cloud.faces):
        surface = add_surface(cloud, collection=collection, origin=origin)
    elif cloud is not None and (cloud.normals is not None or len(cloud) != len(job.field)):
        surface = add_points(
            cloud.points, cloud.normals, name=cloud.name, collection=collection, origin=origin
        )
    else:
        surface = add_points(
            job.field.points,
            job.field.frames[:, 2],
            name="Points",
            collection=collection,
            origin=origin,
        )
    surface.scale = (scale, scale, scale)
    glyphs = add_glyphs(
        glyph_data(job.field, job.choice.orders, job.choice),
        name="Principal directions",
        collection=collection,
        parent=surface,
        origin=origin,
        strokes=job.choice.strokes,
    )
    modifier = find_modifier(glyphs)
    compat.set_input(modifier, "Maxima", Kind.MAXIMUM in job.choice.kinds)
    compat.set_input(modifier, "Minima", Kind.MINIMUM in job.choice.kinds)
    compat.set_input(modifier, "Least Strength", job.choice.least_strength)
    compat.set_input(modifier, "Largest Uncertainty", min(job.choice.largest_uncertainty, 3.15))
    scene.set_stage(stage, (points - origin) * scale, job.view)
    return stage


def main() -> int:
    """Read one job, draw it, report progress and the end; return the exit code."""
    # Blender prints to standard output, in C too: the conversation gets a descriptor of its own.
    with os.fdopen(os.dup(1), "wb") as channel:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, 1)

        def say(message: tuple[float, str] | Exception | None) -> None:
            pickle.dump(message, channel)
            channel.flush()

        try:
            job = pickle.load(sys.stdin.buffer)
            draw(job, Path(sys.argv[1]), lambda fraction, text: say((fraction, text)))
        except PdtheoryError as error:
            say(error)
            return 2
        except Exception as error:
            say(ComputationError(f"Blender could not draw this ({type(error).__name__}: {error})."))
            return 1
        say(None)
    return 0


if __name__ == "__main__":
    sys.exit(main())
