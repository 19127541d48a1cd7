"""The JSON file of ``--drive``: a drive, or a model alone."""

from __future__ import annotations

from pathlib import Path

from mckibben.physics.errors import InputError, did_you_mean


def drive_document(path: str) -> dict[str, object]:
    """The parts of a drive document; a document of a model alone has only ``effects`` (and ``muscle``)."""
    from mckibben.documents.drive import DriveDocument
    from mckibben.presets.reading import BadDocumentError, read_file

    try:
        document = read_file(Path(path), follow_links=True)
    except BadDocumentError as bad:
        raise InputError(f"{path}: {bad.findings[0].message}", hint=bad.findings[0].hint) from bad
    if not isinstance(document, dict):
        raise InputError(f"{path}: a drive document is an object", hint='{"muscle": {...}, "effects": {...}}')
    known = {field.alias or name for name, field in DriveDocument.model_fields.items()}
    for key in document:
        if key not in known:
            raise InputError(f"{path}: {key} is not a known field", hint=did_you_mean(key, known))
    if not isinstance(document.get("effects", {}), dict):
        raise InputError(f"{path}: effects must be an object", hint='{"<effect id>": {}}')
    return document
