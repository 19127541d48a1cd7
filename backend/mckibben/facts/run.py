"""Figures of a run over time: its columns, how a reference is followed, the joint of a pair, the air."""

from __future__ import annotations

from collections.abc import Mapping

from mckibben.facts.figure import Condition, Figure, Group
from mckibben.facts.timing import AT_ANR

_CONTROLLED = Condition("a controller follows a reference", "there is no reference to follow")
_LAGGED = Condition(
    "reference and position change, and a shift of at most a quarter of the run correlates them",
    "no lag fits",
)
_STEPS = Condition(
    "the reference jumps between constant levels", "the reference has no jump between constant levels"
)
_SETTLED = Condition(
    "the position is within 2 % of the step before the last tenth of its time",
    "the position does not stay within 2 % of the step",
)
_SWINGS = Condition("the position has two even periods in the second half of the step", "it does not swing")
_SOMEWHERE = Condition(
    "it is asked for and the forces of the row determine a place",
    "not asked for, or nothing pulls in either direction, or both muscles are slack",
)
_TUBE = Condition("there is a tube", "there is no tube")
_REGULATOR = Condition("there is a proportional pressure regulator", "there is no regulator")
_STIFFNESS = Condition("the stiffness is controlled", "the stiffness is not controlled")


def curve_fit_of(what: str) -> str:
    """What a drive is that was fitted to something with parts that do not exist."""
    return f"curve fit of {what}, not a drive"


#: Columns over time, and what is said of the whole run.
RUN = Group(
    "run",
    "Run",
    Figure("time", "t", "s", "Time", "Time from the start of the run.", column="time"),
    Figure(
        "position", "x", "m", "Position",
        "Position of the load, positive towards a shorter muscle; 0 at the rest length, of a pair in the"
        " middle.", column="load_position",
    ),
    Figure(
        "velocity", "v", "m/s", "Velocity",
        "dx/dt of the load, positive towards a shorter muscle.", column="load_velocity",
    ),
    Figure(
        "acceleration", "a", "m/s^2", "Acceleration",
        "d²x/dt² of the load, positive towards a shorter muscle.", column="load_acceleration",
    ),
    Figure(
        "pressure", "p", "Pa", "Pressure",
        "Gauge pressure in the muscle; of a pair in the first one.", column="pressure",
    ),
    Figure("force", "F", "N", "Force", "Tension of the muscle; of a pair of the first one.", column="force"),
    Figure(
        "mass_flow", "ṁ", "kg/s", "Air flow",
        "Mass flow of air into the muscle, negative out of it; of a pair of the first one. With a stated "
        "polytropic exponent it does not conserve mass: its integral is not the air of the timing table.",
        column="air_flow",
    ),
    Figure(
        "command", "u", "1", "Command", "Command before dead times: 1 fill, 0 closed, −1 vent.",
        quantity="number", column="command",
    ),
    Figure(
        "opening", "", "1", "Opening",
        "Opening of the valve after all effects.", quantity="number", column="valve_opening",
    ),
    Figure("reference", "r", "m", "Reference", "Set point of the position.", _CONTROLLED, column="reference"),
    Figure(
        "supply_flow", "", "kg/s", "Flow from the supply",
        "Mass flow from the supply; of a pair to the first muscle.", column="supply_flow",
    ),
    Figure(
        "exhaust_flow", "", "kg/s", "Flow to the atmosphere",
        "Mass flow to the atmosphere; of a pair from the first muscle.", column="exhaust_flow",
    ),
    Figure(
        "tube_pressure", "", "Pa", "Pressure in the tube",
        "Gauge pressure in the tube.", _TUBE, column="tube_pressure",
    ),
    Figure(
        "regulator_pressure", "", "Pa", "Set point of the regulator",
        "Gauge pressure that the regulator holds, after its lag.", _REGULATOR, column="regulator_pressure",
    ),
    Figure(
        "volume", "V", "m^3", "Gas volume",
        "Gas volume of the muscle with all dead volumes.", column="volume",
    ),
    Figure("diameter", "Ø", "m", "Braid diameter", "Diameter of the braid at mid-span.", column="diameter"),
    Figure(
        "length", "L", "m", "Length between the fittings",
        "Distance of the fittings; a slack muscle is longer.", column="length",
    ),
    Figure(
        "contraction", "ε", "1", "Contraction", "1 − length/rest length, by the distance of the fittings.",
        quantity="ratio",
    ),
    Figure(
        "static_filling", "", "1", "Static contraction, fill",
        "Contraction at which muscle, weight, spring and external force of the row balance at its pressure, "
        "of a pair at both pressures, between the stops; friction against a shortening muscle.",
        _SOMEWHERE, quantity="ratio",
    ),
    Figure(
        "static_venting", "", "1", "Static contraction, vent",
        "The same with friction against a lengthening muscle.", _SOMEWHERE, quantity="ratio",
    ),
    Figure(
        "load_force", "", "N", "External force",
        "Force on the load besides gravity and spring.", column="external_force",
    ),
    Figure(
        "friction", "F_R", "N", "Dry friction",
        "Force of the dry friction on the load, positive towards a shorter muscle; sticking it is what"
        " balances the load.", column="friction",
    ),
    Figure(
        "friction_share", "", "1", "Share of the dry friction",
        "Dry friction over the friction at which the load breaks away or that it slides against; 1 sliding.",
        quantity="ratio", column="friction_share",
    ),
    Figure(
        "temperature", "T", "K", "Gas temperature",
        "Temperature of the air in the muscle.", column="gas_temperature",
    ),
    Figure(
        "contact", "", "1", "On an end stop", "Whether the load rests on an end stop.", quantity="number",
        column="contact",
    ),
    Figure(
        "slack", "", "1", "Muscle slack",
        "Whether the muscle hangs slack: it is then longer than its fittings are apart.", quantity="number",
        column="slack",
    ),
    Figure(
        "stuck", "", "1", "Held by friction", "Whether dry friction holds the load.", quantity="number",
        column="stuck",
    ),
    Figure(
        "weight", "", "N", "Weight along the motion",
        "m g sin(inclination) of the mass of the load, positive against the contraction.",
    ),
    Figure("spring", "", "N/m", "Spring at the load", "Stiffness of the spring against the contraction."),
    Figure(
        "lever_ratio", "", "1", "Lever ratio", "Stroke of the muscle per stroke of the load.",
        quantity="number",
    ),
    Figure("duration", "", "s", "Duration", "Duration of the whole run."),
    Figure(
        "supplied_volume_anr", "V_ANR", "m^3", "Air taken from the supply (ANR)",
        "Air that all muscles and tubes take from the supply over the whole run, as a volume "
        f"{AT_ANR}.", quantity="normal",
    ),
)  # fmt: skip

