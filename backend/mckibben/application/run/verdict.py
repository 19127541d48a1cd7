"""What a run says of the question that its command or its reference asks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from types import MappingProxyType
from typing import Literal

from mckibben.facts.result import result_class
from mckibben.facts.timing import PHASES
from mckibben.simulation.outcome import Outcome
from mckibben.simulation.timing.table import MotionState, PhaseFigures, TimingTable
from mckibben.simulation.timing.tracking import GOOD, FollowState, Tracking

#: How a run ends: of a switched drive its phases, of a controlled one against its reference.
RunState = Literal[
    "never_left", "never_arrived", "drifts", "swings", "returned", "arrived_and_bounced", "arrived_and_held",
    "unstable", "cannot_return", "saturates", "off_target", "tracks", "settles",
]  # fmt: skip

_WORST_FIRST: tuple[MotionState, ...] = (
    "never_left", "never_arrived", "drifts", "swings", "returned", "arrived_and_bounced", "arrived_and_held",
)  # fmt: skip
# A load that is away from its reference, on a stop, at rest or on its way: the sentence says which.
_OF_REFERENCE: Mapping[FollowState, RunState] = MappingProxyType({
    "unstable": "unstable", "swings": "swings", "cannot_return": "cannot_return", "saturates": "saturates",
    "on_stop": "off_target", "beside": "off_target", "moves": "off_target", "deviates": "off_target",
    "tracks": "tracks", "settles": "settles",
})  # fmt: skip
_EVIDENCE = ("stroke", "positioning_time", "settling_time", "overshoot", "swing_frequency", "swing_amplitude")


@result_class
class RunVerdict:
    """Whether a run does what its command or its reference asks."""

    state: RunState | None
    """How it ends, of several phases or steps the worst; None where nothing is asked, or it ended early."""
    met: bool | None
    """Whether that is what was asked; None as the state."""
    sentence: str
    """The same in words."""
    evidence: dict[str, float]
    """Figures that it rests on, SI: of a phase as phase.figure, of a controlled run those of its tracking."""


def verdict_of(
    timing: TimingTable, tracking: Tracking | None, outcome: Outcome, message: str | None
) -> RunVerdict:
    """The verdict of a run."""
    if outcome is not Outcome.COMPLETED:
        return RunVerdict(None, None, message or outcome.label, {})
    if tracking is not None:
        found = asdict(tracking)
        evidence = {name: found[name] for name in ("rms", "max", "lag") if found[name] is not None}
        worst = next((step for step in tracking.steps if step.state == tracking.state), None)
        if worst is not None:
            names = ("time", "size", "overshoot", "steady_error", "settling_time", "swing_frequency",
                     "swing_amplitude", "saturated")  # fmt: skip
            evidence |= {f"step.{n}": value for n in names if (value := getattr(worst, n)) is not None}
        state = _OF_REFERENCE[tracking.state]
        sentence = tracking.verdict[:1].upper() + tracking.verdict[1:]
        return RunVerdict(state, tracking.state in GOOD, f"{sentence}.", evidence)
    phases: dict[str, PhaseFigures] = {name: getattr(timing, name) for name in PHASES}
    ended = {name: phase for name, phase in phases.items() if phase.state is not None}
    if not ended:
        why = "; ".join(f"{words}: {timing.notes[f'{name}.rise_time']}" for name, words in PHASES.items())
        return RunVerdict(None, None, f"Nothing is judged. {why[:1].upper()}{why[1:]}.", {})
    state = min((phase.state for phase in ended.values() if phase.state), key=_WORST_FIRST.index)
    sentence = "; ".join(f"{PHASES[name]}: the load {phase.motion}" for name, phase in ended.items())
    evidence = {
        f"{name}.{figure}": value
        for name, phase in ended.items()
        for figure in _EVIDENCE
        if (value := getattr(phase, figure)) is not None
    }
    return RunVerdict(state, state == "arrived_and_held", f"{sentence[:1].upper()}{sentence[1:]}.", evidence)
