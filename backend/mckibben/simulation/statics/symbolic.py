"""The static model on symbols: the one source of what is compiled here and of what is written out as code."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import symengine as se

from mckibben.physics.effect import Effect
from mckibben.physics.model import Model, State
from mckibben.physics.muscle import GEOMETRY, Muscle

# Inputs that vary from row to row, in this order; geometry and parameters follow.
INPUTS = ("length", "pressure", "velocity", "direction", "temperature")


@dataclass(frozen=True)
class SymbolicState:
    """`Model.evaluate` on symbols.

    Attributes:
        model: the composition.
        inputs: `INPUTS` -> symbol.
        states: "effect.state" -> symbol; empty where the states are at rest.
        geometry: `GEOMETRY` -> symbol.
        parameters: "effect.parameter" -> symbol.
        fields: the outputs.
    """

    model: Model
    inputs: dict[str, Any]
    states: dict[str, Any]
    geometry: dict[str, Any]
    parameters: dict[str, Any]
    fields: State

    @property
    def constants(self) -> dict[str, Any]:
        """Geometry and parameters, in the order in which they are packed."""
        return {**self.geometry, **self.parameters}

    def by(self, field: str, name: str) -> Any:
        """The exact derivative of a field by an input."""
        return getattr(self.fields, field).diff(self.inputs[name])

    def rates(self, pressure_rate: Any) -> dict[str, Any]:
        """Rates of the states at a rate of the measured pressure [Pa/s]."""
        given = self.model.rates(
            muscle=Muscle(**self.geometry), values=self._values(), **self.inputs, pressure_rate=pressure_rate
        )
        return {name: se.sympify(rate) for name, rate in given.items()}

    def _values(self) -> dict[str, dict[str, Any]]:
        return values_of(self.model, {**self.parameters, **self.states})


def values_of(model: Model, named: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Values by effect from "effect.name" -> value."""
    values: dict[str, dict[str, Any]] = {effect.id: {} for effect in model.effects}
    for name, value in named.items():
        effect, _, own = name.partition(".")
        values[effect][own] = value
    return values


def symbolic_state(effects: tuple[Effect, ...], *, memory: bool = False) -> SymbolicState:
    """The static model of effects on symbols.

    Args:
        effects: the effects of the structure.
        memory: whether the states of the muscle's effects are symbols; else they are at rest.
    """
    model = Model(effects)
    inputs = {name: se.Symbol(name) for name in INPUTS}
    states = {
        f"{effect.id}.{state.name}": se.Symbol(f"{effect.id}.{state.name}")
        for effect in model.effects
        if memory and "rates" in effect.slots
        for state in effect.states
    }
    geometry = {name: se.Symbol(name) for name in GEOMETRY}
    parameters = {
        f"{effect.id}.{p.name}": se.Symbol(f"{effect.id}.{p.name}")
        for effect in model.effects
        for p in effect.parameters
    }
    state = model.evaluate(
        muscle=Muscle(**geometry), values=values_of(model, {**parameters, **states}), **inputs
    )
    fields = State(*(se.sympify(output) for output in state))
    return SymbolicState(model, inputs, states, geometry, parameters, fields)
