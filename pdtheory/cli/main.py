"""The ``pdtheory`` command."""

from __future__ import annotations

import errno
import signal
import sys
from types import FrameType
from typing import Annotated, Any

import typer
from typer.core import TyperCommand, TyperGroup

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
from pdtheory.interrupts import EXIT_CODE, SENTENCE


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
            typer.echo(SENTENCE, err=True)
            raise typer.Exit(EXIT_CODE) from None


class _Command(TyperCommand):
    """Write arguments in the usual notation: NAME, [NAME] where it can be left out, NAME... ."""

    def collect_usage_pieces(self, ctx: Any) -> list[str]:
        pieces = [self.options_metavar or ""]
        for argument in self.get_params(ctx):
            if argument.param_type_name == "argument":
                name = argument.metavar or str(argument.name).upper()
                name = name if argument.required else f"[{name}]"
                pieces.append(name if argument.nargs == 1 else f"{name}...")
        return pieces


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
    app.command(command.__name__, cls=_Command)(command)
app.add_typer(addon, name="addon")
# A formula may begin with a minus sign and is no option then.
app.command("eigen", cls=_Command, context_settings={"ignore_unknown_options": True})(eigen)


def _end(number: int, frame: FrameType | None) -> None:
    raise SystemExit(128 + number)


def run() -> None:
    """Run the command line; the entry point of the installed script."""
    for stream in (sys.stdout, sys.stderr):
        # A Windows console with a legacy code page must not stop at a Greek letter.
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")
    for name in ("SIGTERM", "SIGHUP"):
        # By default these end the process at once, and leave half-written files and Blender behind.
        # Windows has no SIGHUP; nohup has it ignored.
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) is signal.SIG_DFL:
            signal.signal(number, _end)
    # Python writes no numbers of more than 4,300 digits; formulas are bounded where they are read.
    sys.set_int_max_str_digits(0)
    app()
