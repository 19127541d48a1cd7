"""Result of a diagnosis: candidates, path, verdict, and models that can be used in further requests."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from mckibben.application.compare import ModelDocument
from mckibben.application.doubts import DoubtfulEntry
from mckibben.application.envelope import MeasuredRange
from mckibben.application.experiment_result import SpecimenResult
from mckibben.application.measurements import UnreadColumn
from mckibben.application.model_question import EffectDocument
from mckibben.application.muscle_summary import GeometrySummary
from mckibben.application.next_experiment import ExperimentProposal, NextExperiment
from mckibben.identification.diagnose.diagnosis import NotTried
from mckibben.identification.diagnose.verdict import Status
from mckibben.identification.fit.comparison import ChannelMisfit, Correlation, ParameterTable, ParameterValue
from mckibben.identification.fit.least_squares import FittedCovariance
from mckibben.identification.predict.reading_errors import AbsorbedError
from mckibben.identification.residual.profiles import Profile
from mckibben.measurement.experiment import Experiment

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Baseline:
    """The start model as given: error, error in percent of full scale, hold-out error."""

    rmse: float
    nrmse_percent: float | None
    holdout_rmse: float


@dataclass(frozen=True, slots=True)
class NoiseFloor:
    """Noise of the data, None when it cannot be estimated, and how it was obtained.

    ``interval``: from the scatter of neighbouring readings to all that no variable explains; None where a
    structure remains.
    """

    rmse: float | None
    how: str
    interval: list[float] | None


@dataclass(frozen=True, slots=True)
class CandidateResult:
    """The start model with one more effect, all parameters refitted.

    Attributes:
        effect, title, equation: id, name and LaTeX of the effect.
        gain_percent: relative reduction of the error.
        score_change: change of the score; negative is better.
        twins: candidates that the data cannot distinguish from it.
        why: reasons for and against it.
        freed: further constants that were freed.
        next_measurement: measurement that would separate it from its first twin.
        model: in the form of a request.
        probability: that it, or one of its twins in the best model, is missing; None while the search runs.
    """

    JSON_KEYS: ClassVar = {"score_change": ("score_change", "delta_bic")}  # the old name, for one version

    effect: str
    title: str
    rmse: float
    holdout_rmse: float
    gain_percent: float
    score_change: float
    parameters: dict[str, ParameterValue]
    twins: list[str]
    why: str
    equation: str
    freed: list[str]
    next_measurement: str | None
    model: ModelDocument
    probability: float | None = None


@dataclass(frozen=True, slots=True)
class CorrectionResult:
    """An effect that lowers the error, but not by more than an inexact form of another effect explains.

    ``probability``: that it is missing nevertheless; ``kept``: whether the model keeps it.
    """

    effect: str
    rmse_before: float
    rmse_after: float
    probability: float
    kept: bool


@dataclass(frozen=True, slots=True)
class PathPoint:
    """The error after each addition; the first is the start model as given, then its own numbers refitted.

    Corrections, which are kept but not called missing, come last. ``fitted``: number of fitted values; with 0
    no group was left out of anything, and ``holdout_rmse`` equals ``rmse``.
    """

    added: str | None
    refitted: bool
    correction: bool
    rmse: float
    holdout_rmse: float
    model: ModelDocument
    freed: list[str]
    fitted: int


@dataclass(frozen=True, slots=True)
class SamePeriod:
    """A period over another coordinate that the data cannot tell from the repetition; SI."""

    over: str
    period: float


@dataclass(frozen=True, slots=True)
class RepetitionResult:
    """A periodic part of the unexplained residual, SI.

    Attributes:
        over, unit: coordinate, ``length``, ``pressure`` or ``time``, and its unit.
        period: in it.
        share: explained part of the mean square.
        amplitude: of the predicted channel, in its unit, at the mean pressure where it grows.
        grows_with_pressure: whether its amplitude is in proportion to the pressure.
        false_alarm: chance that noise does as well somewhere among all periods tried.
        left_out_share: share explained of sweeps that it was not fitted to.
        parts, shown, parts_are: number of records or sweeps, of those that the others predict, which it is.
        also: periods over other coordinates that the data cannot tell from it.
        text: all of it in words.
    """

    over: str
    unit: str
    period: float
    share: float
    amplitude: float
    grows_with_pressure: bool
    false_alarm: float
    left_out_share: float
    parts: int
    shown: int
    parts_are: Literal["records", "sweeps"]
    also: list[SamePeriod]
    text: str


@dataclass(frozen=True, slots=True)
class TermCurve:
    """A proposed term and the residual that it describes, over one variable."""

    x: str
    values: Array
    term: Array
    residual: Array


@dataclass(frozen=True, slots=True)
class TermProposal:
    """A formula for the unexplained residual; share: explained part of its mean square."""

    formula: str
    coefficients: dict[str, float]
    share: float
    model: ModelDocument
    curve: TermCurve


@dataclass(frozen=True, slots=True)
class Verdict:
    """Verdict of a diagnosis.

    Attributes:
        status: adequate, missing_effects, ambiguous or unknown_effect (also where it is likelier
            that none of the named effects is missing).
        title: the status in words.
        effects: the missing effects.
        indistinguishable: groups of effects that the data cannot distinguish.
        probabilities: effect -> probability that it, or one of its group, is missing; a group shares one.
        applied: effect of the model with a group -> why this one of its group.
        corrections: effects that lower the error but are not called missing; the model keeps some of them.
        unexplained_share, unexplained_in: what is left to explain of the residual, and the variables it
            depends on; of an unknown effect at least all above the noise.
        repeats: what of it is periodic.
        proposed_term: a short formula for it that halves the error of the groups left out.
        where_to_look: without a formula, the ranges of these variables with the largest error.
        at_bounds: the missing effects whose values ended at the bound of the search; None without any.
        next_measurement: recommended next measurement.
        experiments: for each pair of effects that the data cannot distinguish.
        next_experiments: for each group of them that an experiment of the rig splits, the best one, and
            one for the pairs that it leaves; the group that is split best comes first.
        sentence: the verdict in one to four sentences.
    """

    status: Status
    title: str
    effects: list[str]
    indistinguishable: list[list[str]]
    probabilities: dict[str, float]
    applied: dict[str, str]
    corrections: list[CorrectionResult]
    unexplained_share: float
    unexplained_in: list[str]
    repeats: RepetitionResult | None
    proposed_term: TermProposal | None
    where_to_look: str | None
    at_bounds: str | None
    next_measurement: str | None
    experiments: list[ExperimentProposal]
    next_experiments: list[NextExperiment]
    sentence: str


@dataclass(frozen=True, slots=True)
class DiagnosedModel:
    """The best model of a diagnosis, in the form of a request.

    Attributes:
        muscle: fitted geometry; of muscles of several lengths without one: it is that of each measurement.
        effects: with all their values.
        drive: of a transient, the drive document of the first measurement, muscle and effects inside; None
            where there is no drive.
    """

    muscle: dict[str, float]
    effects: EffectDocument
    drive: Mapping[str, object] | None = None

    def to_document(self) -> dict[str, object]:
        """The keys of an answer; without a drive where there is none."""
        known = {"muscle": self.muscle, "effects": self.effects}
        return known if self.drive is None else {**known, "drive": dict(self.drive)}


@dataclass(frozen=True, slots=True)
class DiagnosisResult:
    """The missing effects of a model, with the evidence; SI.

    Attributes:
        kind, predicted, unit: as in a comparison.
        rows, rows_used: number of rows, and of those used.
        excluded: reason -> number of rows that are not used.
        where: the start model's residual over each variable.
        candidates: single additions, the best first.
        path: steps to the best model; each adds the effect that lowers the error most.
        parameters, correlations, geometry, model, freed: of the best model.
        not_tried: effects that were not candidates, with the reason.
        messages: notes for the user.
        experiment: values of the experiment in which all measurements agree.
        assumptions: what nobody said and was assumed; they also begin messages and verdict.
        specimens: each measurement, with the error of the best model on it.
        context: entries that may be wrong instead, the most convincing first.
        absorbed: errors of readings within the accuracy.
        envelope: quantity -> range in which the model was measured.
        covariance: of the fitted values; None where the data cannot separate them.
        unread: columns of the files that nothing is read from, and why.
    """

    rows: int
    rows_used: int
    excluded: dict[str, int]
    kind: str
    predicted: str
    unit: str
    baseline: Baseline
    noise_floor: NoiseFloor
    channels: dict[str, ChannelMisfit]
    where: list[Profile]
    candidates: list[CandidateResult]
    path: list[PathPoint]
    verdict: Verdict
    parameters: ParameterTable
    correlations: list[Correlation]
    geometry: GeometrySummary
    model: DiagnosedModel
    freed: list[str]
    not_tried: list[NotTried]
    messages: list[str]
    experiment: Experiment
    assumptions: list[str]
    specimens: list[SpecimenResult]
    absorbed: list[AbsorbedError]
    context: list[DoubtfulEntry]
    envelope: dict[str, MeasuredRange]
    covariance: FittedCovariance | None
    unread: list[UnreadColumn]
