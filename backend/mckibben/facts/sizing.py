"""Figures of a proposed drive, the limits it keeps, and the extent of the search."""

from __future__ import annotations

from dataclasses import replace

from mckibben.facts.figure import Condition, Figure, Group
from mckibben.facts.timing import AT_ANR

#: Duration of the fill [s]: this multiple of the required time, at least the shortest; of a task without one
#: the last.
FILL_TIMES, SHORTEST_FILL, UNTIMED_FILL = 2.0, 0.2, 4.0
#: Travel from which the load has left its stop [m].
LIFTED = 1e-5
#: Positions over the stroke, both ends with them, at which load and muscle are compared.
STATIONS = 7

_RETURNS = Condition(
    "the load rests on the stop of the return at the end of the run",
    "the load does not return within the simulated time",
)
_CARRIED = Condition(
    "the force grows with the pressure wherever the load is carried", "no pressure carries the load"
)
_SPECIMENS = Condition("the task asks for specimens", "the task asks for no specimens")
_PAIR = Condition("the drive is a pair on a pulley", "there is no pulley")
_STATED = Condition("the task or the maker states the limit", "no such limit is stated")

_FIGURES = (
    Figure(
        "nominal_length", "L₀", "m", "Rest length",
        "Rest length of each muscle without its end fittings, as the search chose it.",
    ),
    Figure(
        "parallel", "", "1", "Muscles in parallel",
        "Number of muscles side by side, of a pair on each side.",
    ),
    Figure("muscles", "", "1", "Muscles", "Number of all muscles of the drive."),
    Figure("tube_length", "", "m", "Tube length", "Tube from the valve to each muscle; 0 without one."),
    Figure("pulley_radius", "r", "m", "Pulley radius", "Radius of the pulley that both muscles pull.", _PAIR),
    Figure(
        "pressure", "p_s", "Pa", "Supply pressure",
        "Gauge pressure at the valve of this drive, set by a regulator; at most what the task makes "
        "available.",
    ),
    Figure(
        "time", "t", "s", "Time for the stroke",
        "From switching, dead times with it, to the impact on the stop that ends the stroke.",
    ),
    Figure(
        "time_down", "t_d", "s", "Time for the return",
        "From switching, dead times with it, to the impact on the stop that ends the return.", _RETURNS,
    ),
    Figure(
        "air_volume_anr", "V_ANR", "m^3", "Air per cycle (ANR)",
        "Air that all muscles and tubes take from the supply for one stroke and one return, as a volume "
        f"{AT_ANR}. The valve fills for {FILL_TIMES:g} times the "
        f"required time of stroke or cycle, at least {SHORTEST_FILL:g} s, and {UNTIMED_FILL:g} s where none "
        "is required: after a short fill the muscle is not yet full.",
        quantity="normal",
    ),
    Figure(
        "air_cost", "", "1", "Air cost",
        "Air per cycle times the price of air, in the currency of the task.", quantity="cost",
    ),
    Figure(
        "air_cost_year", "", "1", "Air cost per year",
        "Air cost of a cycle times the cycles per year, in the currency of the task.", quantity="number",
    ),
    Figure(
        "contraction",
        "ε", "1", "Contraction", "At the end of the stroke: stroke times lever ratio over rest length.",
        quantity="ratio",
    ),
    Figure(
        "static_load", "", "N", "Load of a muscle",
        "Load of one muscle at rest at the end of the stroke, without the second muscle of a pair.",
    ),
    Figure(
        "needed_pressure", "p_n", "Pa", "Lowest sufficient pressure",
        f"Least gauge pressure that carries the load at rest at each of {STATIONS} positions of the stroke, "
        "static force while filling, taken as linear between no pressure and supply pressure.", _CARRIED,
    ),
    Figure(
        "pressure_start", "p_1", "Pa", "Pressure at lift-off",
        f"Gauge pressure in the muscle when the load has moved by {1e3 * LIFTED:g} mm.",
    ),
    Figure(
        "pressure_end", "p_2", "Pa", "Pressure on arrival",
        "Gauge pressure in the muscle at the impact that ends the stroke; it may still rise.",
    ),
    Figure(
        "force_reserve", "", "1", "Force reserve at rest",
        f"Least of (static force at supply pressure while filling)/(load) − 1 at {STATIONS} positions of "
        "the stroke, all muscles together; in a pair the empty second muscle is part of the load. A drive "
        "that arrives before its pressure has risen has less in motion.", quantity="ratio",
    ),
    Figure(
        "peak_force", "F_p", "N", "Largest tension of a muscle",
        "Largest tension in the whole run; of a pair that of the first muscle.",
    ),
    Figure(
        "stiffness", "k", "N/m", "Stiffness at the load, valve open",
        "N r² dF/dL at the end of the stroke at constant supply pressure, while filling, for N parallel "
        "muscles and lever ratio r, with that of the empty second muscle and of the spring.",
    ),
    Figure(
        "stiffness_closed", "k_c", "N/m", "Stiffness at the load, valve closed",
        "The same with a constant mass of gas in the muscle, γ = 1.4; the volume of tube and fittings, "
        "which lowers it, is left out.",
    ),
    Figure(
        "impact_energy", "E", "J", "Impact energy",
        "The larger of those of stroke and return: m v²/2 of all moving mass at the stop, of all parallel "
        "muscles together.",
    ),
    Figure(
        "impact_energy_stroke", "E_1", "J", "Impact energy of the stroke",
        "m v²/2 at the stop that ends the stroke, m all moving mass referred to the load.",
    ),
    Figure(
        "impact_energy_return", "E_2", "J", "Impact energy of the return",
        "m v²/2 at the stop that ends the return; 0 if the load does not reach it.",
    ),
    Figure(
        "end_speed", "v_e", "m/s", "Speed on arrival",
        "Speed of the load at the impact that ends the stroke.",
    ),
    Figure("max_speed", "v_max", "m/s", "Largest speed", "Largest speed of the load, of stroke and return."),
    Figure(
        "installed_length", "", "m", "Installed length",
        "Rest length with the end fittings, as far as the task states them.",
    ),
    Figure(
        "outer_diameter", "D_o", "m", "Outer diameter",
        "Outer diameter of the wall at mid-span at the end of the stroke.",
    ),
    Figure(
        "life", "N", "1", "Load cycles (an estimate)",
        "10^(7 − 2u) with u the larger share of the maker's largest contraction and force that is used at "
        "rest; general knowledge, not verified, no curve of the maker.",
    ),
    Figure(
        "probability", "p", "1", "Successful specimens",
        "Share of the simulated specimens that reach the end of the stroke in time, stay there while the "
        "valve fills, and return in time where that is required. Limits at rest, wear and failures are not "
        "part of it.",
        _SPECIMENS, quantity="ratio",
    ),
    Figure(
        "probability_error", "", "1", "Standard error",
        "√(p (1 − p)/n) of the share p of n specimens; at 0 and 1 that of one deviating specimen.",
        _SPECIMENS, quantity="ratio",
    ),
    Figure("specimens", "n", "1", "Specimens", "Simulated specimens of this drive."),
    Figure(
        "margins", "", "1", "Margin",
        "limit/value − 1 of an upper limit, value/limit − 1 of a lower one: the share by which the smaller "
        "of the two may grow until they meet; negative beyond the limit.",
        _STATED, quantity="ratio",
    ),
    Figure("binding", "", "", "Nearest limit", "The limit with the least margin."),
    Figure(
        "front", "", "", "Pareto front",
        "Whether no other proposal and no explored drive is at least as good in every aim and better in "
        "one; aims are air, time, installed length, force reserve and stiffness.",
    ),
)  # fmt: skip

