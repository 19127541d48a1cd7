"""The subject of a study: its document with varied values, and the runs of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from pydantic import BaseModel

from mckibben.application.size.size import ProposedDrive, prepare, sizing_question
from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_reading import drive_of, preset_document, read_document
from mckibben.documents.located import one_line
from mckibben.documents.studio import Studio
from mckibben.documents.study import Subject, drive_content
from mckibben.documents.study_fields import StudyField, field_at, with_values
from mckibben.documents.task import SizingTask, named_task, read_task
from mckibben.facts.study import WATCHED
from mckibben.physics.errors import InputError, fields_inside
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.outcome import Outcome, Watch
from mckibben.studies.drive_runs import DRIVE_FIGURES, REFUSED, DriveRuns
from mckibben.studies.run import CHUNK
from mckibben.studies.table import COMPLETED, Evaluate, Row
from mckibben.studies.variable import Variable

Array = np.ndarray
NO_PROPOSAL = "no_proposal"  # outcome of a task that no drive fulfils
#: Path -> SI unit of the figures of a task: those of its first proposal, and the number of proposals.
TASK_FIGURES = {path: figure.unit for path, figure in WATCHED.items() if path not in DRIVE_FIGURES}


@dataclass(frozen=True)
class StudySubject:
    """What is studied.

    Attributes:
        kind: "drive" or "task".
        content: its document as JSON, complete: nothing in it is left to a drive preset or a saved model.
        figures: path -> SI unit of the figures it has.
        chunk: runs that a worker gets at a time.
    """

    kind: Literal["drive", "task"]
    content: Mapping[str, Any]
    figures: Mapping[str, str]
    chunk: int

    @property
    def model(self) -> type[BaseModel]:
        """Of its document."""
        return DriveDocument if self.kind == "drive" else SizingTask

    def field(self, path: str, studio: Studio) -> StudyField:
        """The field at a path; raises InputError as `mckibben.documents.study_fields.field_at`."""
        return field_at(path, self.model, self.content, studio.effect_table)

    def with_point(
        self, variables: Sequence[Variable], fields: Sequence[StudyField], point: Sequence[float]
    ) -> dict[str, Any]:
        """The document with the values of a point; a factor multiplies the design, else the stated value."""
        values: dict[str, object] = {}
        numbers: dict[str, float] = {}
        both = list(zip(variables, fields, point, strict=True))
        for variable, field, value in both:
            if not variable.relative:
                numbers[variable.path] = float(value)
                values[variable.path] = field.written(variable.shown(value))
        for variable, field, value in both:
            if variable.relative:
                stated = numbers.get(variable.path, field.stated)
                if stated is None:
                    raise InputError(f"{variable.path} has no value that a factor could apply to")
                values[variable.path] = field.written(stated * float(value))
        return with_values(self.content, values)


def subject_of(subject: Subject, studio: Studio) -> StudySubject:
    """The subject of a study document.

    Raises:
        InputError: an unknown preset, or a document that cannot be used; ``field`` in the study.
    """
    if subject.task is not None:
        with fields_inside("subject.task"):
            task = named_task(subject.task, studio) if isinstance(subject.task, str) else subject.task
            sizing_question(task, studio)
        return StudySubject("task", task.to_document(), TASK_FIGURES, 1)
    with fields_inside("subject.drive"):
        preset = preset_document(subject.drive, studio) if isinstance(subject.drive, str) else None
        content = drive_content(subject, preset)
        annotated = drive_of(read_document(content, "the drive"), studio)
    if content.get("effects") is None:
        # Stated, so that one parameter can be varied without the others being dropped.
        content["effects"] = {name: dict(values) for name, values in annotated.start.effects.items()}
    return StudySubject("drive", content, DRIVE_FIGURES, CHUNK)


def evaluator(
    subject: StudySubject,
    variables: Sequence[Variable],
    fields: Sequence[StudyField],
    paths: Sequence[str],
    studio: Studio,
) -> Evaluate:
    """The function that runs points of a study."""

    def content_at(point: Array) -> dict[str, Any]:
        return subject.with_point(variables, fields, point.tolist())

    if subject.kind == "task":
        return _task_runs(content_at, paths, studio)

    def drive_at(point: Array) -> Drive:
        return drive_of(read_document(content_at(point), "the drive"), studio).drive

    return DriveRuns(drive_at, paths)


def _task_runs(content_at: Callable[[Array], object], paths: Sequence[str], studio: Studio) -> Evaluate:
    """Evaluates tasks: the figures of the first proposal."""

    def row(point: Array) -> Row:
        nothing = tuple(0.0 if path == "proposals" else float("nan") for path in paths)
        try:
            question = sizing_question(read_task(content_at(point)), studio)
        except InputError as error:
            return Row(REFUSED, (float("nan"),) * len(paths), one_line(error))
        result = prepare(question)(Watch())
        if result.outcome != Outcome.COMPLETED.label:
            return Row(result.outcome, (float("nan"),) * len(paths), result.message or "")
        if not result.proposals:
            why = result.rejected[0].why if result.rejected else "there are no parts"
            return Row(
                NO_PROPOSAL, nothing, f"{WATCHED['best.time'].exists_when.otherwise}; the nearest: {why}"
            )
        return Row(COMPLETED, tuple(_figure(result.proposals, path) for path in paths))

    def run(points: Array) -> list[Row]:
        return [row(point) for point in points]

    return run


def _figure(proposals: list[ProposedDrive], path: str) -> float:
    if path == "proposals":
        return float(len(proposals))
    value = getattr(proposals[0], path.removeprefix("best."))
    return float("nan") if value is None else float(value)
