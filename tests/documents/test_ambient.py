"""Absolute pressures in drive documents, tasks and requests."""

from __future__ import annotations

from typing import Any

import pytest
from pydantic import ValidationError

from mckibben.documents.drive import DriveDocument
from mckibben.documents.task import SizingTask

DRIVE: dict[str, Any] = {
    "muscle": {"preset": "DMSP-10"},
    "supply": {"pressure": "7 bar(a)"},
    "valve": {"preset": "MPYE-5-M5"},
    "regulator": {"range": "5 bara"},
    "start_pressure": "30 psia",
}


def test_they_become_gauge_pressures_at_the_standard_atmosphere() -> None:
    found = DriveDocument.model_validate(DRIVE)
    assert found.supply.pressure == pytest.approx(7e5 - 101_325.0)
    assert found.regulator is not None
    assert found.regulator.range == pytest.approx(5e5 - 101_325.0)
    assert found.start_pressure == pytest.approx(30 * 6894.757293168 - 101_325.0)
    task = SizingTask.model_validate({"load": {"mass": 5.0}, "stroke": 0.02, "supply_pressure": "7 bar(a)"})
    assert task.supply_pressure == pytest.approx(7e5 - 101_325.0)


@pytest.mark.parametrize("ambient", ["0.8 bar", "0.8 bar(a)", 8e4, "-0.21325 bar(g)"])
def test_the_ambient_pressure_of_the_document_is_used(ambient: object) -> None:
    found = DriveDocument.model_validate({**DRIVE, "gas": {"ambient_pressure": ambient}})
    assert found.gas.ambient_pressure == pytest.approx(8e4)
    assert found.supply.pressure == pytest.approx(6.2e5)
    assert found.regulator is not None
    assert found.regulator.range == pytest.approx(4.2e5)
    assert found.start_pressure == pytest.approx(30 * 6894.757293168 - 8e4)


def test_gauge_texts_do_not_depend_on_the_ambient_pressure() -> None:
    given = {**DRIVE, "supply": {"pressure": "6 bar(g)"}, "gas": {"ambient_pressure": "0.8 bar"}}
    assert DriveDocument.model_validate(given).supply.pressure == pytest.approx(6e5)


def test_an_absolute_pressure_below_the_ambient_one_is_refused_at_its_field() -> None:
    with pytest.raises(ValidationError) as caught:
        DriveDocument.model_validate({**DRIVE, "supply": {"pressure": "0.5 bar(a)"}})
    assert caught.value.errors()[0]["loc"] == ("supply", "pressure")


@pytest.mark.parametrize(
    "broken", [{"gas": "none"}, {"gas": {"ambient_pressure": "5 mm"}}, {"supply": "3 mm"}]
)
def test_a_broken_document_is_refused_where_it_is_broken(broken: dict[str, Any]) -> None:
    with pytest.raises(ValidationError) as caught:
        DriveDocument.model_validate({**DRIVE, **broken})
    assert caught.value.errors()[0]["loc"][0] == next(iter(broken))
