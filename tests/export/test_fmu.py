"""The FMU: valid by FMPy; simulated by FMPy, also by its own integrator, it gives the run of the engine."""

from __future__ import annotations

import ctypes
import re
import shutil
import struct
import subprocess
import zipfile
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

from mckibben.documents.drive_reading import preset_document, read_document
from mckibben.documents.start_model import StatedMuscle
from mckibben.export.c_static import RESULT_MEMBERS
from mckibben.export.fmu import build, package
from mckibben.export.fmu.description import dimension
from mckibben.export.fmu.variables import KIND, OUTPUT, RATE, STATE, Plant
from mckibben.export.source import of_drive, stated_source
from mckibben.export.subject import Stated, Subject, subject_of
from mckibben.export.use_case import ExportQuestion, write_export
from mckibben.physics.units import is_unit
from mckibben.simulation.drive.transient import simulate
from tests.export import test_c
from tests.export.fmus import (
    KINDS,
    fmu_of,
    opening_signal,
    our_run,
    position_error,
    shared_fmu,
    simulated,
    timing_error,
)
from tests.export.models import assert_equal, ours, random_inputs, studio, subject
from tests.export.test_formats import HOSTILE, hostile

gcc = pytest.mark.skipif(shutil.which("gcc") is None, reason="gcc is not installed")
DRIVES = ("propneu-20", "paper-hysteresis", "pair")
MODULATED = {
    "muscle": {"preset": "DMSP-20", "nominal_length": "300 mm"}, "effects": {},
    "supply": {"pressure": "6 bar"}, "valve": {"sonic_conductance": 5e-8}, "load": {"mass": "20 kg"},
    "tube": {"inside_diameter": "4 mm", "length": "0.5 m"}, "quick_exhaust": {"sonic_conductance": 5e-8},
    "pwm": {"frequency": "50 Hz"}, "command": {"shape": "sine", "amplitude": 0.6, "period": "0.6 s"},
    "duration": "0.6 s",
}  # fmt: skip
MUSCLE = "together_1"  # with memory and parts in series


def subject_named(name: str) -> Subject:
    if name == MUSCLE:
        return subject(name)
    if name in test_c.DRIVES:
        short = {**test_c.DRIVES[name], "duration": "1.5 s"}
        short.pop("pwm", None)  # of many pulses the highest is a matter of the last digits: see MODULATED
        return subject_of(of_drive(read_document(short, "the drive"), studio(), name, title=name), studio())
    return subject_of(stated_source(name, studio()), studio())


@pytest.fixture(scope="module")
def fmus(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[Subject, Path]]:
    pytest.importorskip("fmpy", reason="FMPy is not installed")
    base = tmp_path_factory.getbasetemp()
    models = {name: subject_named(name) for name in (*DRIVES, MUSCLE)}
    return {name: (model, shared_fmu(model, base, name)) for name, model in models.items()}


@gcc
@pytest.mark.parametrize("name", [*DRIVES, MUSCLE])
def test_the_fmu_is_valid(name, fmus):
    from fmpy.validation import validate_fmu

    assert validate_fmu(str(fmus[name][1])) == []


@gcc
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", DRIVES)
def test_fmpy_gives_the_motion_of_the_engine(name, kind, fmus):
    """Model exchange by CVode of LLNL: an integrator that shares nothing with ours."""
    model, path = fmus[name]
    rows = simulated(path, model, kind)
    run = our_run(model, rows["time"])
    assert np.ptp(run.states["stroke"]) > 1e-3
    assert position_error(rows, run) < 1e-4
    worst, unsettled = timing_error(rows, run, model)
    assert len(worst) > 10
    assert len(unsettled) <= 2
    assert {figure: error for figure, error in worst.items() if error > 5e-3} == {}


@gcc
def test_the_pulses_of_a_carrier_are_events_of_the_fmu(tmp_path):
    pytest.importorskip("fmpy", reason="FMPy is not installed")
    document = read_document(MODULATED, "the drive")
    model = subject_of(of_drive(document, studio(), "pulses", title="pulses"), studio())
    assert len(Plant(model, "pulses").pieces) > 40
    assert any("pulse-width modulation (50 Hz)" in each for each in model.about.left_out)
    path = fmu_of(model, tmp_path, "pulses")
    for kind in KINDS:
        rows = simulated(path, model, kind)
        run = our_run(model, rows["time"])
        assert np.ptp(run.states["stroke"]) > 5e-3
        assert position_error(rows, run) < 1e-5, kind
        timing, unsettled = timing_error(rows, run, model)
        assert {figure: error for figure, error in timing.items() if error > 5e-3} == {}
        assert len(unsettled) <= 2  # shares of choked flow, which the ripple of the pressure decides


