"""Tables of studies in projects: taken from the runs that are kept, given back where they are missing.

Rows hold for a study together with the program, its presets and the files of the user. A table goes along
with these named: where they are others, it stays in the project and is not shown as a result.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from pydantic import ValidationError

from mckibben.application.study.store import StudyStore, environment_of, study_name
from mckibben.documents.studio import Studio
from mckibben.documents.study import StudyDocument
from mckibben.physics.errors import InputError
from mckibben.projects.project import StoredStudy
from mckibben.studies.journal import checked_journal

MOST_BYTES = 20_000_000  # of a table that goes along with a project


def table_of(
    study: Mapping[str, Any] | None, kept: StudyStore, studio: Studio
) -> tuple[list[StoredStudy], list[str]]:
    """The kept rows of a study document, to be stored with a project, and what there is to say about them.

    A study that cannot be used has no rows: it must not keep a project from being saved.
    """
    if study is None:
        return [], []
    try:
        found = kept.stored(StudyDocument.model_validate(study), studio)
    except (ValidationError, InputError):
        return [], []
    if found is None:
        return [], []
    if len(found.content) > MOST_BYTES:
        words = (
            f"The table of the study ({found.runs} runs, {len(found.content) / 1e6:.0f} MB) is not kept with "
            f"the project, which takes tables up to {MOST_BYTES / 1e6:.0f} MB: save it as CSV or Parquet."
        )
        return [], [words]
    return [found], []


def give_back(studies: Iterable[StoredStudy], kept: StudyStore, studio: Studio) -> list[str]:
    """Keep the tables of a project here again, as far as they hold; what there is to say of the others."""
    here, foreign = environment_of(studio), 0
    for study in studies:
        if study.environment == here:
            kept.bring(study)
        else:
            foreign += 1
    if not foreign:
        return []
    what = (
        "A study table of this project is" if foreign == 1 else f"{foreign} study tables of this project are"
    )
    return [
        f"{what} from another version of the program, or from other presets or terms of your own; not shown "
        "here, but still in the project. Run the study again for results of this version."
    ]


def study_from(environment: str, content: bytes) -> StoredStudy:
    """The study table of a packed project.

    Raises:
        ValueError: it is damaged or too large.
    """
    if len(content) > MOST_BYTES:
        raise ValueError(f"a study table of more than {MOST_BYTES / 1e6:.0f} MB")
    if len(environment) != 64:
        raise ValueError("a study table without its origin")
    fingerprint, runs = checked_journal(content)
    return StoredStudy(study_name(fingerprint, environment), environment, runs, content)
