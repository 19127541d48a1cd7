"""Rows of studies that outlive page and server: asked again, a study has all runs that were made before.

A study has a folder, named by all that its rows depend on. Each time it runs it writes a journal of its own
there, so that two at once do not disturb each other; reading takes all of them together.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import uuid
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import cache
from pathlib import Path

from mckibben.application.study.study import (
    Kept,
    StudyQuestion,
    StudyResult,
    fingerprint_of,
    prepare,
)
from mckibben.application.study.subject import StudySubject, subject_of
from mckibben.documents.studio import Studio
from mckibben.documents.study import StudyDocument
from mckibben.folder import QUOTAS
from mckibben.physics.errors import InputError
from mckibben.projects.project import StoredStudy
from mckibben.resources import presets_folder
from mckibben.simulation.outcome import Watch
from mckibben.studies.journal import Journal, journal_bytes, rows_of
from mckibben.studies.table import Row

_BROUGHT = "-brought.jsonl"  # sorted before all journals written here: rows made here replace it


class StudyStore:
    """Kept rows of studies.

    Args:
        data: folder of the user's data; the rows are in ``studies`` in it.
        quota: most bytes that they may take.
    """

    def __init__(self, data: Path, *, quota: int = QUOTAS.studies) -> None:
        self._folder, self.quota = data / "studies", quota

    def of(self, question: StudyQuestion) -> Callable[[], Kept]:
        """Opens the rows of a study, for `mckibben.application.study.study.prepare`."""
        folder = self._of(question.document, question.subject, question.studio)
        return lambda: _Rows(folder, question.fingerprint, self._tidy)

    def runs(self, question: StudyQuestion) -> int:
        """How many runs of a study are kept."""
        folder = self._of(question.document, question.subject, question.studio)
        return len(_read(folder, question.fingerprint))

    def result(self, question: StudyQuestion) -> StudyResult:
        """The result of the runs that are kept; none is made."""
        return prepare(question, journal=self.of(question))(Watch(cancelled=lambda: True))

    def stored(self, document: StudyDocument, studio: Studio) -> StoredStudy | None:
        """The kept rows of a study in one piece, to be taken elsewhere; None if there are none.

        Raises:
            InputError: the subject cannot be used.
        """
        fingerprint, environment = (
            fingerprint_of(document, subject_of(document.subject, studio)),
            environment_of(studio),
        )
        name = study_name(fingerprint, environment)
        known = _read(self._folder / name, fingerprint)
        return (
            StoredStudy(name, environment, len(known), journal_bytes(fingerprint, known)) if known else None
        )

    def bring(self, study: StoredStudy) -> None:
        """Keep rows that come from elsewhere; those that were made here go first."""
        path = self._folder / study.study / _BROUGHT
        with suppress(OSError):
            if path.exists() and path.read_bytes() == study.content:
                return
            path.parent.mkdir(parents=True, exist_ok=True)
            part = path.with_suffix(f".{uuid.uuid4().hex}")
            part.write_bytes(study.content)
            os.replace(part, path)
            os.utime(path.parent)
            self._tidy()

    def _of(self, document: StudyDocument, subject: StudySubject, studio: Studio) -> Path:
        return self._folder / study_name(fingerprint_of(document, subject), environment_of(studio))

    def size(self) -> int:
        """What the rows of all studies take on the disk [bytes]."""
        with suppress(OSError):
            return sum(self._sizes().values())
        return 0

    def erase(self) -> None:
        """Remove the rows of all studies; they are made again when they are asked for."""
        shutil.rmtree(self._folder, ignore_errors=True)

    def _sizes(self) -> dict[Path, int]:
        found = list(self._folder.iterdir()) if self._folder.exists() else []
        return {path: sum(file.stat().st_size for file in path.iterdir()) for path in found}

    def _tidy(self) -> None:
        """Remove the studies that were not used for longest while all take more than they may."""
        with suppress(OSError):
            sizes = self._sizes()
            found = sorted(sizes, key=lambda path: path.stat().st_mtime)
            total = sum(sizes.values())
            for path in found[:-1]:
                if total <= self.quota:
                    return
                shutil.rmtree(path, ignore_errors=True)
                total -= sizes[path]


class _Rows:
    """The rows of one study, and a journal for new ones; a disk that takes none costs the keeping alone."""

    def __init__(self, folder: Path, fingerprint: str, tidy: Callable[[], None]) -> None:
        self._folder, self._fingerprint, self._tidy = folder, fingerprint, tidy
        self._journal: Journal | None = None
        self._known = _read(folder, fingerprint)
        with suppress(OSError):
            os.utime(folder)

    @property
    def known(self) -> Mapping[int, Row]:
        """Rows by the number of their run."""
        return self._known

    def add_rows(self, runs: Sequence[int], rows: Sequence[Row]) -> None:
        """Keep rows of finished runs."""
        with suppress(OSError, InputError):
            if self._journal is None:
                self._folder.mkdir(parents=True, exist_ok=True)
                path = self._folder / f"{uuid.uuid4().hex}.jsonl"
                self._journal = Journal(path, self._fingerprint, resume=False)
            self._journal.add_rows(runs, rows)

    def close(self) -> None:
        """No further rows come."""
        if self._journal is not None:
            with suppress(OSError):
                self._journal.close()
            self._tidy()


def _read(folder: Path, fingerprint: str) -> dict[int, Row]:
    known: dict[int, Row] = {}
    with suppress(OSError):
        for path in sorted(folder.glob("*.jsonl")):
            with suppress(InputError):  # a damaged journal: its runs are made again
                known |= rows_of(path, fingerprint)
    return known


def study_name(fingerprint: str, environment: str) -> str:
    """Names all that the rows of a study depend on, alike on every machine."""
    return hashlib.sha256(f"{fingerprint}\n{environment}".encode()).hexdigest()[:32]


def environment_of(studio: Studio) -> str:
    """Of what rows depend on beside their study: the program, its presets, and the files of the user."""
    return hashlib.sha256(f"{studio.own_mark()}\n{_program_mark()}".encode()).hexdigest()


@cache
def _program_mark() -> str:
    """Of the code and the presets of the program, which may change without its version."""
    mark = hashlib.sha256()
    for folder in (Path(__file__).parents[1], presets_folder()):
        for path in sorted(path for path in folder.rglob("*") if path.suffix in (".py", ".json")):
            mark.update(f"{path.relative_to(folder).as_posix()}\n".encode() + path.read_bytes())
    return mark.hexdigest()
