"""The equations of a whole drive for other programs: what a packager of an FMU builds on.

They are those of `mckibben.physics.drive`, with three changes. Inputs have one value instead of a value and
a slope, so that the clock is no state. The pressure of the supply is an input, as opening and external force
are. And what depends on parameters alone is computed once, by ``prepare``.

The pieces, each a list of named expressions:

- ``prepare``: parameters -> constants of a run;
- ``rates``: d/dt of the states;
- ``outputs``: forces, flows, readings and the like;
- ``guards``: one for each switch (a stop that holds the load, a direction in which the load slides against
  dry friction, a muscle that hangs slack). A switch changes where its guard falls below minus ``least``;
  `Switch` says what then happens to the states;
- ``jacobian``: the nonzero entries of d rates / d states, as (row, column, expression);
- ``input_jacobian``: the same by the inputs, for directional derivatives.

All are functions of states, constants, inputs and switches.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import symengine as se

from mckibben.export.nodes import ordered
from mckibben.physics.custom import blamed_on_the_term
from mckibben.physics.drive import DriveModel
from mckibben.physics.drive_terms import DriveStructure, StateInfo, Switch
from mckibben.simulation.integrate.invariants import Invariants

# Inputs of a written-out drive; the second opening only of an antagonist pair.
OPENING, COUNTER_OPENING, FORCE, SUPPLY = "opening", "counter_opening", "external_force", "supply_pressure"
_SLOPES = ("opening_slope", "counter_opening_slope", "external_force_slope", "begin")
_CLOCK = "clock"
Entry = tuple[int, int, Any]


@dataclass(frozen=True)
class DriveEquations:
    """A drive as named expressions; see the module.

    Attributes:
        states: in their order, without the clock.
        state_symbols, parameters, constants, inputs, switch_symbols: name -> symbol, in their order;
            ``constants`` are numbered, each with its expression in ``prepare``.
        prepare: expression of each constant in terms of ``parameters``.
        rates, outputs, guards: expressions; ``output_names`` names the outputs.
        jacobian, input_jacobian: nonzero entries.
        switches: the switches.
    """

    states: list[StateInfo]
    state_symbols: dict[str, Any]
    parameters: dict[str, Any]
    constants: list[Any]
    inputs: dict[str, Any]
    switch_symbols: list[Any]
    prepare: list[Any]
    rates: list[Any]
    output_names: tuple[str, ...]
    outputs: list[Any]
    guards: list[Any]
    jacobian: list[Entry]
    input_jacobian: list[Entry]
    switches: list[Switch]


@lru_cache(maxsize=32)
def drive_equations(structure: DriveStructure) -> DriveEquations:
    """The equations of a structure.

    Raises:
        InputError: a typed term among the effects cannot be differentiated.
    """
    with blamed_on_the_term(structure.effects):
        return _equations(DriveModel(structure), pair=structure.pair)


def _equations(model: DriveModel, *, pair: bool) -> DriveEquations:
    clock = model.symbols[_CLOCK]
    # At the beginning of a segment: the inputs have their own values.
    now = {model.inputs[name]: se.Integer(0) for name in _SLOPES} | {clock: se.Integer(0)}
    states = [state for state in model.states if state.name != _CLOCK]
    symbols = {state.name: model.symbols[state.name] for state in states}
    parameters = {name: symbol for name, symbol in model.parameters.items() if name != SUPPLY}
    inputs = {
        OPENING: model.inputs[OPENING],
        **({COUNTER_OPENING: model.inputs[COUNTER_OPENING]} if pair else {}),
        FORCE: model.inputs[FORCE],
        SUPPLY: model.parameters[SUPPLY],
    }
    of_state = dict(zip((state.name for state in model.states), model.rates, strict=True))
    guards = [switch.guard for switch in model.switches]
    expressions = [*(of_state[state.name] for state in states), *model.outputs, *guards]
    invariants = Invariants(parameters.values())
    varying = invariants.without([se.sympify(each).subs(now) for each in expressions])
    prepare = ordered(invariants.values)
    constants = [se.Symbol(f"k_{number}") for number in range(len(prepare))]
    renamed = {invariants.values[each]: own for each, own in zip(prepare, constants, strict=True)}
    varying = [expression.subs(renamed) for expression in varying]
    size, first_guard = len(states), len(varying) - len(guards)
    rates = varying[:size]
    return DriveEquations(
        states=states,
        state_symbols=symbols,
        parameters=parameters,
        constants=constants,
        inputs=inputs,
        switch_symbols=[switch.symbol for switch in model.switches],
        prepare=prepare,
        rates=rates,
        output_names=model.output_names,
        outputs=varying[size:first_guard],
        guards=varying[first_guard:],
        jacobian=_derivatives(rates, list(symbols.values())),
        input_jacobian=_derivatives(rates, list(inputs.values())),
        switches=model.switches,
    )


def _derivatives(rates: list[Any], by: list[Any]) -> list[Entry]:
    """Derivatives of rates by the symbols that they contain."""
    return [
        (row, column, rate.diff(symbol))
        for row, rate in enumerate(rates)
        for column, symbol in enumerate(by)
        if symbol in rate.free_symbols
    ]
