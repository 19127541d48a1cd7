"""Request and answer of ``/api/diagnoses``: which physical effect a model is missing."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field

from mckibben.documents.strict import Series, Strict
from mckibben.server.schemas.common import streamed
from mckibben.server.schemas.comparisons import (
    ChannelError,
    Correlation,
    EffectsJson,
    FittedParameter,
    ModelRequest,
    ResidualProfile,
)
from mckibben.server.schemas.curves import MuscleGeometry
from mckibben.server.schemas.experiments import Absorbed, ExperimentValue, Specimen
from mckibben.server.schemas.measurements import UnreadColumn


class DiagnosisRequest(ModelRequest):
    """The start model and the measurements to explain."""


class DoubtfulEntry(Strict):
    """A statement about the data that may be wrong, with the evidence."""

    hypothesis: str = Field(description="Id, for 'use' and 'keep'.", examples=["rest_length"])
    field: str = Field(description="Field of the muscle, or channel.", examples=["muscle.nominal_length"])
    stated: float | None = Field(description="Stated value, SI; null for a way of reading.")
    value: float | str | None = Field(description="What explains the data: SI value, or in words.")
    stderr: float | None = Field(description="Standard error of the value; null where there is none.")
    unit: str = Field(description="SI unit of stated, value and stderr.")
    explains: float = Field(description="Share of the error above the noise that it explains by itself.")
    rmse_after: float = Field(description="Error of the best model with it.")
    confidence: float = Field(description="Probability against the best model without it.")
    effects: list[str] = Field(description="Effects that are missing with it.")
    asked: bool = Field(description="To be answered before anything else.")
    kept: bool = Field(description="Would be asked about, but the request keeps it.")
    sentence: str = Field(description="The evidence, as a sentence.")


class Baseline(Strict):
    """The start model as given."""

    rmse: float = Field(description="Root mean square of the residual.")
    nrmse_percent: float | None = Field(description="RMSE over the largest measured magnitude.")
    holdout_rmse: float = Field(description="RMSE with whole groups left out of the fit.")


class NoiseFloor(Strict):
    """The error due to noise; a smaller one cannot be reached."""

    rmse: float | None = Field(description="The error; null where it cannot be estimated.")
    how: str = Field(description="How it was estimated.")
    interval: list[float] | None = Field(
        description="From the scatter of neighbouring readings to all that no variable explains; null where "
        "a structure remains."
    )


class ModelJson(Strict):
    """A model in the form of a request."""

    effects: EffectsJson = Field(description="Effect id -> its parameters, SI.")


class Candidate(Strict):
    """The start model with one more effect, all parameters refitted."""

    effect: str = Field(description="Its id.")
    title: str = Field(description="Its name.")
    rmse: float = Field(description="Root mean square of the residual with it.")
    holdout_rmse: float = Field(description="RMSE with whole groups left out of the fit.")
    gain_percent: float = Field(description="By how much it lowers the error of the start model.")
    score_change: float = Field(description="Change of the score of the search; negative is better.")
    delta_bic: float = Field(
        description="Older name of score_change, for this version only.", deprecated=True
    )
    parameters: dict[str, FittedParameter] = Field(description="Effect -> parameter -> value.")
    twins: list[str] = Field(description="Candidates that these data cannot distinguish from it.")
    why: str = Field(description="What speaks for and against it.")
    equation: str = Field(description="LaTeX.")
    freed: list[str] = Field(
        description="Constants of other effects that were fitted with it, as effect.parameter."
    )
    next_measurement: str | None = Field(description="Experiment that separates it from its first twin.")
    model: ModelJson = Field(description="The model with it.")
    probability: float | None = Field(
        description="That it, or one of its twins in the best model, is missing; null while the search runs."
    )


class SmallCorrection(Strict):
    """An effect that lowers the error, but not by more than an inexact form of another one explains."""

    effect: str = Field(description="Its id.")
    rmse_before: float = Field(description="Error without it.")
    rmse_after: float = Field(description="Error with it.")
    probability: float = Field(description="That it is missing nevertheless.")
    kept: bool = Field(description="Whether the model keeps it, because it predicts better with it.")


class PathStep(Strict):
    """The error after adding an effect; first the start model as given, then its own numbers refitted."""

    added: str | None = Field(description="The added effect; null in the steps of the start model.")
    refitted: bool = Field(description="The start model with its own numbers fitted, before any effect.")
    correction: bool = Field(description="The added effect is kept, but not called missing.")
    rmse: float = Field(description="Root mean square of the residual.")
    holdout_rmse: float = Field(description="RMSE with whole groups left out of the fit.")
    model: ModelJson = Field(description="The model after the step.")
    freed: list[str] = Field(description="Constants fitted as well, as effect.parameter.")
    fitted: int = Field(description="Number of fitted values; with 0 no group was left out of anything.")


class TermCurve(Strict):
    """The proposed term and the residual it explains, over one variable."""

    x: str = Field(description="The variable.")
    values: Series = Field(description="Its values, SI.")
    term: Series = Field(description="The term there, SI.")
    residual: Series = Field(description="The residual that it is to explain, SI.")


class ProposedTerm(Strict):
    """A short formula for a residual that no catalogued effect explains, proven on groups left out."""

    formula: str = Field(description="The formula, as a custom effect takes it.")
    coefficients: dict[str, float] = Field(description="Its constants, SI.")
    share: float = Field(description="Share of the residual's mean square that it removes.")
    model: ModelJson = Field(description="The model with the term.")
    curve: TermCurve = Field(description="The term and the residual.")


class Experiment(Strict):
    """An experiment that separates two effects that look alike."""

    pair: list[str] = Field(description="Ids of the two effects.")
    declared: str = Field(
        description="What separates them according to the catalogue; empty without an entry."
    )
    protocol: str = Field(
        description="How to do it, in words; empty where none of the known experiments separates them."
    )
    separation: float = Field(description="Expected difference, in standard deviations of one reading.")
    minutes: float | None = Field(description="How long it takes; null without a protocol.")
    matters: bool = Field(description="Whether the two models predict different results for this rig.")
    differs_in: str = Field(description="Simulated experiment where the models as they are differ most.")
    difference: float = Field(description="By how many standard deviations of one reading.")


class PairSeparation(Strict):
    """By how many standard deviations of one reading an experiment tells two effects apart."""

    pair: list[str] = Field(description="Ids of the two effects.")
    separation: float = Field(description="The number of standard deviations.")


class SetPoints(Strict):
    """Values of one set point, in its SI unit."""

    unit: str = Field(description="The SI unit.")
    values: Series = Field(description="One value per row.")


class NextExperiment(Strict):
    """The experiment that splits a group of indistinguishable effects best, with its set points."""

    group: list[str] = Field(description="The effects, that of the model first.")
    protocol: str = Field(description="How to do it, in words.")
    minutes: float = Field(description="How long it takes.")
    separations: list[PairSeparation] = Field(description="How well it tells each pair of the group apart.")
    run: list[int] = Field(description="Number of the run of each set point; time starts anew in each.")
    set_points: dict[str, SetPoints] = Field(description="Linear between the rows.")


class SamePeriod(Strict):
    """A period over another coordinate that the data cannot tell from the repetition."""

    over: Literal["length", "pressure", "time"] = Field(description="The coordinate.")
    period: float = Field(description="In m, Pa or s.")


class Repetition(Strict):
    """A periodic part of the unexplained residual."""

    over: Literal["length", "pressure", "time"] = Field(description="What it repeats over.")
    unit: Literal["m", "Pa", "s"] = Field(description="Unit of the period.")
    period: float = Field(description="The period.")
    share: float = Field(description="Share of the mean square of the residual that it explains.")
    amplitude: float = Field(
        description="Of the predicted channel, in its unit; at the mean pressure where it grows with it."
    )
    grows_with_pressure: bool = Field(description="Whether its amplitude is in proportion to the pressure.")
    false_alarm: float = Field(
        description="Chance that noise does as well somewhere among all periods tried; below 1e-4."
    )
    left_out_share: float = Field(description="The share that it explains of sweeps it was not fitted to.")
    parts: int = Field(description="Number of records, or of sweeps.")
    shown: int = Field(description="Number of those that a fit to the others explains.")
    parts_are: Literal["records", "sweeps"] = Field(description="What the parts are.")
    also: list[SamePeriod] = Field(description="What these data cannot tell it from.")
    text: str = Field(description="All of it in words.")


class Verdict(Strict):
    """The verdict of the diagnosis."""

    status: Literal["adequate", "missing_effects", "ambiguous", "unknown_effect"] = Field(
        description="The verdict as a word for programs: the model is at the noise (adequate); effects bring "
        "it there (missing_effects), some of which the data cannot tell from others (ambiguous); a rest with "
        "structure stays that no catalogued effect explains, or it is likelier that none of those named is "
        "missing (unknown_effect)."
    )
    title: str = Field(description="The status in words.")
    effects: list[str] = Field(description="Ids of the missing effects.")
    indistinguishable: list[list[str]] = Field(
        description="Groups of effects that the data cannot distinguish."
    )
    probabilities: dict[str, float] = Field(
        description="Effect -> probability that it, or one of its group, is missing; a group shares one."
    )
    applied: dict[str, str] = Field(
        description="Effect of the model that data cannot tell from others -> why this one was taken."
    )
    corrections: list[SmallCorrection] = Field(
        description="Effects that lower the error but are not called missing."
    )
    unexplained_share: float = Field(description="Share of the residual that is left to explain, 0 to 1.")
    unexplained_in: list[str] = Field(description="Variables that this part depends on.")
    repeats: Repetition | None = Field(
        description="What of it is periodic; null where nothing is beyond doubt, or no effect is unknown."
    )
    proposed_term: ProposedTerm | None = Field(description="A formula for it; null where none was proven.")
    where_to_look: str | None = Field(
        description="Without a formula: the ranges in which the unexplained error is largest."
    )
    at_bounds: str | None = Field(
        description="Missing effects whose values ended at the bound of the search; null without any."
    )
    next_measurement: str | None = Field(
        description="Recommended next measurement; null where none is needed."
    )
    experiments: list[Experiment] = Field(
        description="For each pair of effects that the data cannot distinguish."
    )
    next_experiments: list[NextExperiment] = Field(
        description="For each group of effects that an experiment of this rig splits the best one, and a "
        "second one for the pairs that it leaves together; the group that is split best comes first."
    )
    sentence: str = Field(description="The verdict in one to four sentences.")


class NotTried(Strict):
    """An effect that these data cannot show, or that the request excludes."""

    effect: str = Field(description="Its id.")
    why: str = Field(description="The reason.")
    needs_time: bool = Field(description="Whether the time of each row would make it a candidate.")


class MeasuredRange(Strict):
    """The range of a quantity in the data of a model."""

    least: float = Field(description="Smallest value.")
    most: float = Field(description="Largest value.")
    unit: str = Field(description="SI unit; pressures are gauge.")


class FittedCovariance(Strict):
    """Covariance of the fitted values that the data determine."""

    names: list[str] = Field(
        description="effect.parameter, or a dimension of the muscle.", examples=[["effect.parameter"]]
    )
    matrix: list[list[float]] = Field(description="Products of their SI units, one row per name.")


class DiagnosisAnswer(Strict):
    """What the model is missing, and how certain that is."""

    kind: str = Field(description="Measurement kind.")
    rows: int = Field(description="Number of rows of the measurements.")
    rows_used: int = Field(description="Number of rows used.")
    excluded: dict[str, int] = Field(description="Reason for leaving rows out -> number of rows.")
    predicted: str = Field(description="The predicted channel, or several.")
    unit: str = Field(description='SI unit of the errors; "1" = relative to the noise of each channel.')
    baseline: Baseline = Field(description="Error of the start model as given.")
    noise_floor: NoiseFloor = Field(description="The error due to noise.")
    channels: dict[str, ChannelError] = Field(description="Error of each channel when there are several.")
    where: list[ResidualProfile] = Field(description="The residual of the start model over each variable.")
    candidates: list[Candidate] = Field(description="The start model with one more effect, the best first.")
    path: list[PathStep] = Field(description="The steps from the start model to the best one.")
    verdict: Verdict = Field(description="The verdict.")
    parameters: dict[str, dict[str, FittedParameter]] = Field(
        description="Effect -> parameter -> value, of the best model."
    )
    correlations: list[Correlation] = Field(
        description="Correlations of the fitted parameters of the best model."
    )
    geometry: MuscleGeometry = Field(description="Geometry of the muscle of the best model.")
    model: dict[str, Any] = Field(
        description="Muscle and effects; of a transient also 'drive': the drive document with both inside, "
        "which a comparison takes."
    )
    freed: list[str] = Field(description="Constants that the best model fitted as well, as effect.parameter.")
    not_tried: list[NotTried] = Field(
        description="Effects of the catalogue that were not tried, with the reason."
    )
    messages: list[str] = Field(description="Remarks on the data and the search.")
    experiment: dict[str, ExperimentValue] = Field(
        description="Values of the experiment in which all measurements agree, each with its origin."
    )
    assumptions: list[str] = Field(
        description="What nobody said and was assumed; the messages begin with it too."
    )
    specimens: list[Specimen] = Field(description="Each measurement, with its own experiment.")
    absorbed: list[Absorbed] = Field(
        description="Errors of readings within the accuracy, which a fit allows for."
    )
    context: list[DoubtfulEntry] = Field(
        description="Entries that may be wrong instead, the most convincing first."
    )
    envelope: dict[str, MeasuredRange] = Field(
        description="Quantity -> range of the data: rest_length, pressure, contraction, speed, temperature, "
        "load, mass, supply, as far as they were measured or stated."
    )
    covariance: FittedCovariance | None = Field(
        description="Of the fitted values of the best model; null where the data cannot separate them."
    )
    unread: list[UnreadColumn] = Field(description="Columns of the files that nothing is read from, and why.")


DiagnosisEvents = streamed("a candidate or null")
