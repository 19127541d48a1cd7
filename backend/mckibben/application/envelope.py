"""Where a model was measured: the range of each quantity of its data, and which data leave it."""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite

import numpy as np
from numpy.typing import NDArray

from mckibben.application.compare.specimens import Specimen, Specimens
from mckibben.application.muscle_summary import Notice
from mckibben.facts.comparison import FASTEST, MEASURED
from mckibben.facts.figure import Figure
from mckibben.facts.result import result_class
from mckibben.identification.predict import Predictor
from mckibben.identification.predict.fit_model import FitModel
from mckibben.measurement.measurement import STROKES
from mckibben.presets.fit import FitRecord

#: Code of the notice that a fitted model is used where it was not measured.
OUTSIDE_MEASURED = "outside_measured_range"
_MARGIN = {"speed": 0.2}  # share of the largest magnitude that data may lie outside; a speed is less certain
_USUAL_MARGIN = 0.02


@result_class
class MeasuredRange:
    """The range of a quantity in the data of a model, SI; pressures are gauge."""

    least: float
    """Smallest value; of the speed 0."""
    most: float
    """Largest value; of the speed the 99th percentile of the magnitudes."""
    unit: str
    """SI unit; pressures are gauge."""


#: Quantity (rest_length, pressure, contraction, speed, temperature, load, mass, supply) -> its range. A
#: quantity that was not measured, or does not occur in data of this kind, is missing.
Envelope = Mapping[str, MeasuredRange]


def envelope_of(specimens: Specimens, predictor: Predictor, model: FitModel) -> dict[str, MeasuredRange]:
    """The ranges of the rows that are compared; `mckibben.facts.comparison.MEASURED` says what each is.

    Args:
        specimens: the measurements.
        predictor: their rows that are compared.
        model: for the rest length that contractions are counted from.
    """
    measured = {name for one in specimens.each for name in one.points.measurement.columns}
    inputs, rest = predictor.inputs, predictor.rest_length(model)
    # A fit may have moved the rest length of a single muscle from the stated one.
    own = float(model.muscle.nominal_length) if specimens.one_length else None
    lengths = [float(one.muscle.nominal_length) if own is None else own for one in specimens.each]
    values: dict[str, NDArray[np.float64]] = {"rest_length": np.array(lengths)}
    if "pressure" in measured and "pressure" in inputs:
        values["pressure"] = inputs["pressure"]
    if measured & set(STROKES):
        if "length" in inputs:
            values["contraction"] = 1.0 - inputs["length"] / rest
        elif "displacement" in inputs:
            values["contraction"] = inputs["displacement"] / rest
    if "time" in measured and "velocity" in inputs:
        values["speed"] = np.array([0.0, np.percentile(np.abs(inputs["velocity"]), FASTEST)])
    if "temperature" in measured and "temperature" in inputs:
        values["temperature"] = inputs["temperature"]
    if "load" in inputs and predictor.unknown_load is None:
        values["load"] = inputs["load"]
    for name, numbers in _of_drives(specimens).items():
        values[name] = np.array(numbers)
    return {
        name: MeasuredRange(float(np.min(numbers)), float(np.max(numbers)), MEASURED[name].unit)
        for name, numbers in values.items()
        if len(numbers) and np.all(np.isfinite(numbers))
    }


def _of_drives(specimens: Specimens) -> dict[str, list[float]]:
    """Moved mass, constant force and supply pressure of transient measurements."""
    found: dict[str, list[float]] = {}
    for one in specimens.each:
        if one.points.measurement.kind == "transient":
            for name, value in _of_drive(one).items():
                found.setdefault(name, []).append(value)
    return found


def _of_drive(specimen: Specimen) -> dict[str, float]:
    measurement, drive = specimen.points.measurement, specimen.drive
    conditions, values = measurement.conditions, {}
    force = None if drive is None or not isinstance(drive.load.force, float | int) else drive.load.force
    for name, condition, of_drive in (
        ("mass", "load_mass", None if drive is None else drive.load.mass),
        ("load", "load_force", force or None),
        ("supply", "supply_pressure", None if drive is None else drive.supply_pressure),
    ):
        value = conditions.get(condition, of_drive)
        if value is not None and (name != "supply" or "command" in measurement.columns):
            values[name] = float(value)
    return values


def range_of(name: str, *values: float) -> dict[str, MeasuredRange]:
    """The range of a quantity of an answer, from its least and largest values; empty without finite ones."""
    finite = [value for value in values if isfinite(value)]
    return {name: MeasuredRange(min(finite), max(finite), MEASURED[name].unit)} if finite else {}


def use_notices(fit: FitRecord | None, use: Envelope) -> list[Notice]:
    """Where the use of a fitted model leaves the ranges that it was measured in; nowhere without a fit.

    Args:
        fit: how the model was fitted.
        use: the ranges of the answer.
    """
    if fit is None:
        return []
    known = {name: MeasuredRange(span.least, span.most, span.unit) for name, span in fit.envelope.items()}
    return [Notice(OUTSIDE_MEASURED, message) for message in beyond(known, use)]


def beyond(known: Envelope, data: Envelope) -> list[str]:
    """Where data leave the ranges that a model was measured in, in words; empty where nowhere.

    Args:
        known: of the model; empty where it is not known.
        data: of the data.
    """
    if not known:
        return []
    messages = []
    for name, found in data.items():
        figure = MEASURED[name]
        if name not in known:
            if name == "speed" and found.most > 0.0:
                messages.append(
                    f"{figure.words} up to {_shown(figure, found.most)}: the model was measured without time"
                )
            continue
        own = known[name]
        margin = _MARGIN.get(name, _USUAL_MARGIN) * max(abs(own.least), abs(own.most))
        low, high = (_shown(figure, value) for value in (own.least, own.most))
        single = low == high
        if found.most > own.most + margin:
            limit = f"at {high}" if single else f"up to {high}"
            messages.append(
                f"{figure.words} up to {_shown(figure, found.most)}: the model was measured {limit}"
            )
        if found.least < own.least - margin:
            limit = f"at {low}" if single else f"from {low}"
            messages.append(
                f"{figure.words} down to {_shown(figure, found.least)}: the model was measured {limit}"
            )
    return messages


def _shown(figure: Figure, value: float) -> str:
    return f"{figure.scale.of(value):.3g} {figure.scale.unit}"
