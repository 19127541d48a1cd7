"""The air path: supply, valve or regulator, tube, muscle, with the effects that act on it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mckibben.physics import gas, ops
from mckibben.physics.model import Model
from mckibben.physics.ops import Value


def flow_path(
    *,
    tube: bool,
    regulator: bool,
    tube_exponent: Value,
    model: Model,
    values: Mapping[str, Mapping[str, Value]],
    c: Mapping[str, Value],
    y: Mapping[str, Value],
    command: Value,
    temperature: Value,
) -> dict[str, Any]:
    """Mass flows [kg/s] of the valve and into the muscle, and the rates of the pressures in between.

    Args:
        tube: whether the pressure in the tube is a state (``tube_pressure``).
        regulator: whether a pressure regulator feeds the muscle (state ``regulator_pressure``): its pressure
            follows the command with a first-order lag; the conductances are those of its fill and exhaust.
        tube_exponent: polytropic exponent of the air in the tube; 1 where its wall keeps it at ambient
            temperature.
        model, values: effects and their parameters.
        c: constants of the drive, by name.
        y: states of the drive, by name.
        command: commanded opening [-1, 1]; of a regulator its set point as a share of its range.
        temperature: temperature of the gas in the muscle [K].

    Returns:
        ``supply``, ``exhaust`` and ``into_muscle`` mass flow, ``opening`` after all effects, ``openings``
        (effect id -> opening before it), both pressure ratios, and ``rates`` by state.
    """
    openings: dict[str, Value] = {}
    opening = command
    for effect in model.effects:
        if "opening" in effect.slots:
            openings[effect.id] = opening
            opening = effect.call("opening", {"opening": opening}, values[effect.id])
    ambient = c["ambient_temperature"]
    node = y["tube_pressure"] if tube else y["pressure"]
    node_temperature = ambient if tube else temperature
    supply_pressure = model.chain("supply", c["supply_pressure"], values, {}, name="supply_pressure")
    fill_c = model.chain("fill_conductance", c["fill_conductance"], values, {}, name="conductance")
    exhaust_c = model.chain("exhaust_conductance", c["exhaust_conductance"], values, {}, name="conductance")
    rates: dict[str, Value] = {}
    if regulator:
        source = y["regulator_pressure"]
        wanted = ops.minimum(
            c["ambient_pressure"] + ops.positive_part(opening) * c["regulator_range"], supply_pressure
        )
        rates["regulator_pressure"] = (wanted - source) / c["regulator_time"]
        filling = ops.greater(source, node)
        fill_source, exhaust_sink = source, source
        fill_share, exhaust_share = ops.where(filling, 1.0, 0.0), ops.where(filling, 0.0, 1.0)
    else:
        fill_source, exhaust_sink = supply_pressure, c["ambient_pressure"]
        fill_share, exhaust_share = ops.positive_part(opening), ops.positive_part(-opening)
    fill = gas.mass_flow(
        pressure_from=fill_source,
        pressure_to=node,
        temperature_from=ambient,
        temperature_to=node_temperature,
        conductance=fill_c * fill_share,
        critical_ratio=c["fill_ratio"],
    )
    exhaust = gas.mass_flow(
        pressure_from=node,
        pressure_to=exhaust_sink,
        temperature_from=node_temperature,
        temperature_to=ambient,
        conductance=exhaust_c * exhaust_share,
        critical_ratio=c["exhaust_ratio"],
    )
    into = fill - exhaust
    if tube:
        through = gas.mass_flow(
            pressure_from=node,
            pressure_to=y["pressure"],
            temperature_from=ambient,
            temperature_to=temperature,
            conductance=model.chain(
                "tube_conductance", c["tube_conductance"], values, {}, name="conductance"
            ),
            critical_ratio=c["tube_ratio"],
        )
        rates["tube_pressure"] = gas.pressure_rate(
            pressure=node,
            volume=c["tube_volume"],
            volume_rate=0.0,
            mass_flow=into - through,
            temperature=ambient,
            polytropic_exponent=tube_exponent,
        )
        into = through
    return {
        "supply": fill,
        "exhaust": exhaust,
        "into_muscle": into,
        "opening": opening,
        "openings": openings,
        "fill_pressure_ratio": node / fill_source,
        "exhaust_pressure_ratio": exhaust_sink / node,
        "rates": rates,
    }
