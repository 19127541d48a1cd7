"""Comparison of a measurement with a model, with or without fitting the model's parameters."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import ClassVar

import numpy as np

from mckibben.facts.comparison import COMPARISON, PARAMETER
from mckibben.facts.result import result_class
from mckibben.identification.fit.effort import final_effort
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.least_squares import FitResult
from mckibben.identification.fit.misfit import Misfit
from mckibben.identification.predict import Predictor
from mckibben.identification.predict.fit_model import (
    FitModel,
    Free,
    each,
    free_numbers,
    is_start,
    tied,
    together,
    with_values,
)
from mckibben.identification.predict.predictor import PredictedChannel, Reversals, StoppedRun
from mckibben.identification.predict.reading_errors import AbsorbedError
from mckibben.identification.residual.noise import absorbed_by, allowing_for_errors, noise_of
from mckibben.physics.custom import CUSTOM, TERM
from mckibben.physics.errors import InputError

_STROKES = ("length", "displacement")  # channels whose range is a stroke
_FITS = 3  # most fits of a model whose runs stop, each of which leads farther


@dataclass(frozen=True)
class Comparison:
    """Comparison of a model with a measurement, SI; arrays are stacked over the channels of ``predictor``.

    Attributes:
        predictor: the rows used.
        fit_model: the model; after a fit with the fitted values.
        predicted: the model's values.
        rmse: root mean square of the residual; over the noise of each channel if there are several.
        holdout_rmse: rmse_beyond_accuracy over groups that the fit did not see; without a fit
            rmse_beyond_accuracy itself. None when there is only one group.
        noise: standard deviation of the noise; None when it cannot be estimated.
        noise_how: how the noise was obtained.
        fit: the fit; None when nothing was fitted.
        free: the fitted parameters; their starts are the fitted values.
        stated_noise: as stated; None where it is estimated.
        rows: number of rows of the measurement.
        excluded: reason -> number of excluded rows.
        messages: notes for the user.
        absorbed: reading errors within the stated accuracy that explain a part of the residual.
        stopped: runs of the model that ended early; the rest is of the rows that they reached.
        reversals: readings at which the motion turns, which are in none of the errors; None without any.
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
    absorbed: tuple[AbsorbedError, ...] = ()
    stopped: tuple[StoppedRun, ...] = ()
    reversals: Reversals | None = None
    free: tuple[Free, ...] = ()
    stated_noise: float | None = None

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

    @property
    def rmse_beyond_accuracy(self) -> float:
        """rmse of what the accuracy of the readings does not explain."""
        return _beyond_accuracy(self.predictor, self.residual)

    @property
    def over_noise(self) -> float | None:
        """rmse_beyond_accuracy over the noise; None where that is not known."""
        return self.rmse_beyond_accuracy / self.noise if self.noise else None

    @property
    def stroke_percent(self) -> float | None:
        """rmse in percent of the measured stroke; None for another channel, or several."""
        first, *others = self.predictor.channels
        return None if others else _stroke_percent(first, self.predictor.measured, self.residual)

    @property
    def fit_percent(self) -> float | None:
        """100 (1 - |residual| / |measured - mean|), the mean of the channels; None where nothing varies."""
        shares = []
        for channel in self.predictor.channels:
            measured, residual = self.predictor.measured[channel.rows], self.residual[channel.rows]
            spread = float(np.linalg.norm(measured - np.mean(measured)))
            if spread > 0.0:
                shares.append(100.0 * (1.0 - float(np.linalg.norm(residual)) / spread))
        return float(np.mean(shares)) if shares else None

    @property
    def residual_mean(self) -> float:
        """Mean of the residual over its scale."""
        return float(np.mean(self.residual / self.predictor.scale))

    @property
    def parameters(self) -> ParameterTable:
        """All parameters, as used or fitted."""
        return parameter_table(self.fit_model, self.fit, self.free)

    @property
    def channels(self) -> dict[str, ChannelMisfit]:
        """Misfit of each channel where there are several; empty for one."""
        return channel_misfits(self.predictor, self.residual)


