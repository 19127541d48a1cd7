"""Figures of a muscle at rest: curves, characteristics, under a load, limits, geometry, inverse answers."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from mckibben.facts.figure import Condition, Figure, Group

#: Sign of dL/dt -> the branch of a static answer, to be read after a figure's label.
BRANCHES: Mapping[int, str] = MappingProxyType(
    {
        -1: "while shortening (filling)",
        0: "without friction",
        1: "while lengthening (venting)",
    }
)


def branch_of(direction: float) -> str:
    """The branch that a sign of dL/dt names."""
    return BRANCHES[(direction > 0.0) - (direction < 0.0)]


_FITTED = Condition("the model was fitted", "the model was not fitted")
_ASKED_FORCE = Condition(
    "it is asked for, and the ideal muscle has this force at this length",
    "the ideal muscle has no force at this length",
)
_ASKED_SECANT = Condition(
    "it is asked for, and the muscle has a length without force",
    "the muscle has no length without force at this pressure",
)
_FREE = Condition(
    "the force vanishes between 35 % of L₀ and the braid lock",
    "the force vanishes at no length between 35 % of L₀ and the braid lock",
)
_CONTRACTS = Condition(
    "the muscle contracts without load", "the muscle does not contract without load at this pressure"
)
_HELD = Condition(
    "the load is held short of the braid lock", "the load stretches the muscle to the braid lock"
)
_BOTH_WAYS = Condition(
    "the load is held while shortening and while lengthening",
    "the load is not held while shortening or while lengthening",
)
_RISES = Condition(
    "the load is held both ways and the contraction rises with the pressure",
    "the load is not held both ways, or the contraction does not rise with the pressure",
)
_LOADED = Condition("a load is stated", "no load is stated")
_FIXED = Condition("a fixed length is stated", "no fixed length is stated")
_STATED = Condition("the maker states it", "the maker's limit is not known")
_REACHED = Condition(
    "a pressure up to 40 bar gives the force at the length",
    "no pressure up to 40 bar gives this force at this length",
)
_CARRIED = Condition(
    "preload and load are held short of the braid lock",
    "the preload without pressure, or the load at this pressure, stretches the muscle to the braid lock",
)

#: Curves over the length, one for each pressure, of one muscle on one branch.
CURVES = Group(
    "curves",
    "Curves of the muscle",
    Figure("pressure", "P", "Pa", "Pressure", "Gauge pressure in the muscle."),
    Figure(
        "contraction", "ε", "1", "Contraction",
        "(L₀ − L)/L₀; negative where the muscle is stretched.", quantity="ratio",
    ),
    Figure("length", "L", "m", "Length", "L₀ (1 − ε)."),
    Figure(
        "braid_angle", "θ", "rad", "Braid angle",
        "Angle of thread and axis, acos(L/b); where an effect lets the pressure stretch the braid, at the "
        "highest pressure.",
    ),
    Figure(
        "force", "F", "N", "Force",
        "Static tension on the stated branch; 0 where the muscle hangs slack, unless negative forces are "
        "asked for.",
    ),
    Figure(
        "stiffness", "k", "N/m", "Stiffness, valve open",
        "dF/dL of one muscle at constant pressure on the stated branch; 0 where it hangs slack.",
    ),
    Figure(
        "stiffness_closed", "k_c", "N/m", "Stiffness, valve closed",
        "dF/dL of one muscle at constant gas mass, k − (∂F/∂P) γ p (∂V/∂L)/(V + V_d + γ p ∂V/∂P) with "
        "absolute pressure p"
        " and the stated exponent γ (1.4 fast, 1 slow) and dead volume V_d.",
    ),
    Figure(
        "stiffness_from_force", "k₂₀", "N/m", "Stiffness of this force",
        "6 L F/(3 L² − b²), that of an ideal muscle with this force and length, equation (20) of the source"
        " paper.", _ASKED_FORCE,
    ),
    Figure(
        "stiffness_secant", "k₂₅", "N/m", "Secant stiffness",
        "F/(L − L_free), straight from the length without force at this pressure, equation (25) of the "
        "source paper.",
        _ASKED_SECANT,
    ),
    Figure(
        "volume", "V", "m^3", "Gas volume",
        "Gas volume of the muscle without dead volume; where an effect lets the pressure stretch the braid,"
        " at the highest pressure.",
    ),
    Figure(
        "diameter", "D", "m", "Braid diameter",
        "Diameter of the braid (middle of the wall) at mid-span, at the highest pressure.",
    ),
    Figure(
        "outer_diameter", "D_o", "m", "Outer diameter",
        "Outer diameter of the wall at mid-span at constant wall volume, at the highest pressure: the room "
        "that the muscle needs.",
    ),
)  # fmt: skip

#: Where new readings of a fitted model are expected.
FORCE_INTERVAL = Group(
    "force_interval",
    "Interval of new readings of the force",
    Figure(
        "low", "", "N", "Lower end of the force",
        "F − z √(J C Jᵀ + σ_e²) with the covariance C of the fitted values and the error σ_e that the fit "
        "left; outside of the measured range only a bound that is too high.",
        _FITTED,
    ),
    Figure(
        "high", "", "N", "Upper end of the force",
        "F + z √(J C Jᵀ + σ_e²) as the lower end; outside of the measured range only a bound that is too "
        "low.",
        _FITTED,
    ),
    Figure(
        "share", "", "1", "Share of new readings",
        "Share of new readings of the force that lie between both ends, where the model was measured; z is "
        "its quantile of the normal distribution.",
        _FITTED, quantity="ratio",
    ),
)  # fmt: skip

#: Figures at one pressure, on one branch.
CHARACTERISTICS = Group(
    "characteristics",
    "Characteristics",
    Figure("pressure", "P", "Pa", "Pressure", "Gauge pressure in the muscle."),
    Figure("blocked_force", "F₀", "N", "Blocked force", "Static force at ε = 0 on the stated branch."),
    Figure(
        "free_contraction", "ε₀", "1", "Free contraction",
        "ε at which the static force is 0 on the stated branch; negative where the muscle without load is "
        "longer than L₀.",
        _FREE, quantity="ratio",
    ),
    Figure(
        "max_work", "W", "J", "Largest work",
        "∫ F dL from ε = 0 to the free contraction at constant pressure on the stated branch: the most that"
        " one stroke can do, with a load that follows the curve.",
        _CONTRACTS,
    ),
    Figure(
        "thread_tension_total", "T", "N", "Ideal tension of all threads",
        "Tension of all threads together along the threads in the ideal muscle at L₀.",
    ),
)  # fmt: skip

#: State in which the muscle holds a load at one pressure, on one branch.
OPERATING_POINT = Group(
    "operating_point",
    "At the load",
    Figure("pressure", "P", "Pa", "Pressure", "Gauge pressure in the muscle."),
    Figure(
        "contraction", "ε", "1", "Contraction at the load",
        "ε at which the static force on the stated branch equals the load.", _HELD, quantity="ratio",
    ),
    Figure("length", "L", "m", "Length at the load", "L₀ (1 − ε) there.", _HELD),
    Figure("force", "F", "N", "Load", "The stated load.", _HELD),
    Figure(
        "stiffness", "k", "N/m", "Stiffness at the load, valve open",
        "dF/dL of one muscle there at constant pressure.", _HELD,
    ),
    Figure(
        "stiffness_closed", "k_c", "N/m", "Stiffness at the load, valve closed",
        "dF/dL of one muscle there at constant gas mass, with the stated exponent (1.4 fast, 1 slow) and "
        "dead volume.",
        _HELD,
    ),
    Figure(
        "diameter", "D", "m", "Braid diameter at the load",
        "Diameter of the braid (middle of the wall) at mid-span there.", _HELD,
    ),
)  # fmt: skip

_ASKED_CONTRACTION = Condition("a contraction is asked for", "no contraction is asked for")
_ASKED_BOTH = Condition(
    "a contraction is asked for and a pressure up to 40 bar holds the load there",
    "no pressure up to 40 bar holds the load at this contraction",
)
#: What a muscle does with the load at one pressure.
LIFT = Group(
    "lift",
    "What the muscle does with the load",
    Figure("pressure", "P", "Pa", "Pressure", "Gauge pressure in the muscle."),
    Figure("load", "F", "N", "Load", "The stated load; a mass weighs 9.80665 N a kilogram."),
    Figure(
        "contraction", "ε", "1", "Contraction",
        "(L₀ − L)/L₀ where the static force equals the load, reached while filling.", _HELD, quantity="ratio",
    ),
    Figure(
        "contraction_vented", "ε", "1", "Contraction after venting",
        "(L₀ − L)/L₀ where the static force equals the load, reached while venting from a higher pressure.",
        _HELD, quantity="ratio",
    ),
    Figure(
        "length", "L", "m", "Length at rest",
        "L₀ (1 − ε): where the load comes to rest at the pressure while filling.", _HELD,
    ),
    Figure(
        "hanging_length", "L", "m", "Length without pressure",
        "Where the load hangs at zero gauge pressure after venting.",
        Condition("the load is held without pressure short of the braid lock",
                  "without pressure the load stretches the muscle to the braid lock"),
    ),
    Figure(
        "lift", "s", "m", "Lift",
        "From where the load hangs without pressure, after venting, to where it rests at the pressure, while "
        "filling.",
        _CARRIED,
    ),
    Figure(
        "stiffness", "k", "N/m", "Stiffness, valve open",
        "dF/dL at the load and the pressure with the pressure held, while filling.", _HELD,
    ),
    Figure(
        "stiffness_closed", "k_c", "N/m", "Stiffness, valve closed",
        "dF/dL at the load and the pressure with the gas mass held, while filling, with the stated exponent "
        "and dead volume.",
        _HELD,
    ),
    Figure(
        "asked_contraction", "ε", "1", "Asked contraction", "The contraction whose pressure is asked for.",
        _ASKED_CONTRACTION, quantity="ratio",
    ),
    Figure(
        "pressure_filling", "P", "Pa", "Pressure",
        "Gauge pressure up to 40 bar that holds the load at the asked contraction, reached while filling.",
        _ASKED_BOTH,
    ),
    Figure(
        "pressure_venting", "P", "Pa", "Pressure while venting",
        "Gauge pressure up to 40 bar that holds the load at the asked contraction, reached while venting.",
        _ASKED_BOTH,
    ),
)  # fmt: skip

#: Distance of the branches at the load, of a slow loop far from its ends.
LOOP = Group(
    "loop",
    "Width of the loop at the load",
    Figure("pressure", "P", "Pa", "Pressure", "Gauge pressure in the muscle."),
    Figure(
        "stroke", "ΔL", "m", "Loop width in length",
        "L₀ (ε while lengthening − ε while shortening) at equal pressure.", _BOTH_WAYS,
    ),
    Figure(
        "share", "Δε", "1", "Loop width as a share of L₀",
        "ε while lengthening − ε while shortening at equal pressure.", _BOTH_WAYS, quantity="ratio",
    ),
    Figure(
        "pressure_width", "ΔP", "Pa", "Loop width in pressure (linear estimate)",
        "Δε/(dε/dP), with the slope of the mean of both branches: the distance at equal length as far as "
        "the branches are straight.",
        _RISES,
    ),
)  # fmt: skip

#: Over the pressure: position at the load, force and diameters at a fixed length.
OVER_PRESSURE = Group(
    "over_pressure",
    "Over pressure",
    Figure("pressure", "P", "Pa", "Pressure", "Gauge pressure in the muscle."),
    Figure("load", "F", "N", "Load", "The stated load.", _LOADED),
    Figure(
        "contraction", "ε", "1", "Contraction",
        "ε at which the static force equals the load, friction fully built up.", _LOADED, quantity="ratio",
    ),
    Figure("length", "L", "m", "Length", "L₀ (1 − ε) at the load.", _LOADED),
    Figure("diameter", "D", "m", "Braid diameter", "Diameter of the braid at mid-span at the load.", _LOADED),
    Figure(
        "outer_diameter", "D_o", "m", "Outer diameter",
        "Outer diameter of the wall at mid-span at the load.", _LOADED,
    ),
    Figure("fixed_length", "L", "m", "Fixed length", "Length at which both ends are held.", _FIXED),
    Figure(
        "force_at_fixed_length", "F", "N", "Force at fixed length",
        "Static force over the pressure with both ends held, friction fully built up.", _FIXED,
    ),
    Figure(
        "filling", "F", "N", "Force while shortening",
        "Static force at the fixed length on the branch of filling.", _FIXED,
    ),
    Figure(
        "venting", "F", "N", "Force while lengthening",
        "Static force at the fixed length on the branch of venting.", _FIXED,
    ),
    Figure(
        "diameter_at_fixed_length", "D", "m", "Braid diameter at fixed length",
        "Diameter of the braid at mid-span with both ends held; constant unless an effect stretches the "
        "threads.",
        _FIXED,
    ),
    Figure(
        "outer_diameter_at_fixed_length", "D_o", "m", "Outer diameter at fixed length",
        "Outer diameter of the wall at mid-span with both ends held; constant unless an effect stretches "
        "the threads.",
        _FIXED,
    ),
)  # fmt: skip

#: Limits of a muscle: of its maker, and of its braid.
LIMITS = Group(
    "muscle_limits",
    "Limits of the muscle",
    Figure(
        "max_pressure", "P_max", "Pa", "Largest pressure", "Operating pressure (gauge) by the maker.",
        _STATED,
    ),
    Figure("max_force", "F_max", "N", "Largest force", "Lifting force by the maker.", _STATED),
    Figure(
        "max_contraction", "ε_max", "1", "Largest contraction", "Contraction by the maker.", _STATED,
        quantity="ratio",
    ),
    Figure(
        "max_pretension", "", "1", "Largest stretch",
        "Stretch beyond L₀ by the maker, as a positive share of L₀.", _STATED, quantity="ratio",
    ),
    Figure(
        "ideal_max_contraction", "", "1", "Ideal largest contraction",
        "1 − b/(√3 L₀), at which the ideal force is 0.", quantity="ratio",
    ),
    Figure(
        "braid_lock_force", "", "N", "Ideal force at the braid lock",
        "Ideal force of the fully stretched braid, at each pressure.",
    ),
    Figure(
        "share", "", "1", "Used share of the limit",
        "Largest pressure of the curves, load, or largest contraction at the load over its limit; the bar is "
        "full where the limit is reached.", _STATED, quantity="ratio",
    ),
)  # fmt: skip

#: Geometry of a muscle at ε = 0.
GEOMETRY = Group(
    "geometry",
    "Geometry of the muscle",
    Figure(
        "braid_diameter", "D₀", "m", "Braid diameter",
        "Diameter of the braid (middle of the wall) at L₀.",
    ),
    Figure("braid_angle", "θ₀", "rad", "Braid angle", "Angle of thread and axis at L₀."),
    Figure(
        "nominal_length", "L₀", "m", "Rest length",
        "Length at which ε = 0: that of the catalogue, or as stated; friction and pretension of the bladder"
        " may hold the muscle a little beside it.",
    ),
    Figure("inside_diameter", "D_i", "m", "Inside diameter", "Bore of the bladder; 0 where it is not known."),
    Figure("wall_thickness", "H₀", "m", "Wall thickness", "Wall of the bladder; 0 where it is not known."),
    Figure("thread_length", "b", "m", "Thread length", "Length of one thread, L₀/cos θ₀."),
    Figure(
        "turns", "n", "1", "Turns",
        "Turns of one thread round the axis, L₀ tan θ₀/(π D₀).",
        quantity="number",
    ),
    Figure(
        "side", "ℓ", "m", "Rhombus side",
        "Side of one rhombus of the lattice: as stated, 2 mm where the muscle was not stated as a lattice.",
    ),
    Figure(
        "along", "n_L", "1", "Rhombi along", "Number of rhombi along the muscle, b/(2 ℓ).",
        quantity="number",
    ),
    Figure(
        "around", "n_C", "1", "Rhombi around", "Number of rhombi around the muscle, n_L/n.",
        quantity="number",
    ),
)  # fmt: skip

#: Answers to inverse questions, by the name of the question.
INVERSE = Group(
    "inverse",
    "Inverse calculation",
    Figure(
        "pressure", "P", "Pa", "Pressure",
        "Gauge pressure up to 40 bar at which the static force at the stated length equals the stated one.",
        _REACHED,
    ),
    Figure(
        "contraction", "ε", "1", "Contraction",
        "ε at which the static force at the stated pressure equals the stated one.",
        _HELD, quantity="ratio",
    ),
    Figure(
        "stroke_pressure", "P", "Pa", "Pressure that lifts the load",
        "Gauge pressure up to 40 bar that holds the load at L₀ − stroke while shortening; the stroke counts "
        "from L₀, not from where the load hangs without pressure.", _REACHED,
    ),
    Figure(
        "working_range", "s", "m", "Usable stroke",
        "L₀ (ε at the end − ε at the start).", _CARRIED,
    ),
)  # fmt: skip

_UNDIRECTED = Condition(
    "the model has dry friction, and no direction is stated",
    "there is no dry friction, or the direction is stated",
)
#: What stands beside the answer to an inverse question.
INVERSE_DETAILS = Group(
    "inverse_details",
    "Details of the answer",
    Figure("pressure", "P", "Pa", "Pressure", "The stated gauge pressure."),
    Figure("force", "F", "N", "Force", "The stated force."),
    Figure("length", "L", "m", "Length", "Length at which the force acts.", _HELD),
    Figure(
        "contraction", "ε", "1", "Contraction", "Contraction at which the force acts.",
        _HELD, quantity="ratio",
    ),
    Figure(
        "lowest_pressure", "P_1", "Pa", "Lowest pressure that friction holds",
        "Gauge pressure of the stated force and length while lengthening; from there on friction holds the "
        "muscle.", _UNDIRECTED,
    ),
    Figure(
        "highest_pressure", "P_2", "Pa", "Highest pressure that friction holds",
        "Gauge pressure of the stated force and length while shortening; beyond it the muscle moves.",
        _UNDIRECTED,
    ),
    Figure(
        "lowest_contraction", "ε_1", "1", "Least contraction that friction holds",
        "ε of the stated force and pressure that is reached while shortening.", _UNDIRECTED, quantity="ratio",
    ),
    Figure(
        "highest_contraction", "ε_2", "1", "Largest contraction that friction holds",
        "ε of the stated force and pressure that is reached while lengthening.", _UNDIRECTED,
        quantity="ratio",
    ),
    Figure(
        "start", "ε_s", "1", "Contraction at the start",
        "ε under the preload without pressure while lengthening, at most 0.", _CARRIED, quantity="ratio",
    ),
    Figure(
        "end", "ε_e", "1", "Contraction at the end",
        "ε under the load at the pressure while shortening, at most the maker's limit.",
        _CARRIED, quantity="ratio",
    ),
)  # fmt: skip
