"""The verdicts on a folder as a file, and the journal beside it while the diagnoses run."""

from __future__ import annotations

import csv
import hashlib
import io
import os
from collections.abc import Iterator, Sequence
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

from mckibben.application.diagnose.folder import Ask, Diagnose, FileVerdict, diagnose_each
from mckibben.application.json_text import answer_json
from mckibben.application.study.file import journal_of
from mckibben.physics.errors import InputError
from mckibben.simulation.outcome import Watch
from mckibben.studies.journal import JournalFile, damaged
from mckibben.version import __version__

ENDINGS = (".csv", ".json")


def check_out(out: Path, resume: bool) -> None:
    """Check that verdicts can be written there, before long work is done for them.

    Raises:
        InputError: an unknown ending, no such folder, nothing to resume.
    """
    if out.suffix.lower() not in ENDINGS:
        raise InputError(
            f"--out {out}: '{out.suffix}' is not a known ending", hint=f"one of {', '.join(ENDINGS)}"
        )
    if out.is_dir() or not out.parent.is_dir():
        what = "is a folder" if out.is_dir() else f"there is no folder {out.parent}"
        raise InputError(f"--out {out}: {what}", hint="name a file in an existing folder")
    if resume and out.exists() and not journal_of(out).exists():
        raise InputError(f"--out {out}: is complete, there is nothing to resume", hint="omit --resume")


def fingerprint(asked: object) -> str:
    """Of what is asked about every file: options and the files that they name."""
    return hashlib.sha256(f"{__version__}\n{asked!r}".encode()).hexdigest()


def diagnose_kept(
    files: Sequence[Path],
    ask: Ask,
    diagnose: Diagnose,
    watch: Watch,
    *,
    out: Path,
    asked: str,
    resume: bool,
) -> Iterator[FileVerdict]:
    """As `diagnose_each`; verdicts are kept in a journal beside ``out``, and not made again from there.

    A file whose content has changed since is diagnosed again. The journal stays: `finish` ends it.

    Args:
        files, ask, diagnose, watch: as there.
        out: where the table of verdicts will be.
        asked: the `fingerprint` of the options.
        resume: continue the journal that is there.

    Raises:
        InputError: the journal belongs to other options, or cannot be written.
    """
    contents = {path.name: _digest(path) for path in files}
    with JournalFile(journal_of(out), "diagnosis", asked, resume=resume) as journal:
        known: dict[str, FileVerdict] = {}
        for number, entry in enumerate(journal.entries, start=2):
            verdict, content = _read(entry, journal.path, number)
            if contents.get(verdict.file) == content:
                known[verdict.file] = verdict
        yield from known.values()
        left = [path for path in files if path.name not in known]
        for verdict in diagnose_each(left, ask, diagnose, watch, before=len(known)):
            journal.add({"verdict": asdict(verdict), "content": contents[verdict.file]})
            yield verdict


def _digest(path: Path) -> str:
    try:
        return hashlib.sha256(path.read_bytes()).hexdigest()
    except OSError:
        return ""  # told when it is read as a measurement


def _read(entry: Any, path: Path, number: int) -> tuple[FileVerdict, str]:
    try:
        return FileVerdict(**entry["verdict"]), entry["content"]
    except (KeyError, TypeError) as error:
        raise damaged(path, number) from error


def finish(verdicts: Sequence[FileVerdict], out: Path, *, complete: bool) -> None:
    """Write the table of verdicts, SI; an existing file is replaced when all is written.

    Args:
        verdicts: in the order of the table.
        out: .csv or .json.
        complete: nothing is missing; the journal is removed.

    Raises:
        InputError: it cannot be written.
    """
    part = out.with_name(f"{out.name}.part")
    try:
        if out.suffix.lower() == ".csv":
            part.write_text(verdicts_text(verdicts), encoding="utf-8", newline="\n")
        else:
            part.write_bytes(answer_json({"files": verdicts}) + b"\n")
        os.replace(part, out)
    except OSError as error:
        raise InputError(f"--out {out}: cannot be written: {error.strerror or error}") from error
    if complete:
        journal_of(out).unlink(missing_ok=True)


def verdicts_text(verdicts: Sequence[FileVerdict]) -> str:
    """The table as CSV, SI; effects are separated by spaces, nothing where a figure is missing."""
    names = [field.name for field in fields(FileVerdict)]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(names)
    for verdict in verdicts:
        row = asdict(verdict) | {"effects": " ".join(verdict.effects)}
        writer.writerow([row[name] for name in names])
    return text.getvalue()
