"""Experiments that would separate effects that the present data cannot distinguish.

What the catalogue declares about a pair comes first. In addition, the experiments that the rig can run are
simulated with every effect of a group (`mckibben.identification.diagnose.design`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from mckibben.identification.diagnose.design import APART, DECISIVE, DesignedExperiment, Designer
from mckibben.identification.diagnose.twins import Alternative
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.physics.effect import Effect, Twin

_MATTERS = 1.0  # sigma from which the choice between two effects matters


@dataclass(frozen=True)
class SeparatingExperiment:
    """An experiment for a pair of effects.

    Attributes:
        first, second: ids of the effects, that of the model first.
        declared: what separates them according to the catalogue; empty when it has no entry.
        protocol: the simulated experiment that separates them best; empty when none can be simulated.
        separation: rms difference in standard deviations of a reading, after both models have adapted.
        minutes: how long it takes; None without a protocol.
        difference: largest one of the models as they are in a simulated experiment, in standard deviations of
            a reading.
        by_muscle_test: False where the catalogue declares that no test of the muscle separates the two.
    """

    first: str
    second: str
    declared: str
    protocol: str
    separation: float
    minutes: float | None = None
    difference: float = 0.0
    by_muscle_test: bool = True

    @property
    def matters(self) -> bool:
        """Whether the choice between the two changes what the model predicts for this rig."""
        return self.difference >= _MATTERS

    def sentence(self, titles: Mapping[str, str]) -> str:
        """The proposal in words."""
        pair = f"to tell {titles.get(self.first, self.first)} from {titles.get(self.second, self.second)}"
        parts = [self.declared] if self.declared else []
        if self.protocol and self.separation >= APART:
            parts.append(f"simulated best: {self.protocol} ({self.separation:.1f} sigma apart)")
        elif self.protocol and not self.declared:
            parts.append("no experiment with this rig does, and no other one is known")
        elif self.protocol and self.by_muscle_test:  # else what is declared says it already
            parts.append("no experiment with this rig does")
        return f"{pair}: {'; '.join(parts)}" if parts else f"{pair}: no experiment is known"


def declared(first: Effect, second: Effect) -> Twin | None:
    """What either effect declares about the other; None where neither has an entry."""
    for one, other in ((first, second), (second, first)):
        for twin in one.confused_with:
            if twin.effect == other.id:
                return twin
    return None


def next_measurements(
    designer: Designer,
    best: FittedModel,
    others: Sequence[Alternative],
    catalogue: Mapping[str, Effect],
) -> tuple[list[SeparatingExperiment], list[DesignedExperiment]]:
    """Experiments for each pair of indistinguishable effects, and the one that splits each group best.

    The group of which its first experiment separates most comes first; a second one follows its first.

    Args:
        designer: what the rig can run.
        best: the best model.
        others: effects that could replace one of its effects.
        catalogue: for what effects declare, and how likely they are.
    """
    pairs = []
    for other in others:
        sigma, protocol = designer.farthest(best, other.fitted_model)
        differs = (designer.difference(best, other.fitted_model, each) for each in designer.protocols)
        twin = declared(catalogue[other.of], catalogue[other.effect])
        pairs.append(
            SeparatingExperiment(
                other.of,
                other.effect,
                "" if twin is None else twin.separated_by,
                "" if protocol is None else protocol.words,
                sigma,
                None if protocol is None else protocol.minutes,
                max(differs, default=0.0),
                twin is None or twin.by_muscle_test,
            )
        )
    designed = []
    for name in dict.fromkeys(other.of for other in others):
        members = {other.effect: other.fitted_model for other in others if other.of == name}
        group = [name, *members]
        weights = {effect: catalogue[effect].prior.share for effect in group}
        designed.append(designer.designs(group, {name: best, **members}, weights))
    designed.sort(key=lambda of_group: -_decided(of_group[0]) if of_group else 0.0)
    return pairs, [design for of_group in designed for design in of_group]


def _decided(design: DesignedExperiment) -> float:
    """Share of its pairs that an experiment decides, with half of the credit for near misses."""
    sizes = [min(one.sigma / DECISIVE, 1.0) for one in design.separations]
    return sum(sizes) / max(len(sizes), 1)