#: What happens in a run: the key of an event, and what is said of it.
EVENTS: Mapping[str, str] = {
    "hits_high": "hits the upper stop",
    "hits_low": "hits the lower stop",
    "rebounds_high": "rebounds from the upper stop",
    "rebounds_low": "rebounds from the lower stop",
    "leaves_high": "leaves the upper stop",
    "leaves_low": "leaves the lower stop",
    "goes_slack": "muscle goes slack",
    "goes_taut": "muscle goes taut",
    "counter_goes_slack": "second muscle goes slack",
    "counter_goes_taut": "second muscle goes taut",
    "sticks": "sticks: dry friction holds the load",
    "breaks_away_up": "breaks away upwards",
    "breaks_away_down": "breaks away downwards",
    "turns_up": "turns round and slides upwards",
    "turns_down": "turns round and slides downwards",
}
#: The events as figures: when they happen, and how fast the load is just before.
EVENT = Group(
    "event",
    "Events",
    Figure("time", "t", "s", "Time of the event", "Time from the start of the run."),
    Figure(
        "speed", "v", "m/s", "Speed at the event",
        "Velocity of the load just before the event, positive towards a shorter muscle.",
    ),
)  # fmt: skip

#: How a controlled run follows its reference.
TRACKING = Group(
    "tracking",
    "Following the reference",
    Figure(
        "rms", "e_rms", "m", "RMS error of the position",
        "√(1/T ∫(reference − position)² dt) over the whole run, with the transient at its start.",
        _CONTROLLED,
    ),
    Figure(
        "max", "e_max", "m", "Largest error of the position",
        "Largest |reference − position| over the run; where the reference jumps, at least about the jump.",
        _CONTROLLED,
    ),
    Figure(
        "lag", "τ", "s", "Lag",
        "The shift up to a quarter of the run with the largest correlation of reference(t − τ) and "
        "position, whatever "
        "their gain and offset.", _LAGGED, quantity="lapse",
    ),
)  # fmt: skip

