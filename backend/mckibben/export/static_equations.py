"""The static model of a muscle for other programs: results of pressure, length, motion and memory.

Two blocks. ``evaluate`` gives, at a length of the muscle as its sensor reads it, what `StaticModel` computes
before it solves for a series compliance; ``rates`` gives the rates of the states of the effects with memory.
Slack muscles and the compliance are handled by the few lines that each language writes around them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import symengine as se

from mckibben.physics import ops
from mckibben.physics.custom import blamed_on_the_term
from mckibben.physics.effect import Effect, StateVariable
from mckibben.simulation.statics.symbolic import symbolic_state

# Slots through which an effect changes the static model; what acts through others only is left out.
STATIC_SLOTS = frozenset({
    "pressure", "braid", "shape", "force_factor", "elastomer", "elastomer_factor", "tension", "friction",
    "compliance", "rates", "pressure_sensor", "length_sensor", "force_sensor",
})  # fmt: skip
# Results of ``evaluate`` in their order: name -> (field of the model, input that it is differentiated by).
RESULTS: Mapping[str, tuple[str, str | None]] = {
    "force": ("force", None),
    "force_by_length": ("force", "length"),
    "force_by_pressure": ("force", "pressure"),
    "tension": ("tension", None),
    "tension_by_length": ("tension", "length"),
    "tension_by_pressure": ("tension", "pressure"),
    "slack_force": ("slack_force", None),
    "volume": ("volume", None),
    "volume_by_length": ("volume", "length"),
    "volume_by_pressure": ("volume", "pressure"),
    "diameter": ("diameter", None),
    "outer_diameter": ("outer_diameter", None),
    "braid_angle": ("braid_angle", None),
    "true_length": ("length", None),
    "true_length_by_length": ("length", "length"),
    "compliance": ("compliance", None),
}
PRESSURE_RATE = "pressure_rate"


@dataclass(frozen=True)
class StaticEquations:
    """The static model as named expressions.

    Attributes:
        inputs: name -> symbol, of `mckibben.simulation.statics.symbolic.INPUTS` and ``pressure_rate``.
        states: "effect.state" -> symbol.
        state_variables: "effect.state" -> its declaration.
        constants: geometry and "effect.parameter" -> symbol; only those that the model depends on.
        results: `RESULTS` -> expression.
        rates: "effect.state" -> expression.
        direction: the sign of the velocity, 0 at rest.
        compliant: whether a compliance in series has to be solved for.
        left_out: ids of the effects that do not act here.
    """

    inputs: dict[str, Any]
    states: dict[str, Any]
    state_variables: dict[str, StateVariable]
    constants: dict[str, Any]
    results: dict[str, Any]
    rates: dict[str, Any]
    direction: Any
    compliant: bool
    left_out: tuple[str, ...]


@lru_cache(maxsize=64)
def static_equations(effects: tuple[Effect, ...]) -> StaticEquations:
    """The static model of effects on symbols.

    Raises:
        InputError: a typed term among the effects cannot be differentiated.
    """
    acting = tuple(effect for effect in effects if STATIC_SLOTS & set(effect.slots))
    with blamed_on_the_term(acting):
        symbolic = symbolic_state(acting, memory=True)
        rate = se.Symbol(PRESSURE_RATE)
        results = {
            name: getattr(symbolic.fields, field) if by is None else symbolic.by(field, by)
            for name, (field, by) in RESULTS.items()
        }
        rates = symbolic.rates(rate)
    used = set().union(*(expression.free_symbols for expression in (*results.values(), *rates.values())))
    length = symbolic.geometry["nominal_length"]
    return StaticEquations(
        inputs={**symbolic.inputs, PRESSURE_RATE: rate},
        states=symbolic.states,
        state_variables={
            f"{effect.id}.{state.name}": state
            for effect in acting
            for state in effect.states
            if f"{effect.id}.{state.name}" in symbolic.states
        },
        constants={
            name: symbol for name, symbol in symbolic.constants.items() if symbol in used or symbol is length
        },
        results=results,
        rates=rates,
        direction=ops.sign(symbolic.inputs["velocity"]),
        compliant=symbolic.model.has("compliance"),
        left_out=tuple(effect.id for effect in effects if effect not in acting),
    )
