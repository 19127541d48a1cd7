"""What a store of projects takes and gives."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from mckibben.facts.result import result_class
from mckibben.physics.errors import InputError

MOST_TITLE, MOST_NOTES, MOST_DOCUMENT = 200, 100_000, 900_000  # characters
MOST_VERSION = 10**9
_LAST_INSTANT = 4e9  # s since 1970, the year 2096

Document = Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class StoredFile:
    """A measurement file of a project.

    Attributes:
        measurement: id of the measurement; it depends on the content and on the mapping.
        name: of the file, for people.
        content: its bytes.
        mapping: how the user corrected its columns, as JSON; None without a correction.
    """

    measurement: str
    name: str
    content: bytes
    mapping: str | None = None


@dataclass(frozen=True, slots=True)
class StoredStudy:
    """The table of a study in a project.

    Attributes:
        study: names all that its rows depend on.
        environment: the part of that which is not in the study: program, presets and terms of the user.
        runs: number of rows.
        content: the rows, as a journal of the study.
    """

    study: str
    environment: str
    runs: int
    content: bytes


@dataclass(frozen=True, slots=True)
class StoredAnswer:
    """A finished diagnosis in a project.

    Attributes:
        name: names all that it depends on; nothing but its own question finds it.
        content: as it was kept.
    """

    name: str
    content: bytes


@result_class
class ProjectSummary:
    """A project in a list; instants are seconds since 1970 (UTC)."""

    id: str
    """Its id."""
    title: str
    """Title, in one line, at most 200 characters."""
    notes: str
    """Notes of the user, plain text."""
    version: int
    """Number of its last revision; it grows with each change."""
    created: float
    """Instant, seconds since 1970 (UTC)."""
    changed: float
    """Instant of the last change, seconds since 1970 (UTC)."""
    deleted: float | None
    """Instant when it was deleted; None = it is not in the bin."""
    files: int
    """Number of measurements kept with it."""
    size: int
    """Characters and bytes of the last document, of the measurements and of the study tables."""


@result_class
class Revision:
    """A saved state in the history of a project."""

    version: int
    """Its number."""
    saved: float
    """Instant, seconds since 1970 (UTC)."""
    label: str
    """What was done, in words, for the history."""
    automatic: bool
    """Whether it was saved without being asked for."""


@dataclass(frozen=True, slots=True)
class Project:
    """A project with the document of one of its revisions, ids of its measurements and of its studies."""

    summary: ProjectSummary
    revision: Revision
    document: Document
    measurements: tuple[str, ...]
    studies: tuple[str, ...] = ()


class ChangedElsewhereError(InputError):
    """The project was saved by somebody else since it was opened.

    Attributes:
        last: the revision that is there now.
    """

    def __init__(self, last: Revision) -> None:
        self.last = last
        super().__init__(
            "the project has been saved elsewhere since it was opened here",
            field="base_version",
            hint=f"open version {last.version}, save a copy, or save again with base_version {last.version} "
            "to replace it",
            code="conflict",
        )


def checked_title(title: str) -> str:
    """A title in one line.

    Raises:
        InputError: it is empty or too long.
    """
    title = " ".join("".join(c if c.isprintable() else " " for c in title).split())
    if not title:
        raise InputError("a project needs a title", field="title", hint="e.g. 'Lift, second muscle'")
    if len(title) > MOST_TITLE:
        raise InputError(
            f"the title has {len(title)} characters", field="title", hint=f"at most {MOST_TITLE}"
        )
    return title


def checked_notes(notes: str) -> str:
    """Notes as they are.

    Raises:
        InputError: they are too long.
    """
    if len(notes) > MOST_NOTES:
        raise InputError(
            f"the notes have {len(notes)} characters", field="notes", hint=f"at most {MOST_NOTES}"
        )
    return notes.replace("\0", "")


def checked_history(revisions: Sequence[Revision]) -> Sequence[Revision]:
    """Revisions as they are.

    Raises:
        InputError: there are none, versions are not different numbers from 1, or an instant is impossible.
    """
    versions = [revision.version for revision in revisions]
    if not versions or len(set(versions)) != len(versions) or not all(map(is_version, versions)):
        raise InputError("the versions of a project are different numbers from 1", field="history")
    if not all(0.0 <= revision.saved <= _LAST_INSTANT for revision in revisions):
        raise InputError("a version was saved at no possible instant", field="history")
    return revisions


def is_version(number: int) -> bool:
    """Whether a project can have a version of this number."""
    return 1 <= number <= MOST_VERSION
