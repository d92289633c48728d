"""Long work on a thread, for a window that must not freeze."""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Callable
from typing import Final, Generic, TypeVar

from pdtheory.errors import Cancelled

T = TypeVar("T")

Report = Callable[[float, str], None]

#: How much less urgent than the window the work is, in steps of `nice`.
_NICE: Final = 5


class Job(Generic[T]):
    """One piece of work on a daemon thread.

    The work must touch no Blender data: it gets NumPy copies, and its result is applied by the main
    thread afterwards.

    Parameters
    ----------
    work
        Called with a function ``report(fraction, text)``, which raises
        :class:`pdtheory.errors.Cancelled` once the job is cancelled.
    """

    def __init__(self, work: Callable[[Report], T]) -> None:
        self.fraction = 0.0
        self.text = ""
        self._work = work
        self._result: T | None = None
        self._error: BaseException | None = None
        self._cancelled = threading.Event()
        self._thread = threading.Thread(target=self._run, name="pdtheory-job", daemon=True)

    def start(self) -> None:
        """Begin."""
        self._thread.start()

    def run_here(self) -> T:
        """Do the work on this thread, for scripts, and return its result."""
        return self._work(self._report)

    def cancel(self) -> None:
        """Ask the work to stop at its next report."""
        self._cancelled.set()

    @property
    def cancelled(self) -> bool:
        """Whether it was asked to stop."""
        return self._cancelled.is_set()

    @property
    def done(self) -> bool:
        """Whether the thread has ended, in whatever way."""
        return not self._thread.is_alive()

    def wait(self, seconds: float | None = None) -> bool:
        """Wait for the end; return whether it came."""
        self._thread.join(seconds)
        return self.done

    def result(self) -> T:
        """Return what the work returned, once it is done.

        Raises
        ------
        Exception
            Whatever the work raised; :class:`pdtheory.errors.Cancelled` if it was stopped.
        """
        if self._error is not None:
            raise self._error
        if self.cancelled:
            raise Cancelled("the computation was cancelled.")
        assert self.done, "the job has not ended"
        return self._result  # type: ignore[return-value]

    def _report(self, fraction: float, text: str) -> None:
        if self._cancelled.is_set():
            raise Cancelled("the computation was cancelled.")
        self.fraction, self.text = fraction, text

    def _run(self) -> None:
        _give_way()
        try:
            self._result = self._work(self._report)
        except BaseException as error:
            self._error = error


def _give_way() -> None:
    """Let the window be served before this thread and those that it starts.

    On Linux this is a matter of the thread; elsewhere it would be one of the whole program, and the
    system favours the window that the user looks at.
    """
    if sys.platform == "linux":
        os.nice(_NICE)
