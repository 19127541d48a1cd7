"""JSON files of a model: a drive, muscle and effects alone, or a saved model."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from mckibben.documents.kinds import is_preset, no_such, refuse_other, refuse_table
from mckibben.documents.located import at_file
from mckibben.documents.shorthand import MUSCLE_TEXT
from mckibben.physics.errors import InputError, did_you_mean

if TYPE_CHECKING:
    from mckibben.documents.saved_model import SavedModel
    from mckibben.documents.studio import Studio


def _read(path: str) -> dict[str, object]:
    from mckibben.presets.reading import BadDocumentError, read_file

    refuse_table(path, "drive")
    try:
        document = read_file(Path(path), follow_links=True)
    except BadDocumentError as bad:
        raise InputError(f"{path}: {bad.findings[0].message}", hint=bad.findings[0].hint) from bad
    if not isinstance(document, dict):
        raise InputError(f"{path}: a drive document is an object", hint='{"muscle": {...}, "effects": {...}}')
    return document


def drive_document(path: str, studio: Studio) -> dict[str, object]:
    """The parts of a drive document or preset; that of a model alone has only ``effects`` (and ``muscle``).

    Of a saved model, and of the model of a diagnosis, they are those of its drive, if it has one.

    Args:
        path: of the file, or the id of a drive preset.
        studio: presets.

    Raises:
        InputError: names the file, the field, what is wrong and what would be right.
    """
    from mckibben.documents.drive import DriveDocument
    from mckibben.presets import DrivePreset

    if path in [preset.id for preset in studio.library.list("drives")]:
        preset = studio.library.get("drives", path)
        assert isinstance(preset, DrivePreset)  # noqa: S101 - of its folder
        return dict(preset.document)
    if not path.lower().endswith(".json") and not Path(path).exists():
        raise no_such(path, "drive", studio.library)
    document = _read(path)
    refuse_other(document, path, ("drive", "model", "muscle"))
    if document.get("kind") == "model":
        document = saved_model(path).to_document()
        document = {name: document[name] for name in ("muscle", "effects", "drive") if name in document}
    if is_preset(document):
        document = {"drive": document.get("document")}
    inside = document.pop("drive", None)
    if isinstance(inside, dict):
        document = inside
    elif inside is not None:
        raise InputError(f"{path}: drive must be an object", hint='{"muscle": {...}, "valve": {...}}')
    known = {field.alias or name for name, field in DriveDocument.model_fields.items()}
    for key in document:
        if key not in known:
            raise InputError(f"{path}: {key} is not a known field", hint=did_you_mean(key, known))
    if "muscle" in document:
        document["muscle"] = MUSCLE_TEXT.document(document["muscle"])
    effects = document.get("effects", {})
    if not isinstance(effects, dict):
        raise InputError(f"{path}: effects must be an object", hint='{"<effect id>": {}}')
    for name, values in effects.items():
        if not isinstance(values, dict):
            raise InputError(f"{path}: effects.{name} must be an object", hint=f'{{"{name}": {{}}}}')
    return document


def saved_model(path: str) -> SavedModel:
    """The saved model in a file.

    Raises:
        InputError: names the file, the field, what is wrong and what would be right.
    """
    from mckibben.documents.saved_model import read_saved_model

    try:
        document = _read(path)
        refuse_other(document, path, ("model",))
        return read_saved_model(document, path)
    except InputError as error:
        if error.message.startswith(path):
            raise
        raise at_file(path, error.field, error.message, error.hint) from error
