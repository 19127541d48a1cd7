"""The equations of a drive with exact derivatives by states and inputs, as machine code.

They are those of the engine, `mckibben.physics.drive.DriveModel`. Its switches say whether dry friction holds
the load or in which direction it slides; both directions by half are a load without dry friction.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
import symengine as se

from mckibben.physics.custom import blamed_on_the_term
from mckibben.physics.drive import DriveModel
from mckibben.physics.drive_terms import COUNTER, DriveStructure
from mckibben.simulation.integrate.machine_code import Function, machine_code

Array = np.ndarray

# States that nothing depends on: time, and the air counted since the start.
_COUNTED = ("clock", "supplied", "vented")


class Port(NamedTuple):
    """An input or output of a linear model: name, SI unit, and what it is."""

    name: str
    unit: str
    text: str


COMMAND = Port("command", "1", "opening of the valve, or set point of the regulator as a share of its range")
COUNTER_COMMAND = Port("counter_command", "1", "the same of the second muscle of a pair")
SUPPLY = Port("supply_pressure", "Pa", "gauge pressure of the supply")
LOAD_FORCE = Port("load_force", "N", "external force on the load, against the contraction")
POSITION = Port("position", "m", "position of the load, positive = muscle shorter")
VELOCITY = Port("velocity", "m/s", "velocity of the load, positive towards shorter")
PRESSURE = Port("pressure", "Pa", "gauge pressure in the muscle")
FORCE = Port("force", "N", "tension of the muscle")
MASS_FLOW = Port("mass_flow", "kg/s", "mass flow into the muscle")
READING = Port("position_reading", "m", "position of the load as the sensor shows it to a controller")
_COUNTER_PORTS = tuple(
    Port(f"counter_{port.name}", port.unit, f"{port.text}, of the second muscle of a pair")
    for port in (PRESSURE, FORCE, MASS_FLOW)
)


@dataclass(frozen=True)
class Values:
    """Rates and outputs at a point, and their exact derivatives.

    Attributes:
        rates: of all states, shape (states,).
        outputs: all outputs of the drive's model, by name.
        a: derivatives of the rates by the states, (states, states).
        b: of the rates by the inputs, (states, inputs).
        c, d: of the ports' outputs by states and inputs, (ports, states) and (ports, inputs).
        ports: values of the ports' outputs, (ports,).
    """

    rates: Array
    outputs: dict[str, float]
    a: Array
    b: Array
    c: Array
    d: Array
    ports: Array


@dataclass(frozen=True)
class LinearEquations:
    """The compiled equations of a structure.

    Attributes:
        model: names of states, parameters, inputs and switches.
        inputs, outputs: ports of the linear models.
    """

    model: DriveModel
    inputs: tuple[Port, ...]
    outputs: tuple[Port, ...]
    _function: Function
    _entries: tuple[Array, Array, Array, Array]

    @property
    def names(self) -> list[str]:
        """Names of all states."""
        return [state.name for state in self.model.states]

    @property
    def counted(self) -> list[int]:
        """States that nothing depends on."""
        return [i for i, name in enumerate(self.names) if name.removesuffix(COUNTER) in _COUNTED]

    def at(self, *, state: Array, parameters: Array, inputs: Array, switches: Array) -> Values:
        """Rates, outputs and derivatives at a point; arguments in the order of ``model``."""
        row = np.concatenate([state, parameters, inputs, switches])
        values = self._function(row)
        size, names = len(state), self.model.output_names
        ports = len(self.outputs)
        start = size + len(names)
        numbers = dict(zip(names, values[size:start].tolist(), strict=True))
        shown = values[start : start + ports]
        start += ports
        shapes = ((size, size), (size, len(self.inputs)), (ports, size), (ports, len(self.inputs)))
        matrices = []
        for places, shape in zip(self._entries, shapes, strict=True):
            matrix = np.zeros(shape)
            matrix[places[:, 0], places[:, 1]] = values[start : start + len(places)]
            start += len(places)
            matrices.append(matrix)
        a, b, c, d = matrices
        return Values(values[:size], numbers, a, b, c, d, shown)


@lru_cache(maxsize=64)
def linear_equations(structure: DriveStructure) -> LinearEquations:
    """The equations of a structure, compiled once (0.1 s) and kept.

    Raises:
        InputError: a typed term among the effects cannot be compiled.
    """
    with blamed_on_the_term(structure.effects):
        return _compiled(structure)


def _compiled(structure: DriveStructure) -> LinearEquations:
    model = DriveModel(structure)
    y, p, u = model.symbols, model.parameters, model.inputs
    inputs = {COMMAND: u["opening"], SUPPLY: p["supply_pressure"], LOAD_FORCE: u["external_force"]}
    if structure.pair:
        inputs[COUNTER_COMMAND] = u["counter_opening"]
    named = dict(zip(model.output_names, model.outputs, strict=True))
    lever = p["lever_ratio"]
    outputs = {
        POSITION: y["stroke"] / lever,
        VELOCITY: y["speed"] / lever,
        PRESSURE: y["pressure"] - p["ambient_pressure"],
        FORCE: named["force"],
        MASS_FLOW: named["mass_flow"],
        READING: named["stroke_reading"] / lever,
    }
    if structure.pair:
        gauge = y[f"pressure{COUNTER}"] - p["ambient_pressure"]
        others = (gauge, named[f"force{COUNTER}"], named[f"mass_flow{COUNTER}"])
        outputs |= dict(zip(_COUNTER_PORTS, others, strict=True))
    states, ports = list(y.values()), [se.sympify(output) for output in outputs.values()]
    entries, derivatives = [], []
    for rows in (model.rates, ports):
        for symbols in (states, list(inputs.values())):
            places, values = _derivatives(rows, symbols)
            entries.append(places)
            derivatives += values
    arguments = [*states, *p.values(), *u.values(), *(switch.symbol for switch in model.switches)]
    results = [*model.rates, *model.outputs, *ports, *derivatives]
    function = machine_code({"linear": (arguments, results)})["linear"]
    a, b, c, d = entries
    return LinearEquations(model, tuple(inputs), tuple(outputs), function, (a, b, c, d))


def _derivatives(rows: list[se.Basic], symbols: list[se.Symbol]) -> tuple[Array, list[se.Basic]]:
    """The derivatives that are not zero, and their (row, column)."""
    places = [(i, j) for i, row in enumerate(rows) for j, s in enumerate(symbols) if s in row.free_symbols]
    return np.array(places, dtype=int).reshape(-1, 2), [rows[i].diff(symbols[j]) for i, j in places]
