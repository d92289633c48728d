"""Run the command line with ``python -m pdtheory``."""

from pdtheory.cli.main import run

if __name__ == "__main__":
    run()
