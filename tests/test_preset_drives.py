"""Every drive preset is one that could be built, or is declared a curve fit.

A drive rests where its source does, its conductances and dead volume are those of parts, it keeps the limits
of its own parts, and the air that passes its valve is what its muscle takes in: the change of p V, with V by
the closed form of the braid. The integrator's volumes and its air balance are used for none of it.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import pi, sin, tan
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mckibben
from mckibben import cli
from mckibben.application.json_text import to_json
from mckibben.application.run.simulate import SimulationQuestion, SimulationResult, simulate
from mckibben.documents.drive_reading import AnnotatedDrive, drive_of, preset_document, read_document
from mckibben.export.source import stated_source
from mckibben.export.subject import subject_of
from mckibben.presets import DrivePreset, ValvePreset
from tests.shipped import shipped_studio

STUDIO = shipped_studio()
DRIVES = {each.id: each for each in STUDIO.library.list("drives") if isinstance(each, DrivePreset)}
LITRE_BAR = 1e-8  # m3/(s Pa)
GAS_CONSTANT = 287.05  # J/(kg K), dry air
#: Fittings of 1 to 10 cm3 each (engineering estimate, E), one on either end of 1 m of the widest tube:
#: PUN-H-10x1.5 has 7 mm of bore (type code, M).
MOST_DEAD_VOLUME = 2 * 10e-6 + pi / 4 * 7e-3**2 * 1.0
AIR_FACTOR = 2.0
#: A phase of a step whose positioning time the source prints ends at rest.
RESTS = "extend.positioning_time", "retract.positioning_time", "extend.motion_time", "retract.motion_time"


def misses(annotated: AnnotatedDrive, result: SimulationResult, printed: set[str]) -> Iterator[str]:
    """Why it is no drive."""
    drive = annotated.drive
    for phase in dict.fromkeys(name.partition(".")[0] for name in RESTS if name in printed):
        motion = getattr(result.timing, phase).motion
        if motion != "arrives on the stop and holds":
            yield f"rest: {phase} {motion}"
    flows = [
        each.data["sonic_conductance"].si("m^3/(s*Pa)")
        for each in STUDIO.library.list("valves")
        if isinstance(each, ValvePreset) and "sonic_conductance" in each.data
    ]
    for way, flow in (("fill", drive.valve.fill_conductance), ("exhaust", drive.valve.exhaust_conductance)):
        if not min(flows) <= flow <= max(flows) * (1 + 1e-9):
            yield f"conductance: {way} {flow / LITRE_BAR:.3g} l/(s bar)"
    if drive.fitting_volume > MOST_DEAD_VOLUME:
        yield f"dead volume: {drive.fitting_volume * 1e6:.4g} cm3"
    yield from (f"limit: {flag.message}" for flag in result.flags if flag.code.startswith("over_"))
    ratio = air_ratio(annotated, result)
    if not 1 / AIR_FACTOR <= ratio <= AIR_FACTOR:
        yield f"air: {ratio:.3g} times p dV and dead volume"


def air_ratio(annotated: AnnotatedDrive, result: SimulationResult) -> float:
    """Air through the valve both ways, over the changes of p V/(R T) in muscle and dead volume of parts."""
    drive, joint = annotated.drive, result.joint
    dead = min(drive.fitting_volume, MOST_DEAD_VOLUME)
    contraction = result.contraction
    sides = [(contraction, result.pressure, result.supply_flow, result.exhaust_flow)]
    if joint is not None and joint.counter_pressure is not None:
        mirrored = 2 * drive.precontraction - contraction
        if drive.path is not None:
            mirrored = 1 - drive.lengths(result.position)[1] / drive.muscle.nominal_length
        sides.append(
            (mirrored, joint.counter_pressure, joint.counter_supply_flow, joint.counter_exhaust_flow)
        )
    passed = needed = 0.0
    for side, pressure, supply, exhaust in sides:
        muscle = drive.muscle
        left, angle = 1 - side, muscle.braid_angle
        bore = pi / 4 * (muscle.inside_diameter or muscle.braid_diameter) ** 2 * muscle.nominal_length
        volume = bore * (left / sin(angle) ** 2 - left**3 / tan(angle) ** 2)
        charge = (pressure + drive.ambient_pressure) * (volume + dead) / (GAS_CONSTANT * drive.temperature)
        needed += float(np.sum(np.abs(np.diff(charge))))
        passed += float(np.trapezoid(np.abs(supply) + np.abs(exhaust), result.time))
    return passed / needed


def examined(document: dict[str, Any], printed: set[str]) -> list[str]:
    annotated = drive_of(read_document(document, "the drive"), STUDIO)
    return list(misses(annotated, simulate(SimulationQuestion(annotated)), printed))


def printed_of(preset: DrivePreset) -> set[str]:
    return set() if preset.paper is None else set(preset.paper.figures)


@pytest.mark.parametrize("name", DRIVES)
def test_a_preset_is_a_drive_that_could_be_built_or_is_declared_a_curve_fit(name: str) -> None:
    preset = DRIVES[name]
    why = examined(preset.document, printed_of(preset))
    assert bool(why) == bool(preset.document.get("curve_fit")), why or "a drive that is declared a curve fit"


def test_each_fault_of_a_drive_is_found() -> None:
    preset = DRIVES["propneu-20-physical"]
    document, printed = preset.document, printed_of(preset)
    planted: dict[str, dict[str, Any]] = {
        "conductance": {"valve": {**document["valve"], "sonic_conductance": "12 l/(s*bar)"}},
        "dead volume": {"gas": {**document["gas"], "dead_volume": "120 cm^3"}},
        "air": {"gas": {**document["gas"], "dead_volume": "2 l"}, "duration": "4 s"},
        "rest": {"load": {**document["load"], "mass": "40 kg"}},
        "limit": {"muscle": {**document["muscle"], "nominal_length": "740 mm"},
                  "stops": {"max_contraction": 0.27}, "load": {**document["load"], "mass": "4 kg"}},
    }  # fmt: skip
    for fault, changes in planted.items():
        why = examined({**document, **changes}, printed)
        assert any(each.startswith(f"{fault}:") for each in why), (fault, why)


@pytest.mark.parametrize("size", [20, 10])
def test_a_curve_fit_is_called_one_wherever_it_is_used(
    size: int, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    name = f"propneu-{size}"
    said = f"curve fit of {DRIVES[name].document['curve_fit']}, not a drive"
    drive = mckibben.Drive.preset(name)
    run = drive.changed(load={"mass": "5 kg"}).run(points=11)  # what starts from it is one too
    study = {
        "subject": {"drive": name},
        "quantities": [{"path": "load.mass", "values": ["8 kg"]}],
        "figures": ["timing.extend.positioning_time"],
        "method": {"type": "grid"},
    }
    run.save(tmp_path / "run.csv")
    assert cli.run(["compare", str(tmp_path / "run.csv"), "--drive", name]) == 0
    compared = "".join(capsys.readouterr())
    exported = subject_of(stated_source(name, STUDIO), STUDIO).about
    assert cli.run(["simulate", name]) == 0
    shown = {
        "run": repr(run),
        "messages": "\n".join(run.messages),
        "drive": repr(drive),
        "linear": repr(drive.linearise(amplitudes=())),
        "listing": str(mckibben.presets("drives")),
        "catalogue": DRIVES[name].public()["title"],
        "study": " ".join(mckibben.study(study).remarks),
        "export": next(exported.lines()),
        "terminal": capsys.readouterr().out,
        "comparison": compared,
        "JSON of a run": to_json(run).decode(),
        "saved": str(drive.document),
    }
    lost = {place for place, text in shown.items() if said not in str(text)}
    assert lost == {"saved"}  # which holds the field itself
    assert drive.document["curve_fit"]
    assert preset_document(f"{name}-physical", STUDIO).named("x") == "x"
