"""Result of a diagnosis: candidates, path, verdict, and models that can be used in further requests."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from mckibben.application.compare.compare import ModelDocument
from mckibben.application.compare.judged import Proofs, Rival, SuspectRow
from mckibben.application.compare.question import EffectDocument
from mckibben.application.compare.reach import RunReach
from mckibben.application.compare.windows import WindowsResult
from mckibben.application.diagnose.doubts import DoubtfulEntry
from mckibben.application.diagnose.next_experiment import ExperimentProposal, NextExperiment
from mckibben.application.envelope import MeasuredRange
from mckibben.application.measurement.specimen_result import SpecimenResult
from mckibben.application.measurement.summary import UnreadColumn
from mckibben.application.muscle_summary import GeometrySummary
from mckibben.facts.comparison import CHECK, NOISE
from mckibben.facts.diagnosis import DIAGNOSIS
from mckibben.facts.result import Number, Series, result_class
from mckibben.identification.diagnose.stages import NotTried
from mckibben.identification.diagnose.swept_rows import Coordinate, Over
from mckibben.identification.diagnose.verdict import Status
from mckibben.identification.fit.comparison import ChannelMisfit, Correlation, ParameterTable, ParameterValue
from mckibben.identification.fit.least_squares import FittedCovariance
from mckibben.identification.predict.reading_errors import AbsorbedError
from mckibben.identification.residual.profiles import Profile
from mckibben.measurement.experiment import Experiment

Array = NDArray[np.float64]


@result_class
class Baseline:
    """The error of the start model as given."""

    FIGURES: ClassVar = DIAGNOSIS.name

    rmse: float
    nrmse_percent: float | None
    holdout_rmse: float


@result_class
class NoiseFloor:
    """Noise of the data, None when it cannot be estimated, and how it was obtained."""

    FIGURES: ClassVar = NOISE.name

    rmse: float | None
    how: str
    """How it was estimated."""
    interval: list[float] | None


@result_class
class CandidateResult:
    """The start model with one more effect, all parameters refitted."""

    FIGURES: ClassVar = DIAGNOSIS.name

    effect: str
    """Its id."""
    title: str
    """Its name."""
    rmse: float
    holdout_rmse: float
    gain_percent: float
    score_change: float
    """What the search compares models by; no figure of the model."""
    parameters: dict[str, ParameterValue]
    """Effect -> parameter -> value."""
    twins: list[str]
    """Candidates that these data cannot distinguish from it."""
    why: str
    """What speaks for and against it."""
    equation: str
    """LaTeX."""
    freed: list[str]
    """Constants of other effects that were fitted with it, as effect.parameter."""
    next_measurement: str | None
    """Experiment that separates it from its first twin."""
    model: ModelDocument
    """The model with it."""
    probability: float | None = None


@result_class
class CorrectionResult:
    """An effect that lowers the error and is not called missing."""

    FIGURES: ClassVar = DIAGNOSIS.name

    effect: str
    """Its id."""
    rmse_before: float
    rmse_after: float
    probability: float
    kept: bool
    """Whether the model keeps it, because it predicts better with it."""
    why: str
    """Why it is not called missing, in words."""


@result_class
class PathPoint:
    """The error after each addition; the first is the start model as given, then its own numbers refitted.

    Corrections, which are kept but not called missing, come last.
    """

    FIGURES: ClassVar = DIAGNOSIS.name

    added: str | None
    """The added effect; None in the steps of the start model."""
    refitted: bool
    """The start model with its own numbers fitted, before any effect."""
    correction: bool
    """The added effect is kept, but not called missing."""
    rmse: float
    holdout_rmse: float
    model: ModelDocument
    """The model after the step."""
    freed: list[str]
    """Constants fitted as well, as effect.parameter."""
    fitted: int


@result_class
class SamePeriod:
    """A period over another coordinate that the data cannot tell from the repetition; SI."""

    over: Coordinate
    """The coordinate."""
    period: float
    """In m, Pa or s."""


@result_class
class RepetitionResult:
    """A periodic part of the unexplained residual, SI."""

    FIGURES: ClassVar = DIAGNOSIS.name

    over: Over
    """What it repeats over."""
    unit: Literal["m", "Pa", "s", "1"]
    """Unit of the period."""
    period: float
    share: float
    amplitude: float
    grows_with_pressure: bool
    """Whether its amplitude is in proportion to the pressure."""
    parts: int
    """Number of records, or of sweeps."""
    shown: int
    """Number of those that a fit to the others explains."""
    also: list[SamePeriod]
    """Periods over other coordinates that the data cannot tell from it."""
    text: str
    """All of it in words."""


@result_class
class TermCurve:
    """A proposed term and the residual that it describes, over one variable."""

    x: str
    """The variable."""
    values: Series
    """Its values, SI."""
    term: Series
    """The term there, SI."""
    residual: Series
    """The residual that it is to explain, SI."""


@result_class
class TermProposal:
    """A formula for the unexplained residual."""

    FIGURES: ClassVar = DIAGNOSIS.name

    formula: str
    """The formula, as a custom effect takes it."""
    kind: Literal["short", "smooth"]
    """A short formula that halves the error on groups that were left out, or a smooth description of the
    unexplained rest, which explains nothing.
    """
    coefficients: dict[str, float]
    """Its constants, SI."""
    share: float
    band: float
    """Error with the term on groups that were left out, SI: how far it may be off within the data."""
    model: ModelDocument
    """The model with the term."""
    curve: TermCurve
    """The term and the residual."""


@result_class
class Verdict:
    """Verdict of a diagnosis."""

    FIGURES: ClassVar = DIAGNOSIS.name
    CORRECTING: ClassVar = ("sentence",)

    status: Status
    """The verdict as a word for programs: the model is at the noise (adequate); effects bring it there
    (missing_effects), some of which the data cannot tell from others (ambiguous); a rest with structure
    stays that no catalogued effect explains, or it is likelier that none of those named is missing
    (unknown_effect); the data cannot tell whether the rest is noise (undecided); the limit of time ended the
    diagnosis, and this is what was found until then (unfinished).
    """
    title: str
    """The status in words."""
    effects: list[str]
    """Ids of the missing effects; unfinished: of those found so far."""
    indistinguishable: list[list[str]]
    """Groups of effects that the data cannot distinguish."""
    probabilities: dict[str, float]
    """Effect -> probability that it, or one of its group, is missing; a group shares one."""
    applied: dict[str, str]
    """Effect of the model that data cannot tell from others -> why this one was taken."""
    corrections: list[CorrectionResult]
    """Effects that lower the error but are not called missing; the model keeps some of them."""
    superfluous: list[str]
    """Effects of the start model that the data do not need: without all of them the model is as good."""
    proofs: Proofs | None
    """Of the best model; None where the limit of time ended the diagnosis before."""
    why_not: dict[str, str]
    """Proof that does not hold, or is not decided -> why."""
    unexplained_share: float
    unexplained_in: list[str]
    """Variables that this part depends on."""
    repeats: RepetitionResult | None
    """What of it is periodic; None where nothing is beyond doubt, or no effect is unknown."""
    proposed_term: TermProposal | None
    """A formula for it: a short one, or else a smooth description."""
    where_to_look: str | None
    """Without a formula: the ranges in which the unexplained error is largest."""
    at_bounds: str | None
    """Missing effects whose values ended at the bound of the search; None without any."""
    next_measurement: str | None
    """Recommended next measurement; None where none is needed."""
    experiments: list[ExperimentProposal]
    """For each pair of effects that the data cannot distinguish."""
    next_experiments: list[NextExperiment]
    """For each group of effects that an experiment of this rig splits the best one, and a second one for the
    pairs that it leaves together; the group that is split best comes first.
    """
    sentence: str
    """The verdict in one to four sentences."""


@result_class
class DiagnosedModel:
    """The best model of a diagnosis, in the form of a request."""

    muscle: dict[str, float]
    """Fitted geometry, SI; of muscles of several lengths without one: it is that of each measurement."""
    effects: EffectDocument
    """Effect id -> all its values, SI."""
    drive: Mapping[str, object] | None = None
    """Of a transient, the drive document of the first measurement, muscle and effects inside; left out where
    there is no drive.
    """

    def to_document(self) -> dict[str, object]:
        """The keys of an answer; without a drive where there is none."""
        known = {"muscle": self.muscle, "effects": self.effects}
        return known if self.drive is None else {**known, "drive": dict(self.drive)}


@result_class
class CheckError:
    """The error of the best model for measurements that no model of the search was fitted to."""

    FIGURES: ClassVar = CHECK.name

    rmse: Number
    nrmse_percent: Number
    rows_used: int


@result_class
class DiagnosisResult:
    """The missing effects of a model, with the evidence; SI."""

    CORRECTING: ClassVar = (
        "messages",
        "assumptions",
    )

    run: RunReach
    """How far the runs of the model came: a diagnosis is made of complete ones alone."""
    rows: int
    """Number of rows of the measurements."""
    rows_used: int
    """Number of rows used."""
    excluded: dict[str, int]
    """Reason for leaving rows out -> number of rows."""
    kind: str
    """Measurement kind."""
    predicted: str
    """The predicted channel, or several."""
    unit: str
    """SI unit of the errors; "1" = relative to the noise of each channel."""
    baseline: Baseline
    """Error of the start model as given."""
    noise_floor: NoiseFloor
    """Noise of the data."""
    channels: dict[str, ChannelMisfit]
    """Error of each channel when there are several."""
    where: list[Profile]
    """The residual of the start model over each variable."""
    candidates: list[CandidateResult]
    """The start model with one more effect, the best first."""
    path: list[PathPoint]
    """Steps to the best model; each adds the effect that lowers the error most."""
    verdict: Verdict
    """The verdict."""
    rivals: list[Rival]
    """Models without physics on what the best one leaves, the best on left-out groups first."""
    suspect_rows: list[SuspectRow]
    """Rows that do not fit, and count for nothing in the verdict."""
    parameters: ParameterTable
    """Effect -> parameter -> value, of the best model."""
    correlations: list[Correlation]
    """Correlations of the fitted parameters of the best model."""
    geometry: GeometrySummary
    """Geometry of the muscle of the best model."""
    model: DiagnosedModel
    """Muscle and effects; of a transient also 'drive': the drive document with both inside, which a
    comparison takes.
    """
    freed: list[str]
    """Constants that the best model fitted as well, as effect.parameter."""
    not_tried: list[NotTried]
    """Effects of the catalogue that were not tried, with the reason."""
    messages: list[str]
    """Remarks on the data and the search."""
    experiment: Experiment
    """Values of the experiment in which all measurements agree, each with its origin."""
    assumptions: list[str]
    """What nobody said and was assumed; the messages begin with it too."""
    specimens: list[SpecimenResult]
    """Each measurement, with the error of the best model on it."""
    absorbed: list[AbsorbedError]
    """Errors of readings within the accuracy, which a fit allows for."""
    context: list[DoubtfulEntry]
    """Entries that may be wrong instead, the most convincing first."""
    envelope: dict[str, MeasuredRange]
    """Quantity -> range of the data: rest_length, pressure, contraction, speed, temperature, load, mass,
    supply, as far as they were measured or stated.
    """
    covariance: FittedCovariance | None
    """Of the fitted values of the best model; None where the data cannot separate them."""
    unread: list[UnreadColumn]
    """Columns of the files that nothing is read from, and why."""
    windows: WindowsResult | None
    """The error of the best model over windows of records in time; None for other data, and where `messages`
    says why.
    """
    validation: CheckError | None
    """The error of the best model on measurements that nothing was fitted to; None without them."""
