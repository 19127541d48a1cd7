"""Summary of a drive document."""

from __future__ import annotations

import json
from collections.abc import Mapping

from mckibben.documents.drive import DriveDocument
from mckibben.report.summary.parts import Summary, Table


def document_text(document: DriveDocument) -> str:
    """The content of the file of a drive."""
    return json.dumps(document.to_document(), indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def summary_of(document: DriveDocument, name: str) -> Summary:
    """The stated parts, numbers in SI.

    Args:
        document: the drive.
        name: for the title.
    """
    parts = {key: part for key, part in document.to_document().items() if key not in ("schema", "title")}
    rows = [[key.replace("_", " "), _shown(part)] for key, part in parts.items()]
    title = f"{name}: {document.title}" if document.title and document.title != name else name
    return [Table(title, ["part", "stated (SI)"], rows)]


def _shown(part: object) -> str:
    if isinstance(part, Mapping):
        inside = (f"{key} ({_shown(value)})" if isinstance(value, Mapping) else f"{key} {_shown(value)}"
                  for key, value in part.items())  # fmt: skip
        return ", ".join(inside) or "as usual"
    if isinstance(part, list):
        return ", ".join(_shown(value) for value in part[:8]) + (", …" if len(part) > 8 else "")
    return f"{part:.6g}" if isinstance(part, float) else str(part)
