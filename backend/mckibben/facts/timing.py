"""Figures of one phase of a switched drive, fill or vent, as Festo's ProPneu reports them.

All times count from the switching instant of the phase (ProPneu prints those of the vent in run time).
s is the travel since that instant, positive in the direction of the phase (fill: shorter); S the stroke of
the phase: from its start to where it ends, or the demanded stroke.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

from mckibben.facts.figure import Condition, Figure, Group

#: Why figures of a step do not exist.
NO_STEP = "the command changes all through the phase: it is no step"
_MOVES = Condition("the command has the phase and the load moves in it", "the muscle does not move")
_STEPS = Condition("the command is a step and the load moves", "the muscle does not move")
_ARRIVES = Condition(
    "the command is a step, and the load ends within 5 % of its way to the stop that it hits, or settles at "
    "the demanded stroke, or hits no stop and settles",
    "the load does not arrive in this phase",
)
_SETTLES = Condition(
    "the command is a step and the load is within the band before the last tenth of the phase",
    "still moving at the end of the phase",
)
_PRESSURE = Condition(
    "the command is a step and the pressure changes by 100 Pa or more in the phase",
    "the pressure does not change",
)
_STEADY = Condition(
    "the command is a step and the pressure is within the band before the last tenth of the phase",
    "the pressure still changes at the end of the phase",
)
_FLOWS = Condition(
    "air flows in the direction of the phase",
    "no air flows in the direction of the phase",
)
_FREE = Condition("the command is a step, and the load moves and hits no stop", "the load hits the stop")
_HITS = Condition(
    "the load hits the stop ahead, or arrives without one", "the load does not arrive in this phase"
)
_SWINGS = Condition(
    "the command is a step, and the load does not settle and has two even periods in the second half of the "
    "phase",
    "it does not swing",
)
_COMMANDED = Condition("the command has the phase", "the command has no such phase")
_MASS = Condition("the moving mass is known", "the moving mass is not known")

#: A signal that settles only behind this share of its time counts as not settled.
SETTLED_BEFORE = 0.9
#: Phase -> what it is called; it begins when the valve is switched.
PHASES: Mapping[str, str] = MappingProxyType({"extend": "fill", "retract": "vent"})


#: State of the volumes of air, to be read after "a volume": that of ANR, ISO 8778.
AT_ANR = "at 20 °C, 100 kPa and 65 % humidity"
_UNTIL = "from the end of the flow of the phase before to the end of its own flow"


def _section(title: str, *figures: Figure) -> tuple[Figure, ...]:
    return tuple(replace(figure, section=title) for figure in figures)


_MOTION = _section(
    "Motion",
    Figure(
        "stroke", "S", "m", "Stroke of the phase",
        "Position at the end of the phase minus position at its start, in the direction of the phase: where "
        "the load is then, not where its stop is; the demanded stroke where one is demanded.", _MOVES,
    ),
    Figure(
        "positioning_time", "t_pos", "s", "Positioning time",
        "Time of the first impact on the stop ahead at which the load ends; without one first time at "
        "s = 0.95 S.",
        _ARRIVES, quantity="lapse",
    ),
    Figure(
        "rise_time", "t_r", "s", "Rise time (10–90 %)",
        "Time from first s = 0.1 S to first s = 0.9 S; no dead time is in it.",
        _STEPS, quantity="lapse",
    ),
    Figure(
        "delay_time", "t_50", "s", "Time to 50 % of the stroke",
        "First time at s = 0.5 S, the dead time in it (ProPneu calls it delay time).",
        _STEPS, quantity="lapse",
    ),
    Figure(
        "settling_time", "t_s", "s", "Settling time (5 % of the stroke)",
        "Time from which |s − S| ≤ 0.05 S until the end of the phase; not before the impact with which the "
        "load arrives.",
        _SETTLES, quantity="lapse",
    ),
    Figure(
        "average_speed", "v_m", "m/s", "Average speed",
        "Travel at the positioning time over the positioning time.", _ARRIVES,
    ),
    Figure(
        "max_speed", "v_max", "m/s", "Largest speed",
        "Largest ds/dt in the phase, without a load at rest on a stop and with the instant before an impact.",
        _MOVES,
    ),
    Figure(
        "max_speed_at", "t(v_max)", "s", "Time of the largest speed", "Time of the largest ds/dt.",
        _MOVES, quantity="lapse",
    ),
    Figure(
        "max_acceleration", "a_max", "m/s^2", "Largest acceleration towards shorter",
        "Largest second derivative of the position, positive towards shorter in both phases, without "
        "impacts.", _MOVES,
    ),
    Figure(
        "max_acceleration_at", "t(a_max)", "s", "Time of the largest acceleration",
        "Time of the largest acceleration towards shorter.",
        _MOVES, quantity="lapse",
    ),
    Figure(
        "min_acceleration", "a_min", "m/s^2", "Largest acceleration towards longer",
        "Smallest second derivative of the position, negative where the load accelerates towards longer or "
        "brakes on "
        "its way to shorter, without impacts.", _MOVES,
    ),
    Figure(
        "min_acceleration_at", "t(a_min)", "s", "Time of the largest acceleration towards longer",
        "Time of the smallest second derivative of the position.",
        _MOVES, quantity="lapse",
    ),
    Figure(
        "end_speed", "v_e", "m/s", "Speed on arrival",
        "ds/dt just before the first impact on the stop ahead; without an impact ds/dt at the positioning "
        "time.",
        _HITS,
    ),
    Figure(
        "impact_energy", "E", "J", "Impact energy",
        "m v²/2 of the first impact on the stop ahead, m all moving mass referred to the load; 0 without an "
        "impact.",
        _MASS,
    ),
    Figure(
        "overshoot", "o", "1", "Overshoot of the final position",
        "Largest travel beyond S over S: max(0, max s/S − 1); S is where the phase ends, not a reference.",
        _FREE, quantity="ratio",
    ),
    Figure(
        "swing_frequency", "f", "Hz", "Frequency of the swing",
        "One over the mean period of the travel about its middle, in the second half of the phase.", _SWINGS,
    ),
    Figure(
        "swing_amplitude", "â", "m", "Amplitude of the swing",
        "Half of the range of the travel within the last period.", _SWINGS,
    ),
)  # fmt: skip

_PRESSURE_STEP = _section(
    "Pressure",
    Figure(
        "pressure_rise_time", "t_pr", "s", "Pressure rise time (10–90 %)",
        "Time between first 10 and first 90 % of the change of pressure in the (first) muscle in the phase, "
        "up or down.",
        _PRESSURE, quantity="lapse",
    ),
    Figure(
        "pressure_delay_time", "t_p50", "s", "Time to 50 % of the change of pressure",
        "First time at 50 % of the change of pressure in the (first) muscle in the phase, the dead time "
        "in it.",
        _PRESSURE, quantity="lapse",
    ),
    Figure(
        "pressure_settling_time", "t_ps", "s", "Pressure settling time (1 % of the change)",
        "Time from which the pressure stays within 1 % of its change around its value at the end of the "
        "phase.",
        _STEADY, quantity="lapse",
    ),
)  # fmt: skip

_AIR = _section(
    "Air",
    Figure(
        "supplied_mass", "m_s", "kg", "Air taken from the supply",
        f"Mass of air that all muscles and tubes take from the supply in the phase, {_UNTIL}.",
        _COMMANDED, quantity="air",
    ),
    Figure(
        "supplied_volume_anr", "V_s", "m^3", "Air taken from the supply (ANR)",
        f"The same mass as a volume {AT_ANR}: m_s/(1.185 kg/m³).", _COMMANDED, quantity="normal",
    ),
    Figure(
        "vented_mass", "m_v", "kg", "Air let out",
        f"Mass of air that all muscles and tubes let out in the phase, leaks with it, {_UNTIL}.",
        _COMMANDED, quantity="air",
    ),
    Figure(
        "vented_volume_anr", "V_v", "m^3", "Air let out (ANR)",
        f"The same mass as a volume {AT_ANR}: m_v/(1.185 kg/m³).", _COMMANDED, quantity="normal",
    ),
    Figure(
        "tube_air_mass", "m_t", "kg", "… of which in the tubes",
        "Change of the mass of air in the tubes, Δp V/(R T), in the direction of the phase.",
        _COMMANDED, quantity="air",
    ),
    Figure(
        "choked_share", "", "1", "Share of the air that passes choked",
        "Integral of the flow from the supply (fill) or to the atmosphere (vent) while the valve is choked, "
        "over its integral in the phase.",
        _FLOWS, quantity="ratio",
    ),
)  # fmt: skip

TIMING = Group("timing", "Timing of a phase", *_MOTION, *_PRESSURE_STEP, *_AIR)

MOTION_FIGURES, PRESSURE_FIGURES, AIR_FIGURES = (
    tuple(figure.name for figure in part) for part in (_MOTION, _PRESSURE_STEP, _AIR)
)
#: Figures that exist for a step alone.
STEP_FIGURES = (
    "positioning_time", "rise_time", "delay_time", "settling_time", "average_speed", "end_speed", "overshoot",
    "swing_frequency", "swing_amplitude", *PRESSURE_FIGURES,
)  # fmt: skip
