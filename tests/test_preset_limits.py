"""Every limit a preset states is checked where it can be exceeded: curves, runs, sizing."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest

from mckibben.application.curves.curves import CurvesQuestion, curves
from mckibben.application.curves.inverse import MuscleCondition, PressureForStroke, answer
from mckibben.application.run.simulate import SimulationQuestion, simulate
from mckibben.application.size.size import prepare, sizing_question
from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_reading import drive_of
from mckibben.documents.start_model import StatedMuscle
from mckibben.documents.studio import Studio
from mckibben.documents.task import SizingTask
from mckibben.presets import MusclePreset, ValvePreset
from mckibben.resources import presets_folder
from mckibben.simulation.outcome import Watch
from mckibben.simulation.statics.characteristics import Conditions
from tests.shipped import shipped_studio

# Figures by name of a maximum that limit no use of the part, and what they are.
ACCURACY = {
    "max_hysteresis": "width of the loop; spreads the specimens of a sizing",
    "max_relaxation": "creep after a step",
}
DRIVE: dict[str, Any] = {
    "muscle": {"preset": "DMSP-10"},
    "supply": {"pressure": "6 bar"},
    "valve": {"preset": "MPYE-5-1/8-LF"},
    "load": {"mass": "10 kg", "arrangement": "hanging"},
    "command": {"shape": "step", "level": 1.0},
    "stops": {"min_contraction": -0.05, "max_contraction": 0.3},
    "duration": "1 s",
}
TASK: dict[str, Any] = {
    "load": {"mass": "20 kg"},
    "stroke": "40 mm",
    "catalogue": {"muscles": ["DMSP-10"], "valves": ["MPYE-5-1/8-LF"], "tubes": ["PUN-H-6x1"]},
    "uncertainty": {"specimens": 0},
}


@pytest.fixture(scope="module")
def studio() -> Studio:
    return shipped_studio()


def curve_codes(studio: Studio, length: float | None = None, **question: Any) -> set[str]:
    start = studio.start_model(StatedMuscle(preset="DMSP-10", nominal_length=length), None)
    return {notice.code for notice in curves(CurvesQuestion(start, **question), studio).flags}


def run_codes(studio: Studio, **changes: Any) -> set[str]:
    document = DriveDocument.model_validate({**DRIVE, **changes})
    return {notice.code for notice in simulate(SimulationQuestion(drive_of(document, studio))).flags}


def sized(studio: Studio, **changes: Any) -> Any:
    document = SizingTask.model_validate({**TASK, **changes})
    return prepare(sizing_question(document, studio))(Watch())


def rejections(studio: Studio, **changes: Any) -> set[str]:
    return {item.binding for item in sized(studio, **changes).rejected}


Check = Callable[[Studio], bool]
# Limit -> place -> whether it is noticed there.
MUSCLE_LIMITS: dict[str, dict[str, Check]] = {
    "max_pressure": {
        "curves": lambda s: "over_pressure" in curve_codes(s, pressures=(9e5,)),
        "run": lambda s: "over_pressure" in run_codes(s, supply={"pressure": "9.5 bar"}),
        "sizing": lambda s: all(p.pressure <= 8e5 for p in sized(s, supply_pressure="10 bar").proposals),
    },
    "max_force": {
        "curves": lambda s: "over_force_limit" in curve_codes(s, load=700.0),
        "run": lambda s: (
            "over_force_limit"
            in run_codes(s, load={"mass": "5 kg", "force": "620 N"}, supply={"pressure": "8 bar"})
        ),
        "sizing": lambda s: (
            "force_limit" in rejections(s, load={"force": "700 N"}, supply_pressure="8 bar", stroke="1 mm")
        ),
    },
    "max_contraction": {
        "curves": lambda s: (
            "over_contraction_limit" in curve_codes(s, length=1.0, pressures=(8e5,), load=1.0)
        ),
        "run": lambda s: (
            "over_contraction_limit"
            in run_codes(s, load={"mass": "0.5 kg"}, supply={"pressure": "8 bar"}, duration="3 s")
        ),
        "sizing": lambda s: all(
            p.contraction <= 0.25 + 1e-9
            for p in sized(s, load={"mass": "2 kg"}, limits={"max_contraction": "40 %"}).proposals
        ),
    },
    "max_pretension": {
        "curves": lambda s: "over_pretension_limit" in curve_codes(s, pressures=(0.1e5,), load=400.0),
        "run": lambda s: (
            "over_pretension_limit"
            in run_codes(s, load={"mass": "29 kg"}, stops={"min_contraction": -0.08}, duration="0.5 s")
        ),
        # A drive of a sizing starts at the nominal length, so it is never stretched.
        "sizing": lambda s: sized(s).proposals[0].drive.stops.min_contraction == 0.0,
    },
    "min_nominal_length": {
        "curves": lambda s: "length_outside_range" in curve_codes(s, length=0.03),
        "run": lambda s: (
            "length_outside_range"
            in run_codes(s, muscle={"preset": "DMSP-10", "nominal_length": "35 mm"}, load={"mass": "1 kg"})
        ),
        "sizing": lambda s: "length" in rejections(s, stroke="5 mm", limits={"max_length": "38 mm"}),
    },
    "max_nominal_length": {
        "curves": lambda s: "length_outside_range" in curve_codes(s, length=9.1),
        "run": lambda s: (
            "length_outside_range" in run_codes(s, muscle={"preset": "DMSP-10", "nominal_length": "9.1 m"})
        ),
        "sizing": lambda s: "contraction" in rejections(s, stroke="2.5 m", limits={"max_length": "20 m"}),
    },
    "max_suspended_mass": {
        "curves": lambda s: "over_suspended_mass" in curve_codes(s, load=45 * 9.80665),
        "run": lambda s: "over_suspended_mass" in run_codes(s, load={"mass": "45 kg"}),
        "sizing": lambda s: "suspended_mass" in rejections(s, load={"mass": "45 kg"}),
    },
    "min_temperature": {
        "curves": lambda s: "outside_temperature" in curve_codes(s, conditions=Conditions(temperature=263.0)),
        "run": lambda s: "outside_temperature" in run_codes(s, gas={"temperature": "-10 degC"}),
        "sizing": lambda s: "temperature" in rejections(s, ambient_temperature="-10 degC"),
    },
    "max_temperature": {
        "curves": lambda s: "outside_temperature" in curve_codes(s, conditions=Conditions(temperature=343.0)),
        "run": lambda s: "outside_temperature" in run_codes(s, gas={"temperature": "70 degC"}),
        "sizing": lambda s: "temperature" in rejections(s, ambient_temperature="70 degC"),
    },
}
# A valve is in no curve. Limit -> a value [bar] that the supply of 6 bar exceeds or misses.
VALVE_LIMITS = {"max_pressure": 1.0, "min_pressure": 6.5}
# In runs alone: a sizing does not modulate.
SWITCHING_LIMITS = {"max_frequency"}


def stated(studio: Studio, kind: str) -> set[str]:
    """Names of the limits in the presets of a kind."""
    names: set[str] = set()
    for preset in studio.library.list(kind):
        assert isinstance(preset, MusclePreset | ValvePreset)
        document = preset.to_document()
        names |= set(document.get("limits", {}))
        names |= {name for name in document.get("data", {}) if name.startswith(("max_", "min_"))}
    return names - set(ACCURACY)


def test_every_limit_of_a_preset_is_checked_somewhere(studio: Studio) -> None:
    assert stated(studio, "muscles") == set(MUSCLE_LIMITS)
    assert all(set(places) == {"curves", "run", "sizing"} for places in MUSCLE_LIMITS.values())
    assert stated(studio, "valves") == set(VALVE_LIMITS) | SWITCHING_LIMITS


@pytest.mark.parametrize("place", ["curves", "run", "sizing"])
@pytest.mark.parametrize("name", MUSCLE_LIMITS)
def test_a_limit_of_the_muscle_is_checked(studio: Studio, name: str, place: str) -> None:
    assert MUSCLE_LIMITS[name][place](studio)


def test_a_stretched_muscle_is_flagged_where_its_model_was_not_fitted(studio: Studio) -> None:
    assert "stretched" in curve_codes(studio, pressures=(0.1e5,), load=100.0)
    assert "stretched" not in curve_codes(studio, pressures=(4e5,), load=100.0)
    assert "stretched" in run_codes(studio, stops={"min_contraction": -0.02}, duration="0.5 s")
    own = {"muscle": {"preset": "DMSP-10"}, "effects": {}, "stops": {"min_contraction": -0.02}}
    assert "stretched" not in run_codes(studio, **own, duration="0.5 s")  # words of the preset's model


def test_a_usual_use_crosses_no_limit(studio: Studio) -> None:
    notes = {"unverified", "assumed"}
    assert curve_codes(studio, load=200.0, pressures=(3e5,)) <= notes
    assert run_codes(studio, load={"mass": "15 kg"}, stops={"max_contraction": 0.25}) <= notes
    assert sized(studio).proposals


@pytest.mark.parametrize("name", [*VALVE_LIMITS, None])
def test_a_valve_for_other_pressures_is_rejected_and_flagged(tmp_path: Any, name: str | None) -> None:
    limits = {} if name is None else {name: VALVE_LIMITS[name]}
    code = name is not None
    document = json.loads((presets_folder() / "valves" / "MPYE-5-1-8-LF.json").read_text(encoding="utf-8"))
    document["id"] = "narrow"
    for name, value in {"min_pressure": 0.0, "max_pressure": 10.0, **limits}.items():
        document["data"][name] |= {"value": value, "unit": "bar"}
    (tmp_path / "valves").mkdir()
    (tmp_path / "valves" / "narrow.json").write_text(json.dumps(document), encoding="utf-8")
    studio = Studio(presets=presets_folder(), user_presets=tmp_path)
    assert ("outside_valve_pressure" in run_codes(studio, valve={"preset": "narrow"})) is code
    found = sized(studio, catalogue={**TASK["catalogue"], "valves": ["narrow"]})
    assert bool(found.proposals) is not code
    wrong = [item for item in found.rejected if item.binding == "valve_pressure"]
    assert bool(wrong) is code
    assert all("narrow and PUN-H-6x1: the valve is made for" in item.why for item in wrong)


@pytest.mark.parametrize(("carrier", "flagged"), [("330 Hz", False), ("400 Hz", True)])
def test_a_carrier_above_what_the_valve_can_switch_is_flagged(
    studio: Studio, carrier: str, flagged: bool
) -> None:
    codes = run_codes(studio, valve={"preset": "MHE2"}, pwm={"frequency": carrier, "valves": "one"})
    assert ("over_valve_frequency" in codes) is flagged


def test_parallel_muscles_share_the_hanging_mass_and_the_reason_says_it(studio: Studio) -> None:
    found = sized(studio, load={"mass": "45 kg"})
    assert {proposal.parallel for proposal in found.proposals} <= {2}
    alone = next(item for item in found.rejected if item.parallel == 1)
    assert alone.why == "one DMSP-10 would carry 45 kg; the maker permits 30 kg freely suspended"
    assert "2 in parallel" in alone.would_work_if


def test_a_load_that_lies_hangs_on_nothing(studio: Studio) -> None:
    lying = {"mass": "45 kg", "arrangement": "horizontal", "force": "100 N"}
    assert "over_suspended_mass" not in run_codes(studio, load=lying)
    assert "suspended_mass" not in rejections(
        studio, load={"mass": "45 kg", "inclination": "0 deg", "force": "100 N"}
    )


def test_inverse_questions_name_the_hanging_mass(studio: Studio) -> None:
    start = studio.start_model(StatedMuscle(preset="DMSP-10"), None)
    found = answer(
        PressureForStroke(condition=MuscleCondition(start), load=45 * 9.80665, stroke=0.005), studio
    )
    assert "over_suspended_mass" in {notice.code for notice in found.flags}
