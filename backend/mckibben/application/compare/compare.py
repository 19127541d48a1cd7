"""Comparison of a model with measurements: the error, where the model fails, and curves for plots."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from mckibben.application.compare.judged import (
    ComparedVerdict,
    Rival,
    SuspectRow,
    compared_verdict,
    rivals_beside,
    suspects_of_comparison,
)
from mckibben.application.compare.question import EffectDocument, ModelQuestion
from mckibben.application.compare.reach import RunReach, reach_of
from mckibben.application.compare.residual_map import (
    ExplainedInside,
    Over,
    ResidualMap,
    RowsInside,
    explained_inside,
    residual_map,
    rows_inside,
)
from mckibben.application.compare.series import (
    MAX_POINTS_PER_SERIES,
    MAX_SERIES,
    ComparedReversals,
    ComparedSeries,
    reversals_of,
    series_of,
)
from mckibben.application.compare.specimens import Specimens
from mckibben.application.compare.starts import start_messages
from mckibben.application.compare.windows import WindowsResult, windows_result
from mckibben.application.diagnose.doubts import with_accepted
from mckibben.application.envelope import Envelope, MeasuredRange, beyond, envelope_of
from mckibben.application.measurement.specimen_result import (
    SpecimenResult,
    absorbed_message,
    common_experiment,
    specimen_results,
)
from mckibben.application.measurement.summary import UnreadColumn
from mckibben.application.muscle_summary import (
    GeometrySummary,
    Notice,
    curve_fit_notices,
    geometry_of,
    start_notices,
)
from mckibben.facts.comparison import CHECK, COMPARISON, RESIDUAL, error_scale
from mckibben.facts.result import Number, result_class
from mckibben.identification.diagnose.judged import judged_comparison
from mckibben.identification.fit.comparison import (
    ChannelMisfit,
    Comparison,
    Correlation,
    ParameterTable,
    compared,
    correlations_of,
)
from mckibben.identification.predict import Predictor
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.predictor import StoppedRun
from mckibben.identification.predict.reading_errors import AbsorbedError
from mckibben.identification.predict.specimens import own_muscle
from mckibben.identification.residual.cross import CrossCorrelation, cross_correlation
from mckibben.identification.residual.digits import brief
from mckibben.identification.residual.parts import ResidualPart, residual_parts
from mckibben.identification.residual.profiles import (
    MeanLoop,
    Profile,
    ResidualLoop,
    Whiteness,
    loops,
    mean_loop,
    profiles,
    variables_of,
    whiteness,
)
from mckibben.measurement.experiment import Experiment

_TELLING = 0.05  # share of the squared error from which a variable is mentioned

Array = NDArray[np.float64]

_CLOSER = 0.98  # largest error over that of a new muscle with which the muscle counts as used


@result_class
class ModelDocument:
    """A model in the form of a request."""

    effects: EffectDocument
    """Effect id -> its parameters, SI."""


@result_class
class ValidationResult:
    """The error of the model for measurements that it was not fitted to."""

    FIGURES: ClassVar = CHECK.name

    rmse: Number
    nrmse_percent: Number
    rows_used: int
    series: list[ComparedSeries]
    """The points, curve by curve."""


@result_class
class ComparisonResult:
    """The model's error, where it fails, and the points; SI."""

    FIGURES: ClassVar = COMPARISON.name
    CORRECTING: ClassVar = (
        "messages",
        "assumptions",
    )

    kind: str
    """Measurement kind."""
    rows: int
    rows_used: int
    excluded: dict[str, int]
    """Reason for leaving rows out -> number of rows."""
    predicted: str
    """The predicted channel, or several."""
    unit: str
    """SI unit of the error; "1" = relative to the noise of each channel."""
    rmse: Number
    nrmse_percent: Number
    stroke_percent: float | None
    full_scale: Number
    holdout_rmse: float | None
    fitted: int
    noise_floor: float | None
    over_noise: float | None
    fit_percent: float | None
    noise_how: str
    """How the noise was estimated."""
    residual_mean: Number
    channels: dict[str, ChannelMisfit]
    """Error of each channel when there are several."""
    parameters: ParameterTable
    """Effect -> parameter -> value."""
    correlations: list[Correlation]
    """Correlations of the fitted parameters."""
    geometry: GeometrySummary
    """Geometry of the muscle, fitted where it was free."""
    where: list[Profile]
    """The residual over each variable that it may depend on."""
    heat_map: ResidualMap | None
    """The residual over two variables; None where there are too few points."""
    inside: list[RowsInside]
    """The rows of the fit in the range that was asked for, by channel; empty without a range."""
    explains: list[ExplainedInside]
    """What each effect of the model explains there; empty where it was not asked for."""
    parts: list[ResidualPart]
    """What the squared residual is made of; the shares add up to 1."""
    whiteness: Whiteness
    """Autocorrelation and sign changes of the residual; whether it is noise, the verdict says."""
    cross: list[CrossCorrelation]
    """Correlation of the residual with the input that drove the test, of rows with times."""
    loops: list[ResidualLoop]
    """Loops of the force residual, with the energy that the model misses."""
    mean_loop: MeanLoop | None
    """Their mean; None without loops."""
    sentences: list[str]
    """Where the model fails, as sentences."""
    series: list[ComparedSeries]
    """The points, curve by curve."""
    reversals: ComparedReversals | None
    """Readings where the motion turns, which are in none of the errors; None without dry friction."""
    validation: ValidationResult | None
    """The error on measurements not used for the fit; None without them."""
    model: ModelDocument
    """Effects and values in the form of a request."""
    messages: list[str]
    """Remarks on the data."""
    flags: list[Notice]
    """Remarks on the muscle."""
    rmse_beyond_accuracy: Number
    experiment: Experiment
    """Values of the experiment in which all measurements agree, each with its origin."""
    assumptions: list[str]
    """What nobody said and was assumed; the messages begin with it too."""
    specimens: list[SpecimenResult]
    """Each measurement, with its own experiment."""
    absorbed: list[AbsorbedError]
    """Errors of readings within the accuracy, which a fit allows for."""
    unread: list[UnreadColumn]
    """Columns of the files that nothing is read from, and why."""
    verdict: ComparedVerdict | None
    """What is left, and whether it is noise; None where a run stopped, or where it was not asked for."""
    rivals: list[Rival]
    """Models without physics on what the model leaves, the best on left-out groups first."""
    suspect_rows: list[SuspectRow]
    """Rows that do not fit, and count for nothing in the verdict; the figures count them."""
    run: RunReach
    """How far the runs of the model came."""
    stopped: list[StoppedRun]
    """Runs of the model that ended early; all figures are of the rows that they reached."""
    windows: WindowsResult | None
    """The error over windows of records in time; None for other data, and where `messages` says why."""


