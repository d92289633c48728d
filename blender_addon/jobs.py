# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators whose work runs on a thread: progress, Esc, one undo step for the result."""

from dataclasses import dataclass
from typing import Any

import bpy
from bpy.app.handlers import persistent

from pdtheory.blender.background import Job
from pdtheory.blender.result import forget_all, strokes_of
from pdtheory.blender.source import TYPES
from pdtheory.blender.storage import POINTS_KEY
from pdtheory.errors import Cancelled, PdtheoryError

_INTERVAL = 0.1


@dataclass
class Prepared:
    """A piece of work and the object it is for.

    Attributes
    ----------
    job : Job
        The work.
    uid : int
        Which object; names change, and undo replaces the data behind a reference.
    name : str
        Its name, for messages.
    extra : Any
        What the operator needs to apply the result.
    timer : Any
        What lets the operator look at the job, once it was started.
    """

    job: Job[Any]
    uid: int
    name: str
    extra: Any = None
    timer: Any = None


#: At most one computation runs at a time.
_running: Prepared | None = None


def surface_object(context):
    """Return the object that a command is about: the active one, or the surface below strokes."""
    thing = context.active_object
    if thing is not None and POINTS_KEY in thing and thing.parent is not None:
        return thing.parent
    return thing


def has_points(operator, context):
    """Return True if the object that a command is about has points, else say that on the button."""
    thing = surface_object(context)
    if thing is None or thing.type not in TYPES:
        operator.poll_message_set("Select a mesh, curve, text, metaball or point cloud")
        return False
    return True


def has_result(operator, context):
    """Return True if the object that a command is about has a result, else say that there."""
    if strokes_of(surface_object(context)) is None:
        operator.poll_message_set("Compute the directions of this object first")
        return False
    return True


def prepare(thing, work, extra=None):
    """Pack up work for an object."""
    return Prepared(Job(work), thing.session_uid, thing.name, extra)


class JobOperator:
    """Base of operators with long work.

    A subclass reads what it needs in `prepared(context)`, on the main thread, and shows the result
    in `apply(thing, extra, result)`, which returns a sentence.
    """

    bl_options = {"UNDO"}  # noqa: RUF012
    _mine = None

    @classmethod
    def poll(cls, context):
        if _running is not None:
            cls.poll_message_set("A computation is running")
            return False
        return has_points(cls, context)

    def execute(self, context):
        """Do it at once: for scripts, and where there is no window."""
        try:
            prepared = self.prepared(context)
            result = prepared.job.run_here()
            sentence = self.apply(surface_object(context), prepared.extra, result)
        except PdtheoryError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        redraw()
        self.report({"INFO"}, sentence)
        return {"FINISHED"}

    def invoke(self, context, event):
        """Start the thread and watch it."""
        global _running
        if bpy.app.background:
            return self.execute(context)
        try:
            self._mine = _running = self.prepared(context)
        except PdtheoryError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        _running.job.start()
        manager = context.window_manager
        _running.timer = manager.event_timer_add(_INTERVAL, window=context.window)
        manager.modal_handler_add(self)
        _show_progress(manager)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        """Pass everything through but Esc, and look at the job ten times a second."""
        if _running is None or _running is not self._mine:
            # Another file was opened, and perhaps another computation has begun in it.
            return {"CANCELLED"}
        if event.type == "ESC" and event.value == "PRESS":
            _stop()
            self.report({"INFO"}, "Cancelled")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        if _running.job.cancelled:
            # By the button.
            _stop()
            self.report({"INFO"}, "Cancelled")
            return {"CANCELLED"}
        if not _running.job.done:
            _show_progress(context.window_manager)
            return {"PASS_THROUGH"}
        return self._finish(context)

    def cancel(self, context):
        """Blender ends the operator itself: another file is opened, or the program closes."""
        if _running is self._mine:
            _stop()

    def _finish(self, context):
        ended = _running
        _forget()
        try:
            result = ended.job.result()
            thing = next((o for o in bpy.data.objects if o.session_uid == ended.uid), None)
            if thing is None:
                self.report({"WARNING"}, f"{ended.name} was deleted; the result was dropped")
                return {"CANCELLED"}
            sentence = self.apply(thing, ended.extra, result)
        except Cancelled:
            self.report({"INFO"}, "Cancelled")
            return {"CANCELLED"}
        except PdtheoryError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        redraw()
        self.report({"INFO"}, sentence)
        return {"FINISHED"}


class CancelCompute(bpy.types.Operator):
    """Stop the computation (Esc)"""

    bl_idname = "principal_directions.cancel"
    bl_label = "Cancel"

    @classmethod
    def poll(cls, context):
        return _running is not None

    def execute(self, context):
        _running.job.cancel()
        return {"FINISHED"}


def _show_progress(manager):
    progress, job = manager.principal_directions, _running.job
    progress.running = True
    progress.fraction = job.fraction
    progress.text = job.text.capitalize()
    # Only the sidebars: drawing a large object ten times a second would stop the window.
    for window in manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                for region in area.regions:
                    if region.type == "UI":
                        region.tag_redraw()


def redraw():
    """Let the panels and the 3D view catch up."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type in {"VIEW_3D", "PROPERTIES"}:
                area.tag_redraw()


def _stop():
    """End the running computation, if there is one."""
    if _running is not None:
        # The thread ends at its next report; it holds copies only, nobody waits for it.
        _running.job.cancel()
    _forget()


def _forget():
    """Let nothing watch or show the running computation any more."""
    global _running
    if _running is not None and _running.timer is not None:
        bpy.context.window_manager.event_timer_remove(_running.timer)
    _running = None
    for manager in bpy.data.window_managers:
        manager.principal_directions.running = False
    redraw()


@persistent
def _new_file(*_):
    """Nothing of the old file survives."""
    _stop()
    forget_all()


def register():
    bpy.utils.register_class(CancelCompute)
    bpy.app.handlers.load_pre.append(_new_file)


def unregister():
    _new_file()
    bpy.app.handlers.load_pre.remove(_new_file)
    bpy.utils.unregister_class(CancelCompute)
