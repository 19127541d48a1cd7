"""The measurements of a question, each with its own experiment, and the predictor for all of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from mckibben.documents.drive import DriveDocument
from mckibben.identification.predict import Predictor, predictor_of
from mckibben.identification.predict.specimens import (
    SpecimenData,
    SpecimensPredictor,
    own_geometry,
    own_muscle,
    zero_errors,
)
from mckibben.measurement.experiment import Experiment
from mckibben.measurement.measurement import STROKES, lengths
from mckibben.measurement.points import Points, joined
from mckibben.measurement.reduction import reduced
from mckibben.physics.muscle import Muscle
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.statics.model import StaticModel

_SAME = 1e-3  # relative; dimensions that differ by less are those of the same muscle
_LOADS = ("load_mass", "load_force", "supply_pressure")
_DRIVE_FIELDS = ("valve", "tube", "stops", "inclination", "supply", "load")


@dataclass(frozen=True)
class Specimen:
    """One measurement with its experiment.

    Attributes:
        points: the data, corrected by what the experiment states (zeros, load).
        muscle: geometry of this specimen.
        drive: of a transient measurement.
        experiment: every value with its origin.
        accuracy: channel -> standard deviation [SI].
        zeros: channel -> standard deviation of a zero error of its own, where there are several specimens.
        assumed_zeros: channels of these whose deviation is assumed. Such errors make specimens differ; what
            they have in common is left to the effects.
        document: of the drive, with what the experiment says of it.
    """

    points: Points
    muscle: Muscle
    drive: Drive | None = None
    experiment: Experiment = field(default_factory=dict)
    accuracy: Mapping[str, float] = field(default_factory=dict)
    zeros: Mapping[str, float] = field(default_factory=dict)
    assumed_zeros: frozenset[str] = frozenset()
    document: DriveDocument | None = None

    @property
    def name(self) -> str:
        """Name of the file or preset."""
        return self.points.measurement.name


@dataclass(frozen=True)
class Specimens:
    """The measurements of a question.

    Attributes:
        each: at least one.
        reference: muscle of the model to which those of the specimens are in proportion.
        points: all of them as one measurement.
        spread: geometry field -> standard deviation between the muscles, where fits may change it [SI].
    """

    each: tuple[Specimen, ...]
    reference: Muscle
    points: Points
    spread: Mapping[str, float] = field(default_factory=dict)

    @property
    def one_length(self) -> bool:
        """Whether all muscles have the same rest length."""
        lengths = [float(each.muscle.nominal_length) for each in self.each]
        return max(lengths) - min(lengths) <= _SAME * max(lengths)

    @property
    def remounted(self) -> bool:
        """Whether they are several muscles, mounted one after the other."""
        return any(not _same_muscle(specimen, self.each[0]) for specimen in self.each[1:])

    @property
    def several(self) -> bool:
        """Whether they differ in kind, geometry, load or drive, have own errors, or were prepared."""
        first = self.each[0]
        return any(
            not _alike(specimen, first)
            or specimen.points.measurement.kind != first.points.measurement.kind
            or specimen.accuracy
            or specimen.zeros
            for specimen in self.each[1:]
        ) or any(len(self.each) > 1 and one.points.measurement.prepared for one in self.each)

    def predictor(
        self, muscle: Muscle, most_rows: int | None = None
    ) -> tuple[Predictor, list[str], dict[str, int]]:
        """The predictor for all of them, what was done to long measurements, and rows left out by that.

        Args:
            muscle: of the model.
            most_rows: of a measurement that is not transient; longer ones are reduced.

        Raises:
            InputError: a measurement does not allow it.
        """
        if len(self.each) == 1 or not self.several:
            return _predictor(replace(self.each[0], points=self.points), muscle, most_rows)
        total = sum(specimen.points.measurement.rows for specimen in self.each)
        parts, notes, left_out = [], [], {}
        for specimen in self.each:
            share = None
            if most_rows is not None and total > most_rows:
                share = max(most_rows * specimen.points.measurement.rows // total, 1)
            own = own_muscle(muscle, reference=self.reference, own=specimen.muscle)
            predictor, said, lost = _predictor(specimen, own, share)
            data = SpecimenData(specimen.name, predictor, specimen.muscle)
            data = zero_errors(data, specimen.zeros, specimen.assumed_zeros)
            parts.append(own_geometry(data, self.spread))
            notes += [f"{specimen.name}: {note}" for note in said]
            for reason, rows in lost.items():
                left_out[reason] = left_out.get(reason, 0) + rows
        return SpecimensPredictor(parts, reference=self.reference), notes, left_out

    def labels(self, predictor: Predictor) -> np.ndarray:
        """Number of the specimen of each value of the predictor, shape (values,)."""
        if isinstance(predictor, SpecimensPredictor):
            return predictor.specimen
        return np.zeros(len(predictor.measured), dtype=np.int64)


def specimens_of(each: Sequence[Specimen], reference: Muscle) -> Specimens:
    """The measurements as one question.

    Raises:
        InputError: they are of different kinds.
    """
    return Specimens(tuple(each), reference, joined(_with_a_common_stroke(each)))


def _with_a_common_stroke(each: Sequence[Specimen]) -> list[Points]:
    """The data of each; where some state the length, others contraction or displacement, all by length."""
    measurements = [specimen.points.measurement for specimen in each]
    strokes = [set(STROKES) & set(measurement.columns) for measurement in measurements]
    if set.intersection(*strokes) or not all(strokes):
        return [specimen.points for specimen in each]
    changed = []
    for specimen, measurement in zip(each, measurements, strict=True):
        columns = {name: values for name, values in measurement.columns.items() if name not in STROKES}
        columns["length"] = lengths(measurement, float(specimen.muscle.nominal_length))
        changed.append(replace(specimen.points, measurement=replace(measurement, columns=columns)))
    return changed


def _predictor(
    specimen: Specimen, muscle: Muscle, most_rows: int | None
) -> tuple[Predictor, list[str], dict[str, int]]:
    measurement, drive = specimen.points.measurement, specimen.drive
    notes: list[str] = []
    left_out: dict[str, int] = {}
    if measurement.kind != "transient" and most_rows is not None and measurement.rows > most_rows:
        less = reduced(measurement, most_rows)
        left_out = dict(measurement.exclusions)
        measurement = less.measurement
        notes.append(less.message)
    if drive is not None and drive.muscle != muscle:
        drive = replace(drive, model=StaticModel.of(muscle, drive.model.effects, drive.model.values))
    return predictor_of(measurement, muscle, drive, specimen.accuracy), notes, left_out


def _alike(one: Specimen, other: Specimen) -> bool:
    """Whether two specimens are the same muscle in the same drive under the same load."""
    mine, theirs = one.points.measurement.conditions, other.points.measurement.conditions
    loads = all(mine.get(name) == theirs.get(name) for name in _LOADS)
    drives = all(
        getattr(one.experiment.get(name), "value", None) == getattr(other.experiment.get(name), "value", None)
        for name in _DRIVE_FIELDS
    )
    return _same_muscle(one, other) and loads and drives


def _same_muscle(one: Specimen, other: Specimen) -> bool:
    return all(
        abs(a - b) <= _SAME * max(abs(a), abs(b)) for a, b in zip(one.muscle, other.muscle, strict=True)
    )
