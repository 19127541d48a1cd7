"""Projects that the page saves, from Python."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mckibben.application.measurement.experiment import QuestionMeasurement
from mckibben.application.project.projects import found_project, packed, unpacked
from mckibben.door.frames import frame_of_rows
from mckibben.door.measurement import Measurement
from mckibben.door.problem import reported
from mckibben.door.rendering import notebook_cell, plain_text
from mckibben.extras import of_extra
from mckibben.measurement.points import Points
from mckibben.measurement.reading import read_correction, read_measurement
from mckibben.physics.errors import InputError
from mckibben.projects.project import Project as Opened
from mckibben.report.summary import Summary, Table
from mckibben.resources import user_folder

if TYPE_CHECKING:
    import pandas as pd

    from mckibben.projects.store import ProjectStore

_HISTORY = ("version", "saved", "what", "automatic")


def _store() -> ProjectStore:
    from mckibben.projects.database import Database
    from mckibben.projects.store import ProjectStore

    return ProjectStore(Database(os.environ.get("MCKIBBEN_PROJECTS") or user_folder()))


class Project:
    """A project that the page saves: document, notes, measurements, history.

    They are in the user's data folder, or in the database that ``MCKIBBEN_PROJECTS`` names.
    """

    __slots__ = ("_opened", "_projects")

    def __init__(self, projects: ProjectStore, opened: Opened) -> None:
        self._projects = projects
        self._opened = opened

    @staticmethod
    @reported
    def list() -> pd.DataFrame:
        """All projects, the one changed last first; instants are UTC."""
        pd = of_extra("pandas")
        rows = [
            (e.title, e.id, pd.Timestamp(e.changed, unit="s", tz="UTC"), e.version, e.files, e.size)
            for e in _store().list()
        ]
        return frame_of_rows(("title", "id", "changed", "version", "files", "bytes"), rows)

    @classmethod
    @reported
    def open(cls, name: str, *, version: int | None = None) -> Project:
        """A project by its title, its id or the first characters of the id.

        Raises:
            Problem: there is none, or several of that title.
        """
        projects = _store()
        return cls(projects, projects.open(found_project(projects, name).id, version))

    @classmethod
    @reported
    def create(cls, title: str, document: Mapping[str, Any], *, notes: str = "") -> Project:
        """Keep a document (what the page saves as JSON) as a new project.

        Raises:
            Problem: the title or document cannot be kept.
        """
        projects = _store()
        return cls(projects, projects.create(document, title=title, notes=notes))

    @classmethod
    @reported
    def unpack(cls, path: str | os.PathLike[str]) -> Project:
        """A project of another machine, from the file that `pack` or the page wrote.

        Raises:
            Problem: the file cannot be read or is damaged.
        """
        from mckibben.measurement.store import MeasurementStore

        try:
            source = Path(path).open("rb")  # noqa: SIM115 - closed below
        except OSError as error:
            words = f"{path}: {error.strerror or error}"
            raise InputError(words, hint="name a file that can be read") from error
        projects = _store()
        with source:
            return cls(projects, unpacked(source, projects, MeasurementStore(user_folder())))

    @property
    def id(self) -> str:
        """Its id."""
        return self._opened.summary.id

    @property
    def title(self) -> str:
        """Its title."""
        return self._opened.summary.title

    @property
    def notes(self) -> str:
        """Notes of the user."""
        return self._opened.summary.notes

    @property
    def version(self) -> int:
        """Version of the document."""
        return self._opened.revision.version

    @property
    def document(self) -> Mapping[str, Any]:
        """The document of the page."""
        return self._opened.document

    @reported
    def measurements(self) -> tuple[Measurement, ...]:
        """Its measurement files, read as on the page.

        Raises:
            Problem: a file can no longer be read.
        """
        found = [
            read_measurement(file.content, file.name, read_correction(file.mapping or "{}"))
            for file in self._projects.files(self.id)
        ]
        return tuple(Measurement(QuestionMeasurement(Points(measurement))) for measurement in found)

    @reported
    def history(self) -> pd.DataFrame:
        """Its versions, the last one first; instants are UTC."""
        pd = of_extra("pandas")
        rows = [
            (e.version, pd.Timestamp(e.saved, unit="s", tz="UTC"), e.label, e.automatic)
            for e in self._projects.history(self.id)
        ]
        return frame_of_rows(_HISTORY, rows)

    @reported
    def save(self, document: Mapping[str, Any], label: str = "saved from Python") -> Project:
        """A further version of the document; this object keeps the one it has.

        Raises:
            Problem: somebody else has saved the project since it was opened.
        """
        saved = self._projects.save(self.id, document, base_version=self._opened.summary.version, label=label)
        return Project(self._projects, saved)

    @reported
    def pack(self, path: str | os.PathLike[str]) -> Path:
        """Write it as one file, with history, measurements and study tables, for another machine.

        Raises:
            Problem: the file cannot be written.
        """
        try:
            with Path(path).open("wb") as into:
                packed(self._projects, self.id, into)
        except OSError as error:
            words = f"{path}: {error.strerror or error}"
            raise InputError(words, hint="name another file") from error
        return Path(path)

    def _summary(self) -> Summary:
        summary = self._opened.summary
        rows = [["version", f"{self.version}"], ["measurements", f"{summary.files}"]]
        if self._opened.studies:
            rows.append(["study tables", f"{len(self._opened.studies)}"])
        parts: Summary = [Table(f"Project {summary.title}", ["", ""], rows)]
        return [*parts, summary.notes] if summary.notes else parts

    def __str__(self) -> str:
        return plain_text(self._summary())

    def __repr__(self) -> str:
        return f"<Project {self.title!r}, version {self.version}>"

    def _repr_html_(self) -> str:
        return notebook_cell(f"Project {self.title}", (), self._summary())
