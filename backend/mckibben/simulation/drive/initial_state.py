"""The start of a run: the rest position, computed from the compiled equations."""

from __future__ import annotations

import numpy as np

from mckibben.physics import gas
from mckibben.physics.braid import volume as braid_volume
from mckibben.physics.drive_terms import COUNTER, OUTPUTS
from mckibben.physics.errors import InputError
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.integrate.engine import CompiledDrive


def start_of(drive: Drive, compiled: CompiledDrive, parameters: np.ndarray, inputs: np.ndarray) -> np.ndarray:
    """The states at rest: the load in equilibrium between muscle, gravity and stops at the start pressure.

    Args:
        drive: the drive.
        compiled: its equations.
        parameters: constants of the run.
        inputs: inputs before the run, shape (inputs,).

    Raises:
        InputError: no equilibrium short of the braid lock (the load tears the muscle off its lower stop).
    """
    absolute = drive.start_pressure + drive.ambient_pressure
    initial = {
        "stroke": 0.0,
        "pressure": absolute,
        "tube_pressure": absolute,
        "regulator_pressure": absolute,
        "gas_mass": 0.0,
    }
    start = np.array(
        [
            initial[state.name.removesuffix(COUNTER)] if state.initial is None else state.initial
            for state in compiled.model.states
        ]
    )
    names = [state.name for state in compiled.model.states]
    acceleration = compiled.size + OUTPUTS.index("acceleration")
    packed = np.concatenate([start, parameters, inputs])
    masses = [index for index, name in enumerate(names) if name.removesuffix(COUNTER) == "gas_mass"]
    specific = absolute / (gas.GAS_CONSTANT * drive.temperature)
    rough = float(braid_volume(braid=drive.muscle.braid, length=drive.muscle.nominal_length))
    packed[masses] = specific * rough

    def push(stroke: float) -> float:
        packed[names.index("stroke")] = stroke
        return float(compiled.rates(packed)[acceleration])

    rest = drive.muscle.nominal_length
    longest = rest * (1.0 - drive.precontraction) - drive.model.longest  # the stroke at the braid lock
    low = max(drive.stops[0] - 0.01 * rest, longest)
    high = drive.stops[1] + 0.01 * rest
    if not push(low) >= 0.0 >= push(high):
        raise InputError(
            "the load has no rest position between the end stops at the start pressure",
            field="load",
            hint="lower the mass or the external force, or set stops.min_contraction",
        )
    from scipy.optimize import root_scalar

    start[names.index("stroke")] = packed[names.index("stroke")] = float(
        root_scalar(push, bracket=(low, high), xtol=1e-14).root
    )
    outputs = compiled.rates(packed)[compiled.size :]
    for index in masses:
        output = "volume" + names[index].removeprefix("gas_mass")
        start[index] = specific * float(outputs[compiled.model.output_names.index(output)])
    settle(compiled, start, parameters, inputs)
    return start


def settle(compiled: CompiledDrive, start: np.ndarray, parameters: np.ndarray, inputs: np.ndarray) -> None:
    """Set the states that start settled (a spool, a lagged reading) to where their rates are zero, in place.

    Their rates are linear in them. Least squares, because a lag of zero makes a rate that is always zero.
    """
    chosen = [index for index, state in enumerate(compiled.model.states) if state.settled]
    if not chosen:
        return
    packed = np.concatenate([start, parameters, inputs])
    zero = compiled.rates(packed)[chosen]
    scales = np.array([compiled.model.states[index].scale for index in chosen])
    columns = []
    for index, scale in zip(chosen, scales, strict=True):
        packed[index] = start[index] + scale
        columns.append(compiled.rates(packed)[chosen] - zero)
        packed[index] = start[index]
    start[chosen] += scales * np.linalg.lstsq(np.column_stack(columns), -zero, rcond=None)[0]
