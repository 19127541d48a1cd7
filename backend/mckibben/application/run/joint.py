"""The joint of an antagonist pair in a run: angle, torque, stiffness, and its second muscle."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from mckibben.facts.result import Series, result_class
from mckibben.facts.run import JOINT
from mckibben.physics.drive_terms import COUNTER
from mckibben.simulation.drive.transient import Run

Array = np.ndarray


@result_class
class JointMotion:
    """The pulley of an antagonist pair, and its second muscle."""

    FIGURES: ClassVar = JOINT.name

    angle: Series
    torque: Series
    stiffness: Series
    counter_force: Series
    counter_pressure: Series
    counter_command: Series
    counter_mass_flow: Series
    counter_supply_flow: Series
    counter_exhaust_flow: Series
    counter_diameter: Series
    angle_reference: Series | None
    stiffness_reference: Series | None
    stiffness_error: float | None


def joint_of(run: Run, rows: Array) -> JointMotion | None:
    """Angle, torque and stiffness of a pair's pulley; the stiffness at constant pressures."""
    drive = run.drive
    if drive.pulley_radius is None:
        return None
    radius = drive.pulley_radius
    counter = run.outputs[f"force{COUNTER}"][rows]
    wanted = None if drive.stiffness is None else np.asarray(drive.stiffness.reference.value(run.time))
    error = None
    if wanted is not None and len(run.time) > 1:
        square = (_stiffness(run, slice(None)) - wanted) ** 2
        error = float(np.sqrt(np.trapezoid(square, run.time) / np.ptp(run.time)))
    flows = (run.outputs[f"{name}_flow{COUNTER}"][rows] for name in ("mass", "supply", "exhaust"))
    if run.counter_command is not None:
        command = run.counter_command.value(run.time)[rows]
    else:
        own = drive.command if drive.reference is None else run.command
        command = 2.0 * drive.common_command - np.asarray(own.value(run.time))[rows]
    inflow, supplied, vented = flows
    return JointMotion(
        angle=run.states["stroke"][rows] / radius,
        torque=radius * (run.outputs["force"][rows] - counter),
        stiffness=_stiffness(run, rows),
        counter_force=counter,
        counter_pressure=run.states[f"pressure{COUNTER}"][rows] - drive.ambient_pressure,
        counter_command=command,
        counter_mass_flow=inflow,
        counter_supply_flow=supplied,
        counter_exhaust_flow=vented,
        counter_diameter=run.outputs[f"diameter{COUNTER}"][rows],
        angle_reference=None
        if drive.reference is None
        else np.asarray(drive.reference.value(run.time))[rows] / radius,
        stiffness_reference=None if wanted is None else wanted[rows],
        stiffness_error=error,
    )


def _stiffness(run: Run, rows: Array | slice) -> Array:
    """Stiffness of the joint at constant pressures [N m/rad]."""
    drive = run.drive
    stroke = run.states["stroke"][rows]
    middle = drive.muscle.nominal_length * (1.0 - drive.precontraction)
    total = np.zeros(len(stroke))
    for sense, name in ((1.0, "pressure"), (-1.0, f"pressure{COUNTER}")):
        seen = drive.model.outputs(
            length=middle - sense * stroke,
            pressure=run.states[name][rows] - drive.ambient_pressure,
            temperature=drive.temperature,
        )
        total += np.where(seen["tension"] > 0.0, seen["tension_by_length"], 0.0)
    return (drive.pulley_radius or 0.0) ** 2 * total