#: A step of the reference.
STEP = Group(
    "step",
    "Step of the reference",
    Figure("time", "t", "s", "Time of the step", "First row after the jump of the reference.", _STEPS),
    Figure(
        "size", "Δr", "m", "Height of the step",
        "Signed jump of the reference; of a first level its distance from where the load begins.", _STEPS,
    ),
    Figure(
        "overshoot", "o", "1", "Overshoot of the step",
        "Largest travel beyond the new level before the reference changes again, as a share of the jump.",
        _STEPS, quantity="ratio",
    ),
    Figure(
        "settling_time", "t_s", "s", "Settling time of the step (2 %)",
        "Time from the jump from which |position − reference| stays within 2 % of the jump until the "
        "reference changes again.", _SETTLED, quantity="lapse",
    ),
    Figure(
        "steady_error", "e_∞", "m", "Steady error of the step",
        "Reference minus mean position over the last quarter of the time of the step.", _STEPS,
    ),
    Figure(
        "swing_frequency", "f", "Hz", "Frequency of the swing",
        "One over the mean period of the position about its middle, in the second half of the time of the "
        "step.", _SWINGS,
    ),
    Figure(
        "swing_amplitude", "â", "m", "Amplitude of the swing",
        "Half of the range of the position within the last period.", _SWINGS,
    ),
    Figure(
        "saturated", "", "1", "Time at the limits",
        "Share of the time of the step with the command at its limits.", _STEPS, quantity="ratio",
    ),
)  # fmt: skip

#: The joint of an antagonist pair, with its second muscle.
JOINT = Group(
    "joint",
    "Joint",
    Figure(
        "angle", "φ", "rad", "Angle",
        "Angle of the pulley from the middle, positive as the first muscle pulls.", column="joint_angle",
    ),
    Figure(
        "torque", "M", "N*m", "Torque",
        "r (F₁ − F₂), torque of both muscles on the pulley of radius r.", column="joint_torque",
    ),
    Figure(
        "stiffness", "k", "N*m/rad", "Joint stiffness",
        "r² (dF₁/dL₁ + dF₂/dL₂) at constant pressures; a slack muscle counts as 0.", column="joint_stiffness",
    ),
    Figure(
        "counter_force", "F₂", "N", "Force of the second muscle",
        "Tension of the second muscle.", column="counter_force",
    ),
    Figure(
        "counter_pressure",
        "p₂", "Pa", "Pressure in the second muscle", "Gauge pressure in the second muscle.",
        column="counter_pressure",
    ),
    Figure(
        "counter_command",
        "u₂", "1", "Command of the second muscle", "Command of the second valve or regulator.",
        quantity="number", column="counter_command",
    ),
    Figure(
        "counter_mass_flow",
        "", "kg/s", "Air flow of the second muscle", "Mass flow of air into the second muscle.",
        column="counter_air_flow",
    ),
    Figure(
        "counter_supply_flow", "", "kg/s", "Flow from the supply to the second muscle",
        "Mass flow from the supply to the second muscle.", column="counter_supply_flow",
    ),
    Figure(
        "counter_exhaust_flow", "", "kg/s", "Flow from the second muscle to the atmosphere",
        "Mass flow from the second muscle to the atmosphere.", column="counter_exhaust_flow",
    ),
    Figure(
        "counter_diameter", "Ø₂", "m", "Braid diameter of the second muscle",
        "Diameter of the braid of the second muscle at mid-span.", column="counter_diameter",
    ),
    Figure(
        "angle_reference", "", "rad", "Set point of the angle",
        "Set point of the angle.", _CONTROLLED, column="angle_reference",
    ),
    Figure(
        "stiffness_reference",
        "", "N*m/rad", "Set point of the stiffness", "Set point of the joint stiffness.",
        _STIFFNESS, column="stiffness_reference",
    ),
    Figure(
        "angle_range", "", "rad", "Angle, from and to", "Least and largest angle of the rows of the answer.",
    ),
    Figure(
        "torque_range", "", "N*m", "Torque, from and to",
        "Least and largest torque of the rows of the answer.",
    ),
    Figure(
        "stiffness_range", "", "N*m/rad", "Joint stiffness, from and to",
        "Least and largest stiffness of the rows of the answer.",
    ),
    Figure(
        "stiffness_error", "", "N*m/rad", "RMS error of the joint stiffness",
        "√(1/T ∫(stiffness − set point)² dt) over the whole run, with the transient at its start.",
        _STIFFNESS,
    ),
)  # fmt: skip
