"""The command line: ``pdtheory``, or ``python -m pdtheory``."""

from __future__ import annotations

import sys


def run() -> None:
    """Load the commands and run one."""
    try:
        from pdtheory.cli.main import run as start
    except KeyboardInterrupt:
        # Once they are loaded the commands see to it.
        sys.stderr.write("pdtheory: interrupted; nothing was left half-written.\n")
        sys.exit(130)
    start()


if __name__ == "__main__":
    run()