@result_class
class ParameterValue:
    """A parameter as used or fitted."""

    FIGURES: ClassVar = PARAMETER.name

    value: float
    stderr: float | None
    unit: str
    """SI unit."""
    at_bound: bool
    """The fit stopped at a bound."""
    fitted: bool
    """Whether the fit could change it."""


#: Effect id -> name -> value; "geometry" holds what belongs to no effect.
ParameterTable = dict[str, dict[str, ParameterValue]]


@result_class
class ChannelMisfit:
    """Error of one of several predicted channels, SI."""

    FIGURES: ClassVar = COMPARISON.name

    rmse: float
    unit: str
    """SI unit of the figures."""
    noise_floor: float
    full_scale: float
    stroke_percent: float | None


@result_class
class Correlation:
    """How strongly two fitted parameters are correlated."""

    a: str
    """First parameter, as effect.parameter."""
    b: str
    """Second parameter, as effect.parameter."""
    value: float
    """Coefficient of correlation, -1 to 1."""


def correlations_of(fit: FitResult | None) -> list[Correlation]:
    """The strong correlations of a fit."""
    return [] if fit is None else [Correlation(a, b, value) for a, b, value in fit.correlations]


def channel_misfits(predictor: Predictor, residual: np.ndarray) -> dict[str, ChannelMisfit]:
    """Misfit of each channel where there are several; empty for one.

    Args:
        predictor: the data.
        residual: measured minus predicted, shape (values,).
    """
    if len(predictor.channels) < 2:
        return {}
    return {
        channel.name: ChannelMisfit(
            rmse=float(np.sqrt(np.mean(residual[channel.rows] ** 2))),
            unit=channel.unit,
            noise_floor=channel.noise,
            full_scale=channel.full_scale,
            stroke_percent=_stroke_percent(channel, predictor.measured, residual),
        )
        for channel in predictor.channels
    }


def _stroke_percent(channel: PredictedChannel, measured: np.ndarray, residual: np.ndarray) -> float | None:
    """Root mean square of a channel's residual in percent of its range; None for none of a varying length."""
    stroke = float(np.ptp(measured[channel.rows]))
    if channel.name not in _STROKES or not stroke > 0.0:
        return None
    return 100.0 * float(np.sqrt(np.mean(residual[channel.rows] ** 2))) / stroke


def _beyond_accuracy(predictor: Predictor, residual: np.ndarray) -> float:
    """Root mean square of what the accuracy of the readings does not explain."""
    return float(np.sqrt(np.mean(predictor.weighted(residual) ** 2)))


def parameter_table(fit_model: FitModel, fit: FitResult | None, free: Sequence[Free] = ()) -> ParameterTable:
    """All parameters of a model, as used or fitted; those that are tied are as sure as what they follow."""
    fitted = {parameter.name: parameter for parameter in fit.parameters} if fit else {}
    fitted |= {name: fitted[p.name] for p in free for name in p.ties if p.name in fitted}
    table: ParameterTable = {}
    for effect in fit_model.effects:
        for p in effect.parameters:
            estimate = fitted.get(f"{effect.id}.{p.name}")
            table.setdefault(effect.id, {})[p.name] = ParameterValue(
                value=fit_model.values[effect.id][p.name],
                stderr=estimate.stderr if estimate else None,
                unit=p.unit,
                at_bound=estimate.at_bound if estimate else False,
                fitted=estimate is not None,
            )
    others = [parameter for name, parameter in fitted.items() if "." not in name]
    if others:
        table["geometry"] = {
            p.name: ParameterValue(p.value, p.stderr, p.unit, p.at_bound, fitted=True) for p in others
        }
    return table


