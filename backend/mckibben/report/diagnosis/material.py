"""Content of a diagnosis report."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from typing import NamedTuple

from mckibben.application.compare.compare import ComparisonResult
from mckibben.application.diagnose.result import DiagnosisResult
from mckibben.application.measurement.summary import MeasurementSummary
from mckibben.physics.effect import Effect
from mckibben.report.command import Command
from mckibben.report.sources import Figure


@dataclass(frozen=True)
class DataSource:
    """One measurement.

    Attributes:
        name: of the file, or the id of a built-in measurement.
        identity: SHA-256 of an uploaded file, "" of a built-in measurement.
        origin: who made a built-in measurement.
        use: "fit" or "validation".
        about: how the measurement was read.
        left_out: reason -> number of rows left out.
    """

    name: str
    identity: str
    origin: str
    use: str
    about: MeasurementSummary
    left_out: Mapping[str, int]


@dataclass(frozen=True)
class MuscleFacts:
    """What is known about the muscle besides its geometry.

    Attributes:
        preset: id and title of the preset it is based on, "" without one.
        figures: geometry field -> source, for values taken from the preset.
        limits: of the maker: name -> value, SI unit, source.
    """

    preset: str = ""
    figures: Mapping[str, Figure] = field(default_factory=dict)
    limits: Mapping[str, tuple[float, str, Figure]] = field(default_factory=dict)


class PastModel(NamedTuple):
    """An earlier model: its name, its effects, its comparison."""

    label: str
    effects: Sequence[str]
    comparison: ComparisonResult


@dataclass(frozen=True)
class DiagnosisMaterial:
    """Everything the report contains.

    Attributes:
        title: of the report.
        made: date and time.
        versions: program -> version.
        sources: the measurements.
        muscle: preset, sources and limits of the muscle.
        catalogue: effect id -> declaration.
        comparison: the given model against the data.
        figures: "effect.parameter" -> source of the given value.
        diagnosis: None if none was requested.
        proposed: comparison of the final model of the diagnosis, None without one.
        history: earlier models, the oldest first.
        drive: name and value of valve, load and the like, for transient measurements.
        unverified: figures that were not verified, in words.
        command: how to reproduce it.
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
        """Title of an effect; of an unknown one, its id in words."""
        declared = self.catalogue.get(effect)
        return declared.title if declared else effect.replace("_", " ")
