"""From a file, a preset or a document to what is exported."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, cast

from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_reading import named_document, read_document
from mckibben.documents.kinds import kind_of
from mckibben.documents.located import at_file
from mckibben.documents.model_files import drive_document, saved_model
from mckibben.documents.muscle_files import Effects, is_file, start_of_file, start_of_input
from mckibben.documents.saved_model import SavedModel
from mckibben.documents.shorthand import MUSCLE_TEXT
from mckibben.documents.start_model import stated_muscle
from mckibben.documents.studio import Studio
from mckibben.export.subject import Stated
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.presets import DrivePreset
from mckibben.presets.reading import BadDocumentError, read_file


def stated_source(name: str, studio: Studio) -> Stated:
    """The model or drive that a file or the id of a preset names.

    A file may be a drive document or preset, a saved model, a muscle with or without effects, a muscle
    preset, or what the format ``json`` wrote. Ids are those of muscles ("DMSP-20:300mm") and drives.

    Raises:
        InputError: names the file, the field, what is wrong and what would be right.
    """
    drives = [preset.id for preset in studio.library.list("drives")]
    if name in drives:
        return _drive_preset(name, studio)
    if not is_file(name, studio) and not Path(name).exists():
        preset = name.partition(":")[0]
        muscles = [each.id for each in studio.library.list("muscles")]
        if preset.lower() not in {each.lower() for each in muscles}:
            known = did_you_mean(preset, [*drives, *muscles])
            raise InputError(f"{name[:80]}: there is no such file, muscle preset or drive preset", hint=known)
        return Stated(start_of_input(studio, MUSCLE_TEXT.document(name), None, name))
    return _file(Path(name), studio)


def _file(path: Path, studio: Studio) -> Stated:
    source = str(path)
    try:
        content = read_file(path, follow_links=True)
    except BadDocumentError as bad:
        finding = bad.findings[0]
        raise at_file(source, finding.field, finding.message, finding.hint) from bad
    document: dict[str, Any] = content if isinstance(content, dict) else {}
    kind = document.get("kind")
    if kind == "model":
        return of_saved(saved_model(source), studio, source)
    if kind_of(document) in ("drive", "task", "study") or "valve" in (document.get("drive") or {}):
        return of_drive(named_document(source, studio), studio, source)
    if "muscle" in document and kind is None:
        parts = drive_document(source, studio)
        return Stated(
            start_of_input(studio, parts["muscle"], cast("Effects | None", parts.get("effects")), source)
        )
    return Stated(start_of_file(studio, path, None, None))


def _drive_preset(name: str, studio: Studio) -> Stated:
    preset = studio.library.get("drives", name)
    assert isinstance(preset, DrivePreset)  # noqa: S101 - of its folder
    document = read_document(preset.document, f"the drive preset {name}")
    return of_drive(document, studio, name, title=name, grounds=preset.grounds)


def of_drive(
    document: DriveDocument, studio: Studio, source: str, *, title: str = "", grounds: Any = None
) -> Stated:
    """A drive document as what is exported.

    Raises:
        InputError: names source and field.
    """
    with _of(source):
        start = studio.start_model(stated_muscle(document.muscle), document.effects)
    return Stated(start, document.title or title, None, document, grounds)


def of_saved(saved: SavedModel, studio: Studio, source: str) -> Stated:
    """A saved model as what is exported, with its drive if it has one.

    Raises:
        InputError: it is a model of muscles of several lengths, without one of its own.
    """
    if saved.muscle.nominal_length is None and saved.muscle.preset is None:
        error = InputError(
            "the model is one of muscles of several lengths and has none itself",
            field="muscle.nominal_length",
            hint="state the length of yours in it",
        )
        raise error if not source else at_file(source, error.field, error.message, error.hint)
    with _of(source):
        start = studio.start_model(stated_muscle(saved.muscle), saved.effects)
        return Stated(start, "", saved, saved.drive)


@contextmanager
def _of(source: str) -> Iterator[None]:
    """Errors of a file name it; those of a request ("") keep their field."""
    try:
        yield
    except InputError as error:
        if not source:
            raise
        raise at_file(source, error.field, error.message, error.hint) from error
