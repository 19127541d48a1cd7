"""FMI 3.0: valid by FMPy, the same numbers as FMI 2.0, prototypes of the standard's own headers."""

from __future__ import annotations

import re
import shutil
import subprocess
import zipfile
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

from mckibben.export.fmu import package
from mckibben.export.fmu.build import Compiler, built
from mckibben.export.fmu.dialects import FMI2, FMI3, Dialect
from mckibben.export.fmu.variables import INDICATOR, OUTPUT, PARAMETER, PLAY, RATE, STATE, SWITCH, TIME, Plant
from mckibben.export.subject import Subject, subject_of
from tests.export.fmus import KINDS, opening_signal, our_run, position_error, shared_fmu, simulated
from tests.export.models import studio, subject
from tests.export.test_fmu import DRIVES, MUSCLE, subject_named
from tests.export.test_formats import hostile, hostile_saved

IN_FMI2 = pytest.mark.examination("tests/export/test_fmu.py::test_fmpy_gives_the_motion_of_the_engine")
SOME_DRIVES = [pytest.param(name, marks=IN_FMI2) if name == "paper-hysteresis" else name for name in DRIVES]
pytestmark = pytest.mark.skipif(shutil.which("gcc") is None, reason="gcc is not installed")


@pytest.fixture(scope="module")
def fmus(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[Subject, Path, Path]]:
    """Of each model its FMU of FMI 2.0 and of 3.0."""
    pytest.importorskip("fmpy", reason="FMPy is not installed")
    base = tmp_path_factory.getbasetemp()

    class Made(dict[str, tuple[Subject, Path, Path]]):
        """Each is compiled when a test asks for it."""

        def __missing__(self, name: str) -> tuple[Subject, Path, Path]:
            model = subject_named(name)
            one, other = (shared_fmu(model, base, name, each) for each in (FMI2, FMI3))
            self[name] = model, one, other
            return self[name]

    return Made()


@pytest.mark.parametrize("name", [*SOME_DRIVES, MUSCLE])
def test_the_fmu_is_valid(name, fmus):
    from fmpy.model_description import read_model_description
    from fmpy.validation import validate_fmu

    path = str(fmus[name][2])
    assert validate_fmu(path) == []
    said = read_model_description(path)
    assert said.fmiVersion == "3.0"
    assert said.numberOfEventIndicators == len(Plant(fmus[name][0], "x").switches)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", SOME_DRIVES)
def test_both_versions_give_the_same_numbers(name, kind, fmus):
    model, old, new = fmus[name]
    rows, before = (simulated(path, model, kind) for path in (new, old))
    assert np.ptp(rows["position"]) > 1e-4
    for column in rows.dtype.names:
        np.testing.assert_array_equal(rows[column], before[column], err_msg=column)


def test_inputs_and_parameters_act(fmus):
    """The command of the document as a signal, and a heavier load."""
    model, _, path = fmus["propneu-20"]
    rows = simulated(path, model, "ModelExchange", input=opening_signal(model), start_values={PLAY: False})
    assert position_error(rows, our_run(model, rows["time"])) < 1e-4
    heavy = simulated(path, model, "CoSimulation", start_values={"drive.mass": 60.0})
    assert np.max(np.abs(heavy["position"][:1000] - rows["position"][:1000])) > 1e-3


@pytest.fixture
def instance(fmus: dict[str, tuple[Subject, Path, Path]], tmp_path: Path) -> Any:
    """FMPy's object of the pair, for co-simulation, in initialisation mode."""
    from fmpy import extract
    from fmpy.fmi3 import FMU3Slave
    from fmpy.model_description import read_model_description

    folder = extract(str(fmus["pair"][2]), str(tmp_path / "pair"))
    said = read_model_description(folder)
    own = FMU3Slave(guid=said.guid, unzipDirectory=folder, modelIdentifier=said.coSimulation.modelIdentifier)
    own.instantiate()
    own.enterInitializationMode(startTime=0.0)
    yield own
    own.freeInstance()


def test_a_state_that_was_kept_continues_the_same_way_and_wrong_calls_are_refused(instance):
    instance.setBoolean([0], [True])
    assert instance.getBoolean([0]) == [True]
    instance.exitInitializationMode()
    instance.doStep(0.0, 0.2)
    kept = instance.getFMUState()
    instance.doStep(0.2, 0.1)
    first = instance.getFloat64([OUTPUT, OUTPUT + 1])
    copied = instance.deserializeFMUState(instance.serializeFMUState(kept))
    for state in (kept, copied):
        instance.setFMUState(state)
        instance.doStep(0.2, 0.1)
        assert instance.getFloat64([OUTPUT, OUTPUT + 1]) == first
        instance.freeFMUState(state)
    assert instance.getFloat64([TIME]) == [pytest.approx(0.3)]
    for call in (
        lambda: instance.getFloat64([OUTPUT + 99_999]),
        lambda: instance.setFloat64([OUTPUT], [1.0]),
        lambda: instance.setFloat64([STATE], [float("inf")]),
        lambda: instance.getFloat64([INDICATOR + 99]),
        lambda: instance.getInt32([0]),
        lambda: instance.doStep(7.0, 0.1),
    ):
        with pytest.raises(Exception, match="failed"):
            call()
    instance.reset()
    instance.enterInitializationMode(startTime=0.0)
    assert instance.getFloat64([OUTPUT]) != first[:1]


