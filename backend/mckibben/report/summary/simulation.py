"""Summary of a simulated drive: the timing table, and what to know about the run."""

from __future__ import annotations

from math import pi

from mckibben.application.run.simulate import SimulationResult
from mckibben.facts.run import EVENT, JOINT, STEP, TRACKING
from mckibben.facts.timing import PHASES, TIMING
from mckibben.report.summary import Summary, Table, figure, shown
from mckibben.simulation.timing.table import TimingTable

_MOST_NAMED = 6  # of the figures with one remark

_OF_STEPS = (
    "time",
    "size",
    "overshoot",
    "settling_time",
    "steady_error",
    "swing_frequency",
    "swing_amplitude",
)
_MOST_STEPS = 12

_MOST_EVENTS = 20


def summary_of(result: SimulationResult, name: str) -> Summary:
    """Timing, start, air, how the reference is followed, notices.

    Args:
        result: the run.
        name: of the drive, for the title.
    """
    start = result.start
    return [
        timing_table(result, name),
        *_motions(result.timing),
        *(f"– {remark}" for remark in timing_remarks(result.timing)),
        f"start at {round(start.position, 9) * 1e3 + 0.0:.4g} mm "
        f"({start.contraction * 100:.3g} %), {start.reason}",
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
        *_tracking(result),
        *_joint(result),
        *notices(result),
    ]


def _motions(timing: TimingTable) -> list[str]:
    """How the motion of each phase ends."""
    ends = {words: getattr(timing, phase).motion for phase, words in PHASES.items()}
    return [f"{words}: the load {motion}" for words, motion in ends.items() if motion]


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


def timing_remarks(timing: TimingTable) -> list[str]:
    """Remarks on figures, or why they are missing, by phase; figures with the same remark share a line."""
    about: dict[tuple[str, str], list[str]] = {}
    for place, why in timing.notes.items():
        phase, _, name = place.partition(".")
        about.setdefault((PHASES[phase], why), []).append(TIMING[name].words)
    return [f"{words}, {_several(names)}: {why}" for (words, why), names in about.items()]


def _several(names: list[str]) -> str:
    return ", ".join(names) if len(names) <= _MOST_NAMED else f"{len(names)} figures"


def _events(result: SimulationResult) -> Summary:
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


def _tracking(result: SimulationResult) -> Summary:
    follows = result.tracking
    if follows is None:
        return []
    rows = [[each.label, shown(each, getattr(follows, name))] for name, each in TRACKING.items()]
    tables: Summary = [f"controlled: {follows.verdict}" + (f"; {follows.advice}" if follows.advice else "")]
    tables.append(Table(TRACKING.title, ["", ""], rows))
    if follows.steps:
        heads = [STEP[name].label for name in _OF_STEPS]
        steps = [[shown(STEP[n], getattr(each, n)) for n in _OF_STEPS] for each in follows.steps]
        tables.append(Table(f"{STEP.title} ({len(steps)})", heads, steps[:_MOST_STEPS]))
    return tables


def _joint(result: SimulationResult) -> list[Table]:
    """Where the joint of a pair is at the end, and how the stiffness follows its set point."""
    joint = result.joint
    if joint is None or not len(joint.angle):
        return []
    degrees = 180.0 / pi
    rows = [
        ["Angle at the end", figure(float(joint.angle[-1]) * degrees, unit="°")],
        ["Stiffness at the end", figure(float(joint.stiffness[-1]), unit=" N·m/rad")],
    ]
    if joint.counter_pressure is not None:
        both = f"{result.pressure[-1] / 1e5:.3g} and {joint.counter_pressure[-1] / 1e5:.3g} bar"
        rows.append(["Pressures at the end", both])
    if joint.stiffness_error is not None:
        each = JOINT["stiffness_error"]
        rows.append([each.label, shown(each, joint.stiffness_error)])
    return [Table("Joint", ["", ""], rows)]
