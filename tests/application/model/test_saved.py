"""The drive document of a model: what the measurement states takes precedence over the request."""

from __future__ import annotations

from dataclasses import replace

import pytest

from mckibben.application.compare.question import ModelQuestion, question_of
from mckibben.application.measurement.experiment import QuestionMeasurement, QuestionModel
from mckibben.application.model.saved import drive_of_model
from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_files import read_document
from mckibben.documents.start_model import StatedMuscle
from mckibben.measurement.measurement import Measurement
from mckibben.measurement.points import Points
from tests.identification.synthetic import LIFT, MUSCLE, csv
from tests.shipped import shipped_studio

STUDIO = shipped_studio()


def trace(*conditions: str, command: bool = True) -> Measurement:
    names = ["time_s", *(["command"] if command else []), "pressure_bar", "displacement_mm"]
    opening = "1," if command else ""
    rows = [f"{0.01 * n:.2f},{opening}{0.1 * n:.3f},{0.5 * n:.3f}" for n in range(40)]
    return csv(rows, ",".join(names), "kind: transient", *conditions)


def question(measurement: Measurement, drive: DriveDocument | None) -> ModelQuestion:
    stated = StatedMuscle(**MUSCLE._asdict())
    model = QuestionModel(lambda _named, _length: STUDIO.start_model(stated, {"prestress": {}}), drive=drive)
    return question_of(model, [QuestionMeasurement(Points(measurement))], STUDIO)


def test_load_and_supply_of_the_measurement_are_those_of_the_drive() -> None:
    lift = read_document(LIFT, "the drive")
    asked = question(trace("load_mass: 8 kg", "load_force: 15 N", "supply_pressure: 5 bar"), lift)
    document = drive_of_model(asked, asked.fit_model(), STUDIO)
    assert document is not None
    drive = read_document(document, "the model")
    assert (drive.load.mass, drive.load.force) == (8.0, 15.0)
    assert drive.supply.pressure == 5e5
    assert drive.valve == lift.valve
    assert (drive.stops.min_contraction, drive.stops.max_contraction) == (0.0, 0.35)
    assert drive.effects == {"prestress": dict(asked.fit_model().values["prestress"])}
    assert drive.muscle.braid_angle == pytest.approx(MUSCLE.braid_angle)
    assert "tube" not in drive.model_fields_set  # it is still not stated


def test_a_supply_that_was_fitted_is_that_of_the_drive() -> None:
    asked = question(trace("load_mass: 8 kg", "supply_pressure: 5 bar"), read_document(LIFT, "the drive"))
    document = drive_of_model(asked, replace(asked.fit_model(), supply_factor=0.8), STUDIO)
    assert document is not None
    assert read_document(document, "the model").supply.pressure == pytest.approx(4e5)


def test_a_drive_that_the_file_describes_is_one() -> None:
    asked = question(
        trace("load_mass: 8 kg", "valve: MPYE-5-1/8-HF", "tube: 4 mm x 2 m", "stops: 0 % to 20 %"), None
    )
    document = drive_of_model(asked, asked.fit_model(), STUDIO)
    assert document is not None
    drive = read_document(document, "the model")
    assert drive.valve.preset == "MPYE-5-1/8-HF"
    assert drive.tube is not None
    assert (drive.tube.inside_diameter, drive.tube.length) == (0.004, 2.0)
    assert drive.stops.max_contraction == pytest.approx(0.2)
    assert drive.load.mass == 8.0


def test_a_measured_pressure_needs_no_drive() -> None:
    asked = question(trace("load_mass: 8 kg", command=False), None)
    assert drive_of_model(asked, asked.fit_model(), STUDIO) is None


@pytest.mark.parametrize(
    ("stops", "simulated", "told"), [("0 % to 20 %", 0.2, False), ("0 % to 3 %", 0.4, True)]
)
def test_a_stated_stop_that_the_record_passes_is_told_and_not_simulated(
    stops: str, simulated: float, told: bool
) -> None:
    """The record goes to 19.5 of 300 mm: a stop at 3 % did not hold it, and is not dropped without a word."""
    asked = question(trace("load_mass: 8 kg", f"stops: {stops}", command=False), None)
    drive = asked.specimens.each[0].drive
    assert drive is not None
    assert drive.max_contraction == pytest.approx(simulated)
    assert any("passes the stated end stop at 3 %" in remark for remark in asked.remarks) is told
