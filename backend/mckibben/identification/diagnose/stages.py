"""The stages of a diagnosis: prepare, single additions, sets of effects, and which of them are missing.

Each stage takes what the ones before found and adds its own; none of them is changed. What is common to all,
the fits that were made and the noise that is asked of them, stands in the fitter.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from mckibben.facts.result import result_class
from mckibben.identification.diagnose.corrections import Correction, refined, without_corrections
from mckibben.identification.diagnose.gauge_zero import GaugeZero, vented
from mckibben.identification.diagnose.judgement import DIGITS, Judgement, judged
from mckibben.identification.diagnose.needed import pruned
from mckibben.identification.diagnose.probability import Evidence, ModelWeights, loss, none_likely
from mckibben.identification.diagnose.progress import Progress
from mckibben.identification.diagnose.reason import ResidualTraits, traits_of
from mckibben.identification.diagnose.search import search
from mckibben.identification.diagnose.steps import (
    PathStep,
    SingleAddition,
    path_to,
    single_addition,
)
from mckibben.identification.diagnose.supported import supported
from mckibben.identification.diagnose.twins import Alternative, likeliest, same, same_predictions
from mckibben.identification.fit.comparison import with_found_starts
from mckibben.identification.fit.effort import SearchEffort
from mckibben.identification.fit.fitted_model import FittedModel, unfitted
from mckibben.identification.fit.fitter import Fitter
from mckibben.identification.predict.fit_model import FitModel, Free
from mckibben.identification.predict.predictor import Predictor
from mckibben.identification.residual.noise import allowing_for_errors, noise_of
from mckibben.identification.residual.profiles import Profile, profiles, variables_of
from mckibben.identification.residual.surface import log_evidence
from mckibben.identification.thresholds import SCORE
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError
from mckibben.simulation.outcome import Watch

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


@dataclass
class Prepared:
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
    _evidences: dict[FittedModel, float | None] = field(default_factory=dict)

    @property
    def predictor(self) -> Predictor:
        """The data."""
        return self.fitter.predictor

    @cached_property
    def variables(self) -> dict[str, np.ndarray]:
        """That the residual may depend on."""
        return variables_of(self.predictor, self.start.fit_model)

    @cached_property
    def where(self) -> list[Profile]:
        """The residual of the start model over each of them."""
        return profiles(self.start.residual, self.variables, self.predictor.folds[0])

    def beside_a_surface(self, model: FittedModel) -> float | None:
        """Log evidence of a model beside a free surface, see `log_evidence`."""
        if model not in self._evidences:
            self._evidences[model] = log_evidence(model, self.predictor)
        return self._evidences[model]

    def tell(self, single: SingleAddition) -> None:
        """Pass on a candidate as soon as it is known."""
        self.singles[single.effect.id] = single
        self.on_candidate(single)


@dataclass(frozen=True)
class Singles:
    """The start model with each single effect.

    Attributes:
        fitted: those that promise most, fitted.
        guessed: the others, to first order.
        before: traits of what the start model leaves.
    """

    fitted: tuple[tuple[Effect, FittedModel], ...]
    guessed: tuple[tuple[Effect, FittedModel], ...]
    before: ResidualTraits

    def ranked(self, prepared: Prepared, level: float) -> list[SingleAddition]:
        """All of them, the best first, with those that predict the same.

        Args:
            prepared: the data and the start model.
            level: of the noise; differences below it are none.
        """
        root, fitter = prepared.root, prepared.fitter
        changing = [(effect.id, model) for effect, model in self.fitted if not same(model, root, level)]
        alike = same_predictions(changing, level)
        return sorted(
            (
                single_addition(fitter, root, effect, model, self.before, alike.get(effect.id, ()))
                for effect, model in (*self.fitted, *self.guessed)
            ),
            key=lambda candidate: candidate.score,
        )


@dataclass(frozen=True)
class Searched:
    """The best model of the search over sets of effects.

    Attributes:
        model: the model.
        judgement: on it.
        noise_how: how its noise was obtained.
        level: of the noise that an effect is held against.
    """

    model: FittedModel
    judgement: Judgement
    noise_how: str
    level: float


@dataclass(frozen=True)
class Named:
    """Which effects are called missing.

    Attributes:
        best: the model with these, and the corrections that it keeps.
        lean: the same with those corrections only that the alternatives hold as well.
        path: the steps to it.
        added: the effects.
        alternatives: what could replace them.
        corrections: effects that lower the error but are not called missing.
        evidence: of each of the effects.
        weights: of the models that the search visited.
        judgement: on the best model.
        noise_how: how its noise was obtained.
    """

    best: FittedModel
    lean: FittedModel
    path: tuple[PathStep, ...]
    added: tuple[str, ...]
    alternatives: tuple[Alternative, ...]
    corrections: tuple[Correction, ...]
    evidence: tuple[Evidence, ...]
    weights: ModelWeights
    judgement: Judgement
    noise_how: str


def prepare(
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
) -> Prepared:
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
    fit_model = with_found_starts(predictor, fit_model, geometry)
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
    return Prepared(
        progress, fitter, start, first, root, how, gauge_zero, candidates, not_tried, on_candidate
    )


def singles(prepared: Prepared) -> Singles:
    """The start model with each candidate.

    The most promising come first: whoever follows the search sees a useful answer at once, and a first one
    while the equations of the other effects are compiled.

    Raises:
        CancelledError: the watch ended it; ``prepared`` holds what was found.
    """
    fitter, root, candidates = prepared.fitter, prepared.root, prepared.candidates
    before = traits_of(root.residual, prepared.variables)

    def tell(effect: Effect, model: FittedModel) -> None:
        if not model.lost:
            prepared.tell(single_addition(fitter, root, effect, model, before, ()))

    early = fitter.promising(root, [effect for effect in candidates if effect in prepared.predictor.quick])[
        :1
    ]
    for effect in early:
        tell(effect, fitter.adding(root, effect))
    promising = fitter.promising(root, candidates)[: fitter.effort.tried]
    others = [effect for effect in candidates if effect not in promising]
    fitted, guessed = [], []
    for effect in promising:
        prepared.progress.share = 0.45 * len(fitted) / max(len(candidates), 1)
        fitted.append((effect, fitter.adding(root, effect)))
        if effect not in early:
            tell(*fitted[-1])
    if others:
        fitter.guess_ahead(root, others)
    for effect in others:
        prepared.progress.share = 0.45 * (len(fitted) + len(guessed)) / len(candidates)
        guessed.append((effect, fitter.guessed(root, effect)))
        if effect not in early:
            tell(*guessed[-1])
    prepared.not_tried += [NotTried(effect.id, _STOPS) for effect, single in fitted if single.lost]
    whole = tuple((effect, single) for effect, single in fitted if not single.lost)
    return Singles(whole, tuple(guessed), before)


def searched(prepared: Prepared, single: Singles, stated_noise: float | None) -> Searched:
    """The best set of effects, without those that are likelier noise, and the judgement on it.

    Args:
        prepared: the data and the start model.
        single: the single additions.
        stated_noise: of the predicted channel, where it is stated.
    """
    fitter, predictor = prepared.fitter, prepared.predictor
    best = search(fitter, prepared.root, singles=[model for _, model in single.fitted])
    best = pruned(fitter, best, prepared.root)
    judgement, how = judged_anew(fitter, best, stated_noise)
    # Simulated data have no noise: differences below their numerical resolution do not count.
    full_scale = float(np.max(np.abs(predictor.measured / predictor.scale)))
    return Searched(best, judgement, how, max(fitter.noise or best.rmse, DIGITS * full_scale))


def named(prepared: Prepared, found: Searched, stated_noise: float | None) -> Named:
    """Which of the effects of the best set are missing, what could replace them, and what only corrects them.

    Args:
        prepared: the data and the start model.
        found: the best set.
        stated_noise: of the predicted channel, where it is stated.

    Raises:
        InputError: runs of the model stop before their end.
    """
    fitter, root, level = prepared.fitter, prepared.root, found.level
    lean, corrections = without_corrections(fitter, found.model, root, level)
    added = tuple(effect for effect in lean.fit_model.ids if effect not in set(root.fit_model.ids))
    corrected = {item.effect for item in corrections}
    lean, exchangeable = likeliest(fitter, lean, added, level, root=root, never=corrected)
    unknown = level if found.judgement.structured else None
    surface = found.judgement.surface
    likely = supported(
        fitter, lean, root, exchangeable, noise=level, unknown=unknown,
        beside=prepared.beside_a_surface,
        left=surface is None or surface.left > SCORE.at_floor * level,
        enough=not (found.judgement.structured or found.judgement.undecided),
    )  # fmt: skip

    def proved(model: FittedModel) -> bool:
        return judged(
            model, fitter.predictor, noise_of(fitter.predictor, model.residual, stated_noise)[0]
        ).structured

    if (
        unknown is None
        and likely.steps
        and any(each.formula for each in likely.corrections)
        and proved(likely.firm)
    ):
        likely = likely.without_corrections()  # they would hide that no effect explains the rest
    if unknown is None and none_likely(likely.evidence) and not proved(root):
        likely = likely.without_any(root)  # noise may look so, too
    path = path_to(fitter, prepared.start, root, likely.firm, prepared.gauge_zero)
    added = tuple(step.added for step in path if step.added)
    refinements: list[tuple[str, FittedModel]] = []
    base = likely.steps[-1][1] if likely.steps else likely.firm
    if likely.evidence or likely.steps or found.model is root:
        refinements, corrections = refined(fitter, base, found.model, corrections)
    kept = (*likely.steps, *refinements)
    path += tuple(PathStep(name, model, correction=True) for name, model in kept)
    if any(step.fitted_model.lost for step in path):
        raise InputError(
            "no diagnosis can be made: the model stops before the end of a run with some of the effects that "
            "the data show",
            field="measurement",
            hint="give the load more mass, or state more of the drive; 'compare' shows where it stops",
        )
    best = kept[-1][1] if kept else likely.firm
    judgement, how = found.judgement, found.noise_how
    if best is not found.model:
        judgement, how = judged_anew(fitter, best, stated_noise)
    by_effect = {item.effect: item for item in likely.evidence}
    for name in added:
        if name not in by_effect:  # read before the search, a part of the start model since
            lost = loss(lean, fitter.dropping(lean, name), root, noise=level)
            by_effect[name] = Evidence(name, (name,), 1.0, lost, read=True)
    of_named = {item.effect for item in likely.evidence}
    return Named(
        best=best,
        lean=lean,
        path=path,
        added=added,
        alternatives=tuple(other for other in exchangeable if other.of in of_named),
        corrections=(*likely.corrections, *corrections),
        evidence=tuple(by_effect[name] for name in added),
        weights=likely.weights,
        judgement=judgement,
        noise_how=how,
    )


def judged_anew(fitter: Fitter, model: FittedModel, stated_noise: float | None) -> tuple[Judgement, str]:
    """The judgement on a model, by the noise of what it leaves, and how that was obtained."""
    fitter.noise, how = noise_of(fitter.predictor, model.residual, stated_noise)
    judgement = judged(model, fitter.predictor, fitter.noise)
    if fitter.noise is not None and not judgement.structured:
        # What is left may be noise, whatever neighbouring readings share: so much is asked of an effect.
        fitter.noise = max(fitter.noise, model.rmse)
    return judgement, how


def _why_not(effect: Effect, predictor: Predictor) -> str:
    """Why an effect is not a candidate; empty for a candidate."""
    if effect.among_lengths and not predictor.several_lengths:
        return "it shows only among muscles of several lengths, and these are the data of one"
    return predictor.why_hidden(effect)