@pytest.fixture
def instance(fmus: dict[str, tuple[Subject, Path]], tmp_path: Path) -> Iterator[Any]:
    """Starts an FMU for single calls: (drive or muscle, kind) -> FMPy's object in initialisation mode."""
    from fmpy import extract
    from fmpy.fmi2 import FMU2Model, FMU2Slave
    from fmpy.model_description import read_model_description

    opened = []

    def start(name: str, kind: str = "ModelExchange") -> Any:
        folder = extract(str(fmus[name][1]), str(tmp_path / f"{name}-{len(opened)}"))
        said = read_model_description(folder)
        own = (FMU2Model if kind == "ModelExchange" else FMU2Slave)(
            guid=said.guid, unzipDirectory=folder, modelIdentifier=said.modelExchange.modelIdentifier
        )
        own.instantiate()
        own.setupExperiment(tolerance=1e-7, startTime=0.0)
        own.enterInitializationMode()
        own.said = {each.name: each.valueReference for each in said.modelVariables}
        opened.append(own)
        return own

    yield start
    for own in opened:
        own.terminate()
        own.freeInstance()


@gcc
def test_a_muscle_has_the_force_and_rates_of_the_static_model(fmus, instance):
    model = fmus[MUSCLE][0]
    own = instance(MUSCLE)
    inputs = random_inputs(model, 100, 3)
    names = list(model.equations.states)
    # A simulation has a smooth direction, so fast motion is compared with the sign of it.
    inputs["velocity"] = np.copysign(np.maximum(np.abs(inputs["velocity"]), 0.2), inputs["velocity"])
    inputs["direction"] = np.sign(inputs["velocity"])
    expected = ours(model, inputs)
    given = [own.said[name] for name in ("length", "velocity", "pressure", "temperature")]
    rows = np.empty((100, len(RESULT_MEMBERS)))
    for row in range(100):
        own.setReal(given, [inputs[n][row] for n in ("length", "velocity", "pressure", "temperature")])
        own.setReal([STATE + place for place in range(len(names))], [inputs[name][row] for name in names])
        rows[row] = own.getReal([OUTPUT + place for place in range(len(RESULT_MEMBERS))])
    for column, member in enumerate(RESULT_MEMBERS):
        assert_equal(rows[:, column], expected[member], member)


@gcc
def test_directional_derivatives_are_those_of_the_rates_and_outputs(fmus, instance):
    model = fmus["pair"][0]
    plant, own = Plant(model, "pair"), instance("pair")
    run = our_run(model, np.linspace(0.0, 0.3, 4))
    states = [run.states[each.key][2] for each in plant.states]
    own.setReal([STATE + place for place in range(len(states))], states)
    unknowns = [RATE + place for place in range(len(states))] + [OUTPUT, OUTPUT + 4]
    for place, (state, at) in enumerate(zip(plant.states, states, strict=True)):
        step = 1e-6 * max(abs(at), state.nominal or 0.0)
        found = own.getDirectionalDerivative(unknowns, [STATE + place], [1.0])
        sides = []
        for value in (at + step, at - step):
            own.setReal([STATE + place], [value])
            sides.append(np.array(own.getReal(unknowns)))
        own.setReal([STATE + place], [at])
        slopes = (sides[0] - sides[1]) / (2.0 * step)
        floor = 1e-9 * (np.abs(sides[0]) + 1e-12) / step
        assert np.all(np.abs(found - slopes) <= 1e-4 * np.abs(slopes) + floor), state.name


@gcc
def test_a_parameter_acts_as_it_does_in_our_run(fmus):
    """A load of 1.5 times the mass; on its lower stop the drive starts at the same place."""
    model, path = fmus["propneu-20"]
    drive = model.runnable.drive
    heavier = replace(drive, load=replace(drive.load, mass=1.5 * drive.load.mass), duration=1.0)
    rows = simulated(path, model, "CoSimulation", start_values={"drive.mass": 1.5 * drive.load.mass})
    rows = rows[rows["time"] < 1.0]
    run = simulate(heavier, grid=np.ascontiguousarray(rows["time"]), tolerance=1e-7)
    before = our_run(model, rows["time"])
    assert position_error(rows, run) < 1e-4
    assert position_error(rows, before) > 1e-2


