"""The joint of an antagonist pair in a run: angle, torque, stiffness, and its second muscle."""

from __future__ import annotations

import numpy as np

from mckibben.facts.result import Series, result_class
from mckibben.physics.drive_terms import COUNTER
from mckibben.simulation.drive.transient import Run

Array = np.ndarray


@result_class
class JointMotion:
    """The pulley of an antagonist pair, and its second muscle."""

    angle: Series
    """Pulley angle from the middle [rad], positive as the first muscle pulls."""
    torque: Series
    """Torque of both muscles on the pulley [N*m]."""
    stiffness: Series
    """Stiffness of the joint at constant pressures [N*m/rad]."""
    counter_force: Series
    """Tension of the second muscle [N]."""
    counter_pressure: Series
    """Pressure in the second muscle [Pa]."""
    counter_command: Series
    """Command of the second valve or regulator [-]."""
    counter_mass_flow: Series
    """Mass flow into the second muscle [kg/s]."""
    counter_supply_flow: Series
    """Mass flow from the supply to the second muscle [kg/s]."""
    counter_exhaust_flow: Series
    """Mass flow from the second muscle to the atmosphere [kg/s]."""
    counter_diameter: Series
    """Braid diameter of the second muscle at mid-span [m]."""
    angle_reference: Series | None
    """Set point of the angle [rad]; None without a controller."""
    stiffness_reference: Series | None
    """Set point of the stiffness [N*m/rad]; None where the stiffness is not controlled."""
    stiffness_error: float | None
    """Root mean square of stiffness minus set point over the rows [N*m/rad]; None without one."""


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
