"""Packed projects for the tests, written without the code that writes them."""

from __future__ import annotations

import io
import json
import zipfile
from typing import Any


def packed_project(document: dict[str, Any], measured: dict[str, bytes], **about: Any) -> bytes:
    """A packed project of one version with files by id; ``about`` replaces parts of project.json."""
    parts = {f"measurements/{number}.csv": content for number, content in enumerate(measured.values())}
    description = {
        "schema": "mckibben-project/1",
        "title": "Lift",
        "notes": "",
        "history": [
            {"version": 1, "saved": 1.6e9, "label": "created", "automatic": False, "file": "history/1.json"}
        ],
        "files": [
            {"measurement": identity, "name": "run1.csv", "mapping": None, "file": name}
            for identity, name in zip(measured, parts, strict=True)
        ],
    }
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        archive.writestr("project.json", json.dumps(description | about))
        archive.writestr("history/1.json", json.dumps(document))
        for name, content in parts.items():
            archive.writestr(name, content)
    return buffer.getvalue()
