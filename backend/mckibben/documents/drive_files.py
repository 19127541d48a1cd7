"""Drive documents from JSON and from presets."""

from __future__ import annotations

from pathlib import Path

from mckibben.documents.drive import DriveDocument
from mckibben.documents.located import located
from mckibben.documents.problems import validated
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.presets import DrivePreset
from mckibben.presets.reading import BadDocumentError, parse, read_file


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
    return validated(DriveDocument, document, subject)


def named_document(name: str, studio: Studio) -> DriveDocument:
    """The document of a file, of a preset file, or of a preset.

    Raises:
        InputError: names the file, the field, what is wrong and what would be right.
    """
    path = Path(name)
    known = [preset.id for preset in studio.library.list("drives")]
    if name in known or not (path.exists() or name.lower().endswith(".json")):
        if name not in known:
            raise InputError(
                f"{name}: there is no such file and no such drive preset", hint=did_you_mean(name, known)
            )
        return preset_document(name, studio)
    try:
        content = read_file(path, follow_links=True)
        if isinstance(content, dict) and "kind" in content:
            preset = parse(DrivePreset, content, studio.effect_table)
            assert isinstance(preset, DrivePreset)  # noqa: S101 - parsed as one
            content = preset.document
        return read_document(content, "the drive")
    except BadDocumentError as bad:
        finding = bad.findings[0]
        raise InputError(f"{name}: {located(finding.field, finding.message)}", hint=finding.hint) from bad
    except InputError as error:
        message = located(error.field, error.message).removesuffix(".")
        raise InputError(f"{name}: {message}", hint=error.hint) from error
