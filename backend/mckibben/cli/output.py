"""JSON and tables on stdout, remarks on stderr."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence

import typer
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table

from mckibben.api.answer import to_json


def write_json(answer: object) -> None:
    """One JSON object and a line end, nothing else."""
    sys.stdout.buffer.write(to_json(answer) + b"\n")
    sys.stdout.buffer.flush()


def write_table(title: str, columns: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    """A table of right-aligned figures; the first column is left-aligned."""
    table = Table(box=SIMPLE_HEAD)
    for index, column in enumerate(columns):
        table.add_column(column, justify="left" if index == 0 else "right", no_wrap=True)
    for row in rows:
        table.add_row(*row)
    console = Console(highlight=False)
    if not console.is_terminal:
        # A pipe has no width; figures must not be cut off.
        console = Console(highlight=False, width=200)
    console.print(title, style="bold", soft_wrap=True)
    console.print(table)


def remark(text: str) -> None:
    """A message for people, on stderr."""
    typer.echo(text, err=True)


def figure(value: float | None, digits: int = 4, unit: str = "") -> str:
    """A number with so many significant digits, or a dash."""
    if value is None or value != value:
        return "–"
    # Rounding errors of a sum are no figures.
    shown = 0.0 if abs(value) < 1e-9 else value
    return f"{shown:.{digits}g}{unit}"
