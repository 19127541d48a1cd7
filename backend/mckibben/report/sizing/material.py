"""What the report of a sizing is made of."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from typing import NamedTuple

from mckibben.application.simulate import SimulationResult
from mckibben.application.size import ProposedDrive, SizingResult
from mckibben.physics.effect import Effect
from mckibben.report.command import Command
from mckibben.report.sources import Figure


class Entry(NamedTuple):
    """A field of the task.

    Attributes:
        path: "limits.max_length".
        value: in SI, or words; None where nothing is demanded.
        unit: SI unit, "" of words; "%" of a share that people write in percent.
        given: whether the task says it; else it is the usual value.
        about: what it is, and why its usual value is what it is.
    """

    path: str
    value: float | str | None
    unit: str
    given: bool
    about: str


class KnownFigure(NamedTuple):
    """A figure of a part that enters: name, value in its own unit, where it comes from, a remark."""

    name: str
    value: float
    unit: str
    figure: Figure
    note: str = ""


@dataclass(frozen=True)
class Part:
    """A line of the parts list.

    Attributes:
        kind: "muscle", "valve" or "tube".
        id: of the preset.
        number: how many are needed.
        order: what to order: title of the preset, with the length where it is cut.
        maker, origin: who makes it; "built-in" or "user" preset.
        figures: what enters the sizing.
        references: of the preset.
    """

    kind: str
    id: str
    number: int
    order: str
    maker: str
    origin: str
    figures: Sequence[KnownFigure]
    references: Sequence[str]


class Margin(NamedTuple):
    """A limit: its name, what is allowed and what the drive has in SI, whether less is better, the margin."""

    name: str
    allowed: float
    actual: float
    unit: str
    upper: bool
    share: float


@dataclass(frozen=True)
class ForceCurves:
    """Force of one muscle over its contraction at rest, and what it has to carry.

    Attributes:
        contraction: of the columns [-].
        pressures: gauge, ascending, the supply's last [Pa].
        force: shape (pressures, columns) [N].
        places: contractions over the stroke [-].
        demand: force one muscle must have there [N]; with what the second muscle of a pair resists.
        counter: that resistance alone [N].
        carrying: pressures that just carry the load at the begin and at the end [Pa].
        run: the same demand as the run takes it, where that differs; else empty [N].
    """

    contraction: Sequence[float]
    pressures: Sequence[float]
    force: Sequence[Sequence[float]]
    places: Sequence[float]
    demand: Sequence[float]
    counter: Sequence[float]
    carrying: tuple[float, float]
    run: Sequence[float] = ()


@dataclass(frozen=True)
class SpecimenSpread:
    """What the specimens of the probability vary by.

    Attributes:
        blocked_force: two standard deviations, share of the blocked force.
        shift: one standard deviation of the contraction at which a specimen is at rest [-].
        hysteresis: largest width of the loop, share of the nominal length; None where nobody states it.
        friction: largest force of one muscle against the motion [N].
        supply: largest deviation of the supply pressure, share of it.
        demands: what a specimen must do, in words.
    """

    blocked_force: float
    shift: float
    hysteresis: float | None
    friction: float
    supply: float
    demands: Sequence[str]


@dataclass(frozen=True)
class Chosen:
    """The proposal that is written down.

    Attributes:
        rank: of it, 1 the best.
        proposal: the drive.
        run: its run.
        fill: when the valve begins and stops to fill [s].
        count: muscles on one side; the run is that of one of them.
        lever: stroke of the muscle per stroke of the load.
        curves: of one muscle.
        margins: to each limit.
        parts: what is built in.
        spread: of the specimens; None when none were asked for.
        effects: effect id -> its parameters in the run.
        figures: "effect.parameter" -> where the value comes from.
        gas: how the air in the muscle is modelled.
    """

    rank: int
    proposal: ProposedDrive
    run: SimulationResult
    fill: tuple[float, float]
    count: int
    lever: float
    curves: ForceCurves
    margins: Sequence[Margin]
    parts: Sequence[Part]
    spread: SpecimenSpread | None
    effects: Mapping[str, Mapping[str, float]]
    figures: Mapping[str, Figure]
    gas: str


@dataclass(frozen=True)
class SizingMaterial:
    """Everything the report tells.

    Attributes:
        title: of the report.
        made: when.
        versions: program -> version.
        about: the task in one sentence.
        entries: every field of the task that applies.
        result: of the search.
        pair: whether the drive is an antagonist pair.
        profile: strokes [m] and forces [N] of a force over the stroke; empty without one.
        considered: kind of part -> ids that were tried.
        chosen: the proposal that is written down; None when nothing does the task.
        catalogue: effect id -> declaration.
        hashes: what -> SHA-256 of its canonical JSON.
        command: how to repeat it.
    """

    title: str
    made: datetime
    versions: Mapping[str, str]
    about: str
    entries: Sequence[Entry]
    result: SizingResult
    pair: bool
    profile: tuple[Sequence[float], Sequence[float]]
    considered: Mapping[str, Sequence[str]]
    chosen: Chosen | None
    catalogue: Mapping[str, Effect]
    hashes: Mapping[str, str]
    command: Command = field(default_factory=lambda: Command(()))
