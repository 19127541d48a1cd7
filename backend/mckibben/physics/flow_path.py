"""The air path: supply, valve or regulator, tube, muscle, with the effects that act on it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from mckibben.physics import gas, ops
from mckibben.physics.model import Model
from mckibben.physics.ops import Value


def regulator_shares(*, error: Value, band: Value, dead_band: Value) -> tuple[Value, Value]:
    """Openings of the two orifices of a pressure regulator, of filling and of venting [0, 1].

    Each opens with the pressure that is missing or too much, beyond half of a dead band in which both are
    closed, and is fully open where that exceeds a band:

    .. math:: x = \\operatorname{sgn}(e)\\,\\min\\bigl(\\max(|e| - \\tfrac{d}{2},\\,0)/b,\\,1\\bigr)

    Args:
        error: set point after its lag minus the pressure at the outlet e [Pa].
        band: error beyond the dead band at which an orifice is fully open b [Pa].
        dead_band: full width d [Pa].
    """
    excess = ops.positive_part(error - 0.5 * dead_band) / band
    surplus = ops.positive_part(-error - 0.5 * dead_band) / band
    # Exactly one of both has a derivative at zero error: a regulator at rest still controls.
    fills = ops.greater(error, 0.0)
    return (
        ops.where(fills, ops.minimum(excess, 1.0), 0.0),
        ops.where(fills, 0.0, ops.minimum(surplus, 1.0)),
    )


class Restriction(NamedTuple):
    """Sonic conductance [m^3/(s Pa)] and critical pressure ratio [-]."""

    conductance: Value
    critical_ratio: Value


def with_flow_control(
    *, before: Restriction, behind: Restriction, c: Mapping[str, Value]
) -> tuple[Restriction, Restriction]:
    """What is in series with a flow control valve on the muscle, while filling and while venting.

    Args:
        before: what the air passes before the flow control while it fills the muscle.
        behind: what it passes behind the flow control while it leaves the muscle.
        c: constants of the drive, by name.
    """
    filling = gas.in_series(
        first=before.conductance,
        first_ratio=before.critical_ratio,
        second=c["filling_restriction"],
        second_ratio=c["filling_restriction_ratio"],
    )
    venting = gas.in_series(
        first=c["venting_restriction"],
        first_ratio=c["venting_restriction_ratio"],
        second=behind.conductance,
        second_ratio=behind.critical_ratio,
    )
    return Restriction(*filling), Restriction(*venting)


def quick_exhaust_share(*, excess: Value, band: Value) -> Value:
    """Opening of a quick exhaust valve [0, 1]: its lip lifts over a band of pressure differences.

    Args:
        excess: pressure in the muscle minus that in the tube before it [Pa].
        band: excess at which it is fully open [Pa].
    """
    return ops.minimum(ops.positive_part(excess) / band, 1.0)


def flow_path(
    *,
    tube: bool,
    regulator: bool,
    second_order: bool = False,
    flow_control: bool = False,
    quick_exhaust: bool = False,
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
        regulator: whether a pressure regulator feeds the muscle (`regulator_shares`); the conductances are
            those of its fully open orifices.
        second_order: whether its set point is followed by a lag of second order (state ``regulator_rate``).
        flow_control: whether a flow control valve is on the muscle, with other conductances for filling and
            for venting; without a tube in series with the valve, else with the tube.
        quick_exhaust: whether a quick exhaust valve is on the muscle, behind the tube
            (`quick_exhaust_share`).
        tube_exponent: polytropic exponent of the air in the tube; 1 where its wall keeps it at ambient
            temperature.
        model, values: effects and their parameters.
        c: constants of the drive, by name.
        y: states of the drive, by name.
        command: commanded opening [-1, 1]; of a regulator its set point as a share of its range.
        temperature: temperature of the gas in the muscle [K].

    Returns:
        ``supply``, ``exhaust`` and ``into_muscle`` mass flow, ``through_exhaust`` without what a quick
        exhaust dumps, ``opening`` after all effects, ``openings`` (effect id -> opening before it), both
        pressure ratios, and ``rates`` by state.
    """
    openings: dict[str, Value] = {}
    opening = command
    for effect in model.effects:
        if "opening" in effect.slots:
            openings[effect.id] = opening
            opening = effect.call("opening", {"opening": opening}, values[effect.id])
    ambient, ambient_pressure = c["ambient_temperature"], c["ambient_pressure"]
    node = y["tube_pressure"] if tube else y["pressure"]
    node_temperature = ambient if tube else temperature
    supply_pressure = model.chain("supply", c["supply_pressure"], values, {}, name="supply_pressure")
    fill_c = model.chain("fill_conductance", c["fill_conductance"], values, {}, name="conductance")
    exhaust_c = model.chain("exhaust_conductance", c["exhaust_conductance"], values, {}, name="conductance")
    exhaust_sink = model.chain("exhaust_sink", ambient_pressure, values, {}, name="sink_pressure")
    rates: dict[str, Value] = {}
    fill_source = supply_pressure
    if regulator:
        source = y["regulator_pressure"]
        set_point = ambient_pressure + ops.positive_part(opening) * c["regulator_range"]
        lagging = (ops.minimum(set_point, supply_pressure) - source) / c["regulator_time"]
        if second_order:
            rate = y["regulator_rate"]
            rates["regulator_pressure"] = rate
            rates["regulator_rate"] = (lagging - 2.0 * c["regulator_damping"] * rate) / c["regulator_time"]
        else:
            rates["regulator_pressure"] = lagging
        fill_share, exhaust_share = regulator_shares(
            error=source - node, band=c["regulator_band"], dead_band=c["regulator_dead_band"]
        )
    else:
        fill_share, exhaust_share = ops.positive_part(opening), ops.positive_part(-opening)
    filling = Restriction(fill_c * fill_share, c["fill_ratio"])
    venting = Restriction(exhaust_c * exhaust_share, c["exhaust_ratio"])
    if flow_control and not tube:
        filling, venting = with_flow_control(before=filling, behind=venting, c=c)
    fill = gas.mass_flow(
        pressure_from=fill_source,
        pressure_to=node,
        temperature_from=ambient,
        temperature_to=node_temperature,
        conductance=filling.conductance,
        critical_ratio=filling.critical_ratio,
    )
    exhaust = gas.mass_flow(
        pressure_from=node,
        pressure_to=exhaust_sink,
        temperature_from=node_temperature,
        temperature_to=ambient,
        conductance=venting.conductance,
        critical_ratio=venting.critical_ratio,
    )
    into, through_exhaust = fill - exhaust, exhaust
    if tube:
        own = model.chain("tube_conductance", c["tube_conductance"], values, {}, name="conductance")
        line = Restriction(own, c["tube_ratio"])
        inward = ops.greater(node, y["pressure"])
        if flow_control:
            ways = with_flow_control(before=line, behind=line, c=c)
            line = Restriction(*(ops.where(inward, *pair) for pair in zip(*ways, strict=True)))
        through = gas.mass_flow(
            pressure_from=node,
            pressure_to=y["pressure"],
            temperature_from=ambient,
            temperature_to=temperature,
            conductance=line.conductance,
            critical_ratio=line.critical_ratio,
        )
        if quick_exhaust:
            through = ops.where(inward, through, 0.0)
        rates["tube_pressure"] = gas.pressure_rate(
            pressure=node,
            volume=c["tube_volume"],
            volume_rate=0.0,
            mass_flow=into - through,
            temperature=ambient,
            polytropic_exponent=tube_exponent,
        )
        into = through
    if quick_exhaust:
        dumped = gas.mass_flow(
            pressure_from=y["pressure"],
            pressure_to=ambient_pressure,
            temperature_from=temperature,
            temperature_to=ambient,
            conductance=c["quick_exhaust_conductance"]
            * quick_exhaust_share(excess=y["pressure"] - node, band=c["quick_exhaust_band"]),
            critical_ratio=c["quick_exhaust_ratio"],
        )
        into, exhaust = into - dumped, exhaust + dumped
    return {
        "supply": fill,
        "exhaust": exhaust,
        "through_exhaust": through_exhaust,
        "into_muscle": into,
        "opening": opening,
        "openings": openings,
        "fill_pressure_ratio": node / fill_source,
        "exhaust_pressure_ratio": exhaust_sink / node,
        "rates": rates,
    }
