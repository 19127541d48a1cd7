"""Prediction of a measurement by a model: for each kind, the inputs and the predicted channels.

| kind | given | predicted |
|---|---|---|
| isobaric, isometric, static | pressure, length (and time, where rates or memory matter) | force |
| the same at a joint | pressures, angle, levers | torque |
| isotonic | pressure, load | length |
| diameter | pressure or length | diameter |
| transient | command, supply, load | pressure, displacement (force where measured) |
| transient, no command channel | measured pressure, load | displacement (force where measured) |
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from mckibben.identification.predict.comparable_rows import comparable_rows
from mckibben.identification.predict.joint import JointPredictor, joint_rows, of_joint
from mckibben.identification.predict.moving import TransientPredictor
from mckibben.identification.predict.moving_records import highest_stop, hung_weights, lowest_stop
from mckibben.identification.predict.predictor import PredictedChannel, Predictor
from mckibben.identification.predict.quasistatic import QuasistaticPredictor
from mckibben.identification.predict.reading_errors import ReadingError
from mckibben.measurement.measurement import Measurement
from mckibben.physics import ideal
from mckibben.physics.errors import InputError
from mckibben.physics.muscle import Muscle
from mckibben.simulation.command.shapes import Step
from mckibben.simulation.drive.parts import Drive, Load, Valve
from mckibben.simulation.statics.model import StaticModel

__all__ = [
    "PredictedChannel", "Predictor", "QuasistaticPredictor", "TransientPredictor", "driven_by_pressure",
    "highest_stop", "lowest_stop", "predictor_of",
]  # fmt: skip

_PRESSURE = 6e5  # Pa; required by the drive, but unused because the pressure is measured
_ANY_VALVE = Valve(1e-8, 1e-8)  # the pressure is measured, so no air flows through it

_SAME_CLAMP = 0.1  # of the accuracy of a length, within which two groups have the same


def predictor_of(
    measurement: Measurement,
    muscle: Muscle,
    drive: Drive | None = None,
    accuracy: Mapping[str, float] | None = None,
) -> Predictor:
    """The predictor for a measurement.

    Args:
        measurement: of any kind.
        muscle: for the nominal length and the thread length of the braid.
        drive: of a transient measurement; not needed if the load is stated and there is no command channel.
        accuracy: channel -> standard deviation [SI] of what its readings may be wrong by all the time. Each
            clamped length of an isometric measurement has its own error. Transients do not use it.

    Raises:
        InputError: a channel, a condition or the drive is missing.
    """
    if measurement.kind != "transient":
        levered = of_joint(measurement)
        task = comparable_rows(measurement, muscle)
        pressure = max(float(task.state["pressure"].max()), 1.0)
        blocked = ideal.force(braid=muscle.braid, pressure=pressure, length=muscle.nominal_length)
        if levered:
            rows = joint_rows(measurement, task)
            predictor: QuasistaticPredictor | JointPredictor = JointPredictor(
                task, rows, largest_load=float(blocked)
            )
        else:
            predictor = QuasistaticPredictor(task, largest_load=float(blocked))
        _set_accuracy(predictor, dict(accuracy or {}))
        return _sharing_noise(predictor, measurement)
    transient = TransientPredictor(measurement, drive or driven_by_pressure(measurement, muscle))
    return _sharing_noise(transient, measurement)


def _sharing_noise(predictor: Predictor, measurement: Measurement) -> Predictor:
    """The predictor, whose noise holds what neighbouring rows share since a filter."""
    if len(predictor.channels) == 1:  # several are weighed by noises that hold it already
        shared = measurement.shared_noise.get(predictor.channels[0].name, 0.0)
        predictor.input_floor = float(np.hypot(predictor.input_floor, shared))
    return predictor


def _set_accuracy(predictor: Predictor, accuracy: dict[str, float]) -> None:
    """Clamped lengths as reading errors; all other accuracies are common to all rows."""
    length = accuracy.pop("length", 0.0) if predictor.kind == "isometric" else 0.0
    if length > 0.0:
        at = predictor.inputs["length"]
        clamped = _clamped(predictor.groups, at, length)
        predictor.reading_errors = tuple(
            ReadingError("length", f"clamped at {1e3 * float(np.mean(at[rows])):.4g} mm", length, "m", rows)
            for rows in clamped
        )
    seen = {channel.name for channel in predictor.channels} | set(predictor.inputs)
    predictor.accuracy = {name: sigma for name, sigma in accuracy.items() if name in seen and sigma > 0.0}


def _clamped(groups: np.ndarray, length: np.ndarray, accuracy: float) -> list[np.ndarray]:
    """Masks of the rows that were measured in one clamping: groups one after the other at the same length.

    A way there and its way back are two groups, but nobody clamped the muscle anew between them.
    """
    masks: list[np.ndarray] = []
    for label in np.unique(groups).tolist():
        rows = groups == label
        if masks and abs(np.mean(length[rows]) - np.mean(length[masks[-1]])) < _SAME_CLAMP * accuracy:
            masks[-1] = masks[-1] | rows
        else:
            masks.append(rows)
    return masks


def driven_by_pressure(measurement: Measurement, muscle: Muscle) -> Drive:
    """The drive of a transient measurement whose pressure is given: its load alone matters.

    Raises:
        InputError: it has a command channel, or its load is not stated.
    """
    if "command" in measurement.columns:
        raise InputError(
            f"{measurement.name}: a transient with a command channel needs the drive's valve and load",
            field="drive",
            hint="give a drive document (--drive DRIVE.json), or --load and "
            '--experiment "valve=MPYE-5-1/8-HF"',
        )
    conditions = measurement.conditions
    if not {"load_mass", "load_force"} & set(conditions) and hung_weights(measurement) is None:
        unused = ", ".join(f"'{header}'" for header in measurement.undecided)
        also = f"; is the force in one of the unused columns {unused}?" if unused else ""
        also = "" if "force" in measurement.columns else also
        raise InputError(
            f"{measurement.name}: the load of a transient measurement is not given",
            field="load_mass",
            hint=f"--load '6 kg', or a line '# load_mass: 6 kg' before the header, or a drive document{also}",
        )
    return Drive(
        model=StaticModel(muscle),
        valve=_ANY_VALVE,
        load=Load(
            mass=float(conditions.get("load_mass", 0.0)), force=float(conditions.get("load_force", 0.0))
        ),
        command=Step(level=1.0, initial=0.0),
        duration=1.0,
        supply_pressure=_PRESSURE,
        min_contraction=lowest_stop(measurement, muscle.nominal_length),
        max_contraction=highest_stop(measurement, muscle.nominal_length, None),
    )
