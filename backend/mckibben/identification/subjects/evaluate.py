r"""The static model at the rows of a task, with memory along its records, and exact derivatives.

With a series compliance c the muscle settles where :math:`L(x) + c\,T(x)` is the measured length, so by the
implicit function theorem

.. math:: \frac{dF}{d\theta} = F_\theta - F_x\,\frac{c\,T_\theta + T c_\theta}{L_x + c\,T_x}
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from mckibben.identification.setting import LOAD, Setting
from mckibben.identification.subjects.memory import Memory, remembers
from mckibben.identification.subjects.task import Task
from mckibben.physics.effect import Effect
from mckibben.physics.model import Model
from mckibben.simulation.compile import INPUTS, compiled_state
from mckibben.simulation.static import settle

State = Mapping[str, np.ndarray]


class Evaluation:
    """Evaluates settings at the rows of one task."""

    def __init__(self, task: Task) -> None:
        self.task = task
        self._memory = Memory(task)

    def state(self, setting: Setting) -> dict[str, np.ndarray]:
        """What the model is evaluated at: measured inputs, and where the memory of the effects has got to."""
        state = {name: self.task.state[name] for name in INPUTS if name in self.task.state}
        return state | self._memory.states(setting)

    def at(
        self, setting: Setting, names: Sequence[str] = (), state: State | None = None
    ) -> tuple[dict[str, np.ndarray], np.ndarray]:
        """Outputs at the measured length, and derivatives of the force by the named numbers.

        The second has shape (rows, names); the load is none of the model's own, its column is 0.
        """
        # A typed term may have no slope, or no value, somewhere: that is looked for in what comes out.
        with np.errstate(all="ignore"):
            return self._at(setting, names, state)

    def _at(
        self, setting: Setting, names: Sequence[str], state: State | None
    ) -> tuple[dict[str, np.ndarray], np.ndarray]:
        moved = self._memory.by_parameters(setting, names)
        states = sorted({state for own in moved.values() for state in own})
        inner = tuple(name for name in names if name != LOAD)
        compiled = compiled_state(
            sorted_effects(setting.effects),
            (*inner, *states),
            memory=any(map(remembers, setting.effects)),
            quick=True,
        )
        constants = compiled.pack(setting.muscle, setting.values)
        out, raw = settle(compiled, constants, state or self.state(setting))
        force, tension, _, compliance = (raw[index::4] for index in range(4))
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
                gradient[:, column] += total[len(inner) + states.index(own)] * rate
        return out, gradient


def sorted_effects(effects: Sequence[Effect]) -> tuple[Effect, ...]:
    """One order for one choice of effects, so that its machine code is found again."""
    return Model(effects).effects
