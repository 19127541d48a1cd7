"""Projects: saved, opened, renamed, copied, put into the bin and taken out again.

Two windows that have the same project open never overwrite each other silently: a change states the version
that it began with, and is refused where the project has a later one.
"""

from __future__ import annotations

import builtins
import contextlib
import hashlib
import json
import time
from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import Any
from uuid import uuid4

from sqlalchemy import delete, func, select, update
from sqlalchemy.dialects import postgresql, sqlite
from sqlalchemy.orm import Session

from mckibben.folder import QUOTAS, no_space
from mckibben.physics.errors import InputError
from mckibben.projects.database import Database
from mckibben.projects.project import (
    MOST_DOCUMENT,
    ChangedElsewhereError,
    Document,
    Project,
    ProjectSummary,
    Revision,
    StoredAnswer,
    StoredFile,
    StoredStudy,
    checked_history,
    checked_notes,
    checked_title,
    is_version,
)
from mckibben.projects.tables import AnswerRow, ContentRow, FileRow, ProjectRow, RevisionRow, StudyRow

_MERGED = 300_000  # ms; automatic saves in the same span of this length are one revision

_MOST_REVISIONS = 200  # of a project; the oldest automatic ones give way first
_MOST_LABEL = 200
_MOST_STUDIES, _MOST_STUDY_BYTES = 8, 40_000_000  # of a project; those saved first give way
_MOST_ANSWERS, _MOST_ANSWER_BYTES = 32, 40_000_000  # of a project; those saved first give way