@dataclass(frozen=True, slots=True)
class Compared:
    """The result with what it was made from.

    Attributes:
        result: the answer.
        comparison: the compared model and all rows.
        envelope: quantity -> range in which the data lie.
    """

    result: ComparisonResult
    comparison: Comparison
    envelope: dict[str, MeasuredRange]


def compare(
    question: ModelQuestion,
    *,
    fit: bool = False,
    within: Mapping[Over, Sequence[float]] | None = None,
    explain: bool = False,
    judge: bool = True,
    ties: Mapping[str, str] | None = None,
) -> ComparisonResult:
    """Compare a model with measurements; see `compared_whole`."""
    return compared_whole(question, fit=fit, within=within, explain=explain, judge=judge, ties=ties).result


def compared_whole(
    question: ModelQuestion,
    *,
    fit: bool = False,
    within: Mapping[Over, Sequence[float]] | None = None,
    explain: bool = False,
    judge: bool = True,
    ties: Mapping[str, str] | None = None,
) -> Compared:
    """Compare a model with measurements.

    Args:
        question: the model and the measurements.
        fit: fit the parameters that the effects declare as fitted, and those freed by the question.
        within: variable -> range whose rows the answer looks at by themselves, SI.
        explain: also what each effect of the model explains of them.
        judge: also whether what is left is noise, which takes longer than the rest.
        ties: fitted constants that always have the value of another one, both as "effect.parameter".

    Raises:
        InputError: the measurement does not allow the comparison, a geometry field cannot be freed, or a tied
            constant is not fitted.
    """
    start, points = question.start, question.points
    comparison = compared(
        question.predictor,
        question.fit_model(),
        rows=points.measurement.rows,
        fit=fit,
        geometry=question.free_geometry(),
        freed=question.freed,
        ties=ties,
        noise=question.noise,
    )
    predictor, left_out = comparison.predictor, sum(points.left_out.values())
    series, thinned = series_of(comparison, "fit")
    data = envelope_of(question.specimens, predictor, comparison.fit_model)
    messages = [
        *question.opening,
        *question.unread_messages,
        *beyond(question.envelope, data),
        *comparison.messages,
        *start_messages(comparison.fit),
        *absorbed_message(comparison.absorbed, predictor.unit),
    ]
    over_windows, why_none = windows_result(predictor, comparison.fit_model, question.noise)
    messages += [why_none] if why_none else []
    validation, stopped = None, list(comparison.stopped)
    if question.validation is not None:
        validation, thin, said, others = checked(question, question.validation, comparison.fit_model, data)
        stopped += others
        thinned = thinned or thin
        messages += said
    reversals, fewer = reversals_of(comparison)
    if thinned or fewer:
        messages.append(f"curves show at most {MAX_POINTS_PER_SERIES} points each; the figures use all rows")
    # A quantity that is accepted as wrong has another value only after a fit.
    accepted = [entry for entry in question.accepted if fit or entry.reading is not None]
    residual = comparison.residual / predictor.scale
    variables = variables_of(predictor, comparison.fit_model)
    where = profiles(residual, variables, predictor.folds[0])
    white = whiteness(residual, predictor.sweeps)
    closed = _loops(comparison, residual)
    judged = judged_comparison(comparison) if judge and not comparison.stopped else None
    suspects = [] if judged is None else suspects_of_comparison(question, judged)
    rivals = [] if judged is None else rivals_beside(judged.model, judged.predictor, judged.judgement)
    verdict = None if judged is None else compared_verdict(judged, suspects, rivals)
    result = ComparisonResult(
        kind=predictor.kind,
        rows=comparison.rows + left_out,
        rows_used=predictor.rows_used,
        excluded=points.left_out | dict(comparison.excluded),
        predicted=predictor.predicted,
        unit=predictor.unit,
        rmse=comparison.rmse,
        nrmse_percent=comparison.nrmse_percent,
        stroke_percent=comparison.stroke_percent,
        full_scale=comparison.full_scale,
        holdout_rmse=comparison.holdout_rmse,
        fitted=0 if comparison.fit is None else len(comparison.fit.numbers),
        noise_floor=comparison.noise,
        over_noise=comparison.over_noise,
        fit_percent=comparison.fit_percent,
        noise_how=comparison.noise_how,
        residual_mean=comparison.residual_mean,
        channels=comparison.channels,
        parameters=comparison.parameters,
        correlations=correlations_of(comparison.fit),
        geometry=geometry_of(start, comparison.fit_model.muscle),
        where=where,
        heat_map=residual_map(comparison),
        inside=rows_inside(comparison, within) if within else [],
        explains=explained_inside(comparison, within) if within and explain else [],
        parts=residual_parts(
            residual, variables, 1.0 if comparison.predictor.unit == "1" else comparison.noise
        ),
        whiteness=white,
        cross=_cross(comparison, residual, variables),
        loops=closed[:MAX_SERIES],
        mean_loop=mean_loop(closed),
        sentences=[
            *(run.sentence for run in stopped),
            *([] if over_windows is None else [over_windows.sentence]),
            *_sentences(where, predictor.unit),
            *([] if verdict is None else [verdict.sentence]),
        ],
        series=series,
        reversals=reversals,
        validation=validation,
        model=ModelDocument(question.effect_document(comparison.fit_model)),
        messages=messages,
        flags=[*start_notices(start), *curve_fit_notices(question.curve_fit)],
        rmse_beyond_accuracy=comparison.rmse_beyond_accuracy,
        experiment=with_accepted(common_experiment(question), accepted, comparison.fit_model),
        unread=question.unread,
        assumptions=[assumption.message for assumption in question.assumptions],
        specimens=specimen_results(question, predictor, predictor.weighted(comparison.residual)),
        absorbed=list(comparison.absorbed),
        verdict=verdict,
        rivals=rivals,
        suspect_rows=suspects,
        run=reach_of(comparison.stopped),
        stopped=stopped,
        windows=over_windows,
    )
    return Compared(result, comparison, data)


