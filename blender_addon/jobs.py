# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators whose work runs on a thread: progress, Esc, one undo step for the result."""

from dataclasses import dataclass
from typing import Any

import bpy
from bpy.app.handlers import persistent

from pdtheory.blender.background import Job
from pdtheory.blender.result import POINTS_KEY, forget_all
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
    shape : tuple of int
        What changes when the object is edited.
    extra : Any
        What the operator needs to apply the result.
    """

    job: Job[Any]
    uid: int
    name: str
    shape: tuple[int, ...]
    extra: Any = None


#: At most one computation runs at a time.
_running: Prepared | None = None


def surface_object(context):
    """Return the object that a command is about: the active one, or the surface below strokes."""
    thing = context.active_object
    if thing is not None and POINTS_KEY in thing and thing.parent is not None:
        return thing.parent
    return thing


def shape_of(thing):
    """Return what changes when an object is edited."""
    if thing.type != "MESH":
        return ()
    if thing.mode == "EDIT":
        thing.update_from_editmode()
    data = thing.data
    return (len(data.vertices), len(data.edges), len(data.polygons))


def prepare(thing, work, extra=None):
    """Pack up work for an object."""
    return Prepared(Job(work), thing.session_uid, thing.name, shape_of(thing), extra)


class JobOperator:
    """Base of operators with long work.

    A subclass reads what it needs in `prepared(context)`, on the main thread, and shows the result
    in `apply(thing, extra, result)`, which returns a sentence.
    """

    bl_options = {"UNDO"}  # noqa: RUF012
    _timer = None

    @classmethod
    def poll(cls, context):
        if _running is not None:
            cls.poll_message_set("A computation is running")
            return False
        if surface_object(context) is None:
            cls.poll_message_set("Select an object")
            return False
        return True

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
            _running = self.prepared(context)
        except PdtheoryError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        _running.job.start()
        manager = context.window_manager
        self._timer = manager.event_timer_add(_INTERVAL, window=context.window)
        manager.modal_handler_add(self)
        _show_progress(manager)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        """Pass everything through but Esc, and look at the job ten times a second."""
        if _running is None:
            self._stop(context)
            return {"CANCELLED"}
        if event.type == "ESC" and event.value == "PRESS":
            # The thread ends at its next report; it holds copies only, nobody waits for it.
            _running.job.cancel()
            self._stop(context)
            self.report({"INFO"}, "Cancelled")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        if _running.job.cancelled:
            # By the button.
            self._stop(context)
            self.report({"INFO"}, "Cancelled")
            return {"CANCELLED"}
        if not _running.job.done:
            _show_progress(context.window_manager)
            return {"PASS_THROUGH"}
        return self._finish(context)

    def cancel(self, context):
        """Blender ends the operator itself: another file is opened, or the program closes."""
        if _running is not None:
            _running.job.cancel()
        self._stop(context)

    def _finish(self, context):
        ended = _running
        self._stop(context)
        try:
            result = ended.job.result()
            thing = next((o for o in bpy.data.objects if o.session_uid == ended.uid), None)
            if thing is None:
                self.report({"WARNING"}, f"{ended.name} was deleted; the result was dropped")
                return {"CANCELLED"}
            edited = shape_of(thing) != ended.shape
            sentence = self.apply(thing, ended.extra, result)
        except Cancelled:
            self.report({"INFO"}, "Cancelled")
            return {"CANCELLED"}
        except PdtheoryError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        redraw()
        if edited:
            self.report({"WARNING"}, f"{thing.name} was edited meanwhile; compute again")
        else:
            self.report({"INFO"}, sentence)
        return {"FINISHED"}

    def _stop(self, context):
        global _running
        _running = None
        if self._timer is not None:
            context.window_manager.event_timer_remove(self._timer)
            self._timer = None
        context.window_manager.principal_directions.running = False
        redraw()


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


@persistent
def _new_file(*_):
    """Nothing of the old file survives."""
    global _running
    if _running is not None:
        _running.job.cancel()
        _running = None
    forget_all()


def register():
    bpy.utils.register_class(CancelCompute)
    bpy.app.handlers.load_pre.append(_new_file)


def unregister():
    _new_file()
    bpy.app.handlers.load_pre.remove(_new_file)
    bpy.utils.unregister_class(CancelCompute)
