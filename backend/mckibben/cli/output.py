"""JSON and tables on stdout, remarks on stderr."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import typer
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table

from mckibben.application.json_text import to_json
from mckibben.identification.fit.comparison import ParameterTable
from mckibben.physics.errors import InputError
from mckibben.simulation.outcome import Watch

if TYPE_CHECKING:
    from mckibben.application.experiment_result import SpecimenResult


def write_json(answer: object) -> None:
    """One JSON object and a line end, nothing else."""
    sys.stdout.buffer.write(to_json(answer) + b"\n")
    sys.stdout.buffer.flush()


def check_folder(path: Path, option: str) -> None:
    """Check that a file can be written there, before long work is done for it.

    Raises:
        InputError: it is a folder, or its folder does not exist.
    """
    if path.is_dir():
        raise InputError(
            f"{option} {path}: is a folder", hint=f"name a file in it, e.g. {path / 'model.json'}"
        )
    if not path.parent.is_dir():
        raise InputError(f"{option} {path}: there is no folder {path.parent}", hint="name an existing folder")


def write_table(title: str, columns: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    """A table of right-aligned figures; the first column is left-aligned."""
    table = Table(box=SIMPLE_HEAD)
    for index, column in enumerate(columns):
        table.add_column(column, justify="left" if index == 0 else "right", no_wrap=True)
    for row in rows:
        table.add_row(*row)
    console = Console(highlight=False)
    if not console.is_terminal:
        # A pipe has no width; figures must not be truncated.
        console = Console(highlight=False, width=200)
    console.print(title, style="bold", soft_wrap=True)
    console.print(table)


@contextmanager
def progress(words: str) -> Iterator[Watch]:
    """A progress bar on stderr if that is a terminal; yields the watch of the work it shows."""
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn

    console = Console(stderr=True)
    with Progress(
        TextColumn(words), BarColumn(), TaskProgressColumn(), console=console, transient=True,
        disable=not console.is_terminal,
    ) as bar:  # fmt: skip
        task = bar.add_task(words, total=1.0)
        yield Watch(progress=lambda share: bar.update(task, completed=share), time_limit=float("inf"))


def remark(text: str) -> None:
    """A message for people, on stderr."""
    typer.echo(text, err=True)


class CountedRows(Protocol):
    """A result that counts the rows of its data."""

    @property
    def rows(self) -> int:
        """Number of rows of the data."""
        ...

    @property
    def rows_used(self) -> int:
        """Number of rows used."""
        ...

    @property
    def excluded(self) -> Mapping[str, int]:
        """Reason for leaving rows out -> number of rows."""
        ...


def rows_of(result: CountedRows) -> str:
    """Number of rows that a comparison or diagnosis uses, with the reasons for leaving out others."""
    if result.rows_used == result.rows:
        return f"{result.rows} rows"
    reasons = "".join(f", {count} left out: {reason}" for reason, count in result.excluded.items())
    return f"{result.rows_used} of {result.rows} rows{reasons}"


def error_unit(unit: str) -> tuple[str, float]:
    """Display unit of an error, and its number per SI unit."""
    return ("mm", 1e3) if unit == "m" else (unit.replace("1", "x noise"), 1.0)


def write_experiment(specimens: Iterable[SpecimenResult]) -> None:
    """Print what each test was made with, and who says it."""
    from mckibben.measurement.experiment import place_of, shown_value, title_of

    for specimen in specimens:
        write_table(
            f"Experiment of {specimen.file}",
            ["", "value", "who says it"],
            [
                [title_of(name), shown_value(name, value), place_of(value)]
                for name, value in specimen.experiment.items()
            ],
        )


def write_parameters(parameters: ParameterTable) -> None:
    """Print the table of a model's parameters, if it has any."""
    rows = [
        [
            f"{effect}.{name}",
            f"{item.value:.5g}",  # a conductance is below the rounding errors that a figure hides
            ("–" if item.stderr is None else f"{item.stderr:.2g}") if item.fitted else "given",
            item.unit,
            "at its bound" if item.at_bound else "",
        ]
        for effect, values in parameters.items()
        for name, item in values.items()
    ]
    if rows:
        write_table("Parameters", ["parameter", "value", "± standard error", "unit", ""], rows)


def figure(value: float | None, digits: int = 4, unit: str = "") -> str:
    """A number with ``digits`` significant digits, or a dash."""
    if value is None or value != value:
        return "–"
    # A result this small is the rounding error of a sum.
    shown = 0.0 if abs(value) < 1e-9 else value
    return f"{shown:.{digits}g}{unit}"
