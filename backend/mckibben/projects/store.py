"""Projects: saved, opened, renamed, copied, put into the bin and taken out again.

Two windows that have the same project open never overwrite each other silently: a change states the version
that it began with, and is refused where the project has a later one.
"""

from __future__ import annotations

import builtins
import json
import time
from collections.abc import Iterable, Sequence
from uuid import uuid4

from sqlalchemy import select, update

from mckibben.physics.errors import InputError
from mckibben.projects.database import Database
from mckibben.projects.project import (
    MOST_DOCUMENT,
    Document,
    Project,
    ProjectSummary,
    Revision,
    StoredFile,
    StoredStudy,
    checked_history,
    checked_notes,
    checked_title,
)
from mckibben.projects.queries import (
    add_revision,
    empty_bin,
    keep_files,
    keep_studies,
    next_version,
    opened,
    remove,
    revision_of,
    row_of,
    summary_of,
    thin,
)
from mckibben.projects.tables import ContentRow, FileRow, ProjectRow, RevisionRow, StudyRow

_MERGED = 300_000  # ms; automatic saves in the same span of this length are one revision


class ProjectStore:
    """Projects of a database.

    Every method is one transaction. Unknown ids are refused as `InputError` with the code ``not_found``.

    Args:
        database: where they are.
    """

    def __init__(self, database: Database) -> None:
        self._database = database

    @property
    def place(self) -> str:
        """Where they are."""
        return self._database.place

    def close(self) -> None:
        """Close the database."""
        self._database.close()

    def list(self, *, deleted: bool = False) -> builtins.list[ProjectSummary]:
        """All projects, the one changed last first; or those in the bin."""
        with self._database.session() as session:
            chosen = ProjectRow.deleted.is_not(None) if deleted else ProjectRow.deleted.is_(None)
            rows = session.scalars(select(ProjectRow).where(chosen).order_by(ProjectRow.changed.desc()))
            return [summary_of(session, row) for row in rows]

    def create(
        self,
        document: Document,
        *,
        title: str,
        notes: str = "",
        files: Iterable[StoredFile] = (),
        studies: Iterable[StoredStudy] = (),
        label: str = "created",
    ) -> Project:
        """A new project with its first revision."""
        text, title, notes = _text_of(document), checked_title(title), checked_notes(notes)
        identity, now = uuid4().hex, _now()
        with self._database.session(writes=True) as session:
            empty_bin(session, now)
            session.add(
                ProjectRow(id=identity, title=title, notes=notes, version=1, created=now, changed=now)
            )
            session.flush()
            add_revision(session, identity, 1, now, label, automatic=False, text=text)
            keep_files(session, identity, files)
            keep_studies(session, identity, studies, now)
            return opened(session, identity)

    def open(self, identity: str, version: int | None = None) -> Project:
        """A project with its last document, or with that of an earlier version."""
        with self._database.session() as session:
            return opened(session, identity, version)

    def files(self, identity: str) -> builtins.list[StoredFile]:
        """The measurement files of a project, with their content."""
        with self._database.session() as session:
            row_of(session, identity)
            rows = session.execute(
                select(FileRow, ContentRow.data)
                .join(ContentRow, ContentRow.digest == FileRow.digest)
                .where(FileRow.project == identity)
                .order_by(FileRow.measurement)
            )
            return [StoredFile(row.measurement, row.name, data, row.mapping) for row, data in rows]

    def studies(self, identity: str) -> builtins.list[StoredStudy]:
        """The study tables of a project, the one saved last first."""
        with self._database.session() as session:
            row_of(session, identity)
            rows = session.execute(
                select(StudyRow, ContentRow.data)
                .join(ContentRow, ContentRow.digest == StudyRow.digest)
                .where(StudyRow.project == identity)
                .order_by(StudyRow.saved.desc(), StudyRow.study)
            )
            return [StoredStudy(row.study, row.environment, row.runs, data) for row, data in rows]

    def save(
        self,
        identity: str,
        document: Document,
        *,
        base_version: int,
        files: Iterable[StoredFile] = (),
        studies: Iterable[StoredStudy] = (),
        label: str = "saved",
        automatic: bool = False,
    ) -> Project:
        """A new revision.

        Args:
            identity: of the project.
            document: what is saved.
            base_version: version that the document was made from.
            files: all its measurements; those that are no longer named stay as long as an earlier revision
                may name them.
            studies: tables of studies to be kept with it; those kept before stay.
            label: what was done.
            automatic: whether the program saves by itself; such revisions replace each other for some
                minutes.

        Raises:
            ChangedElsewhereError: the project has another version.
        """
        text, now = _text_of(document), _now()
        with self._database.session(writes=True) as session:
            version = next_version(session, identity, base_version, now)
            before = session.get(RevisionRow, (identity, base_version))
            if automatic and before is not None and before.automatic and _same_span(before.saved, now):
                session.delete(before)
            add_revision(session, identity, version, now, label, automatic=automatic, text=text)
            thin(session, identity)
            keep_files(session, identity, files)
            keep_studies(session, identity, studies, now)
            return opened(session, identity)

    def describe(
        self, identity: str, *, base_version: int, title: str | None = None, notes: str | None = None
    ) -> ProjectSummary:
        """Another title or other notes; the document stays.

        Raises:
            ChangedElsewhereError: the project has another version.
        """
        with self._database.session(writes=True) as session:
            row, now = row_of(session, identity), _now()
            values = {
                "title": row.title if title is None else checked_title(title),
                "notes": row.notes if notes is None else checked_notes(notes),
            }
            if row.version == base_version and values == {"title": row.title, "notes": row.notes}:
                return summary_of(session, row)
            version = next_version(session, identity, base_version, now)
            before = session.get_one(RevisionRow, (identity, base_version))
            label = f"title: {values['title']}" if values["title"] != row.title else "notes changed"
            session.execute(update(ProjectRow).where(ProjectRow.id == identity).values(**values))
            add_revision(session, identity, version, now, label, automatic=False, text=before.document)
            return summary_of(session, row_of(session, identity))

    def duplicate(self, identity: str, *, title: str | None = None) -> Project:
        """A copy with the last document, all measurements and study tables, and a history of its own."""
        with self._database.session() as session:
            project = opened(session, identity)
        return self.create(
            project.document,
            title=title or f"{project.summary.title[:190]} (copy)",
            notes=project.summary.notes,
            files=self.files(identity),
            studies=self.studies(identity),
            label=f"copy of version {project.revision.version}",
        )

    def delete(self, identity: str) -> ProjectSummary:
        """Put a project into the bin, from which it can be restored for 30 days."""
        return self._binned(identity, _now())

    def restore(self, identity: str) -> ProjectSummary:
        """Take a project out of the bin."""
        return self._binned(identity, None)

    def erase(self, identity: str) -> ProjectSummary:
        """Remove a project that is in the bin for good."""
        with self._database.session(writes=True) as session:
            row = row_of(session, identity, binned=True)
            if row.deleted is None:
                raise InputError("only a deleted project can be erased", code="conflict")
            last = summary_of(session, row)
            remove(session, [identity])
            return last

    def history(self, identity: str) -> Sequence[Revision]:
        """The revisions of a project, the last one first."""
        with self._database.session() as session:
            row_of(session, identity)
            rows = session.scalars(
                select(RevisionRow)
                .where(RevisionRow.project == identity)
                .order_by(RevisionRow.version.desc())
            )
            return [revision_of(row) for row in rows]

    def revive(
        self,
        revisions: Sequence[tuple[Revision, Document]],
        *,
        title: str,
        notes: str = "",
        files: Iterable[StoredFile] = (),
        studies: Iterable[StoredStudy] = (),
    ) -> Project:
        """A project of another database, as a new one, with its history.

        Args:
            revisions: at least one, of different versions from 1.
            title, notes, files, studies: of the project; the studies saved last stand first.

        Raises:
            InputError: versions are missing, not positive or occur twice, or an instant is impossible.
        """
        last = max(each.version for each in checked_history([revision for revision, _ in revisions]))
        title, notes = checked_title(title), checked_notes(notes)
        texts = [(revision, _text_of(document)) for revision, document in revisions]
        identity, now = uuid4().hex, _now()
        with self._database.session(writes=True) as session:
            row = ProjectRow(id=identity, title=title, notes=notes, version=last, created=now, changed=now)
            session.add(row)
            session.flush()
            for revision, text in texts:
                saved = int(1e3 * revision.saved)
                add_revision(
                    session, identity, revision.version, saved, revision.label,
                    automatic=revision.automatic, text=text,
                )  # fmt: skip
            keep_files(session, identity, files)
            keep_studies(session, identity, studies, now)
            return opened(session, identity)

    def _binned(self, identity: str, deleted: int | None) -> ProjectSummary:
        with self._database.session(writes=True) as session:
            row = row_of(session, identity, binned=True)
            row.deleted = deleted
            session.flush()
            return summary_of(session, row)


def _text_of(document: Document) -> str:
    try:
        text = json.dumps(document, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
        text.encode()
    except (TypeError, ValueError) as error:
        raise InputError(f"the document cannot be stored: {error}", field="document") from error
    if len(text) > MOST_DOCUMENT:
        raise InputError(
            f"the document has {len(text)} characters", field="document", hint=f"at most {MOST_DOCUMENT}"
        )
    if "\\u0000" in text:
        raise InputError("the document holds a text with a zero character", field="document")
    return text


def _now() -> int:
    return time.time_ns() // 1_000_000


def _same_span(one: int, other: int) -> bool:
    return one // _MERGED == other // _MERGED
