"""What a study of a subject can vary and watch."""

from __future__ import annotations

from typing import Any, Literal

from mckibben.application.study.file import has_parquet
from mckibben.application.study.subject import subject_of
from mckibben.documents.drive_reading import drive_of, read_document
from mckibben.documents.studio import Studio
from mckibben.documents.study import Subject
from mckibben.documents.study_fields import stated_paths
from mckibben.facts.result import result_class
from mckibben.physics.errors import InputError
from mckibben.studies.table import Figure


@result_class
class OpenQuantity:
    """A quantity that a study can vary."""

    path: str
    """Path in the document of the subject."""
    unit: str
    """SI unit."""
    value: float | None
    """Present value in SI; None for a plain gain, whose unit the document does not state."""


@result_class
class StudyOptions:
    """What a study of a subject can vary and watch."""

    kind: Literal["drive", "task"]
    """What the subject is."""
    quantities: list[OpenQuantity]
    """Quantities, in the order of the document."""
    figures: list[Figure]
    """Figures."""
    document: dict[str, Any]
    """The document of the subject with the effects of its presets stated."""
    parquet: bool
    """Whether the server can write tables as Parquet."""


def study_options(subject: Subject, studio: Studio) -> StudyOptions:
    """What a study of this subject can vary and watch.

    Raises:
        InputError: as `mckibben.application.study.subject.subject_of`.
    """
    found = subject_of(subject, studio)
    presets = _of_presets(found.content, studio) if found.kind == "drive" else {}
    quantities = []
    for path in stated_paths(found.model, found.content, studio.effect_table):
        try:
            field = found.field(path, studio)
        except InputError:  # a part, a list, a profile: no single value
            continue
        value = presets.get(path) if field.stated is None else field.stated
        if field.unit is not None and (value is not None or field.as_text):
            quantities.append(OpenQuantity(path, field.unit, value))
    figures = [Figure(path, unit) for path, unit in found.figures.items()]
    return StudyOptions(found.kind, quantities, figures, dict(found.content), has_parquet())


def _of_presets(content: Any, studio: Studio) -> dict[str, float]:
    """The length of the muscle where its preset says it: path -> value in SI."""
    muscle = drive_of(read_document(content, "the drive"), studio).start.muscle
    return {"muscle.nominal_length": muscle.nominal_length}