def compared(
    predictor: Predictor,
    fit_model: FitModel,
    *,
    rows: int,
    fit: bool = False,
    geometry: Sequence[Free] = (),
    freed: Sequence[str] = (),
    ties: Mapping[str, str] | None = None,
    noise: float | None = None,
) -> Comparison:
    """Compare prepared data with a model.

    Where a run of the model stops early, the rows that it reached are fitted to and compared.

    Args:
        predictor: the data.
        fit_model: the model.
        rows: number of rows of the measurement.
        fit: fit the parameters that the effects declare as fitted.
        geometry: geometry fields to fit as well. Starts of runs are no part of the model: where they are free
            they are fitted without ``fit`` too, alone.
        freed: further constants to fit, as "effect.parameter".
        ties: fitted constants that always have the value of another fitted one.
        noise: standard deviation of the predicted channel, when it is known.

    Raises:
        InputError: a tied constant is not fitted, the model has no finite value at some row, or
            its runs reach less than three rows.
    """
    check_finite(predictor, fit_model)
    messages = list(predictor.messages)
    if fit:
        chosen: _Chosen = partial(_of_fit, geometry=geometry, freed=freed, ties=ties or {})
    else:
        chosen = partial(_of_runs, geometry=geometry)
    choice = chosen(fit_model, predictor)
    if len(geometry) > len(choice) and not fit:
        messages.append("geometry fields were freed or accepted as wrong, but no fit was requested")
    if fit and not choice:
        messages.append("nothing to fit: the model has no effects and no geometry was freed")
    whole, result = predictor, None
    predictor = allowing_for_errors(whole.reached(fit_model), fit_model)
    if choice:
        predictor, fit_model, result = _fitted(whole, predictor, fit_model, chosen)
    stopped = whole.stopped(fit_model)
    predicted = predictor.predict(fit_model)
    rmse = predictor.rmse(predictor.measured - predicted)
    holdout: float | None = _beyond_accuracy(predictor, predictor.measured - predicted)
    if choice:
        holdout = holdout_rmse(predictor, fit_model, choice)
        if holdout is None:
            messages.append(COMPARISON["holdout_rmse"].exists_when.otherwise)
    floor, how = noise_of(predictor, (predictor.measured - predicted) / predictor.scale, noise)
    if floor is None:
        messages.append("sweeps are too short to estimate the noise")
    reversals = predictor.at_reversals(fit_model)
    return Comparison(
        predictor=predictor,
        fit_model=fit_model,
        predicted=predicted,
        rmse=rmse,
        holdout_rmse=holdout,
        noise=floor,
        noise_how=how,
        fit=result,
        rows=rows,
        excluded=predictor.excluded,
        messages=(
            *messages,
            *([] if reversals is None else filter(None, [reversals.sentence(floor, rmse)])),
            *predictor.assumed_history(fit_model),
            *(result.messages if result else ()),
        ),
        absorbed=absorbed_by(predictor, fit_model),
        stopped=stopped,
        reversals=reversals,
        free=tuple(replace(p, start=fit_model.number(p.name)) for p in choice),
        stated_noise=noise,
    )


def with_found_starts(predictor: Predictor, fit_model: FitModel, geometry: Sequence[Free]) -> FitModel:
    """A model with the starts of runs that are free fitted, and nothing else, as a comparison shows it."""
    choice = _of_runs(fit_model, predictor, geometry=geometry)
    if not choice:
        return fit_model
    found = fit_of(predictor.beginning(fit_model), fit_model, choice)
    return fit_model.with_numbers([p.name for p in choice], found.numbers)


#: What is free of a model, by the data.
_Chosen = Callable[[FitModel, Predictor], tuple[Free, ...]]


def _of_fit(
    fit_model: FitModel,
    predictor: Predictor,
    *,
    geometry: Sequence[Free],
    freed: Sequence[str],
    ties: Mapping[str, str],
) -> tuple[Free, ...]:
    return tied(free_numbers(fit_model, geometry, freed, load=predictor.unknown_load), ties)


def _of_runs(fit_model: FitModel, predictor: Predictor, *, geometry: Sequence[Free]) -> tuple[Free, ...]:
    del predictor
    return tuple(replace(f, start=fit_model.number(f.name)) for f in geometry if is_start(f.name))


