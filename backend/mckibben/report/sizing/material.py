"""Content of a sizing report."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from typing import NamedTuple

from mckibben.application.run.simulate import SimulationResult
from mckibben.application.size.size import ProposedDrive, SizingResult
from mckibben.documents.task import TaskOperation
from mckibben.physics.effect import Effect
from mckibben.report.command import Command
from mckibben.report.sources import Figure


class Entry(NamedTuple):
    """A field of the task.

    Attributes:
        path: "limits.max_length".
        value: in SI, or text; None where nothing is demanded.
        stated: whether the task states it; otherwise it is the default.
        about: its meaning, and the reason for the default.
    """

    path: str
    value: float | str | None
    stated: bool
    about: str


class KnownFigure(NamedTuple):
    """A figure of a part used in the sizing: name, value, its unit, source and a remark."""

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
        order: title of the preset, with the length of parts cut to length.
        code: what its order code begins with; None where the series has none that is known.
        maker: of the part.
        origin: "built-in" or "user" preset.
        figures: those used in the sizing.
        references: of the preset.
    """

    kind: str
    id: str
    number: int
    order: str
    code: str | None
    maker: str
    origin: str
    figures: Sequence[KnownFigure]
    references: Sequence[str]


class Margin(NamedTuple):
    """Distance to a limit.

    Attributes:
        name: of the limit, of `mckibben.facts.sizing.LIMITS`.
        allowed, actual: its value and that of the drive, SI.
        upper: whether it is an upper limit.
        share: the margin, as `mckibben.facts.sizing` defines it.
    """

    name: str
    allowed: float
    actual: float
    upper: bool
    share: float


@dataclass(frozen=True)
class ForceCurves:
    """Static force of one muscle over its contraction, and the force demanded of it.

    Attributes:
        contraction: of the columns [-].
        pressures: gauge, ascending, the supply pressure last [Pa].
        force: shape (pressures, columns) [N].
        places: contractions over the stroke [-].
        demand: force demanded of one muscle at ``places``, including ``counter`` [N].
        counter: force of the empty second muscle of a pair [N].
        carrying: pressures that just carry the load at the start and at the end [Pa].
        run: demand used in the run, if that differs; else empty [N].
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
    """How the simulated specimens differ.

    Attributes:
        blocked_force: two standard deviations, share of the blocked force.
        shift: one standard deviation of the shift of the curve along the contraction [-].
        hysteresis: largest width of the loop, share of the rest length; None if unknown.
        friction: largest friction force of one muscle [N].
        supply: largest deviation of the supply pressure, share of it.
        demands: what a specimen must achieve, in words.
    """

    blocked_force: float
    shift: float
    hysteresis: float | None
    friction: float
    supply: float
    demands: Sequence[str]


@dataclass(frozen=True)
class Chosen:
    """The reported proposal.

    Attributes:
        rank: 1 is the best.
        proposal: the drive.
        run: its simulation.
        fill: when the valve starts and stops filling [s].
        count: muscles on one side; ``run`` simulates one of them.
        curves: of one muscle.
        margins: to each limit, the smallest first.
        parts: parts list.
        spread: of the specimens; None if none were simulated.
        effects: effect id -> its parameters in the run.
        figures: "effect.parameter" -> source of the value.
        gas: how the air in the muscle is modelled.
    """

    rank: int
    proposal: ProposedDrive
    run: SimulationResult
    fill: tuple[float, float]
    count: int
    curves: ForceCurves
    margins: Sequence[Margin]
    parts: Sequence[Part]
    spread: SpecimenSpread | None
    effects: Mapping[str, Mapping[str, float]]
    figures: Mapping[str, Figure]
    gas: str


@dataclass(frozen=True)
class SizingMaterial:
    """Everything the report contains.

    Attributes:
        title: of the report.
        made: date and time.
        versions: program -> version.
        entries: every field of the task that applies.
        result: of the search.
        pair: whether the drive is an antagonist pair.
        operation: cycles per year and price of the air.
        profile: strokes [m] and forces [N] of a force over the stroke; empty without one.
        chosen: the reported proposal; None if there is none.
        catalogue: effect id -> declaration.
        hashes: file -> SHA-256 of its canonical JSON.
        command: how to reproduce it.
    """

    title: str
    made: datetime
    versions: Mapping[str, str]
    entries: Sequence[Entry]
    result: SizingResult
    pair: bool
    operation: TaskOperation
    profile: tuple[Sequence[float], Sequence[float]]
    chosen: Chosen | None
    catalogue: Mapping[str, Effect]
    hashes: Mapping[str, str]
    command: Command = field(default_factory=lambda: Command(()))
