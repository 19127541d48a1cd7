"""What a sizing task states: label, definition, and the default with its reason."""

from __future__ import annotations

from math import sqrt

from mckibben.facts.figure import Figure, Group
from mckibben.facts.timing import AT_ANR
from mckibben.facts.units import NAMES, SHIFTED


def _default(text: str) -> float | None:
    """The SI value of "6 bar"; None of an empty text."""
    if not text:
        return None
    number, _, unit = text.partition(" ")
    factor, offset = SHIFTED[unit] if unit in SHIFTED else (NAMES[unit or "1"][0], 0.0)
    return float(number) * factor + offset


def _stated(
    name: str, unit: str, label: str, definition: str, usual: str = "", quantity: str = "", symbol: str = ""
) -> Figure:
    """A value of the task; ``{usual}`` in its definition is the default."""
    text = definition.replace("{usual}", usual.replace(" °", "°") if usual.endswith("°") else usual)
    return Figure(name, symbol, unit, label, text, quantity=quantity, default=_default(usual))


_SPECIMENS = 100

#: Path in the document of a task -> what it states.
TASK = Group(
    "task",
    "Task",
    _stated("load.mass", "kg", "Mass", "Mass to be moved. 0: only the other loads count.", "0"),
    _stated(
        "load.force", "N", "External force",
        "Constant force against the muscle, in addition to the weight. Default 0: none.", "0",
    ),
    _stated(
        "load.force_over_stroke", "N", "Force over stroke",
        "Further force that depends on the stroke, linear in between. Leave empty for none. Static "
        "calculations use it as it is; simulations use the lowest straight line that is nowhere below it "
        "and does not fall.",
    ),
    _stated(
        "load.inclination", "rad", "Inclination",
        "Angle between the direction of motion and the horizontal. Default {usual}: most loads hang.", "90 °",
    ),
    _stated(
        "load.spring", "N/m", "Spring",
        "Spring against the contraction, relaxed at the start of the stroke. Default 0: none.", "0",
    ),
    _stated(
        "load.counterweight", "kg", "Counterweight",
        "Mass on the other side of a pulley that pulls with the muscle. Default 0: none.", "0",
    ),
    _stated(
        "load.lever_ratio", "1", "Lever ratio",
        "Stroke of the muscle per stroke of the load. Default {usual}: the muscle pulls directly.",
        "1", "number",
    ),
    _stated("load.pair.angle", "rad", "Angle", "Whole swing of the pulley, from one end to the other."),
    _stated(
        "load.pair.torque", "N*m", "Torque",
        "Torque against the first muscle over the whole swing. Default 0: none.", "0",
    ),
    _stated(
        "load.pair.inertia", "kg*m^2", "Inertia",
        "Moment of inertia of everything that turns. 0: the time depends on the air flow alone.", "0",
    ),
    _stated(
        "load.pair.pulley_radius", "m", "Pulley radius",
        "Radius of the pulley. Leave empty to try eight radii from 10 to 120 mm.",
    ),
    _stated("stroke", "m", "Stroke", "Travel of the load; a pair has an angle instead."),
    _stated(
        "time", "s", "Time for the stroke", "Longest time for the stroke. Leave empty for no limit.",
    ),
    _stated(
        "time_down", "s", "Time for the return", "Longest time for the return. Leave empty for no limit.",
    ),
    _stated(
        "cycle_time", "s", "Cycle time",
        "Longest time for stroke and return together, without a pause between them. Leave empty for no "
        "limit.",
    ),
    _stated(
        "speed", "m/s", "Average speed",
        "Stroke over time for the stroke, dead times with it, instead of the time. Leave empty to use the "
        "time.",
    ),
    _stated(
        "stiffness", "N/m", "Stiffness at the load",
        "Least stiffness at the load at the end of the stroke with the valve open; with the valve closed "
        "it is higher. Leave empty for no limit.",
    ),
    _stated(
        "supply_pressure", "Pa", "Available supply",
        "Gauge pressure that is available. Default {usual}: a usual supply, and the limit of most muscles.",
        "6 bar",
    ),
    _stated(
        "ambient_temperature", "K", "Ambient temperature",
        "Temperature of the surroundings. Default {usual}.", "20 °C",
    ),
    _stated(
        "limits.max_contraction", "1", "Largest contraction",
        "Contraction at the end of the stroke. Default {usual}: makers allow 25 %, but the force is small "
        "there. A lower limit of the maker takes precedence.", "20 %", "ratio",
    ),
    _stated(
        "limits.force_reserve", "1", "Force reserve",
        "Least static force above the load on the whole stroke, as a share of the load. Default {usual}: "
        "specimens differ by about that much.", "10 %", "ratio",
    ),
    _stated(
        "limits.pressure_reserve", "1", "Pressure reserve",
        "Share of the available supply that is not used. Default 0: its tolerance has a field of its own.",
        "0", "ratio",
    ),
    _stated(
        "limits.max_length", "m", "Largest installed length",
        "Rest length with the end fittings, without pressure. Default {usual}. Longer muscles exist.", "1 m",
    ),
    _stated(
        "limits.end_fittings", "m", "End fittings",
        "Length of both end fittings together. Default 0: no verified value is known, enter yours.", "0",
    ),
    _stated(
        "limits.max_diameter", "m", "Largest outer diameter",
        "Outer diameter at the end of the stroke. Leave empty for no limit.",
    ),
    _stated(
        "limits.max_parallel", "1", "Muscles in parallel",
        "Largest number of muscles side by side. Default {usual}: more muscles rarely share a load evenly.",
        "2", "number",
    ),
    _stated(
        "limits.max_impact_energy", "J", "Largest impact energy",
        "Energy that either end stop can take, that of the stroke and that of the return. A drive above it "
        "is proposed behind those below it. Leave empty for no limit.",
    ),
    _stated(
        "limits.life", "1", "Load cycles",
        "Least number of load cycles. Leave empty for no limit. The life is an unverified estimate: makers "
        "publish no curves.", "", "number",
    ),
    _stated(
        "catalogue.muscles", "", "Muscles",
        "Muscle presets. Default: all with complete catalogue data, because then every limit is known.",
    ),
    _stated(
        "catalogue.valves", "", "Valves",
        "Valve presets. Default: all whose flow is known, without pressure regulators, which switch too "
        "slowly.",
    ),
    _stated(
        "catalogue.tubes", "", "Tubes",
        "Tube presets. Default: all. Narrow tubes save air, wide tubes save time.",
    ),
    _stated(
        "catalogue.tube_length", "m", "Tube length",
        "From the valve to each muscle; 0 for no tube. Default {usual}.", "1 m",
    ),
    _stated(
        "operation.cycles_per_year", "1", "Cycles per year",
        "For the cost of the air. Default one million.", "1e6", "number",
    ),
    _stated(
        "operation.air_price", "1/m^3", "Price of air (ANR)",
        f"Price of a cubic metre of compressed air {AT_ANR}. "
        "Default {usual}, a "
        "usual figure in euro (general knowledge, not verified: 0.01 to 0.03).", "0.025",
    ),
    _stated("operation.currency", "", "Currency", "Currency of the price."),
    _stated(
        "uncertainty.blocked_force", "1", "Force spread",
        "Two standard deviations of the blocked force between specimens. Default {usual}: published curves "
        "of the same size differ by that much.", "10 %", "ratio",
    ),
    _stated(
        "uncertainty.hysteresis", "1", "Hysteresis",
        "Largest width of the loop as a share of the rest length. Leave empty for the value of the "
        "catalogue.",
        "", "ratio",
    ),
    _stated(
        "uncertainty.supply_pressure", "1", "Supply tolerance",
        "Largest deviation of the supply pressure. Default {usual}: a usual pressure regulator.",
        "3 %", "ratio",
    ),
    _stated(
        "uncertainty.specimens", "1", "Specimens",
        "Simulated specimens of each proposal. Default {usual}: the standard error of the share that "
        f"succeeds is then at most {50.0 / sqrt(_SPECIMENS):.2g} %, and "
        f"{100.0 * sqrt(0.95 * 0.05 / _SPECIMENS):.1g} % at a share of 95 %. 0: none.",
        str(_SPECIMENS), "number",
    ),
    _stated(
        "rank_by", "", "Ranked by",
        "Order of the proposals. Balanced: air consumption times the square root of length and number of "
        "muscles, because air is a running cost and space is not. Drives that probably fail come last in "
        "any order.",
    ),
    _stated(
        "max_proposals", "1", "Proposals", "Largest number of proposals. Default {usual}.", "10", "number",
    ),
)  # fmt: skip


def usual(path: str) -> float:
    """The default of a value of the task, SI.

    Raises:
        LookupError: it has none.
    """
    value = TASK[path].default
    if value is None:
        raise LookupError(f"{path} has no default")
    return value
