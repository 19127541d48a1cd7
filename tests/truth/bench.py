"""The test bench for everything but transients: from a record to noisy readings and what their noise is."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from tests.truth.composition import Record, Truth
from tests.truth.friction import play_path
from tests.truth.muscle import Array
from tests.truth.sensors import Noise


@dataclass
class Measured:
    """Readings of the written rows, SI.

    Attributes:
        columns: channel -> values.
        noise: predicted channel -> rms of measured minus truth at the measured inputs.
        ratios: per hidden effect, rms of what it changes over that noise.
        clean: what the truth says of the predicted channel at the measured inputs.
    """

    columns: dict[str, Array]
    noise: dict[str, float]
    ratios: tuple[float, ...]
    clean: dict[str, Array]


def rms(values: Array) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(values**2)))


def force_rows(truth: Truth, record: Record, noise: Noise, rng: np.random.Generator) -> Measured:
    """Measured force at measured pressure and length."""
    true = _with_force(truth, record)
    shown = truth.read(true)
    keep = record.kept
    columns = {"time": record.time[keep], "group": record.group[keep].astype(float)}
    rows = len(columns["time"])
    errors = {}
    for name in ("pressure", "length", "force"):
        raw = shown[name][keep]
        added = raw + noise.white(name, rows, rng) + noise.drifting(name, columns["time"])
        columns[name] = noise.quantised(name, added)
        errors[name] = columns[name] - raw
    state = [true[name][keep] for name in ("pressure", "length")]
    warm = record.temperature[keep]
    at_true = truth.force(state[0], state[1], warm)
    at_read = truth.force(state[0] + errors["pressure"], state[1] + errors["length"], warm)
    propagated = at_read - at_true
    level = rms(errors["force"] - propagated)
    ratios = []
    for index, part in enumerate(truth.hidden):
        rest = truth.without(index)
        seen = part.reading(dict(true)) if part.reading else true
        other = replace(record, pressure=seen["pressure"], length=seen["length"])
        lacking = rest.read(_with_force(rest, other))["force"]
        ratios.append(rms((shown["force"] - lacking)[keep]) / level)
    return Measured(columns, {"force": level}, tuple(ratios), {"force": shown["force"][keep] + propagated})


def _with_force(truth: Truth, record: Record) -> dict[str, Array]:
    force = truth.force(record.pressure, record.length, record.temperature) + truth.memory(record)
    return {
        "time": record.time,
        "pressure": record.pressure,
        "length": record.length,
        "force": np.maximum(force, 0.0),
    }


def length_under(truth: Truth, pressure: Array, load: Array) -> Array:
    """Length at which the muscle holds a load [m], by bisection; at the braid lock if it cannot."""
    room = np.full_like(pressure, 293.15)
    low = np.full_like(pressure, 0.6 * truth.muscle.nominal)
    high = np.full_like(pressure, 0.9995 * truth.muscle.thread)
    for _ in range(48):
        middle = 0.5 * (low + high)
        weak = truth.force(pressure, middle, room) < load
        low, high = np.where(weak, middle, low), np.where(weak, high, middle)
    return 0.5 * (low + high)


def _sliding(truth: Truth, record: Record) -> Array:
    """Length of a slow pressure cycle with friction: it moves when the load leaves the friction band."""
    assert record.load is not None
    pressure, load = record.pressure, record.load
    band = np.zeros_like(pressure)
    middle = length_under(truth, pressure, load)
    for part in truth.parts:
        if part.slip:
            band = band + part.slip(pressure, middle)
    if not band.any():
        return middle
    # Pulling harder than the load plus friction it shortens, weaker than the load less friction it gives way.
    longest = length_under(truth, pressure, load + band)
    shortest = length_under(truth, pressure, load - band)
    return play_path(shortest, longest, float(middle[0]))


def length_rows(truth: Truth, record: Record, noise: Noise, rng: np.random.Generator) -> Measured:
    """Measured length under held loads at measured pressure."""
    assert record.load is not None
    keep = record.kept
    true = _with_length(truth, record)
    shown = truth.read(true)
    columns = {
        "time": record.time[keep],
        "group": record.group[keep].astype(float),
        "force": record.load[keep],
    }
    rows = len(columns["time"])
    errors = {}
    for name in ("pressure", "length"):
        raw = shown[name][keep]
        columns[name] = noise.quantised(name, raw + noise.white(name, rows, rng))
        errors[name] = columns[name] - raw
    pressure, load = record.pressure[keep], record.load[keep]
    propagated = length_under(truth, pressure + errors["pressure"], load) - length_under(
        truth, pressure, load
    )
    level = rms(errors["length"] - propagated)
    ratios = []
    for index, part in enumerate(truth.hidden):
        rest = truth.without(index)
        seen = part.reading(dict(true)) if part.reading else true
        other = replace(record, pressure=seen["pressure"])
        lacking = rest.read(_with_length(rest, other))["length"]
        ratios.append(rms((shown["length"] - lacking)[keep]) / level)
    return Measured(columns, {"length": level}, tuple(ratios), {"length": shown["length"][keep] + propagated})


def _with_length(truth: Truth, record: Record) -> dict[str, Array]:
    return {"time": record.time, "pressure": record.pressure, "length": _sliding(truth, record)}


def diameter_rows(truth: Truth, record: Record, noise: Noise, rng: np.random.Generator) -> Measured:
    """Measured braid diameter at measured length and pressure."""
    keep = record.kept
    true = {
        "time": record.time,
        "pressure": record.pressure,
        "length": record.length,
        "diameter": _diameter(truth, record.pressure, record.length),
    }
    shown = truth.read(true)
    columns = {"time": record.time[keep], "group": record.group[keep].astype(float)}
    rows = len(columns["time"])
    errors = {}
    for name in ("pressure", "length", "diameter"):
        raw = shown[name][keep]
        columns[name] = noise.quantised(name, raw + noise.white(name, rows, rng))
        errors[name] = columns[name] - raw
    pressure, length = record.pressure[keep], record.length[keep]
    propagated = (
        _diameter(truth, pressure + errors["pressure"], length + errors["length"]) - true["diameter"][keep]
    )
    level = rms(errors["diameter"] - propagated)
    ratios = []
    for index, part in enumerate(truth.hidden):
        rest = truth.without(index)
        seen = part.reading(dict(true)) if part.reading else true
        lacking = _diameter(rest, seen["pressure"], seen["length"])
        ratios.append(rms((shown["diameter"] - lacking)[keep]) / level)
    clean = shown["diameter"][keep] + propagated
    return Measured(columns, {"diameter": level}, tuple(ratios), {"diameter": clean})


def _diameter(truth: Truth, pressure: Array, length: Array) -> Array:
    value = truth.muscle.diameter_at(length)
    for part in truth.parts:
        if part.diameter:
            value = part.diameter(pressure, length)
    return value
