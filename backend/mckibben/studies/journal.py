"""The journal of a study: its runs in the order in which they end, so that it can be resumed.

JSON lines. The first names the study by a fingerprint of everything that its runs depend on; each other one
holds the rows of a chunk. A line that a crash cut off is dropped, its runs are made again.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import IO, Any

import orjson

from mckibben.physics.errors import InputError
from mckibben.studies.table import Row

_FORM = "mckibben study journal 1"


class Journal:
    """Writes rows as they come; a context manager.

    Args:
        path: of the journal.
        fingerprint: of the study.
        resume: continue the journal that is there; without, it must not hold an unfinished study.

    Raises:
        InputError: the journal cannot be read or written, or belongs to another study.
    """

    def __init__(self, path: Path, fingerprint: str, *, resume: bool) -> None:
        self.path, self._fingerprint = path, fingerprint
        #: Rows that the journal held, by the number of their run.
        self.known: dict[int, Row] = {}
        self._file: IO[bytes] | None = None
        whole = self._read(resume) if path.exists() else b""
        try:
            if whole:
                self._file = path.open("r+b")
                self._file.truncate(len(whole))
                self._file.seek(len(whole))
            else:
                self._file = path.open("wb")
                self._write({"form": _FORM, "study": fingerprint})
        except OSError as error:
            raise InputError(f"{path}: cannot be written: {error.strerror}") from error

    def __enter__(self) -> Journal:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def add(self, runs: Sequence[int], rows: Sequence[Row]) -> None:
        """Rows of finished runs; on disk when it returns, as far as the operating system is concerned."""
        # json, not orjson: NaN stays NaN.
        self._write(
            {
                "rows": [
                    [run, row.outcome, row.figures, row.message] for run, row in zip(runs, rows, strict=True)
                ]
            }
        )

    def end(self) -> None:
        """Remove the journal of a complete study."""
        self.close()
        self.path.unlink(missing_ok=True)

    def close(self) -> None:
        """Close the file; the journal stays."""
        if self._file is not None:
            self._file.close()
            self._file = None

    def _write(self, content: dict[str, Any]) -> None:
        if self._file is None:
            raise ValueError("the journal is closed")
        self._file.write(json.dumps(content, separators=(",", ":")).encode() + b"\n")
        self._file.flush()

    def _read(self, resume: bool) -> bytes:
        """Fill ``known``; returns the part of the file that is whole."""
        try:
            content = self.path.read_bytes()
        except OSError as error:
            raise InputError(f"{self.path}: cannot be read: {error.strerror}") from error
        content = content[: content.rfind(b"\n") + 1]
        lines = content.splitlines()
        if not lines:
            return b""
        try:
            head = orjson.loads(lines[0])
        except orjson.JSONDecodeError:
            head = None
        if not isinstance(head, dict) or head.get("form") != _FORM:
            raise InputError(f"{self.path}: is not the journal of a study", hint="remove or rename it")
        if not resume:
            raise InputError(
                f"{self.path}: holds the runs of an unfinished study",
                hint="--resume continues it; remove the file to start again",
            )
        if head.get("study") != self._fingerprint:
            raise InputError(
                f"{self.path}: belongs to another study or version of the program",
                hint="resume it with the study it was started with, or remove the file",
            )
        for number, line in enumerate(lines[1:], start=2):
            try:
                for run, outcome, figures, message in json.loads(line)["rows"]:
                    self.known[run] = Row(outcome, tuple(figures), message)
            except (ValueError, KeyError, TypeError) as error:
                raise InputError(f"{self.path}: line {number} is damaged", hint="remove the file") from error
        return content
