"""Which physical effect is missing: candidates, the best model, its twins, and an honest verdict."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mckibben.identification.diagnose.gauge_zero import Vented, vented
from mckibben.identification.diagnose.next_measurement import Proposal
from mckibben.identification.diagnose.reason import Seen, seen, why
from mckibben.identification.diagnose.score import effective_rows, score
from mckibben.identification.diagnose.search import search
from mckibben.identification.diagnose.twins import Alternative, alternatives, same, same_predictions
from mckibben.identification.diagnose.verdict import is_force, left_structure, messages, proposals, status_of
from mckibben.identification.fit.fitted_model import Node
from mckibben.identification.fit.fitter import CancelledError, Fits
from mckibben.identification.fit.least_squares import FitResult, least_squares_fit
from mckibben.identification.predict.fit_model import Setting
from mckibben.identification.predict.free import Free
from mckibben.identification.predict.predictor import Subject
from mckibben.identification.residual.noise import noise_of
from mckibben.identification.residual.profiles import Profile, profiles, variables_of
from mckibben.identification.residual.structure import Structure, Term, proposed_term
from mckibben.physics.effect import Effect
from mckibben.simulation.outcome import Outcome, Watch

#: Values that a diagnosis needs at least: fewer than these many effects fit by themselves.
FEWEST_VALUES = 6
_DIGITS = 1e-9  # of the largest value


@dataclass(frozen=True)
class Candidate:
    """The start model with one more effect, everything refitted.

    Attributes:
        effect: what was added.
        node: the fitted model.
        gain: share of the rms error that it took away.
        score: change of the score of `mckibben.identification.diagnose.score`; negative is better.
        twins: candidates whose fitted predictions are the same on these data.
        why: one sentence.
    """

    effect: Effect
    node: Node
    gain: float
    score: float
    twins: tuple[str, ...]
    why: str


@dataclass(frozen=True)
class Step:
    """One step of the path: what was added, and the errors after it."""

    added: str | None
    node: Node


@dataclass(frozen=True)
class NotTried:
    """An effect that was no candidate, and why."""

    effect: str
    why: str


@dataclass(frozen=True)
class Diagnosis:
    """The answer.

    Attributes:
        subject: the data.
        start: the start model as given, its residual over its scale.
        root: the start model refitted.
        noise: of the residual over its scale; None when it cannot be told. ``noise_how``: from what.
        where: the start model's residual over each variable.
        candidates: single additions, the best first.
        path: the best model, in the order of adding that lowers the error fastest.
        best: the best model; fit: its numbers with errors.
        status: adequate, missing_effects, ambiguous or unknown_effect.
        added: effects that the best model has and the start model has not.
        alternatives: effects that could stand in for one of these.
        structure: what a regression still predicts of the last residual; term: a formula for it.
        proposals: experiments that would separate what is alike.
        messages: what has to be said.
        not_tried: effects of the catalogue that were no candidates, with the reason.
    """

    subject: Subject
    start: Node
    root: Node
    noise: float | None
    noise_how: str
    where: tuple[Profile, ...]
    seen: Seen
    candidates: tuple[Candidate, ...]
    path: tuple[Step, ...]
    best: Node
    fit: FitResult | None
    status: str
    added: tuple[str, ...]
    alternatives: tuple[Alternative, ...]
    structure: Structure
    term: Term | None
    proposals: tuple[Proposal, ...]
    messages: tuple[str, ...] = ()
    not_tried: tuple[NotTried, ...] = ()


def diagnose(
    subject: Subject,
    setting: Setting,
    *,
    catalogue: Mapping[str, Effect],
    geometry: Sequence[Free] = (),
    freed: Sequence[str] = (),
    noise: float | None = None,
    watch: Watch | None = None,
    found: Callable[[Candidate], None] = lambda _: None,
) -> Diagnosis:
    """Find what a model of a measurement is missing.

    Args:
        subject: the data.
        setting: the start model.
        catalogue: effects to choose from.
        geometry: geometry that fits may change.
        freed: further constants of the start model that fits may change, as "effect.parameter".
        noise: standard deviation of the predicted channel [SI], when it is known.
        watch: may cancel, and is told the share that is done.
        found: told each candidate as it is tried.

    Raises:
        CancelledError: the watch said so.
    """
    from threadpoolctl import threadpool_limits

    # Many small decompositions: threads of the linear algebra only wait for each other.
    with threadpool_limits(1):
        return _diagnose(subject, setting, catalogue, geometry, frozenset(freed), noise, watch, found)


def _diagnose(
    subject: Subject,
    setting: Setting,
    catalogue: Mapping[str, Effect],
    geometry: Sequence[Free],
    freed: frozenset[str],
    noise: float | None,
    watch: Watch | None,
    found: Callable[[Candidate], None],
) -> Diagnosis:
    inside = set(setting.ids)
    absent = [effect for effect in catalogue.values() if effect.id not in inside]
    candidates = tuple(effect for effect in absent if subject.reveals(effect))
    not_tried = [NotTried(effect.id, why) for effect in absent if (why := subject.why_hidden(effect))]
    progress = _Progress(watch or Watch(time_limit=np.inf))
    work = Fits(
        subject,
        tuple(geometry),
        candidates,
        None,
        tell=progress.tell,
        estimate=lambda node: noise_of(subject, node.residual, noise)[0],
    )
    subject.prepare(setting, candidates, geometry)
    start = Node(
        setting, (), frozenset(), subject.residual(setting) / subject.scale,
        np.empty((len(subject.measured), 0)), subject.folds,
    )  # fmt: skip
    readings = subject.inputs.get("pressure")
    vent = None if readings is None else vented(readings, candidates)
    first = setting
    if vent is not None:
        work.held = frozenset({f"{vent.effect.id}.{vent.parameter}"})
        first = setting.adding(vent.effect, {vent.parameter: vent.value})
        candidates = tuple(effect for effect in candidates if effect is not vent.effect)
        work.candidates = candidates
    root = work.fit(first, freed)
    if subject.unknown_load is not None and root.implausible:
        # The start model has a constant tension of its own, which takes the place of the load.
        subject.unknown_load = None
        work.known.clear()
        root = work.fit(first, freed)
    work.noise, how = noise_of(subject, root.residual, noise)
    variables = variables_of(subject, setting.muscle.nominal_length)
    before = seen(root.residual, variables)
    where = profiles(start.residual, variables, subject.folds[0])
    fitted = {effect.id for effect in work.promising(root, candidates)[: subject.tried]}
    singles, guesses = [], []
    for number, effect in enumerate(sorted(candidates, key=lambda effect: effect.id not in fitted)):
        progress.share = 0.45 * number / max(len(candidates), 1)
        if effect.id in fitted:
            singles.append((effect, work.adding(root, effect)))
            found(_candidate(work, root, effect, singles[-1][1], before, ()))
        else:
            guesses.append((effect, work.guessed(root, effect)))
    progress.share, progress.end = 0.45, 0.85
    best = search(work, root, singles=[node for _, node in singles])
    work.noise, how = noise_of(subject, best.residual, noise)
    # Made-up data have no noise: what differs by less than their digits is the same.
    full_scale = float(np.max(np.abs(subject.measured / subject.scale)))
    level = max(work.noise or best.rmse, _DIGITS * full_scale)
    progress.share, progress.end = 0.85, 0.95
    path = _path(work, start, root, best, vent)
    added = tuple(step.added for step in path if step.added)
    proven = () if vent is None else (vent.effect.id,)
    others = tuple(alternatives(work, best, [name for name in added if name not in proven], level))
    fit = _final_fit(subject, best)
    changing = [(effect.id, node) for effect, node in singles if not same(node, root, level)]
    alike = same_predictions(changing, level)
    ranked = sorted(
        (
            _candidate(work, root, effect, node, before, alike.get(effect.id, ()))
            for effect, node in (*singles, *guesses)
        ),
        key=lambda candidate: candidate.score,
    )
    rest = left_structure(subject, best.residual, variables)
    status = status_of(start, best, work.noise, added, others, rest, full_scale)
    term = None
    if status == "unknown_effect" and is_force(subject):
        term = proposed_term(best.residual, variables, best.jacobian[:, best.inner])
    progress.share = 0.95
    return Diagnosis(
        subject, start, root, work.noise, how, tuple(where), before, tuple(ranked), path, best, fit, status,
        added, others, rest, term, tuple(proposals(best, others, catalogue, level, subject)),
        (*([] if vent is None else [vent.message]), *messages(work, first, best, fit)), tuple(not_tried),
    )  # fmt: skip


class _Progress:
    """Shares of the work, told to a watch."""

    def __init__(self, watch: Watch) -> None:
        self._watch = watch
        self.share, self.end = 0.0, 0.45

    def tell(self, _: str) -> None:
        """One more model is fitted."""
        self.share += 0.02 * (self.end - self.share)
        if self._watch.ended(self.share) in (Outcome.CANCELLED, Outcome.TIMED_OUT):
            raise CancelledError


def _candidate(
    work: Fits, root: Node, effect: Effect, node: Node, before: Seen, twins: Sequence[str]
) -> Candidate:
    rows = effective_rows(node.residual, work.subject.sweeps, work.subject.folds)
    change = score(node, rows=rows, noise=work.noise) - score(root, rows=rows, noise=work.noise)
    gain = 1.0 - node.rmse / root.rmse if root.rmse > 0.0 else 0.0
    return Candidate(effect, node, gain, change, tuple(twins), why(effect, before, gain=gain))


def _path(work: Fits, start: Node, root: Node, best: Node, vent: Vented | None) -> tuple[Step, ...]:
    steps = [Step(None, start)]
    if vent is not None:
        steps.append(Step(vent.effect.id, root))
    node, left = root, [e for e in best.setting.effects if e.id not in set(root.setting.ids)]
    while len(left) > 1:
        nexts = [(effect, work.adding(node, effect)) for effect in left]
        effect, node = min(nexts, key=lambda pair: pair[1].rmse)
        steps.append(Step(effect.id, node))
        left.remove(effect)
    if left:
        steps.append(Step(left[0].id, best))
    elif best.rmse < 0.98 * start.rmse:
        steps.append(Step(None, best))
    return tuple(steps)


def _final_fit(subject: Subject, best: Node) -> FitResult | None:
    if not best.free:
        return None
    freedom = [p.start for p in best.free]
    return least_squares_fit(
        lambda numbers: best.jacobian @ (np.asarray(numbers) - freedom) - best.residual,
        lambda _: best.jacobian,
        best.free,
        starts=1,
    )
