"""The table of a study as a file, and the journal beside it while the study runs."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path

from mckibben.application.json_text import answer_json
from mckibben.application.study.study import StudyQuestion, StudyResult, prepare
from mckibben.application.text_file import check_ending
from mckibben.physics.errors import InputError
from mckibben.simulation.outcome import Outcome, Watch
from mckibben.studies.journal import Journal
from mckibben.studies.run import Workers

ENDINGS = (".csv", ".json", ".parquet")


def journal_of(out: Path) -> Path:
    """Where the runs of a study are kept until its table is complete."""
    return out.with_name(f"{out.name}.journal")


def check_out(out: Path, resume: bool) -> None:
    """Check that a table can be written there, before long work is done for it.

    Raises:
        InputError: an unknown ending, no such folder, a library that is missing, nothing to resume.
    """
    check_ending(out, ENDINGS)
    if out.is_dir() or not out.parent.is_dir():
        what = "is a folder" if out.is_dir() else f"there is no folder {out.parent}"
        raise InputError(f"{out}: {what}", hint="name a file in an existing folder")
    if out.suffix.lower() == ".parquet":
        _check_parquet(f"{out}: ")
    if resume and out.exists() and not journal_of(out).exists():
        raise InputError(f"{out}: this study is complete, there is nothing to resume", hint="omit --resume")


def prepare_file(
    question: StudyQuestion,
    out: Path,
    *,
    resume: bool,
    workers: Workers | None = None,
    chunk: int | None = None,
) -> Callable[[Watch], StudyResult]:
    """A study whose table goes to a file; runs are kept in a journal beside it until all are made.

    Raises:
        InputError: as `check_out`; while it runs, a journal of another study, a file that cannot be written.
    """
    check_out(out, resume)
    journal = journal_of(out)
    study = prepare(
        question,
        workers=workers,
        journal=lambda: Journal(journal, question.fingerprint, resume=resume),
        chunk=chunk,
    )

    def work(watch: Watch) -> StudyResult:
        result = study(watch)
        write_table(result, out)
        if result.outcome == Outcome.COMPLETED.label:
            journal.unlink(missing_ok=True)
        return result

    return work


def table_text(result: StudyResult) -> str:
    """The table as CSV, units in the head; nothing where a figure is missing.

    Numbers are written so that reading gives exactly the same.
    """
    units = {column.name: column.unit for column in result.columns}
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(f"{name} [{units[name]}]" if units.get(name) else name for name in result.table)
    writer.writerows(zip(*result.table.values(), strict=True))
    return text.getvalue()


def write_table(result: StudyResult, out: Path) -> None:
    """Write the table, or as ``.json`` the whole result; an existing file is replaced when all is written.

    Raises:
        InputError: it cannot be written.
    """
    part = out.with_name(f"{out.name}.part")
    ending = out.suffix.lower()
    try:
        if ending == ".csv":
            part.write_text(table_text(result), encoding="utf-8", newline="\n")
        elif ending == ".json":
            part.write_bytes(answer_json(result) + b"\n")
        else:
            part.write_bytes(parquet_bytes(result, f"{out}: "))
        os.replace(part, out)
    except OSError as error:
        raise InputError(f"{out}: cannot be written: {error.strerror or error}") from error


def has_parquet() -> bool:
    """Whether what writes Parquet is installed; it is an extra."""
    return find_spec("pyarrow") is not None


def parquet_bytes(result: StudyResult, where: str = "") -> bytes:
    """The table as Parquet, SI.

    Raises:
        InputError: a library is missing.
    """
    _check_parquet(where)
    import pyarrow
    from pyarrow import parquet

    stream = io.BytesIO()
    parquet.write_table(pyarrow.table(dict(result.table)), stream)
    return stream.getvalue()


def _check_parquet(where: str) -> None:
    if not has_parquet():
        raise InputError(f"{where}parquet needs pyarrow", hint='pip install "mckibben[parquet]", or use CSV')
