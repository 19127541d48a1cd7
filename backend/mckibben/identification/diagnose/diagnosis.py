"""Diagnosis of a model: candidate effects, the best model, its alternatives, and the verdict."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial

import numpy as np

from mckibben.facts.result import result_class
from mckibben.identification.diagnose.contest import contest
from mckibben.identification.diagnose.corrections import Correction, refined, without_corrections
from mckibben.identification.diagnose.design import DesignedExperiment, Designer
from mckibben.identification.diagnose.entries import Statements
from mckibben.identification.diagnose.gauge_zero import GaugeZero, vented
from mckibben.identification.diagnose.judgement import DIGITS, Judgement, judged, without_suspects
from mckibben.identification.diagnose.left_out import LeftOutSpecimen, left_out_specimens
from mckibben.identification.diagnose.needed import pruned
from mckibben.identification.diagnose.next_measurement import SeparatingExperiment, next_measurements
from mckibben.identification.diagnose.probability import Evidence, ModelWeights, beside, loss, none_likely
from mckibben.identification.diagnose.progress import Progress
from mckibben.identification.diagnose.reason import traits_of
from mckibben.identification.diagnose.repetition import Repetition
from mckibben.identification.diagnose.reweighted import reweighted
from mckibben.identification.diagnose.search import search
from mckibben.identification.diagnose.sign_changes import sign_changes
from mckibben.identification.diagnose.steps import (
    PathStep,
    SingleAddition,
    known_path,
    path_to,
    single_addition,
)
from mckibben.identification.diagnose.superfluous import Superfluous, superfluous
from mckibben.identification.diagnose.supported import supported
from mckibben.identification.diagnose.twins import Alternative, likeliest, same, same_predictions
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
from mckibben.identification.fit.fitted_model import FittedModel, unfitted
from mckibben.identification.fit.fitter import CancelledError, Fitter
from mckibben.identification.fit.least_squares import FitResult, fit_report
from mckibben.identification.predict.fit_model import FitModel, Free
from mckibben.identification.predict.predictor import Predictor
from mckibben.identification.predict.reading_errors import AbsorbedError
from mckibben.identification.predict.specimens import SpecimensPredictor
from mckibben.identification.residual.noise import absorbed_by, allowing_for_errors, noise_of
from mckibben.identification.residual.profiles import Profile, profiles, variables_of
from mckibben.identification.residual.term import Term, proposed_term
from mckibben.identification.thresholds import PROBABILITY
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError
from mckibben.simulation.outcome import Outcome, Watch

#: Fewest values for a diagnosis: with fewer, many single effects fit them exactly.
FEWEST_VALUES = 6
_STOPS = "with it the model stops before the end of a run"


@result_class
class NotTried:
    """An effect that was not a candidate, and why; ``needs_time``: the time of each row would make it one."""

    effect: str
    """Its id."""
    why: str
    """The reason."""
    needs_time: bool = False
    """Whether the time of each row would make it a candidate."""


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
        begun = _begin(
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
            return _search(begun, fit_model, catalogue=catalogue, noise=noise, statements=statements)
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


@dataclass
class _Begun:
    """A diagnosis whose start model is fitted, and what it has found since."""

    progress: Progress
    fitter: Fitter
    start: FittedModel
    first: FitModel
    root: FittedModel
    noise_how: str
    gauge_zero: GaugeZero | None
    candidates: tuple[Effect, ...]
    not_tried: list[NotTried]
    on_candidate: Callable[[SingleAddition], None]
    singles: dict[str, SingleAddition] = field(default_factory=dict)

    @property
    def predictor(self) -> Predictor:
        return self.fitter.predictor

    @cached_property
    def variables(self) -> dict[str, np.ndarray]:
        """That the residual may depend on."""
        return variables_of(self.predictor, self.start.fit_model)

    @cached_property
    def where(self) -> list[Profile]:
        """The residual of the start model over each of them."""
        return profiles(self.start.residual, self.variables, self.predictor.folds[0])

    def tell(self, single: SingleAddition) -> None:
        """Pass on a candidate as soon as it is known."""
        self.singles[single.effect.id] = single
        self.on_candidate(single)


def _begin(
    predictor: Predictor,
    fit_model: FitModel,
    *,
    catalogue: Mapping[str, Effect],
    geometry: Sequence[Free],
    load: Free | None,
    freed: frozenset[str],
    noise: float | None,
    effort: SearchEffort,
    watch: Watch,
    on_candidate: Callable[[SingleAddition], None],
) -> _Begun:
    """The start model fitted.

    Raises:
        CancelledError: the watch ended the diagnosis before.
    """
    start_ids = set(fit_model.ids)
    absent = [effect for effect in catalogue.values() if effect.id not in start_ids]
    reasons = {effect: _why_not(effect, predictor) for effect in absent}
    candidates = tuple(effect for effect in absent if not reasons[effect])
    not_tried = [NotTried(e.id, why, why == predictor.without_time) for e, why in reasons.items() if why]
    progress = Progress(watch)
    predictor = allowing_for_errors(predictor.prepared(fit_model, candidates), fit_model)
    fitter = Fitter(
        predictor=predictor,
        geometry=tuple(geometry),
        candidates=candidates,
        noise=None,
        load=predictor.unknown_load or load,
        effort=effort,
        before_fit=progress.count_fit,
        estimate=lambda fitted_model: noise_of(predictor, fitted_model.residual, noise)[0],
    )
    start = unfitted(predictor, fit_model)
    readings = predictor.inputs.get("pressure")
    gauge_zero = None if readings is None else vented(readings, candidates)
    first = fit_model
    if gauge_zero is not None:
        fitter.fixed = frozenset({f"{gauge_zero.effect.id}.{gauge_zero.parameter}"})
        first = fit_model.adding(gauge_zero.effect, {gauge_zero.parameter: gauge_zero.value})
        candidates = tuple(effect for effect in candidates if effect is not gauge_zero.effect)
        fitter.candidates = candidates
    root = fitter.fit(first, freed)
    if fitter.load is not None and root.implausible:
        # The start model already has a constant tension, which the data cannot separate from the load.
        fitter.load = None
        fitter.known.clear()
        root = fitter.fit(first, freed)
    fitter.noise, how = noise_of(predictor, root.residual, noise)
    return _Begun(progress, fitter, start, first, root, how, gauge_zero, candidates, not_tried, on_candidate)


def _search(
    begun: _Begun,
    fit_model: FitModel,
    *,
    catalogue: Mapping[str, Effect],
    noise: float | None,
    statements: Statements | None,
) -> Diagnosis:
    """The whole diagnosis.

    Raises:
        CancelledError: the watch ended it; ``begun`` holds what was found.
    """
    fitter, predictor, progress = begun.fitter, begun.predictor, begun.progress
    start, root, gauge_zero, candidates = begun.start, begun.root, begun.gauge_zero, begun.candidates
    variables, where, how = begun.variables, begun.where, begun.noise_how
    before = traits_of(root.residual, variables)

    # The most promising first: whoever follows the search sees a useful answer at once, and a first one while
    # the equations of the other effects are compiled.
    def tell(effect: Effect, fitted_model: FittedModel) -> None:
        if not fitted_model.lost:
            begun.tell(single_addition(fitter, root, effect, fitted_model, before, ()))

    early = fitter.promising(root, [effect for effect in candidates if effect in predictor.quick])[:1]
    for effect in early:
        tell(effect, fitter.adding(root, effect))
    promising = fitter.promising(root, candidates)[: fitter.effort.tried]
    fitted_singles, guesses = [], []
    for number, effect in enumerate(dict.fromkeys([*promising, *candidates])):
        progress.share = 0.45 * number / max(len(candidates), 1)
        if number < len(promising):
            fitted_singles.append((effect, fitter.adding(root, effect)))
        else:
            if not guesses:
                fitter.guess_ahead(root, [each for each in candidates if each not in promising])
            guesses.append((effect, fitter.guessed(root, effect)))
        found = fitted_singles[-1] if number < len(promising) else guesses[-1]
        if effect not in early:
            tell(*found)
    begun.not_tried += [NotTried(effect.id, _STOPS) for effect, single in fitted_singles if single.lost]
    fitted_singles = [(effect, single) for effect, single in fitted_singles if not single.lost]
    progress.share, progress.end = 0.45, 0.85
    best = search(fitter, root, singles=[fitted_model for _, fitted_model in fitted_singles])
    best = pruned(fitter, best, root)
    # Simulated data have no noise: differences below their numerical resolution do not count.
    full_scale = float(np.max(np.abs(predictor.measured / predictor.scale)))
    judgement, how = _judged(fitter, best, noise)
    level = max(fitter.noise or best.rmse, DIGITS * full_scale)
    progress.share, progress.end = 0.85, 0.95
    start_names = set(root.fit_model.ids)
    searched = best
    lean, corrections = without_corrections(fitter, best, root, level)
    added = tuple(effect for effect in lean.fit_model.ids if effect not in start_names)
    corrected = {item.effect for item in corrections}
    lean, exchangeable = likeliest(fitter, lean, added, level, root=root, never=corrected)
    unknown = level if judgement.structured else None
    likely = supported(
        fitter, lean, root, exchangeable, noise=level, unknown=unknown,
        enough=not (judgement.structured or judgement.undecided),
    )  # fmt: skip
    if unknown is None and none_likely(likely.evidence):
        # Noise may look so, too, where what the start model leaves is not proved to be more.
        of_root = judged(root, predictor, noise_of(predictor, root.residual, noise)[0])
        likely = likely if of_root.structured else likely.without_any(root)
    exchangeable = [other for other in exchangeable if other.of in {item.effect for item in likely.evidence}]
    path = path_to(fitter, start, root, likely.firm, gauge_zero)
    added = tuple(step.added for step in path if step.added)
    refinements: list[tuple[str, FittedModel]] = []
    base = likely.steps[-1][1] if likely.steps else likely.firm
    if likely.evidence or likely.steps or searched is root:
        refinements, corrections = refined(fitter, base, searched, corrections)
    kept = (*likely.steps, *refinements)
    path += tuple(PathStep(name, model, correction=True) for name, model in kept)
    corrections = (*likely.corrections, *corrections)
    best = kept[-1][1] if kept else likely.firm
    if best is not searched:
        judgement, how = _judged(fitter, best, noise)
    if any(step.fitted_model.lost for step in path):
        raise InputError(
            "no diagnosis can be made: the model stops before the end of a run with some of the effects that "
            "the data show",
            field="measurement",
            hint="give the load more mass, or state more of the drive; 'compare' shows where it stops",
        )
    fit = _final_fit(best)
    by_effect = {item.effect: item for item in likely.evidence}
    support = []
    for name in added:
        if name not in by_effect:  # read before the search, a part of the start model since
            lost = loss(lean, fitter.dropping(lean, name), root, noise=level)
            by_effect[name] = Evidence(name, (name,), 1.0, lost, read=True)
        support.append(by_effect[name])
    changing = [
        (effect.id, fitted_model)
        for effect, fitted_model in fitted_singles
        if not same(fitted_model, root, level)
    ]
    alike = same_predictions(changing, level)
    ranked = sorted(
        (
            single_addition(fitter, root, effect, fitted_model, before, alike.get(effect.id, ()))
            for effect, fitted_model in (*fitted_singles, *guesses)
        ),
        key=lambda candidate: candidate.score,
    )
    context = ()
    if statements is not None:
        context = contest(
            statements, fitter=fitter, first=begun.first, root=root, best=searched, stated_noise=noise
        )
    doubted = any(entry.stands for entry in context)
    status = status_of(judgement, added, exchangeable, doubted=doubted)
    left = status == "unknown_effect"
    unlikely = not left and not doubted and none_likely(support)
    term = None
    if left and is_force(predictor):
        propose = partial(
            proposed_term, best.residual, variables, folds=predictor.folds,
            basis=best.jacobian[:, best.inner], weigh=predictor.weighted,
        )  # fmt: skip
        term = propose() or propose(smooth=True)
    shown = partial(reweighted, predictor)
    designer = Designer.of(predictor, lean, level) if exchangeable else Designer((), level)
    pairs, designs = next_measurements(designer, lean, exchangeable, catalogue)
    progress.share = 0.95
    reversals = predictor.at_reversals(best.fit_model)
    return Diagnosis(
        predictor=predictor,
        start=start,
        root=root,
        noise=judgement.noise,
        noise_how=how,
        noise_interval=noise_interval(judgement),
        judgement=judgement,
        where=tuple(where),
        left_where=tuple(profiles(best.residual, variables, predictor.folds[0])),
        candidates=tuple(replace(one, fitted_model=shown(one.fitted_model)) for one in ranked),
        path=tuple(replace(step, fitted_model=shown(step.fitted_model)) for step in path),
        best=best,
        lean=lean,
        fit=fit,
        status="unknown_effect" if unlikely else status,
        added=added,
        alternatives=tuple(exchangeable),
        repetition=judgement.repeats if left else None,
        term=term,
        proposals=tuple(pairs),
        designs=tuple(designs),
        messages=(
            *([] if gauge_zero is None else [gauge_zero.message]),
            *messages(fitter, best, fit, added),
            *([] if reversals is None else [reversals.sentence(judgement.noise)]),
            *predictor.assumed_history(best.fit_model),
            *sign_changes(fitter, fit_model, best),
        ),
        not_tried=tuple(begun.not_tried),
        context=context,
        absorbed=absorbed_by(predictor, best.fit_model),
        corrections=corrections,
        superfluous=superfluous(fitter, best, root),
        evidence=beside(support, context),
        weights=likely.weights,
        left_out=left_out_specimens(predictor, best) if isinstance(predictor, SpecimensPredictor) else (),
        none_likely=unlikely,
    )


def _judged(fitter: Fitter, model: FittedModel, stated_noise: float | None) -> tuple[Judgement, str]:
    """The judgement on a model, by the noise of what it leaves, and how that was obtained."""
    fitter.noise, how = noise_of(fitter.predictor, model.residual, stated_noise)
    judgement = judged(model, fitter.predictor, fitter.noise)
    if fitter.noise is not None and not judgement.structured:
        # What is left may be noise, whatever neighbouring readings share: so much is asked of an effect.
        fitter.noise = max(fitter.noise, model.rmse)
    return judgement, how


def _so_far(begun: _Begun, limit: float) -> Diagnosis:
    """The best of the models that were fitted until the time was over; nothing more is fitted."""
    fitter, predictor, start, root = begun.fitter, begun.predictor, begun.start, begun.root
    steps = known_path(fitter, root)
    best = steps[-1].fitted_model if steps else root
    path = [PathStep(None, start)]
    if begun.gauge_zero is not None:
        path.append(PathStep(begun.gauge_zero.effect.id, root))
    elif root.free:
        path.append(PathStep(None, root, refitted=True))
    path += steps
    added = tuple(step.added for step in path if step.added)
    shown = partial(reweighted, predictor)
    left = [effect for effect in begun.candidates if effect.id not in begun.singles]
    return Diagnosis(
        predictor=predictor,
        start=start,
        root=root,
        noise=fitter.noise,
        noise_how=begun.noise_how,
        noise_interval=None,
        judgement=None,
        where=tuple(begun.where),
        left_where=tuple(profiles(best.residual, begun.variables, predictor.folds[0])),
        candidates=tuple(
            replace(one, fitted_model=shown(one.fitted_model))
            for one in sorted(begun.singles.values(), key=lambda single: single.score)
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
        messages=() if begun.gauge_zero is None else (begun.gauge_zero.message,),
        not_tried=(
            *begun.not_tried,
            *(NotTried(effect.id, "the limit of time ended the diagnosis before") for effect in left),
        ),
        absorbed=absorbed_by(predictor, best.fit_model),
        unfinished=Unfinished(len(begun.singles), len(begun.candidates), len(fitter.known), limit),
    )


def _why_not(effect: Effect, predictor: Predictor) -> str:
    """Why an effect is not a candidate; empty for a candidate."""
    if effect.among_lengths and not predictor.several_lengths:
        return "it shows only among muscles of several lengths, and these are the data of one"
    return predictor.why_hidden(effect)


def _final_fit(best: FittedModel) -> FitResult | None:
    if not best.free:
        return None
    # The numbers are those of the model, which is at its minimum: what is reported and what is saved agree.
    numbers = np.array([p.start for p in best.free])
    return fit_report(numbers, best.jacobian, -best.residual, best.free, noise_lines=best.noise_lines)
