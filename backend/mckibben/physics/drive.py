r"""A drive as one symbolic model: supply, valve, tube, muscle, load and any choice of effects.

.. math::
   \dot p\,(V + n p\,\partial_p V) &= n R T\,\dot m - n p\,\partial_s V\,\dot s \\
   M \ddot s &= r^2 F - r\,(m g\sin\psi + F_{ext} + F_{guide}) - k s - F_{stop}

with the stroke s of the muscle (positive = shorter), the lever ratio r (muscle stroke per load stroke) and
the volume V and tension F of `mckibben.physics.model`. The tension is never negative: a slack muscle lets
the load fly; its volume is then still taken at the distance of its ends. With a heat flow the chamber obeys
the energy balance with exponent 1.4 and T = pV/(mR) instead.

Everything is written on symengine symbols, because the volume's derivatives are taken here.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import symengine as se

from mckibben.physics import gas, ops
from mckibben.physics.drive_terms import CONSTANTS, INPUTS, OUTPUTS, StateInfo, Structure
from mckibben.physics.flow_path import flow_path
from mckibben.physics.model import Model
from mckibben.physics.muscle import GEOMETRY, Muscle
from mckibben.physics.ops import Value

# Speed at which a friction's sign is 0.7 of full [m/s]; below, the muscle creeps instead of sticking.
SIGN_SPEED = 1e-3
# Depth over which the damper of a stop comes in [m], so that an impact is no jump.
_STOP_ONSET = 1e-6


class DriveModel:
    """The equations of a structure on symbols.

    Attributes:
        states: in their order; ``initial`` None where a run has to say it.
        symbols: state name -> symbol.
        parameters: constants of a run: `CONSTANTS`, geometry, "effect.parameter"; name -> symbol.
        inputs: name -> symbol of `INPUTS`.
        rates: d/dt of the states.
        outputs: expressions of ``output_names``, here `OUTPUTS`.
    """

    output_names = OUTPUTS

    def __init__(self, structure: Structure) -> None:
        model = Model(structure.effects)
        self.states = _states(structure, model)
        self.symbols = {state.name: se.Symbol(f"y_{state.name}") for state in self.states}
        constants = {name: se.Symbol(name) for name in CONSTANTS}
        geometry = {name: se.Symbol(name) for name in GEOMETRY}
        effects = {
            f"{effect.id}.{p.name}": se.Symbol(f"{effect.id}.{p.name}")
            for effect in model.effects
            for p in effect.parameters
        }
        self.parameters = {**constants, **geometry, **effects}
        self.inputs = {name: se.Symbol(f"u_{name}") for name in INPUTS}
        values = {
            effect.id: {p.name: effects[f"{effect.id}.{p.name}"] for p in effect.parameters}
            | {state.name: self.symbols[f"{effect.id}.{state.name}"] for state in effect.states}
            for effect in model.effects
        }
        rates, outputs = _equations(
            structure, model, Muscle(**geometry), values, constants, self.symbols, self.inputs
        )
        self.rates = [se.sympify(rates[state.name]) for state in self.states]
        self.outputs = [se.sympify(outputs[name]) for name in OUTPUTS]


def _states(structure: Structure, model: Model) -> list[StateInfo]:
    states = [
        StateInfo("stroke", None, 0.1),
        StateInfo("speed", 0.0, 1.0),
        StateInfo("pressure", None, 1e5),
        StateInfo("supplied", 0.0, 1e-3),
        StateInfo("vented", 0.0, 1e-3),
        StateInfo("clock", 0.0, 1.0),
    ]
    if structure.tube:
        states.append(StateInfo("tube_pressure", None, 1e5))
    if structure.regulator:
        states.append(StateInfo("regulator_pressure", None, 1e5))
    if _heated(model):
        states.append(StateInfo("gas_mass", None, 1e-3))
    for effect in model.effects:
        states += [StateInfo(f"{effect.id}.{s.name}", s.initial, s.scale, s.settled) for s in effect.states]
    return states


def _heated(model: Model) -> bool:
    return any("heat" in effect.slots for effect in model.effects)


def _equations(
    structure: Structure,
    model: Model,
    muscle: Muscle,
    values: Mapping[str, Mapping[str, Value]],
    c: Mapping[str, Value],
    y: Mapping[str, Value],
    u: Mapping[str, Value],
) -> tuple[dict[str, Value], dict[str, Value]]:
    rates: dict[str, Value] = {"clock": 1.0}
    stroke, speed, pressure = y["stroke"], y["speed"], y["pressure"]
    passed = y["clock"] - u["begin"]
    command = u["opening"] + u["opening_slope"] * passed
    external = u["external_force"] + u["external_force_slope"] * passed

    gauge = pressure - c["ambient_pressure"]
    sign = -speed / ops.sqrt(speed**2 + SIGN_SPEED**2)
    moving: dict[str, Any] = {
        "muscle": muscle,
        "length": muscle.nominal_length - stroke,
        "pressure": gauge,
        "velocity": -speed,
        "direction": sign,
        "temperature": c["ambient_temperature"],
    }
    state = model.at(**{**moving, "values": values})
    yielding = 1.0 - state.compliance * state.tension.diff(stroke)
    force = ops.positive_part(state.tension / yielding)

    # Gas.
    volume = state.volume + c["fitting_volume"] + model.sum("extra_volume", values, {})
    heated = _heated(model)
    temperature = (
        pressure * volume / (y["gas_mass"] * gas.GAS_CONSTANT) if heated else c["ambient_temperature"]
    )
    flows = flow_path(
        tube=structure.tube,
        regulator=structure.regulator,
        model=model,
        values=values,
        c=c,
        y=y,
        command=command,
        temperature=temperature,
    )
    leak = model.sum(
        "leakage",
        values,
        {
            "absolute_pressure": pressure,
            "ambient_pressure": c["ambient_pressure"],
            "gas_temperature": temperature,
        },
    )
    inflow = flows["into_muscle"] - leak
    exponent = gas.HEAT_CAPACITY_RATIO if heated else c["polytropic_exponent"]
    if heated:
        heat = model.sum(
            "heat",
            values,
            {
                **moving,
                "diameter": state.diameter,
                "gas_temperature": temperature,
                "ambient_temperature": c["ambient_temperature"],
            },
        )
        entering = ops.positive_part(flows["into_muscle"]) * c["ambient_temperature"]
        leaving = (ops.positive_part(-flows["into_muscle"]) + leak) * temperature
        supply = (exponent - 1.0) * (heat + gas.HEAT_CAPACITY_P * (entering - leaving))
        rates["gas_mass"] = inflow
    else:
        supply = exponent * gas.GAS_CONSTANT * temperature * inflow
    work = exponent * pressure * volume.diff(stroke) * speed
    pressure_rate = (supply - work) / (volume + exponent * pressure * volume.diff(pressure))
    rates |= {
        "pressure": pressure_rate,
        "supplied": flows["supply"],
        "vented": flows["exhaust"] + leak,
        **flows["rates"],
    }

    # Load. The guide's friction opposes the stroke, whose sign is the opposite of the muscle's velocity.
    factor = model.product("load_factor", values, {})
    inertia = factor * c["mass"] + c["own_mass"] + model.sum("inertia", values, {"muscle": muscle})
    guide = model.sum("guide", values, {"stroke": stroke, "speed": speed, "direction": -sign})
    lever = c["lever_ratio"]
    resisting = factor * (c["mass"] * c["gravity"] + external) + guide
    stop, depth = end_stops(constants=c, stroke=stroke, speed=speed)
    acceleration = (lever**2 * force - lever * resisting - c["spring"] * stroke - stop) / inertia
    rates |= {"stroke": speed, "speed": acceleration}

    sensors = {
        name: model.reading(f"{name}_sensor", muscle=muscle, values=values)
        for name in ("pressure", "force", "length")
    }
    readings = {
        "pressure_reading": sensors["pressure"].scale * gauge + sensors["pressure"].offset,
        "force_reading": sensors["force"].scale * force + sensors["force"].offset,
        # A length that reads too long is a stroke that reads too short.
        "stroke_reading": sensors["length"].scale * stroke - sensors["length"].offset,
    }
    seen = {**moving, "area": state.area, "pressure_rate": pressure_rate}
    drive = {
        "supply_flow": flows["supply"],
        "mass_flow": inflow,
        "supply_pressure": c["supply_pressure"],
        "pressure": gauge,
        "force": force,
        "stroke": stroke,
        "speed": speed,
        "gas_temperature": temperature,
        **{f"instant_{name}": reading for name, reading in readings.items()},
    }
    _effect_rates(model, values, seen, drive, flows["openings"], rates)
    outputs = {
        "acceleration": acceleration,
        "force": force,
        "mass_flow": inflow,
        "supply_flow": flows["supply"],
        "exhaust_flow": flows["exhaust"],
        "opening": flows["opening"],
        "fill_pressure_ratio": flows["fill_pressure_ratio"],
        "exhaust_pressure_ratio": flows["exhaust_pressure_ratio"],
        "gas_temperature": temperature,
        "volume": volume,
        "diameter": state.diameter,
        "penetration": depth,
        "external_force": external,
        **{
            name: model.chain(name, reading, values, {}, name="reading") for name, reading in readings.items()
        },
    }
    return rates, outputs


def end_stops(*, constants: Mapping[str, Value], stroke: Value, speed: Value) -> tuple[Value, Value]:
    """Force of the end stops on the stroke [N], and how deep either is pressed in [m]; they never pull."""
    above = ops.positive_part(stroke - constants["stop_high"])
    below = ops.positive_part(constants["stop_low"] - stroke)
    high = ops.positive_part(
        constants["stop_stiffness"] * above
        + constants["stop_damping"] * speed * ops.minimum(above / _STOP_ONSET, 1.0)
    )
    low = ops.positive_part(
        constants["stop_stiffness"] * below
        - constants["stop_damping"] * speed * ops.minimum(below / _STOP_ONSET, 1.0)
    )
    return high - low, above + below


def _effect_rates(
    model: Model,
    values: Mapping[str, Mapping[str, Value]],
    seen: Mapping[str, Value],
    drive: Mapping[str, Value],
    openings: Mapping[str, Value],
    rates: dict[str, Value],
) -> None:
    for effect in model.effects:
        if not effect.states:
            continue
        if "rates" in effect.slots:
            given = effect.call("rates", seen, values[effect.id])
        else:
            here = {**drive, "opening": openings.get(effect.id, 0.0)}
            given = effect.call("drive_rates", here, values[effect.id])
        for state, rate in zip(effect.states, given, strict=True):
            rates[f"{effect.id}.{state.name}"] = rate
