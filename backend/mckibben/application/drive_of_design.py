"""Converts a design of the sizing search to a drive document."""

from __future__ import annotations

from typing import Any

from mckibben.sizing import Design, Task
from mckibben.sizing.catalogue import switch_on


def drive_document(design: Design, task: Task) -> dict[str, Any]:
    """The drive of one of the parallel muscles as a document; its simulation gives the proposal's figures."""
    group, drive = design.group, design.group.drive(task, design.length, design.pressure)
    duty, load = group.duty, drive.load
    on = switch_on(task, duty)
    valve: dict[str, Any] = {"preset": group.valve.id}
    if group.parallel > 1:
        valve["sonic_conductance"] = drive.valve.fill_conductance
        valve["exhaust_conductance"] = drive.valve.exhaust_conductance
    moved: dict[str, Any] = {"mass": load.mass, "force": load.force, "spring": load.spring}
    if duty.pair:
        moved |= {
            "arrangement": "antagonist",
            "pulley_radius": duty.pulley_radius,
            "precontraction": drive.precontraction,
        }
    else:
        moved["inclination"] = load.inclination
        if duty.lever_ratio != 1.0:
            moved |= {"arrangement": "lever", "lever_ratio": load.lever_ratio}
    document: dict[str, Any] = {
        "schema": 1,
        "title": f"{group.muscle.id}, one of {group.muscles}" if group.muscles > 1 else group.muscle.id,
        "muscle": {"preset": group.muscle.id, "nominal_length": design.length},
        "supply": {"pressure": design.pressure},
        "valve": valve,
        "load": moved,
        "command": {"shape": "pulse", "on": on, "off": on + task.fill_time},
        "gas": {"temperature": task.temperature},
        "stops": {"min_contraction": 0.0, "max_contraction": drive.max_contraction},
        "duration": drive.duration,
    }
    if drive.tube is not None:
        document["tube"] = {"preset": group.tube.id, "length": drive.tube.length}
    return document
