"""A and B of linear models by differences of the engine's own rates.

Where an orifice opens on one side of the point only, or a play pushes in one direction only, the derivative
of that side is the one-sided difference: of a regulator that fills, its set point after the lag rises and
the pressure behind it falls.
"""

from __future__ import annotations

import numpy as np

from mckibben.physics.drive_terms import COUNTER
from mckibben.simulation.drive.initial_state import settle
from mckibben.simulation.linear.bound import ASIDE, BoundDrive
from mckibben.simulation.linear.linearise import Linearisation
from mckibben.simulation.linear.model import LinearModel
from mckibben.simulation.linear.point import OperatingPoint

Array = np.ndarray

_COMMANDS = {"command": 0, "counter_command": 2, "load_force": 4}  # in the engine's inputs
_VALVE = {"spool_lag.position": 1.0, "valve_hysteresis.position": -1.0}


def side_of(model: LinearModel) -> int:
    """1 of a model that fills, -1 of one that vents, 0 of one with both."""
    if model.name.startswith("mean"):
        return 0
    return 1 if model.name.endswith("filling") else -1 if model.name.endswith("venting") else 0


def offset_of(linear: Linearisation, side: int) -> float:
    """From the command of the point to the edge of the dead band."""
    if linear.dead_band is None or not side:
        return 0.0
    return linear.dead_band[side > 0] - linear.point.command


def sense_of(bound: BoundDrive, name: str) -> float:
    """In which direction a state moves while the first muscle fills and the second vents; 0: no corner."""
    plain = name.removesuffix(COUNTER)
    sense = _VALVE.get(plain, 0.0)
    if bound.drive.regulator is not None:
        outlet = "tube_pressure" if bound.places("tube_pressure") else "pressure"
        sense = {"regulator_pressure": 1.0, outlet: -1.0}.get(plain, sense)
    return sense if plain == name else -sense


def differences(
    point: OperatingPoint,
    states: list[str],
    inputs: list[str],
    scales: tuple[Array, Array],
    *,
    side: int,
    offset: float,
) -> tuple[Array, Array]:
    """A and B over the magnitudes of states and inputs, of the side stated; 0: of both, their mean."""
    bound, compiled, names = point.bound, point.bound.compiled, point.bound.names
    expansion = {names[place]: bound.expansion[:, i] for i, place in enumerate(bound.independent)}
    rows = [names.index(state) for state in states]
    supply = list(bound.equations.model.parameters).index("supply_pressure")
    state, at = point.state.copy(), bound.inputs(point.command + offset + side * ASIDE)
    if offset or side:
        settle(compiled, state, bound.parameters, at)

    def moved(name: str, size: float) -> Array:
        own, given, parameters = state.copy(), at.copy(), bound.parameters.copy()
        if name in expansion:
            own += size * expansion[name]
        elif name in _COMMANDS:
            given[_COMMANDS[name]] += size
        else:
            parameters[supply] += size
        rates = compiled.rates(np.concatenate([own, parameters, given]), point.switches)
        return rates[rows] / scales[0]

    def central(name: str, scale: float, size: float) -> Array:
        """Richardson's extrapolation of two central differences; each step stays where the flow is linear."""
        once, twice = (
            (moved(name, h * scale) - moved(name, -h * scale)) / (2.0 * h) for h in (size, 2.0 * size)
        )
        return (4.0 * once - twice) / 3.0

    def to_side(name: str, scale: float, size: float, sense: float) -> Array:
        """The same to one side, of third order."""
        h = size * scale * sense
        zero, one, two, four = (moved(name, share * h) for share in (0.0, 1.0, 2.0, 4.0))
        first, second, third = (
            (each - zero) / share for each, share in ((one, 1.0), (two, 2.0), (four, 4.0))
        )
        rough, fine = 2.0 * second - third, 2.0 * first - second
        return (4.0 * fine - rough) / 3.0 * scale / h

    # A regulator changes from filling to venting at its rest: the error of a difference grows with the step.
    small = 1e-5 if bound.drive.regulator is None else 3e-6
    a, b = [], []
    for name, scale in zip(states, scales[0], strict=True):
        sense = side * sense_of(bound, name)
        a.append(to_side(name, scale, 1e-5, sense) if sense else central(name, scale, small))
    for name, scale in zip(inputs, scales[1], strict=True):
        sense = side * {"command": 1.0, "counter_command": -1.0}.get(name, 0.0)
        b.append(to_side(name, scale, 1e-5, sense) if sense else central(name, scale, 1e-5))
    return np.column_stack(a), np.column_stack(b)


def of_model(linear: Linearisation, model: LinearModel) -> tuple[Array, Array, Array, Array]:
    """A and B of a model by differences, and the exact ones, all over the magnitudes."""
    states, inputs, _ = model.scales
    side = side_of(model)
    own, ports = [each.name for each in model.states], [each.name for each in model.inputs]
    a, b = differences(model.point, own, ports, (states, inputs), side=side, offset=offset_of(linear, side))
    return a, b, model.a * states / states[:, None], model.b * inputs / states[:, None]
