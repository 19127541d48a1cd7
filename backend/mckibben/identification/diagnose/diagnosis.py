"""Diagnosis of a model: candidate effects, the best model, its alternatives, and the verdict."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from mckibben.identification.diagnose.contest import contest
from mckibben.identification.diagnose.corrections import Correction
from mckibben.identification.diagnose.design import DesignedExperiment, Designer
from mckibben.identification.diagnose.entries import Statements
from mckibben.identification.diagnose.judgement import Judgement, without_suspects
from mckibben.identification.diagnose.left_out import LeftOutSpecimen, left_out_specimens
from mckibben.identification.diagnose.next_measurement import SeparatingExperiment, next_measurements
from mckibben.identification.diagnose.probability import Evidence, ModelWeights, beside, none_likely
from mckibben.identification.diagnose.repetition import Repetition
from mckibben.identification.diagnose.reweighted import reweighted
from mckibben.identification.diagnose.sign_changes import sign_changes
from mckibben.identification.diagnose.stages import NotTried, Prepared, named, prepare, searched, singles
from mckibben.identification.diagnose.steps import (
    PathStep,
    SingleAddition,
    known_path,
)
from mckibben.identification.diagnose.superfluous import Superfluous, superfluous
from mckibben.identification.diagnose.twins import Alternative
from mckibben.identification.diagnose.verdict import (
    Interval,
    Status,
    is_force,
    messages,
    noise_interval,
    status_of,
)
from mckibben.identification.diagnose.wrong_entry import WrongEntry
from mckibben.identification.fit.effort import SearchEffort, diagnosis_effort
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import CancelledError
from mckibben.identification.fit.least_squares import FitResult, fit_report
from mckibben.identification.predict.fit_model import FitModel, Free
from mckibben.identification.predict.predictor import Predictor
from mckibben.identification.predict.reading_errors import AbsorbedError
from mckibben.identification.predict.specimens import SpecimensPredictor
from mckibben.identification.residual.noise import absorbed_by
from mckibben.identification.residual.profiles import Profile, profiles
from mckibben.identification.residual.term import Term, proposed_term
from mckibben.identification.thresholds import PROBABILITY
from mckibben.physics.effect import Effect
from mckibben.simulation.outcome import Outcome, Watch

#: Fewest values for a diagnosis: with fewer, many single effects fit them exactly.
FEWEST_VALUES = 6


@dataclass(frozen=True)
class Unfinished:
    """How far a diagnosis came that its limit of time ended.

    Attributes:
        tried: effects that were tried alone.
        candidates: effects that could be tried.
        models: models that were fitted.
        limit: of time [s].
    """

    tried: int
    candidates: int
    models: int
    limit: float


@dataclass(frozen=True)
class Diagnosis:
    """Result of a diagnosis.

    Attributes:
        predictor: the data.
        start: the start model as given, not refitted.
        root: the start model refitted.
        noise: of the scaled residual; None when it cannot be estimated.
        noise_how: how it was obtained.
        noise_interval: from the scatter of neighbouring readings to all that is left; None where that is not
            noise alone.
        judgement: what speaks for and against the best model; None where the limit of time ended it before.
        where: the start model's residual over each variable.
        left_where: the best model's residual over each variable.
        candidates: single additions, the best first; their errors, and those of the path, are those that a
            comparison with each model shows.
        path: steps to the best model; each adds the effect that lowers the error most, corrections last.
        best: the best model, with the corrections that it keeps.
        lean: the same with those corrections only that the alternatives hold as well.
        fit: its parameters with standard errors.
        status: adequate, missing_effects, ambiguous, unknown_effect, undecided, or unfinished.
        added: effects of the best model that the start model does not have.
        alternatives: effects that could replace one of these.
        repetition: what of the last residual of an unknown effect is periodic; None without it.
        term: a formula that lowers the error of the folds left out; None without one.
        proposals: experiments that would separate the alternatives.
        designs: for each group of alternatives the experiment of this rig that splits it best.
        messages: notes for the user.
        not_tried: effects of the catalogue that were not candidates, with the reason.
        context: entries that may be wrong instead, the most convincing first.
        absorbed: reading errors within the stated accuracy that explain a part of the residual.
        corrections: effects that lower the error but are not called missing.
        superfluous: effects of the start model that the data do not need.
        evidence: of each effect of the best model.
        weights: of the models that the search visited.
        left_out: of several specimens, each predicted by the best model fitted to the others.
        none_likely: whether the status is unknown_effect because none of the named effects is likely, and not
            because of what they leave.
        with_them: the diagnosis of all rows, where some were set aside because they do not fit.
        unfinished: how far it came, where the limit of time ended it: then it is the best of what was fitted
            until then, and what the data cannot tell from it was not looked for. None when it is complete.
    """

    predictor: Predictor
    start: FittedModel
    root: FittedModel
    noise: float | None
    noise_how: str
    noise_interval: Interval | None
    judgement: Judgement | None
    where: tuple[Profile, ...]
    left_where: tuple[Profile, ...]
    candidates: tuple[SingleAddition, ...]
    path: tuple[PathStep, ...]
    best: FittedModel
    lean: FittedModel
    fit: FitResult | None
    status: Status
    added: tuple[str, ...]
    alternatives: tuple[Alternative, ...]
    repetition: Repetition | None
    term: Term | None
    proposals: tuple[SeparatingExperiment, ...]
    designs: tuple[DesignedExperiment, ...] = ()
    messages: tuple[str, ...] = ()
    not_tried: tuple[NotTried, ...] = ()
    context: tuple[WrongEntry, ...] = ()
    absorbed: tuple[AbsorbedError, ...] = ()
    corrections: tuple[Correction, ...] = ()
    superfluous: tuple[Superfluous, ...] = ()
    evidence: tuple[Evidence, ...] = ()
    weights: ModelWeights | None = None
    left_out: tuple[LeftOutSpecimen, ...] = ()
    none_likely: bool = False
    with_them: Diagnosis | None = None
    unfinished: Unfinished | None = None

    def probability_of(self, effect: str) -> float:
        """Probability that an effect, or one that the data cannot tell from it, is missing."""
        of_group = [item.probability for item in self.evidence if effect in item.group]
        of_correction = [item.probability for item in self.corrections if item.effect == effect]
        if of_group:
            return max(of_group)
        visited = 0.0 if self.weights is None else self.weights.share([effect])
        return max([PROBABILITY.likely * visited, *of_correction])


def diagnose(
    predictor: Predictor,
    fit_model: FitModel,
    *,
    catalogue: Mapping[str, Effect],
    geometry: Sequence[Free] = (),
    freed: Sequence[str] = (),
    noise: float | None = None,
    statements: Statements | None = None,
    load: Free | None = None,
    effort: SearchEffort | None = None,
    watch: Watch | None = None,
    on_candidate: Callable[[SingleAddition], None] = lambda _: None,
) -> Diagnosis:
    """Find the effects that a model of a measurement lacks.

    Args:
        predictor: the data.
        fit_model: the start model.
        catalogue: effects to choose from.
        geometry: geometry fields that fits may change.
        freed: further constants of the start model that fits may change, as "effect.parameter".
        noise: standard deviation of the predicted channel [SI], when it is known.
        statements: what is stated about the data and may be wrong; by default nothing is doubted.
        load: a stated load with its range, where fits may change it.
        effort: limits of the search; by default they depend on the cost of a prediction.
        watch: receives the progress and may cancel.
        on_candidate: receives each candidate as soon as it is fitted, or guessed if it promises little.

    Returns:
        The diagnosis; where the time limit of the watch ended it, the best of what was fitted until then.

    Raises:
        CancelledError: the watch cancelled, or the time is over before the start model is fitted.
        InputError: runs of the best model stop before their end.
    """
    from threadpoolctl import threadpool_limits

    watch = watch or Watch(time_limit=np.inf)

    def diagnosed(data: Predictor) -> Diagnosis:
        begun = prepare(
            data,
            fit_model,
            catalogue=catalogue,
            geometry=geometry,
            load=load,
            freed=frozenset(freed),
            noise=noise,
            effort=effort or diagnosis_effort(simulated=data.simulated),
            watch=watch,
            on_candidate=on_candidate,
        )
        try:
            return _whole(begun, fit_model, catalogue=catalogue, noise=noise, statements=statements)
        except CancelledError as end:
            if end.outcome is not Outcome.TIMED_OUT:
                raise
            return _so_far(begun, watch.time_limit)

    def again(without: Predictor) -> Diagnosis | None:
        try:
            found = diagnosed(without)
        except CancelledError as end:
            if end.outcome is not Outcome.TIMED_OUT:
                raise
            return None
        return found if found.unfinished is None else None  # what was found before is whole

    # The matrices are small: several linear-algebra threads would be slower than one.
    with threadpool_limits(1):
        whole = diagnosed(predictor)
        found = without_suspects(predictor, whole, again, lambda diagnosis: diagnosis.judgement)
        return whole if found is whole else _with_all_rows(found, whole)


def _with_all_rows(without: Diagnosis, whole: Diagnosis) -> Diagnosis:
    """A diagnosis that sets rows aside, with the errors of all rows, as a comparison shows them."""
    predictor = whole.predictor

    def shown(model: FittedModel) -> FittedModel:
        residual = predictor.weighted(predictor.residual(model.fit_model))
        jacobian = model.jacobian
        if model.free:
            jacobian = predictor.weighted(predictor.linearised(model.fit_model, model.free)[1])
        return replace(model, residual=residual, jacobian=jacobian, aside=None)

    return replace(
        without,
        start=shown(without.start),
        path=tuple(replace(step, fitted_model=shown(step.fitted_model)) for step in without.path),
        candidates=tuple(replace(one, fitted_model=shown(one.fitted_model)) for one in without.candidates),
        with_them=whole,
    )


def _whole(
    prepared: Prepared,
    fit_model: FitModel,
    *,
    catalogue: Mapping[str, Effect],
    noise: float | None,
    statements: Statements | None,
) -> Diagnosis:
    """The whole diagnosis.

    Raises:
        CancelledError: the watch ended it; ``prepared`` holds what was found.
    """
    fitter, predictor, progress = prepared.fitter, prepared.predictor, prepared.progress
    single = singles(prepared)
    progress.share, progress.end = 0.45, 0.85
    found = searched(prepared, single, noise)
    progress.share, progress.end = 0.85, 0.95
    missing = named(prepared, found, noise)
    ranked = single.ranked(prepared, found.level)
    context: tuple[WrongEntry, ...] = ()
    if statements is not None:
        context = contest(
            statements, fitter=fitter, first=prepared.first, root=prepared.root, best=found.model,
            stated_noise=noise, beside=prepared.beside_a_surface,
        )  # fmt: skip
    best, judgement = missing.best, missing.judgement
    doubted = any(entry.stands for entry in context)
    status = status_of(judgement, missing.added, missing.alternatives, doubted=doubted)
    left = status == "unknown_effect"
    unlikely = not left and not doubted and none_likely(missing.evidence)
    fit = _final_fit(best)
    shown = partial(reweighted, predictor)
    designer = Designer.of(predictor, missing.lean, found.level) if missing.alternatives else None
    pairs, designs = next_measurements(
        designer or Designer((), found.level), missing.lean, missing.alternatives, catalogue
    )
    progress.share = 0.95
    reversals = predictor.at_reversals(best.fit_model)
    return Diagnosis(
        predictor=predictor,
        start=prepared.start,
        root=prepared.root,
        noise=judgement.noise,
        noise_how=missing.noise_how,
        noise_interval=noise_interval(judgement),
        judgement=judgement,
        where=tuple(prepared.where),
        left_where=tuple(profiles(best.residual, prepared.variables, predictor.folds[0])),
        candidates=tuple(replace(one, fitted_model=shown(one.fitted_model)) for one in ranked),
        path=tuple(replace(step, fitted_model=shown(step.fitted_model)) for step in missing.path),
        best=best,
        lean=missing.lean,
        fit=fit,
        status="unknown_effect" if unlikely else status,
        added=missing.added,
        alternatives=missing.alternatives,
        repetition=judgement.repeats if left else None,
        term=_term(best, prepared) if left and is_force(predictor) else None,
        proposals=tuple(pairs),
        designs=tuple(designs),
        messages=(
            *([] if prepared.gauge_zero is None else [prepared.gauge_zero.message]),
            *messages(fitter, best, fit, missing.added),
            *(
                []
                if reversals is None
                else filter(None, [reversals.sentence(judgement.noise, judgement.rmse)])
            ),
            *predictor.assumed_history(best.fit_model),
            *sign_changes(fitter, fit_model, best),
        ),
        not_tried=tuple(prepared.not_tried),
        context=context,
        absorbed=absorbed_by(predictor, best.fit_model),
        corrections=missing.corrections,
        superfluous=superfluous(fitter, best, prepared.root),
        evidence=beside(missing.evidence, context),
        weights=missing.weights,
        left_out=left_out_specimens(predictor, best) if isinstance(predictor, SpecimensPredictor) else (),
        none_likely=unlikely,
    )


def _term(best: FittedModel, prepared: Prepared) -> Term | None:
    """A formula for what the best model leaves: a short one, or else a smooth description."""
    predictor = prepared.predictor
    propose = partial(
        proposed_term, best.residual, prepared.variables, folds=predictor.folds,
        basis=best.jacobian[:, best.inner], weigh=predictor.weighted,
    )  # fmt: skip
    return propose() or propose(smooth=True)


def _so_far(prepared: Prepared, limit: float) -> Diagnosis:
    """The best of the models that were fitted until the time was over; nothing more is fitted."""
    fitter, predictor, start, root = prepared.fitter, prepared.predictor, prepared.start, prepared.root
    steps = known_path(fitter, root)
    best = steps[-1].fitted_model if steps else root
    path = [PathStep(None, start)]
    if prepared.gauge_zero is not None:
        path.append(PathStep(prepared.gauge_zero.effect.id, root))
    elif root.free:
        path.append(PathStep(None, root, refitted=True))
    path += steps
    added = tuple(step.added for step in path if step.added)
    shown = partial(reweighted, predictor)
    left = [effect for effect in prepared.candidates if effect.id not in prepared.singles]
    return Diagnosis(
        predictor=predictor,
        start=start,
        root=root,
        noise=fitter.noise,
        noise_how=prepared.noise_how,
        noise_interval=None,
        judgement=None,
        where=tuple(prepared.where),
        left_where=tuple(profiles(best.residual, prepared.variables, predictor.folds[0])),
        candidates=tuple(
            replace(one, fitted_model=shown(one.fitted_model))
            for one in sorted(prepared.singles.values(), key=lambda single: single.score)
        ),
        path=tuple(replace(step, fitted_model=shown(step.fitted_model)) for step in path),
        best=best,
        lean=best,
        fit=_final_fit(best),
        status="unfinished",
        added=added,
        alternatives=(),
        repetition=None,
        term=None,
        proposals=(),
        messages=() if prepared.gauge_zero is None else (prepared.gauge_zero.message,),
        not_tried=(
            *prepared.not_tried,
            *(NotTried(effect.id, "the limit of time ended the diagnosis before") for effect in left),
        ),
        absorbed=absorbed_by(predictor, best.fit_model),
        unfinished=Unfinished(len(prepared.singles), len(prepared.candidates), len(fitter.known), limit),
    )


def _final_fit(best: FittedModel) -> FitResult | None:
    if not best.free:
        return None
    # The numbers are those of the model, which is at its minimum: what is reported and what is saved agree.
    numbers = np.array([p.start for p in best.free])
    return fit_report(numbers, best.jacobian, -best.residual, best.free, noise_lines=best.noise_lines)
