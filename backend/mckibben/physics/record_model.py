"""A muscle driven by measured pressure: with measured length it predicts force, otherwise motion.

Effects and composition are those of `mckibben.physics.drive`, without valve, tube and gas balance. Measured
channels are linear between samples. Effects of sensors and lags on the readings are included.

The direction of the dry friction is that of `mckibben.physics.drive` where the load moves. Where the length
is measured it is an input, because a record knows only with its noise which way it goes.
"""

from __future__ import annotations

from typing import Any

import symengine as se

from mckibben.physics import ops
from mckibben.physics.drive import DryFriction, motion_switches
from mckibben.physics.drive_terms import StateInfo, Switch
from mckibben.physics.effect import Effect
from mckibben.physics.model import Model
from mckibben.physics.muscle import GEOMETRY, Muscle

FORCE_INPUTS = ("pressure", "pressure_slope", "length", "length_slope", "direction", "begin")
MOTION_INPUTS = ("pressure", "pressure_slope", "external_force", "external_force_slope", "begin")
MOTION_CONSTANTS = (
    "mass",
    "own_mass",
    "gravity",
    "spring",
    "lever_ratio",
    "stop_low",
    "stop_high",
)


class RecordModel:
    """Equations on symbols of a muscle whose pressure is measured.

    Args:
        effects: the effects; those of the air path do not act here.
        motion: False: the length is measured too and the force predicted; True: the load moves.

    Attributes are those of `mckibben.physics.drive.DriveModel`, with ``output_names``.
    """

    def __init__(self, effects: tuple[Effect, ...], *, motion: bool = False) -> None:
        model = Model(effects)
        own = [
            StateInfo(f"{effect.id}.{state.name}", state.initial, state.scale, state.settled)
            for effect in model.effects
            if "rates" in effect.slots or _reads(effect) or (motion and "guide" in effect.slots)
            for state in effect.states
        ]
        moving = [StateInfo("stroke", None, 0.1), StateInfo("speed", 0.0, 1.0)] if motion else []
        self.states = [StateInfo("clock", 0.0, 1.0), *moving, *own]
        self.symbols = {state.name: se.Symbol(f"y_{state.name}") for state in self.states}
        constants = {name: se.Symbol(name) for name in (*(MOTION_CONSTANTS if motion else ()), "temperature")}
        geometry = {name: se.Symbol(name) for name in GEOMETRY}
        named = {
            f"{effect.id}.{p.name}": se.Symbol(f"{effect.id}.{p.name}")
            for effect in model.effects
            for p in effect.parameters
        }
        self.parameters = {**constants, **geometry, **named}
        names = MOTION_INPUTS if motion else FORCE_INPUTS
        self.inputs = {name: se.Symbol(f"u_{name}") for name in names}
        values = {
            effect.id: {p.name: named[f"{effect.id}.{p.name}"] for p in effect.parameters}
            | {
                state.name: self.symbols[f"{effect.id}.{state.name}"]
                for state in effect.states
                if f"{effect.id}.{state.name}" in self.symbols
            }
            for effect in model.effects
        }
        rates, outputs, self.switches = _equations(
            model, Muscle(**geometry), values, constants, self.symbols, self.inputs, motion=motion
        )
        self.output_names = tuple(outputs)
        self.rates = [se.sympify(rates[state.name]) for state in self.states]
        self.outputs = [se.sympify(output) for output in outputs.values()]


def _reads(effect: Effect) -> bool:
    return any(slot.endswith("_reading") for slot in effect.slots)


def _equations(
    model: Model, muscle: Muscle, values: Any, c: Any, y: Any, u: Any, *, motion: bool
) -> tuple[dict[str, Any], dict[str, Any], list[Switch]]:
    sensors = {
        name: model.reading(f"{name}_sensor", muscle=muscle, values=values, temperature=c["temperature"])
        for name in ("pressure", "length", "force")
    }
    passed = y["clock"] - u["begin"]
    scale, offset = sensors["pressure"]
    pressure = (u["pressure"] + u["pressure_slope"] * passed - offset) / scale
    pressure_rate = u["pressure_slope"] / scale
    scale, offset = sensors["length"]
    if motion:
        length, velocity = muscle.nominal_length - y["stroke"], -y["speed"]
    else:
        length = (u["length"] + u["length_slope"] * passed - offset) / scale
        velocity = u["length_slope"] / scale
    along = se.Symbol("direction")  # of the stroke, which grows where the length falls
    direction = -along if motion else u["direction"]
    seen: dict[str, Any] = {
        "muscle": muscle,
        "length": length,
        "pressure": pressure,
        "velocity": velocity,
        "direction": direction,
        "temperature": c["temperature"],
    }
    state = model.at(**seen, values=values)
    pulled = state.tension
    if model.has("compliance"):
        # One Newton step from the rigid rig, as in the drive.
        free = se.Symbol("free_length")
        by_length = model.at(**{**seen, "length": free, "values": values}).tension.diff(free)
        pulled = pulled / (1.0 + state.compliance * by_length.subs({free: length}))
    force = ops.positive_part(pulled)
    rates: dict[str, Any] = {"clock": 1.0}
    stroke, speed = muscle.nominal_length - length, -velocity
    switches: list[Switch] = []
    dry: DryFriction | None = None
    if motion:
        factor = model.product("load_factor", values, {})
        inertia = factor * c["mass"] + c["own_mass"] + model.sum("inertia", values, {"muscle": muscle})
        external = u["external_force"] + u["external_force_slope"] * passed
        lever = c["lever_ratio"]
        hung = model.sum("hung_mass", values, {}) * c["gravity"]
        load = factor * (c["mass"] * c["gravity"] + external) + hung
        guided = {"stroke": stroke, "speed": speed, "direction": along, "load": ops.absolute(load)}
        resisting = load + model.sum("guide", values, guided)
        net = lever**2 * force - lever * resisting - c["spring"] * stroke
        switches, dry = motion_switches(
            constants=c, stroke=stroke, speed=speed, net_force=net, direction=along
        )
        rates["stroke"] = speed
        rates["speed"] = dry.moves * dry.net_force / inertia
    reading = {
        "pressure_reading": pressure * sensors["pressure"].scale + sensors["pressure"].offset,
        "force_reading": sensors["force"].scale * force + sensors["force"].offset,
        "stroke_reading": sensors["length"].scale * stroke - sensors["length"].offset,
    }
    for effect in model.effects:
        if not effect.states or f"{effect.id}.{effect.states[0].name}" not in y:
            continue
        if "rates" in effect.slots:
            given = effect.call(
                "rates", {**seen, "area": state.area, "pressure_rate": pressure_rate}, values[effect.id]
            )
        else:
            here = {"pressure": pressure, "force": force, "stroke": stroke, "speed": speed}
            here |= {f"instant_{name}": value for name, value in reading.items()}
            given = effect.call("drive_rates", here, values[effect.id])
        for own, rate in zip(effect.states, given, strict=True):
            rates[f"{effect.id}.{own.name}"] = rate
    outputs = {
        "force": force,
        **{name: model.chain(name, value, values, {}, name="reading") for name, value in reading.items()},
    }
    if dry is not None:
        rates, outputs = dry.resolved(rates), dry.resolved(outputs)
    return rates, outputs, switches
