"""Sizing tasks from JSON and from files."""

from __future__ import annotations

from pathlib import Path

from mckibben.documents.studio import Studio
from mckibben.documents.task import SizingTask
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.presets import TaskPreset
from mckibben.presets.reading import parse, read_file


def read_task_file(path: Path, studio: Studio) -> SizingTask:
    """The task of a file, or the one inside a preset file.

    Raises:
        BadDocumentError: the file cannot be read, or its preset is not valid.
        InputError: what is wrong, with ``field`` the path in the document.
    """
    return read_task(_content(path, studio))


def _content(path: Path, studio: Studio) -> object:
    """The content of a file, or the document inside a preset file."""
    content = read_file(path, follow_links=True)
    if not isinstance(content, dict) or "kind" not in content:
        return content
    preset = parse(TaskPreset, content, studio.effect_table)
    assert isinstance(preset, TaskPreset)  # noqa: S101 - parsed as one
    return preset.document


def read_task(document: object) -> SizingTask:
    """A task from JSON.

    Raises:
        InputError: what is wrong, with ``field`` the path in the document.
    """
    from mckibben.documents.problems import validated

    return validated(SizingTask, document, "the task")


def named_task(name: str, studio: Studio) -> SizingTask:
    """The task of a file, of a preset file, or of a preset.

    Raises:
        BadDocumentError: the file cannot be read, or its preset is not valid.
        InputError: what is wrong, with ``field`` the path in the document.
    """
    known = [preset.id for preset in studio.library.list("tasks")]
    if name in known or not (Path(name).exists() or name.lower().endswith(".json")):
        if name not in known:
            raise InputError("there is no such file and no such task preset", hint=did_you_mean(name, known))
        preset = studio.library.get("tasks", name)
        assert isinstance(preset, TaskPreset)  # noqa: S101 - of its folder
        return read_task(preset.document)
    return read_task_file(Path(name), studio)
