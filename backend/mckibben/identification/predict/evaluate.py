r"""The static model at the rows of a task, with memory along its records, and exact derivatives.

With a series compliance c the muscle settles where :math:`L(x) + c\,T(x)` is the measured length, so by the
implicit function theorem

.. math:: \frac{dF}{d\theta} = F_\theta - F_x\,\frac{c\,T_\theta + T c_\theta}{L_x + c\,T_x}
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from mckibben.identification.predict.comparable_rows import ComparableRows
from mckibben.identification.predict.fit_model import LOAD, FitModel
from mckibben.identification.predict.memory import Memory, remembers
from mckibben.physics.effect import Effect
from mckibben.physics.model import Model
from mckibben.physics.muscle import GEOMETRY
from mckibben.simulation.statics.compiled import INPUTS, compiled_state
from mckibben.simulation.statics.model import settle

State = Mapping[str, np.ndarray]

# Up to here a structure is compiled once with the derivatives by all its parameters: another 10 ms for each
# choice of them would take longer than to evaluate what is not asked for.
_FEW_ROWS = 600


class Evaluation:
    """Evaluates settings at the rows of one task."""

    def __init__(self, task: ComparableRows) -> None:
        self.task = task
        self._memory = Memory(task)

    def state(self, fit_model: FitModel) -> dict[str, np.ndarray]:
        """What the model is evaluated at: measured inputs, and where the memory of the effects has got to."""
        state = {name: self.task.state[name] for name in INPUTS if name in self.task.state}
        return state | self._memory.states(fit_model)

    def at(
        self, fit_model: FitModel, names: Sequence[str] = (), state: State | None = None
    ) -> tuple[dict[str, np.ndarray], np.ndarray]:
        """Outputs at the measured length, and derivatives of the force by the named numbers.

        The second has shape (rows, names); the load is none of the model's own, its column is 0.
        """
        # A typed term may have no slope, or no value, somewhere: that is looked for in what comes out.
        with np.errstate(all="ignore"):
            return self._at(fit_model, names, state)

    def _at(
        self, fit_model: FitModel, names: Sequence[str], state: State | None
    ) -> tuple[dict[str, np.ndarray], np.ndarray]:
        moved = self._memory.by_parameters(fit_model, names)
        effects = sorted_effects(fit_model.effects)
        memory = any(map(remembers, effects))
        inner = [name for name in names if name != LOAD]
        inner += sorted({state for own in moved.values() for state in own})
        few = len(self.task.measured) <= _FEW_ROWS
        gradient_by = _derivatives(effects, inner, memory) if few else tuple(inner)
        compiled = compiled_state(effects, gradient_by, memory=memory, quick=True)
        constants = compiled.pack(fit_model.muscle, fit_model.values)
        out, raw = settle(compiled, constants, state or self.state(fit_model))
        picked = [gradient_by.index(name) for name in inner]
        force, tension, _, compliance = np.moveaxis(raw.reshape(-1, 4, raw.shape[1])[picked], 1, 0)
        pulling = out["tension"] > 0.0
        c = np.where(pulling, out["compliance"], 0.0)
        slope = out["length_by_length"] + c * out["tension_by_length"]
        # settle() gives dF/dL as seen at the measured length; here the slope at the muscle itself is needed.
        by_length = out["force_by_length"] * slope / out["length_by_length"]
        stretch = c * tension + np.where(pulling, out["tension"], 0.0) * compliance
        total = force - by_length * stretch / slope
        gradient = np.zeros((len(out["force"]), len(names)))
        for column, name in enumerate(names):
            if name != LOAD:
                gradient[:, column] = total[inner.index(name)]
            for own, rate in moved.get(name, {}).items():
                gradient[:, column] += total[inner.index(own)] * rate
        return out, gradient


def _derivatives(effects: Sequence[Effect], names: Sequence[str], memory: bool) -> tuple[str, ...]:
    """All that fits of these effects may ask derivatives by."""
    geometry = [name for name in GEOMETRY if name in names]
    parameters = [f"{effect.id}.{parameter.name}" for effect in effects for parameter in effect.parameters]
    remembering = filter(remembers, effects) if memory else ()
    states = [f"{effect.id}.{state.name}" for effect in remembering for state in effect.states]
    return (*geometry, *parameters, *states)


def sorted_effects(effects: Sequence[Effect]) -> tuple[Effect, ...]:
    """One order for one choice of effects, so that its machine code is found again."""
    return Model(effects).effects
