"""Experiments that a rig can run: set points over time, and what a model predicts for them.

A rig can do what it did for the measurement at hand: its largest pressure, its range of lengths, its highest
speed, its loads. Slower and smaller is always possible.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from mckibben.identification.predict.comparable_rows import ComparableRows
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.predictor import Predictor
from mckibben.identification.predict.quasistatic import QuasistaticPredictor
from mckibben.measurement.motion import held_directions
from mckibben.physics.model import ROOM_TEMPERATURE

_SET_UP = 30.0  # s, to start one run
_FASTEST = 99.0  # percentile of the measured speeds: single ones are noise of the differentiation
_USUAL_SPEED = 0.05  # 1/s, contraction rate where the file has no time
_SLOWEST = 600.0  # s, longest sweep of one run
_PER_SWEEP = 60  # predicted rows
_HOLD = 60.0  # s
_MOST_LOADS = 3
_STILL = 1e-9  # m/s
#: Way of small reversals, shares of the range: friction that yields before it slides shows in them.
_SMALL = (0.0, 0.5, 0.46, 0.5, 0.42, 0.5, 0.34, 0.5, 1.0, 0.0)
_PASSES = 2  # of the motion under a load: with the memory of no motion, then with that of the first pass


@dataclass(frozen=True)
class Rig:
    """Limits of a rig, SI.

    Attributes:
        pressure: largest gauge pressure [Pa].
        least, most: contractions between which it can move the muscle, or the load moved.
        speed: largest speed of the muscle's end [m/s].
        loads: forces it can apply [N]; empty on a rig that prescribes the length.
    """

    pressure: float
    least: float
    most: float
    speed: float
    loads: tuple[float, ...] = ()


@dataclass(frozen=True)
class Schedule:
    """Set points of an experiment, linear between its rows: channel -> values in SI.

    ``run`` numbers the runs from 0; time starts anew in each.
    """

    run: np.ndarray
    columns: Mapping[str, np.ndarray]

    @property
    def seconds(self) -> float:
        """Duration with the set-up of each run."""
        time = self.columns["time"]
        runs = [time[self.run == number] for number in np.unique(self.run)]
        return float(sum(np.ptp(one) + _SET_UP for one in runs))


@dataclass(frozen=True)
class Protocol:
    """A possible experiment: in words, as set points, and as data that a model can predict."""

    words: str
    schedule: Schedule
    predictor: Predictor

    @property
    def minutes(self) -> float:
        """Duration [min]."""
        return self.schedule.seconds / 60.0


def rig_of(predictor: Predictor, fit_model: FitModel) -> Rig:
    """What the rig of one or more measurements did, all of the same predicted channel."""
    inputs, rest = predictor.inputs, float(fit_model.muscle.nominal_length)
    length = inputs.get("length", predictor.measured)
    contraction = 1.0 - length / predictor.rest_length(fit_model)
    speed = _USUAL_SPEED * rest
    if "time" in inputs:
        speed = float(np.percentile(np.abs(inputs["velocity"]), _FASTEST)) or speed
    loads = np.unique(np.round(inputs["load"], 1)) if "load" in inputs else np.empty(0)
    if len(loads) > _MOST_LOADS:
        loads = np.quantile(loads, np.linspace(0.0, 1.0, _MOST_LOADS))
    return Rig(
        pressure=float(np.max(inputs["pressure"])),
        least=float(np.min(contraction)),
        most=float(np.max(contraction)),
        speed=speed,
        loads=tuple(float(load) for load in loads),
    )


def protocols(rig: Rig, fit_model: FitModel, *, channel: str) -> list[Protocol]:
    """Experiments on a rig that prescribes lengths and reads forces, or hangs loads and reads lengths.

    Args:
        rig: its limits.
        fit_model: for the nominal length, and as the first guess of lengths under load.
        channel: "force" or "length".
    """
    if not rig.pressure > 0.0:
        return []
    if channel == "length":
        return list(_under_load(rig, fit_model))
    return list(_at_length(rig, fit_model)) if channel == "force" and rig.most > rig.least else []


@dataclass(frozen=True)
class RigRun:
    """Set points of one run: times, and the values of what the rig prescribes."""

    time: np.ndarray
    pressure: np.ndarray
    contraction: np.ndarray | None = None
    load: float = 0.0


def _at_length(rig: Rig, fit_model: FitModel) -> Iterator[Protocol]:
    low, span = rig.least, rig.most - rig.least
    rest = float(fit_model.muscle.nominal_length)

    def sweep(share: float, speed: float, turns: Sequence[float]) -> RigRun:
        points = low + span * np.array(turns)
        pace = max(speed / rest, float(np.sum(np.abs(np.diff(points)))) / _SLOWEST)
        time = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(points)))]) / pace
        return RigRun(time, np.full(len(time), share * rig.pressure), points)

    def ramp(place: float, seconds: float) -> RigRun:
        time = np.array([0.0, seconds, 2.0 * seconds])
        pressure = rig.pressure * np.array([0.0, 1.0, 0.0])
        return RigRun(time, pressure, np.full(3, low + place * span))

    loop = [0.0, 1.0, 0.0]
    speeds = [rig.speed, 0.1 * rig.speed, 0.01 * rig.speed]
    yield experiment_of(
        "loops of contraction at three pressures and three speeds two decades apart",
        [sweep(share, speed, loop) for share in (1 / 3, 2 / 3, 1.0) for speed in speeds],
        fit_model,
    )
    nested = [0.0, 1.0, 0.5, 1.0, 0.25, 0.75, 0.25, 1.0, 0.0]
    yield experiment_of(
        "loops of contraction of several amplitudes, one within the other",
        [sweep(share, 0.3 * rig.speed, nested) for share in (0.5, 1.0)],
        fit_model,
    )
    yield experiment_of(
        "small reversals of a slow contraction, of 4, 8 and 16 % of the range",
        [sweep(share, 0.1 * rig.speed, _SMALL) for share in (0.5, 1.0)],
        fit_model,
    )
    yield experiment_of(
        "pressure ramps up and down from vented at five lengths",
        [ramp(place, 5.0) for place in np.linspace(0.0, 1.0, 5)],
        fit_model,
    )
    yield experiment_of(
        "pressure ramps up and down from vented at one length, at rates two decades apart",
        [ramp(0.3, seconds) for seconds in (1.0, 10.0, 100.0)],
        fit_model,
    )
    yield experiment_of("a loop of contraction without pressure", [sweep(0.0, rig.speed, loop)], fit_model)
    quick = max(span * rest / rig.speed, 0.05)
    holds = [
        RigRun(
            np.array([0.0, quick, quick + _HOLD, 2 * quick + _HOLD, 2 * quick + 2 * _HOLD]),
            np.full(5, share * rig.pressure),
            low + span * np.array([0.0, 0.7, 0.7, 0.2, 0.2]),
        )
        for share in (0.5, 1.0)
    ]
    yield experiment_of("holds of 60 s after a fast contraction and a fast extension", holds, fit_model)


def _under_load(rig: Rig, fit_model: FitModel) -> Iterator[Protocol]:
    loads = rig.loads or (0.0,)
    up_down = [0.0, 1.0, 0.0]
    heaviest = loads[len(loads) - 1]

    def ramps(seconds: Sequence[float], levels: Sequence[float], chosen: Sequence[float]) -> list[RigRun]:
        shape = np.array(levels)
        return [
            RigRun(np.linspace(0.0, total, len(shape)), rig.pressure * shape, None, load)
            for load in chosen
            for total in seconds
        ]

    several = f"each of {len(loads)} loads" if len(loads) > 1 else "the load"
    yield experiment_of(
        f"slow pressure ramps up and down under {several}", ramps([60.0], up_down, loads), fit_model
    )
    yield experiment_of(
        "pressure ramps up and down at rates two decades apart",
        ramps([4.0, 40.0, 400.0], up_down, [heaviest]),
        fit_model,
    )
    yield experiment_of(
        "pressure ramps of several heights, one within the other",
        ramps([120.0], [0.0, 1.0, 0.5, 1.0, 0.25, 0.75, 0.25, 1.0, 0.0], [heaviest]),
        fit_model,
    )
    yield experiment_of(
        "small reversals of a slow pressure ramp, of 4, 8 and 16 % of its height",
        ramps([240.0], _SMALL, [heaviest]),
        fit_model,
    )
    hold = RigRun(
        np.array([0.0, 1.0, 1.0 + _HOLD, 2.0 + _HOLD, 2.0 + 2.0 * _HOLD]),
        rig.pressure * np.array([0.0, 1.0, 1.0, 0.5, 0.5]),
        None,
        heaviest,
    )
    yield experiment_of("holds of 60 s after fast changes of the pressure", [hold], fit_model)


def experiment_of(words: str, runs: Sequence[RigRun], fit_model: FitModel) -> Protocol:
    """The experiment of some runs; its rows are dense where something moves and at the begin of holds.

    Set points belong to the path and are not compared, as a reader leaves out the rows where the motion of a
    file turns: friction has the sign of neither side there, and models differ in it by all of their friction.
    """
    parts = [_dense(run.time) for run in runs]
    labels = np.repeat(np.arange(len(runs)), [len(time) for time in parts])
    rest = float(fit_model.muscle.nominal_length)
    pressure = np.concatenate([np.interp(t, r.time, r.pressure) for r, t in zip(runs, parts, strict=True)])
    prescribed = [
        None if r.contraction is None else rest * (1.0 - np.interp(t, r.time, r.contraction))
        for r, t in zip(runs, parts, strict=True)
    ]
    lengths = [part for part in prescribed if part is not None]
    state = {
        "pressure": pressure,
        **_motion(
            [np.zeros(len(t)) if part is None else part for t, part in zip(parts, prescribed, strict=True)],
            parts,
        ),
        "temperature": np.full(len(labels), ROOM_TEMPERATURE),
    }
    columns = {
        "time": np.concatenate([run.time for run in runs]),
        "pressure": np.concatenate([run.pressure for run in runs]),
    }
    if lengths:
        state["length"] = np.concatenate(lengths)
        columns["length"] = np.concatenate(
            [rest * (1.0 - r.contraction) for r in runs if r.contraction is not None]
        )
    else:
        state["load"] = np.repeat([run.load for run in runs], [len(time) for time in parts])
        columns["load"] = np.concatenate([np.full(len(run.time), run.load) for run in runs])
    task = ComparableRows(
        kind="isobaric" if lengths else "isotonic",
        channel="force" if lengths else "length",
        unit="N" if lengths else "m",
        measured=np.zeros(len(labels)) if lengths else np.full(len(labels), rest),
        state=state,
        time=np.concatenate(parts),
        records=labels,
        groups=labels,
        turning=np.zeros(len(labels), bool),
        rows=np.arange(len(labels)),
        excluded={},
        unknown_load=False,
        messages=(),
        rest_length=rest,
    )
    if not lengths:  # the motion under a load is that of the model; its memory needs a path to begin with
        task = _along(task, np.full(len(labels), rest), parts)
        for _ in range(_PASSES):
            task = _along(task, QuasistaticPredictor(task).predict(fit_model), parts)
    corners = np.concatenate([np.isin(t, r.time) for r, t in zip(runs, parts, strict=True)])
    task = replace(task, turning=corners)
    numbers = np.repeat(np.arange(len(runs)), [len(run.time) for run in runs])
    return Protocol(words, Schedule(numbers, columns), QuasistaticPredictor(task).after(("rest",)))


def _along(task: ComparableRows, length: np.ndarray, times: Sequence[np.ndarray]) -> ComparableRows:
    """The task with the motion along lengths; ``times`` are those of its runs."""
    each = [length[task.records == number] for number in range(len(times))]
    return replace(task, measured=length, state={**task.state, "length": length, **_motion(each, times)})


def _motion(lengths: Sequence[np.ndarray], times: Sequence[np.ndarray]) -> dict[str, np.ndarray]:
    """Velocity and direction of each run; a muscle at rest keeps the direction of its last motion."""
    velocity = [np.gradient(x, t) for x, t in zip(lengths, times, strict=True)]
    directions = []
    for length, speed in zip(lengths, velocity, strict=True):
        sign = np.sign(np.where(np.abs(speed) > _STILL, speed, 0.0)).astype(np.int8)
        directions.append(held_directions(sign, length, np.zeros(len(length), int), least=0.0))
    return {"velocity": np.concatenate(velocity), "direction": np.concatenate(directions).astype(float)}


def _dense(corners: np.ndarray) -> np.ndarray:
    """Times of the predicted rows: evenly over each part, closer together at the begin of a long one."""
    shape = np.linspace(0.0, 1.0, _PER_SWEEP, endpoint=False)
    median = float(np.median(np.diff(corners)))
    parts = [
        start + (end - start) * (shape**2 if end - start > 2.0 * median else shape)
        for start, end in pairwise(corners)
    ]
    return np.concatenate([*parts, corners[-1:]])
