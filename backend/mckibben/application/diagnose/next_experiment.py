"""The next experiment of a diagnosis: what it would decide, and its set points as a table a rig can play."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import ClassVar

import numpy as np

from mckibben.facts.diagnosis import DIAGNOSIS
from mckibben.facts.result import Integers, Series, result_class
from mckibben.identification.diagnose.design import APART, DesignedExperiment
from mckibben.identification.diagnose.diagnosis import Diagnosis
from mckibben.identification.diagnose.next_measurement import SeparatingExperiment

#: Set point -> SI unit, column of the table, factor from SI.
_COLUMNS: Mapping[str, tuple[str, str, float]] = {
    "time": ("s", "time_s", 1.0),
    "pressure": ("Pa", "pressure_bar", 1e-5),
    "length": ("m", "length_mm", 1e3),
    "load": ("N", "load_N", 1.0),
    "command": ("1", "command", 1.0),
    "mass": ("kg", "load_mass_kg", 1.0),
    "supply": ("Pa", "supply_pressure_bar", 1e-5),
}


_TOLD = 4  # most pairs that the words name

#: Why there may be none.
NO_EXPERIMENT = "no two effects have to be distinguished, or no experiment of this rig would do it"


@result_class
class ExperimentProposal:
    """An experiment that separates two similar effects."""

    FIGURES: ClassVar = DIAGNOSIS.name

    pair: list[str]
    """The effects, that of the model first."""
    declared: str
    """What separates them according to the catalogue; empty without an entry."""
    protocol: str
    """How to do it, in words; empty where none of the known experiments separates them."""
    separation: float
    minutes: float | None
    matters: bool
    """Whether the two models predict different results for this rig."""
    difference: float


@result_class
class PairSeparation:
    """By how many standard deviations of one reading an experiment tells two effects apart."""

    FIGURES: ClassVar = DIAGNOSIS.name

    pair: list[str]
    """Ids of the two effects."""
    separation: float


@result_class
class SetPoints:
    """Values of one set point, in its SI unit."""

    unit: str
    """The SI unit."""
    values: Series
    """One value per row."""


@result_class
class NextExperiment:
    """The experiment that splits a group of indistinguishable effects best."""

    FIGURES: ClassVar = DIAGNOSIS.name

    group: list[str]
    """The effects, that of the model first."""
    protocol: str
    """How to do it, in words."""
    minutes: float
    separations: list[PairSeparation]
    """How well it tells each pair of the group apart."""
    run: Integers
    """Number of the run of each set point; time starts anew in each."""
    set_points: dict[str, SetPoints]
    """Time, and what the rig prescribes, linear between the rows."""


def proposal(pair: SeparatingExperiment) -> ExperimentProposal:
    """An experiment for one pair, as an answer."""
    return ExperimentProposal(
        [pair.first, pair.second],
        pair.declared,
        pair.protocol,
        pair.separation,
        pair.minutes,
        pair.matters,
        pair.difference,
    )


def next_experiment(design: DesignedExperiment) -> NextExperiment:
    """A designed experiment as an answer."""
    return NextExperiment(
        group=list(design.group),
        protocol=design.words,
        minutes=design.minutes,
        separations=[PairSeparation([s.first, s.second], s.sigma) for s in design.separations],
        run=design.schedule.run.astype(np.int64),
        set_points={
            name: SetPoints(_COLUMNS[name][0], np.asarray(values, dtype=float))
            for name, values in design.schedule.columns.items()
        },
    )


def next_measurement(diagnosis: Diagnosis, titles: Mapping[str, str]) -> str | None:
    """What to measure next, in words: the experiments that split a group, then what is declared.

    An entry that may be wrong comes before any experiment.
    """
    doubted = next((entry.entry for entry in diagnosis.context if entry.stands), None)
    if doubted is not None:
        return f"check {doubted.title}, before any other experiment"
    sentences = []
    for design in diagnosis.designs:
        names = {name: titles.get(name, name) for name in design.group}
        split = [s for s in design.separations if s.sigma >= APART]
        if split:
            parts = []
            for first in dict.fromkeys(s.first for s in split[:_TOLD]):
                others = [
                    f"{names[s.second]} ({s.sigma:.1f} sigma)" for s in split[:_TOLD] if s.first == first
                ]
                parts.append(f"{names[first]} from {_joined(others)}")
            minutes = max(design.minutes, 1.0)
            sentences.append(f"to tell {'; '.join(parts)}: {design.words} (about {minutes:.0f} min)")
    decided_pairs = {frozenset(pair) for d in diagnosis.designs for pair in d.decided()}
    rest = [p for p in diagnosis.proposals if frozenset((p.first, p.second)) not in decided_pairs]
    rest.sort(key=lambda pair: not pair.declared)
    sentences += [pair.sentence(titles) for pair in rest[: max(3 - len(sentences), 1)]]
    return "; ".join(sentences) or None


def _joined(names: Sequence[str]) -> str:
    return f"{', '.join(names[:-1])} and {names[-1]}" if len(names) > 1 else "".join(names)


def schedule_csv(experiment: NextExperiment) -> str:
    """The set points as text that a rig can play and this program can read.

    Lines before the header say what is done; columns are run, time and the prescribed quantities.
    """
    names = list(experiment.set_points)
    lines = [
        f"# protocol: {experiment.protocol}",
        f"# decides between: {', '.join(experiment.group)}",
        "# set points, linear between the rows; time starts anew in each run",
        ",".join(["run", *(_COLUMNS[name][1] for name in names)]),
    ]
    columns = [experiment.set_points[name].values * _COLUMNS[name][2] for name in names]
    lines += [
        ",".join([str(int(run)), *(f"{value:.6g}" for value in row)])
        for run, *row in zip(experiment.run, *columns, strict=True)
    ]
    return "\n".join(lines) + "\n"
