"""What the report of a diagnosis is made of."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from typing import NamedTuple

from mckibben.application.compare import ComparisonResult
from mckibben.application.diagnosis_result import DiagnosisResult
from mckibben.application.measurements import MeasurementSummary
from mckibben.physics.effect import Effect
from mckibben.report.command import Command
from mckibben.report.sources import Figure


@dataclass(frozen=True)
class DataSource:
    """One measurement.

    Attributes:
        name: of the file, or the id of a built-in measurement.
        identity: SHA-256 of an uploaded file, "" of a built-in measurement.
        origin: who measured a built-in one.
        use: "fit" or "validation".
        about: how the measurement was understood.
        left_out: why rows were left out -> how many.
    """

    name: str
    identity: str
    origin: str
    use: str
    about: MeasurementSummary
    left_out: Mapping[str, int]


@dataclass(frozen=True)
class MuscleFacts:
    """What is known of the muscle besides its geometry.

    Attributes:
        preset: id and title of the preset it is based on, "" without one.
        figures: geometry field -> source, of what is the preset's own.
        limits: what the maker allows: name -> value, SI unit, source.
    """

    preset: str = ""
    figures: Mapping[str, Figure] = field(default_factory=dict)
    limits: Mapping[str, tuple[float, str, Figure]] = field(default_factory=dict)


class PastModel(NamedTuple):
    """A model on the way to this one: its name, its effects, its comparison."""

    label: str
    effects: Sequence[str]
    comparison: ComparisonResult


@dataclass(frozen=True)
class DiagnosisMaterial:
    """Everything the report tells.

    Attributes:
        title: of the report.
        made: when.
        versions: program -> version.
        sources: the measurements.
        muscle: what is known of it.
        catalogue: effect id -> declaration, of all that are named.
        comparison: the model as given beside the data.
        figures: "effect.parameter" -> where the given value comes from.
        diagnosis: None when none was asked for.
        proposed: comparison of the model that the diagnosis ends with, None without one.
        history: models on the way to the given one.
        drive: valve, tube, load and the like in words, of transient measurements.
        unverified: figures that nobody verified, in words.
        command: how to repeat it.
    """

    title: str
    made: datetime
    versions: Mapping[str, str]
    sources: Sequence[DataSource]
    muscle: MuscleFacts
    catalogue: Mapping[str, Effect]
    comparison: ComparisonResult
    figures: Mapping[str, Figure]
    command: Command
    diagnosis: DiagnosisResult | None = None
    proposed: ComparisonResult | None = None
    history: Sequence[PastModel] = ()
    drive: Sequence[tuple[str, str]] = ()
    unverified: Sequence[str] = ()

    def title_of(self, effect: str) -> str:
        """An effect in the field's own words."""
        known = self.catalogue.get(effect)
        return known.title if known else effect.replace("_", " ")
