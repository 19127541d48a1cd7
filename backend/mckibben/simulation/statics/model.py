"""The static model of one muscle with chosen effects: force, stiffness, volume and diameter as curves."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from math import isfinite
from typing import Any, NamedTuple

import numpy as np

from mckibben.physics import ideal
from mckibben.physics.braid import Braid
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.model import ROOM_TEMPERATURE
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import UNKNOWN_SIZE, MuscleSize
from mckibben.simulation.statics.compiled import OUTPUTS, CompiledState, compiled_state
from mckibben.simulation.statics.limits import MuscleLimits

EffectValues = Mapping[str, Mapping[str, float]]

_NEWTON_STEPS = 12
_LENGTH_TOLERANCE = 1e-12  # m


class Curves(NamedTuple):
    """Curves of a pressure family; arrays of shape (pressures, lengths), SI."""

    force: np.ndarray
    stiffness: np.ndarray
    stiffness_closed: np.ndarray
    volume: np.ndarray
    diameter: np.ndarray
    outer_diameter: np.ndarray
    braid_angle: np.ndarray


class StaticModel:
    """A muscle with effects, compiled.

    Args:
        muscle: geometry, checked here.
        effects: effect id -> parameter values in SI; missing parameters take their defaults.
        catalogue: effects by id; the built-in catalogue by default.
        limits: limits stated by the maker.

    Raises:
        InputError: an unknown effect or parameter (with the nearest match), a value outside its bounds, a
            geometry that cannot pull, or an effect that needs a figure the muscle does not have.
    """

    def __init__(
        self,
        muscle: Muscle,
        effects: EffectValues | None = None,
        *,
        catalogue: Mapping[str, Effect] | None = None,
        limits: MuscleLimits | None = None,
    ) -> None:
        self.muscle = muscle.checked()
        self.limits = limits or MuscleLimits()
        known = default_catalogue() if catalogue is None else catalogue
        self.values = checked_values(effects or {}, known, size=self.muscle.size)
        self.effects = tuple(known[effect_id] for effect_id in self.values)
        for effect in self.effects:
            for needed in effect.needs:
                if not getattr(muscle, needed) > 0.0:
                    raise InputError(
                        f"the effect '{effect.id}' needs the {needed.replace('_', ' ')} of the muscle",
                        field=f"muscle.{needed}",
                        hint="e.g. '1.8 mm'",
                    )

    @classmethod
    def of(
        cls, muscle: Muscle, effects: tuple[Effect, ...], values: Mapping[str, Mapping[str, float]]
    ) -> StaticModel:
        """A model without checks, for a fit: the effects and values must be complete and valid."""
        model = cls.__new__(cls)
        model.muscle, model.limits = muscle, MuscleLimits()
        model.effects = effects
        model.values = {effect.id: dict(values[effect.id]) for effect in effects}
        return model

    @cached_property
    def _compiled(self) -> CompiledState:
        return compiled_state(self.effects)

    @cached_property
    def _constants(self) -> np.ndarray:
        return self._compiled.pack(self.muscle, self.values)

    @property
    def longest(self) -> float:
        """The longest permitted length: just below the braid lock L = b [m]."""
        return float(longest_of(self.muscle.braid))

    def outputs(
        self,
        *,
        length: Any,
        pressure: Any,
        velocity: Any = 0.0,
        direction: Any = 0.0,
        temperature: Any = ROOM_TEMPERATURE,
    ) -> dict[str, np.ndarray]:
        """Every output of the compiled model (`OUTPUTS`) at measured lengths and pressures.

        Inputs broadcast to one dimension. With a series compliance c the muscle itself is shorter by c times
        its tension; that length is found by Newton's method and all outputs, derivatives included, are those
        seen at the measured length.
        """
        state = {
            "length": length,
            "pressure": pressure,
            "velocity": velocity,
            "direction": direction,
            "temperature": temperature,
        }
        return settle(self._compiled, self._constants, state)[0]

    def force(self, *, clipped: bool = True, **state: Any) -> np.ndarray:
        """Measured tension [N]; a slack muscle (it would push) has zero tension unless unclipped."""
        outputs = self.outputs(**state)
        return clip_slack(outputs) if clipped else outputs["force"]

    def curves(
        self,
        pressures: np.ndarray,
        lengths: np.ndarray,
        *,
        direction: float = 0.0,
        temperature: float = ROOM_TEMPERATURE,
        clipped: bool = True,
        dead_volume: float = 0.0,
        polytropic_exponent: float = 1.4,
    ) -> Curves:
        """Curves over lengths [m] for each gauge pressure [Pa].

        The closed-valve stiffness keeps the gas mass: k_c = dF/dL - (dF/dP) gamma p (dV/dL)/(V + V_d +
        gamma p dV/dP) with the absolute pressure p. A slack muscle has neither force nor stiffness unless
        unclipped.
        """
        shape = (len(pressures), len(lengths))
        pressure = np.repeat(pressures, len(lengths))
        out = self.outputs(
            length=np.tile(lengths, len(pressures)),
            pressure=pressure,
            direction=direction,
            temperature=temperature,
        )
        bulk = polytropic_exponent * (pressure + ideal.ATMOSPHERE)
        volume = out["volume"] + dead_volume + bulk * out["volume_by_pressure"]
        force, stiffness = out["force"], out["force_by_length"]
        closed = stiffness - out["force_by_pressure"] * bulk * out["volume_by_length"] / volume
        if clipped:
            pulling = out["tension"] > 0.0
            force = clip_slack(out)
            stiffness = np.where(pulling, stiffness, 0.0)
            closed = np.where(pulling, closed, 0.0)
        fields = (force, stiffness, closed, *(out[name] for name in Curves._fields[3:]))
        return Curves(*(field.reshape(shape) for field in fields))


def checked_values(
    effects: EffectValues, catalogue: Mapping[str, Effect], *, size: MuscleSize = UNKNOWN_SIZE
) -> dict[str, dict[str, float]]:
    """Values of every parameter of the named effects, with defaults filled in; unknown names are refused.

    Args:
        effects: effect id -> parameter -> value [SI].
        catalogue: the known effects.
        size: see `mckibben.physics.parameter.Parameter.bounds` and ``default_of``.

    Raises:
        InputError: an unknown parameter, or a value outside its bounds.
    """
    values: dict[str, dict[str, float]] = {}
    for effect_id, stated in effects.items():
        effect = catalogue[effect_id]
        known = {parameter.name: parameter for parameter in effect.parameters}
        for name, value in stated.items():
            field = f"effects.{effect_id}.{name}"
            if name not in known:
                raise InputError(
                    f"the effect '{effect_id}' has no parameter '{name}'",
                    field=field,
                    hint=did_you_mean(name, known),
                )
            parameter = known[name]
            lower, upper = parameter.bounds(size)
            least, most = parameter.allowed(size)
            if not isfinite(value) or not least <= value <= most:
                unit = "" if parameter.unit == "1" else f" {parameter.unit}"
                raise InputError(
                    f"{name.replace('_', ' ')} of '{effect_id}' is {value:g}{unit}, outside "
                    f"{lower:g} to {upper:g}{unit}",
                    field=field,
                    hint=f"a typical value is {parameter.default_of(size):g}{unit}",
                )
        values[effect_id] = {**effect.defaults_of(size), **stated}
    return values


def longest_of(braid: Braid) -> Value:
    """The longest permitted length of a braid: just below its lock L = b [m]."""
    return 0.9999 * braid.thread_length


def clip_slack(outputs: Mapping[str, np.ndarray]) -> np.ndarray:
    """Force readings, with zero tension for slack muscles (negative tension)."""
    return np.where(outputs["tension"] > 0.0, outputs["force"], outputs["slack_force"])


def settle(
    compiled: CompiledState, constants: np.ndarray, state: Mapping[str, Any]
) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """Outputs with the series compliance solved for, and the remaining rows after `OUTPUTS` (gradients)."""
    rows = compiled(constants, **state)
    out = dict(zip(OUTPUTS, rows, strict=False))
    if not (compiled.compliant and np.any(out["compliance"])):
        return out, rows[len(OUTPUTS) :]
    target = out["length"]  # true length of muscle and series spring together
    reading = np.broadcast_to(np.asarray(state["length"], dtype=float), target.shape).copy()
    for _ in range(_NEWTON_STEPS):
        pulling = out["tension"] > 0.0
        stretch = out["compliance"] * np.where(pulling, out["tension"], 0.0)
        slope = out["length_by_length"] + out["compliance"] * np.where(pulling, out["tension_by_length"], 0.0)
        step = (out["length"] + stretch - target) / slope
        reading = reading - step
        rows = compiled(constants, **{**state, "length": reading})
        out = dict(zip(OUTPUTS, rows, strict=False))
        if np.max(np.abs(step)) < _LENGTH_TOLERANCE:
            break
    pulling = out["tension"] > 0.0
    compliance = np.where(pulling, out["compliance"], 0.0)
    slope = out["length_by_length"] + compliance * out["tension_by_length"]
    # Derivatives of the muscle's length by the measured length, and by pressure at a fixed measured length.
    by_length = out["length_by_length"] / slope
    by_pressure = -compliance * out["tension_by_pressure"] / slope
    for name in ("force", "volume"):
        out[f"{name}_by_pressure"] = out[f"{name}_by_pressure"] + out[f"{name}_by_length"] * by_pressure
        out[f"{name}_by_length"] = out[f"{name}_by_length"] * by_length
    return out, rows[len(OUTPUTS) :]
