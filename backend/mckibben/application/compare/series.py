"""The points of a comparison as curves for a plot, thinned for the screen."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from mckibben.facts.comparison import REVERSALS
from mckibben.facts.result import Number, Series, result_class
from mckibben.identification.fit.comparison import Comparison

MAX_POINTS_PER_SERIES = 400
MAX_SERIES = 200
_CONSTANT = 0.03  # share of its mean; a quantity that changes by less is constant

Array = NDArray[np.float64]


@result_class
class ComparedSeries:
    """One curve, e.g. all points of one pressure; SI, shape (points,)."""

    label: str
    """Name of the curve."""
    channel: str
    """The predicted channel."""
    unit: str
    """SI unit of measured, predicted and residual."""
    use: Literal["fit", "validation"]
    """Used for the fit, or only for validation."""
    pressure: float | None
    """Pressure of the series [Pa], when it has one."""
    time: Series | None
    """Time of each point [s]."""
    contraction: Series
    """Contraction of each point [-]."""
    length: Series
    """Length of each point [m]."""
    x_pressure: Series
    """Pressure of each point [Pa]."""
    angle: Series | None
    """Angle of the joint of each point [rad]; null where none was measured."""
    velocity: Series
    """dL/dt of each point [m/s]."""
    direction: Series
    """-1 shortening, 1 lengthening, 0 at rest or unknown."""
    measured: Series
    """Measured."""
    predicted: Series
    """Predicted."""
    residual: Series
    """Measured minus predicted."""


@result_class
class ComparedReversals:
    """Readings of force or torque where the motion turns, each with its range of friction.

    SI, shape (points,).
    """

    FIGURES: ClassVar = REVERSALS.name

    rows: int
    outside: int
    distance: Number
    time: Series | None
    """Time of each point [s]."""
    contraction: Series
    """Contraction of each point [-]."""
    length: Series
    """Length of each point [m]."""
    x_pressure: Series
    """Pressure of each point [Pa]."""
    angle: Series | None
    """Angle of the joint of each point [rad]; null where none was measured."""
    velocity: Series
    """dL/dt of each point [m/s]."""
    measured: Series
    """Measured, in the unit of the error."""
    low: Series
    """The least that the model allows."""
    high: Series
    """The most that it allows."""


@dataclass(frozen=True, slots=True)
class KnownInputs:
    """What is known of each value of a comparison, SI, shape (values,); NaN where not known."""

    time: Array | None
    length: Array
    contraction: Array
    pressure: Array
    velocity: Array
    direction: Array
    angle: Array | None = None


def inputs_of(comparison: Comparison) -> KnownInputs:
    """What is known of each compared value."""
    predictor = comparison.predictor
    inputs = predictor.inputs
    count = len(predictor.measured)
    rest = np.broadcast_to(predictor.rest_length(comparison.fit_model), (count,))
    unknown = np.full(count, np.nan)
    length = inputs.get("length", unknown)
    if predictor.predicted == "length":
        length = predictor.measured
    elif "displacement" in inputs:
        length = rest - inputs["displacement"]
    return KnownInputs(
        time=inputs.get("time"),
        length=length,
        contraction=1.0 - length / rest,
        pressure=inputs.get("pressure", unknown),
        angle=inputs.get("angle"),
        velocity=inputs.get("velocity", unknown),
        direction=inputs.get("direction", unknown),
    )


def rows_of(comparison: Comparison) -> dict[str, NDArray[Any]]:
    """All compared rows as columns, SI; those of several predicted channels one below the other.

    Columns: channel (text), group (number), time and angle where there are any, pressure, length,
    contraction, velocity, measured, predicted, residual (measured minus predicted).
    """
    predictor, known = comparison.predictor, inputs_of(comparison)
    channel = np.empty(len(predictor.measured), dtype=object)
    for each in predictor.channels:
        channel[each.rows] = each.name
    columns: dict[str, NDArray[Any]] = {"channel": channel, "group": np.asarray(predictor.groups)}
    if known.time is not None:
        columns["time"] = known.time
    if known.angle is not None:
        columns["angle"] = known.angle
    return columns | {
        "pressure": known.pressure,
        "length": known.length,
        "contraction": known.contraction,
        "velocity": known.velocity,
        "measured": predictor.measured,
        "predicted": comparison.predicted,
        "residual": comparison.residual,
    }


def series_of(comparison: Comparison, use: Literal["fit", "validation"]) -> tuple[list[ComparedSeries], bool]:
    """One curve per channel and group of rows, thinned for the screen; and whether any was thinned."""
    predictor, known = comparison.predictor, inputs_of(comparison)
    place = np.arange(len(predictor.measured))
    series: list[ComparedSeries] = []
    thinned = False
    for channel in predictor.channels:
        inside = place[channel.rows]
        labels = np.unique(predictor.groups[inside])
        if len(labels) > MAX_SERIES:
            labels, thinned = labels[:MAX_SERIES], True
        for number, label in enumerate(labels, 1):
            rows = inside[predictor.groups[inside] == label]
            level = constant_level(known.pressure[rows])
            length = constant_level(known.length[rows])
            name = _label(number, level, length, timed=predictor.kind == "transient")
            if len(rows) > MAX_POINTS_PER_SERIES:
                rows, thinned = rows[np.linspace(0, len(rows) - 1, MAX_POINTS_PER_SERIES).astype(int)], True
            series.append(
                ComparedSeries(
                    label=name,
                    channel=channel.name,
                    unit=channel.unit,
                    use=use,
                    pressure=level,
                    time=None if known.time is None else known.time[rows],
                    contraction=known.contraction[rows],
                    length=known.length[rows],
                    x_pressure=known.pressure[rows],
                    angle=None if known.angle is None else known.angle[rows],
                    velocity=known.velocity[rows],
                    direction=known.direction[rows],
                    measured=predictor.measured[rows],
                    predicted=comparison.predicted[rows],
                    residual=comparison.residual[rows],
                )
            )
    return series, thinned


def reversals_of(comparison: Comparison) -> tuple[ComparedReversals | None, bool]:
    """The readings where the motion turns, thinned for the screen; and whether any was left out."""
    found = comparison.reversals
    if found is None:
        return None, False
    rows = np.arange(len(found.measured))
    thinned = len(rows) > MAX_POINTS_PER_SERIES
    if thinned:
        rows = np.linspace(0, len(rows) - 1, MAX_POINTS_PER_SERIES).astype(int)
    time = found.inputs.get("time")
    length = found.inputs["length"]
    result = ComparedReversals(
        rows=len(found.measured),
        outside=found.outside(comparison.noise, comparison.rmse),
        distance=float(np.max(found.distance)),
        time=None if time is None else time[rows],
        contraction=(1.0 - length / found.muscle_length)[rows],
        length=length[rows],
        x_pressure=found.inputs["pressure"][rows],
        angle=None if "angle" not in found.inputs else found.inputs["angle"][rows],
        velocity=found.inputs["velocity"][rows],
        measured=found.measured[rows],
        low=found.low[rows],
        high=found.high[rows],
    )
    return result, thinned


def constant_level(values: Array) -> float | None:
    """The level of a constant quantity, else None."""
    level = float(np.mean(values))
    return level if np.ptp(values) <= _CONSTANT * abs(level) else None


def _label(number: int, pressure: float | None, length: float | None, *, timed: bool) -> str:
    if timed:
        return f"run {number}"
    if pressure is not None:
        return f"{pressure / 1e5:.3g} bar"
    return f"sweep {number}" if length is None else f"{length * 1e3:.4g} mm"
