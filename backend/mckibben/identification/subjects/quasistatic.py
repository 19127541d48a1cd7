"""Measurements of force, length or diameter: the model is evaluated row by row, memory follows the record."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mckibben.identification.fit import Free
from mckibben.identification.setting import LOAD, Setting
from mckibben.identification.subjects.evaluate import Evaluation, sorted_effects
from mckibben.identification.subjects.folds import folds_of, ranges_of, sweeps_of
from mckibben.identification.subjects.lengths import predicted_lengths
from mckibben.identification.subjects.memory import remembers
from mckibben.identification.subjects.subject import Channel, Subject
from mckibben.identification.subjects.task import Task
from mckibben.physics.effect import Effect
from mckibben.simulation.driven import driven_force
from mckibben.simulation.static import StaticModel, clip_slack

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
        # Rows where the motion turns belong to the way, but are not held against the model.
        self._counted = ~task.turning if np.any(~task.turning) else np.ones(len(task.turning), bool)
        counted = task.chosen(self._counted)
        self.measured = counted.measured
        self.scale = np.ones(len(self.measured))
        full_scale = float(np.max(np.abs(self.measured)))
        self.channels = (Channel(task.channel, task.unit, slice(None), 1.0, full_scale),)
        self.records, self.groups = counted.records, counted.groups
        self.rows_used, self.excluded, self.messages = len(self.measured), task.excluded, task.messages
        within = "pressure" if task.kind in ("isometric", "isotonic") else "length"
        other = ranges_of(counted.state.get(within, counted.state["pressure"]))
        ways = [folds_of(self.groups), other]
        self.folds = tuple(ways if np.ptp(other) else ways[:1])
        self.sweeps = sweeps_of(
            self.groups,
            self.records,
            counted.state.get("length"),
            counted.state["pressure"],
            timed=task.time is not None,
        )
        time = {} if counted.time is None else {"time": counted.time}
        self.inputs = {
            name: values
            for name, values in {**counted.state, **time}.items()
            if name != "temperature" or np.ptp(values) > 0.0
        }
        if task.unknown_load:
            self.unknown_load = Free(LOAD, 0.05 * largest_load, 0.0, largest_load, "N")
        self._evaluation = Evaluation(task)
        self._wide: tuple[Effect, ...] = ()

    def reveals(self, effect: Effect) -> bool:
        """By the kinds that the effect names; memory needs an order in time, temperature a change."""
        if self.kind not in effect.kinds:
            return False
        late = _late(effect)
        if (remembers(effect) or late) and self.task.time is None:
            return False
        if late and self.task.channel != "force":
            return False
        return "compliance" not in effect.slots or self.task.channel == "force"

    def prepare(self, setting: Setting, candidates: Sequence[Effect], geometry: Sequence[Free]) -> None:
        """One structure that holds every model of a search: absent effects are off in it."""
        inside = {effect.id for effect in setting.effects}
        further = [e for e in candidates if e.id not in inside and not _late(e)]
        self._wide = sorted_effects((*setting.effects, *further))

    def trial(self, setting: Setting) -> np.ndarray:
        """As `predict`, in the structure of all candidates where that holds the model."""
        if not set(setting.effects) <= set(self._wide):
            return self.predict(setting, clipped=False)
        values = {effect.id: setting.values.get(effect.id, effect.off) for effect in self._wide}
        return self.predict(replace(setting, effects=self._wide, values=values), clipped=False)

    def predict(self, setting: Setting, *, clipped: bool = True) -> np.ndarray:
        """Force, length or diameter of each row; a load that passes the braid lock is predicted there."""
        model = StaticModel.of(setting.muscle, sorted_effects(setting.effects), setting.values)
        if self.task.channel == "force":
            if any(map(_late, setting.effects)):
                return self._delayed(model)[self._counted]
            out = self._evaluation.at(setting)[0]
            return (clip_slack(out) if clipped else out["force"])[self._counted]
        if self.task.channel == "length":
            return predicted_lengths(self._evaluation, setting)[0][self._counted]
        return self._diameter(setting)[self._counted]

    def linearised(self, setting: Setting, free: Sequence[Free]) -> tuple[np.ndarray, np.ndarray]:
        """Predicted values and exact derivatives of force and length; differences for what has none."""
        names = tuple(parameter.name for parameter in free)
        if self.task.channel == "diameter":
            return super().linearised(setting, free)
        if any(map(_late, setting.effects)):
            return self._delayed_linearised(setting, free)
        if self.task.channel == "force":
            out, gradient = self._evaluation.at(setting, names)
            return out["force"][self._counted], gradient[self._counted]
        length, gradient = predicted_lengths(self._evaluation, setting, names)
        return length[self._counted], gradient[self._counted]

    def _delayed_linearised(self, setting: Setting, free: Sequence[Free]) -> tuple[np.ndarray, np.ndarray]:
        """Differences by the numbers of the delays; the others act as if nothing were late."""
        predicted = self.predict(setting, clipped=False)
        ids = {effect.id for effect in setting.effects if _late(effect)}
        at_once = replace(setting, effects=tuple(e for e in setting.effects if e.id not in ids))
        inner = [p for p in free if p.name.partition(".")[0] not in ids]
        gradient = np.empty((len(predicted), len(free)))
        exact = self._evaluation.at(at_once, tuple(p.name for p in inner))[1][self._counted]
        for column, parameter in enumerate(free):
            own = parameter in inner
            gradient[:, column] = (
                exact[:, inner.index(parameter)] if own else self.differences(setting, [parameter])[:, 0]
            )
        return predicted, gradient

    def _diameter(self, setting: Setting) -> np.ndarray:
        if "length" in self.task.state:
            return self._evaluation.at(setting)[0]["diameter"]
        length, _ = predicted_lengths(self._evaluation, setting)
        state = {**self._evaluation.state(setting), "length": length}
        return self._evaluation.at(setting, (), state)[0]["diameter"]

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
