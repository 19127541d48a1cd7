"""Request and answer of ``/api/diagnoses``: which physical effect a model is missing."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field

from mckibben.documents.strict import Series, Strict
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


class DiagnosisRequest(ModelRequest):
    """The start model and the measurements to explain."""


class DoubtfulEntry(Strict):
    """A statement about the data that may be wrong, with the evidence."""

    hypothesis: str = Field(description="Id, for 'use' and 'keep'.", examples=["rest_length"])
    field: str = Field(description="Field of the muscle, or channel.", examples=["muscle.nominal_length"])
    stated: float | None = Field(description="Stated value, SI; null for a way of reading.")
    value: float | str | None = Field(description="What explains the data: SI value, or in words.")
    stderr: float | None
    unit: str
    explains: float = Field(description="Share of the error above the noise that it explains by itself.")
    rmse_after: float = Field(description="Error of the best model with it.")
    confidence: float = Field(description="Probability against the best model without it.")
    effects: list[str] = Field(description="Effects that are missing with it.")
    asked: bool = Field(description="To be answered before anything else.")
    kept: bool = Field(description="Would be asked about, but the request keeps it.")
    sentence: str


class Baseline(Strict):
    """The start model as given."""

    rmse: float
    nrmse_percent: float | None
    holdout_rmse: float


class NoiseFloor(Strict):
    """The error due to noise; a smaller one cannot be reached."""

    rmse: float | None
    how: str
    interval: list[float] | None = Field(
        description="From the scatter of neighbouring readings to all that no variable explains; null where "
        "a structure remains."
    )


class ModelJson(Strict):
    """A model in the form of a request."""

    effects: EffectsJson


class Candidate(Strict):
    """The start model with one more effect, all parameters refitted."""

    effect: str
    title: str
    rmse: float
    holdout_rmse: float
    gain_percent: float
    score_change: float = Field(description="Change of the score of the search; negative is better.")
    delta_bic: float = Field(
        description="Older name of score_change, for this version only.", deprecated=True
    )
    parameters: dict[str, FittedParameter]
    twins: list[str] = Field(description="Candidates that these data cannot distinguish from it.")
    why: str
    equation: str = Field(description="LaTeX.")
    freed: list[str]
    next_measurement: str | None = Field(description="Experiment that separates it from its first twin.")
    model: ModelJson
    probability: float | None = Field(
        description="That it, or one of its twins in the best model, is missing; null while the search runs."
    )


class SmallCorrection(Strict):
    """An effect that lowers the error, but not by more than an inexact form of another one explains."""

    effect: str
    rmse_before: float
    rmse_after: float
    probability: float = Field(description="That it is missing nevertheless.")
    kept: bool = Field(description="Whether the model keeps it, because it predicts better with it.")


class PathStep(Strict):
    """The error after adding an effect; first the start model as given, then its own numbers refitted."""

    added: str | None
    refitted: bool = Field(description="The start model with its own numbers fitted, before any effect.")
    correction: bool = Field(description="The added effect is kept, but not called missing.")
    rmse: float
    holdout_rmse: float
    model: ModelJson
    freed: list[str]


class TermCurve(Strict):
    """The proposed term and the residual it explains, over one variable."""

    x: str
    values: Series
    term: Series
    residual: Series


class ProposedTerm(Strict):
    """A short formula for a residual that no catalogued effect explains, proven on groups left out."""

    formula: str
    coefficients: dict[str, float]
    share: float = Field(description="Share of the residual's mean square that it removes.")
    model: ModelJson
    curve: TermCurve


class Experiment(Strict):
    """An experiment that separates two effects that look alike."""

    pair: list[str]
    declared: str
    protocol: str
    separation: float = Field(description="Expected difference, in standard deviations of one reading.")
    minutes: float | None = Field(description="How long it takes; null without a protocol.")
    matters: bool = Field(description="Whether the two models predict different results for this rig.")
    differs_in: str = Field(description="Simulated experiment where the models as they are differ most.")
    difference: float = Field(description="By how many standard deviations of one reading.")


class PairSeparation(Strict):
    """By how many standard deviations of one reading an experiment tells two effects apart."""

    pair: list[str]
    separation: float


class SetPoints(Strict):
    """Values of one set point, in its SI unit."""

    unit: str
    values: Series


class NextExperiment(Strict):
    """The experiment that splits a group of indistinguishable effects best, with its set points."""

    group: list[str] = Field(description="The effects, that of the model first.")
    protocol: str
    minutes: float
    separations: list[PairSeparation]
    run: list[int] = Field(description="Number of the run of each set point; time starts anew in each.")
    set_points: dict[str, SetPoints] = Field(description="Linear between the rows.")


class Verdict(Strict):
    """The verdict of the diagnosis."""

    status: Literal["adequate", "missing_effects", "ambiguous", "unknown_effect"]
    title: str = Field(description="The status in words.")
    effects: list[str]
    indistinguishable: list[list[str]]
    probabilities: dict[str, float] = Field(
        description="Effect -> probability that it, or one of its group, is missing; a group shares one."
    )
    applied: dict[str, str] = Field(
        description="Effect of the model that data cannot tell from others -> why this one was taken."
    )
    corrections: list[SmallCorrection] = Field(
        description="Effects that lower the error but are not called missing."
    )
    unexplained_share: float
    unexplained_in: list[str]
    proposed_term: ProposedTerm | None
    where_to_look: str | None = Field(
        description="Without a formula: the ranges in which the unexplained error is largest."
    )
    next_measurement: str | None
    experiments: list[Experiment]
    next_experiments: list[NextExperiment] = Field(
        description="For each group of effects the experiment that splits it best, the best first."
    )
    sentence: str


class NotTried(Strict):
    """An effect that these data cannot show, or that the request excludes."""

    effect: str
    why: str


class MeasuredRange(Strict):
    """The range of a quantity in the data of a model."""

    least: float
    most: float
    unit: str = Field(description="SI unit; pressures are gauge.")


class DiagnosisAnswer(Strict):
    """What the model is missing, and how certain that is."""

    kind: str
    rows: int
    rows_used: int
    excluded: dict[str, int] = Field(description="Reason for leaving rows out -> number of rows.")
    predicted: str
    unit: str
    baseline: Baseline
    noise_floor: NoiseFloor
    channels: dict[str, ChannelError]
    where: list[ResidualProfile]
    candidates: list[Candidate]
    path: list[PathStep]
    verdict: Verdict
    parameters: dict[str, dict[str, FittedParameter]]
    correlations: list[Correlation]
    geometry: MuscleGeometry
    model: dict[str, Any] = Field(
        description="Muscle and effects; of a transient also 'drive': the drive document with both inside, "
        "which a comparison takes."
    )
    freed: list[str]
    not_tried: list[NotTried] = Field(
        description="Effects of the catalogue that were not tried, with the reason."
    )
    messages: list[str]
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


DiagnosisEvents: dict[int | str, dict[str, Any]] = {
    200: {
        "content": {
            "text/event-stream": {
                "schema": {
                    "type": "string",
                    "description": "With `Accept: text/event-stream`: events `progress` "
                    '({"share": 0 to 1, "found": a candidate or null}), then `done` (the answer) or `error`.',
                }
            }
        }
    }
}
