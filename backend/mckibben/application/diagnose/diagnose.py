"""Diagnosis of a model: candidates, path, verdict, and models that can be used in further requests."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from mckibben.application.compare.compare import ModelDocument, checked
from mckibben.application.compare.judged import (
    Rival,
    SuspectRow,
    proofs_of,
    rival_sentence,
    rivals_beside,
    suspect_rows,
)
from mckibben.application.compare.question import ModelQuestion
from mckibben.application.compare.reach import reach_of
from mckibben.application.compare.starts import start_messages
from mckibben.application.compare.stated_question import of_one_channel
from mckibben.application.compare.windows import windows_result
from mckibben.application.diagnose.doubts import (
    doubtful_entries,
    notes_of,
    questions_of,
    statements_of,
    with_accepted,
)
from mckibben.application.diagnose.next_experiment import next_experiment, next_measurement, proposal
from mckibben.application.diagnose.result import (
    Baseline,
    CandidateResult,
    CheckError,
    CorrectionResult,
    DiagnosedModel,
    DiagnosisResult,
    NoiseFloor,
    PathPoint,
    RepetitionResult,
    SamePeriod,
    TermCurve,
    TermProposal,
    Verdict,
)
from mckibben.application.envelope import Envelope, beyond, envelope_of
from mckibben.application.measurement.specimen_result import (
    absorbed_message,
    common_experiment,
    specimen_results,
)
from mckibben.application.model.saved import drive_of_model
from mckibben.application.muscle_summary import curve_fit_notices, geometry_of
from mckibben.documents.studio import Studio
from mckibben.identification.diagnose.diagnosis import FEWEST_VALUES, Diagnosis
from mckibben.identification.diagnose.diagnosis import diagnose as search_effects
from mckibben.identification.diagnose.judgement_words import open_proofs
from mckibben.identification.diagnose.next_measurement import declared
from mckibben.identification.diagnose.search import ended
from mckibben.identification.diagnose.steps import SingleAddition
from mckibben.identification.diagnose.swept_rows import Over
from mckibben.identification.diagnose.verdict import unexplained_share
from mckibben.identification.diagnose.words import (
    applied_reasons,
    aside_of,
    aside_sentence,
    bounds_sentence,
    correction_reason,
    corrections_sentence,
    left_out_sentence,
    repeats,
    sentence_of,
    superfluous_sentence,
    suspects_of,
    title_of,
    where_to_look,
)
from mckibben.identification.fit.comparison import (
    ParameterValue,
    channel_misfits,
    check_finite,
    correlations_of,
    parameter_table,
)
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import CancelledError
from mckibben.identification.predict import Predictor
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.residual.correlated import Noises
from mckibben.identification.residual.profiles import variables_of
from mckibben.identification.residual.term import SYMBOLS
from mckibben.physics.custom import CUSTOM, TERM
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError
from mckibben.simulation.outcome import Outcome, Watch

_MOST_ROWS = 3000  # of a diagnosis; longer measurements are reduced
_UNITS: dict[Over, Literal["m", "Pa", "s", "1"]] = {
    "length": "m", "pressure": "Pa", "time": "s", "rows": "1",
}  # fmt: skip
_CURVE = 200  # points of the curve of a proposed term

#: A diagnosis that takes longer ends with what it has found [s].
TIME_LIMIT = 300.0
#: How it would take less time.
HINT = "give fewer rows of the measurement, or start with fewer effects"


@dataclass(frozen=True)
class _Data:
    """The data of a diagnosis: all rows, or fewer with the same information."""

    predictor: Predictor
    rows: int
    excluded: dict[str, int]
    notes: list[str] = field(default_factory=list)
    most_rows: int | None = None


def prepare(question: ModelQuestion, studio: Studio) -> Callable[[Watch], DiagnosisResult]:
    """The diagnosis of a question, ready to start; the watch receives each candidate when it is fitted.

    Raises:
        InputError: the measurement does not allow a diagnosis.
    """
    start = question.fit_model()
    data = _data(question)
    doubtful = statements_of(question, data.most_rows)
    check_finite(data.predictor, start)
    if stopped := data.predictor.stopped(start):
        raise InputError(
            f"no diagnosis can be made: {stopped[0].event}",
            field="measurement",
            hint="what a model predicts of a part of a run says nothing about entries or effects; 'compare' "
            "shows the error of the rows before",
        )
    if len(data.predictor.measured) < FEWEST_VALUES:
        name = question.points.measurement.name
        raise InputError(
            f"{name}: {len(data.predictor.measured)} values are too few for a diagnosis",
            field="measurement",
            hint=f"measure at least {FEWEST_VALUES}, at several pressures or lengths; 'compare' takes fewer",
        )
    geometry = question.free_geometry()
    if question.noise is not None:
        of_one_channel(data.predictor)
    # A custom term is not a candidate, but stays in a model that has it.
    catalogue = {**studio.catalogue, **question.start.catalogue}

    def work(watch: Watch) -> DiagnosisResult:
        def report_candidate(candidate: SingleAddition) -> None:
            if watch.found is not None:
                watch.found(_candidate(question, candidate, catalogue, None))

        try:
            diagnosis = search_effects(
                data.predictor,
                start,
                catalogue=catalogue,
                geometry=geometry,
                freed=question.freed,
                noise=question.noise,
                statements=doubtful,
                load=question.free_load,
                watch=watch,
                on_candidate=report_candidate,
            )
        except CancelledError as stop:
            if stop.outcome is Outcome.CANCELLED:
                raise InputError("the diagnosis was cancelled", code="stopped") from stop
            raise InputError(
                f"the limit of {watch.time_limit:g} s of processor time ended the diagnosis before the start "
                "model was fitted",
                hint=HINT,
                code="stopped",
            ) from stop
        return _result(question, data, diagnosis, catalogue, studio)

    return work


def _data(question: ModelQuestion) -> _Data:
    """The data of a question; long measurements are reduced."""
    most = None if question.points.measurement.kind == "transient" else _MOST_ROWS
    total = sum(specimen.points.measurement.rows for specimen in question.specimens.each)
    excluded, notes = dict(question.points.left_out), []
    if most is not None and total > most:
        predictor, notes, reduced_away = question.specimens.predictor(question.start.muscle, most)
        excluded |= reduced_away
    else:
        predictor = question.predictor
    rows = total + sum(question.points.left_out.values())
    excluded |= predictor.excluded
    if averaged := rows - predictor.rows_used - sum(excluded.values()):
        excluded["averaged into the others"] = averaged
    return _Data(predictor, rows, excluded, notes, most if most is not None and total > most else None)


def _result(
    question: ModelQuestion,
    data: _Data,
    diagnosis: Diagnosis,
    catalogue: Mapping[str, Effect],
    studio: Studio,
) -> DiagnosisResult:
    titles = {name: effect.title for name, effect in catalogue.items()}
    predictor, best, start = diagnosis.predictor, diagnosis.best, question.start
    judgement = diagnosis.judgement
    rivals = [] if judgement is None else rivals_beside(best, predictor, judgement)
    residual = diagnosis.path[-1].fitted_model.residual  # of the best model, as a comparison shows it
    full_scale = float(np.max(np.abs(predictor.measured / predictor.scale)))
    muscle = best.fit_model.muscle
    envelope = envelope_of(question.specimens, predictor, best.fit_model)
    suspects = _suspects(question, diagnosis)
    over_windows, why_none = windows_result(predictor, best.fit_model, question.noise)
    validation, of_check = _check(question, best.fit_model, envelope)
    return DiagnosisResult(
        run=reach_of(()),
        rows=data.rows,
        rows_used=predictor.rows_used,
        excluded=data.excluded,
        kind=predictor.kind,
        predicted=predictor.predicted,
        unit=predictor.unit,
        baseline=Baseline(
            rmse=diagnosis.start.rmse,
            nrmse_percent=100.0 * diagnosis.start.rmse / full_scale if full_scale else None,
            holdout_rmse=diagnosis.start.holdout_rmse,
        ),
        noise_floor=NoiseFloor(
            diagnosis.noise,
            diagnosis.noise_how,
            None if diagnosis.noise_interval is None else list(diagnosis.noise_interval),
        ),
        channels=channel_misfits(predictor, residual * predictor.scale),
        where=list(diagnosis.where),
        candidates=[
            replace(
                _candidate(question, candidate, catalogue, diagnosis.best.noises),
                probability=None if diagnosis.unfinished else diagnosis.probability_of(candidate.effect.id),
            )
            for candidate in diagnosis.candidates
        ],
        path=[
            PathPoint(
                added=step.added,
                refitted=step.refitted,
                correction=step.correction,
                rmse=step.fitted_model.rmse,
                holdout_rmse=step.fitted_model.holdout_rmse,
                model=_model(question, step.fitted_model),
                freed=sorted(step.fitted_model.freed),
                fitted=len(step.fitted_model.free),
            )
            for step in diagnosis.path
        ],
        verdict=_verdict(question, diagnosis, catalogue, suspects, rivals),
        rivals=rivals,
        suspect_rows=suspects,
        parameters=parameter_table(best.fit_model, diagnosis.fit),
        correlations=correlations_of(diagnosis.fit),
        geometry=geometry_of(start, muscle),
        model=DiagnosedModel(
            muscle={
                name: float(value)
                for name, value in muscle._asdict().items()
                if value and (name != "nominal_length" or question.specimens.one_length)
            },
            effects=question.effect_document(best.fit_model),
            drive=drive_of_model(question, best.fit_model, studio),
        ),
        freed=sorted({*best.freed, *ended(best, diagnosis.added)}),
        not_tried=list(diagnosis.not_tried),
        messages=[
            *question.opening,
            *question.unread_messages,
            *beyond(question.envelope, envelope),
            *question.points.measurement.messages,
            *(str(notice) for notice in curve_fit_notices(question.curve_fit)),
            *data.notes,
            *diagnosis.messages,
            *start_messages(diagnosis.fit),
            *notes_of(diagnosis.context, titles),
            *absorbed_message(diagnosis.absorbed, predictor.unit),
            *([why_none] if why_none else []),
            *of_check,
        ],
        experiment=with_accepted(common_experiment(question), question.accepted, best.fit_model),
        unread=question.unread,
        assumptions=[assumption.message for assumption in question.assumptions],
        specimens=specimen_results(question, predictor, residual, best, diagnosis.left_out),
        absorbed=list(diagnosis.absorbed),
        context=doubtful_entries(diagnosis.context, titles),
        envelope=envelope,
        covariance=None if diagnosis.fit is None else diagnosis.fit.covariance,
        windows=over_windows,
        validation=validation,
    )


def _check(
    question: ModelQuestion, fit_model: FitModel, envelope: Envelope
) -> tuple[CheckError | None, list[str]]:
    """The error of the best model on the measurements that are kept for it, and remarks."""
    if question.validation is None:
        return None, []
    try:
        found, _, remarks, stopped = checked(question, question.validation, fit_model, envelope)
    except InputError as error:  # which is no reason to withhold the verdict
        return None, [f"validation: {error.message}"]
    error = CheckError(found.rmse, found.nrmse_percent, found.rows_used)
    return error, [*remarks, *(run.sentence for run in stopped)]


def _model(question: ModelQuestion, fitted: FittedModel) -> ModelDocument:
    return ModelDocument(question.effect_document(fitted.fit_model))


def _suspects(question: ModelQuestion, diagnosis: Diagnosis) -> list[SuspectRow]:
    """The rows that were set aside, with their files."""
    whole = diagnosis.with_them
    if whole is None or whole.judgement is None:
        return []
    return suspect_rows(
        question, whole.predictor, aside_of(diagnosis), suspects_of(diagnosis), whole.judgement
    )


def _verdict(
    question: ModelQuestion,
    diagnosis: Diagnosis,
    catalogue: Mapping[str, Effect],
    suspects: Sequence[SuspectRow],
    rivals: Sequence[Rival],
) -> Verdict:
    titles = {name: effect.title for name, effect in catalogue.items()}
    bounds = bounds_sentence(diagnosis, catalogue)
    judgement = diagnosis.judgement
    return Verdict(
        status=diagnosis.status,
        title=title_of(
            diagnosis.status,
            added=bool(diagnosis.added),
            doubted=any(entry.stands for entry in diagnosis.context),
            none_likely=diagnosis.none_likely,
        ),
        effects=list(diagnosis.added),
        indistinguishable=groups_of(diagnosis),
        probabilities={name: item.probability for item in diagnosis.evidence for name in item.group},
        applied=applied_reasons(diagnosis, catalogue),
        corrections=[
            CorrectionResult(
                item.effect, item.before, item.after, item.probability, item.kept, correction_reason(item)
            )
            for item in diagnosis.corrections
        ],
        superfluous=[item.effect for item in diagnosis.superfluous],
        proofs=None if judgement is None else proofs_of(judgement),
        why_not={} if judgement is None else open_proofs(judgement),
        unexplained_share=unexplained_share(diagnosis.status, diagnosis.best, diagnosis.noise, judgement),
        unexplained_in=[] if judgement is None else list(judgement.depends_on),
        repeats=_repetition(diagnosis),
        proposed_term=_term(question, diagnosis),
        where_to_look=where_to_look(diagnosis) or None,
        at_bounds=bounds or None,
        next_measurement=next_measurement(diagnosis, titles),
        experiments=[proposal(pair) for pair in diagnosis.proposals],
        next_experiments=[next_experiment(design) for design in diagnosis.designs if design.decided()],
        sentence=" ".join(
            text
            for text in (
                *(assumption.sentence for assumption in question.assumptions),
                questions_of(diagnosis.context, titles),
                sentence_of(diagnosis, catalogue),
                ""
                if judgement is None or not open_proofs(judgement)
                else rival_sentence(diagnosis.best, diagnosis.predictor, judgement, rivals),
                aside_sentence(diagnosis, [each.place for each in suspects], catalogue),
                bounds,
                corrections_sentence(diagnosis, titles),
                superfluous_sentence(diagnosis, titles),
                left_out_sentence(diagnosis),
            )
            if text
        ),
    )


def _repetition(diagnosis: Diagnosis) -> RepetitionResult | None:
    found = diagnosis.repetition
    if found is None:
        return None
    return RepetitionResult(
        over=found.over,
        unit=_UNITS[found.over],
        period=found.period,
        share=found.share,
        amplitude=found.amplitude,
        grows_with_pressure=found.grows,
        parts=found.parts,
        shown=found.shown,
        also=[SamePeriod(over, period) for over, period in found.also],
        text=repeats(diagnosis),
    )


def groups_of(diagnosis: Diagnosis) -> list[list[str]]:
    """Groups of effects that the data cannot distinguish: each added effect with its alternatives."""
    groups = []
    for added in diagnosis.added:
        others = [other.effect for other in diagnosis.alternatives if other.of == added]
        if others:
            groups.append([added, *others])
    return groups


def _candidate(
    question: ModelQuestion,
    candidate: SingleAddition,
    catalogue: Mapping[str, Effect],
    noises: Noises | None,
) -> CandidateResult:
    """A candidate; its standard errors are not known before the noise is, that of the best model."""
    fitted, effect = candidate.fitted_model, candidate.effect
    other = catalogue.get(candidate.twins[0]) if candidate.twins else None
    twin = None if other is None else declared(effect, other)
    return CandidateResult(
        effect=effect.id,
        title=effect.title,
        rmse=fitted.rmse,
        holdout_rmse=fitted.holdout_rmse,
        gain_percent=100.0 * candidate.gain,
        score_change=candidate.score,
        parameters=_parameters(fitted, effect, noises),
        twins=list(candidate.twins),
        why=candidate.why,
        equation=effect.equation,
        freed=sorted(fitted.freed),
        next_measurement=None if twin is None else twin.separated_by,
        model=_model(question, fitted),
    )


def _parameters(fitted: FittedModel, effect: Effect, noises: Noises | None) -> dict[str, ParameterValue]:
    errors = [None] * len(fitted.free) if noises is None else fitted.standard_errors_under(noises)
    places = {p.name: number for number, p in enumerate(fitted.free)}
    values = {}
    for p in effect.parameters:
        place = places.get(f"{effect.id}.{p.name}")
        values[p.name] = ParameterValue(
            value=fitted.fit_model.values[effect.id][p.name],
            stderr=None if place is None else errors[place],
            unit=p.unit,
            at_bound=place is not None and bool(fitted.at_bound[place]),
            fitted=place is not None,
        )
    return values


def _term(question: ModelQuestion, diagnosis: Diagnosis) -> TermProposal | None:
    """The proposed term, a model with it, and a curve over its most important variable."""
    term = diagnosis.term
    if term is None:
        return None
    effects = question.effect_document(diagnosis.best.fit_model)
    formula, coefficients = term.formula, dict(term.coefficients)
    if CUSTOM in effects:  # a model has only one custom term: the new one is added to it
        formula, coefficients = _joined(effects[CUSTOM], formula, coefficients)
    variables = variables_of(diagnosis.predictor, diagnosis.best.fit_model)
    name = next(
        (n for n in (diagnosis.judgement.depends_on if diagnosis.judgement else ()) if n in SYMBOLS.values()),
        next(n for n in SYMBOLS.values() if n in variables),
    )
    x = variables[name]
    rows = np.argsort(x, kind="stable")
    rows = rows[np.unique(np.linspace(0, len(rows) - 1, _CURVE).astype(int))]
    return TermProposal(
        formula=formula,
        coefficients=coefficients,
        kind="smooth" if term.smooth else "short",
        share=term.share,
        band=term.band,
        model=ModelDocument({**effects, CUSTOM: {TERM: formula, **coefficients}}),
        curve=TermCurve(name, x[rows], term.values[rows], diagnosis.best.residual[rows]),
    )


def _joined(
    old: Mapping[str, float | str], formula: str, coefficients: Mapping[str, float]
) -> tuple[str, dict[str, float]]:
    """The sum of a custom term and a proposed one; the coefficients of the proposed one are renamed."""
    renamed = {name: f"d{name[1:]}" for name in coefficients}
    for name, other in renamed.items():
        formula = re.sub(rf"\b{name}\b", other, formula)
    values = {renamed[name]: value for name, value in coefficients.items()}
    values |= {name: float(value) for name, value in old.items() if name != TERM}
    return f"{old[TERM]} + {formula}", values
