"""A measurement beside the model: the error in numbers, with or without fitting the model's parameters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from mckibben.identification.fit import FitResult, Free, least_squares_fit
from mckibben.identification.measurement import Measurement
from mckibben.identification.noise import noise_floor
from mckibben.identification.predict import Task, force_gradient, predict, task_of, with_values
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.muscle import GEOMETRY, NEUTRAL_ANGLE, Muscle
from mckibben.simulation.limits import Limits
from mckibben.simulation.static import EffectValues, StaticModel

_UNITS = {name: "rad" if name == "braid_angle" else "m" for name in GEOMETRY}
# How far a fit may take a geometry field whose tolerance is not known: +- rad or share of the value.
_DEFAULT_TOLERANCE = {"braid_angle": 0.06, "nominal_length": 0.02}
_DEFAULT_SHARE = 0.10


@dataclass(frozen=True)
class Comparison:
    """A model beside a measurement, SI; arrays have one element per used row, in the order of ``task.rows``.

    Attributes:
        task: the rows used and what was excluded.
        predicted: the model's values.
        rmse: root mean square of measured minus predicted.
        full_scale: largest measured magnitude.
        holdout_rmse: rmse over rows of groups that the fit did not see; equals rmse without a fit, None when
            there is only one group.
        noise: estimated standard deviation of the noise, None when the sweeps are too short to tell.
        fit: the fit, None when nothing was fitted.
        muscle, values: the model compared, fitted numbers in place.
        messages: what has to be said.
    """

    task: Task
    predicted: np.ndarray
    rmse: float
    full_scale: float
    holdout_rmse: float | None
    noise: float | None
    fit: FitResult | None
    muscle: Muscle
    values: dict[str, dict[str, float]]
    effects: tuple[Effect, ...]
    rows: int
    messages: tuple[str, ...] = field(default_factory=tuple)

    @property
    def residual(self) -> np.ndarray:
        """Measured minus predicted."""
        return self.task.measured - self.predicted

    @property
    def nrmse_percent(self) -> float:
        """rmse in percent of the largest measured magnitude."""
        return 100.0 * self.rmse / self.full_scale if self.full_scale > 0.0 else float("nan")

    def report(self) -> dict:
        """The figures as `mckibben compare --json` prints them."""
        return {
            "kind": self.task.kind,
            "rows": self.rows,
            "rows_used": len(self.task.measured),
            "excluded": dict(self.task.excluded),
            "predicted": self.task.channel,
            "unit": self.task.unit,
            "rmse": self.rmse,
            "nrmse_percent": self.nrmse_percent,
            "full_scale": self.full_scale,
            "holdout_rmse": self.holdout_rmse,
            "noise_floor": self.noise,
            "residual_mean": float(np.mean(self.residual)),
            "parameters": self._parameters(),
            "correlations": [
                {"a": a, "b": b, "value": value}
                for a, b, value in (self.fit.correlations if self.fit else ())
            ],
            "geometry": {name: float(getattr(self.muscle, name)) for name in GEOMETRY},
            "messages": [*self.messages, *(self.fit.messages if self.fit else ())],
        }

    def _parameters(self) -> dict[str, dict[str, dict]]:
        fitted = {parameter.name: parameter for parameter in self.fit.parameters} if self.fit else {}
        table: dict[str, dict[str, dict]] = {}
        for effect in self.effects:
            for p in effect.parameters:
                own = fitted.get(f"{effect.id}.{p.name}")
                table.setdefault(effect.id, {})[p.name] = {
                    "value": self.values[effect.id][p.name],
                    "stderr": own.stderr if own else None,
                    "unit": p.unit,
                    "at_bound": own.at_bound if own else False,
                    "fitted": own is not None,
                }
        geometry = [parameter for parameter in fitted.values() if parameter.name in GEOMETRY]
        if geometry:
            table["geometry"] = {
                p.name: {
                    "value": p.value,
                    "stderr": p.stderr,
                    "unit": p.unit,
                    "at_bound": p.at_bound,
                    "fitted": True,
                }
                for p in geometry
            }
        return table


def compare(
    measurement: Measurement,
    muscle: Muscle,
    effects: EffectValues,
    *,
    catalogue: Mapping[str, Effect],
    limits: Limits | None = None,
    fit: bool = False,
    free: Sequence[str] = (),
    tolerance: Mapping[str, float] | None = None,
) -> Comparison:
    """Compare a measurement with a muscle and its effects.

    Args:
        measurement: what was measured.
        muscle: the muscle as given.
        effects: effect id -> parameter values, SI; parameters left out take the effect's default.
        catalogue: where effects are looked up.
        limits: of the muscle.
        fit: fit the parameters that the effects declare as fitted.
        free: geometry fields to fit as well, within their tolerance.
        tolerance: geometry field -> how far it may go either way, SI.

    Raises:
        InputError: a row, kind, effect, parameter or geometry field that cannot be used.
    """
    task = task_of(measurement, muscle)
    model = StaticModel(muscle, effects, catalogue=catalogue, limits=limits)
    messages = list(task.messages)
    choice = _free_parameters(model, free, tolerance or {}) if fit else []
    if free and not fit:
        messages.append("a freed geometry only matters to a fit")
    if fit and not choice:
        messages.append("nothing to fit: the model has no effects and no geometry was freed")
    result = None
    if choice:
        result = _fit(task, model, choice, starts=4)
        model = _replaced(model, choice, result.numbers, catalogue)
    predicted = predict(task, model)
    rmse = _rms(task.measured - predicted)
    full_scale = float(np.max(np.abs(task.measured)))
    holdout: float | None = rmse
    if choice:
        holdout = _holdout(task, model, choice, catalogue)
        if holdout is None:
            messages.append("one group only: no group can be left out")
    noise = noise_floor(task, task.measured - predicted)
    if noise is None:
        messages.append("sweeps are too short to estimate the noise")
    return Comparison(
        task,
        predicted,
        rmse,
        full_scale,
        holdout,
        noise,
        result,
        model.muscle,
        model.values,
        model.effects,
        measurement.rows,
        tuple(messages),
    )


def _rms(residual: np.ndarray) -> float:
    return float(np.sqrt(np.mean(residual**2)))


def _free_parameters(model: StaticModel, free: Sequence[str], tolerance: Mapping[str, float]) -> list[Free]:
    choice = [
        Free(f"{effect.id}.{p.name}", model.values[effect.id][p.name], p.lower, p.upper, p.unit)
        for effect in model.effects
        for p in effect.parameters
        if p.fitted
    ]
    for name in dict.fromkeys(free):
        if name not in GEOMETRY:
            raise InputError(
                f"'{name}' is not a geometry field that can be freed",
                field="free",
                hint=did_you_mean(name, GEOMETRY),
            )
        value = float(getattr(model.muscle, name))
        width = tolerance.get(name, _DEFAULT_TOLERANCE.get(name, _DEFAULT_SHARE * value))
        if name == "nominal_length":
            width = tolerance.get(name, _DEFAULT_TOLERANCE[name] * value)
        if not width > 0.0:
            raise InputError(f"the muscle's {name.replace('_', ' ')} is not known", field=f"muscle.{name}")
        upper = min(value + width, 0.9999 * NEUTRAL_ANGLE) if name == "braid_angle" else value + width
        choice.append(Free(name, value, max(value - width, 1e-6), upper, _UNITS[name]))
    return choice


def _replaced(
    model: StaticModel,
    choice: Sequence[Free],
    numbers: Sequence[float] | np.ndarray,
    catalogue: Mapping[str, Effect],
) -> StaticModel:
    muscle, values = with_values(model.muscle, model.values, [p.name for p in choice], numbers)
    return StaticModel(muscle, values, catalogue=catalogue, limits=model.limits)


def _fit(task: Task, model: StaticModel, choice: Sequence[Free], *, starts: int) -> FitResult:
    # The unclipped force is fitted: where the model is slack although the muscle pulls, a clipped one has no
    # gradient to follow.
    names = tuple(parameter.name for parameter in choice)
    catalogue = {effect.id: effect for effect in model.effects}

    def residual(numbers: np.ndarray) -> np.ndarray:
        trial = _replaced(model, choice, numbers, catalogue)
        return predict(task, trial, clipped=False) - task.measured

    def jacobian(numbers: np.ndarray) -> np.ndarray:
        muscle, values = with_values(model.muscle, model.values, names, numbers)
        return force_gradient(task, muscle, model.effects, values, names)

    return least_squares_fit(residual, jacobian if task.channel == "force" else None, choice, starts=starts)


def _holdout(
    task: Task, model: StaticModel, choice: Sequence[Free], catalogue: Mapping[str, Effect]
) -> float | None:
    labels = np.unique(task.groups)
    if len(labels) < 2:
        return None
    squares = 0.0
    fitted = [
        Free(p.name, x, p.lower, p.upper, p.unit)
        for p, x in zip(choice, _numbers(model, choice), strict=True)
    ]
    for label in labels:
        rest, left_out = task.without_group(label), task.only_group(label)
        numbers = _fit(rest, model, fitted, starts=1).numbers
        trial = _replaced(model, choice, numbers, catalogue)
        squares += float(np.sum((left_out.measured - predict(left_out, trial)) ** 2))
    return float(np.sqrt(squares / len(task.measured)))


def _numbers(model: StaticModel, choice: Sequence[Free]) -> list[float]:
    numbers = []
    for parameter in choice:
        if parameter.name in GEOMETRY:
            numbers.append(float(getattr(model.muscle, parameter.name)))
        else:
            effect, name = parameter.name.split(".")
            numbers.append(model.values[effect][name])
    return numbers