@gcc
def test_inputs_act_as_the_command_of_the_document(fmus):
    model, path = fmus["propneu-20"]
    rows = simulated(
        path,
        model,
        "ModelExchange",
        input=opening_signal(model),
        start_values={"play_document_command": False},
    )
    assert position_error(rows, our_run(model, rows["time"])) < 1e-4


@gcc
def test_an_effect_changes_the_fmu_as_it_changes_our_run(fmus, tmp_path):
    document = preset_document("paper-step", studio()).to_document()
    document["effects"] = {**document.get("effects", {}), "dahl": {"force": "60 N"}, "leak": {}}
    changed = subject_of(of_drive(read_document(document, "the drive"), studio(), "x"), studio())
    plain = subject_named("paper-step")
    rows = simulated(fmu_of(changed, tmp_path, "changed"), changed, "CoSimulation")
    assert position_error(rows, our_run(changed, rows["time"])) < 1e-4
    assert position_error(rows, our_run(plain, rows["time"])) > 1e-3
    guids = {
        package.sources(each, "x")["modelDescription.xml"].split('guid="')[1][:66]
        for each in (changed, plain)
    }
    assert len(guids) == 2


@gcc
def test_a_state_that_was_kept_continues_the_same_way(instance):
    own = instance("pair", "CoSimulation")
    own.setBoolean([0], [True])
    own.exitInitializationMode()
    own.doStep(0.0, 0.2)
    kept = own.getFMUState()
    own.doStep(0.2, 0.1)
    first = own.getReal([OUTPUT, OUTPUT + 1])
    copied = own.deSerializeFMUstate(own.serializeFMUstate(kept))
    for state in (kept, copied):
        own.setFMUState(state)
        own.doStep(0.2, 0.1)
        assert own.getReal([OUTPUT, OUTPUT + 1]) == first
        own.freeFMUState(state)
    own.reset()
    own.setupExperiment(startTime=0.0)
    own.enterInitializationMode()
    assert own.getReal([OUTPUT]) != first[:1]


@gcc
def test_wrong_calls_are_refused_with_a_sentence(instance, monkeypatch):
    own = instance("propneu-20", "CoSimulation")
    own.exitInitializationMode()
    for call in (
        lambda: own.getReal([OUTPUT + KIND - 1]),
        lambda: own.setReal([OUTPUT], [1.0]),
        lambda: own.setReal([own.said["opening"]], [float("nan")]),
        lambda: own.getInteger([0]),
        lambda: own.doStep(0.5, 0.1),
    ):
        with pytest.raises(Exception, match="failed"):
            call()


@gcc
def test_the_binary_needs_the_c_library_and_nothing_else(fmus, tmp_path):
    readelf = shutil.which("readelf")
    if readelf is None:
        pytest.skip("readelf is not installed")
    with zipfile.ZipFile(fmus["propneu-20"][1]) as archive:
        path = archive.extract("binaries/linux64/propneu_20.so", tmp_path)
    said = subprocess.run([readelf, "-d", path], capture_output=True, text=True, check=True).stdout
    assert set(re.findall(r"NEEDED.*\[(.*)\]", said)) <= {"libm.so.6", "libc.so.6"}
    exported = ctypes.CDLL(path)
    assert exported.fmi2DoStep
    with pytest.raises(AttributeError):
        exported.plant_reset  # noqa: B018 - hidden


def test_sources_and_xml_are_the_same_every_time_and_units_are_known():
    for name in ("paper-step-mpye", MUSCLE):
        first = package.packed(subject_named(name), "model", ())
        assert first == package.packed(subject_named(name), "model", ())
    for model in (subject_named("paper-step-mpye"), subject_named("pair"), subject(MUSCLE)):
        plant = Plant(model, "x")
        every = [*plant.states, *plant.rates(), *plant.parameters, *plant.inputs, *plant.outputs]
        for each in every:
            assert each.unit == "1" or is_unit(each.unit), each
            assert dimension(each.unit) is not None, each
            assert len(each.meaning) > 3
        assert len({each.name for each in every}) == len(every)
        used = [each for each in plant.parameters if "Not used" not in each.meaning]
        free = [each.key for each in used if each.least is None]
        assert set(free) <= {"gravity", "precontraction", "stop_low", "stop_high", "slack_damping"}
        for each in plant.parameters:
            assert each.least is None or each.least <= each.start <= each.most, each
        for each in plant.parameters:
            assert ("Source: " in each.meaning) != ("Not used" in each.meaning), each
    assert dimension("m^3/(s*Pa)") == (-1, 4, 1, 0, 0, 0)
    assert dimension("N*s/m") == (1, 0, -1, 0, 0, 0)
    assert dimension("furlong") is None