def _cross(
    comparison: Comparison, residual: Array, variables: Mapping[str, np.ndarray]
) -> list[CrossCorrelation]:
    """Correlation of each channel's residual with its input, for rows in the order of time."""
    predictor = comparison.predictor
    if "time" not in predictor.inputs:
        return []
    found = []
    for channel in predictor.channels:
        inside = np.zeros(len(residual), dtype=bool)
        inside[channel.rows] = True
        sweeps = [rows for rows in predictor.sweeps if inside[rows[0]]]
        found.append(cross_correlation(channel.name, residual, variables, sweeps))
    return [one for one in found if one is not None]


def _loops(comparison: Comparison, residual: Array) -> list[ResidualLoop]:
    """Loop areas of the residual, for a force measured over time."""
    predictor = comparison.predictor
    if predictor.predicted != "force" or not {"length", "time"} <= predictor.inputs.keys():
        return []
    return loops(residual, predictor.inputs["length"], predictor.groups, comparison.noise)


def _sentences(where: list[Profile], unit: str) -> list[str]:
    """Where the model fails, in words."""
    scale, share = error_scale(unit), RESIDUAL["share_explained"].scale
    return [
        f"{profile.worst}: {brief(scale.of(profile.rmse))} {scale.unit} rms; this variable alone predicts "
        f"{share.of(profile.share_explained):.0f} {share.unit} of the squared error"
        for profile in where[:3]
        if profile.share_explained > _TELLING
    ]


