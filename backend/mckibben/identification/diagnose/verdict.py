"""Verdict of a diagnosis: status, remaining structure, proposed experiments and notes for the user."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple

from mckibben.identification.diagnose.judgement import Judgement
from mckibben.identification.diagnose.twins import Alternative
from mckibben.identification.diagnose.usual import taken_as_usual
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import Fitter
from mckibben.identification.fit.least_squares import FitResult
from mckibben.identification.predict.predictor import Predictor
from mckibben.physics.muscle import assumption


class Interval(NamedTuple):
    """Lower and upper end."""

    low: float
    high: float


#: What a diagnosis ends with; `mckibben.identification.diagnose.words` says what each means.
Status = Literal["adequate", "missing_effects", "ambiguous", "unknown_effect", "undecided", "unfinished"]


def status_of(
    judgement: Judgement,
    added: Sequence[str],
    others: Sequence[Alternative],
    *,
    doubted: bool = False,
) -> Status:
    """What the diagnosis ends with.

    Args:
        judgement: on the best model.
        added: the missing effects.
        others: effects that could replace them.
        doubted: whether a changed entry explains the data better: missing physics cannot be distinguished
            from it.
    """
    if doubted:
        return "ambiguous"
    if judgement.structured:
        return "unknown_effect"
    if added:
        return "ambiguous" if others else "missing_effects"
    return "undecided" if judgement.undecided else "adequate"


def noise_interval(judgement: Judgement) -> Interval | None:
    """From the scatter of neighbouring readings to all that is left; None where that is not noise alone.

    Both are the same for white noise. The lower end does not see what neighbouring readings share, nor
    readings that are farther off than most.
    """
    if judgement.noise is None or judgement.structured:
        return None
    return Interval(judgement.noise, max(judgement.noise, judgement.rmse))


def unexplained_share(
    status: Status, best: FittedModel, noise: float | None, judgement: Judgement | None
) -> float:
    """Share of the last mean square that is left to explain: what is predictable of it; of an unknown effect
    at least all above the noise.
    """
    predictable = 0.0 if judgement is None else judgement.predictable
    if status != "unknown_effect" or noise is None or not best.mean_square > 0.0:
        return predictable
    return max(predictable, 1.0 - min(noise**2 / best.mean_square, 1.0))


def is_force(predictor: Predictor) -> bool:
    """Whether the force is the only predicted channel, so that a term can be added to it."""
    return [channel.name for channel in predictor.channels] == ["force"]


def _assumptions(best: FittedModel) -> list[str]:
    """Notes on assumed fields of the muscle, and on the products that the data determine."""
    notes = []
    for name in sorted(best.fit_model.assumed):
        value = best.fit_model.number(name)
        products = [
            f"{p.name.replace('_', ' ')} x {name.replace('_', ' ')} = "
            f"{best.fit_model.values[effect.id][p.name] * value:.4g} N/m"
            for effect in best.fit_model.effects
            if name in effect.needs
            for p in effect.parameters
            if p.unit == "Pa" and best.fit_model.values[effect.id][p.name] != 0.0
        ]
        notes.append(
            f"{assumption(best.fit_model.muscle, name)}. These data determine only {', '.join(products)}; "
            f"state {name} to know the modulus itself"
        )
    return notes


def messages(
    fitter: Fitter, best: FittedModel, fit: FitResult | None, added: Sequence[str] = ()
) -> list[str]:
    """Notes for the user on assumptions, the noise, the geometry and the fit.

    Args:
        fitter: the fits of the search.
        best: the best model.
        fit: its parameters with standard errors.
        added: effects that the search added.
    """
    notes = [*_assumptions(best), *taken_as_usual(best, added)]
    if fitter.noise is None:
        notes.append(
            "the sweeps are too short to estimate the noise: state it, so that the search can stop there"
        )
    for p in fitter.geometry:
        change = 100.0 * (best.fit_model.number(p.name) / p.start - 1.0)
        if abs(change) > 0.5:
            notes.append(f"the fit moved {p.name.replace('_', ' ')} by {change:+.1f} %")
    return [*notes, *(fit.messages if fit else ())]
