"""Errors over windows: how far a model goes astray within a short time from what was measured.

A run over a whole record adds up what the model has wrong: a leak of 1 % a second, a clock that is a
little off. A window begins anew at the measured stroke, its smoothed speed and, where a command drives the
model, the measured pressure; the states of effects are those that the measured motion leaves. An error that
the run has and windows have not is one that builds up, or one of phase; an error that both have is one of
shape.

A window lasts one mean period of the measured motion: within it an error of shape shows whole, and nothing
that takes longer to build up. It is at most a quarter of the record, and at least ten rows.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.input_noise import without_input_noise
from mckibben.identification.predict.moving import TransientPredictor
from mckibben.identification.predict.predictor import Predictor
from mckibben.identification.predict.specimens import SpecimensPredictor
from mckibben.measurement.derivative import noise_of, rates
from mckibben.measurement.preparation import ORDER, low_passed
from mckibben.physics.errors import InputError
from mckibben.physics.model import ROOM_TEMPERATURE
from mckibben.simulation.drive.records import states_of_records
from mckibben.simulation.drive.windows import Measured
from mckibben.simulation.integrate.engine import compiled_driven

_LONGEST = 0.25  # of the record
_FEWEST_ROWS = 10  # of a window
# By how much a motion has to turn back: a share of its range, and deviations of the noise up to another
# share, because few rows a swing make a swing look like noise.
_TURN, _NOISE, _MOST_NOISE = 0.05, 6.0, 0.25
_SEED = 0  # of the noise of a perfect model; the same question gives the same digits
_FOLLOWED = 1e-4  # relative error per step of states along the measured motion


@dataclass(frozen=True)
class WindowErrors:
    """Errors over windows.

    Attributes:
        length: of a window [s].
        count: number of windows.
        rows: number of rows compared.
        rmse: root mean square of measured − model, over the scale of the channels where there are several.
        of_run: the same of the whole runs, at the same rows.
        perfect: what the model would have if it were perfect: its own run with the noise of the readings,
            begun anew in the same way.
        noise: root mean square of that noise, over the same scale.
    """

    length: float
    count: int
    rows: int
    rmse: float
    of_run: float
    perfect: float
    noise: float


def window_errors(
    predictor: Predictor, fit_model: FitModel, noise: float | None = None
) -> WindowErrors | str | None:
    """The errors of a model over windows of records in time.

    Args:
        predictor: the data.
        fit_model: the model.
        noise: standard deviation of the only channel [SI], where it is stated; else it is estimated from
            third differences of all rows, of the readings or of what the run leaves of them.

    Returns:
        a sentence why there are none; None for data that are no records in time.
    """
    parts: list[tuple[Predictor, FitModel]] = [(predictor, fit_model)]
    if isinstance(predictor, SpecimensPredictor):
        parts = predictor.parts(fit_model)
    records = []
    for part, model in parts:
        if not isinstance(part, TransientPredictor):
            return None
        if "displacement" not in {channel.name for channel in part.channels}:
            return "no windows: no stroke was measured that a window could begin from"
        if part.commanded and "pressure" not in {channel.name for channel in part.channels}:
            return "no windows: a command drives the model, and no pressure was measured to begin from"
        records += [_Record(part, model, number) for number in range(part.runs)]
    try:
        return _errors(records, noise)
    except InputError as error:
        return f"no windows: {error.message}"


def _errors(records: Sequence[_Record], noise: float | None) -> WindowErrors | str:
    records = [record for record in records if len(record.grid) > 4 * _FEWEST_ROWS]
    if not records:
        return f"no windows: a record of {4 * _FEWEST_ROWS} rows is too short for four of them"
    length = _rounded(float(np.median([record.window for record in records])))
    random = np.random.default_rng(_SEED)
    squares, of_run, perfect, noises, count = [], [], [], [], 0
    for record in records:
        spans = record.spans(length)
        measured = record.readings
        own = record.own_readings
        squares.append(record.scaled(record.over_windows(measured, spans), measured, spans))
        whole = [{n: v[first + 1 : last + 1] for n, v in own.items()} for first, last in spans]
        of_run.append(record.scaled(whole, measured, spans))
        sigmas = record.noises(noise)
        made = {n: v + _noise(random, sigmas[n], record.grid, record.cut_off.get(n)) for n, v in own.items()}
        perfect.append(record.scaled(record.over_windows(made, spans), made, spans))
        noises.append(record.scaled(whole, made, spans))
        count += len(spans)
    found = np.concatenate(squares)
    finite = np.isfinite(found)
    if not finite.any():
        return "no windows: the model does not run from what was measured"
    return WindowErrors(
        length,
        count,
        int(np.count_nonzero(finite)) // len(records[0].names),
        _root_mean(found[finite]),
        _root_mean(np.concatenate(of_run)[finite]),
        _root_mean(np.concatenate(perfect)),
        _root_mean(np.concatenate(noises)),
    )


def _root_mean(squares: np.ndarray) -> float:
    finite = squares[np.isfinite(squares)]
    return float(np.sqrt(np.mean(finite))) if len(finite) else float("nan")


def _rounded(length: float) -> float:
    """To two digits, so that the number can be said."""
    return float(f"{length:.2g}")


class _Record:
    """One run of a predictor, with the model's own run at all its rows."""

    def __init__(self, predictor: TransientPredictor, fit_model: FitModel, number: int) -> None:
        self._predictor = predictor
        self.names = tuple(channel.name for channel in predictor.channels)
        self._own, readings = predictor.whole_run(fit_model, number)
        written = len(self._own.columns["stroke"])
        self.grid = self._own.grid[:written]
        self.readings = {name: readings[name][:written] for name in self.names}
        self._pressure = readings["pressure"][:written] if "pressure" in readings else None

    @property
    def own_readings(self) -> dict[str, np.ndarray]:
        """The readings of the whole run."""
        return {name: self._own.columns[_READINGS[name]] for name in self.names}

    @property
    def window(self) -> float:
        """One mean period of the measured motion, within its limits [s]."""
        duration = float(self.grid[-1] - self.grid[0])
        turns = _turns(self.readings["displacement"])
        period = 2.0 * duration / turns if turns else duration
        least = _FEWEST_ROWS * duration / (len(self.grid) - 1)
        return min(max(period, least), _LONGEST * duration)

    def spans(self, length: float) -> list[tuple[int, int]]:
        """First and last row of each window; the rest behind the last whole one is left out."""
        duration = float(self.grid[-1] - self.grid[0])
        count = max(int(duration / length + 1e-6), 1)
        edges = np.searchsorted(self.grid, self.grid[0] + length * np.arange(count + 1) - 1e-9 * duration)
        edges = np.unique(np.minimum(edges, len(self.grid) - 1))
        return list(zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True))

    @property
    def cut_off(self) -> Mapping[str, float]:
        """Channel -> frequency up to which a preparation lets it pass [Hz]."""
        return self._predictor.prepared_from.cut_off

    def noises(self, stated: float | None) -> dict[str, float]:
        """Standard deviation of the noise of each channel [SI]."""
        if stated is not None and len(self.names) == 1:
            return {self.names[0]: stated}
        shared = self._predictor.prepared_from.shared_noise
        found = {}
        for name in self.names:
            readings = self.readings[name]
            seen = min(noise_of(readings), noise_of(readings - self.own_readings[name]))
            found[name] = float(np.hypot(seen, shared.get(name, 0.0)))
        return found

    def over_windows(
        self, readings: Mapping[str, np.ndarray], spans: Sequence[tuple[int, int]]
    ) -> list[dict[str, np.ndarray]]:
        """The model's readings in windows that begin at these readings."""
        stroke = without_input_noise(self.grid, readings["displacement"])
        rate = rates(self.grid, readings["displacement"])
        known = np.isfinite(rate.sigma)
        speed = np.where(known, rate.value, 0.0)
        pressure = readings.get("pressure")
        if pressure is not None:
            pressure = without_input_noise(self.grid, pressure)
        measured = Measured(stroke, speed, np.where(known, rate.sigma, 0.0), pressure, self._states(stroke))
        found = self._own.windows(spans, measured, [_READINGS[name] for name in self.names])
        return [{name: each[_READINGS[name]] for name in self.names} for each in found]

    def _states(self, stroke: np.ndarray) -> dict[str, np.ndarray]:
        """States of effects along the measured motion; none where they do not follow it."""
        drive = self._own.drive
        names = [state.name for state in compiled_driven(drive.model.effects, motion=False).model.states][1:]
        pressure = self._pressure
        if not names or pressure is None:
            return {}
        own = self._own.columns
        offset = float(np.median(own["stroke_reading"] - own["stroke"]))
        length = drive.muscle.nominal_length * (1.0 - drive.precontraction) - (stroke - offset)
        try:
            (found,) = states_of_records(
                [drive.model], names, time=self.grid, pressure=without_input_noise(self.grid, pressure),
                length=length, begins=[{}], temperature=ROOM_TEMPERATURE, tolerance=_FOLLOWED,
            )  # fmt: skip
        except InputError:
            return {}
        return found

    def scaled(
        self,
        found: Sequence[Mapping[str, np.ndarray]],
        readings: Mapping[str, np.ndarray],
        spans: Sequence[tuple[int, int]],
    ) -> np.ndarray:
        """Squared differences to readings over the scale of each channel."""
        several = len(self.names) > 1
        parts = []
        for channel in self._predictor.channels:
            scale = channel.noise if several else 1.0
            measured = np.concatenate([readings[channel.name][first + 1 : last + 1] for first, last in spans])
            model = np.concatenate([each[channel.name] for each in found])
            parts.append(((measured - model) / scale) ** 2)
        return np.concatenate(parts)


