"""The command line as typer sees it, and how it is run: exit code, one line on stderr for what is wrong."""

from __future__ import annotations

import os

import typer

from mckibben.documents.located import one_line
from mckibben.physics.errors import InputError
from mckibben.version import __version__

app = typer.Typer(
    name="mckibben",
    help="Design studio for pneumatic (McKibben) muscles. Without a command: serve.",
    add_completion=False,
    no_args_is_help=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)

_BAD_INPUT = 2
# Options of `mckibben` itself; any other first option belongs to `serve`.
_OWN_OPTIONS = frozenset({"-h", "--help", "--version"})


def _show_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"mckibben {__version__}")
        raise typer.Exit


@app.callback()
def _root(
    version: bool = typer.Option(
        False, "--version", callback=_show_version, is_eager=True, help="Show the version."
    ),
) -> None:
    """Design studio for pneumatic (McKibben) muscles. Without a command: serve."""


def _fail(message: str, code: int = _BAD_INPUT) -> int:
    typer.echo(f"mckibben: {' '.join(message.split())}", err=True)
    return code


def _command(arguments: list[str]) -> str:
    known = {command.name or getattr(command.callback, "__name__", "") for command in app.registered_commands}
    return f"{arguments[0]} " if arguments[0] in known else ""


def run(arguments: list[str]) -> int:
    """Run one command line; the exit code. Whatever goes wrong is one line on stderr."""
    if not arguments or (arguments[0].startswith("-") and arguments[0] not in _OWN_OPTIONS):
        arguments = ["serve", *arguments]
    try:
        return app(args=arguments, prog_name="mckibben", standalone_mode=False) or 0
    except typer.Exit as stop:
        return stop.exit_code
    except InputError as error:
        return _fail(one_line(error))
    except (KeyboardInterrupt, typer.Abort):
        return 130
    except (BrokenPipeError, SystemExit) as stop:
        # The reader of the pipe has closed it, which click and rich turn into an exit: no more output, also
        # not by the interpreter on exit.
        if not any(isinstance(error, BrokenPipeError) for error in (stop, stop.__context__)):
            raise
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        return 0
    except Exception as error:
        # Usage errors of typer; their class is click's in some versions and a copy of it in others.
        if callable(explain := getattr(error, "format_message", None)):
            return _fail(f"{explain()} (see mckibben {_command(arguments)}--help)")
        if os.environ.get("MCKIBBEN_DEBUG"):
            raise
        return _fail(f"unexpected {type(error).__name__}: {error} (MCKIBBEN_DEBUG=1 shows where)", 1)
