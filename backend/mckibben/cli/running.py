"""Runs a command line: the exit code, and one line on stderr for whatever is wrong."""

from __future__ import annotations

import os

import typer

from mckibben.documents.located import one_line
from mckibben.physics.errors import InputError

_BAD_INPUT = 2
# Options of `mckibben` itself; any other first option belongs to `serve`.
_OWN_OPTIONS = frozenset({"-h", "--help", "--version"})


def _fail(message: str, code: int = _BAD_INPUT) -> int:
    typer.echo(f"mckibben: {' '.join(message.split())}", err=True)
    return code


def _command(app: typer.Typer, arguments: list[str]) -> str:
    known = {command.name or getattr(command.callback, "__name__", "") for command in app.registered_commands}
    return f"{arguments[0]} " if arguments[0] in known else ""


def run_app(app: typer.Typer, arguments: list[str]) -> int:
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
            return _fail(f"{explain()} (see mckibben {_command(app, arguments)}--help)")
        if os.environ.get("MCKIBBEN_DEBUG"):
            raise
        return _fail(f"unexpected {type(error).__name__}: {error} (MCKIBBEN_DEBUG=1 shows where)", 1)