def checked(
    question: ModelQuestion, specimens: Specimens, fit_model: FitModel, envelope: Envelope
) -> tuple[ValidationResult, bool, list[str], list[StoppedRun]]:
    """The error of a fitted model for validation data, whether the curves were thinned, remarks, and the
    runs that ended early.
    """
    muscle = fit_model.muscle
    own = own_muscle(muscle, reference=specimens.reference, own=specimens.each[0].muscle)
    predictor = specimens.predictor(muscle if specimens.several else own)[0]
    model = fit_model if specimens.several else replace(fit_model, muscle=own)
    model, remark = preconditioned_model(predictor, model, envelope)
    rows = specimens.points.measurement.rows
    validation = compared(predictor, model, rows=rows, noise=question.noise)
    series, thinned = series_of(validation, "validation")
    rows_used = validation.predictor.rows_used
    result = ValidationResult(validation.rmse, validation.nrmse_percent, rows_used, series)
    names = [f"validation, {run.of}" if run.of else "validation" for run in validation.stopped]
    stopped = [replace(run, of=name) for run, name in zip(validation.stopped, names, strict=True)]
    return result, thinned, [f"validation: {remark}"] if remark else [], stopped


def preconditioned_model(predictor: Predictor, model: FitModel, envelope: Envelope) -> tuple[FitModel, str]:
    """The model of a muscle used before, as far as in earlier measurements, where data are closer to it.

    Files do not say whether a muscle is the one that was measured before or a new one of the same kind.

    Args:
        predictor: the later data.
        model: fitted to earlier data; it takes the muscle as new where it does not say how far it was used.
        envelope: ranges of the earlier data.

    Returns:
        The model, and a sentence; the model as it was and "" where nothing lasts or the muscle is closer to
        a new one.
    """
    changes = {
        f"{effect.id}.{state.lasting}": (effect, envelope[state.largest].most)
        for effect in model.effects
        for state in effect.states
        if state.lasting and model.values[effect.id][state.lasting] == 0.0 and state.largest in envelope
    }
    numbers = {
        name: min(most, effect.parameter(name.partition(".")[2]).upper)
        for name, (effect, most) in changes.items()
        if most > 0.0
    }
    if not numbers:
        return model, ""
    used = model.with_numbers(list(numbers), list(numbers.values()))
    new, after = (predictor.rmse(predictor.residual(each)) for each in (model, used))
    if not after < _CLOSER * new:
        return model, ""
    titles = " and ".join(dict.fromkeys(effect.title for effect, _ in changes.values()))
    stated = ", ".join(f"{name} = {number:.3g}" for name, number in numbers.items())
    factor, unit = {"m": (1e3, " mm"), "1": (1.0, " times the noise")}.get(
        predictor.unit, (1.0, f" {predictor.unit}")
    )
    return used, (
        f"{titles}: the muscle is taken as used before, as far as in the measurements of the model "
        f"({stated}): error {brief(factor * after)}{unit}, as a new muscle {brief(factor * new)}{unit}"
    )
