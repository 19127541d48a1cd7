"""A model beside measurements: the error in numbers, where it fails, and the points for the plots."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from mckibben.application.asked import Asked
from mckibben.application.start import Json, geometry_json, start_flags
from mckibben.documents.start_model import StartModel
from mckibben.identification.fit.comparison import Comparison, compare
from mckibben.identification.residual.profiles import heat_map, loops, profiles, variables_of, whiteness
from mckibben.measurement.points import Points
from mckibben.simulation.statics.model import EffectValues

MAX_POINTS_PER_SERIES = 400
_MAX_SERIES = 200
# A sample this much longer or shorter than the muscle is another muscle.
_OTHER_LENGTH = 0.05


def comparison_answer(asked: Asked, *, fit: bool = False) -> Json:
    """Compare, and say it in JSON (with numpy arrays in it).

    Raises:
        InputError: the measurement does not allow the comparison, or a geometry field cannot be freed.
    """
    start, points = asked.start, asked.points
    result = _compared(asked, points, start.effects, fit=fit)
    report = result.report()
    series, thinned = _series(result, "fit")
    messages = [*report["messages"], *_length_messages(start, points)]
    validation = None
    if asked.validation is not None:
        validation, thin = _validation(asked, asked.validation, result)
        thinned = thinned or thin
    if thinned:
        messages.append(f"curves show at most {MAX_POINTS_PER_SERIES} points each; the figures use all rows")
    left_out = sum(points.left_out.values())
    muscle = result.fit_model.muscle
    return {
        **report,
        "rows": report["rows"] + left_out,
        "excluded": points.left_out | report["excluded"],
        "messages": messages,
        # A fitted geometry no longer belongs to the lattice it was given by.
        "geometry": geometry_json(
            start if muscle == start.muscle else replace(start, muscle=muscle, rhombus=None)
        ),
        "noise_how": result.noise_how,
        **failures(result),
        "series": series,
        "validation": validation,
        "model": {"effects": asked.effects_json(result.fit_model)},
        "flags": start_flags(start),
    }


def _compared(asked: Asked, points: Points, effects: EffectValues, *, fit: bool) -> Comparison:
    return compare(
        points.measurement,
        asked.start.muscle,
        effects,
        catalogue=asked.start.catalogue,
        drive=asked.drive,
        fit=fit,
        free=asked.free,
        freed=asked.freed,
        tolerance={} if asked.start.preset is None else asked.start.preset.tolerance,
        noise=asked.noise,
    )


def failures(result: Comparison) -> Json:
    """Where the model fails: over each variable, as a map, in loops, in words; and whether it is noise."""
    predictor = result.predictor
    residual = result.residual / predictor.scale
    variables = variables_of(predictor, result.fit_model.muscle.nominal_length)
    found = profiles(residual, variables, predictor.folds[0])
    chart = heat_map(residual, variables)
    white = whiteness(residual, predictor.sweeps)
    areas = []
    if predictor.predicted == "force" and "length" in predictor.inputs and "time" in predictor.inputs:
        areas = loops(residual, predictor.inputs["length"], predictor.groups)
    unit = "" if predictor.unit == "1" else f" {predictor.unit}"
    words = [
        f"{profile.worst}: {profile.rmse:.3g}{unit} rms; this variable alone predicts "
        f"{100.0 * profile.share_explained:.0f} % of the error"
        for profile in found[:3]
        if profile.share_explained > 0.05
    ]
    words.append(
        "the residual looks like noise" if white.white else "the residual is not noise: it has structure"
    )
    return {
        "where": [profile.report() for profile in found],
        "heat_map": None if chart is None else chart.report(),
        "whiteness": white.report(),
        "loops": areas[:_MAX_SERIES],
        "sentences": words,
    }


def _validation(asked: Asked, points: Points, fitted: Comparison) -> tuple[Json, bool]:
    """The fitted model on what it has not seen."""
    started = replace(asked.start, muscle=fitted.fit_model.muscle, rhombus=None)
    other = replace(asked, start=started, free=(), freed=())
    result = _compared(other, points, dict(fitted.fit_model.values), fit=False)
    series, thinned = _series(result, "validation")
    return {
        "rmse": result.rmse,
        "nrmse_percent": result.nrmse_percent,
        "rows_used": result.predictor.rows_used,
        "series": series,
    }, thinned


def _length_messages(start: StartModel, points: Points) -> list[str]:
    sample, muscle = points.nominal_length, start.muscle.nominal_length
    if sample is None or abs(muscle / sample - 1.0) <= _OTHER_LENGTH:
        return []
    return [
        f"the measured sample is {sample * 1e3:.4g} mm long, the muscle {muscle * 1e3:.4g} mm: "
        "the lengths do not belong together"
    ]


def _series(result: Comparison, use: str) -> tuple[list[Json], bool]:
    """One curve per channel and group of rows, thinned for the screen."""
    predictor, rest = result.predictor, result.fit_model.muscle.nominal_length
    inputs = predictor.inputs
    count = len(predictor.measured)
    unknown = np.full(count, np.nan)
    length = inputs.get("length", unknown)
    if predictor.predicted == "length":
        length = predictor.measured
    elif "displacement" in inputs:
        length = rest - inputs["displacement"]
    pressure = inputs.get("pressure", unknown)
    place = np.arange(count)
    series, thinned = [], False
    for channel in predictor.channels:
        inside = place[channel.rows]
        labels = np.unique(predictor.groups[inside])
        if len(labels) > _MAX_SERIES:
            labels, thinned = labels[:_MAX_SERIES], True
        for number, label in enumerate(labels, 1):
            rows = inside[predictor.groups[inside] == label]
            held = _held(pressure[rows])
            name = _label(number, held, _held(length[rows]), timed=predictor.kind == "transient")
            if len(rows) > MAX_POINTS_PER_SERIES:
                rows, thinned = rows[np.linspace(0, len(rows) - 1, MAX_POINTS_PER_SERIES).astype(int)], True
            series.append(
                {
                    "label": name,
                    "channel": channel.name,
                    "unit": channel.unit,
                    "use": use,
                    "pressure": held,
                    "time": inputs["time"][rows] if "time" in inputs else None,
                    "contraction": 1.0 - length[rows] / rest,
                    "length": length[rows],
                    "x_pressure": pressure[rows],
                    "velocity": inputs.get("velocity", unknown)[rows],
                    "direction": inputs.get("direction", unknown)[rows],
                    "measured": predictor.measured[rows],
                    "predicted": result.predicted[rows],
                    "residual": result.residual[rows],
                }
            )
    return series, thinned


def _held(values: NDArray) -> float | None:
    """The level of a quantity that stays the same (within 3 %), else None."""
    level = float(np.mean(values))
    return level if np.ptp(values) <= 0.03 * abs(level) else None


def _label(number: int, pressure: float | None, length: float | None, *, timed: bool) -> str:
    if timed:
        return f"run {number}"
    if pressure is not None:
        return f"{pressure / 1e5:.3g} bar"
    return f"sweep {number}" if length is None else f"{length * 1e3:.4g} mm"
