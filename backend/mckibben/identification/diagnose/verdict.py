"""Verdict of a diagnosis: status, remaining structure, proposed experiments and notes for the user."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal, NamedTuple

import numpy as np

from mckibben.identification.diagnose.repetition import Repetition, repetition
from mckibben.identification.diagnose.score import AT_FLOOR
from mckibben.identification.diagnose.twins import Alternative
from mckibben.identification.diagnose.usual import taken_as_usual
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import Fitter
from mckibben.identification.fit.least_squares import FitResult
from mckibben.identification.predict.predictor import Predictor
from mckibben.identification.residual.structure import ResidualStructure, structure
from mckibben.physics.muscle import assumption

_FAR = 2.0  # error over noise above which a structured rest is an unknown effect, however much was explained
_STRUCTURED = 0.3  # share of the residual predicted by a regression, above which it is not noise
_EXPLAINED = 0.98  # explained share of the excess over the noise, above which the rest does not matter
_BEYOND = 4.0  # error over noise that is more than noise beside effects that are named
# Error over noise that correlated noise alone does not reach: of an autoregressive process with a = 0.9 the
# third differences have the variance 20 - 30 a + 12 a^2 - 2 a^3 = 1.26 instead of 20, a ratio of 4.0.
_BEYOND_NOISE = 5.0
_MOST_ROWS = 2.0  # the same for the median row; below, a few outliers make the error
_SMALL = 0.03  # error over full scale up to which a model is adequate when the noise is unknown


_MEDIAN = 0.6745  # median magnitude of a standard normal deviate


class Interval(NamedTuple):
    """Lower and upper end."""

    low: float
    high: float


#: What a diagnosis ends with; `mckibben.identification.diagnose.words` says what each means.
Status = Literal["adequate", "missing_effects", "ambiguous", "unknown_effect", "unfinished"]


def left_structure(
    predictor: Predictor,
    residual: np.ndarray,
    variables: Mapping[str, np.ndarray],
    noise: float | None,
    added: Sequence[str],
) -> ResidualStructure:
    """Structure left in the residual; channels are weighted by their mean squares.

    Where no effect is named, within what correlated noise reaches, only what the other curves show as well is
    structure. Beside effects a rest that belongs to one curve may be run-in or another history.

    Args:
        predictor: the data.
        residual: scaled, shape (values,).
        variables: that it may depend on.
        noise: of the scaled residual; None when it cannot be estimated.
        added: the missing effects.
    """
    found = _structure_of_channels(predictor, residual, variables)
    within = noise is not None and float(np.sqrt(np.mean(residual**2))) <= _BEYOND_NOISE * noise
    if added or not within or found.share <= _STRUCTURED:
        return found
    others = _structure_of_channels(predictor, residual, variables, predictor.folds[0])
    return min(found, others, key=lambda each: each.share)


def left_repetition(predictor: Predictor, residual: np.ndarray) -> Repetition | None:
    """What of the residual repeats over length, pressure or time, in the channel with the largest rest."""
    channel = max(predictor.channels, key=lambda each: float(np.mean(residual[each.rows] ** 2)))
    inside = np.zeros(len(residual), bool)
    inside[channel.rows] = True
    sweeps = [np.asarray(sweep)[inside[sweep]] for sweep in predictor.sweeps]
    return repetition(residual, predictor.inputs, sweeps=sweeps, records=predictor.records)


def _structure_of_channels(
    predictor: Predictor,
    residual: np.ndarray,
    variables: Mapping[str, np.ndarray],
    left_out: np.ndarray | None = None,
) -> ResidualStructure:
    parts = []
    for channel in predictor.channels:
        channel_variables = {name: values[channel.rows] for name, values in variables.items()}
        left = residual[channel.rows]
        label = None if left_out is None else left_out[channel.rows]
        parts.append((float(np.mean(left**2)), structure(left, channel_variables, left_out=label)))
    whole = sum(size for size, _ in parts) or 1.0
    lost: dict[str, float] = {}
    for size, part in parts:
        for name, share in part.variables:
            lost[name] = lost.get(name, 0.0) + share * size / whole
    order = tuple(sorted(lost.items(), key=lambda pair: -pair[1]))
    return ResidualStructure(sum(size * part.share for size, part in parts) / whole, order)


def status_of(
    start: FittedModel,
    best: FittedModel,
    noise: float | None,
    added: Sequence[str],
    others: Sequence[Alternative],
    rest: ResidualStructure,
    full_scale: float,
    *,
    doubted: bool = False,
) -> Status:
    """What the diagnosis ends with.

    Args:
        start, best: the model as given, and the best one.
        noise: None when it cannot be estimated.
        added: the missing effects.
        others: effects that could replace them.
        rest: structure left in the residual.
        full_scale: largest measured magnitude over the scale of the residual.
        doubted: whether a changed entry explains the data better: missing physics cannot be distinguished
            from it.
    """
    if doubted:
        return "ambiguous"
    if noise is None and not added:
        return "adequate" if best.rmse <= _SMALL * full_scale else "unknown_effect"
    floor = noise or 0.0
    excess = max(start.mean_square - floor**2, 1e-300)
    explained = 1.0 - max(best.mean_square - floor**2, 0.0) / excess
    if rest.share > _STRUCTURED and (
        best.rmse > _FAR * floor or (best.rmse > AT_FLOOR * floor and explained < _EXPLAINED)
    ):
        return "unknown_effect"
    # Without structure the rest is noise unlike that between neighbours: correlated, or with outliers.
    beyond = _BEYOND if added else _BEYOND_NOISE
    if best.rmse > beyond * floor and typical(best.residual) > _MOST_ROWS * floor:
        return "unknown_effect"
    if not added:
        return "adequate"
    return "ambiguous" if others else "missing_effects"


def typical(residual: np.ndarray) -> float:
    """Standard deviation of a residual from its median magnitude, which outliers do not change."""
    return float(np.median(np.abs(residual))) / _MEDIAN


def noise_interval(best: FittedModel, noise: float | None, rest: ResidualStructure) -> Interval | None:
    """From the scatter of neighbouring readings to all that no variable explains.

    The upper end counts correlated noise and outliers as noise, which the lower end does not see. Both are
    the same for white noise. None where the noise is unknown or a structure remains.
    """
    if noise is None or rest.share > _STRUCTURED:
        return None
    unexplained = best.rmse * float(np.sqrt(1.0 - rest.share))
    return Interval(noise, max(noise, unexplained))


def unexplained_share(
    status: Status, best: FittedModel, noise: float | None, rest: ResidualStructure
) -> float:
    """Share of the last mean square that is left to explain: its structure; of an unknown effect at least
    all above the noise.
    """
    if status != "unknown_effect" or noise is None or not best.mean_square > 0.0:
        return rest.share
    return max(rest.share, 1.0 - min(noise**2 / best.mean_square, 1.0))


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
