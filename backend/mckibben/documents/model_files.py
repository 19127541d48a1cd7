"""JSON files of a model: a drive, muscle and effects alone, or a saved model."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from mckibben.documents.located import at_file
from mckibben.physics.errors import InputError, did_you_mean

if TYPE_CHECKING:
    from mckibben.documents.saved_model import SavedModel


def _read(path: str) -> dict[str, object]:
    from mckibben.presets.reading import BadDocumentError, read_file

    try:
        document = read_file(Path(path), follow_links=True)
    except BadDocumentError as bad:
        raise InputError(f"{path}: {bad.findings[0].message}", hint=bad.findings[0].hint) from bad
    if not isinstance(document, dict):
        raise InputError(f"{path}: a drive document is an object", hint='{"muscle": {...}, "effects": {...}}')
    return document


def drive_document(path: str) -> dict[str, object]:
    """The parts of a drive document or preset; that of a model alone has only ``effects`` (and ``muscle``).

    Of a saved model, and of the model of a diagnosis, they are those of its drive, if it has one.
    """
    from mckibben.documents.drive import DriveDocument

    document = _read(path)
    if document.get("kind") == "model":
        document = saved_model(path).to_document()
        document = {name: document[name] for name in ("muscle", "effects", "drive") if name in document}
    if document.get("kind") == "drive":  # a preset
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
        return read_saved_model(_read(path), path)
    except InputError as error:
        if error.message.startswith(path):
            raise
        raise at_file(path, error.field, error.message, error.hint) from error
