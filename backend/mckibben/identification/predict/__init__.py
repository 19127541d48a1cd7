"""Prediction of a measurement by a model: for each kind, the inputs and the predicted channels.

| kind | given | predicted |
|---|---|---|
| isobaric, isometric, static | pressure, length (and time, where rates or memory matter) | force |
| isotonic | pressure, load | length |
| diameter | pressure or length | diameter |
| transient | command, supply, load | pressure, displacement (force where measured) |
| transient, no command channel | measured pressure, load | displacement (force where measured) |
"""

from __future__ import annotations

from mckibben.identification.predict.comparable_rows import comparable_rows
from mckibben.identification.predict.moving import TransientPredictor
from mckibben.identification.predict.predictor import PredictedChannel, Predictor
from mckibben.identification.predict.quasistatic import QuasistaticPredictor
from mckibben.measurement.measurement import Measurement
from mckibben.physics import ideal
from mckibben.physics.errors import InputError
from mckibben.physics.muscle import Muscle
from mckibben.simulation.command.shapes import Step
from mckibben.simulation.drive.parts import Drive, Load, Valve
from mckibben.simulation.statics.model import StaticModel

__all__ = ["PredictedChannel", "Predictor", "QuasistaticPredictor", "TransientPredictor", "predictor_of"]

_PRESSURE = 6e5  # Pa; required by the drive, but unused because the pressure is measured
_ANY_VALVE = Valve(1e-8, 1e-8)  # the pressure is measured, so no air flows through it


def predictor_of(measurement: Measurement, muscle: Muscle, drive: Drive | None = None) -> Predictor:
    """The predictor for a measurement.

    Args:
        measurement: of any kind.
        muscle: for the nominal length and the thread length of the braid.
        drive: of a transient measurement; not needed if the load is stated and there is no command channel.

    Raises:
        InputError: a channel, a condition or the drive is missing.
    """
    if measurement.kind != "transient":
        task = comparable_rows(measurement, muscle)
        pressure = max(float(task.state["pressure"].max()), 1.0)
        blocked = ideal.force(braid=muscle.braid, pressure=pressure, length=muscle.nominal_length)
        return QuasistaticPredictor(task, largest_load=float(blocked))
    return TransientPredictor(measurement, drive or _bare_drive(measurement, muscle))


def _bare_drive(measurement: Measurement, muscle: Muscle) -> Drive:
    if "command" in measurement.columns:
        raise InputError(
            f"{measurement.name}: a transient with a command channel needs the drive's valve and load",
            field="drive",
            hint="give a drive document (--drive DRIVE.json)",
        )
    conditions = measurement.conditions
    if not {"load_mass", "load_force"} & set(conditions):
        unused = ", ".join(f"'{header}'" for header in measurement.ignored)
        also = f"; is the force in one of the unused columns {unused}?" if unused else ""
        raise InputError(
            f"{measurement.name}: the load of a transient measurement is not given",
            field="load_mass",
            hint=f"add a line '# load_mass: 6 kg' before the header, or give a drive document{also}",
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
        max_contraction=0.4,
    )
