r"""A linear model: :math:`\dot x = A x + B u,\ y = C x + D u`, all deviations from the operating point."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mckibben.physics.drive_terms import COUNTER
from mckibben.simulation.drive.initial_state import settle
from mckibben.simulation.linear.bound import ASIDE, BoundDrive
from mckibben.simulation.linear.equations import COMMAND, COUNTER_COMMAND, LOAD_FORCE, SUPPLY, Port
from mckibben.simulation.linear.point import OperatingPoint

Array = np.ndarray

_STATES = {
    "stroke": ("m", "stroke of the muscle, positive = shorter"),
    "speed": ("m/s", "rate of the stroke"),
    "pressure": ("Pa", "absolute pressure in the muscle"),
    "tube_pressure": ("Pa", "absolute pressure in the tube"),
    "regulator_pressure": ("Pa", "absolute set point of the regulator after its lag"),
    "regulator_rate": ("Pa/s", "rate of the set point of the regulator"),
    "gas_mass": ("kg", "mass of the air in the muscle"),
}
_ABSOLUTE = ("pressure", "tube_pressure", "regulator_pressure")
# Share by which pressures along a path without flow are moved apart.
_PRESSURE_ASIDE = 1e-11
# Speed [m/s] that tells the directions of friction with memory apart and moves nothing.
_CREEP = 1e-13
# Magnitudes of the inputs, for the conditioning of matrices; no result depends on them.
INPUT_SCALES = {COMMAND.name: 1.0, COUNTER_COMMAND.name: 1.0, SUPPLY.name: 1e5, LOAD_FORCE.name: 100.0}
_OUTPUT_SCALES = {"m": 0.1, "m/s": 1.0, "Pa": 1e5, "N": 100.0, "kg/s": 1e-3}


@dataclass(frozen=True)
class LinearModel:
    """The matrices of a model, and what it is a model of.

    Attributes:
        name: short name, "smooth", "mean of both sides", "held", "sliding shorter", "filling", ...
        text: what it describes, one sentence.
        states, inputs, outputs: names with SI units, in the order of the matrices.
        a, b, c, d: shapes (states, states), (states, inputs), (outputs, states), (outputs, inputs).
        dead_time: of the command [s]; not in the matrices, but in every frequency response of it.
        point: where it was linearised.
        mirrored: whether the command of a second muscle follows the first's, with the opposite sign.
    """

    name: str
    text: str
    states: tuple[Port, ...]
    inputs: tuple[Port, ...]
    outputs: tuple[Port, ...]
    a: Array
    b: Array
    c: Array
    d: Array
    dead_time: float
    point: OperatingPoint
    mirrored: bool = False

    def channel(self, input_name: str, output_name: str) -> tuple[Array, Array, Array, float]:
        """A, b, c and d from one input to one output; the command of a pair acts on both muscles.

        Raises:
            KeyError: an unknown name.
        """
        inputs = [port.name for port in self.inputs]
        outputs = [port.name for port in self.outputs]
        if input_name not in inputs or output_name not in outputs:
            raise KeyError(f"{input_name} to {output_name}")
        column, row = inputs.index(input_name), outputs.index(output_name)
        b, d = self.b[:, column], float(self.d[row, column])
        if self.mirrored and input_name == COMMAND.name:
            other = inputs.index(COUNTER_COMMAND.name)
            b, d = b - self.b[:, other], d - float(self.d[row, other])
        return self.a, b, self.c[row], d

    @property
    def scales(self) -> tuple[Array, Array, Array]:
        """Magnitudes of states, inputs and outputs."""
        bound = self.point.bound
        by_name = dict(zip((bound.names[i] for i in bound.independent), bound.scales, strict=True))
        return (
            np.array([by_name[state.name] for state in self.states]),
            np.array([INPUT_SCALES[port.name] for port in self.inputs]),
            np.array([_OUTPUT_SCALES[port.unit] for port in self.outputs]),
        )


def matrices(
    point: OperatingPoint, *, side: int, motion: int | None, offset: float = 0.0
) -> tuple[Array, Array, Array, Array]:
    """Derivatives by the independent states and the inputs, for a command moved a trifle to one side.

    Args:
        point: the operating point.
        side: 1 or -1, to which the command is moved; 0 it is not, and the result is the mean of both sides.
        motion: of the load against dry friction, see `mckibben.simulation.linear.bound.BoundDrive.values`.
        offset: of the command from that of the point [-], with which valve and sensors settle.
    """
    if side == 0:
        both = [_beside(point, sign, 0, motion=motion, offset=offset) for sign in (1, -1)]
        a, b, c, d = (0.5 * (one + other) for one, other in zip(*both, strict=True))
        return a, b, c, d
    return _beside(point, side, side, motion=motion, offset=offset)


def _beside(
    point: OperatingPoint, flow: int, side: int, *, motion: int | None, offset: float
) -> tuple[Array, Array, Array, Array]:
    """The derivatives while air just flows in (flow 1) or out (-1).

    Exactly at equal pressures the branches of the flow's energy have no derivative, and exactly at rest
    friction with memory has none by the speed: those of a muscle at rest are the mean of both directions.
    """
    bound = point.bound
    state, command = point.state.copy(), point.command + offset + side * ASIDE
    if offset or side:
        settle(bound.compiled, state, bound.parameters, bound.inputs(command))
    for name, steps in (("tube_pressure", 1.0), ("regulator_pressure", 2.0)):
        for place, sense in zip(bound.places(name), (1.0, -1.0), strict=False):
            state[place] *= 1.0 + sense * flow * steps * _PRESSURE_ASIDE
    keep, expansion = bound.independent, bound.expansion
    found: list[tuple[Array, Array, Array, Array]] = []
    speed = bound.names.index("speed")
    for creep in (_CREEP, -_CREEP) if bound.reached and not motion else (state[speed],):
        state[speed] = creep
        values = bound.values(state, command, point.switches, direction=motion)
        found.append(((values.a @ expansion)[keep], values.b[keep], values.c @ expansion, values.d))
    a, b, c, d = (np.mean(each, axis=0) for each in zip(*found, strict=True))
    return a, b, c, d


def model_of(
    point: OperatingPoint,
    *,
    name: str,
    text: str,
    side: int,
    dead_time: float,
    offset: float = 0.0,
) -> LinearModel:
    """The model at a point, without the states that never change there."""
    bound = point.bound
    a, b, c, d = matrices(point, side=side, motion=point.motion, offset=offset)
    names = [bound.names[index] for index in bound.independent]
    fixed = {"stroke", "speed"} if point.on_stop or point.motion is None else set()
    if point.direction:
        fixed |= {bound.names[index] for index in bound.reached}
    still = (np.abs(a).sum(axis=1) == 0.0) & (np.abs(b).sum(axis=1) == 0.0)
    keep = [i for i, state in enumerate(names) if state not in fixed and not still[i]]
    return LinearModel(
        name=name,
        text=text,
        states=tuple(_port_of(bound, names[i]) for i in keep),
        inputs=bound.equations.inputs,
        outputs=bound.equations.outputs,
        a=a[np.ix_(keep, keep)],
        b=b[keep],
        c=c[:, keep],
        d=d,
        dead_time=dead_time,
        point=point,
        mirrored=bound.drive.pair,
    )


def mean_of(first: LinearModel, second: LinearModel, *, share: float, name: str, text: str) -> LinearModel:
    """Weighted mean of the matrices of two models with the same states; ``share`` is that of the first."""
    if first.states != second.states:
        raise ValueError("the models have different states")
    return LinearModel(
        name=name,
        text=text,
        states=first.states,
        inputs=first.inputs,
        outputs=first.outputs,
        a=share * first.a + (1.0 - share) * second.a,
        b=share * first.b + (1.0 - share) * second.b,
        c=share * first.c + (1.0 - share) * second.c,
        d=share * first.d + (1.0 - share) * second.d,
        dead_time=max(first.dead_time, second.dead_time),
        point=first.point,
        mirrored=first.mirrored,
    )


def _port_of(bound: BoundDrive, name: str) -> Port:
    plain = name.removesuffix(COUNTER)
    suffix = ", of the second muscle of a pair" if name != plain else ""
    if plain in _STATES:
        unit, text = _STATES[plain]
        return Port(name, unit, text + suffix)
    effect_id, variable_name = plain.split(".")
    effect = next(effect for effect in bound.drive.model.effects if effect.id == effect_id)
    variable = next(each for each in effect.states if each.name == variable_name)
    return Port(name, variable.unit, variable.description.rstrip(".") + suffix)


def name_of_state(state: Port) -> str:
    """What a state of a model is called beside inputs and outputs, whose pressures are gauge."""
    return f"absolute_{state.name}" if state.name.removesuffix(COUNTER) in _ABSOLUTE else state.name
