"""The ``pdtheory`` command."""

from __future__ import annotations

import errno
import sys
from typing import Annotated, Any

import typer
from typer.core import TyperGroup

from pdtheory import __version__
from pdtheory.cli.addon import app as addon
from pdtheory.cli.cone import cone
from pdtheory.cli.demo import demo
from pdtheory.cli.draw import draw
from pdtheory.cli.eigen import eigen
from pdtheory.cli.estimate import estimate
from pdtheory.cli.figure import figure
from pdtheory.cli.inverse import inverse
from pdtheory.cli.point import point
from pdtheory.cli.sample import sample, surfaces
from pdtheory.cli.verify import verify
from pdtheory.cli.view import view
from pdtheory.errors import PdtheoryError


class _Refusing(TyperGroup):
    """Turn our own errors, and a lack of memory, into one sentence and exit code 2."""

    def invoke(self, ctx: Any) -> Any:
        try:
            return super().invoke(ctx)
        except PdtheoryError as error:
            typer.echo(f"pdtheory: {error}", err=True)
            raise typer.Exit(2) from error
        except MemoryError as error:
            reason = f" ({error})" if str(error) else ""
            typer.echo(
                f"pdtheory: there is not enough memory{reason}; ask for less, or give a smaller "
                "file.",
                err=True,
            )
            raise typer.Exit(2) from error
        except OSError as error:
            # A stream, unlike a file, has no name. Typer itself ends quietly on a closed pipe.
            if error.filename is not None or error.errno == errno.EPIPE:
                raise
            # What could not be written must not be tried once more when Python ends.
            sys.stdout = None
            typer.echo(f"pdtheory: cannot write the answer: {error.strerror}.", err=True)
            raise typer.Exit(2) from error
        except KeyboardInterrupt:
            typer.echo("pdtheory: interrupted; nothing was left half-written.", err=True)
            raise typer.Exit(130) from None


app = typer.Typer(
    cls=_Refusing,
    help="Principal directions of arbitrary order on surfaces: exact theory and computation.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,  # Rich help would double the start-up time
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"pdtheory {__version__}")
        raise typer.Exit


@app.callback()
def _main(
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_version, is_eager=True, help="Print the version and stop."
        ),
    ] = False,
) -> None:
    pass


for command in (demo, estimate, point, draw, view, sample, surfaces, inverse, cone, verify, figure):
    app.command(command.__name__)(command)
app.add_typer(addon, name="addon")
# A formula may begin with a minus sign and is no option then.
app.command("eigen", context_settings={"ignore_unknown_options": True})(eigen)


def run() -> None:
    """Run the command line; the entry point of the installed script."""
    for stream in (sys.stdout, sys.stderr):
        # A Windows console with a legacy code page must not stop at a Greek letter.
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")
    # Python writes no numbers of more than 4,300 digits; formulas are bounded where they are read.
    sys.set_int_max_str_digits(0)
    app()
