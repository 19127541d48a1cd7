"""Experiments that a drive can run: other commands, loads and supply pressures than those measured."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from mckibben.identification.diagnose.protocol import Protocol, Schedule
from mckibben.identification.predict.moving import TransientPredictor
from mckibben.measurement.measurement import build

_FEWEST, _MOST = 200, 600  # rows of a run
_PULSE = 0.05  # s of opening
_LOWER_SUPPLY = 0.7
_USUAL = 4.0  # s, shortest run
_LIGHTER = 0.5

#: Times [s] and values of a command or pressure, linear between them.
Course = tuple[Sequence[float], Sequence[float]]


def drive_protocols(predictor: TransientPredictor) -> list[Protocol]:
    """Experiments with the drive of a measurement, at most at its largest load, supply and pressure."""
    longest = max(max(one.duration for one in predictor.drives), _USUAL)
    courses = _commands(longest) if predictor.commanded else _pressures(predictor, longest)
    masses = sorted({float(one.load.mass) for one in predictor.drives})
    supply = max(float(one.supply_pressure) for one in predictor.drives)
    found = []
    for words, course in courses:
        conditions = {"load_mass": masses[-1]} if masses[-1] > 0.0 else {}
        found.append(_made(predictor, words, course, conditions | _supply(predictor, supply)))
    words, course = courses[0]
    if masses[-1] > 0.0:
        lighter = masses[0] if masses[0] < masses[-1] else _LIGHTER * masses[-1]
        conditions = {"load_mass": lighter} | _supply(predictor, supply)
        found.append(_made(predictor, f"{words}, with a load of {lighter:.3g} kg", course, conditions))
    if predictor.commanded:
        lower = _LOWER_SUPPLY * supply
        conditions = ({"load_mass": masses[-1]} if masses[-1] > 0.0 else {}) | {"supply_pressure": lower}
        found.append(_made(predictor, f"{words}, at a supply of {lower / 1e5:.2g} bar", course, conditions))
    return found


def _supply(predictor: TransientPredictor, pressure: float) -> dict[str, float]:
    return {"supply_pressure": pressure} if predictor.commanded else {}


def _commands(seconds: float) -> list[tuple[str, Course]]:
    s = seconds
    edge = 1e-4 * s
    half = 0.5 * s

    def levels(*parts: tuple[float, float]) -> Course:
        """Held levels: (begin, level), up to the end."""
        times, values, last = [0.0], [0.0], 0.0
        for begin, level in parts:
            times += [begin, begin + edge]
            values += [last, level]
            last = level
        return [*times, s], [*values, last]

    pulses = [
        part
        for k in range(8)
        for part in (
            (0.05 * s + 0.11 * s * k, 1.0 if k < 4 else -1.0),
            (0.05 * s + 0.11 * s * k + _PULSE, 0.0),
        )
    ]
    return [
        ("filling and exhausting with the valve fully open", levels((0.05 * s, 1.0), (half, -1.0))),
        (
            "filling and exhausting with the valve open by a quarter",
            levels((0.05 * s, 0.25), (half, -0.25)),
        ),
        ("short pulses of the valve with rests between them", levels(*pulses)),
        ("a slow ramp of the command up and down", ([0.0, 0.4 * s, s], [0.0, 0.3, -0.3])),
    ]


def _pressures(predictor: TransientPredictor, seconds: float) -> list[tuple[str, Course]]:
    high = float(np.max(predictor.inputs["pressure"]))
    s = seconds
    return [
        (
            "fast pressure steps up and down",
            ([0, 0.1 * s, 0.12 * s, 0.5 * s, 0.52 * s, s], _times(high, 0, 0, 1, 1, 0, 0)),
        ),
        ("a slow pressure ramp up and down", ([0.0, 5.0 * s, 10.0 * s], _times(high, 0, 1, 0))),
        (
            "pressure ramps of several heights, one within the other",
            ([0, 2 * s, 3 * s, 4 * s, 6 * s], _times(high, 0, 1, 0.4, 0.8, 0)),
        ),
    ]


def _times(size: float, *shares: float) -> list[float]:
    return [size * share for share in shares]


def _made(
    predictor: TransientPredictor, words: str, course: Course, conditions: dict[str, float]
) -> Protocol:
    times, values = (np.asarray(part, dtype=float) for part in course)
    step = float(np.median(np.diff(predictor.inputs["time"][: len(predictor.rows)])))
    rows = int(np.clip(times[-1] / max(step, 1e-6), _FEWEST, _MOST))
    time = np.unique(np.concatenate([np.linspace(0.0, times[-1], rows), times]))
    prescribed = "command" if predictor.commanded else "pressure"
    names = dict(_placeholders(predictor, len(time)))
    columns = {"time": time, **names, prescribed: np.interp(time, times, values)}
    measurement = build(columns, name=words, id=words, kind="transient", conditions=dict(conditions))
    set_points = {"time": times, prescribed: values} | {
        {"load_mass": "mass", "supply_pressure": "supply"}[name]: np.full(len(times), value)
        for name, value in conditions.items()
    }
    run = np.zeros(len(times), dtype=int)
    return Protocol(words, Schedule(run, set_points), predictor.elsewhere(measurement))


def _placeholders(predictor: TransientPredictor, count: int) -> Iterator[tuple[str, np.ndarray]]:
    """Channels that are to be predicted; only their presence matters."""
    for channel in predictor.channels:
        yield channel.name, np.zeros(count)
