"""Drive documents from JSON and from presets."""

from __future__ import annotations

from mckibben.documents.drive import DriveDocument
from mckibben.documents.problems import first_problem
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError
from mckibben.presets import DrivePreset


def preset_document(preset_id: str, studio: Studio) -> DriveDocument:
    """The document of a drive preset.

    Raises:
        InputError: there is no such preset, or its document cannot be used.
    """
    try:
        preset = studio.library.get("drives", preset_id)
    except InputError as error:
        raise error.at(None, code="unknown_preset") from error
    assert isinstance(preset, DrivePreset)  # noqa: S101 - of its folder
    return read_document(preset.document, f"the drive preset {preset.id}")


def read_document(document: object, subject: str) -> DriveDocument:
    """A drive document from JSON.

    Args:
        document: parsed JSON.
        subject: name of the document in messages.

    Raises:
        InputError: the document is not valid; ``field`` is the path in it.
    """
    from pydantic import ValidationError

    try:
        return DriveDocument.model_validate(document)
    except ValidationError as error:
        problem = first_problem(error.errors(), DriveDocument, document, subject)
        raise InputError(
            problem.message, field=problem.field, hint=problem.hint, code=problem.code
        ) from error
