"""The command line as typer sees it; commands register themselves, each group in a module of its own."""

from __future__ import annotations

import typer

from mckibben.version import __version__

app = typer.Typer(
    name="mckibben",
    help="Design studio for pneumatic (McKibben) muscles. Without a command: serve.",
    add_completion=False,
    no_args_is_help=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


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
