"""What a search amounts to: its status, what is left, what would separate twins, what has to be said."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal

import numpy as np

from mckibben.identification.diagnose.next_measurement import (
    SeparatingExperiment,
    declared,
    protocols,
    separation,
)
from mckibben.identification.diagnose.other_geometry import geometry_instead
from mckibben.identification.diagnose.score import AT_FLOOR
from mckibben.identification.diagnose.twins import Alternative
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import Fitter
from mckibben.identification.fit.least_squares import FitResult
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.predictor import Predictor
from mckibben.identification.residual.structure import ResidualStructure, structure
from mckibben.physics.effect import Effect
from mckibben.physics.muscle import assumption

_FAR = 2.0  # of the noise: something is left that is not known, whatever was explained before
_STRUCTURED = 0.3  # share of the residual a regression predicts, from which it is structure
_EXPLAINED = 0.98  # of the excess over the noise
_SMALL = 0.03  # of full scale: an error of data that do not tell their noise, up to which nothing is missed


#: What a diagnosis ends with; `mckibben.identification.diagnose.words` says what each means.
Status = Literal["adequate", "missing_effects", "ambiguous", "unknown_effect"]


def left_structure(
    predictor: Predictor, residual: np.ndarray, variables: Mapping[str, np.ndarray]
) -> ResidualStructure:
    """Structure left in the residual: of each channel, together by their mean squares."""
    parts = []
    for channel in predictor.channels:
        own = {name: values[channel.rows] for name, values in variables.items()}
        left = residual[channel.rows]
        parts.append((float(np.mean(left**2)), structure(left, own)))
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
) -> Status:
    """What the diagnosis ends with.

    Args:
        start, best: the model as given, and as far as it got.
        noise: None when the data do not tell it.
        added: effects that are missing.
        others: what could stand in for them.
        rest: structure that is left.
        full_scale: largest value that was measured, over the scale of the residual.
    """
    if noise is None and not added:
        return "adequate" if best.rmse <= _SMALL * full_scale else "unknown_effect"
    floor = noise or 0.0
    if noise is not None and best.rmse > _FAR * floor:
        return "unknown_effect"
    excess = max(start.mean_square - floor**2, 1e-300)
    explained = 1.0 - max(best.mean_square - floor**2, 0.0) / excess
    above = best.rmse > AT_FLOOR * floor and rest.share > _STRUCTURED
    if above and explained < _EXPLAINED:
        return "unknown_effect"
    if not added:
        return "adequate"
    return "ambiguous" if others else "missing_effects"


def is_force(predictor: Predictor) -> bool:
    """Whether a force is predicted, to which a term can be added."""
    return [channel.name for channel in predictor.channels] == ["force"]


def proposals(
    best: FittedModel,
    others: Sequence[Alternative],
    catalogue: Mapping[str, Effect],
    noise: float,
    predictor: Predictor,
) -> list[SeparatingExperiment]:
    """Experiments that would separate each added effect from what could stand in for it."""
    found = []
    pressure = predictor.inputs.get("pressure")
    high = float(np.max(pressure)) if pressure is not None else 6e5
    for other in others:
        words, apart = "", 0.0
        if is_force(predictor) and high > 0.0:
            tests = protocols(best.fit_model, largest_pressure=high)
            words, apart = separation(best.fit_model, other.fitted_model.fit_model, tests, noise=noise)
        text = declared(catalogue[other.of], catalogue[other.effect])
        found.append(SeparatingExperiment(other.of, other.effect, text, words, apart))
    return found


def _assumptions(best: FittedModel) -> list[str]:
    """Fields of the muscle that were assumed, and the products that the data determine instead."""
    found = []
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
        found.append(
            f"{assumption(best.fit_model.muscle, name)}. What these data determine is {', '.join(products)}; "
            f"state {name} to know the modulus itself"
        )
    return found


def messages(fitter: Fitter, first: FitModel, best: FittedModel, fit: FitResult | None) -> list[str]:
    """What has to be said of the noise, of geometry that took up an effect or could, and of the fit.

    Args:
        fitter: the fits of the search.
        first: the start model.
        best: the best model; fit: its numbers with errors.
    """
    found = _assumptions(best)
    # Transients hardly tell the geometry, and each fit takes long: their effort leaves the dimensions out.
    if fitter.effort.dimensions and len(best.fit_model.ids) > len(first.ids) and not fitter.geometry:
        found += geometry_instead(fitter.predictor, first, best, held=fitter.held, load=fitter.load)
    if fitter.noise is None:
        found.append("the sweeps are too short to estimate the noise: state it to know when to stop")
    for p in fitter.geometry:
        moved = 100.0 * (best.fit_model.number(p.name) / p.start - 1.0)
        if abs(moved) > 0.5:
            found.append(f"the fit moved {p.name.replace('_', ' ')} by {moved:+.1f} %")
    return [*found, *(fit.messages if fit else ())]
