"""The figures, limits and inputs of a sizing against the formulas and the types that they belong to."""

from __future__ import annotations

import re
from math import radians, sqrt
from typing import get_args

import pytest

from mckibben.documents.task import SizingTask
from mckibben.facts.sizing import LIMITS
from mckibben.facts.task import TASK, usual
from mckibben.sizing.statics import LimitName
from mckibben.sizing.task import DesignLimits, Task, Uncertainty


def test_every_limit_is_declared() -> None:
    assert set(LIMITS) == set(get_args(LimitName))


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("supply_pressure", 6e5),
        ("ambient_temperature", 293.15),
        ("load.inclination", radians(90.0)),
        ("limits.max_contraction", 0.2),
        ("limits.max_length", 1.0),
        ("uncertainty.supply_pressure", 0.03),
        ("operation.air_price", 0.025),
    ],
)
def test_a_default_is_the_number_of_its_text(path: str, value: float) -> None:
    assert usual(path) == pytest.approx(value, rel=1e-15)


def test_a_value_without_a_default_has_none() -> None:
    with pytest.raises(LookupError, match="stroke has no default"):
        usual("stroke")


def test_a_task_that_states_nothing_is_one_in_the_document_and_in_the_search() -> None:
    document = SizingTask.model_validate({"load": {}, "stroke": 0.1})
    task = Task(stroke=0.1)
    assert task.limits == DesignLimits(**document.limits.model_dump())
    assert task.uncertainty == Uncertainty(**document.uncertainty.model_dump())
    assert (task.supply_pressure, task.temperature) == (
        document.supply_pressure,
        document.ambient_temperature,
    )
    assert (task.inclination, task.max_proposals) == (document.load.inclination, document.max_proposals)


def test_the_stated_error_of_the_specimens_is_that_of_a_binomial_share() -> None:
    count = usual("uncertainty.specimens")
    half, high = (
        float(number) / 100.0
        for number in re.findall(r"(\d+) %(?!\.)", TASK["uncertainty.specimens"].definition)[:2]
    )
    assert half == pytest.approx(sqrt(0.5 * 0.5 / count), abs=0.005)
    assert high == pytest.approx(sqrt(0.95 * 0.05 / count), abs=0.005)
