"""One muscle of a drive with its air path: tension, gas balance, rates of its states."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from mckibben.physics import gas, ops
from mckibben.physics.drive_terms import DriveStructure
from mckibben.physics.flow_path import flow_path
from mckibben.physics.model import Model, State
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value


class Motion(NamedTuple):
    """How a muscle moves with the coordinate of the drive.

    Attributes:
        stroke: rest length less the distance of the fittings [m].
        rate: d stroke/dt [m/s].
        direction: that of the dry friction along the stroke: +1 or -1 sliding, between them at rest.
        shown: stroke that a sensor counts [m].
    """

    stroke: Value
    rate: Value
    direction: Value
    shown: Value


class Side(NamedTuple):
    """Results for one muscle.

    Attributes:
        force: tension [N], never negative; 0 when slack.
        resting_tension: tension without friction of the moment, unclipped [N].
        distance: of the fittings [m].
        volume: with dead volumes [m^3].
    """

    force: Value
    resting_tension: Value
    distance: Value
    volume: Value
    temperature: Value
    gauge: Value
    inflow: Value
    stroke: Value
    flows: dict[str, Any]
    state: State
    rates: dict[str, Value]
    readings: dict[str, Value]


def with_energy_balance(*, structure: DriveStructure, model: Model) -> bool:
    """Whether the chamber obeys the energy balance, with its gas mass as a state.

    That is so unless the drive states a polytropic exponent and no effect exchanges heat.
    """
    return not structure.polytropic or model.has("heat")


def muscle_side(
    *,
    structure: DriveStructure,
    slack: Value,
    model: Model,
    muscle: Muscle,
    values: Mapping[str, Mapping[str, Value]],
    constants: Mapping[str, Value],
    states: Mapping[str, Value],
    motion: Motion,
    command: Value,
) -> Side:
    """The equations of one muscle.

    Args:
        structure: tube, regulator and closure of the gas.
        slack: the switch that is 1 while the muscle hangs slack.
        model, values: effects, their parameters and states.
        muscle: geometry.
        constants: constants of the drive, by name.
        states: states of this muscle, by name; absolute pressures.
        motion: its stroke from the drive's coordinate.
        command: opening of its valve, or set point of its regulator.
    """
    pressure, ambient = states["pressure"], constants["ambient_temperature"]
    gauge = pressure - constants["ambient_pressure"]
    stroke = motion.stroke
    distance, length = muscle.nominal_length - stroke, states["length"]
    still: dict[str, Any] = {
        "muscle": muscle,
        "length": length,
        "pressure": gauge,
        "velocity": 0.0,
        "direction": 0.0,
        "temperature": ambient,
    }
    resting = model.at(**still, values=values).tension
    velocity = -motion.rate - slack * resting / constants["slack_damping"]
    moving = {**still, "velocity": velocity, "direction": -motion.direction}
    state = model.at(**moving, values=values)
    # Series compliance: one Newton step from the rigid rig.
    yielding = 1.0 + state.compliance * state.tension.diff(length)
    force = (1.0 - slack) * ops.positive_part(state.tension / yielding)
    volume = (
        state.volume + constants["fitting_volume"] + model.sum("extra_volume", values, {"muscle": muscle})
    )
    balanced = with_energy_balance(structure=structure, model=model)
    temperature = pressure * volume / (states["gas_mass"] * gas.GAS_CONSTANT) if balanced else ambient
    flows = flow_path(
        tube=structure.tube,
        regulator=structure.regulator,
        second_order=structure.second_order,
        flow_control=structure.flow_control,
        quick_exhaust=structure.quick_exhaust,
        tube_exponent=constants["polytropic_exponent"] if structure.polytropic else 1.0,
        model=model,
        values=values,
        c=constants,
        y=states,
        command=command,
        temperature=temperature,
    )
    around = {
        "absolute_pressure": pressure,
        "ambient_pressure": constants["ambient_pressure"],
        "gas_temperature": temperature,
    }
    leak = model.sum("leakage", values, around)
    inflow = flows["into_muscle"] - leak
    if balanced:
        exponent: Value = gas.HEAT_CAPACITY_RATIO
        warmed = {**moving, "diameter": state.diameter, "ambient_temperature": ambient}
        if model.has("heat"):
            heat = model.sum("heat", values, {**warmed, "gas_temperature": temperature})
        else:
            heat = gas.wall_heat_flow(
                coefficient=constants["wall_heat_transfer"],
                diameter=state.diameter,
                length=length,
                gas_temperature=temperature,
                wall_temperature=ambient,
            )
        entering = ops.positive_part(flows["into_muscle"]) * ambient
        leaving = (ops.positive_part(-flows["into_muscle"]) + leak) * temperature
        supply = (exponent - 1.0) * (heat + gas.HEAT_CAPACITY_P * (entering - leaving))
    else:
        exponent = constants["polytropic_exponent"]
        supply = exponent * gas.GAS_CONSTANT * temperature * inflow
    work = exponent * pressure * volume.diff(length) * velocity
    pressure_rate = (supply - work) / (volume + exponent * pressure * volume.diff(pressure))
    rates = {
        "length": velocity,
        "pressure": pressure_rate,
        "supplied": flows["supply"],
        "vented": flows["exhaust"] + leak,
        **flows["rates"],
        **({"gas_mass": inflow} if balanced else {}),
    }
    instant = _readings(
        model, muscle, values, gauge=gauge, force=force, stroke=motion.shown, temperature=ambient
    )
    drive = {
        "supply_flow": flows["supply"],
        "mass_flow": inflow,
        "exhaust_flow": flows["through_exhaust"],
        "exhaust_conductance": constants["exhaust_conductance"],
        "supply_pressure": constants["supply_pressure"],
        "ambient_pressure": constants["ambient_pressure"],
        "pressure": gauge,
        "force": force,
        "stroke": stroke,
        "speed": motion.rate,
        "gas_temperature": temperature,
        **{f"instant_{name}": reading for name, reading in instant.items()},
    }
    seen = {**moving, "area": state.area, "pressure_rate": pressure_rate}
    for effect in model.effects:
        if not effect.states:
            continue
        if "rates" in effect.slots:
            # The gas here is that of the muscle: no sensor is before or behind it.
            still = {"pressure_rate": 0.0} if effect.between_sensor_and_muscle else {}
            given = effect.call("rates", seen | still, values[effect.id])
        else:
            here = {**drive, "opening": flows["openings"].get(effect.id, 0.0)}
            given = effect.call("drive_rates", here, values[effect.id])
        for own, rate in zip(effect.states, given, strict=True):
            rates[f"{effect.id}.{own.name}"] = rate
    readings = {name: model.chain(name, value, values, {}, name="reading") for name, value in instant.items()}
    return Side(
        force=force,
        resting_tension=resting,
        distance=distance,
        volume=volume,
        temperature=temperature,
        gauge=gauge,
        inflow=inflow,
        stroke=stroke,
        flows=flows,
        state=state,
        rates=rates,
        readings=readings,
    )


def _readings(
    model: Model,
    muscle: Muscle,
    values: Mapping[str, Mapping[str, Value]],
    *,
    gauge: Value,
    force: Value,
    stroke: Value,
    temperature: Value,
) -> dict[str, Value]:
    """Sensor readings of a muscle, before any lag of the sensors."""
    sensor = {
        name: model.reading(f"{name}_sensor", muscle=muscle, values=values, temperature=temperature)
        for name in ("pressure", "force", "length")
    }
    return {
        "pressure_reading": sensor["pressure"].scale * gauge + sensor["pressure"].offset,
        "force_reading": sensor["force"].scale * force + sensor["force"].offset,
        # A length that reads too long makes the stroke read too short.
        "stroke_reading": sensor["length"].scale * stroke - sensor["length"].offset,
    }
