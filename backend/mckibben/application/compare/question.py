"""A model and measurements: the common input of comparisons, diagnoses and their reports."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from mckibben.application.compare.specimens import Specimens
from mckibben.application.envelope import Envelope
from mckibben.application.measurement.experiment import (
    Assumption,
    QuestionMeasurement,
    QuestionModel,
    resolved,
)
from mckibben.application.measurement.summary import UnreadColumn, unread_sentence
from mckibben.documents.start_model import StartModel, StatedMuscle
from mckibben.documents.studio import Studio
from mckibben.identification.diagnose.entries import StatedEntry
from mckibben.identification.predict import Predictor
from mckibben.identification.predict.fit_model import LOAD, START, FitModel, Free, free_geometry
from mckibben.measurement.measurement import Measurement
from mckibben.measurement.points import Points
from mckibben.physics.custom import CUSTOM, TERM
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.simulation.drive.parts import Drive

#: Effects in the form of a request: effect id -> parameter -> value; a custom term with its text.
EffectDocument = dict[str, dict[str, float | str]]


@dataclass(frozen=True)
class ModelQuestion:
    """A start model and the measurements that it is compared with.

    Attributes:
        start: muscle and effects; its length is that of the first measurement.
        specimens: data for fits, each measurement with its experiment.
        validation: data that models are not fitted to.
        free: geometry fields that fits may change as well, within their tolerance; `START`: starts of runs.
        freed: further constants that fits may change, as "effect.parameter".
        noise: standard deviation of the predicted channel, when it is known [SI].
        assumptions: what nobody said and was assumed.
        accepted: entries that the user has accepted as wrong: channels are read in other ways already,
            quantities are fitted.
        kept: hypotheses of wrong entries that the user has ruled out.
        remarks: notes on the experiment for the user.
        envelope: quantity -> range in which the model was measured, if it is a saved one.
        load_force: of isotonic data that do not state their load, where a fit begins [N].

    Raises:
        InputError: a geometry field to be fitted is not stated.
    """

    start: StartModel
    specimens: Specimens
    validation: Specimens | None = None
    free: Sequence[str] = ()
    freed: Sequence[str] = ()
    noise: float | None = None
    assumptions: tuple[Assumption, ...] = ()
    remarks: tuple[str, ...] = ()
    accepted: tuple[StatedEntry, ...] = ()
    kept: frozenset[str] = frozenset()
    envelope: Envelope = field(default_factory=dict)
    load_force: float = 0.0

    def __post_init__(self) -> None:
        for name in self.free:
            if name in self.start.assumed:
                raise InputError(
                    f"the muscle's {name.replace('_', ' ')} is not known, so no fit can start from it",
                    field=f"muscle.{name}",
                    hint=f"state {name}, or remove it from 'free'",
                )

    @property
    def points(self) -> Points:
        """All measurements for fits as one."""
        return self.specimens.points

    @property
    def curve_fit(self) -> str:
        """What the drive was fitted to, with parts that do not exist; "" of a drive, or without one."""
        return "" if self.drive is None else self.drive.curve_fit

    @property
    def drive(self) -> Drive | None:
        """Drive of the first measurement, if it is transient."""
        return self.specimens.each[0].drive

    @cached_property
    def predictor(self) -> Predictor:
        """The data to fit to, read once for comparison, diagnosis and report.

        Raises:
            InputError: the measurement does not allow it.
        """
        return self.specimens.predictor(self.start.muscle)[0]

    @property
    def opening(self) -> list[str]:
        """How every answer begins: what was assumed, and remarks on the experiment."""
        return [*(assumption.message for assumption in self.assumptions), *self.remarks]

    @property
    def unread(self) -> list[UnreadColumn]:
        """Columns of the files that nothing is read from, and why; those of validation data come last."""
        return [UnreadColumn(column, why) for m in self._measurements for column, why in m.unread]

    @property
    def unread_messages(self) -> list[str]:
        """A sentence on the unread columns of each file, without those that its messages name already."""
        measurements = self._measurements
        several = len(measurements) > 1
        sentences = [(m.name, unread_sentence(m)) for m in measurements]
        return [f"{name}: {text}" if several else text for name, text in sentences if text]

    @property
    def _measurements(self) -> list[Measurement]:
        parts = [self.specimens] if self.validation is None else [self.specimens, self.validation]
        return [specimen.points.measurement for part in parts for specimen in part.each]

    @property
    def tolerance(self) -> Mapping[str, float]:
        """Geometry field -> largest change by a fit, from the preset."""
        return {} if self.start.preset is None else self.start.preset.tolerance

    def fit_model(self) -> FitModel:
        """The start model in the form for fits."""
        start = self.start
        effects = tuple(start.catalogue[name] for name in start.effects)
        return FitModel(
            start.muscle.checked(),
            effects,
            start.effects,
            self.load_force,
            frozenset(start.assumed),
            size=start.muscle.size,
        )

    def free_geometry(self) -> tuple[Free, ...]:
        """The freed geometry with its bounds: within the tolerance, or within what is plausible where an
        entry is accepted as wrong.

        Raises:
            InputError: a name is not a geometry field, or its value is not known.
        """
        wrong = [entry.free for entry in self.accepted if entry.free is not None and entry.free.name != LOAD]
        names = [name for name in self.free if name not in {free.name for free in wrong} and name != START]
        starts = self.predictor.free_starts() if START in self.free else ()
        return (*free_geometry(self.start.muscle, names, self.tolerance), *wrong, *starts)

    @property
    def free_load(self) -> Free | None:
        """The stated load with its plausible range, where it is accepted as wrong."""
        loads = (entry.free for entry in self.accepted if entry.free is not None)
        return next((free for free in loads if free.name == LOAD), None)

    def effect_document(self, fit_model: FitModel) -> EffectDocument:
        """The effects of a model in the form of a request, a custom term with its text."""
        document: EffectDocument = {name: dict(values) for name, values in fit_model.values.items()}
        if CUSTOM in document and self.start.term is not None:
            document[CUSTOM] = {TERM: self.start.term, **document[CUSTOM]}
        return document

    def with_data_of(self, other: ModelQuestion) -> ModelQuestion:
        """This question, with the predictor of another one if their data are the same.

        The data depend on length and braid of the muscle, but not on the effects of the model.
        """
        mine, theirs = self.start.muscle, other.start.muscle
        if (
            self.specimens is other.specimens
            and mine[:3] == theirs[:3]
            and (self.drive is None) == (other.drive is None)
        ):
            self.__dict__["predictor"] = other.predictor
        return self


def question_of(
    model: QuestionModel,
    measurements: Sequence[QuestionMeasurement],
    studio: Studio,
    *,
    free: Sequence[str] = (),
    freed: Sequence[str] = (),
    strict: bool = False,
) -> ModelQuestion:
    """A checked question.

    Args:
        model: muscle, effects and drive, as they were stated.
        measurements: the data, with what was stated about each.
        studio: presets and effects.
        free, freed: see `ModelQuestion`.
        strict: refuse instead of assuming.

    Raises:
        InputError: a value out of bounds, an impossible geometry, an unknown constant, two statements that
            contradict each other, or a value that nobody stated and that cannot be assumed.
    """
    found = resolved(model, measurements, studio, strict=strict)
    start = found.start
    studio.static_model(start)
    known = {f"{effect.id}.{p.name}" for effect in start.catalogue.values() for p in effect.parameters}
    for place, name in enumerate(freed):
        if name not in known:
            similar = {each for each in known if each.startswith(name.partition(".")[0])} or known
            raise InputError(
                f"there is no constant '{name}'", field=f"freed.{place}", hint=did_you_mean(name, similar)
            )
    question = ModelQuestion(
        start, found.specimens, found.validation, free, freed, None, found.assumptions, found.remarks
    )
    if not found.specimens.remounted:
        return question
    # Each of several muscles has dimensions of its own: two standard deviations within the tolerance.
    spread = {each.name: 0.5 * (each.upper - each.start) for each in question.free_geometry()}
    return replace(question, specimens=replace(found.specimens, spread=spread))


def with_model(
    question: ModelQuestion,
    studio: Studio,
    muscle: StatedMuscle,
    effects: Mapping[str, Mapping[str, float | str]],
    *,
    freed: Sequence[str] = (),
) -> ModelQuestion:
    """The same question for another model of the same sample, without freed geometry.

    Raises:
        InputError: a geometry, effect or value that cannot be used.
    """
    start = replace(studio.start_model(muscle, effects), preset=question.start.preset)
    studio.static_model(start)
    other = replace(question, start=start, free=(), freed=freed)
    return other.with_data_of(question)
