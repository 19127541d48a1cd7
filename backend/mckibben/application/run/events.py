"""What happens in a run, as a list: impacts, slack muscles, loads that stick and break away."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar

from mckibben.facts.result import result_class
from mckibben.facts.run import EVENT, EVENTS
from mckibben.physics.drive_terms import COUNTER, HIGH_STOP, LOW_STOP, SLIDES_DOWN, SLIDES_UP
from mckibben.simulation.drive.events import Event
from mckibben.simulation.drive.transient import Run
from mckibben.simulation.integrate.engine import SLOWEST_REBOUND

_STOPS = {HIGH_STOP: "high", LOW_STOP: "low"}
_WAYS = {SLIDES_UP: "up", SLIDES_DOWN: "down"}


@result_class
class RunEvent:
    """Something that happens at an instant of a run."""

    FIGURES: ClassVar = EVENT.name

    time: float
    kind: str
    """What happens: "sticks", "breaks_away_up", "hits_high", ..."""
    text: str
    """The same in words."""
    speed: float


def events_of_run(run: Run) -> list[RunEvent]:
    """The events of a run in their order; a direction of sliding that turns round at one instant is one."""
    lever = run.drive.load.lever_ratio
    return [
        RunEvent(time=event.time, kind=kind, text=EVENTS[kind], speed=event.speed / lever)
        for event, kind in _kinds(run)
    ]


def _kinds(run: Run) -> Iterator[tuple[Event, str]]:
    """Events with their kinds; of a drive without dry friction no load sticks."""
    dry = bool((run.outputs["friction_share"] != 0.0).any())
    ends: Event | None = None  # of a direction of sliding
    for event in run.events:
        way = _WAYS.get(event.switch)
        if ends is not None and not (way and event.begins and event.time == ends.time):
            yield ends, "sticks"
            ends = None
        if way is None:
            yield event, _plain(event)
        elif not dry:
            continue
        elif event.begins:
            yield event, f"{'breaks_away' if ends is None else 'turns'}_{way}"
            ends = None
        elif abs(event.speed) <= SLOWEST_REBOUND:
            ends = event
    if ends is not None:
        yield ends, "sticks"


def _plain(event: Event) -> str:
    """The kind of an event of a stop or of a slack muscle."""
    side = _STOPS.get(event.switch)
    if side is None:
        muscle = "counter_" if event.switch.endswith(COUNTER) else ""
        return f"{muscle}goes_{'slack' if event.begins else 'taut'}"
    if event.begins:
        return f"hits_{side}"
    return f"{'rebounds' if event.impact else 'leaves'}_{side}"


def rest_of_run(run: Run) -> str | None:
    """What holds a load that dry friction holds at the end of a run; None for any other load."""
    if not len(run.time) or abs(float(run.states["speed"][-1])) > STILL or run.outputs["contact"][-1]:
        return None
    share = float(run.outputs["friction_share"][-1])
    up, down = (float(run.outputs[f"friction_left_{way}"][-1]) for way in ("up", "down"))
    if not share and not up + down:
        return None
    return (
        f"rests, held by friction: it takes {up:.3g} N more upwards and {down:.3g} N more downwards before "
        "the load breaks away"
    )


#: Speed below which a load that friction slows down rests [m/s]: an approach without end is one to rest.
STILL = 1e-9
