"""Checks of the worked examples, and of the slots outside the muscle one by one."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from itertools import product

import numpy as np
import symengine as se

from mckibben.application.effect.broken import claim
from mckibben.application.effect.states import MUSCLE, MUSCLE_SLOTS
from mckibben.physics.effect import Effect
from mckibben.physics.slots import SLOTS
from mckibben.physics.worked_examples import wrong_examples

# What slot functions may ask for, and between which values it is tried.
RANGES: dict[str, tuple[float, float]] = {
    "length": (0.225, 0.309),
    "pressure": (0.0, 8e5),
    "velocity": (-0.5, 0.5),
    "direction": (-1.0, 1.0),
    "temperature": (273.15, 343.15),
    "area": (0.0, 3e-3),
    "pressure_rate": (-2e6, 2e6),
    "diameter": (0.02, 0.05),
    "gas_temperature": (230.0, 420.0),
    "ambient_temperature": (273.15, 323.15),
    "absolute_pressure": (0.6e5, 9e5),
    "ambient_pressure": (0.9e5, 1.05e5),
    "tube_length": (0.0, 10.0),
    "angle": (-2.0, 2.0),
    "opening": (-1.0, 1.0),
    "conductance": (1e-10, 1e-7),
    "supply_pressure": (3e5, 1.1e6),
    "supply_flow": (-0.02, 0.02),
    "mass_flow": (-0.02, 0.02),
    "exhaust_flow": (-0.02, 0.02),
    "exhaust_conductance": (1e-10, 1e-7),
    "sink_pressure": (0.9e5, 1.05e5),
    "force": (0.0, 1500.0),
    "stroke": (-0.01, 0.08),
    "speed": (-1.0, 1.0),
    "load": (0.0, 1500.0),
    "reading": (-1e5, 1e6),
    "instant_pressure_reading": (0.0, 8e5),
    "instant_force_reading": (-20.0, 1500.0),
    "instant_stroke_reading": (-0.01, 0.08),
}


def _slots(effect: Effect) -> list[str]:
    return [slot for slot in effect.slots if slot not in MUSCLE_SLOTS]


def _ranges(effect: Effect, slot: str) -> dict[str, tuple[float, float]]:
    """Range of every number the slot's function asks for."""
    own = {p.name: (p.lower, p.upper) for p in effect.parameters}
    own |= {state.name: (-state.scale, state.scale) for state in effect.states}
    asked = inspect.signature(effect.slots[slot]).parameters
    return {name: (own | RANGES)[name] for name in asked if name != "muscle"}


def _evaluate(effect: Effect, slot: str, point: Mapping[str, object]) -> list:
    given = effect.call(slot, {"muscle": MUSCLE}, point)
    return list(given) if isinstance(given, tuple) else [given]


def _compiled(effect: Effect, slot: str) -> tuple[list[str], int, Callable[[np.ndarray], np.ndarray]]:
    """Names of the arguments, number of results, and a function giving results and all their derivatives."""
    symbols = {name: se.Symbol(name) for name in _ranges(effect, slot)}
    results = [se.sympify(result) for result in _evaluate(effect, slot, symbols)]
    slopes = [result.diff(symbol) for result in results for symbol in symbols.values()]
    return (
        list(symbols),
        len(results),
        se.Lambdify(list(symbols.values()), results + slopes, backend="llvm", cse=True),
    )


def check_off_leaves_slots_alone(effect: Effect) -> None:
    """At its off values a chained slot gives back what it got, a sum 0 and a product 1, to the last bit."""
    random = np.random.default_rng(3)
    for slot in _slots(effect):
        if slot in ("rates", "drive_rates"):
            continue
        chained = SLOTS[slot].context[0] if SLOTS[slot].combined_by == "chain" else None
        for _ in range(20):
            point = {name: random.uniform(*limits) for name, limits in _ranges(effect, slot).items()}
            neutral = 1.0 if SLOTS[slot].combined_by == "product" else 0.0
            want = point[chained] if chained else neutral
            claim(all(float(got) == want for got in _evaluate(effect, slot, point | effect.off)), slot)


def check_slots_finite_at_all_bounds(effect: Effect) -> None:
    """Results and derivatives are finite at every corner, without motion, at empty and at full states."""
    for slot in _slots(effect):
        names, _, function = _compiled(effect, slot)
        tried = [
            (low, 0.0, high) if low < 0.0 < high else (low, high)
            for low, high in _ranges(effect, slot).values()
        ]
        rows = np.array(list(product(*tried))) if names else np.zeros((1, 0))
        claim(np.isfinite(function(rows)).all(), slot)


def check_slots_agree(effect: Effect) -> None:
    """The same numbers on numpy and on symbols, and exact derivatives."""
    random = np.random.default_rng(5)
    for slot in _slots(effect):
        names, count, function = _compiled(effect, slot)
        ranges = _ranges(effect, slot)
        for _ in range(12):
            point = {name: random.uniform(*limits) for name, limits in ranges.items()}
            got = function(np.array([point[name] for name in names]))
            here = np.array([float(value) for value in _evaluate(effect, slot, point)])
            np.testing.assert_allclose(got[:count], here, rtol=1e-12, atol=1e-300)
            exact = got[count:].reshape(count, len(names))
            for column, name in enumerate(names):
                step = 1e-6 * (ranges[name][1] - ranges[name][0])
                up, down = (
                    np.array([float(v) for v in _evaluate(effect, slot, {**point, name: point[name] + h})])
                    for h in (step, -step)
                )
                slope = (up - down) / (2.0 * step)
                rounding = 1e-14 * np.maximum(np.abs(up), np.abs(down)) / step
                claim(
                    (np.abs(exact[:, column] - slope) <= 1e-5 * np.abs(slope) + rounding).all(),
                    f"{slot}: d/d {name} is {exact[:, column]}, {slope} by differences at {point}",
                )


def check_worked_examples(effect: Effect) -> None:
    """Its worked examples come out as they say."""
    wrong = wrong_examples(effect=effect)
    claim(not wrong, "; ".join(wrong))


SLOT_CHECKS = (check_off_leaves_slots_alone, check_slots_finite_at_all_bounds, check_slots_agree)
