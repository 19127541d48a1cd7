"""A drive's equations as machine code: rates, exact Jacobian and elimination plan."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from mckibben.physics.custom import blamed_on_the_term
from mckibben.physics.drive import DriveModel
from mckibben.physics.drive_terms import DriveStructure
from mckibben.physics.driven import DrivenModel
from mckibben.physics.effect import Effect
from mckibben.simulation.integrate.elimination import Plan, plan_of
from mckibben.simulation.integrate.invariants import Invariants
from mckibben.simulation.integrate.machine_code import Function, machine_code

# The state that is time.
_CLOCK = "clock"


@dataclass(frozen=True)
class Codes:
    """The functions of a system; their arguments are the states, the run's constants and a segment's inputs.

    Attributes:
        constants: parameters -> constants of a run: all subexpressions that do not vary.
        rates: -> rates and outputs.
        jacobian: -> rates, the entries of ``entries`` and the derivatives by time of the rates ``timed``.
        entries: (row, column) of the nonzero entries of the Jacobian; shape (entries, 2).
        timed: rates that depend on time.
        plan: elimination for ``entries``.
        clock: number of the state that is time.
    """

    constants: Function
    rates: Function
    jacobian: Function
    entries: np.ndarray
    timed: np.ndarray
    plan: Plan
    clock: int

    @cached_property
    def given(self) -> tuple[Any, ...]:
        """The first arguments of the kernel."""
        addresses = (self.rates.address, self.jacobian.address)
        plan = self.plan
        lists = (plan.places, self.timed, plan.diagonal, plan.pivots, plan.lower, plan.updates, plan.rows)
        # Unsigned: numba then does not look for negative positions.
        positions = tuple(np.ascontiguousarray(part, np.uint64) for part in (*lists, plan.terms))
        return addresses, positions, plan.size, self.clock


@dataclass(frozen=True)
class CompiledDrive:
    """A system of equations as machine code.

    Attributes:
        model: names of states, parameters, inputs.
        codes: the functions for the integrators.
        scales: magnitude of each state, for error control.
    """

    model: DriveModel | DrivenModel
    codes: Codes
    scales: np.ndarray

    @property
    def width(self) -> int:
        """Number of outputs."""
        return len(self.model.output_names)

    @property
    def size(self) -> int:
        """Number of states."""
        return len(self.model.states)

    def rates(self, packed: np.ndarray) -> np.ndarray:
        """Rates and outputs of packed states, parameters and inputs."""
        return self.codes.rates(self._prepared(packed))

    def jacobian(self, packed: np.ndarray) -> np.ndarray:
        """Rates, then the whole Jacobian by rows, of packed states, parameters and inputs."""
        entries = self.codes.jacobian(self._prepared(packed))
        return np.concatenate([entries[: self.size], self.dense(entries).ravel()])

    def dense(self, values: np.ndarray) -> np.ndarray:
        """The Jacobian as a matrix, from a result of ``codes.jacobian``."""
        matrix = np.zeros((self.size, self.size))
        entries, timed = self.codes.entries, self.codes.timed
        matrix[entries[:, 0], entries[:, 1]] = values[self.size : self.size + len(entries)]
        matrix[timed, self.codes.clock] = values[self.size + len(entries) :]
        return matrix

    def _prepared(self, packed: np.ndarray) -> np.ndarray:
        row = np.asarray(packed, dtype=np.float64)
        stop = self.size + len(self.model.parameters)
        return np.concatenate([row[: self.size], self.codes.constants(row[self.size : stop]), row[stop:]])


@lru_cache(maxsize=128)
def compiled_drive(structure: DriveStructure, level: int = 0) -> CompiledDrive:
    """A drive's compiled equations, built once (20 to 40 ms) and kept.

    Args:
        structure: features of the drive that determine its equations.
        level: see `mckibben.simulation.integrate.machine_code`; 1 pays off from a few hundred runs on.

    Raises:
        InputError: a typed term among the effects cannot be compiled.
    """
    with blamed_on_the_term(structure.effects):
        return compile_system(DriveModel(structure), level)


@lru_cache(maxsize=128)
def compiled_driven(effects: tuple[Effect, ...], motion: bool, level: int = 0) -> CompiledDrive:
    """The compiled equations of a muscle whose pressure is measured, built once and kept.

    Raises:
        InputError: a typed term among the effects cannot be compiled.
    """
    with blamed_on_the_term(effects):
        return compile_system(DrivenModel(effects, motion=motion), level)


def compile_system(model: DriveModel | DrivenModel, level: int = 0) -> CompiledDrive:
    """Machine code of a system and of its exact Jacobian."""
    states = list(model.symbols.values())
    clock = [state.name for state in model.states].index(_CLOCK)
    invariants = Invariants(model.parameters.values())
    results = invariants.without([*model.rates, *model.outputs])
    rates = results[: len(states)]
    # Skip derivatives by symbols that a rate does not contain: they would not always simplify to 0.
    free_symbols_of = [rate.free_symbols for rate in rates]
    positions = [(row, column) for row in range(len(rates)) for column in range(len(states))]
    entries = [(i, j) for i, j in positions if j != clock and states[j] in free_symbols_of[i]]
    timed = [row for row in range(len(rates)) if states[clock] in free_symbols_of[row]]
    derivatives = [rates[i].diff(states[j]) for i, j in entries]
    derivatives += [rates[i].diff(states[clock]) for i in timed]
    parameters = list(model.parameters.values())
    arguments = [*states, *invariants.values.values(), *model.inputs.values()]
    codes = machine_code(
        {
            "constants": (parameters, list(invariants.values)),
            "rates": (arguments, results),
            "jacobian": (arguments, [*rates, *derivatives]),
        },
        level=level,
    )
    return CompiledDrive(
        model,
        Codes(
            codes["constants"],
            codes["rates"],
            codes["jacobian"],
            np.array(entries, np.int64).reshape(-1, 2),
            np.array(timed, np.int64),
            plan_of(len(states), entries, without=clock),
            clock,
        ),
        np.array([state.scale for state in model.states]),
    )