class ProjectStore:
    """Projects of a database.

    Every method is one transaction. Unknown ids are refused as `InputError` with the code ``not_found``.

    Args:
        database: where they are.
        quota: most bytes that all may take, with those in the bin, which is emptied before more are refused.
    """

    def __init__(self, database: Database, *, quota: int = QUOTAS.projects) -> None:
        self._database = database
        self.quota = quota

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
        answers: Iterable[StoredAnswer] = (),
        label: str = "created",
    ) -> Project:
        """A new project with its first revision."""
        text, title, notes = _text_of(document), checked_title(title), checked_notes(notes)
        identity, now = uuid4().hex, _now()
        with self._writing(len(text)) as session:
            session.add(
                ProjectRow(id=identity, title=title, notes=notes, version=1, created=now, changed=now)
            )
            session.flush()
            add_revision(session, identity, 1, now, label, automatic=False, text=text)
            keep_files(session, identity, files)
            keep_studies(session, identity, studies, now)
            keep_answers(session, identity, answers, now)
            return opened(session, identity)

    def open(self, identity: str, version: int | None = None) -> Project:
        """A project with its last document, or with that of an earlier version."""
        with self._database.session() as session:
            return opened(session, identity, version)

    def files(self, identity: str) -> Iterator[StoredFile]:
        """The measurement files of a project, one after the other: all at once may be more than fits."""
        with self._database.session() as session:
            row_of(session, identity)
            order = select(FileRow.measurement).where(FileRow.project == identity)
            measurements = session.scalars(order.order_by(FileRow.measurement)).all()
        for measurement in measurements:
            with self._database.session() as session:
                row = session.get(FileRow, (identity, measurement))
                content = None if row is None else session.get(ContentRow, row.digest)
                if row is None or content is None:  # erased meanwhile
                    continue
                file = StoredFile(row.measurement, row.name, content.data, row.mapping)
            yield file

    def answers(self, identity: str, known: Collection[str] = ()) -> Iterator[StoredAnswer]:
        """The finished diagnoses of a project, without known ones, one after the other."""
        for name in sorted(self.answer_names(identity) - set(known)):
            with self._database.session() as session:
                row = session.get(AnswerRow, (identity, name))
                content = None if row is None else session.get(ContentRow, row.digest)
                data = None if content is None else content.data
            if data is not None:
                yield StoredAnswer(name, data)

    def answer_names(self, identity: str) -> set[str]:
        """Names of the finished diagnoses kept with a project; none of a project that is not there."""
        with self._database.session() as session:
            return set(session.scalars(select(AnswerRow.name).where(AnswerRow.project == identity)))

    def measurements(self, identity: str) -> set[str]:
        """Ids of the measurements kept with a project; none of a project that is not there."""
        with self._database.session() as session:
            return set(session.scalars(select(FileRow.measurement).where(FileRow.project == identity)))

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
        answers: Iterable[StoredAnswer] = (),
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
            studies, answers: tables of studies and finished diagnoses to be kept with it; those kept before
                stay.
            label: what was done.
            automatic: whether the program saves by itself; such revisions replace each other for some
                minutes.

        Raises:
            ChangedElsewhereError: the project has another version.
        """
        text, now = _text_of(document), _now()
        with self._writing(len(text)) as session:
            version = next_version(session, identity, base_version, now)
            before = session.get(RevisionRow, (identity, base_version))
            if automatic and before is not None and before.automatic and _same_span(before.saved, now):
                session.delete(before)
            add_revision(session, identity, version, now, label, automatic=automatic, text=text)
            thin(session, identity)
            keep_files(session, identity, files)
            keep_studies(session, identity, studies, now)
            keep_answers(session, identity, answers, now)
            return opened(session, identity)

    def describe(
        self, identity: str, *, base_version: int, title: str | None = None, notes: str | None = None
    ) -> ProjectSummary:
        """Another title or other notes; the document stays.

        Raises:
            ChangedElsewhereError: the project has another version.
        """
        with self._writing(0) as session:
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
            answers=self.answers(identity),
            label=f"copy of version {project.revision.version}",
        )

    def delete(self, identity: str) -> ProjectSummary:
        """Put a project into the bin, from which it can be restored until its room is needed."""
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
        self._database.shrink()
        return last

    def empty_bin(self) -> None:
        """Erase all deleted projects."""
        with self._database.session(writes=True) as session:
            remove(session, [*session.scalars(select(ProjectRow.id).where(ProjectRow.deleted.is_not(None)))])
        self._database.shrink()

    def size(self) -> tuple[int, int]:
        """What all projects take, with those in the bin, and what only those in the bin take [bytes]."""
        with self._database.session() as session:
            rows = session.scalars(select(ProjectRow).where(ProjectRow.deleted.is_not(None)))
            return self._database.taken(session), sum(summary_of(session, row).size for row in rows)

    def check_room(self, size: int) -> None:
        """Refuse what is about to be written before it is.

        Args:
            size: of it [bytes].

        Raises:
            InputError: code ``no_space``, it has no room beside what is kept, without the bin.
        """
        with self._database.session() as session:
            taken = self._database.taken(session)
        if taken + size > self.quota:
            binned = self.size()[1]
            if taken - binned + size > self.quota:
                raise self._no_space(taken - binned, size)

    def _no_space(self, taken: int, needs: int) -> InputError:
        place = self._database.folder
        return no_space("projects", taken=taken, quota=self.quota, needs=needs, folder=place)

    @contextlib.contextmanager
    def _writing(self, size: int) -> Iterator[Session]:
        """A transaction that adds something; undone where all then takes more than it may.

        Args:
            size: of what is added at least [bytes].
        """
        with self._database.session(writes=True) as session:
            before = self._database.taken(session)
            yield session
            session.flush()
            if self._database.taken(session) <= max(self.quota, before):
                return
            oldest = select(ProjectRow.id).where(ProjectRow.deleted.is_not(None)).order_by(ProjectRow.deleted)
            for identity in session.scalars(oldest).all():
                remove(session, [identity])
                if self._database.taken(session) <= self.quota:
                    return
            raise self._no_space(before, max(size, self._database.taken(session) - before))

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
        with self._writing(sum(len(text) for _, text in texts)) as session:
            row = ProjectRow(id=identity, title=title, notes=notes, version=last, created=now, changed=now)
            session.add(row)
            session.flush()
            for revision, text in texts:
                saved = int(1e3 * revision.saved)
                add_revision(
                    session, identity, revision.version, saved, revision.label,
                    automatic=revision.automatic, text=text,
                )  # fmt: skip
            thin(session, identity)
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


def row_of(session: Session, identity: str, *, binned: bool = False) -> ProjectRow:
    """The row of a project; one in the bin only if it may be there."""
    row = session.get(ProjectRow, identity, populate_existing=True)
    if row is None or (row.deleted is not None and not binned):
        hint = "take it out of the bin first" if row else "list them with GET /api/projects"
        raise InputError(f"there is no project {identity[:32]}", field="id", hint=hint, code="not_found")
    return row


def next_version(session: Session, identity: str, base_version: int, now: int) -> int:
    """Claim the version after the base; the condition makes it safe against other processes."""
    if not is_version(base_version):
        row_of(session, identity)
        raise ChangedElsewhereError(last_revision(session, identity))
    claimed: Any = session.execute(
        update(ProjectRow)
        .where(ProjectRow.id == identity, ProjectRow.version == base_version, ProjectRow.deleted.is_(None))
        .values(version=base_version + 1, changed=now)
        .execution_options(synchronize_session=False)
    )
    if claimed.rowcount != 1:
        row_of(session, identity)
        raise ChangedElsewhereError(last_revision(session, identity))
    return base_version + 1


def last_revision(session: Session, identity: str) -> Revision:
    """The revision that a project has now."""
    row = session.scalars(
        select(RevisionRow)
        .where(RevisionRow.project == identity)
        .order_by(RevisionRow.version.desc())
        .limit(1)
    ).one()
    return revision_of(row)


def add_revision(
    session: Session, identity: str, version: int, now: int, label: str, *, automatic: bool, text: str
) -> None:
    """Add a revision to a project."""
    label = " ".join(label.replace("\0", " ").split())[:_MOST_LABEL] or "saved"
    session.add(
        RevisionRow(
            project=identity, version=version, saved=now, label=label, automatic=automatic, document=text
        )
    )
    session.flush()


def thin(session: Session, identity: str) -> None:
    """Remove the oldest revisions beyond the most that are kept, automatic ones first."""
    rows = session.execute(
        select(RevisionRow.version, RevisionRow.automatic)
        .where(RevisionRow.project == identity)
        .order_by(RevisionRow.automatic.desc(), RevisionRow.version)
    ).all()
    last = max(version for version, _ in rows)
    spare = [version for version, _ in rows if version != last][: max(len(rows) - _MOST_REVISIONS, 0)]
    if spare:
        session.execute(
            delete(RevisionRow).where(RevisionRow.project == identity, RevisionRow.version.in_(spare))
        )


def keep_files(session: Session, identity: str, files: Iterable[StoredFile]) -> None:
    """Store the files that a project does not have yet."""
    have = set(session.scalars(select(FileRow.measurement).where(FileRow.project == identity)))
    for file in files:
        if file.measurement in have:
            continue
        have.add(file.measurement)
        row = FileRow(
            project=identity, measurement=file.measurement, name=file.name[:200],
            digest=_keep_content(session, file.content), mapping=file.mapping,
        )  # fmt: skip
        session.add(row)
    session.flush()


def _keep_content(session: Session, content: bytes) -> str:
    digest = hashlib.sha256(content).hexdigest()
    if session.get(ContentRow, digest) is None:
        # Another process may store the same file at this moment.
        insert = postgresql.insert if session.get_bind().dialect.name == "postgresql" else sqlite.insert
        row = insert(ContentRow).values(digest=digest, data=content)
        session.execute(row.on_conflict_do_nothing())
    return digest


def keep_studies(session: Session, identity: str, studies: Iterable[StoredStudy], now: int) -> None:
    """Store tables of studies, one with at least as many runs instead of an earlier one of the same study."""
    # A clock that was set back does not make a table older than those that it replaces.
    last = select(func.max(StudyRow.saved)).where(StudyRow.project == identity)
    now, changed = max(now, 1 + (session.scalar(last) or 0)), False
    for study in studies:
        before = session.get(StudyRow, (identity, study.study))
        if before is not None and before.runs >= study.runs:
            continue
        digest, changed = _keep_content(session, study.content), True
        session.merge(
            StudyRow(
                project=identity, study=study.study, environment=study.environment, runs=study.runs,
                saved=now, digest=digest,
            )
        )  # fmt: skip
        session.flush()
    if changed:
        _limit(session, identity, StudyRow, _MOST_STUDIES, _MOST_STUDY_BYTES)
        _drop_contents(session)


def keep_answers(session: Session, identity: str, answers: Iterable[StoredAnswer], now: int) -> None:
    """Store the finished diagnoses that a project does not have yet."""
    last = select(func.max(AnswerRow.saved)).where(AnswerRow.project == identity)
    now, changed = max(now, 1 + (session.scalar(last) or 0)), False
    for answer in answers:
        if session.get(AnswerRow, (identity, answer.name)) is None:
            digest, changed = _keep_content(session, answer.content), True
            session.add(AnswerRow(project=identity, name=answer.name, saved=now, digest=digest))
            session.flush()
    if changed:
        _limit(session, identity, AnswerRow, _MOST_ANSWERS, _MOST_ANSWER_BYTES)
        _drop_contents(session)


def _limit(
    session: Session, identity: str, table: type[StudyRow | AnswerRow], most: int, most_bytes: int
) -> None:
    """Remove results that were saved first beyond what a project keeps."""
    rows = session.execute(
        select(table, func.length(ContentRow.data))
        .join(ContentRow, ContentRow.digest == table.digest)
        .where(table.project == identity)
        .order_by(table.saved.desc(), table.digest)
    ).all()
    total = 0
    for number, (row, size) in enumerate(rows):
        total += size
        if number and (number >= most or total > most_bytes):
            session.delete(row)
    session.flush()


def _drop_contents(session: Session) -> None:
    """Erase contents that no project needs any more."""
    unused = [ContentRow.digest.not_in(select(table.digest)) for table in (FileRow, StudyRow, AnswerRow)]
    session.execute(delete(ContentRow).where(*unused).execution_options(synchronize_session=False))


def remove(session: Session, identities: Sequence[str]) -> None:
    """Erase projects, and contents that no project needs any more."""
    for table in (FileRow, StudyRow, AnswerRow, RevisionRow):
        session.execute(delete(table).where(table.project.in_(identities)))
    session.execute(delete(ProjectRow).where(ProjectRow.id.in_(identities)))
    _drop_contents(session)


def opened(session: Session, identity: str, version: int | None = None) -> Project:
    """A project with its last document, or that of a version."""
    row = row_of(session, identity)
    wanted = row.version if version is None else version
    revision = session.get(RevisionRow, (identity, wanted)) if is_version(wanted) else None
    if revision is None:
        raise InputError(
            f"the project has no version {version}",
            field="version",
            hint="its history lists those that are kept",
            code="not_found",
        )
    measurements = session.scalars(
        select(FileRow.measurement).where(FileRow.project == identity).order_by(FileRow.measurement)
    )
    studies = session.scalars(
        select(StudyRow.study).where(StudyRow.project == identity).order_by(StudyRow.study)
    )
    return Project(
        summary_of(session, row),
        revision_of(revision),
        json.loads(revision.document),
        tuple(measurements),
        tuple(studies),
    )


def revision_of(row: RevisionRow) -> Revision:
    """A row as a revision."""
    return Revision(row.version, row.saved / 1e3, row.label, row.automatic)


def summary_of(session: Session, row: ProjectRow) -> ProjectSummary:
    """A row as a project in a list."""
    (files, size), (_, tables), (_, answers) = (
        session.execute(
            select(func.count(), func.coalesce(func.sum(func.length(ContentRow.data)), 0))
            .select_from(table)
            .join(ContentRow, ContentRow.digest == table.digest)
            .where(table.project == row.id)
        ).one()
        for table in (FileRow, StudyRow, AnswerRow)
    )
    document = session.scalar(
        select(func.length(RevisionRow.document)).where(
            RevisionRow.project == row.id, RevisionRow.version == row.version
        )
    )
    return ProjectSummary(
        id=row.id,
        title=row.title,
        notes=row.notes,
        version=row.version,
        created=row.created / 1e3,
        changed=row.changed / 1e3,
        deleted=None if row.deleted is None else row.deleted / 1e3,
        files=int(files),
        size=int(size) + int(tables) + int(answers) + int(document or 0),
    )
