"""Tables of the projects' database; `migrations` brings an existing database to this state."""

from __future__ import annotations

from sqlalchemy import BigInteger, ForeignKey, LargeBinary, MetaData, String, Text
from sqlalchemy.orm import DeclarativeBase, Mapped, mapped_column

#: Names of constraints, so that a migration can name what it changes on every database.
NAMES = {
    "pk": "pk_%(table_name)s",
    "fk": "fk_%(table_name)s_%(column_0_name)s",
    "ix": "ix_%(table_name)s_%(column_0_name)s",
}


class Base(DeclarativeBase):
    """All tables."""

    metadata = MetaData(naming_convention=NAMES)


class ProjectRow(Base):
    """A project; instants are milliseconds since 1970 (UTC)."""

    __tablename__ = "projects"

    id: Mapped[str] = mapped_column(String(32), primary_key=True)
    title: Mapped[str] = mapped_column(String(200))
    notes: Mapped[str] = mapped_column(Text, default="")
    version: Mapped[int] = mapped_column(BigInteger)
    created: Mapped[int] = mapped_column(BigInteger)
    changed: Mapped[int] = mapped_column(BigInteger, index=True)
    deleted: Mapped[int | None] = mapped_column(BigInteger, default=None)


class RevisionRow(Base):
    """The document of a project as it was saved."""

    __tablename__ = "revisions"

    project: Mapped[str] = mapped_column(
        String(32), ForeignKey("projects.id", ondelete="CASCADE"), primary_key=True
    )
    version: Mapped[int] = mapped_column(BigInteger, primary_key=True)
    saved: Mapped[int] = mapped_column(BigInteger)
    label: Mapped[str] = mapped_column(String(200))
    automatic: Mapped[bool]
    document: Mapped[str] = mapped_column(Text)


class ContentRow(Base):
    """Bytes of a measurement file or of a study's table, by the sha256 of its content."""

    __tablename__ = "contents"

    digest: Mapped[str] = mapped_column(String(64), primary_key=True)
    data: Mapped[bytes] = mapped_column(LargeBinary)


class FileRow(Base):
    """A measurement of a project: its id, name and content, and how the user corrected its columns."""

    __tablename__ = "project_files"

    project: Mapped[str] = mapped_column(
        String(32), ForeignKey("projects.id", ondelete="CASCADE"), primary_key=True
    )
    measurement: Mapped[str] = mapped_column(String(64), primary_key=True)
    name: Mapped[str] = mapped_column(String(200))
    digest: Mapped[str] = mapped_column(String(64), ForeignKey("contents.digest"), index=True)
    mapping: Mapped[str | None] = mapped_column(Text, default=None)


class AnswerRow(Base):
    """A finished diagnosis of a project; `saved` in milliseconds since 1970 (UTC)."""

    __tablename__ = "project_answers"

    project: Mapped[str] = mapped_column(
        String(32), ForeignKey("projects.id", ondelete="CASCADE"), primary_key=True
    )
    name: Mapped[str] = mapped_column(String(64), primary_key=True)
    saved: Mapped[int] = mapped_column(BigInteger)
    digest: Mapped[str] = mapped_column(String(64), ForeignKey("contents.digest"), index=True)


class StudyRow(Base):
    """The table of a study of a project; `saved` in milliseconds since 1970 (UTC)."""

    __tablename__ = "project_studies"

    project: Mapped[str] = mapped_column(
        String(32), ForeignKey("projects.id", ondelete="CASCADE"), primary_key=True
    )
    study: Mapped[str] = mapped_column(String(64), primary_key=True)
    environment: Mapped[str] = mapped_column(String(64))
    runs: Mapped[int] = mapped_column(BigInteger)
    saved: Mapped[int] = mapped_column(BigInteger)
    digest: Mapped[str] = mapped_column(String(64), ForeignKey("contents.digest"), index=True)
