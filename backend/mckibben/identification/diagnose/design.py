r"""The next experiment: the one that a rig can run and that tells models apart best.

Every model predicts every experiment. Let d be the difference of two predictions in standard deviations of a
reading. The other model may adapt its parameters, but not beyond what the present data allow, so what the
experiment shows is

.. math:: r = d - J\delta,\qquad \delta = \arg\min_\delta |d - J\delta|^2 + |K\delta|^2 + |\delta/s|^2

with its derivatives J in the experiment and K in the present data, and the plausible ranges s. The separation
is the rms of r in the run where it is largest.

Slopes promise too much where constants move far. So of the experiments that promise most, the best few are
verified: each model is refitted to the present data and to what the other one predicts of the experiment
(`mckibben.identification.diagnose.adapting`), and the separation is what that leaves. Where a prediction is a
simulated run, which costs a thousand times as much, the slopes have to do. A pair that the chosen experiment
leaves together gets a second one, if there is one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from mckibben.identification.diagnose.adapting import left_after_refit
from mckibben.identification.diagnose.drive_protocol import drive_protocols
from mckibben.identification.diagnose.protocol import Protocol, Rig, Schedule, protocols, rig_of
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.predict.moving import TransientPredictor
from mckibben.identification.predict.predictor import Predictor
from mckibben.identification.predict.quasistatic import QuasistaticPredictor
from mckibben.identification.predict.specimens import SpecimensPredictor
from mckibben.identification.thresholds import TWINS
from mckibben.physics.errors import InputError

DECISIVE = 3.0  # separation [sigma] from which an experiment decides
#: Separation [sigma] from which an experiment tells two effects apart: twice what a diagnosis counts as the
#: same, because the noise and the form of the laws take their part of it.
APART = 2.0 * TWINS.same
_FEWEST = 8  # values that a run needs
_TENSE = 0.1  # share of the rows under tension without which a reader cannot know the others as slack
_MOST_MODELS = 5  # of a group that are simulated, the likeliest
_VERIFIED = 3  # experiments whose separations are verified, the most promising


@dataclass(frozen=True)
class Separation:
    """How far an experiment tells two models apart: sigma, and its share of pairs."""

    first: str
    second: str
    sigma: float


@dataclass(frozen=True)
class DesignedExperiment:
    """The experiment that splits a group of effects best.

    Attributes:
        group: the effects, the one of the model first.
        words: what to do.
        minutes: how long it takes.
        schedule: its set points.
        separations: of each pair of the group that was simulated.
    """

    group: tuple[str, ...]
    words: str
    minutes: float
    schedule: Schedule
    separations: tuple[Separation, ...]

    def between(self, first: str, second: str) -> float | None:
        """Separation of two effects [sigma]; None if it was not simulated."""
        return next((s.sigma for s in self.separations if {s.first, s.second} == {first, second}), None)

    def decided(self) -> list[tuple[str, str]]:
        """The pairs that it tells apart at all."""
        return [(s.first, s.second) for s in self.separations if s.sigma >= APART]


@dataclass(frozen=True)
class _Predicted:
    """Prediction of an experiment and its derivatives over the noise, and the rows that have one.

    A slack muscle reads the zero of the sensor, which no constant of the muscle changes.
    """

    values: np.ndarray
    slopes: np.ndarray
    rows: np.ndarray


@dataclass
class Designer:
    """Designs experiments with the rig of a measurement.

    Attributes:
        protocols: what the rig can run.
        noise: standard deviation of the scaled residual.
        present: the present data, for the refits; None: separations are those of the slopes.
    """

    protocols: Sequence[Protocol]
    noise: float
    present: Predictor | None = None
    _seen: dict[tuple[int, int], _Predicted | None] = field(default_factory=dict)
    _verified: dict[tuple[int, int, int], float] = field(default_factory=dict)

    @classmethod
    def of(cls, predictor: Predictor, best: FittedModel, noise: float) -> Designer:
        """For the rig of the data of a model; without experiments where the kind of data has none."""
        return cls(_possible(predictor, best), noise, None if predictor.simulated else predictor)

    def designs(
        self, group: Sequence[str], models: Mapping[str, FittedModel], weights: Mapping[str, float]
    ) -> list[DesignedExperiment]:
        """The experiment that splits a group most evenly, and one more for the pairs that it leaves.

        Args:
            group: effects, the one of the model first.
            models: fitted model with each of them.
            weights: prior of each.

        Returns:
            Nothing where no experiment can be simulated; else the first one, which may separate no pair.
        """
        likeliest = sorted(group[1:], key=lambda name: -weights[name])[: _MOST_MODELS - 1]
        chosen = [group[0], *likeliest]
        pairs = [(a, b) for i, a in enumerate(chosen) for b in chosen[i + 1 :]]
        first = self._best(group, pairs, models, weights)
        if first is None:
            return []
        left = [pair for pair in pairs if pair not in first.decided()]
        if not left or len(left) == len(pairs):
            return [first]
        second = self._best(group, left, models, weights)
        return [first, second] if second is not None and second.decided() else [first]

    def _best(
        self,
        group: Sequence[str],
        pairs: Sequence[tuple[str, str]],
        models: Mapping[str, FittedModel],
        weights: Mapping[str, float],
    ) -> DesignedExperiment | None:
        """The experiment that is worth most for some pairs, by the separations that were verified."""

        def worth(sizes: Sequence[float], protocol: Protocol) -> float:
            shares = [
                weights[a] * weights[b] * min(size / DECISIVE, 1.0)
                for (a, b), size in zip(pairs, sizes, strict=True)
            ]
            # A tenth of the worth is not worth twice the time.
            return float(sum(shares) / (1.0 + 0.1 * np.log2(1.0 + protocol.minutes)))

        promised = []
        for protocol in self.protocols:
            sizes = [self.separation(models[a], models[b], protocol) for a, b in pairs]
            promised.append((worth(sizes, protocol), sizes, protocol))
        promised.sort(key=lambda one: -one[0])
        best, highest = None, 0.0
        for promise, sizes, protocol in promised[:_VERIFIED]:
            if promise <= highest:  # a refit only lowers what slopes promise
                break
            sure = [
                min(size, self.verified(models[a], models[b], protocol)) if size >= APART else size
                for (a, b), size in zip(pairs, sizes, strict=True)
            ]
            if worth(sure, protocol) > highest:
                best, highest = (protocol, sure), worth(sure, protocol)
        if best is None:
            return None
        protocol, sure = best
        separations = tuple(Separation(a, b, size) for (a, b), size in zip(pairs, sure, strict=True))
        return DesignedExperiment(
            tuple(group), protocol.words, protocol.minutes, protocol.schedule, separations
        )

    def farthest(self, first: FittedModel, second: FittedModel) -> tuple[float, Protocol | None]:
        """The largest separation of two models, verified where it is one, and the experiment that has it."""
        promised = sorted(
            ((self.separation(first, second, p), p) for p in self.protocols), key=lambda one: -one[0]
        )
        best: tuple[float, Protocol | None] = (0.0, promised[0][1] if promised else None)
        for size, protocol in promised[:_VERIFIED]:
            if size <= best[0]:
                break
            sure = min(size, self.verified(first, second, protocol)) if size >= APART else size
            if sure > best[0]:
                best = sure, protocol
        return best

    def separation(self, first: FittedModel, second: FittedModel, protocol: Protocol) -> float:
        """By how many standard deviations of a reading slopes say that an experiment separates two models."""
        return min(self._apart(first, second, protocol), self._apart(second, first, protocol))

    def verified(self, first: FittedModel, second: FittedModel, protocol: Protocol) -> float:
        """The separation of two models that are refitted to all the data, the one with more constants first.

        Once one of them leaves less than `APART`, the other one is not refitted.
        """
        if self.present is None:
            return self.separation(first, second, protocol)
        smallest = np.inf
        for rival, truth in sorted([(first, second), (second, first)], key=lambda one: -len(one[0].free)):
            smallest = min(smallest, self._left(truth, rival, protocol))
            if smallest < APART:
                break
        return float(smallest)

    def _left(self, truth: FittedModel, rival: FittedModel, protocol: Protocol) -> float:
        key = id(truth), id(rival), id(protocol)
        if key not in self._verified:
            one, two = self._predicted(truth, protocol), self._predicted(rival, protocol)
            if one is None or two is None or self.present is None:
                return 0.0
            rows = one.rows & two.rows
            wanted = np.where(one.rows, one.values, 0.0) * self.noise * protocol.predictor.scale
            experiment = protocol.predictor.reading(wanted)
            left = left_after_refit(rival, self.present, experiment, rows, self.noise)
            self._verified[key] = self._largest(left, rows, protocol)
        return self._verified[key]

    def difference(self, first: FittedModel, second: FittedModel, protocol: Protocol) -> float:
        """The same for the models as they are, which is what the choice between them matters."""
        one, two = self._predicted(first, protocol), self._predicted(second, protocol)
        if one is None or two is None:
            return 0.0
        return self._largest(one.values - two.values, one.rows & two.rows, protocol)

    def _apart(self, truth: FittedModel, other: FittedModel, protocol: Protocol) -> float:
        one, two = self._predicted(truth, protocol), self._predicted(other, protocol)
        if one is None or two is None:
            return 0.0
        rows = one.rows & two.rows
        difference = np.where(rows, one.values - two.values, 0.0)
        span = np.array([p.upper - p.lower for p in other.free])
        if len(span):
            inside = np.where(rows[:, None], two.slopes, 0.0) * span
            present = other.jacobian / self.noise * span
            stacked = np.vstack([inside, present, np.eye(len(span))])
            wanted = np.concatenate([difference, np.zeros(len(present) + len(span))])
            shift = np.linalg.lstsq(stacked, wanted, rcond=None)[0]
            difference = difference - inside @ shift
        return self._largest(difference, rows, protocol)

    def _predicted(self, model: FittedModel, protocol: Protocol) -> _Predicted | None:
        key = id(model), id(protocol)
        if key not in self._seen:
            predictor = protocol.predictor
            try:
                free, slopes = predictor.linearised(model.fit_model, model.free)
                values = predictor.predict(model.fit_model)
            except InputError:
                self._seen[key] = None
            else:
                scale = self.noise * predictor.scale
                tight = np.isclose(values, free)
                slopes = np.where(tight[:, None], slopes, 0.0) / scale[:, None]
                finite = np.isfinite(values) & np.all(np.isfinite(slopes), axis=1)
                if np.mean(tight) < _TENSE:
                    finite &= tight
                self._seen[key] = _Predicted(values / scale, slopes, finite)
        return self._seen[key]

    @staticmethod
    def _largest(difference: np.ndarray, rows: np.ndarray, protocol: Protocol) -> float:
        groups = protocol.predictor.groups
        sizes = [
            float(np.sqrt(np.mean(difference[of_run] ** 2)))
            for label in np.unique(groups)
            if np.count_nonzero(of_run := rows & (groups == label)) >= _FEWEST
        ]
        return max(sizes, default=0.0)


def _possible(predictor: Predictor, best: FittedModel) -> list[Protocol]:
    if isinstance(predictor, TransientPredictor):
        return drive_protocols(predictor)
    if isinstance(predictor, QuasistaticPredictor | SpecimensPredictor) and not predictor.simulated:
        rig: Rig = rig_of(predictor, best.fit_model)
        return protocols(rig, best.fit_model, channel=predictor.channels[0].name)
    return []
