"""The drive document: what it may say, what it means in SI, and what is refused with which field."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from math import radians
from pathlib import Path
from typing import Any

import pytest

from mckibben.documents.drive_reading import AnnotatedDrive, drive_of, preset_document, read_document
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError
from mckibben.presets import PresetLibrary
from mckibben.resources import presets_folder
from mckibben.simulation.command.signals import Signal
from tests.shipped import shipped_studio

EXAMPLE: dict[str, Any] = {
    "schema": 1,
    "muscle": {"preset": "DMSP-20", "nominal_length": "800 mm"},
    "effects": {"bladder_elasticity": {}, "viscous_damping": {"coefficient": "120 N*s/m"}},
    "supply": {"pressure": "6 bar"},
    "valve": {"preset": "MPYE-5-1/8-HF"},
    "tube": {"inside_diameter": "4 mm", "length": "1 m"},
    "load": {"mass": "10 kg", "force": "0 N", "inclination": "90 deg", "arrangement": "hanging"},
    "command": {"shape": "pulse", "on": "0 s", "off": "2 s"},
    "duration": "4 s",
}
CONTROLLER = {
    "type": "pid",
    "kp": 2.0,
    "ki": 10.0,
    "kd": 0.01,
    "reference": {"shape": "triangle", "amplitude": "20 mm", "period": "1 s"},
}


@pytest.fixture(scope="module")
def studio() -> Studio:
    return shipped_studio()


@pytest.fixture
def read(studio: Studio) -> Callable[..., AnnotatedDrive]:
    """The drive of the example with parts replaced; None takes a part away."""

    def given(**changes: Any) -> AnnotatedDrive:
        document = copy.deepcopy(EXAMPLE)
        for name, value in changes.items():
            document.pop(name, None)
            if value is not None:
                document[name] = value
        return drive_of(read_document(document, "the drive"), studio)

    return given


def test_the_example_means_this_in_si(read: Callable[..., AnnotatedDrive]) -> None:
    drive = read().drive
    assert drive.muscle.nominal_length == 0.8
    assert drive.model.values["viscous_damping"]["coefficient"] == 120.0
    assert "shear_modulus" in drive.model.values["bladder_elasticity"]
    assert drive.supply_pressure == 6e5
    assert drive.valve.fill_conductance == pytest.approx(3e-8)
    assert drive.valve.exhaust_conductance == pytest.approx(3e-8)
    assert drive.tube is not None
    assert (drive.tube.inside_diameter, drive.tube.length) == (0.004, 1.0)
    assert (drive.load.mass, drive.load.inclination) == (10.0, radians(90.0))
    assert drive.duration == 4.0
    assert (drive.min_contraction, drive.max_contraction) == (0.0, 0.25)


def test_a_tube_may_be_stated_left_out_or_excluded(read: Callable[..., AnnotatedDrive]) -> None:
    assert read().drive.assumed_tube is None
    left_out = read(tube=None).drive
    assert left_out.tube is None
    assert left_out.assumed_tube is not None
    document = {name: value for name, value in EXAMPLE.items() if name != "tube"} | {"tube": None}
    excluded = drive_of(read_document(document, "the drive"), shipped_studio()).drive
    assert (excluded.tube, excluded.assumed_tube) == (None, None)


def test_outside_a_pulse_a_valve_exhausts_and_a_regulator_gives_no_pressure(
    read: Callable[..., AnnotatedDrive],
) -> None:
    assert list(read().drive.command.segments(4.0).start_values) == [1.0, -1.0]
    regulated = read(regulator={"range": "6 bar", "time": "50 ms"}).drive
    assert list(regulated.command.segments(4.0).start_values) == [1.0, 0.0]
    assert regulated.regulator is not None
    assert (regulated.regulator.range, regulated.regulator.time) == (6e5, 0.05)


def test_a_regulator_preset_brings_its_range(read: Callable[..., AnnotatedDrive]) -> None:
    drive = read(valve={"preset": "VPPM-6"}).drive
    assert drive.regulator is not None
    assert drive.regulator.range == 6e5
    faster = read(valve={"preset": "VPPM-6"}, regulator={"time": "20 ms"}).drive
    assert faster.regulator is not None
    assert (faster.regulator.range, faster.regulator.time) == (6e5, 0.02)


def test_a_controller_gives_the_command_instead(read: Callable[..., AnnotatedDrive]) -> None:
    given = read(controller=CONTROLLER)
    assert given.drive.controller is not None
    assert given.drive.controller.kp == pytest.approx(20.0)  # percent per mm in 1/m
    assert given.drive.controller.output_min == -1.0
    assert given.drive.reference is not None
    assert given.drive.reference.extent == (0.0, 0.02)
    assert "controller" in given.notes["command"]
    alone = read(controller=CONTROLLER, command=None, valve={"preset": "VPPM-6"})
    assert alone.drive.controller is not None
    assert alone.drive.controller.output_min == 0.0
    assert alone.notes == {}


def test_valve_by_value(read: Callable[..., AnnotatedDrive]) -> None:
    valve = read(valve={"sonic_conductance": "1.2 l/(s*bar)", "critical_pressure_ratio": 0.2}).drive.valve
    assert valve.fill_conductance == valve.exhaust_conductance == pytest.approx(1.2e-8)
    assert valve.fill_ratio == valve.exhaust_ratio == 0.2
    both = read(valve={"sonic_conductance": 1e-8, "exhaust_conductance": "2 l/(s*bar)"}).drive.valve
    assert both.exhaust_conductance == pytest.approx(2e-8)
    # 700 l/min from 6 to 5 bar gauge with b = 0.3 is the 3 l/(s bar) of the preset.
    flow = read(valve={"nominal_flow": "700 l/min"}).drive.valve
    assert flow.fill_conductance == pytest.approx(3.0e-8, rel=0.01)
    own = read(valve={"preset": "MPYE-5-1/8-HF", "sonic_conductance": "2 l/(s*bar)"}).drive.valve
    assert own.fill_conductance == own.exhaust_conductance == pytest.approx(2e-8)


def test_effects_of_the_presets_hold_only_when_the_document_names_none(
    read: Callable[..., AnnotatedDrive],
) -> None:
    with_presets = read(effects=None)
    assert set(with_presets.start.effects) >= {"bladder_elasticity", "prestress", "spool_lag"}
    assert with_presets.start.effects["spool_lag"] == {"time": pytest.approx(1.386e-3), "damping": 0.8}
    assert set(read().start.effects) == {"bladder_elasticity", "viscous_damping"}
    assert read(effects={}).start.effects == {}


def test_fittings_and_dead_volume_add_up(read: Callable[..., AnnotatedDrive]) -> None:
    drive = read(fittings=["QS-4", "QS-6"], gas={"dead_volume": "10 cm^3"}).drive
    assert drive.fitting_volume == pytest.approx(13e-6)


def test_loads(read: Callable[..., AnnotatedDrive]) -> None:
    assert read(load={"mass": 1.0, "arrangement": "horizontal"}).drive.load.inclination == 0.0
    inclined = read(load={"mass": 1.0, "arrangement": "inclined", "inclination": "30 deg"}).drive.load
    assert inclined.inclination == pytest.approx(radians(30.0))
    lever = read(load={"mass": 1.0, "arrangement": "lever", "lever_ratio": 0.5}).drive.load
    assert lever.lever_ratio == 0.5
    ramp = {"shape": "ramp", "from": "0 N", "to": "1000 N", "duration": "7 s"}
    force = read(load={"force": ramp}).drive.load.force
    assert isinstance(force, Signal)
    assert float(force.value(3.5)) == pytest.approx(500.0)
    assert read(load={"spring": "500 N/m"}).drive.load.spring == 500.0


REFUSED = {
    "unknown key": ({"vlave": {}}, "vlave", "valve"),
    "unknown key inside": ({"tube": {"preset": "PUN-H-6x1", "lenght": 1}}, "tube.lenght", "length"),
    "unknown muscle": ({"muscle": {"preset": "DMPS-20"}}, "muscle.preset", "DMSP-20"),
    "unknown valve": ({"valve": {"preset": "MPYE-5-1/8-HV"}}, "valve.preset", "MPYE-5-1/8-HF"),
    "unknown tube": ({"tube": {"preset": "PUN-6x1"}}, "tube.preset", "PUN-H-6x1"),
    "unknown fitting": ({"fittings": ["QS-5"]}, "fittings.0", "QS-"),
    "unknown effect": ({"effects": {"creeep": {}}}, "effects.creeep", "creep"),
    "unknown parameter": ({"effects": {"creep": {"tim": 1}}}, "effects.creep.tim", None),
    "unknown shape": ({"command": {"shape": "pulze"}}, "command.shape", "pulse"),
    "unknown key of a shape": ({"command": {"shape": "pulse", "onn": 0, "off": 1}}, "command.onn", "on"),
    "command out of range": ({"command": {"shape": "step", "level": 2}}, "command", None),
    "below 0 for a regulator": (
        {"valve": {"preset": "VPPM-6"}, "command": {"shape": "step", "initial": -1}}, "command", None
    ),
    "negative mass": ({"load": {"mass": "-3 kg"}}, "load.mass", "kg"),
    "wrong unit": ({"load": {"mass": "3 m"}}, "load.mass", "kg"),
    "no duration": ({"duration": 0}, "duration", "s"),
    "too long": ({"duration": "601 s"}, "duration", "s"),
    "supply below ambient": ({"supply": {"pressure": "-0.1 bar"}}, "supply.pressure", "bar"),
    "no supply": ({"supply": None}, "supply", None),
    "no muscle": ({"muscle": None}, "muscle", None),
    "no valve": ({"valve": None}, "valve", None),
    "no flow": ({"valve": {"preset": "MPPES-3-1/4-6-010"}}, "valve.sonic_conductance", "sonic"),
    "closed valve": ({"valve": {"sonic_conductance": 0}}, "valve.sonic_conductance", "l/(s*bar)"),
    "closed exhaust": (
        {"valve": {"sonic_conductance": 1e-8, "exhaust_conductance": 0}}, "valve.exhaust_conductance", None
    ),
    "two flows": (
        {"valve": {"sonic_conductance": 1e-8, "nominal_flow": "100 l/min"}}, "valve.nominal_flow", None
    ),
    "no tube length": ({"tube": {"inside_diameter": "4 mm"}}, "tube.length", "m"),
    "tube shorter than wide": ({"tube": {"inside_diameter": "4 mm", "length": "1 mm"}}, "tube.length", None),
    "no command": ({"command": None}, "command", "shape"),
    "beyond the braid lock": ({"stops": {"min_contraction": -0.5}}, "stops.min_contraction", "at least"),
    "stops in the wrong order": (
        {"stops": {"min_contraction": 0.1, "max_contraction": 0.05}}, "stops.max_contraction", None
    ),
    "nothing is left": ({"stops": {"max_contraction": 0.95}}, "stops.max_contraction", None),
    "hanging and flat": ({"load": {"arrangement": "hanging", "inclination": 0}}, "load.inclination", None),
    "inclined, how much": ({"load": {"arrangement": "inclined"}}, "load.inclination", "deg"),
    "lever without ratio": ({"load": {"arrangement": "lever"}}, "load.lever_ratio", None),
    "regulator without range": ({"regulator": {"time": "50 ms"}}, "regulator.range", "bar"),
    "gain in another unit": ({"controller": {**CONTROLLER, "kp": "2 bar"}}, "controller.kp", None),
    "gain below zero": ({"controller": {**CONTROLLER, "ki": -1}}, "controller.ki", None),
    "reference in degrees": (
        {"controller": {**CONTROLLER, "reference": {"shape": "step", "level": "20 deg"}}},
        "controller.reference.level", "mm",
    ),
    "another schema": ({"schema": 2}, "schema", None),
}  # fmt: skip


@pytest.mark.parametrize(
    ("arrangement", "words"),
    [("antagonist", "an antagonist load"), ("inclined", "an inclined load"), ("hanging", "a hanging load")],
)
def test_arrangements_have_the_right_article(
    read: Callable[..., AnnotatedDrive], arrangement: str, words: str
) -> None:
    load = {"arrangement": arrangement, "lever_ratio": 0.5}
    own = {"antagonist": {"pulley_radius": "20 mm"}, "inclined": {"inclination": "30 deg"}}
    with pytest.raises(InputError, match=f"^{words} has no lever$"):
        read(load={**load, **own.get(arrangement, {})})


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_refused_and_where(read: Callable[..., AnnotatedDrive], name: str) -> None:
    changes, field, hint = REFUSED[name]
    with pytest.raises(InputError) as caught:
        read(**changes)
    assert caught.value.field == field
    if hint is not None:
        assert hint in f"{caught.value.message} {caught.value.hint}"


def test_every_drive_preset_can_be_read(studio: Studio) -> None:
    presets = studio.library.list("drives")
    assert {preset.id for preset in presets} >= {"paper-ramp", "paper-step", "propneu-20"}
    for preset in presets:
        given = drive_of(preset_document(preset.id, studio), studio)
        assert given.drive.duration > 0.0


def test_a_broken_drive_preset_is_a_problem_of_its_own(tmp_path: Path) -> None:
    (tmp_path / "drives").mkdir()
    content = json.loads((presets_folder() / "drives" / "paper-step.json").read_text("utf-8"))
    content["paper"]["figures"]["extend.rise_time"]["unit"] = "m²²"
    (tmp_path / "drives" / "paper-step.json").write_text(json.dumps(content), "utf-8")
    library = PresetLibrary(tmp_path)
    assert library.list("drives") == []
    assert library.problems("drives")[0].field == "paper.figures.extend.rise_time.unit"