def _noise(random: np.random.Generator, sigma: float, time: np.ndarray, cut_off: float | None) -> np.ndarray:
    """Noise of these times: white, or what a low pass leaves of it."""
    white = random.normal(0.0, sigma, len(time))
    rate = (len(time) - 1) / float(time[-1] - time[0])
    if cut_off is None or not 0.0 < cut_off < 0.5 * rate:
        return white
    passed = low_passed(white, cut_off, rate, ORDER)
    return passed * (sigma / max(float(np.std(passed)), 1e-300))


#: Channel -> output of a run that is its reading.
_READINGS = {"pressure": "pressure_reading", "displacement": "stroke_reading", "force": "force_reading"}


def _turns(stroke: np.ndarray) -> int:
    """How often a motion turns back by more than a share of its range and more than its noise."""
    span = float(np.ptp(stroke))
    least = max(_TURN * span, min(_NOISE * noise_of(stroke), _MOST_NOISE * span))
    turns, sense, extreme = 0, 0, float(stroke[0])
    for value in stroke.tolist():
        if sense >= 0 and value < extreme - least:
            turns += sense != 0
            sense, extreme = -1, value
        elif sense <= 0 and value > extreme + least:
            turns += sense != 0
            sense, extreme = 1, value
        elif (sense > 0 and value > extreme) or (sense < 0 and value < extreme):
            extreme = value
    return turns