def test_without_a_compiler_there_are_sources_and_a_message(tmp_path, monkeypatch):
    monkeypatch.setattr(build.shutil, "which", lambda name: None)
    monkeypatch.setattr(build.importlib.util, "find_spec", lambda name: None)
    said: list[str] = []
    stated = stated_source("paper-step", studio())
    (path,) = write_export(
        ExportQuestion(stated, "fmu"), tmp_path / "a.b-c.fmu", studio(), remark=said.append
    )
    assert len(said) == 1
    assert "sources only" in said[0]
    assert "mckibben[fmu]" in said[0]
    with zipfile.ZipFile(path) as archive:
        names = archive.namelist()
        xml = ElementTree.fromstring(archive.read("modelDescription.xml"))
        assert stated.title.encode() in archive.read("documentation/index.html")
    assert not any(name.startswith("binaries/") for name in names)
    listed = {each.get("name") for each in xml.iterfind("ModelExchange/SourceFiles/File")}
    assert listed == {Path(n).name for n in names if n.startswith("sources/") and n.endswith(".c")}
    assert "a_b_c.c" in listed


def test_a_compiler_that_fails_is_said_and_what_is_missing_too():
    broken = build.Compiler("win64", (("", ("sh", "-c", "echo no such luck >&2; exit 3")),))
    done = build.built({"a.c": "int a;"}, "a", (broken,))
    assert done.binaries == {}
    assert done.remarks == ("The FMU has no binary for win64, the compiler failed: no such luck",)


def test_a_compiler_that_takes_too_long_is_said_with_what_to_do(monkeypatch):
    monkeypatch.setattr(build, "_SECONDS", 0.05)
    slow = build.Compiler("win64", (("", ("sh", "-c", "exec sleep 20")),))
    (said,) = build.built({"a.c": "int a;"}, "a", (slow,)).remarks
    assert said.startswith("The FMU has no binary for win64, the compiler was stopped after")
    assert said.endswith("export again")


def test_a_macos_binary_of_two_architectures_has_the_head_that_apple_describes():
    parts = {"x86_64-macos": b"x" * 100, "aarch64-macos": b"a" * 20000}
    whole = build.universal(parts)
    magic, count = struct.unpack_from(">II", whole)
    assert (magic, count) == (0xCAFEBABE, 2)
    for number, (processor, content) in enumerate(zip((0x01000007, 0x0100000C), parts.values(), strict=True)):
        kind, _, at, size, align = struct.unpack_from(">IIIII", whole, 8 + 20 * number)
        assert kind == processor
        assert at % (1 << align) == 0
        assert whole[at : at + size] == content


@gcc
def test_hostile_texts_stay_texts(tmp_path):
    model = subject_of(hostile("c"), studio())
    texts = package.sources(model, "plant_2")
    assert ElementTree.fromstring(texts["modelDescription.xml"]).get("guid")
    assert not set("".join(texts.values())) & set("\x00\x1b\r\u2028\u202e")
    assert "<bad>" not in texts["index.html"]
    assert fmu_of(model, tmp_path, "plant").exists()  # also the name of a file of its own
    with zipfile.ZipFile(tmp_path / "plant.fmu") as archive:
        assert not any(name.startswith("/") or ".." in name for name in archive.namelist())
    alone = Stated(studio().start_model(StatedMuscle(preset="DMSP-20"), {"custom": {"term": "c*P"}}), HOSTILE)
    assert ElementTree.fromstring(package.sources(subject_of(alone, studio()), "m")["modelDescription.xml"])


def test_every_preset_can_be_packed():
    for kind in ("muscles", "drives"):
        for preset in studio().library.list(kind):
            model = subject_of(stated_source(preset.id, studio()), studio())
            xml = ElementTree.fromstring(package.sources(model, "m")["modelDescription.xml"])
            assert len(xml.findall("ModelVariables/ScalarVariable")) > 20
