"""What a store of projects reads and writes within a transaction."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Sequence
from typing import Any

from sqlalchemy import delete, func, select, update
from sqlalchemy.dialects import postgresql, sqlite
from sqlalchemy.orm import Session

from mckibben.physics.errors import InputError
from mckibben.projects.project import (
    ChangedElsewhereError,
    Project,
    ProjectSummary,
    Revision,
    StoredFile,
    StoredStudy,
    is_version,
)
from mckibben.projects.tables import ContentRow, FileRow, ProjectRow, RevisionRow, StudyRow

_MOST_REVISIONS = 200  # of a project; the oldest automatic ones give way first
_BIN = 30 * 86_400_000  # ms that a deleted project can be restored
_MOST_LABEL = 200
_MOST_STUDIES, _MOST_STUDY_BYTES = 8, 40_000_000  # of a project; those saved first give way


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
    changed = False
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
        _limit_studies(session, identity)
        _drop_contents(session)


def _limit_studies(session: Session, identity: str) -> None:
    """Remove the study tables that were saved first beyond what a project keeps."""
    rows = session.execute(
        select(StudyRow, func.length(ContentRow.data))
        .join(ContentRow, ContentRow.digest == StudyRow.digest)
        .where(StudyRow.project == identity)
        .order_by(StudyRow.saved.desc(), StudyRow.study)
    ).all()
    total = 0
    for number, (row, size) in enumerate(rows):
        total += size
        if number and (number >= _MOST_STUDIES or total > _MOST_STUDY_BYTES):
            session.delete(row)
    session.flush()


def _drop_contents(session: Session) -> None:
    """Erase contents that no project needs any more."""
    unused = [ContentRow.digest.not_in(select(table.digest)) for table in (FileRow, StudyRow)]
    session.execute(delete(ContentRow).where(*unused).execution_options(synchronize_session=False))


def empty_bin(session: Session, now: int) -> None:
    """Erase what has been in the bin for too long."""
    old = list(session.scalars(select(ProjectRow.id).where(ProjectRow.deleted < now - _BIN)))
    if old:
        remove(session, old)


def remove(session: Session, identities: Sequence[str]) -> None:
    """Erase projects, and contents that no project needs any more."""
    for table in (FileRow, StudyRow, RevisionRow):
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
    (files, size), (_, tables) = (
        session.execute(
            select(func.count(), func.coalesce(func.sum(func.length(ContentRow.data)), 0))
            .select_from(table)
            .join(ContentRow, ContentRow.digest == table.digest)
            .where(table.project == row.id)
        ).one()
        for table in (FileRow, StudyRow)
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
        size=int(size) + int(tables) + int(document or 0),
    )
