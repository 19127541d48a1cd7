"""Summary of a simulated drive: the timing table, and what to know about the run."""

from __future__ import annotations

from math import pi

from mckibben.application.run.simulate import SimulationResult
from mckibben.facts.run import EVENT, JOINT, TRACKING
from mckibben.facts.timing import PHASES, PRESSURE_FIGURES, TIMING
from mckibben.report.summary.parts import Summary, Table, figure, shown

_MOST_EVENTS = 20


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
        *(
            []
            if start.lowest is None or start.highest is None
            else [
                f"dry friction holds the load there from {start.lowest * 1e3:.4g} mm to "
                f"{start.highest * 1e3:.4g} mm"
            ]
        ),
        f"air: {result.gas}",
        *([] if result.rest is None else [f"at the end the load {result.rest}"]),
        *_events(result),
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
    rows = [
        [
            each.label,
            *(shown(each, getattr(getattr(result.timing, phase), name)) for phase in PHASES),
        ]
        for name, each in TIMING.items()
    ]
    return Table(f"{name}: {result.outcome}", ["", *PHASES.values()], rows)


def _reasons(result: SimulationResult) -> set[str]:
    """Why figures are missing, and which of the pressure are blurred."""
    timing = result.timing
    return {
        f"{words}: {why}"
        for phase, words in PHASES.items()
        for name in TIMING
        if (getattr(getattr(timing, phase), name) is None or name in PRESSURE_FIGURES)
        and (why := timing.notes.get(f"{phase}.{name}"))
    }


def _events(result: SimulationResult) -> list[Table | str]:
    """The events of the run in their order; of many the first."""
    if not result.events:
        return []
    rows = [
        [shown(EVENT["time"], each.time), each.text, shown(EVENT["speed"], each.speed)]
        for each in result.events[:_MOST_EVENTS]
    ]
    table = Table(EVENT.title, [EVENT["time"].label, "", EVENT["speed"].label], rows)
    further = len(result.events) - len(rows)
    return [table, *([f"and {further} further events, which the answer lists"] if further else [])]


def _tracking(result: SimulationResult) -> list[Table]:
    follows = result.tracking
    if follows is None:
        return []
    rows = [[each.label, shown(each, getattr(follows, name))] for name, each in TRACKING.items()]
    return [Table(TRACKING.title, ["", ""], rows)]


def _joint(result: SimulationResult) -> list[Table]:
    """Where the joint of a pair is at the end, and how the stiffness follows its set point."""
    joint = result.joint
    if joint is None or not len(joint.angle):
        return []
    degrees = 180.0 / pi
    rows = [
        ["Angle at the end", figure(float(joint.angle[-1]) * degrees, unit="°")],
        ["Stiffness at the end", figure(float(joint.stiffness[-1]), unit=" N·m/rad")],
        [
            "Pressures at the end",
            f"{result.pressure[-1] / 1e5:.3g} and {joint.counter_pressure[-1] / 1e5:.3g} bar",
        ],
    ]
    if joint.stiffness_error is not None:
        each = JOINT["stiffness_error"]
        rows.append([each.label, shown(each, joint.stiffness_error)])
    return [Table("Joint", ["", ""], rows)]