@pytest.mark.examination("tests/export/test_fmu.py::test_wrong_calls_are_refused_with_a_sentence")
@pytest.mark.parametrize("value", [0.0, -1.0, 1e300, 1e-300])
def test_an_absurd_parameter_ends_in_a_sentence_or_a_run_but_never_hangs(value, fmus, instance):
    """Among them a valve of 1e300: its stiffness would need steps of picoseconds, so the call ends early."""
    names = [each.key for each in Plant(fmus["pair"][0], "x").parameters]
    for name in ("exhaust_conductance", "mass", "nominal_length", "tube_volume"):
        instance.reset()
        instance.enterInitializationMode(startTime=0.0)
        instance.setBoolean([0], [True])
        instance.setFloat64([PARAMETER + names.index(name)], [value])
        instance.exitInitializationMode()
        try:
            instance.doStep(0.0, 0.05)
        except Exception as error:
            assert "failed" in str(error)  # noqa: PT017 - a run is right too
        else:
            assert all(np.isfinite(instance.getFloat64([STATE + place for place in range(4)])))


def test_directional_derivatives_are_those_of_rates_and_outputs(instance):
    states = instance.getFloat64([STATE + place for place in range(4)])
    unknowns = [RATE, RATE + 1, RATE + 2, OUTPUT, OUTPUT + 5]
    for place, at in enumerate(states):
        step = 1e-5 * max(abs(at), 1e-3)
        found = np.array(instance.getDirectionalDerivative(unknowns, [STATE + place], [2.0]))
        sides = []
        for value in (at + step, at - step):
            instance.setFloat64([STATE + place], [value])
            sides.append(np.array(instance.getFloat64(unknowns)))
        instance.setFloat64([STATE + place], [at])
        slopes = (sides[0] - sides[1]) / step
        floor = 1e-8 * (np.abs(sides[0]) + 1e-9) / step
        assert np.all(np.abs(found - slopes) <= 1e-3 * np.abs(slopes) + floor), place


@pytest.mark.parametrize(("dialect", "number"), [(FMI2, 2), (FMI3, 3)])
def test_prototypes_are_those_of_the_standard(dialect: Dialect, number: int, tmp_path: Path):
    """Compiled with the headers of the standard in the place of ours: another prototype is an error."""
    fmpy = pytest.importorskip("fmpy", reason="FMPy is not installed")
    headers = Path(fmpy.__file__).parent / "c-code"
    texts = package.sources(subject("dahl"), "m", dialect)
    for name in ("fmi.c", "access.h", "plant.h", "model.h"):
        (tmp_path / name).write_text(texts[name], "utf-8")
    words = texts["fmi.h"].partition("/* The words of fmi.c. */")[2].rpartition("#endif")[0]
    (tmp_path / "fmi.h").write_text(
        f'#include "fmi{number}Functions.h"\n#define FMI{number}(name) name\n'
        f"#undef FMI{number}_EXPORT\n#define FMI{number}_EXPORT\n{words}",
        "utf-8",
    )
    command = ["gcc", "-std=c99", "-Werror", "-I", str(headers), "-c", "fmi.c"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    said = (headers / f"fmi{number}Functions.h").read_text("utf-8")
    wanted = set(re.findall(rf"FMI{number}_Export\s+fmi{number}\w+TYPE\s+(fmi{number}\w+);", said))
    symbols = subprocess.run(["nm", "fmi.o"], cwd=tmp_path, capture_output=True, text=True).stdout
    assert len(wanted) > 30
    assert wanted <= set(re.findall(r" T (\w+)", symbols))


def test_sources_are_listed_and_the_same_every_time(tmp_path):
    model = subject_of(hostile("c"), studio())
    texts = package.sources(subject_of(hostile_saved(), studio()), "m", FMI3)
    assert not set("".join(texts.values())) & set("\x00\x1b\r\u2028\u202e")
    assert "<bad>" not in texts["index.html"] + texts["modelDescription.xml"]
    file = package.packed(model, "fmi", (), FMI3)
    assert file == package.packed(model, "fmi", (), FMI3)
    (tmp_path / file.name).write_bytes(file.content)
    with zipfile.ZipFile(tmp_path / file.name) as archive:
        names = archive.namelist()
        build = ElementTree.fromstring(archive.read("sources/buildDescription.xml"))
        xml = ElementTree.fromstring(archive.read("modelDescription.xml"))
    listed = {each.get("name") for each in build.iter("SourceFile")}
    assert listed == {Path(n).name for n in names if n.startswith("sources/") and n.endswith(".c")}
    assert "fmi_model.c" in listed  # not the name of the interface's own file
    references = [each.get("valueReference") for each in xml.find("ModelVariables") or ()]
    assert len(set(references)) == len(references)
    assert str(SWITCH) in references
    assert "do not follow a parameter" in (xml.get("description") or "")


def test_binaries_stand_in_folders_of_architecture_and_system():
    targets = {"linux64": ("x86_64-linux-gnu.2.17",), "darwin64": ("x86_64-macos", "aarch64-macos")}
    using = [Compiler(name, tuple((each, ("gcc",)) for each in own)) for name, own in targets.items()]
    done = built({"a.c": "int a;"}, "a", tuple(using), tuples=True)
    folders = [Path(name).parent.name for name in done.binaries]
    assert folders == ["x86_64-linux", "x86_64-darwin", "aarch64-darwin"]
    assert "not for win64;" in done.remarks[0]
