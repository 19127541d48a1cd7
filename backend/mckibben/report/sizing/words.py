"""Names and display units of the fields, limits and figures of a sizing."""

from __future__ import annotations

from mckibben.application.size.size import ProposedDrive, RejectedParts
from mckibben.report.figures import Scale, figure, plain, scale_of, variable
from mckibben.report.html import Html, html, tag
from mckibben.report.sizing.material import Entry

LITRES, SECONDS, NEWTON, JOULE = Scale("l", 1e-3), Scale("s"), Scale("N"), Scale("J")
MILLIMETRES, BAR, SHARE = Scale("mm", 1e-3), Scale("bar", 1e5), Scale("%", 0.01)
PER_MILLIMETRE = Scale("N/mm", 1e3)
_ZERO_CELSIUS = 273.15
#: Ratio of force to load from which it is shown as "ample": the load is practically zero.
AMPLE = 100.0

_FIELDS = {
    "load.mass": "Moved mass",
    "load.inclination": "Inclination of the path",
    "load.force": "Constant force against the muscle",
    "load.force_over_stroke": "Force over the stroke",
    "load.spring": "Spring against the muscle",
    "load.counterweight": "Counterweight",
    "load.lever_ratio": "Stroke of the muscle per stroke of the load",
    "load.pair.angle": "Swing of the pair",
    "load.pair.torque": "Torque against the first muscle",
    "load.pair.inertia": "Moment of inertia",
    "load.pair.pulley_radius": "Pulley radius",
    "stroke": "Stroke of the load",
    "time": "Time for the stroke",
    "time_down": "Time for the return",
    "cycle_time": "Time for stroke and return",
    "speed": "Average speed",
    "stiffness": "Stiffness at the load",
    "supply_pressure": "Supply pressure (gauge)",
    "ambient_temperature": "Ambient temperature",
    "limits.max_contraction": "Largest contraction",
    "limits.force_reserve": "Force reserve",
    "limits.pressure_reserve": "Pressure reserve",
    "limits.max_length": "Largest installed length",
    "limits.end_fittings": "Length of both end fittings",
    "limits.max_diameter": "Largest diameter",
    "limits.max_parallel": "Largest number of parallel muscles",
    "limits.life": "Load cycles",
    "catalogue.muscles": "Muscles to try",
    "catalogue.valves": "Valves to try",
    "catalogue.tubes": "Tubes to try",
    "catalogue.tube_length": "Tube from the valve to each muscle",
    "limits.max_impact_energy": "Largest energy at the end stop",
    "operation.cycles_per_year": "Cycles per year",
    "operation.air_price": "Price of a cubic metre of air (ANR)",
    "operation.currency": "Currency",
    "uncertainty.blocked_force": "Spread of the blocked force (two standard deviations)",
    "uncertainty.hysteresis": "Width of the hysteresis loop",
    "uncertainty.supply_pressure": "Tolerance of the supply pressure",
    "uncertainty.specimens": "Simulated specimens",
    "rank_by": "Ranked by",
    "max_proposals": "Number of proposals",
}
#: Limit -> its name in words.
LIMITS = {
    "length": "Installed length",
    "pressure": "Supply pressure",
    "contraction": "Contraction",
    "force": "Force over load, at rest",
    "force_limit": "Tension of a muscle",
    "suspended_mass": "Mass hanging on a muscle",
    "valve_pressure": "Pressure of the valve",
    "diameter": "Outer diameter",
    "stiffness": "Stiffness at the load",
    "life": "Load cycles (an estimate)",
    "temperature": "Ambient temperature",
    "time": "Time for the stroke",
    "time_down": "Time for the return",
    "cycle_time": "Time for stroke and return",
}


def field_name(path: str) -> str:
    """A field of the task in words."""
    return _FIELDS.get(path) or path.rpartition(".")[2].replace("_", " ").capitalize()


def limit_name(name: str) -> str:
    """A limit in words."""
    return LIMITS.get(name) or name.replace("_", " ").capitalize()


def entry_value(entry: Entry) -> Html:
    """The value of a field; "none" where nothing is demanded."""
    if entry.value is None:
        return html("none")
    if isinstance(entry.value, str):
        return html(entry.value)
    return in_unit(entry.value, entry.unit)


def in_unit(value: float, unit: str, digits: int = 4) -> Html:
    """An SI value in its usual unit."""
    if unit == "K":
        shown = plain(value - _ZERO_CELSIUS, digits, exact=True)
        return tag("data", f"{shown}\N{NO-BREAK SPACE}°C", value=repr(float(value)))
    scale = {"Pa": BAR, "%": SHARE, "1": Scale(""), "": Scale("")}.get(unit) or scale_of(unit)
    return figure(value, scale, digits, exact=True)


def drive_words(proposal: ProposedDrive) -> str:
    """The muscles of a proposal in words."""
    number = f"{proposal.muscles} × " if proposal.muscles > 1 else ""
    return f"{number}{proposal.muscle}, {variable('length')[1].of(proposal.nominal_length):.4g} mm"


def parts_words(item: ProposedDrive | RejectedParts) -> str:
    """Valve and tube of a proposal or rejected choice in words."""
    names = [item.valve, item.tube]
    return ", ".join(name for name in names if name) or "any valve and tube"
