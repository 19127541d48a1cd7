"""Journals: the results of long work in the order in which they come, so that it can be resumed.

JSON lines. The first names the work by a fingerprint of everything that it depends on; each other one holds
results, of a study the rows of a chunk. A line that a crash cut off is dropped, its part is done again.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import IO, Any, Self

import orjson

from mckibben.physics.errors import InputError
from mckibben.studies.table import Row

_STUDY = "study"
_FORM = "mckibben {} journal 1"
_ROWS = 1000  # in a line


class JournalFile:
    """A file that grows line by line while long work is done; a context manager.

    Args:
        path: of the journal.
        what: the work, for people: "study".
        fingerprint: of all that its entries depend on.
        resume: continue the journal that is there; without, it must not hold unfinished work.

    Raises:
        InputError: the journal cannot be read or written, or belongs to other work.
    """

    def __init__(self, path: Path, what: str, fingerprint: str, *, resume: bool) -> None:
        self.path = path
        #: What the journal held, in order.
        self.entries: list[Any] = []
        self._file: IO[bytes] | None = None
        whole = 0
        if path.exists():
            self.entries, whole = entries_of(path, what, fingerprint, resume=resume)
        try:
            if whole:
                self._file = path.open("r+b")
                self._file.truncate(whole)
                self._file.seek(whole)
            else:
                self._file = path.open("wb")
                self.add({"form": _FORM.format(what), what: fingerprint})
        except OSError as error:
            raise InputError(f"{path}: cannot be written: {error.strerror}") from error

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def add(self, entry: dict[str, Any]) -> None:
        """An entry; on disk when it returns, as far as the operating system is concerned.

        Raises:
            ValueError: the journal is closed.
        """
        if self._file is None:
            raise ValueError("the journal is closed")
        # json, not orjson: NaN stays NaN.
        self._file.write(json.dumps(entry, separators=(",", ":")).encode() + b"\n")
        self._file.flush()

    def end(self) -> None:
        """Remove the journal of complete work."""
        self.close()
        self.path.unlink(missing_ok=True)

    def close(self) -> None:
        """Close the file; the journal stays."""
        if self._file is not None:
            self._file.close()
            self._file = None


def entries_of(path: Path, what: str, fingerprint: str, *, resume: bool = True) -> tuple[list[Any], int]:
    """The entries of a journal, which another process may be writing, and the length of its whole lines.

    Args:
        path, what, fingerprint, resume: as of `JournalFile`.

    Raises:
        InputError: as `JournalFile`.
    """
    try:
        content = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from error
    content = content[: content.rfind(b"\n") + 1]
    lines = content.splitlines()
    if not lines:
        return [], 0
    try:
        head = orjson.loads(lines[0])
    except orjson.JSONDecodeError:
        head = None
    if not isinstance(head, dict) or head.get("form") != _FORM.format(what):
        raise InputError(f"{path}: is not the journal of a {what}", hint="remove or rename it")
    if not resume:
        raise InputError(
            f"{path}: holds the results of an unfinished {what}",
            hint="--resume continues it; remove the file to start again",
        )
    if head.get(what) != fingerprint:
        raise InputError(
            f"{path}: belongs to another {what} or version of the program",
            hint=f"resume it with the {what} it was started with, or remove the file",
        )
    entries = []
    for number, line in enumerate(lines[1:], start=2):
        try:
            entries.append(json.loads(line))
        except ValueError as error:
            raise damaged(path, number) from error
    return entries, len(content)


def damaged(path: Path, line: int) -> InputError:
    """The error of a journal with a line that cannot be used."""
    return InputError(f"{path}: line {line} is damaged", hint="remove the file")


class Journal(JournalFile):
    """The rows of a study as they come.

    Args:
        path, fingerprint, resume: as of `JournalFile`.

    Raises:
        InputError: as `JournalFile`.
    """

    def __init__(self, path: Path, fingerprint: str, *, resume: bool) -> None:
        super().__init__(path, _STUDY, fingerprint, resume=resume)
        #: Rows that the journal held, by the number of their run.
        self.known: dict[int, Row] = {}
        try:
            self.known |= _rows_in(path, self.entries)
        except InputError:
            self.close()
            raise
        self.entries.clear()

    def add_rows(self, runs: Sequence[int], rows: Sequence[Row]) -> None:
        """Rows of finished runs."""
        self.add({"rows": [[run, *_parts_of(row)] for run, row in zip(runs, rows, strict=True)]})


def journal_bytes(fingerprint: str, rows: Mapping[int, Row]) -> bytes:
    """A journal with all rows of a study, in the order of the runs."""
    lines: list[Any] = [{"form": _FORM.format(_STUDY), _STUDY: fingerprint}]
    runs = sorted(rows)
    for start in range(0, len(runs), _ROWS):
        part = [[run, *_parts_of(rows[run])] for run in runs[start : start + _ROWS]]
        lines.append({"rows": part})
    return b"".join(json.dumps(line, separators=(",", ":")).encode() + b"\n" for line in lines)


def checked_journal(content: bytes) -> tuple[str, int]:
    """Fingerprint and number of rows of a journal from elsewhere.

    Raises:
        ValueError: it is not the journal of a study, or is damaged.
    """
    head, *entries = (json.loads(line) for line in content.splitlines())
    if not isinstance(head, dict) or head.get("form") != _FORM.format(_STUDY):
        raise ValueError("not the journal of a study")
    runs = set()
    for entry in entries:
        for run, outcome, figures, message in entry["rows"]:
            numbers = isinstance(figures, list) and all(type(each) in (int, float) for each in figures)
            if type(run) is not int or run < 0 or not numbers:
                raise ValueError("a row of a study is damaged")
            if not (isinstance(outcome, str) and isinstance(message, str)):
                raise ValueError("a row of a study is damaged")
            runs.add(run)
    return str(head[_STUDY]), len(runs)


def _parts_of(row: Row) -> tuple[str, Sequence[float], str]:
    return row.outcome, row.figures, row.message


def rows_of(path: Path, fingerprint: str) -> dict[int, Row]:
    """The rows of a study in a journal, which another process may be writing, by the number of their run.

    Raises:
        InputError: as `Journal`.
    """
    return _rows_in(path, entries_of(path, _STUDY, fingerprint)[0])


def _rows_in(path: Path, entries: Sequence[Any]) -> dict[int, Row]:
    known = {}
    for number, entry in enumerate(entries, start=2):
        try:
            for run, outcome, figures, message in entry["rows"]:
                known[run] = Row(outcome, tuple(figures), message)
        except (ValueError, KeyError, TypeError) as error:
            raise damaged(path, number) from error
    return known
