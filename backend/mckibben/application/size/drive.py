"""Converts a design of the sizing search to a drive document."""

from __future__ import annotations

from mckibben.documents.drive import DriveDocument, LoadInput
from mckibben.simulation.drive.parts import Drive
from mckibben.sizing import Design, Task
from mckibben.sizing.catalogue import Group, switch_on


def drive_document(design: Design, task: Task) -> DriveDocument:
    """The drive of one of the parallel muscles as a document; its simulation gives the proposal's figures."""
    group, drive = design.group, design.group.drive(task, design.length, design.pressure)
    on = switch_on(task, group.duty)
    valve: dict[str, object] = {"preset": group.valve.id}
    if group.parallel > 1:
        valve["sonic_conductance"] = drive.valve.fill_conductance
        valve["exhaust_conductance"] = drive.valve.exhaust_conductance
    document: dict[str, object] = {
        "schema": 1,
        "title": f"One of {group.muscles} muscles" if group.muscles > 1 else "",
        "muscle": {"preset": group.muscle.id, "nominal_length": design.length},
        "supply": {"pressure": design.pressure},
        "valve": valve,
        "load": _load(group, drive),
        "command": {"shape": "pulse", "on": on, "off": on + task.fill_time},
        "gas": {"temperature": task.temperature},
        "stops": {"min_contraction": 0.0, "max_contraction": drive.max_contraction},
        "duration": drive.duration,
    }
    if drive.tube is not None:
        document["tube"] = {"preset": group.tube.id, "length": drive.tube.length}
    return DriveDocument.model_validate(document)


def _load(group: Group, drive: Drive) -> LoadInput:
    load, duty = drive.load, group.duty
    values: dict[str, object] = {"mass": load.mass, "force": load.force, "spring": load.spring}
    if duty.pair:
        values |= {
            "arrangement": "antagonist",
            "pulley_radius": duty.pulley_radius,
            "precontraction": drive.precontraction,
        }
    else:
        values["inclination"] = load.inclination
        if duty.lever_ratio != 1.0:
            values |= {"arrangement": "lever", "lever_ratio": load.lever_ratio}
    # Without validation: the mass equivalent to an inertia may exceed what a document may state.
    return LoadInput.model_construct(None, **values)
