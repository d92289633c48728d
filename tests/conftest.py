"""What every test starts from."""

from __future__ import annotations

import signal


def pytest_configure() -> None:
    """Let the processes that tests start be interrupted.

    A shell starts its background jobs with Ctrl-C ignored, and an ignored signal is handed down:
    a test run in the background could not check that an interrupted program stops.
    """
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
