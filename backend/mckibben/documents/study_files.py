"""Studies from JSON and from files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from mckibben.documents.located import located
from mckibben.documents.problems import validated
from mckibben.documents.study import StudyDocument
from mckibben.physics.errors import InputError
from mckibben.presets.reading import BadDocumentError, read_file


def read_study(document: object) -> StudyDocument:
    """A study from JSON.

    Raises:
        InputError: what is wrong, with ``field`` the path in the document.
    """
    return validated(StudyDocument, document, "the study")


def read_study_file(path: Path) -> StudyDocument:
    """The study of a file; its subject may name other JSON files, relative to it.

    Raises:
        InputError: names the file, the field, what is wrong and what would be right.
    """
    try:
        content = _content(path, "")
        if isinstance(content, dict) and isinstance(subject := content.get("subject"), dict):
            content = {**content, "subject": {name: _named(part, path) for name, part in subject.items()}}
        return read_study(content)
    except InputError as error:
        raise in_file(str(path), error) from error


def in_file(file: str, error: InputError) -> InputError:
    """The error with its file and its whole field in front: several quantities may have the same mistake."""
    message = error.message.removesuffix(".")
    if error.field and not message.startswith(error.field):
        message = f"{error.field}: {message}"
    return InputError(f"{file}: {message}", hint=error.hint, code=error.code)


def _named(part: Any, study: Path) -> object:
    """The content of the file that a part of the subject names; other parts unchanged."""
    if not isinstance(part, str) or not part.lower().endswith(".json"):
        return part
    content = _content(study.parent / part, f"{part}: ")
    presets = ("drives", "drive", "tasks", "task")
    if isinstance(content, dict) and content.get("kind") in presets and "document" in content:
        return content["document"]
    return content


def _content(path: Path, named: str) -> object:
    try:
        return read_file(path, follow_links=True)
    except BadDocumentError as bad:
        finding = bad.findings[0]
        raise InputError(f"{named}{located(finding.field, finding.message)}", hint=finding.hint) from bad
