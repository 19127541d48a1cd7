"""A measurement beside the model: the error in numbers, with or without fitting the model's parameters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from mckibben.identification.fit.effort import final_effort
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.least_squares import FitResult
from mckibben.identification.fit.misfit import Misfit
from mckibben.identification.predict import Predictor, predictor_of
from mckibben.identification.predict.fit_model import FitModel, free_geometry, free_numbers
from mckibben.identification.predict.free import Free
from mckibben.identification.residual.noise import noise_of
from mckibben.measurement.measurement import Measurement
from mckibben.physics.custom import CUSTOM, TERM
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError
from mckibben.physics.muscle import GEOMETRY, Muscle
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.statics.model import EffectValues, checked_values


@dataclass(frozen=True)
class Comparison:
    """A model beside a measurement, SI; arrays are stacked over the predicted channels of ``predictor``.

    Attributes:
        predictor: the rows used.
        fit_model: the model compared, fitted numbers in place.
        predicted: the model's values.
        rmse: root mean square of the residual; over the noise of each channel when there are several.
        holdout_rmse: the same over groups that the fit did not see; equals rmse without a fit, None when
            there is only one group.
        noise: standard deviation of the noise, None when it cannot be told; noise_how: from what.
        fit: the fit, None when nothing was fitted.
        rows: of the measurement.
        excluded: why rows were left out -> how many.
        messages: what has to be said.
    """

    predictor: Predictor
    fit_model: FitModel
    predicted: np.ndarray
    rmse: float
    holdout_rmse: float | None
    noise: float | None
    noise_how: str
    fit: FitResult | None
    rows: int
    excluded: Mapping[str, int]
    messages: tuple[str, ...] = field(default_factory=tuple)

    @property
    def residual(self) -> np.ndarray:
        """Measured minus predicted."""
        return self.predictor.measured - self.predicted

    @property
    def full_scale(self) -> float:
        """Largest measured magnitude over the scale of the residual."""
        return float(np.max(np.abs(self.predictor.measured / self.predictor.scale)))

    @property
    def nrmse_percent(self) -> float:
        """rmse in percent of the largest measured magnitude."""
        return 100.0 * self.rmse / self.full_scale if self.full_scale > 0.0 else float("nan")

    def report(self) -> dict:
        """The figures as `mckibben compare --json` prints them."""
        predictor = self.predictor
        several = len(predictor.channels) > 1
        mean = float(np.mean(self.residual / predictor.scale))
        return {
            "kind": predictor.kind,
            "rows": self.rows,
            "rows_used": predictor.rows_used,
            "excluded": dict(self.excluded),
            "predicted": predictor.predicted,
            "unit": predictor.unit,
            "rmse": self.rmse,
            "nrmse_percent": self.nrmse_percent,
            "full_scale": self.full_scale,
            "holdout_rmse": self.holdout_rmse,
            "noise_floor": self.noise,
            "residual_mean": mean,
            "channels": self._channels() if several else {},
            "parameters": parameter_table(self.fit_model, self.fit),
            "correlations": [
                {"a": a, "b": b, "value": value}
                for a, b, value in (self.fit.correlations if self.fit else ())
            ],
            "geometry": {name: float(getattr(self.fit_model.muscle, name)) for name in GEOMETRY},
            "messages": [*self.messages, *(self.fit.messages if self.fit else ())],
        }

    def _channels(self) -> dict[str, dict]:
        return {
            channel.name: {
                "rmse": float(np.sqrt(np.mean(self.residual[channel.rows] ** 2))),
                "unit": channel.unit,
                "noise_floor": channel.noise,
                "full_scale": channel.full_scale,
            }
            for channel in self.predictor.channels
        }


def parameter_table(fit_model: FitModel, fit: FitResult | None) -> dict[str, dict[str, dict]]:
    """Effect -> parameter -> value, standard error, unit, whether it was fitted and ended at a bound."""
    fitted = {parameter.name: parameter for parameter in fit.parameters} if fit else {}
    table: dict[str, dict[str, dict]] = {}
    for effect in fit_model.effects:
        for p in effect.parameters:
            own = fitted.get(f"{effect.id}.{p.name}")
            table.setdefault(effect.id, {})[p.name] = {
                "value": fit_model.values[effect.id][p.name],
                "stderr": own.stderr if own else None,
                "unit": p.unit,
                "at_bound": own.at_bound if own else False,
                "fitted": own is not None,
            }
    others = [parameter for parameter in fitted.values() if "." not in parameter.name]
    if others:
        table["geometry"] = {
            p.name: {
                "value": p.value,
                "stderr": p.stderr,
                "unit": p.unit,
                "at_bound": p.at_bound,
                "fitted": True,
            }
            for p in others
        }
    return table


def compare(
    measurement: Measurement,
    muscle: Muscle,
    effects: EffectValues,
    *,
    catalogue: Mapping[str, Effect],
    drive: Drive | None = None,
    fit: bool = False,
    free: Sequence[str] = (),
    freed: Sequence[str] = (),
    tolerance: Mapping[str, float] | None = None,
    noise: float | None = None,
) -> Comparison:
    """Compare a measurement with a muscle and its effects.

    Args:
        measurement: what was measured.
        muscle: the muscle as given.
        effects: effect id -> parameter values, SI; parameters left out take the effect's default.
        catalogue: where effects are looked up.
        drive: valve, tube and load of a transient measurement.
        fit: fit the parameters that the effects declare as fitted.
        free: geometry fields to fit as well, within their tolerance.
        freed: further constants to fit, as "effect.parameter".
        tolerance: geometry field -> how far it may go either way, SI.
        noise: standard deviation of the predicted channel, when it is known.

    Raises:
        InputError: a row, kind, effect, parameter or geometry field that cannot be used.
    """
    values = checked_values(effects, catalogue)
    fit_model = FitModel(muscle.checked(), tuple(catalogue[name] for name in values), values)
    predictor = predictor_of(measurement, muscle, drive)
    check_finite(predictor, fit_model)
    geometry = free_geometry(muscle, free, tolerance or {})
    messages = list(predictor.messages)
    choice = free_numbers(fit_model, geometry, freed, load=predictor.unknown_load) if fit else ()
    if free and not fit:
        messages.append("a freed geometry only matters to a fit")
    if fit and not choice:
        messages.append("nothing to fit: the model has no effects and no geometry was freed")
    result = None
    if choice:
        result = fit_of(predictor, fit_model, choice)
        fit_model = fit_model.with_numbers([p.name for p in choice], result.numbers)
    predicted = predictor.predict(fit_model)
    rmse = predictor.rmse(predictor.measured - predicted)
    holdout: float | None = rmse
    if choice:
        holdout = holdout_rmse(predictor, fit_model, choice)
        if holdout is None:
            messages.append("one group only: no group can be left out")
    floor, how = noise_of(predictor, (predictor.measured - predicted) / predictor.scale, noise)
    if floor is None:
        messages.append("sweeps are too short to estimate the noise")
    return Comparison(
        predictor,
        fit_model,
        predicted,
        rmse,
        holdout,
        floor,
        how,
        result,
        measurement.rows,
        predictor.excluded,
        tuple(messages),
    )


def check_finite(predictor: Predictor, fit_model: FitModel) -> None:
    """Refuse a model without a finite value somewhere in the data, as a typed term may be.

    Raises:
        InputError: says at how many rows.
    """
    lost, rows = predictor.lost(fit_model)
    if lost:
        raise InputError(
            f"the model has no finite value at {lost} of {rows} rows",
            field=f"effects.{CUSTOM}.{TERM}" if CUSTOM in fit_model.ids else "effects",
            hint="look for a division by zero, a root or an exponential, or give other parameters",
        )


def fit_of(predictor: Predictor, fit_model: FitModel, choice: Sequence[Free]) -> FitResult:
    """Fit the numbers; several starts where a model is quick, tightly where its derivatives are exact."""
    return Misfit(predictor, fit_model, choice).fit(final_effort(simulated=predictor.simulated))


def holdout_rmse(predictor: Predictor, fit_model: FitModel, choice: Sequence[Free]) -> float | None:
    """Error over whole groups left out of the fit; None when there is one group only."""
    if len(np.unique(predictor.folds[0])) < 2:
        return None
    predicted, jacobian = predictor.linearised(fit_model, choice)
    ended = tuple(replace(p, start=fit_model.number(p.name)) for p in choice)
    misfit = (predictor.measured - predicted) / predictor.scale
    fitted_model = FittedModel(
        fit_model, ended, frozenset(), misfit, jacobian / predictor.scale[:, None], predictor.folds
    )
    return fitted_model.holdout_rmse
