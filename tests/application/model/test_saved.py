"""The drive document of a model: what the measurement states takes precedence over the request."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from mckibben.application.compare.question import ModelQuestion, question_of
from mckibben.application.measurement.experiment import QuestionMeasurement, QuestionModel
from mckibben.application.model.saved import drive_of_model, keep
from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_reading import read_document
from mckibben.documents.saved_model import read_saved_model
from mckibben.documents.start_model import StatedMuscle
from mckibben.documents.studio import Studio
from mckibben.measurement.measurement import Measurement
from mckibben.measurement.points import Points
from mckibben.physics.errors import InputError
from mckibben.presets import MusclePreset
from mckibben.resources import presets_folder
from tests.identification.synthetic import LIFT, MUSCLE, csv
from tests.shipped import shipped_studio

STUDIO = shipped_studio()

MODEL: dict[str, Any] = {
    "schema": 1,
    "kind": "model",
    "muscle": {"preset": "DMSP-20", "nominal_length": "250 mm", "braid_angle": "25.1 deg"},
    "effects": {"bladder_elasticity": {"shear_modulus": "0.5 MPa"}, "coulomb_friction": {}},
    "free": ["braid_angle"],
    "envelope": {"pressure": {"least": 1e5, "most": 5e5, "unit": "Pa"}},
    "errors": {"force": 8.0},
    "covariance": {
        "names": ["bladder_elasticity.shear_modulus", "braid_angle"],
        "matrix": [[1e8, 0.0], [0.0, 1e-6]],
    },
    "origin": {
        "program": "mckibben",
        "made": "2026-01-02T03:04:05+00:00",
        "kind": "isobaric",
        "predicted": "force",
        "verdict": "x",
        "error": {"rmse": 8.0, "holdout_rmse": 9.0, "noise": 7.0, "unit": "N"},
        "files": [{"name": "bench.csv", "sha256": None, "rows": 200}],
    },
}


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


@pytest.fixture
def studio(tmp_path: Path) -> Studio:
    return Studio(presets=presets_folder(), user_presets=tmp_path)


def kept(studio: Studio, **changes: Any) -> MusclePreset:
    return keep(read_saved_model(MODEL | changes, "the model"), studio, id="mine", title="Mine")


def test_fitted_values_name_the_data_and_the_others_keep_their_sources(studio: Studio) -> None:
    preset, base = kept(studio), studio.library.muscle("DMSP-20")
    assert preset.geometry.braid_angle.source == "fitted to bench.csv"
    assert preset.geometry.braid_angle.grade == "user"
    assert preset.geometry.inside_diameter == base.geometry.inside_diameter
    assert preset.geometry.nominal_length.source == "of the model, not fitted"
    assert preset.effects["bladder_elasticity"]["shear_modulus"].source == "fitted to bench.csv"
    assert preset.limits == base.limits
    assert preset.data == base.data
    assert (preset.id, preset.title, preset.origin) == ("mine", "Mine", "user")


def test_the_fit_comes_back_with_the_muscle_until_it_is_changed(studio: Studio) -> None:
    kept(studio)
    start = studio.start_model(StatedMuscle(preset="mine"), None)
    fit = start.fit
    assert fit is not None
    assert fit.covariance is not None
    assert fit.covariance.names == MODEL["covariance"]["names"]
    assert fit.errors == {"force": 8.0}
    assert fit.envelope["pressure"].most == 5e5
    assert start.muscle.nominal_length == 0.25
    # Another length is the same model; another dimension or effect is none that was fitted.
    assert studio.start_model(StatedMuscle(preset="mine", nominal_length=0.4), None).fit == fit
    assert studio.start_model(StatedMuscle(preset="mine", wall_thickness=2e-3), None).fit is None
    assert studio.start_model(StatedMuscle(preset="mine"), {}).fit is None
    effects = {name: dict(values) for name, values in start.effects.items()}
    assert studio.start_model(StatedMuscle(preset="mine"), effects).fit == fit
    effects["bladder_elasticity"]["shear_modulus"] *= 1.1
    assert studio.start_model(StatedMuscle(preset="mine"), effects).fit is None


def test_a_model_that_nobody_fitted_is_kept_without_a_fit(studio: Studio) -> None:
    document = {name: value for name, value in MODEL.items() if name not in ("origin", "covariance")}
    preset = keep(read_saved_model(document, "the model"), studio, id="plain")
    assert preset.fit is None
    assert preset.title == "plain"


def test_a_typed_term_is_refused(studio: Studio) -> None:
    typed = {"custom": {"term": "-c*sign(v)", "c": 3.0}}
    with pytest.raises(InputError, match="typed term") as refused:
        kept(studio, effects=typed)
    assert refused.value.hint is not None
    assert "JSON" in refused.value.hint


def test_a_model_without_any_length_is_refused(studio: Studio) -> None:
    muscle = {"inside_diameter": "20 mm", "braid_angle": "25 deg"}
    with pytest.raises(InputError, match="several lengths") as refused:
        kept(studio, muscle=muscle, free=[])
    assert refused.value.field == "muscle.nominal_length"


def test_an_id_of_the_program_is_refused(studio: Studio) -> None:
    with pytest.raises(InputError, match="taken by a built-in"):
        keep(read_saved_model(MODEL, "the model"), studio, id="DMSP-20")


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ({"names": ["a.b"], "matrix": [[1.0, 2.0]]}, "1 rows of 1"),
        ({"names": ["a.b", "a.c"], "matrix": [[1.0, 0.5], [0.4, 1.0]]}, "symmetric"),
        ({"names": ["a.b", "a.c"], "matrix": [[1.0, 2.0], [2.0, 1.0]]}, "no covariance"),
        ({"names": ["a.b"], "matrix": [[-1.0]]}, "no covariance"),
        ({"names": ["a.b", "a.b"], "matrix": [[1.0, 0.0], [0.0, 1.0]]}, "twice"),
        (
            {"names": ["a", "b", "c"], "matrix": [[1.0, 0.9, -0.9], [0.9, 1.0, 0.9], [-0.9, 0.9, 1.0]]},
            "negative variance",
        ),
    ],
)
def test_what_is_no_covariance_is_refused(studio: Studio, table: dict[str, Any], words: str) -> None:
    with pytest.raises(InputError, match=words) as refused:
        read_saved_model(MODEL | {"covariance": table}, "the model")
    assert (refused.value.field or "").startswith("covariance")
    kept(studio)
    path = next(Path(studio.library.user_folder or "").rglob("mine.json"))
    document = json.loads(path.read_text("utf-8"))
    document["fit"]["covariance"] = table
    with pytest.raises(InputError, match=words):
        studio.library.save_muscle(document)
