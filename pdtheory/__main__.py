"""The command line: ``pdtheory``, or ``python -m pdtheory``."""

from __future__ import annotations

import sys

from pdtheory.interrupts import EXIT_CODE, SENTENCE


def run() -> None:
    """Load the commands and run one."""
    try:
        from pdtheory.cli.main import run as start
    except KeyboardInterrupt:
        # Once they are loaded the commands see to it.
        sys.stderr.write(f"{SENTENCE}\n")
        sys.exit(EXIT_CODE)
    start()


if __name__ == "__main__":
    run()
