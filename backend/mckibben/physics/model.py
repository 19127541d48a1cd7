r"""Composition: one muscle and any choice of effects give one model, on numbers, arrays or symbols.

.. math:: F = f\,P_\mathrm{eff}\Bigl(-\frac{\partial V}{\partial L}\Bigr)
   + e\sum F_\mathrm{elastomer} + \sum F_\mathrm{tension} + \sum F_\mathrm{friction}

with the product f of all force factors, e of all elastomer factors. The gas balance uses the same volume V,
so force and dV/dL are always consistent. Sensor readings of length and pressure are first converted to true
values, and the true force is last converted to a reading.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple

from mckibben.physics import braid as braid_geometry
from mckibben.physics import ops
from mckibben.physics.effect import Effect
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.slots import Reading, Shape

ROOM_TEMPERATURE = 293.15  # K

Values = Mapping[str, Mapping[str, Value]]


class State(NamedTuple):
    """Outputs of the model for one state; every field has the broadcast shape of the inputs.

    Attributes:
        force: tension read by the force sensor, unclipped: negative means it would push [N].
        tension: true tension of the muscle, unclipped [N].
        slack_force: reading of the force sensor when the muscle is slack [N].
        length: true length of the muscle [m].
        area: force per driving pressure -dV/dL [m^2].
        volume: enclosed gas volume [m^3].
        diameter: braid diameter at mid-span [m].
        braid_angle: braid angle [rad].
        outer_diameter: outer diameter of the wall at mid-span [m], at constant wall volume.
        compliance: extension in series per force [m/N].
    """

    force: Value
    tension: Value
    slack_force: Value
    length: Value
    area: Value
    volume: Value
    diameter: Value
    braid_angle: Value
    outer_diameter: Value
    compliance: Value


class Model:
    """The composition of effects; contains only the structure, no values.

    Args:
        effects: effects in any order; chained slots run in their declared order, then by id.
    """

    def __init__(self, effects: Iterable[Effect] = ()) -> None:
        self.effects = tuple(sorted(effects, key=lambda effect: (effect.order, effect.id)))

    def evaluate(
        self,
        *,
        muscle: Muscle,
        values: Values,
        length: Value,
        pressure: Value,
        velocity: Value = 0.0,
        direction: Value = 0.0,
        temperature: Value = ROOM_TEMPERATURE,
    ) -> State:
        """The state at a measured length [m] and measured gauge pressure [Pa].

        The length is taken at the muscle; a series compliance is only reported, because it needs the force
        (`mckibben.simulation.statics.model` solves for both). Direction is the sign of the velocity dL/dt: -1
        shortening (filling), +1 lengthening (venting), 0 at rest.
        """
        sensor = self.reading("force_sensor", muscle=muscle, values=values, temperature=temperature)
        state = self.at(
            muscle=muscle,
            values=values,
            length=_inverse(self.reading("length_sensor", muscle=muscle, values=values), length),
            pressure=_inverse(self.reading("pressure_sensor", muscle=muscle, values=values), pressure),
            velocity=velocity,
            direction=direction,
            temperature=temperature,
        )
        return state._replace(force=sensor.scale * state.tension + sensor.offset, slack_force=sensor.offset)

    def at(
        self,
        *,
        muscle: Muscle,
        values: Values,
        length: Value,
        pressure: Value,
        velocity: Value,
        direction: Value,
        temperature: Value = ROOM_TEMPERATURE,
    ) -> State:
        """The state at a true length [m] and true gauge pressure [Pa], without sensors.

        ``values`` may hold states of effects in addition to their parameters; missing states are at rest.
        """
        context: dict[str, Any] = {
            "muscle": muscle,
            "length": length,
            "pressure": pressure,
            "velocity": velocity,
            "direction": direction,
            "temperature": temperature,
        }
        shape, braid = self._shape(values, context)
        here = shape(length)
        area = -ops.derivative(lambda x: shape(x).volume, length)
        driving = self.chain("pressure", pressure, values, context, name="pressure")
        tension = (
            self.product("force_factor", values, context) * driving * area
            + self.product("elastomer_factor", values, context) * self.sum("elastomer", values, context)
            + self.sum("tension", values, context)
            + self.sum("friction", values, context)
        )
        return State(
            force=tension,
            tension=tension,
            slack_force=0.0,
            length=length,
            area=area,
            volume=here.volume,
            diameter=here.diameter,
            braid_angle=braid_geometry.angle(braid=braid, length=length),
            outer_diameter=here.diameter + _wall(muscle, here.diameter, length),
            compliance=self.sum("compliance", values, {}),
        )

    def rates(
        self,
        *,
        muscle: Muscle,
        values: Values,
        length: Value,
        pressure: Value,
        velocity: Value,
        direction: Value,
        temperature: Value = ROOM_TEMPERATURE,
        pressure_rate: Value = 0.0,
    ) -> dict[str, Value]:
        """Rates of the states in the muscle ("effect.state"), as `evaluate`; the pressure changes by Pa/s.

        ``values`` holds the states of effects in addition to their parameters.
        """
        pressure_sensor = self.reading("pressure_sensor", muscle=muscle, values=values)
        context: dict[str, Any] = {
            "muscle": muscle,
            "length": _inverse(self.reading("length_sensor", muscle=muscle, values=values), length),
            "pressure": _inverse(pressure_sensor, pressure),
            "velocity": velocity,
            "direction": direction,
            "temperature": temperature,
        }
        context["area"] = self.at(**context, values=values).area
        context["pressure_rate"] = pressure_rate / pressure_sensor.scale
        rates: dict[str, Value] = {}
        for effect in self._with("rates"):
            given = effect.call("rates", context, values[effect.id])
            rates |= {f"{effect.id}.{own.name}": rate for own, rate in zip(effect.states, given, strict=True)}
        return rates

    def has(self, slot: str) -> bool:
        """Whether any effect acts in a slot."""
        return bool(self._with(slot))

    def _with(self, slot: str) -> list[Effect]:
        return [effect for effect in self.effects if slot in effect.slots]

    def sum(self, slot: str, values: Values, context: Mapping[str, Value]) -> Value:
        """Sum of the results of all effects of a slot; 0 without effects."""
        return sum((e.call(slot, context, values[e.id]) for e in self._with(slot)), 0.0)

    def product(self, slot: str, values: Values, context: Mapping[str, Value]) -> Value:
        """Product of the results of all effects of a slot; 1 without effects."""
        result: Value = 1.0
        for effect in self._with(slot):
            result = result * effect.call(slot, context, values[effect.id])
        return result

    def chain(
        self, slot: str, start: Value, values: Values, context: Mapping[str, Value], *, name: str
    ) -> Value:
        """A value after all functions of a chained slot, which take it under the given name."""
        for effect in self._with(slot):
            start = effect.call(slot, {**context, name: start}, values[effect.id])
        return start

    def reading(
        self, slot: str, *, muscle: Muscle, values: Values, temperature: Value = ROOM_TEMPERATURE
    ) -> Reading:
        """The sensors of a channel in series, combined into one."""
        chain = Reading(1.0, 0.0)
        for effect in self._with(slot):
            scale, offset = effect.call(
                slot, {"muscle": muscle, "temperature": temperature}, values[effect.id]
            )
            chain = Reading(chain.scale * scale, chain.offset * scale + offset)
        return chain

    def _shape(
        self, values: Values, context: Mapping[str, Value]
    ) -> tuple[Callable[[Value], Shape], braid_geometry.Braid]:
        braid = context["muscle"].braid
        for effect in self._with("braid"):
            braid = effect.call("braid", {**context, "braid": braid}, values[effect.id])

        def ideal(length: Value) -> Shape:
            return Shape(
                braid_geometry.volume(braid=braid, length=length),
                braid_geometry.diameter(braid=braid, length=length),
            )

        shape: Callable[[Value], Shape] = ideal
        for effect in self._with("shape"):
            shape = _wrapped(effect, values[effect.id], context, shape)
        return shape, braid


def _wrapped(
    effect: Effect, values: Mapping[str, Value], context: Mapping[str, Value], inner: Callable[[Value], Shape]
) -> Callable[[Value], Shape]:
    return lambda length: effect.call("shape", {**context, "inner": inner, "length": length}, values)


def _inverse(reading: Reading, measured: Value) -> Value:
    return (measured - reading.offset) / reading.scale


def _wall(muscle: Muscle, diameter: Value, length: Value) -> Value:
    # Constant volume of rubber: H D L = H0 D0 L0 for a thin wall.
    return muscle.wall_thickness * muscle.braid_diameter * muscle.nominal_length / (diameter * length)
