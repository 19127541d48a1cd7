"""States of effects with memory (friction, creep, run-in) along a measured record."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from mckibben.identification.predict.comparable_rows import ComparableRows
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.input_noise import without_input_noise
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError
from mckibben.physics.model import ROOM_TEMPERATURE
from mckibben.simulation.drive.records import states_of_records
from mckibben.simulation.statics.model import StaticModel

_KEPT = 128  # trajectories in the cache; the oldest are dropped
_SENSORS = ("pressure_sensor", "length_sensor")
_MOVED = 0.02  # share of the range of a record after which its first motion has a direction
_STEP = 2e-3  # relative difference step of a parameter, for the derivative of a state


class Before(NamedTuple):
    """What may have gone before a record.

    Attributes:
        slid: share of the states that a long slow motion leaves, along the first motion of the record.
        applied: the pressure and the load of its first row were put on at once, just before it.
        anew: so they were before each new level of what is held constant.
    """

    slid: float = 0.0
    applied: bool = False
    anew: bool = False


#: What may have gone before a record: rest under what its first row shows, a motion the other way that its
#: first one turns back, its first motion itself, or rest without air and load until just before it.
HISTORIES = {
    "rest": Before(),
    "the other way": Before(slid=-1.0),
    "the same way": Before(slid=1.0),
    "applied": Before(applied=True),
    "applied anew": Before(applied=True, anew=True),
}
_NEW_LEVEL = 0.05  # jump of a quantity that is held, share of its range
_HOLD, _STEADY = 5, 0.02  # rows; share of the largest pressure within which it is held
_APPLIED = 0.1  # of the largest pressure; less at the start of a record is nothing that was put on


def remembers(effect: Effect) -> bool:
    """Whether an effect has memory of the muscle's motion."""
    return bool(effect.states) and "rates" in effect.slots


def remembers_before(effect: Effect) -> bool:
    """Whether an effect knows a state that a long slow motion before the record leaves."""
    return remembers(effect) and any(state.sliding for state in effect.states)


def creeps(effect: Effect) -> bool:
    """Whether an effect goes on after a pressure or a load that was put on before the record."""
    return remembers(effect) and any(state.applied for state in effect.states)


def concerning(effect: Effect, before: Before) -> Before:
    """What an effect knows of a history."""
    known = creeps(effect)
    slid = before.slid if remembers_before(effect) else 0.0
    return Before(slid, before.applied and known, before.anew and known)


class _Wanted(NamedTuple):
    """A trajectory of an effect's states: what it depends on, as a key and as values."""

    key: tuple
    fit_model: FitModel
    effects: tuple[Effect, ...]
    before: Before


