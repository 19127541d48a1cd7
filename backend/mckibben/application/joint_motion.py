"""The joint of an antagonist pair in a run: angle, torque, stiffness, and its second muscle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mckibben.physics.drive_terms import COUNTER
from mckibben.simulation.drive.transient import Run

Array = np.ndarray


@dataclass(frozen=True, slots=True)
class JointMotion:
    """The pulley of an antagonist pair, and its second muscle.

    Attributes:
        angle: from the middle [rad]; positive in the direction of the first muscle.
        torque: of both muscles [N m].
        stiffness: at constant pressures [N m/rad].
        counter_force, counter_pressure: of the second muscle [N], [Pa].
        counter_command: of its valve or regulator, before dead times.
        counter_mass_flow, counter_supply_flow, counter_exhaust_flow: of the second muscle [kg/s].
        counter_diameter: of its braid [m].
        angle_reference, stiffness_reference: set points [rad], [N m/rad]; None without.
        stiffness_error: root mean square of stiffness minus set point [N m/rad]; None without one.
    """

    angle: Array
    torque: Array
    stiffness: Array
    counter_force: Array
    counter_pressure: Array
    counter_command: Array
    counter_mass_flow: Array
    counter_supply_flow: Array
    counter_exhaust_flow: Array
    counter_diameter: Array
    angle_reference: Array | None
    stiffness_reference: Array | None
    stiffness_error: float | None


def joint_of(run: Run, rows: Array) -> JointMotion | None:
    """Angle, torque and stiffness of a pair's pulley; the stiffness at constant pressures."""
    drive = run.drive
    if drive.pulley_radius is None:
        return None
    radius, rest = drive.pulley_radius, drive.muscle.nominal_length
    stroke = run.states["stroke"][rows]
    pressures = [
        run.states[name][rows] - drive.ambient_pressure for name in ("pressure", f"pressure{COUNTER}")
    ]
    middle = rest * (1.0 - drive.precontraction)
    stiffness = np.zeros(len(rows))
    for sense, pressure in zip((1.0, -1.0), pressures, strict=True):
        seen = drive.model.outputs(
            length=middle - sense * stroke, pressure=pressure, temperature=drive.temperature
        )
        stiffness += np.where(seen["tension"] > 0.0, seen["tension_by_length"], 0.0)
    counter = run.outputs[f"force{COUNTER}"][rows]
    wanted = None if drive.stiffness is None else np.asarray(drive.stiffness.reference.value(run.time))[rows]
    error = None if wanted is None else float(np.sqrt(np.mean((radius**2 * stiffness - wanted) ** 2)))
    flows = (run.outputs[f"{name}_flow{COUNTER}"][rows] for name in ("mass", "supply", "exhaust"))
    if run.counter_command is not None:
        command = run.counter_command.value(run.time)[rows]
    else:
        own = drive.command if drive.reference is None else run.command
        command = 2.0 * drive.common_command - np.asarray(own.value(run.time))[rows]
    inflow, supplied, vented = flows
    return JointMotion(
        angle=stroke / radius,
        torque=radius * (run.outputs["force"][rows] - counter),
        stiffness=radius**2 * stiffness,
        counter_force=counter,
        counter_pressure=pressures[1],
        counter_command=command,
        counter_mass_flow=inflow,
        counter_supply_flow=supplied,
        counter_exhaust_flow=vented,
        counter_diameter=run.outputs[f"diameter{COUNTER}"][rows],
        angle_reference=None
        if drive.reference is None
        else np.asarray(drive.reference.value(run.time))[rows] / radius,
        stiffness_reference=wanted,
        stiffness_error=error,
    )
