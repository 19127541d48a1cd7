"""The muscle, states and evaluations that the contract of effects is checked with.

The muscle is a DMSP-20 of 300 mm (braid 21.8 mm at 26.5 degrees), the working range 3 % stretch to 25 %
contraction at 0 to 8 bar.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import lru_cache

import numpy as np
import symengine as se

from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.effect import Effect
from mckibben.physics.model import ROOM_TEMPERATURE, Model, State
from mckibben.physics.muscle import GEOMETRY, Muscle
from mckibben.simulation.statics.model import StaticModel

MUSCLE = Muscle(0.3, 0.0218, math.radians(26.5), 0.0018, 0.020)
LENGTHS = MUSCLE.nominal_length * (1.0 - np.linspace(-0.03, 0.25, 15))
PRESSURES = np.array([0.0, 0.2e5, 0.5e5, 1e5, 2e5, 4e5, 6e5, 8e5])
SPEED = 0.002  # m/s, where a motion is needed
WARM = 333.15  # K, so that a temperature effect shows
FORCE_SCALE = 1500.0  # N, the muscle's catalogue force
INPUTS = ("length", "pressure", "velocity", "direction", "temperature")

MUSCLE_SLOTS = frozenset(  # what `Model.evaluate` asks for
    """pressure braid shape force_factor elastomer elastomer_factor tension friction compliance
    pressure_sensor length_sensor force_sensor""".split()  # noqa: SIM905
)

Values = dict[str, dict[str, float]]


def an_elastomer() -> Effect:
    """The first effect that is one."""
    return next(effect for effect in default_catalogue().values() if "elastomer" in effect.slots)


def companions(effect: Effect) -> tuple[Effect, ...]:
    """What has to be there for the effect to act on: an elastomer, when it only multiplies one."""
    only_factor = set(effect.slots) - {"rates"} == {"elastomer_factor"}
    return (an_elastomer(),) if only_factor else ()


def predict_force(effects: Sequence[Effect], values: Values, **state: object) -> np.ndarray:
    """Force as measured, unclipped; with a series compliance by the static solver, which finds the length."""
    if any("compliance" in effect.slots for effect in effects):
        model = StaticModel(MUSCLE, values, catalogue={effect.id: effect for effect in effects})
        arrays = np.broadcast_arrays(*(np.asarray(state.get(name, 0.0)) for name in INPUTS[:4]))
        flat = dict(zip(INPUTS, (array.ravel() for array in arrays), strict=False))
        temperature = state.get("temperature", ROOM_TEMPERATURE)
        return model.force(clipped=False, temperature=temperature, **flat).reshape(arrays[0].shape)
    return np.asarray(Model(effects).evaluate(muscle=MUSCLE, values=values, **state).force)


def acts_on_muscle(effect: Effect) -> bool:
    """Whether any of its slots is one of the muscle, and not of the drive around it."""
    return bool(MUSCLE_SLOTS & set(effect.slots))


def state_symbols(effects: Iterable[Effect]) -> list[str]:
    """Names of all states, as effect.state."""
    return [f"{effect.id}.{state.name}" for effect in effects for state in effect.states]


def defaults(effects: Iterable[Effect]) -> Values:
    """Effect id -> its defaults."""
    return {effect.id: effect.defaults for effect in effects}


def contribution(effect: Effect, **state: object) -> np.ndarray:
    """Force as measured with the effect at its defaults, minus without it."""
    others = companions(effect)
    state = {"temperature": WARM, **state}
    with_it = predict_force((*others, effect), defaults((*others, effect)), **state)
    return with_it - predict_force(others, defaults(others), **state)


def grid(*, lengths: np.ndarray = LENGTHS, pressures: np.ndarray = PRESSURES, sign: float) -> dict:
    """A state over lengths and pressures; the sign is that of the motion."""
    length, pressure = np.meshgrid(lengths, pressures)
    return {"length": length, "pressure": pressure, "velocity": sign * SPEED, "direction": sign}


def symbolic(effects: Sequence[Effect]) -> tuple[list[se.Symbol], State]:
    """The model on symbols: the symbols (inputs, geometry, parameters, states in this order), its output."""
    inputs = {name: se.Symbol(name) for name in INPUTS}
    geometry = {name: se.Symbol(name) for name in GEOMETRY}
    values = {e.id: {p.name: se.Symbol(f"{e.id}.{p.name}") for p in e.parameters} for e in effects}
    parameters = [symbol for effect in effects for symbol in values[effect.id].values()]
    states = {name: se.Symbol(name) for name in state_symbols(effects)}
    for effect in effects:
        values[effect.id] |= {state.name: states[f"{effect.id}.{state.name}"] for state in effect.states}
    output = Model(effects).evaluate(muscle=Muscle(**geometry), values=values, **inputs)
    return [*inputs.values(), *geometry.values(), *parameters, *states.values()], output


@lru_cache(4)  # checks of one effect follow each other
def compiled(effects: tuple[Effect, ...]) -> tuple[list[str], Callable[[np.ndarray], np.ndarray]]:
    """Names of the arguments; a function of them giving all outputs, then d force by d each argument."""
    symbols, state = symbolic(effects)
    force = se.sympify(state.force)
    outputs = [se.sympify(output) for output in state] + [force.diff(symbol) for symbol in symbols]
    return [symbol.name for symbol in symbols], se.Lambdify(symbols, outputs, backend="llvm", cse=True)


def numeric(effects: Sequence[Effect], point: Mapping[str, float]) -> State:
    """The output of the model at a point, in numbers."""
    values = {e.id: {p.name: point[f"{e.id}.{p.name}"] for p in (*e.parameters, *e.states)} for e in effects}
    muscle = Muscle(**{name: point[name] for name in GEOMETRY})
    return Model(effects).evaluate(muscle=muscle, values=values, **{name: point[name] for name in INPUTS})


def random_points(effects: Sequence[Effect], count: int) -> list[dict[str, float]]:
    """Points of the working range, always the same: all arguments of `compiled`."""
    random = np.random.default_rng(20)
    points = []
    for _ in range(count):
        sign = float(random.choice([-1.0, 1.0]))
        point = {
            "length": MUSCLE.nominal_length * (1.0 - random.uniform(-0.03, 0.25)),
            "pressure": random.uniform(0.1e5, 8e5),
            "velocity": sign * random.uniform(0.01, 0.3),
            "direction": sign,
            "temperature": random.uniform(273.15, 343.15),
            **MUSCLE._asdict(),
        }
        for effect in effects:
            for p in effect.parameters:
                point[f"{effect.id}.{p.name}"] = random.uniform(p.lower, p.upper)
            for state in effect.states:
                point[f"{effect.id}.{state.name}"] = random.uniform(-state.scale, state.scale)
        points.append(point)
    return points


_PHASE = np.linspace(0.0, 2.0 * math.pi, 40001)[:-1]
PHASE_STEP = 2.0 * math.pi / len(_PHASE)


def closed_path() -> tuple[dict, np.ndarray, np.ndarray]:
    """A closed path through the working range, 0.05 to 6 bar: the state, dL/ds and dP/ds."""
    length = MUSCLE.nominal_length * (0.89 + 0.13 * np.sin(_PHASE))
    length_rate = MUSCLE.nominal_length * 0.13 * np.cos(_PHASE)
    pressure = 3.025e5 + 2.975e5 * np.cos(_PHASE + 0.7)
    sign = np.sign(length_rate)
    state = {"length": length, "pressure": pressure, "velocity": sign * SPEED, "direction": sign}
    return state | {"temperature": WARM}, length_rate, -2.975e5 * np.sin(_PHASE + 0.7)
