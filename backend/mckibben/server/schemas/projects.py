"""Projects: what is sent and answered."""

from __future__ import annotations

from typing import Any

from pydantic import ConfigDict, Field

from mckibben.documents.strict import Strict
from mckibben.projects.project import ProjectSummary, Revision

_TITLE = Field(description="Title, in one line, at most 200 characters.", examples=["Lift, second muscle"])
_NOTES = Field(description="Notes of the user, plain text.")
_DOCUMENT = Field(
    description="The document: any JSON object. Measurements whose ids stand anywhere in it are kept with it."
)
_BASE = Field(description="Version that the change began with; 409 where the project has a later one.", ge=1)
_LABEL = Field(description="What was done, in words, for the history.", examples=["mass 20 kg"])
_STUDY = Field(
    default=None,
    description="The study of the document, as for /api/studies: its runs that the server keeps, up to 20 "
    "MB, are kept with the project. One that cannot be used is passed over. null: study tables stay.",
)


class NewProject(Strict):
    """A project to be kept."""

    title: str = _TITLE
    notes: str = Field(default="", description="Notes of the user, plain text.")
    document: dict[str, Any] = _DOCUMENT
    study: dict[str, Any] | None = _STUDY


class ProjectState(Strict):
    """A further state of a project."""

    document: dict[str, Any] = _DOCUMENT
    study: dict[str, Any] | None = _STUDY
    base_version: int = _BASE
    label: str = Field(default="saved", description="What was done, in words, for the history.")
    automatic: bool = Field(
        default=False,
        description="Saved without being asked for: such states replace each other within five minutes.",
    )


class ProjectChange(Strict):
    """Another title or other notes."""

    base_version: int = _BASE
    title: str | None = Field(default=None, description="New title; null = as it is.")
    notes: str | None = Field(default=None, description="New notes; null = as they are.")


class ProjectCopy(Strict):
    """How a copy is called."""

    title: str | None = Field(default=None, description='Title; null = that of the original with "(copy)".')


class ProjectAnswer(Strict):
    """A project with the document of one version."""

    project: ProjectSummary = Field(description="The project as it is now.")
    revision: Revision = Field(description="The version of the document.")
    document: dict[str, Any] = Field(description="The document as it was saved.")
    measurements: list[str] = Field(description="Ids of the measurements kept with it.")
    studies: int = Field(description="Number of study tables kept with it.")
    remarks: list[str] = Field(description="Study tables that are not kept or not shown, and why, in words.")

    model_config = ConfigDict(extra="forbid")


class ProjectsAnswer(Strict):
    """The projects, the one changed last first."""

    projects: list[ProjectSummary] = Field(description="The projects.")
    place: str = Field(description="The database they are in, without a password.")


class HistoryAnswer(Strict):
    """The versions of a project, the last one first."""

    history: list[Revision] = Field(description="The versions that are kept.")
