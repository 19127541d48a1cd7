r"""Measurements of force, length or diameter: the model is evaluated row by row, memory follows the record.

The force has exact derivatives. With a series compliance c the muscle settles where :math:`L(x) + c\,T(x)` is
the measured length, so by the implicit function theorem

.. math:: \frac{dF}{d\theta} = F_\theta - F_x\,\frac{c\,T_\theta + T c_\theta}{L_x + c\,T_x}

A length under a load W is where :math:`F(L) = W`, so :math:`dL/d\theta = -F_\theta/F_L`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mckibben.identification.fit import Free
from mckibben.identification.setting import LOAD, Setting
from mckibben.identification.subjects.folds import folds_of, ranges_of, sweeps_of
from mckibben.identification.subjects.memory import Memory, remembers
from mckibben.identification.subjects.subject import Channel, Subject
from mckibben.identification.subjects.task import Task
from mckibben.physics.effect import Effect
from mckibben.physics.model import Model
from mckibben.simulation.compile import INPUTS, compiled_state
from mckibben.simulation.driven import driven_force
from mckibben.simulation.static import StaticModel, clip_slack, settle

_NEWTON_STEPS = 40
_LENGTH_TOLERANCE = 1e-9  # m
_LARGEST_STEP = 0.02  # of the nominal length, per Newton step
_SHORTEST = 0.35  # share of the nominal length down to which a length is looked for
_LATE = ("skew", "force_reading", "pressure_reading", "stroke_reading")


class Quasistatic(Subject):
    """A task of any kind but transient.

    Args:
        task: the rows.
        largest_load: up to where an unknown load is looked for [N].
    """

    def __init__(self, task: Task, *, largest_load: float = 0.0) -> None:
        self.task = task
        self.kind = task.kind
        self.measured = task.measured
        self.scale = np.ones(len(task.measured))
        full_scale = float(np.max(np.abs(task.measured)))
        self.channels = (Channel(task.channel, task.unit, slice(None), 1.0, full_scale),)
        self.records, self.groups = task.records, task.groups
        self.rows_used, self.excluded, self.messages = len(task.measured), task.excluded, task.messages
        within = "pressure" if task.kind in ("isometric", "isotonic") else "length"
        other = ranges_of(task.state.get(within, task.state["pressure"]))
        self.folds = (folds_of(task.groups), other) if np.ptp(other) else (folds_of(task.groups),)
        self.sweeps = sweeps_of(
            task.groups,
            task.records,
            task.state.get("length"),
            task.state["pressure"],
            timed=task.time is not None,
        )
        self.inputs = {
            name: values
            for name, values in {**task.state, **({} if task.time is None else {"time": task.time})}.items()
            if name != "temperature" or np.ptp(values) > 0.0
        }
        if task.unknown_load:
            self.unknown_load = Free(LOAD, 0.05 * largest_load, 0.0, largest_load, "N")
        self._memory = Memory(task)
        self._wide: tuple[Effect, ...] = ()
        self._ordered = task.time is not None

    def reveals(self, effect: Effect) -> bool:
        """By the kinds that the effect names; memory needs an order in time, temperature a change."""
        if self.kind not in effect.kinds:
            return False
        late = _late(effect)
        if (remembers(effect) or late) and not self._ordered:
            return False
        if late and self.task.channel != "force":
            return False
        return "compliance" not in effect.slots or self.task.channel == "force"

    def prepare(self, setting: Setting, candidates: Sequence[Effect], geometry: Sequence[Free]) -> None:
        """One structure that holds every model of a search: absent effects are off in it."""
        inside = {effect.id for effect in setting.effects}
        further = [e for e in candidates if e.id not in inside and not _late(e)]
        self._wide = _sorted((*setting.effects, *further))

    def trial(self, setting: Setting) -> np.ndarray:
        """As `predict`, in the structure of all candidates where that holds the model."""
        if not set(setting.effects) <= set(self._wide):
            return self.predict(setting, clipped=False)
        values = {effect.id: setting.values.get(effect.id, effect.off) for effect in self._wide}
        return self.predict(replace(setting, effects=self._wide, values=values), clipped=False)

    def predict(self, setting: Setting, *, clipped: bool = True) -> np.ndarray:
        """Force, length or diameter of each row; a load that passes the braid lock is predicted there."""
        model = StaticModel.of(setting.muscle, _sorted(setting.effects), setting.values)
        if self.task.channel == "force":
            if any(map(_late, setting.effects)):
                return self._delayed(model)
            out = self._settled(setting, ())[0]
            return clip_slack(out) if clipped else out["force"]
        if self.task.channel == "length":
            return self._length(setting, ())[0]
        return self._diameter(setting)

    def linearised(self, setting: Setting, free: Sequence[Free]) -> tuple[np.ndarray, np.ndarray]:
        """Predicted values and exact derivatives of force and length; differences for what has none."""
        names = tuple(parameter.name for parameter in free)
        if self.task.channel == "diameter":
            return super().linearised(setting, free)
        if any(map(_late, setting.effects)):
            return self._delayed_linearised(setting, free)
        if self.task.channel == "force":
            out, gradient, _ = self._settled(setting, names)
            return out["force"], gradient
        return self._length(setting, names)

    def _delayed_linearised(self, setting: Setting, free: Sequence[Free]) -> tuple[np.ndarray, np.ndarray]:
        """Differences by the numbers of the delays; the others act as if they came at once, which is close."""
        predicted = self.predict(setting, clipped=False)
        ids = {effect.id for effect in setting.effects if _late(effect)}
        at_once = replace(setting, effects=tuple(e for e in setting.effects if e.id not in ids))
        inner = [p for p in free if p.name.partition(".")[0] not in ids]
        gradient = np.empty((len(predicted), len(free)))
        exact = self._settled(at_once, tuple(p.name for p in inner))[1]
        for column, parameter in enumerate(free):
            own = parameter in inner
            gradient[:, column] = (
                exact[:, inner.index(parameter)] if own else self.differences(setting, [parameter])[:, 0]
            )
        return predicted, gradient

    def _state(self, setting: Setting) -> dict[str, np.ndarray]:
        state = {name: self.task.state[name] for name in INPUTS if name in self.task.state}
        return state | self._memory.states(setting)

    def _settled(
        self, setting: Setting, names: Sequence[str], state: dict[str, np.ndarray] | None = None
    ) -> tuple[dict[str, np.ndarray], np.ndarray, np.ndarray]:
        """Outputs at the measured length, derivatives of the force by the numbers, and d force/d length."""
        moved = self._memory.by_parameters(setting, names)
        states = sorted({state for own in moved.values() for state in own})
        inner = tuple(name for name in names if name != LOAD)
        compiled = compiled_state(
            _sorted(setting.effects),
            (*inner, *states),
            memory=any(map(remembers, setting.effects)),
            quick=True,
        )
        constants = compiled.pack(setting.muscle, setting.values)
        out, raw = settle(compiled, constants, state or self._state(setting))
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
        return out, gradient, out["force_by_length"]

    def _length(self, setting: Setting, names: Sequence[str]) -> tuple[np.ndarray, np.ndarray]:
        load = self.task.state["load"] + setting.load
        state = self._state(setting)
        rest = setting.muscle.nominal_length
        low, high = _SHORTEST * rest, 0.9999 * float(setting.muscle.braid.thread_length)
        length = np.clip(self.task.measured, low, high)
        for _ in range(_NEWTON_STEPS):
            out, _, slope = self._settled(setting, (), {**state, "length": length})
            with np.errstate(divide="ignore", invalid="ignore"):
                step = np.where(slope > 0.0, (out["force"] - load) / slope, np.sign(out["force"] - load))
            limit = _LARGEST_STEP * rest
            moved = np.clip(length - np.clip(step, -limit, limit), low, high)
            done = np.max(np.abs(moved - length)) < _LENGTH_TOLERANCE
            length = moved
            if done:
                break
        if not names:
            return length, np.empty((len(length), 0))
        _, gradient, slope = self._settled(setting, names, {**state, "length": length})
        gradient = gradient.copy()
        if LOAD in names:
            gradient[:, list(names).index(LOAD)] = -1.0
        inside = (length > low) & (length < high) & (slope > 0.0)
        return length, np.where(inside[:, None], -gradient / np.where(inside, slope, 1.0)[:, None], 0.0)

    def _diameter(self, setting: Setting) -> np.ndarray:
        if "length" in self.task.state:
            return self._settled(setting, ())[0]["diameter"]
        length, _ = Quasistatic._length(self, setting, ())
        return self._settled(setting, (), {**self._state(setting), "length": length})[0]["diameter"]

    def _delayed(self, model: StaticModel) -> np.ndarray:
        """The force of a model with lags or skew of the channels, along each record."""
        task = self.task
        assert task.time is not None  # noqa: S101 - `reveals` asks for it
        found = np.zeros(len(task.measured))
        for label in np.unique(task.records):
            rows = np.flatnonzero(task.records == label)
            if len(rows) >= 2:
                found[rows] = driven_force(
                    model,
                    time=task.time[rows],
                    pressure=task.state["pressure"][rows],
                    length=task.state["length"][rows],
                )
        return found


def _late(effect: Effect) -> bool:
    """Whether an effect delays what is read, so that rows depend on the rows before them."""
    return any(slot in effect.slots for slot in _LATE)


def _sorted(effects: Sequence[Effect]) -> tuple[Effect, ...]:
    # One order for one choice of effects, so that its machine code is found again.
    return Model(effects).effects
