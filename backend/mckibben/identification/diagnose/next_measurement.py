"""Experiments that would separate effects that the present data cannot distinguish.

What the catalogue declares about a pair comes first. In addition, candidate protocols are simulated with one
model as the truth, and the other model is refitted to each. The proposal is the protocol with the largest
remaining difference, stated in standard deviations of one reading.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from mckibben.identification.fit.fitted_model import refitted
from mckibben.identification.predict.comparable_rows import ComparableRows
from mckibben.identification.predict.fit_model import FitModel, free_numbers
from mckibben.identification.predict.free import Free
from mckibben.identification.predict.quasistatic import QuasistaticPredictor
from mckibben.physics.effect import Effect
from mckibben.physics.model import ROOM_TEMPERATURE
from mckibben.simulation.statics.inverse import contraction_at
from mckibben.simulation.statics.model import StaticModel

_FEWEST = 8  # rows with tension that a protocol needs


@dataclass(frozen=True)
class Protocol:
    """A possible experiment: its description and its rows."""

    words: str
    task: ComparableRows


@dataclass(frozen=True)
class SeparatingExperiment:
    """An experiment for a pair of effects.

    Attributes:
        first, second: ids of the effects.
        declared: what separates them according to the catalogue; empty when it has no entry.
        protocol: the simulated experiment where they differ most; empty when none can be simulated.
        separation: rms difference in standard deviations of a reading.
    """

    first: str
    second: str
    declared: str
    protocol: str
    separation: float

    def sentence(self, titles: Mapping[str, str]) -> str:
        """The proposal in words."""
        pair = f"{titles.get(self.first, self.first)} or {titles.get(self.second, self.second)}"
        parts = [f"{pair}: {self.declared}" if self.declared else f"{pair}:"]
        if self.protocol and self.separation >= 1.0:
            parts.append(f"simulated best: {self.protocol} ({self.separation:.1f} sigma apart)")
        elif self.protocol and self.declared:
            parts.append("a force measurement alone is not enough: no simulated one separates them")
        elif self.protocol:
            parts.append("no simulated force measurement separates them, and no other experiment is known")
        return "; ".join(part.rstrip(":") for part in parts)


def declared(first: Effect, second: Effect) -> str:
    """What either effect declares to separate it from the other."""
    for one, other in ((first, second), (second, first)):
        for twin in one.confused_with:
            if twin.effect == other.id:
                return twin.separated_by
    return ""


def separation(
    truth: FitModel,
    other: FitModel,
    protocols: list[Protocol],
    *,
    noise: float,
    geometry: tuple[Free, ...] = (),
) -> tuple[str, float]:
    """The protocol in which the refitted model differs most from the truth, and by how many sigma.

    Rows where the muscle would be slack are not readings of its force and do not count.
    """
    best, largest = "", 0.0
    for protocol in protocols:
        bare = QuasistaticPredictor(protocol.task)
        force = bare.predict(truth, clipped=False)
        slack = bare.predict(truth) != force
        if np.count_nonzero(~slack) < _FEWEST:
            continue
        predictor = QuasistaticPredictor(replace(protocol.task, measured=force, turning=slack))
        fitted_model = refitted(predictor, other, free_numbers(other, geometry))
        residual = predictor.measured - predictor.predict(fitted_model.fit_model, clipped=False)
        difference = float(np.sqrt(np.mean(residual**2))) / noise
        if difference > largest:
            best, largest = protocol.words, difference
    return best, largest


def protocols(fit_model: FitModel, *, largest_pressure: float) -> list[Protocol]:
    """Experiments on a force rig, up to the measured pressure and within the muscle's stroke."""
    muscle = fit_model.muscle
    model = StaticModel(muscle)
    ideal = float(contraction_at(model, load=0.0, pressures=np.array([largest_pressure]))[0])
    most = 0.6 * ideal
    rest = muscle.nominal_length
    high = largest_pressure
    speeds = [(share * high, speed) for share in (0.3, 0.6, 1.0) for speed in (0.002, 0.02, 0.2)]
    loops = "isobaric loops at three pressures and three speeds two decades apart"
    nested = "isobaric loops of three amplitudes within each other"
    lengths = np.linspace(0.0, most, 5)
    return [
        _sweep(loops, speeds, 0.0, most, rest),
        _sweep(nested, [(0.6 * high, 0.02)], 0.0, most, rest, nested=True),
        _ramps("pressure ramps up and down at five lengths, from vented", high, lengths, rest),
        _sweep("a pull beyond the nominal length without pressure", [(0.0, 0.01)], -0.02, 0.05, rest),
        _hold("a hold of 60 s after a fast contraction", 0.6 * high, most, rest),
    ]


def _sweep(
    words: str, runs: list[tuple[float, float]], low: float, high: float, rest: float, *, nested: bool = False
) -> Protocol:
    parts = []
    for number, (pressure, speed) in enumerate(runs):
        turns = [low, high, low]
        if nested:
            middle = 0.5 * (low + high)
            turns = [low, high, middle, high, 0.25 * high, 0.75 * high, 0.25 * high, low]
        turning_points = np.array(turns)
        path = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(turning_points)))]) * rest
        time = np.linspace(0.0, path[-1] / speed, 60 * (len(turns) - 1))
        contraction = np.interp(time * speed, path, turning_points)
        parts.append((time, np.full(len(time), pressure), rest * (1.0 - contraction), number))
    return Protocol(words, _task(parts))


def _ramps(words: str, high: float, contractions: np.ndarray, rest: float) -> Protocol:
    parts = []
    for number, contraction in enumerate(contractions):
        time = np.linspace(0.0, 10.0, 81)
        pressure = high * np.interp(time, [0.0, 5.0, 10.0], [0.0, 1.0, 0.0])
        parts.append((time, pressure, np.full(len(time), rest * (1.0 - contraction)), number))
    return Protocol(words, _task(parts))


def _hold(words: str, pressure: float, contraction: float, rest: float) -> Protocol:
    time = np.concatenate([np.linspace(0.0, 0.5, 20), np.geomspace(0.55, 60.0, 60)])
    stroke = np.interp(time, [0.0, 0.5, 60.0], [0.0, contraction, contraction])
    return Protocol(words, _task([(time, np.full(len(time), pressure), rest * (1.0 - stroke), 0)]))


def _task(parts: list[tuple[np.ndarray, np.ndarray, np.ndarray, int]]) -> ComparableRows:
    time, pressure = [part[0] for part in parts], [part[1] for part in parts]
    length, label = [part[2] for part in parts], [part[3] for part in parts]
    velocity = np.concatenate([np.gradient(x, t) for t, x in zip(time, length, strict=True)])
    labels = np.repeat(label, [len(t) for t in time])
    count = len(labels)
    return ComparableRows(
        kind="isobaric",
        channel="force",
        unit="N",
        measured=np.zeros(count),
        state={
            "length": np.concatenate(length),
            "pressure": np.concatenate(pressure),
            "velocity": velocity,
            "direction": np.sign(np.where(np.abs(velocity) > 1e-9, velocity, 0.0)),
            "temperature": np.full(count, ROOM_TEMPERATURE),
        },
        time=np.concatenate(time),
        records=labels,
        groups=labels,
        turning=np.zeros(count, bool),
        rows=np.arange(count),
        excluded={},
        unknown_load=False,
        messages=(),
    )
