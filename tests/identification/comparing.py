"""A measurement compared with a muscle and effects by name, as a test states them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from mckibben.identification.fit.comparison import Comparison, compared
from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.fit_model import FitModel, free_geometry
from mckibben.measurement.measurement import Measurement
from mckibben.physics.effect import Effect
from mckibben.physics.muscle import Muscle
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.statics.model import EffectValues, checked_values


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
    """The comparison; missing parameters take their defaults, ``fit`` fits those declared as fitted."""
    values = checked_values(effects, catalogue)
    fit_model = FitModel(muscle.checked(), tuple(catalogue[name] for name in values), values)
    return compared(
        predictor_of(measurement, muscle, drive),
        fit_model,
        rows=measurement.rows,
        fit=fit,
        geometry=free_geometry(muscle, free, tolerance or {}),
        freed=freed,
        noise=noise,
    )