#: A proposal.
SIZING = Group("sizing", "Proposed drive", *_FIGURES)


def _limit(name: str, figure: str, definition: str) -> Figure:
    """The limit of a figure of a proposal."""
    return replace(SIZING[figure], name=name, definition=definition, exists_when=_STATED)


#: The limits of a drive by their names; unit and scale are those of the value that is limited.
LIMITS = Group(
    "limit",
    "Limits of a drive",
    _limit("length", "installed_length", "Largest installed length."),
    _limit("pressure", "pressure", "Largest supply pressure: what is available, less the pressure reserve."),
    _limit("contraction", "contraction", "Largest contraction: the smaller of the task's and the maker's."),
    Figure(
        "force", "", "1", "Force beyond the reserve",
        "Least of force over load at rest on the stroke: 1 and the force reserve of the task.",
        _STATED, "number",
    ),
    Figure(
        "force_limit",
        "", "N", "Tension of a muscle", "Largest tension the maker permits, at rest and in the run.", _STATED
    ),
    Figure(
        "suspended_mass", "", "kg", "Mass hanging on a muscle",
        "Largest mass the maker permits to hang freely on a muscle.", _STATED,
    ),
    _limit("diameter", "outer_diameter", "Largest outer diameter at the end of the stroke."),
    _limit("stiffness", "stiffness", "Least stiffness at the load with the valve open."),
    _limit("life", "life", "Least number of load cycles."),
    Figure(
        "temperature", "", "K", "Ambient temperature", "Temperatures for which the muscle is made.", _STATED,
    ),
    _limit("time", "time", "Longest time for the stroke."),
    _limit("time_down", "time_down", "Longest time for the return."),
    Figure(
        "cycle_time", "", "s", "Cycle time",
        "Longest time for stroke and return together, without a pause between them.", _STATED,
    ),
    Figure(
        "valve_pressure", "", "Pa", "Pressure of the valve",
        "Pressures for which the valve is made, against those at which the muscles carry the load.", _STATED,
    ),
)  # fmt: skip

#: How far the search went.
SEARCH = Group(
    "search",
    "Search",
    Figure(
        "combinations", "", "1", "Combinations",
        "Combinations of muscle, length, number, pressure, valve and tube within the limits of length, "
        "pressure and contraction.",
    ),
    Figure("pruned", "", "1", "Rejected at rest", "Combinations rejected by the static calculation."),
    Figure("simulated", "", "1", "Simulated", "Transient runs, without those of specimens."),
    Figure("specimens", "", "1", "Specimens simulated", "Transient runs of specimens for the probabilities."),
)  # fmt: skip
