"""Summary of a simulated drive: the timing table, and what to know about the run."""

from __future__ import annotations

from collections.abc import Callable
from math import pi

from mckibben.application.simulate import SimulationResult
from mckibben.facts.timing import PRESSURE_FIGURES
from mckibben.report.summary.parts import Summary, Table, figure
from mckibben.simulation.timing.table import PhaseFigures

# Name of a figure, its field in the timing table, factor and unit.
_SHOWN: tuple[tuple[str, Callable[[PhaseFigures], float | None], str, float, str], ...] = (
    ("positioning time", lambda phase: phase.positioning_time, "positioning_time", 1e3, "ms"),
    ("rise time 10-90 %", lambda phase: phase.rise_time, "rise_time", 1e3, "ms"),
    ("delay time 50 %", lambda phase: phase.delay_time, "delay_time", 1e3, "ms"),
    ("settling time", lambda phase: phase.settling_time, "settling_time", 1e3, "ms"),
    ("average speed", lambda phase: phase.average_speed, "average_speed", 1.0, "m/s"),
    ("largest speed", lambda phase: phase.max_speed, "max_speed", 1.0, "m/s"),
    ("  at", lambda phase: phase.max_speed_at, "max_speed_at", 1e3, "ms"),
    ("largest acceleration", lambda phase: phase.max_acceleration, "max_acceleration", 1.0, "m/s²"),
    ("  at", lambda phase: phase.max_acceleration_at, "max_acceleration_at", 1e3, "ms"),
    ("smallest acceleration", lambda phase: phase.min_acceleration, "min_acceleration", 1.0, "m/s²"),
    ("  at", lambda phase: phase.min_acceleration_at, "min_acceleration_at", 1e3, "ms"),
    ("end speed", lambda phase: phase.end_speed, "end_speed", 1.0, "m/s"),
    ("impact energy", lambda phase: phase.impact_energy, "impact_energy", 1.0, "J"),
    ("overshoot", lambda phase: phase.overshoot, "overshoot", 100.0, "%"),
    ("pressure rise time", lambda phase: phase.pressure_rise_time, "pressure_rise_time", 1e3, "ms"),
    ("pressure delay time", lambda phase: phase.pressure_delay_time, "pressure_delay_time", 1e3, "ms"),
    (
        "pressure settling time",
        lambda phase: phase.pressure_settling_time,
        "pressure_settling_time",
        1e3,
        "ms",
    ),
    ("air", lambda phase: phase.air_mass, "air_mass", 1e3, "g"),
    ("  of it for the tube", lambda phase: phase.tube_air_mass, "tube_air_mass", 1e3, "g"),
    ("air at ANR", lambda phase: phase.air_volume_anr, "air_volume_anr", 1e3, "l"),
    ("share that flows choked", lambda phase: phase.choked_share, "choked_share", 100.0, "%"),
)


def summary_of(result: SimulationResult, name: str) -> Summary:
    """Timing, start, air, how the reference is followed, notices.

    Args:
        result: the run.
        name: of the drive, for the title.
    """
    start, note = result.start, result.timing.notes.get("extend.air_mass")
    return [
        timing_table(result, name),
        *(f"– {reason}" for reason in sorted(_reasons(result))),
        f"start at {start.position * 1e3:.4g} mm ({start.contraction * 100:.3g} %), {start.reason}",
        f"air: {result.gas}",
        *([] if note is None else [f"air mass {note}"]),
        *_tracking(result),
        *_joint(result),
        *notices(result),
    ]


def notices(result: SimulationResult) -> list[str]:
    """Notices about the drive, and why the run did not complete."""
    ended = [] if result.message is None else [f"{result.outcome}: {result.message}"]
    return [*(notice.message for notice in result.flags), *ended]


def timing_table(result: SimulationResult, name: str) -> Table:
    """The figures of both phases."""
    phases = (result.timing.extend, result.timing.retract)
    rows = [
        [label, *(figure(_times(figure_of(phase), factor), unit=f" {unit}") for phase in phases)]
        for label, figure_of, _, factor, unit in _SHOWN
    ]
    return Table(f"{name}: {result.outcome}", ["", "extend (fill)", "retract (exhaust)"], rows)


def _reasons(result: SimulationResult) -> set[str]:
    """Why figures are missing, and which of the pressure are blurred."""
    timing = result.timing
    return {
        f"{name}: {why}"
        for name, phase in (("extend", timing.extend), ("retract", timing.retract))
        for _, figure_of, key, _, _ in _SHOWN
        if (figure_of(phase) is None or key in PRESSURE_FIGURES)
        and (why := timing.notes.get(f"{name}.{key}"))
    }


def _tracking(result: SimulationResult) -> list[Table]:
    follows = result.tracking
    if follows is None:
        return []
    rows = [
        ["rms error", figure(follows.rms * 1e3, unit=" mm")],
        ["largest error", figure(follows.max * 1e3, unit=" mm")],
        ["lag", figure(_times(follows.lag, 1e3), unit=" ms")],
    ]
    return [Table("Following the reference", ["", ""], rows)]


def _joint(result: SimulationResult) -> list[Table]:
    """Where the joint of a pair is at the end, and how the stiffness follows its set point."""
    joint = result.joint
    if joint is None or not len(joint.angle):
        return []
    degrees = 180.0 / pi
    rows = [
        ["angle at the end", figure(float(joint.angle[-1]) * degrees, unit="°")],
        ["stiffness at the end", figure(float(joint.stiffness[-1]), unit=" N·m/rad")],
        [
            "pressures at the end",
            f"{result.pressure[-1] / 1e5:.3g} and {joint.counter_pressure[-1] / 1e5:.3g} bar",
        ],
    ]
    if joint.stiffness_error is not None:
        rows.append(["rms error of the stiffness", figure(joint.stiffness_error, unit=" N·m/rad")])
    return [Table("Joint", ["", ""], rows)]


def _times(value: float | None, factor: float) -> float | None:
    return None if value is None else value * factor
