"""JSON and tables on stdout, remarks on stderr."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from threading import Timer

import typer
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table as RichTable

from mckibben.application.json_text import answer_json
from mckibben.application.text_file import check_ending, write_text
from mckibben.physics.errors import InputError
from mckibben.report.summary import Summary, Table
from mckibben.simulation.integrate.background import is_compiling
from mckibben.simulation.outcome import Watch

_SHOWN_AFTER = 1.0  # s
_PIPE = 10_000  # columns, more than any table has
_COMPILING = "compiling, once on this machine"


def write_json(answer: object) -> None:
    """One JSON object and a line end, nothing else."""
    sys.stdout.buffer.write(answer_json(answer) + b"\n")
    sys.stdout.buffer.flush()


def standard_input(names: Sequence[str]) -> dict[str, bytes]:
    """What comes from standard input, where it is named: "-" -> its content.

    Raises:
        InputError: it is named twice, or is a terminal.
    """
    if "-" not in names:
        return {}
    if list(names).count("-") > 1:
        raise InputError("-: standard input can be read once only", hint="name the other files")
    if sys.stdin.isatty():
        raise InputError("-: standard input is the terminal", hint="mckibben convert - < file.csv")
    from mckibben.application.measurement.files import LARGEST_FILE

    return {"-": sys.stdin.buffer.read(LARGEST_FILE + 1)}


def check_written(path: Path | None, option: str, endings: Sequence[str]) -> None:
    """Check that the file of an option can be written there, before long work is done for it.

    Args:
        path: of the file; None where the option is not used.
        option: the option.
        endings: of the forms in which it can be written.

    Raises:
        InputError: another ending, it is a folder, or its folder does not exist.
    """
    if path is None:
        return
    if path.is_dir():
        raise InputError(
            f"{option} {path}: is a folder", hint=f"name a file in it, e.g. {path / 'model.json'}"
        )
    if not path.parent.is_dir():
        raise InputError(f"{option} {path}: there is no folder {path.parent}", hint="name an existing folder")
    check_ending(path, endings, named=f"{option} {path}")


def write_file(path: Path, option: str, what: str, text: str) -> None:
    """Write the file that an option names, and say so: "model: muscle.json".

    Raises:
        InputError: it cannot be written.
    """
    write_text(path, text, named=f"{option} {path}")
    remark(f"{what}: {path}")


def write_summary(summary: Summary) -> None:
    """The tables on stdout, the sentences on stderr."""
    for part in summary:
        if isinstance(part, str):
            remark(part)
        else:
            _write_table(part)


def _write_table(content: Table) -> None:
    """A table of right-aligned figures; the first column is left-aligned.

    A terminal that is too narrow breaks cells and heads into lines; nothing is cut off. A pipe has no width.
    """
    console = Console(highlight=False)
    narrow = console.is_terminal
    if not narrow:
        console = Console(highlight=False, width=_PIPE)
    table = RichTable(box=SIMPLE_HEAD)
    for index, column in enumerate(content.columns):
        table.add_column(column, justify="right" if index else "left", no_wrap=not narrow, overflow="fold")
    for row in content.rows:
        table.add_row(*row)
    console.print(content.title, style="bold", soft_wrap=True)
    console.print(table)


@contextmanager
def progress(words: str) -> Iterator[Watch]:
    """A progress bar on stderr if that is a terminal, after a second; yields the watch of the work it shows.

    Until the work tells a share, the bar only moves; work that cannot tell one need not use the watch.
    """
    from rich.progress import BarColumn, Progress, ProgressColumn, TaskProgressColumn, TimeElapsedColumn
    from rich.text import Text

    class _Words(ProgressColumn):
        def render(self, task: object) -> Text:
            return Text(f"{words} ({_COMPILING})" if is_compiling() else words)

    console = Console(stderr=True)
    bar = Progress(
        _Words(), BarColumn(), TaskProgressColumn(show_speed=False), TimeElapsedColumn(),
        console=console, transient=True, disable=not console.is_terminal,
    )  # fmt: skip
    task = bar.add_task(words, total=None)
    begin = Timer(_SHOWN_AFTER, bar.start)
    begin.daemon = True
    begin.start()
    try:
        yield Watch(
            progress=lambda share: bar.update(task, total=1.0, completed=share), time_limit=float("inf")
        )
    finally:
        begin.cancel()
        begin.join()
        bar.stop()


def remark(text: str) -> None:
    """A message for people, on stderr."""
    typer.echo(text, err=True)
