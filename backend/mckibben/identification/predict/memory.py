"""States of effects with memory (friction, creep, run-in) along a measured record."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mckibben.identification.predict.comparable_rows import ComparableRows
from mckibben.identification.predict.fit_model import FitModel
from mckibben.physics.effect import Effect
from mckibben.physics.model import ROOM_TEMPERATURE
from mckibben.simulation.drive.driven import driven_states
from mckibben.simulation.statics.model import StaticModel

_KEPT = 128  # trajectories in the cache; the oldest are dropped
_SENSORS = ("pressure_sensor", "length_sensor")
_MOVED = 0.02  # share of the range of a record after which its first motion has a direction
_STEP = 2e-3  # relative difference step of a parameter, for the derivative of a state


#: What may have gone before a record: rest, a motion the other way that its first one turns back, or its
#: first motion itself. The number is the share of the states of a long slow motion, along the first one.
HISTORIES = {"rest": 0.0, "the other way": -1.0, "the same way": 1.0}


def remembers(effect: Effect) -> bool:
    """Whether an effect has memory of the muscle's motion."""
    return bool(effect.states) and "rates" in effect.slots


def remembers_before(effect: Effect) -> bool:
    """Whether an effect knows a state that a long slow motion before the record leaves."""
    return remembers(effect) and any(state.sliding for state in effect.states)


class Memory:
    """Trajectories of the states of effects over the rows, cached for models that share them.

    The states follow the measured length and pressure; each record begins after one of `HISTORIES`, all with
    the same. They depend only on
    the parameters in the rates of their effect and on the sensors. So each effect is integrated by itself,
    and a fit of other parameters does not integrate it again.
    """

    def __init__(self, task: ComparableRows) -> None:
        self._task = task
        self._kept: dict[tuple, dict[str, np.ndarray]] = {}
        self._records = [
            np.flatnonzero(task.records == label)
            for label in np.unique(task.records)
            if np.count_nonzero(task.records == label) >= 2
        ]

    def states(self, fit_model: FitModel, before: float = 0.0) -> dict[str, np.ndarray]:
        """Value of each state ("effect.state") at each row, after one of `HISTORIES`."""
        sensors = tuple(e for e in fit_model.effects if any(slot in e.slots for slot in _SENSORS))
        trajectories: dict[str, np.ndarray] = {}
        for effect in filter(remembers, fit_model.effects):
            effects = (effect, *(sensor for sensor in sensors if sensor is not effect))
            values = {e.id: dict(fit_model.values[e.id]) for e in effects}
            past = before if remembers_before(effect) else 0.0
            key = (fit_model.muscle, past, *(self._key(e, values[e.id]) for e in effects))
            if key not in self._kept:
                if len(self._kept) >= _KEPT:
                    self._kept.pop(next(iter(self._kept)))
                self._kept[key] = self._run(StaticModel.of(fit_model.muscle, effects, values), effect, past)
            trajectories |= self._kept[key]
        return trajectories

    def by_parameters(
        self, fit_model: FitModel, names: Sequence[str], before: float = 0.0
    ) -> dict[str, dict[str, np.ndarray]]:
        """Derivatives of the states by the named parameters that affect them: name -> state -> rows."""
        derivatives: dict[str, dict[str, np.ndarray]] = {}
        for name in names:
            effect_id, _, parameter = name.partition(".")
            effect = next((e for e in fit_model.effects if e.id == effect_id), None)
            if effect is None or not remembers(effect) or parameter not in effect.wanted("rates"):
                continue
            declared = effect.parameter(parameter)
            here = fit_model.number(name)
            step = _STEP * max(abs(here), 0.01 * (declared.upper - declared.lower))
            other = here + step if here + step <= declared.upper else here - step
            first = self.states(fit_model, before)
            last = self.states(fit_model.with_numbers([name], [other]), before)
            derivatives[name] = {
                state: (last[state] - first[state]) / (other - here)
                for state in first
                if state.startswith(f"{effect_id}.")
            }
        return derivatives

    @staticmethod
    def _key(effect: Effect, values: dict[str, float]) -> tuple:
        wanted = effect.wanted("rates") if remembers(effect) else tuple(values)
        return (effect.id, *(values[name] for name in values if name in wanted))

    def _run(self, model: StaticModel, effect: Effect, before: float) -> dict[str, np.ndarray]:
        task = self._task
        rest = {f"{effect.id}.{state.name}": state.initial for state in effect.states}
        trajectories = {name: np.full(len(task.measured), value) for name, value in rest.items()}
        clock = task.time if task.time is not None else np.arange(len(task.measured), dtype=float)
        for rows in self._records:
            along = before * self._first_motion(rows) if before else 0.0
            states = driven_states(
                model,
                time=clock[rows],
                pressure=task.state["pressure"][rows],
                length=task.state["length"][rows],
                temperature=float(np.mean(task.state.get("temperature", ROOM_TEMPERATURE))),
                begin={
                    f"{effect.id}.{state.name}": along * state.sliding
                    for state in effect.states
                    if state.sliding and along
                },
            )
            for name in trajectories:
                trajectories[name][rows] = states[name]
        return trajectories

    def _first_motion(self, rows: np.ndarray) -> float:
        """1 if a record begins with a lengthening, -1 with a shortening, 0 without a motion.

        At a constant length filling counts as shortening.
        """
        for name, sign in (("length", 1.0), ("pressure", -1.0)):
            values = self._task.state[name][rows]
            least = _MOVED * float(np.ptp(self._task.state[name]))
            moved = np.flatnonzero(np.abs(values - values[0]) > least)
            if least > 0.0 and len(moved):
                return sign * float(np.sign(values[moved[0]] - values[0]))
        return 0.0