def _fitted(
    whole: Predictor, part: Predictor, fit_model: FitModel, chosen: _Chosen
) -> tuple[Predictor, FitModel, FitResult]:
    """The rows that the runs of the fitted model reach, that model, and what these rows determine.

    Args:
        whole: all rows.
        part: those that the runs of the start model reach. Where the fit leads farther, it is repeated there.
        fit_model: see `compared`.
        chosen: what is fitted.
    """
    for left in reversed(range(_FITS)):
        choice = chosen(fit_model, part)
        usual = {p.name for p in free_numbers(fit_model, (), (), load=part.unknown_load)}
        first = [p for p in choice if p.name in usual]
        result = fit_of(part.beginning(fit_model), fit_model, choice, first=first)
        fit_model = with_values(fit_model, choice, result.numbers)
        ended = whole.reached(fit_model)
        if ended.rows_used == part.rows_used:
            break
        farther = ended.rows_used > part.rows_used
        part = allowing_for_errors(ended, fit_model)
        if not (farther and left):  # what the fit determines is said of the rows that its end reaches
            result = Misfit(part, fit_model, choice).report(np.array(result.numbers))
            break
    return part, fit_model, result


def check_finite(predictor: Predictor, fit_model: FitModel) -> None:
    """Reject a model that is not finite at some rows, for example because of a custom term.

    Raises:
        InputError: with the number of these rows.
    """
    lost, rows = predictor.lost(fit_model)
    if lost:
        raise InputError(
            f"the model has no finite value at {lost} of {rows} rows",
            field=f"effects.{CUSTOM}.{TERM}" if CUSTOM in fit_model.ids else "effects",
            hint="look for a division by zero, a root or an exponential, or give other parameters",
        )


def fit_of(
    predictor: Predictor, fit_model: FitModel, choice: Sequence[Free], *, first: Sequence[Free] = ()
) -> FitResult:
    """Fit the chosen parameters with the effort of a final fit.

    Args:
        predictor: the data.
        fit_model: the model.
        choice: the free parameters.
        first: those of them that are fitted alone before; where that leads closer, the fit begins there. Many
            constants at once may lose their way from the usual values.
    """
    effort = final_effort(simulated=predictor.simulated)
    misfit = Misfit(predictor, fit_model, choice)
    numbers = misfit.fit(effort)
    if 0 < len(first) < len(choice):
        ended = Misfit(predictor, fit_model, first).fit(effort).tolist()
        begun = dict(zip([p.name for p in first], ended, strict=True))
        near = [replace(p, start=begun.get(p.name, p.start)) for p in choice]
        staged = Misfit(predictor, fit_model, near)
        other = staged.fit(effort)
        if float(np.sum(staged.value(other) ** 2)) < float(np.sum(misfit.value(numbers) ** 2)):
            misfit, numbers = staged, other
    return misfit.report(numbers)


def determined(
    predictor: Predictor, fit_model: FitModel, *, geometry: Sequence[Free] = (), freed: Sequence[str] = ()
) -> FitResult | None:
    """How sure the values of a model are that was fitted before, without a change; None without free ones.

    Args:
        predictor: the data.
        fit_model: the model with its fitted values.
        geometry, freed: what the fit changed besides the parameters of the effects.
    """
    predictor = allowing_for_errors(predictor, fit_model)
    free = free_numbers(fit_model, geometry, freed, load=predictor.unknown_load)
    if not free:
        return None
    numbers = np.array([fit_model.number(parameter.name) for parameter in free])
    return Misfit(predictor, fit_model, free).report(numbers)


def holdout_rmse(predictor: Predictor, fit_model: FitModel, choice: Sequence[Free]) -> float | None:
    """Error over whole groups that are left out of the fit; None for a single group."""
    if len(np.unique(predictor.folds[0])) < 2:
        return None
    predicted, slopes = predictor.linearised(fit_model, each(choice))
    jacobian = together(slopes, choice)
    ended = tuple(replace(p, start=fit_model.number(p.name)) for p in choice)
    misfit = predictor.weighted(predictor.measured - predicted)
    fitted_model = FittedModel(
        fit_model, ended, frozenset(), misfit, predictor.weighted(jacobian), predictor.folds
    )
    return fitted_model.holdout_rmse
