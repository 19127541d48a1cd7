r"""The static model at the comparable rows, with memory along the records, and exact derivatives.

With a series compliance c the muscle is in equilibrium where :math:`L(x) + c\,T(x)` is the measured length.
By the implicit function theorem,

.. math:: \frac{dF}{d\theta} = F_\theta - F_x\,\frac{c\,T_\theta + T c_\theta}{L_x + c\,T_x}
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from copy import copy

import numpy as np

from mckibben.identification.predict.comparable_rows import ComparableRows
from mckibben.identification.predict.fit_model import LOAD, FitModel
from mckibben.identification.predict.memory import (
    HISTORIES,
    Before,
    Memory,
    creeps,
    remembers,
    remembers_before,
)
from mckibben.identification.predict.path import Path, path_of
from mckibben.physics.effect import Effect
from mckibben.physics.model import Model
from mckibben.physics.muscle import GEOMETRY
from mckibben.simulation.statics.compiled import INPUTS, CompiledState, compiled_state
from mckibben.simulation.statics.model import settle

State = Mapping[str, np.ndarray]

# Up to this many rows a model is compiled once with derivatives by all its parameters. Compiling each choice
# of parameters (10 ms) would take longer than to evaluate the unneeded derivatives.
_FEW_ROWS = 600
_HELD = ("isometric", "isotonic")  # kinds that hold the length or the load
_KEPT = 512  # models whose history is known


class Evaluation:
    """Evaluates models at the same comparable rows.

    Args:
        task: the rows.
    """

    def __init__(self, task: ComparableRows) -> None:
        self.task = task
        self._memory = Memory(task)
        self._known_history: str | None = None
        self._histories: dict[Hashable, str] = {}
        self._without_derivatives = False
        # Of each direction of motion the lengths at which the last model carried the load, to begin at.
        self.balanced: dict[float, np.ndarray] = {}
        self._paths: list[Path] = []  # the one of `path` once it is known, for copies of this as well

    @property
    def path(self) -> Path:
        """Rows between which the length of a muscle with memory is followed."""
        if not self._paths:
            self._paths.append(path_of(self.task, self._memory.starts))
        return self._paths[0]

    def after(self, history: str) -> Evaluation:
        """The same with one of `HISTORIES` for every model."""
        pinned = copy(self)
        pinned._known_history = history
        return pinned

    @property
    def pinned(self) -> bool:
        """Whether the history is that of `after` for every model."""
        return self._known_history is not None

    def without_derivatives(self) -> Evaluation:
        """The same for structures that are evaluated only: of all candidates, they would be a hundred."""
        quick = copy(self)
        quick._without_derivatives = True
        return quick

    def history(self, fit_model: FitModel) -> str:
        """What went before the records, of `HISTORIES`: that with which the forces fit best.

        Files do not say it. Rest, unless effects remember it and another one is closer to the forces.
        """
        if self._known_history is not None:
            return self._known_history
        if len(self.histories(fit_model.effects)) < 2:
            return "rest"
        named = tuple((name, *values.values()) for name, values in fit_model.values.items())
        key = (fit_model.muscle, fit_model.ids, named)
        if key not in self._histories:
            if len(self._histories) >= _KEPT:
                self._histories.pop(next(iter(self._histories)))
            self._histories[key] = self._best_history(fit_model)
        return self._histories[key]

    def histories(self, effects: Sequence[Effect]) -> tuple[str, ...]:
        """Those of `HISTORIES` that change what these effects show in these rows, rest first.

        A motion before the record only where the force is read; a pressure or a load that was put on just
        before it in tests that hold the length or the load.
        """
        task = self.task
        names = ["rest"]
        if task.channel == "force" and any(map(remembers_before, effects)):
            names += [name for name, before in HISTORIES.items() if before.slid]
        begins_held = task.kind in _HELD and task.channel != "diameter" and self._memory.begins_held
        if begins_held and any(map(creeps, effects)):
            names += ["applied", *(["applied anew"] if self._memory.has_levels else [])]
        return tuple(names)

    def _best_history(self, fit_model: FitModel) -> str:
        task = self.task
        names = self.histories(fit_model.effects)
        scored = ~task.turning if np.any(~task.turning) else slice(None)
        misfit = {}
        self._memory.together([(fit_model, HISTORIES[name]) for name in names])
        with np.errstate(all="ignore"):
            for name in names:
                before = HISTORIES[name]
                out = self._at(fit_model, (), self._state(fit_model, before), before)[0]
                if task.channel == "force":
                    error = out["force"] - task.measured
                else:  # how far the length is from carrying the load, to the first order
                    error = (out["force"] - self._load(fit_model)) / out["force_by_length"]
                misfit[name] = float(np.sum(error[scored] ** 2))
        finite = {name: value for name, value in misfit.items() if np.isfinite(value)}
        return min(finite, key=lambda name: finite[name], default="rest")

    def _load(self, fit_model: FitModel) -> np.ndarray:
        return self.task.state["load"] + fit_model.load

    def state(self, fit_model: FitModel) -> dict[str, np.ndarray]:
        """Inputs of the model: the measured ones, and the states of effects with memory."""
        return self._state(fit_model, HISTORIES[self.history(fit_model)])

    def _state(self, fit_model: FitModel, before: Before) -> dict[str, np.ndarray]:
        state = {name: self.task.state[name] for name in INPUTS if name in self.task.state}
        moved = self.moved(fit_model)
        if "length" in state and np.any(moved):
            state["length"] = state["length"] + moved
        return state | self._memory.states(fit_model, before)

    def begins(self, fit_model: FitModel, history: str) -> dict[int, dict[str, float]]:
        """Row -> states that are not at rest there, where a record or a level begins, after a history."""
        return self._memory.begins(fit_model, HISTORIES[history])

    def moved(self, fit_model: FitModel) -> np.ndarray | float:
        """How much longer each length is with the nominal length of a model than with that of the rows [m].

        A fit may change the nominal length; displacements and contractions then mean other lengths.
        Velocities and the history of effects with memory stay those of the rows.
        """
        return self.task.by_rest_length * (fit_model.muscle.nominal_length - self.task.rest_length)

    def at(
        self, fit_model: FitModel, names: Sequence[str] = (), state: State | None = None
    ) -> tuple[dict[str, np.ndarray], np.ndarray]:
        """Outputs at the measured length, and derivatives of the force by the named parameters.

        The derivatives have shape (rows, names). The load does not enter the model; its column is 0.
        """
        # A custom term may be undefined at some rows; callers check the result.
        with np.errstate(all="ignore"):
            before = HISTORIES[self.history(fit_model)]
            return self._at(fit_model, names, state, before)

    def by_length(
        self, fit_model: FitModel, state: State
    ) -> Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]:
        """Force and its slope over the length, of lengths [m] at some rows, for a search of lengths."""
        compiled, _ = self._compiled(fit_model, ())
        constants = compiled.pack(fit_model.muscle, fit_model.values)

        def at(length: np.ndarray, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            there = {name: values[rows] for name, values in state.items()}
            with np.errstate(all="ignore"):
                out, _ = settle(compiled, constants, {**there, "length": length})
            return out["force"], out["force_by_length"]

        return at

    def _compiled(self, fit_model: FitModel, names: Sequence[str]) -> tuple[CompiledState, tuple[str, ...]]:
        """The structure with derivatives, and by what: at least by the names."""
        effects = sorted_effects(fit_model.effects)
        memory = any(map(remembers, effects))
        few = len(self.task.measured) <= _FEW_ROWS and not self._without_derivatives
        gradient_by = _derivatives(effects, names, memory) if few else tuple(names)
        return compiled_state(effects, gradient_by, memory=memory, quick=True), gradient_by

    def _at(
        self, fit_model: FitModel, names: Sequence[str], state: State | None, before: Before
    ) -> tuple[dict[str, np.ndarray], np.ndarray]:
        moved = self._memory.by_parameters(fit_model, names, before)
        inner = [name for name in names if name != LOAD]
        inner += sorted({state for rates in moved.values() for state in rates})
        compiled, gradient_by = self._compiled(fit_model, inner)
        constants = compiled.pack(fit_model.muscle, fit_model.values)
        out, raw = settle(compiled, constants, state or self._state(fit_model, before))
        picked = [gradient_by.index(name) for name in inner]
        force, tension, _, compliance = np.moveaxis(raw.reshape(-1, 4, raw.shape[1])[picked], 1, 0)
        pulling = out["tension"] > 0.0
        c = np.where(pulling, out["compliance"], 0.0)
        slope = out["length_by_length"] + c * out["tension_by_length"]
        # settle() gives dF/dL by the measured length; the slope by the length of the muscle is needed here.
        by_length = out["force_by_length"] * slope / out["length_by_length"]
        stretch = c * tension + np.where(pulling, out["tension"], 0.0) * compliance
        total = force - by_length * stretch / slope
        gradient = np.zeros((len(out["force"]), len(names)))
        for column, name in enumerate(names):
            if name != LOAD:
                gradient[:, column] = total[inner.index(name)]
            if name == "nominal_length" and state is None:
                gradient[:, column] += out["force_by_length"] * self.task.by_rest_length
            for state_name, rate in moved.get(name, {}).items():
                gradient[:, column] += total[inner.index(state_name)] * rate
        return out, gradient


def _derivatives(effects: Sequence[Effect], names: Sequence[str], memory: bool) -> tuple[str, ...]:
    """All names by which a fit of these effects may need derivatives."""
    geometry = [name for name in GEOMETRY if name in names]
    parameters = [f"{effect.id}.{parameter.name}" for effect in effects for parameter in effect.parameters]
    remembering = filter(remembers, effects) if memory else ()
    states = [f"{effect.id}.{state.name}" for effect in remembering for state in effect.states]
    return (*geometry, *parameters, *states)


def sorted_effects(effects: Sequence[Effect]) -> tuple[Effect, ...]:
    """The effects in a fixed order, so that their machine code is found in the cache."""
    return Model(effects).effects
