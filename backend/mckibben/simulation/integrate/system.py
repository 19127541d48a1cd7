"""A drive's equations as machine code: rates, exact Jacobian and elimination plan."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from mckibben.physics.custom import blamed_on_the_term
from mckibben.physics.drive import DriveModel
from mckibben.physics.drive_terms import DriveStructure
from mckibben.physics.effect import Effect
from mckibben.physics.record_model import RecordModel
from mckibben.simulation.integrate.compiling import COMPILING, one_at_a_time
from mckibben.simulation.integrate.elimination import Plan, plan_of
from mckibben.simulation.integrate.invariants import Invariants
from mckibben.simulation.integrate.lane_code import Functions, LaneCodes
from mckibben.simulation.integrate.machine_code import Function, machine_code

# The state that is time.
_CLOCK = "clock"
# The output that a sampled controller measures.
_READING = "stroke_reading"


@dataclass(frozen=True)
class Codes:
    """The functions of a system; their arguments are states, constants of the run, inputs and switches.

    Attributes:
        constants: parameters -> constants of a run: all subexpressions that do not vary.
        rates: -> rates.
        outputs: -> outputs.
        guards: -> guards of the switches.
        entries: (row, column) of the nonzero entries of the Jacobian; shape (entries, 2).
        timed: rates that depend on time.
        plan: elimination for ``entries``.
        clock: number of the state that is time.
        effects: those acting, for messages about a typed term among them.
    """

    constants: Function
    rates: Function
    outputs: Function
    guards: Function
    entries: np.ndarray
    timed: np.ndarray
    plan: Plan
    clock: int
    effects: tuple[Effect, ...] = field(repr=False)
    _wanted: Mapping[str, tuple[Sequence[Any], Sequence[Any]]] = field(repr=False)
    _level: int

    @cached_property
    def jacobian(self) -> Function:
        """-> rates, entries of ``entries``, derivatives by time of the rates ``timed``, and guards.

        Compiled when first used: it is half of the work, and runs in lanes have one of their own.

        Raises:
            InputError: a typed term among the effects cannot be compiled.
        """
        return self._compiled("jacobian")

    @cached_property
    def reading(self) -> Function:
        """-> what the position sensor reads, alone: a sampled controller asks for it in every sample.

        Compiled when first used.
        """
        return self._compiled("reading")

    def _compiled(self, name: str) -> Function:
        with COMPILING, blamed_on_the_term(self.effects):
            return machine_code({name: self._wanted[name]}, level=self._level)[name]


@dataclass(frozen=True)
class CompiledDrive:
    """A system of equations as machine code.

    Attributes:
        model: names of states, parameters, inputs.
        codes: the functions for the integrators.
        scales: magnitude of each state, for error control.
        functions: those of ``codes`` as symbols and expressions.
        quick: whether its code for lanes is compiled quickly, for few runs.
    """

    model: DriveModel | RecordModel
    codes: Codes
    scales: np.ndarray
    functions: Functions
    quick: bool = False

    @cached_property
    def lanes(self) -> LaneCodes:
        """The functions on rows of lanes; compiled when first used."""
        return LaneCodes(self.functions, self.codes.plan, self.codes.effects, quick=self.quick)

    @cached_property
    def columns(self) -> dict[tuple[str, ...] | None, Any]:
        """What `mckibben.simulation.integrate.lane_buffers.columns_of` has found."""
        return {}

    @property
    def width(self) -> int:
        """Number of outputs."""
        return len(self.model.output_names)

    @property
    def size(self) -> int:
        """Number of states."""
        return len(self.model.states)

    @cached_property
    def parameter_places(self) -> dict[str, int]:
        """Position of each parameter."""
        return {name: place for place, name in enumerate(self.model.parameters)}

    @cached_property
    def moved(self) -> tuple[int, int]:
        """Numbers of the states stroke and speed, which end stops act on; -1 without stops."""
        if not any(switch.stop for switch in self.model.switches):
            return -1, -1
        names = [state.name for state in self.model.states]
        return names.index("stroke"), names.index("speed")

    @cached_property
    def least(self) -> np.ndarray:
        """Least guard of each switch."""
        return np.array([switch.least for switch in self.model.switches])

    def stops(self, parameters: np.ndarray) -> np.ndarray:
        """Stroke of the end stop of each switch [m], NaN for other switches."""
        return np.array(
            [np.nan if place is None else parameters[place] for place in self.stop_places], dtype=float
        )

    @cached_property
    def follows(self) -> np.ndarray:
        """Number of the length that follows each switch, -1 for none."""
        names = [state.name for state in self.model.states]
        return np.array([names.index(s.follows) if s.follows else -1.0 for s in self.model.switches], float)

    @cached_property
    def slides(self) -> np.ndarray:
        """The direction of sliding that each switch is, 1 or -1; 0 for others."""
        return np.array([switch.slides for switch in self.model.switches], float)

    @cached_property
    def watched(self) -> np.ndarray:
        """Numbers of the states that the guards depend on."""
        arguments, guards = self.functions["guards"]
        used = set().union(*(guard.free_symbols for guard in guards))
        return np.array([i for i, symbol in enumerate(arguments[: self.size]) if symbol in used], float)

    @cached_property
    def stop_places(self) -> tuple[int | None, ...]:
        """Position of the parameter that is the end stop of each switch, None for other switches."""
        places = self.parameter_places
        return tuple(places[s.stop] if s.stop else None for s in self.model.switches)

    def rates(self, packed: np.ndarray, switches: np.ndarray | None = None) -> np.ndarray:
        """Rates of packed states, parameters and inputs; switches are 0 unless stated."""
        return self.codes.rates(self.prepared(packed, switches))

    def outputs(self, packed: np.ndarray, switches: np.ndarray | None = None) -> np.ndarray:
        """Outputs of packed states, parameters and inputs."""
        return self.codes.outputs(self.prepared(packed, switches))

    def guards(self, packed: np.ndarray, switches: np.ndarray | None = None) -> np.ndarray:
        """Guards of the switches."""
        return self.codes.guards(self.prepared(packed, switches))

    def jacobian(self, packed: np.ndarray, switches: np.ndarray | None = None) -> np.ndarray:
        """Rates, then the whole Jacobian by rows, of packed states, parameters and inputs."""
        entries = self.codes.jacobian(self.prepared(packed, switches))
        return np.concatenate([entries[: self.size], self.dense(entries).ravel()])

    def dense(self, values: np.ndarray) -> np.ndarray:
        """The Jacobian as a matrix, from a result of ``codes.jacobian``."""
        matrix = np.zeros((self.size, self.size))
        entries, timed = self.codes.entries, self.codes.timed
        matrix[entries[:, 0], entries[:, 1]] = values[self.size : self.size + len(entries)]
        after = self.size + len(entries)
        matrix[timed, self.codes.clock] = values[after : after + len(timed)]
        return matrix

    def prepared(self, packed: np.ndarray, switches: np.ndarray | None = None) -> np.ndarray:
        """Arguments of the codes from packed states, parameters and inputs."""
        row = np.asarray(packed, dtype=np.float64)
        stop = self.size + len(self.model.parameters)
        state = np.zeros(len(self.model.switches)) if switches is None else switches
        constants = self.codes.constants(row[self.size : stop])
        return np.concatenate([row[: self.size], constants, row[stop:], state])


@one_at_a_time
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
        return compile_system(DriveModel(structure), level, structure.effects)


@one_at_a_time
@lru_cache(maxsize=128)
def quick_drive(structure: DriveStructure) -> CompiledDrive:
    """As `compiled_drive`, for at most a few hundred runs in lanes: their code is compiled quickly.

    Raises:
        InputError: a typed term among the effects cannot be compiled.
    """
    return replace(compiled_drive(structure), quick=True)


@one_at_a_time
@lru_cache(maxsize=128)
def compiled_driven(effects: tuple[Effect, ...], motion: bool, level: int = 0) -> CompiledDrive:
    """The compiled equations of a muscle whose pressure is measured, built once and kept.

    Raises:
        InputError: a typed term among the effects cannot be compiled.
    """
    with blamed_on_the_term(effects):
        return compile_system(RecordModel(effects, motion=motion), level, effects)


def compile_system(
    model: DriveModel | RecordModel, level: int = 0, effects: tuple[Effect, ...] = ()
) -> CompiledDrive:
    """Machine code of a system and of its exact Jacobian; errors name a typed term among ``effects``."""
    states = list(model.symbols.values())
    clock = [state.name for state in model.states].index(_CLOCK)
    invariants = Invariants(model.parameters.values())
    guards = [switch.guard for switch in model.switches]
    results = invariants.without([*model.rates, *model.outputs, *guards])
    rates = results[: len(states)]
    outputs = results[len(states) : len(results) - len(guards)]
    guards = results[len(results) - len(guards) :]
    # Skip derivatives by symbols that a rate does not contain: they would not always simplify to 0.
    free_symbols_of = [rate.free_symbols for rate in rates]
    positions = [(row, column) for row in range(len(rates)) for column in range(len(states))]
    entries = [(i, j) for i, j in positions if j != clock and states[j] in free_symbols_of[i]]
    timed = [row for row in range(len(rates)) if states[clock] in free_symbols_of[row]]
    derivatives = [rates[i].diff(states[j]) for i, j in entries]
    derivatives += [rates[i].diff(states[clock]) for i in timed]
    parameters = list(model.parameters.values())
    switches = [switch.symbol for switch in model.switches]
    arguments = [*states, *invariants.values.values(), *model.inputs.values(), *switches]
    functions: Functions = {
        "constants": (parameters, list(invariants.values)),
        "rates": (arguments, rates),
        "outputs": (arguments, outputs),
        "guards": (arguments, guards),
        "jacobian": (arguments, [*rates, *derivatives, *guards]),
    }
    codes = machine_code({n: each for n, each in functions.items() if n != "jacobian"}, level=level)
    wanted = {"jacobian": functions["jacobian"]}
    if _READING in model.output_names:
        wanted["reading"] = (arguments, [outputs[model.output_names.index(_READING)]])
    return CompiledDrive(
        model,
        Codes(
            codes["constants"],
            codes["rates"],
            codes["outputs"],
            codes["guards"],
            np.array(entries, np.int64).reshape(-1, 2),
            np.array(timed, np.int64),
            plan_of(len(states), entries, without=clock),
            clock,
            effects,
            wanted,
            level,
        ),
        np.array([state.scale for state in model.states]),
        functions,
    )
