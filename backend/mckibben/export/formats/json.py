"""JSON: the model with everything said of it; reading the file gives the same model."""

from __future__ import annotations

import json
from dataclasses import asdict

from mckibben.export.registry import ExportedFile, Format
from mckibben.export.subject import Subject


def write(subject: Subject, stem: str) -> tuple[ExportedFile, ...]:
    """The document that stands alone, and what every file says of the model."""
    content = {"schema": 1, "kind": "export", "about": asdict(subject.about), "document": subject.document}
    text = json.dumps(content, indent=1, ensure_ascii=False, allow_nan=False)
    return (ExportedFile.of_text(f"{stem}.json", text, "application/json"),)


FORMAT = Format(
    title="JSON",
    note="the model with the source of every number; can be read again",
    write=write,
)
