"""Pressures that were probably meant in bar are pointed out in every answer."""

from __future__ import annotations

from typing import Any

import pytest

from mckibben.application.curves.curves import CurvesQuestion, curves
from mckibben.application.curves.inverse import ContractionForForce, MuscleCondition, answer
from mckibben.application.operating_limits import pressure_notices
from mckibben.application.run.simulate import SimulationQuestion, simulate
from mckibben.application.size.size import prepare, sizing_question
from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_reading import drive_of
from mckibben.documents.start_model import StatedMuscle
from mckibben.documents.studio import Studio
from mckibben.documents.task import SizingTask
from mckibben.simulation.outcome import Watch
from tests.shipped import shipped_studio


@pytest.fixture(scope="module")
def studio() -> Studio:
    return shipped_studio()


def tiny(flags: list[Any]) -> dict[str | None, str]:
    return {notice.field: notice.message for notice in flags if notice.code == "tiny_pressure"}


def test_six_pascal_are_told_in_bar() -> None:
    (notice,) = pressure_notices({"supply.pressure": 6.0})
    assert notice.field == "supply.pressure"
    assert notice.message.startswith("6 Pa; did you mean 6 bar?")
    assert pressure_notices({"pressures.0": 0.0, "pressures.1": 1e4}) == []


def test_curves_and_inverse_questions_say_it(studio: Studio) -> None:
    start = studio.start_model(StatedMuscle(preset="DMSP-10"), None)
    assert set(tiny(curves(CurvesQuestion(start, pressures=(6.0, 3e5)), studio).flags)) == {"pressures.0"}
    assert tiny(curves(CurvesQuestion(start), studio).flags) == {}
    found = answer(ContractionForForce(condition=MuscleCondition(start), force=10.0, pressure=6.0), studio)
    assert set(tiny(found.flags)) == {"pressure"}


def test_runs_and_sizings_say_it(studio: Studio) -> None:
    document = {
        "muscle": {"preset": "DMSP-10"},
        "supply": {"pressure": 6},
        "valve": {"preset": "MPYE-5-M5"},
        "load": {"mass": 1.0},
        "command": {"shape": "step", "level": 1.0},
        "duration": 0.2,
    }
    run = simulate(SimulationQuestion(drive_of(DriveDocument.model_validate(document), studio)))
    assert set(tiny(run.flags)) == {"supply.pressure"}
    task = {
        "load": {"mass": 5.0}, "stroke": 0.02, "supply_pressure": 6,
        "catalogue": {"muscles": ["DMSP-10"], "valves": ["MPYE-5-M5"], "tubes": ["PUN-H-6x1"]},
    }  # fmt: skip
    found = prepare(sizing_question(SizingTask.model_validate(task), studio))(Watch())
    assert found.proposals == []
    assert set(tiny(found.flags)) == {"supply_pressure"}
