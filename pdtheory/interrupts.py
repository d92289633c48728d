"""Interruptions that wait until it is safe to be interrupted."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Final

#: What a command says, and the code it ends with, when Ctrl-C has ended it.
SENTENCE: Final = "pdtheory: interrupted; nothing was left half-written."
EXIT_CODE: Final = 130


@contextmanager
def signals_held() -> Iterator[None]:
    """Hold back Ctrl-C, SIGTERM and SIGHUP during the block, and deliver the first after it.

    For imports of packages that guard their own optional imports with ``except BaseException``: an
    interruption that arrives there would be lost. Signals that Python does not handle, such as
    those that end the process at once, are left as they are; so is everything outside the main
    thread, where no signal arrives.
    """
    came: list[int] = []

    def note(number: int, frame: FrameType | None) -> None:
        came.append(number)

    handlers = {}
    if threading.current_thread() is threading.main_thread():
        for name in ("SIGINT", "SIGTERM", "SIGHUP"):
            # Windows has no SIGHUP.
            number = getattr(signal, name, None)
            handler = None if number is None else signal.getsignal(number)
            if number is not None and callable(handler):
                handlers[number] = handler
    try:
        for number in handlers:
            signal.signal(number, note)
        yield
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)
        if came:
            signal.raise_signal(came[0])