class Memory:
    """Trajectories of the states of effects over the rows, cached for models that share them.

    The states follow the measured length and pressure; each record begins after one of `HISTORIES`, all with
    the same. They depend only on the parameters in the rates of their effect and on the sensors. So each
    effect is integrated by itself, and a fit of other parameters does not integrate it again. Where lengths
    are predicted they follow those instead, see `mckibben.identification.predict.free_runs`.
    """

    def __init__(self, task: ComparableRows) -> None:
        self._task = task
        self._kept: dict[tuple, dict[str, np.ndarray]] = {}
        self._smooth: dict[tuple[str, int, int], np.ndarray] = {}  # by name, first row and number of rows
        # A model remembers the same with and without a late reading, so corners do not belong to its path.
        path = np.ones(len(task.records), bool) if task.corners is None else ~task.corners
        records = [np.flatnonzero(path & (task.records == label)) for label in np.unique(task.records)]
        self._records = [rows for rows in records if len(rows) >= 2]
        self._levels = [part for rows in self._records for part in np.split(rows, self._new_levels(rows))]

    @property
    def starts(self) -> list[int]:
        """First rows of records and of levels."""
        return sorted({int(rows[0]) for rows in (*self._records, *self._levels)})

    @property
    def begins_held(self) -> bool:
        """Whether a record begins with a hold under pressure, as a log of creep does and no sweep."""
        pressure = self._task.state["pressure"]
        most = float(np.max(pressure))
        least = max(_NEW_LEVEL * float(np.ptp(pressure)), _STEADY * most)
        starts = [pressure[rows[:_HOLD]] for rows in self._records]
        return any(start[0] > _APPLIED * most and np.ptp(start) <= least for start in starts)

    @property
    def has_levels(self) -> bool:
        """Whether holds follow each other within records."""
        return len(self._levels) > len(self._records)

    def _new_levels(self, rows: np.ndarray) -> np.ndarray:
        """Places within a record at which a hold begins: its pressure, length or load is another one."""
        constant = {"isometric": ("length", "pressure"), "isotonic": ("load", "pressure")}.get(
            self._task.kind, ()
        )
        begins = np.zeros(len(rows) - 1, bool)
        for name in constant:
            values = self._task.state[name]
            begins |= np.abs(np.diff(values[rows])) > _NEW_LEVEL * max(float(np.ptp(values)), 1e-12)
        places = 1 + np.flatnonzero(begins)
        shortest = np.min(np.diff([0, *places, len(rows)]))
        return places if shortest >= _HOLD else np.empty(0, dtype=np.intp)  # else a sweep

    def states(self, fit_model: FitModel, before: Before = HISTORIES["rest"]) -> dict[str, np.ndarray]:
        """Value of each state ("effect.state") at each row, after one of `HISTORIES`."""
        return self.together([(fit_model, before)])[0]

    def together(self, wanted: Sequence[tuple[FitModel, Before]]) -> list[dict[str, np.ndarray]]:
        """The states of models with the same effects after their histories; unknown ones side by side."""
        found: list[dict[str, np.ndarray]] = [{} for _ in wanted]
        effects = wanted[0][0].effects
        sensors = [e for e in effects if any(slot in e.slots for slot in _SENSORS)]
        for effect in filter(remembers, effects):
            chosen = (effect, *(sensor for sensor in sensors if sensor is not effect))
            runs = [
                _Wanted(
                    (model.muscle, past, *(self._key(e, model.values[e.id]) for e in chosen)),
                    model,
                    chosen,
                    past,
                )
                for model, before in wanted
                for past in [concerning(effect, before)]
            ]
            missing = list({run.key: run for run in runs if run.key not in self._kept}.values())
            if missing:
                trajectories = self._run(missing, effect)
                self._kept |= {run.key: states for run, states in zip(missing, trajectories, strict=True)}
            for states, run in zip(found, runs, strict=True):
                states |= self._kept[run.key]
        while len(self._kept) > _KEPT:
            self._kept.pop(next(iter(self._kept)))
        return found

    def begins(self, fit_model: FitModel, before: Before) -> dict[int, dict[str, float]]:
        """Row -> states that are not at rest there, where a record or a level begins."""
        found: dict[int, dict[str, float]] = {}
        for effect in filter(remembers, fit_model.effects):
            past = concerning(effect, before)
            run = _Wanted((), fit_model, (), past)
            rest = {f"{effect.id}.{state.name}": state.initial or 0.0 for state in effect.states}
            for rows in self._levels if past.anew else self._records:
                motion = self._first_motion(rows) if past.slid else 0.0
                begin = rest | self._begin(run, effect, int(rows[0]), motion)
                found.setdefault(int(rows[0]), {}).update(begin)
        return found

    def by_parameters(
        self, fit_model: FitModel, names: Sequence[str], before: Before = HISTORIES["rest"]
    ) -> dict[str, dict[str, np.ndarray]]:
        """Derivatives of the states by the named parameters that affect them: name -> state -> rows."""
        changed: dict[str, tuple[FitModel, float]] = {}  # name -> the model with it changed, and by how much
        for name in names:
            effect_id, _, parameter = name.partition(".")
            effect = next((e for e in fit_model.effects if e.id == effect_id), None)
            if effect is None or not remembers(effect) or parameter not in effect.wanted("rates"):
                continue
            declared = effect.parameter(parameter)
            here = fit_model.number(name)
            step = _STEP * max(abs(here), 0.01 * (declared.upper - declared.lower))
            other = here + step if here + step <= declared.upper else here - step
            changed[name] = fit_model.with_numbers([name], [other]), other - here
        if not changed:
            return {}
        models = [fit_model, *(model for model, _ in changed.values())]
        first, *others = self.together([(model, before) for model in models])
        return {
            name: {
                state: (last[state] - first[state]) / difference
                for state in first
                if state.startswith(f"{name.partition('.')[0]}.")
            }
            for (name, (_, difference)), last in zip(changed.items(), others, strict=True)
        }

    @staticmethod
    def _key(effect: Effect, values: Mapping[str, float]) -> tuple:
        wanted = effect.wanted("rates") if remembers(effect) else tuple(values)
        return (effect.id, *(values[name] for name in values if name in wanted))

    def _run(self, runs: Sequence[_Wanted], effect: Effect) -> list[dict[str, np.ndarray]]:
        """The trajectories of runs, side by side where they begin at the same rows."""
        found: list[dict[str, np.ndarray]] = [{} for _ in runs]
        for anew, parts in ((False, self._records), (True, self._levels)):
            places = [place for place, run in enumerate(runs) if run.before.anew is anew]
            if places:
                trajectories = self._run_along(parts, [runs[place] for place in places], effect)
                for place, states in zip(places, trajectories, strict=True):
                    found[place] = states
        return found

    def _run_along(
        self, parts: Sequence[np.ndarray], runs: Sequence[_Wanted], effect: Effect
    ) -> list[dict[str, np.ndarray]]:
        task = self._task
        names = [f"{effect.id}.{state.name}" for state in effect.states]
        rest = {f"{effect.id}.{state.name}": state.initial for state in effect.states}
        found = [{name: np.full(len(task.measured), value) for name, value in rest.items()} for _ in runs]
        clock = task.time if task.time is not None else np.arange(len(task.measured), dtype=float)
        models = [
            StaticModel.of(model.muscle, effects, {e.id: model.values[e.id] for e in effects})
            for _, model, effects, _ in runs
        ]
        for rows in parts:
            motion = self._first_motion(rows) if any(run.before.slid for run in runs) else 0.0
            states = self._followed(models, names, effect, clock, rows, [
                self._begin(run, effect, rows[0], motion) for run in runs
            ])  # fmt: skip
            for trajectories, of_run in zip(found, states, strict=True):
                for name in names:
                    trajectories[name][rows] = of_run[name]
                    if task.corners is not None:
                        between = np.flatnonzero(task.corners & (task.records == task.records[rows[0]]))
                        trajectories[name][between] = np.interp(clock[between], clock[rows], of_run[name])
        return found

    def _followed(
        self, models: Sequence[StaticModel], names: Sequence[str], effect: Effect, clock: np.ndarray,
        rows: np.ndarray, begins: Sequence[Mapping[str, float]],
    ) -> list[dict[str, np.ndarray]]:  # fmt: skip
        """The states of models along a record; NaN for one that cannot be followed: those rows are lost."""
        task = self._task
        try:
            return states_of_records(
                models,
                names,
                time=clock[rows],
                pressure=self._pressure(effect, clock, rows),
                length=self._length(effect, clock, rows),
                temperature=float(np.mean(task.state.get("temperature", ROOM_TEMPERATURE))),
                begins=begins,
            )
        except InputError:
            if len(models) == 1:
                return [{name: np.full(len(rows), np.nan) for name in names}]
        # The others do not share the fate of one among them.
        return [
            self._followed([model], names, effect, clock, rows, [begin])[0]
            for model, begin in zip(models, begins, strict=True)
        ]

    def _pressure(self, effect: Effect, clock: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """The pressure that an effect's states follow; noise passes a lag of the pressure without a lag."""
        pressure = self._task.state["pressure"][rows]
        if not effect.between_sensor_and_muscle:
            return pressure
        return self._smoothed("pressure", clock, rows)

    def _length(self, effect: Effect, clock: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """The length that an effect's states follow; friction would take its noise for reversals."""
        if "friction" not in effect.slots or self._task.time is None:
            return self._task.state["length"][rows]
        return self._smoothed("length", clock, rows)

    def _smoothed(self, name: str, clock: np.ndarray, rows: np.ndarray) -> np.ndarray:
        place = name, int(rows[0]), len(rows)
        if place not in self._smooth:
            self._smooth[place] = without_input_noise(clock[rows], self._task.state[name][rows])
        return self._smooth[place]

    def _begin(self, run: _Wanted, effect: Effect, row: int, motion: float) -> dict[str, float]:
        """The states that are not at rest at the first row of a record."""
        applied = {
            "pressure": float(self._task.state["pressure"][row]),
            "stroke": float(self._task.state["length"][row] - run.fit_model.muscle.nominal_length),
        }
        states: dict[str, float] = {}
        for state in effect.states:
            if state.sliding and run.before.slid * motion:
                states[f"{effect.id}.{state.name}"] = run.before.slid * motion * state.sliding
            elif state.applied and run.before.applied:
                states[f"{effect.id}.{state.name}"] = applied[state.applied]
        return states

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
