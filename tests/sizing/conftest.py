"""Presets, opened once, and tasks made of documents."""

from __future__ import annotations

import json
from typing import Any

import pytest

from mckibben.application.json_text import to_json
from mckibben.application.size.size import prepare, sizing_question
from mckibben.application.size.task import catalogue_of, task_of
from mckibben.documents.studio import Studio
from mckibben.documents.task import SizingTask
from mckibben.simulation.outcome import Watch
from mckibben.sizing import PartsCatalogue, Task
from tests.shipped import shipped_studio

LIFT: dict[str, Any] = {
    "load": {"mass": "20 kg"},
    "stroke": "60 mm",
    "time": "0.5 s",
    "limits": {"max_length": "600 mm", "max_diameter": "60 mm"},
    "catalogue": {
        "muscles": ["DMSP-10", "DMSP-20", "DMSP-40"], "valves": ["MPYE-5-1/8-HF"], "tubes": ["PUN-H-6x1"],
    },
    "uncertainty": {"specimens": 0},
}  # fmt: skip


@pytest.fixture(scope="session")
def studio() -> Studio:
    return shipped_studio()


def understood(document: dict[str, Any], studio: Studio) -> tuple[Task, PartsCatalogue]:
    """Task and catalogue of a document."""
    given = SizingTask.model_validate(document)
    return task_of(given), catalogue_of(given, studio)


def sized(document: dict[str, Any], studio: Studio) -> dict[str, Any]:
    """The answer to a task, as JSON tells it."""
    return json.loads(to_json(prepare(sizing_question(SizingTask.model_validate(document), studio))(Watch())))
