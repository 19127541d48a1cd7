r"""The next experiment: the one that a rig can run and that tells models apart best.

Every model predicts every experiment. Let d be the difference of two predictions in standard deviations of a
reading. The other model may adapt its parameters, but not beyond what the present data allow, so what the
experiment shows is

.. math:: r = d - J\delta,\qquad \delta = \arg\min_\delta |d - J\delta|^2 + |K\delta|^2 + |\delta/s|^2

with its derivatives J in the experiment and K in the present data, and the plausible ranges s. The separation
is the rms of r in the run where it is largest.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from mckibben.identification.diagnose.drive_protocol import drive_protocols
from mckibben.identification.diagnose.protocol import Protocol, Rig, Schedule, protocols, rig_of
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.predict.moving import TransientPredictor
from mckibben.identification.predict.predictor import Predictor
from mckibben.identification.predict.quasistatic import QuasistaticPredictor
from mckibben.identification.predict.specimens import SpecimensPredictor
from mckibben.physics.errors import InputError

DECISIVE = 3.0  # separation [sigma] from which an experiment decides
_FEWEST = 8  # values with tension that a run needs
_MOST_MODELS = 5  # of a group that are simulated, the likeliest


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
        return [(s.first, s.second) for s in self.separations if s.sigma >= 1.0]


@dataclass
class Designer:
    """Designs experiments with the rig of a measurement.

    Attributes:
        protocols: what the rig can run.
        noise: standard deviation of the scaled residual.
    """

    protocols: Sequence[Protocol]
    noise: float
    _seen: dict[tuple[int, int], tuple[np.ndarray, np.ndarray, np.ndarray] | None] = field(
        default_factory=dict
    )

    @classmethod
    def of(cls, predictor: Predictor, best: FittedModel, noise: float) -> Designer:
        """For the rig of the data of a model; without experiments where the kind of data has none."""
        return cls(_possible(predictor, best), noise)

    def design(
        self, group: Sequence[str], models: Mapping[str, FittedModel], weights: Mapping[str, float]
    ) -> DesignedExperiment | None:
        """The experiment that splits a group most evenly; None where none can be simulated.

        Args:
            group: effects, the one of the model first.
            models: fitted model with each of them.
            weights: prior of each.
        """
        likeliest = sorted(group[1:], key=lambda name: -weights[name])[: _MOST_MODELS - 1]
        chosen = [group[0], *likeliest]
        pairs = [(a, b) for i, a in enumerate(chosen) for b in chosen[i + 1 :]]
        best, highest = None, 0.0
        for protocol in self.protocols:
            separations = tuple(
                Separation(a, b, self.separation(models[a], models[b], protocol)) for a, b in pairs
            )
            worth = sum(
                weights[s.first] * weights[s.second] * min(s.sigma / DECISIVE, 1.0) for s in separations
            )
            # A tenth of the worth is not worth twice the time.
            worth /= 1.0 + 0.1 * np.log2(1.0 + protocol.minutes)
            if worth > highest:
                best, highest = (protocol, separations), float(worth)
        if best is None:
            return None
        protocol, separations = best
        return DesignedExperiment(
            tuple(group), protocol.words, protocol.minutes, protocol.schedule, separations
        )

    def separation(self, first: FittedModel, second: FittedModel, protocol: Protocol) -> float:
        """By how many standard deviations of a reading an experiment tells two models apart."""
        return min(self._apart(first, second, protocol), self._apart(second, first, protocol))

    def difference(self, first: FittedModel, second: FittedModel, protocol: Protocol) -> float:
        """The same for the models as they are, which is what the choice between them matters."""
        one, two = self._predicted(first, protocol), self._predicted(second, protocol)
        if one is None or two is None:
            return 0.0
        return self._largest(one[0] - two[0], one[2] & two[2], protocol)

    def _apart(self, truth: FittedModel, other: FittedModel, protocol: Protocol) -> float:
        one, two = self._predicted(truth, protocol), self._predicted(other, protocol)
        if one is None or two is None:
            return 0.0
        (true, _, tight), (predicted, slopes, tight_too) = one, two
        rows = tight & tight_too
        difference = np.where(rows, true - predicted, 0.0)
        span = np.array([p.upper - p.lower for p in other.free])
        if len(span):
            inside = np.where(rows[:, None], slopes, 0.0) * span
            present = other.jacobian / self.noise * span
            stacked = np.vstack([inside, present, np.eye(len(span))])
            wanted = np.concatenate([difference, np.zeros(len(present) + len(span))])
            shift = np.linalg.lstsq(stacked, wanted, rcond=None)[0]
            difference = difference - inside @ shift
        return self._largest(difference, rows, protocol)

    def _predicted(
        self, model: FittedModel, protocol: Protocol
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
        """Prediction and derivatives over the noise, and the rows where the muscle is under tension."""
        key = id(model), id(protocol)
        if key not in self._seen:
            predictor = protocol.predictor
            try:
                values, slopes = predictor.linearised(model.fit_model, model.free)
                tight = np.isclose(values, predictor.predict(model.fit_model))
            except InputError:
                self._seen[key] = None
            else:
                scale = self.noise * predictor.scale
                finite = np.isfinite(values) & np.all(np.isfinite(slopes), axis=1)
                self._seen[key] = values / scale, slopes / scale[:, None], tight & finite
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
