"""Checks of what effects do over time: the claims that need a run from rest, and those of the drive.

The run drives the effect's own states by a given length and pressure over time. "Contribution" is the tension
with the effect minus without, as in claims.py.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass
from itertools import product

import numpy as np
from scipy.integrate import solve_ivp

from mckibben.application.effect.broken import claim
from mckibben.application.effect.states import (
    MUSCLE,
    SPEED,
    companions,
    defaults,
    grid,
)
from mckibben.physics.effect import Effect
from mckibben.physics.joint import JOINT_SLOTS
from mckibben.physics.model import Model, State


def check_nothing_without_history(effect: Effect) -> None:
    """With its states at rest it changes nothing of what the muscle does at a length and a pressure."""
    others = companions(effect)
    for sign in (-1.0, 0.0, 1.0):
        state = grid(sign=sign)
        got = Model((*others, effect)).evaluate(muscle=MUSCLE, values=defaults((*others, effect)), **state)
        want = Model(others).evaluate(muscle=MUSCLE, values=defaults(others), **state)
        for name in State._fields:
            claim(np.array_equal(getattr(got, name), getattr(want, name)), f"{name} differs")


@dataclass(frozen=True)
class Swing:
    """Length and pressure over time: L0 (0.9 + stretch sin wt) and P + swing sin(wt + phase)."""

    stretch: float = 0.0
    swing: float = 0.0
    mean_pressure: float = 3e5
    phase: float = 0.0
    period: float = 4.0
    cycles: int = 3

    def at(self, time: np.ndarray | float) -> dict[str, np.ndarray]:
        """What slots of the muscle may ask for."""
        w, t = 2.0 * math.pi / self.period, np.asarray(time)
        velocity = MUSCLE.nominal_length * self.stretch * w * np.cos(w * t)
        return {
            "length": MUSCLE.nominal_length * (0.9 + self.stretch * np.sin(w * t)),
            "velocity": velocity,
            "direction": np.sign(velocity),
            "pressure": self.mean_pressure + self.swing * np.sin(w * t + self.phase),
            "pressure_rate": self.swing * w * np.cos(w * t + self.phase),
        }


def run(
    effect: Effect,
    at: Callable[[float], Mapping[str, object]],
    time: np.ndarray,
    values: Mapping[str, float] | None = None,
    *,
    slot: str = "rates",
    tolerance: float = 1e-8,
) -> dict[str, np.ndarray]:
    """The effect's own states over time, from their start values, driven by what ``at(t)`` offers."""
    values = {**effect.defaults, **(values or {})}
    names = [state.name for state in effect.states]

    def rates(t: float, y: np.ndarray) -> list[float]:
        given = effect.call(slot, {"muscle": MUSCLE, **at(t)}, {**values, **dict(zip(names, y, strict=True))})
        return [float(rate) for rate in given]

    solution = solve_ivp(
        rates,
        (time[0], time[-1]),
        [state.initial for state in effect.states],
        method="LSODA",
        t_eval=time,
        rtol=tolerance,
        atol=np.array([0.1 * tolerance * state.scale for state in effect.states]),
        max_step=(time[-1] - time[0]) / 300.0,
    )
    claim(solution.success, solution.message)
    return dict(zip(names, solution.y, strict=True))


def driven(
    effect: Effect,
    swing: Swing,
    values: Mapping[str, float] | None = None,
    *,
    points: int = 1200,
    tolerance: float = 1e-8,
) -> tuple[np.ndarray, np.ndarray]:
    """Contribution to the read force [N] over a swing, and dL at the same rows, for the loop integral.

    Several claims look at the same run, and those that are false on purpose do so again: it is made once.
    """
    what = (effect.id, *effect.slots.items(), *effect.defaults.items(), effect.states)
    key = (what, swing, tuple(sorted((values or {}).items())), points, tolerance)
    if key not in _DRIVEN:
        _DRIVEN[key] = _driven(effect, swing, values, points=points, tolerance=tolerance)
    return _DRIVEN[key]


_DRIVEN: dict[Hashable, tuple[np.ndarray, np.ndarray]] = {}


def _driven(
    effect: Effect, swing: Swing, values: Mapping[str, float] | None, *, points: int, tolerance: float
) -> tuple[np.ndarray, np.ndarray]:
    time = np.linspace(0.0, swing.cycles * swing.period, swing.cycles * points + 1)
    states = run(effect, swing.at, time, values, tolerance=tolerance)
    others = companions(effect)
    state = {name: value for name, value in swing.at(time).items() if name != "pressure_rate"}
    own = {**effect.defaults, **(values or {}), **states}
    values_with = {**defaults(others), effect.id: own}
    with_it = Model((*others, effect)).evaluate(muscle=MUSCLE, values=values_with, **state)
    without = Model(others).evaluate(muscle=MUSCLE, values=defaults(others), **state)
    force = np.broadcast_to(with_it.force - without.force, time.shape)
    return force, np.gradient(state["length"]) * np.ones_like(time)


STRETCHED = Swing(stretch=0.08)
PRESSED = Swing(swing=2e5)
_LEAST = 1e-6  # N, what the tolerance of a run leaves


def check_mirrored_motion(effect: Effect) -> None:
    """Even: the same when every motion is mirrored. Odd: the opposite. Undeclared: neither."""
    pairs = []
    for swing, mirrored in ((STRETCHED, Swing(stretch=-0.08)), (PRESSED, Swing(swing=-2e5))):
        pairs.append((driven(effect, swing)[0], driven(effect, mirrored)[0]))
    scale = max(np.abs(force).max() for force, _ in pairs)
    claim(scale > _LEAST)
    even, odd = (max(np.abs(b - side * a).max() for a, b in pairs) <= 1e-5 * scale for side in (1.0, -1.0))
    claim((even, odd) == (effect.signature.direction == "even", effect.signature.direction == "odd"))


def check_power_over_run(effect: Effect) -> None:
    """At constant pressure in proportion to its declared power; undeclared: to none, or nothing shows."""
    pressures = (1e5, 2e5, 4e5)
    sizes = [np.abs(driven(effect, Swing(stretch=0.08, mean_pressure=p))[0]).max() for p in pressures]
    if max(sizes) <= _LEAST:
        claim(effect.signature.pressure_power is None)
        return
    powers = np.diff(np.log(sizes)) / np.diff(np.log(pressures))
    if effect.signature.pressure_power is None:
        claim(np.ptp(powers) > 1e-3)
    else:
        np.testing.assert_allclose(powers, effect.signature.pressure_power, atol=1e-6)


def check_shows_in_runs(effect: Effect) -> None:
    """Visible in the kinds it names, invisible in all others, and nothing without motion if it says so."""
    shown = {
        "isobaric": np.abs(driven(effect, STRETCHED)[0]).max(),
        "isometric": np.abs(driven(effect, PRESSED)[0]).max(),
        "isotonic": np.abs(driven(effect, Swing(stretch=-0.08, swing=2e5))[0]).max(),
        # A map has no history (check_nothing_without_history), and no state acts on the shape.
        "static": 0.0,
        "diameter": 0.0,
    }
    shown["transient"] = max(shown.values())
    for kind, size in shown.items():
        claim((kind in effect.kinds) == (size > _LEAST), f"{kind}: {size} N")
    claim(("no_motion" in effect.signature.zero_at) == (shown["isometric"] <= _LEAST))
    claim(set(effect.signature.zero_at) <= {"no_motion"}, "others are not checked for effects with states")


def check_work_of_run(effect: Effect) -> None:
    """Dissipative: no run from rest gains work, and none of its cycles. Lumped: some closed path does.

    Reading: it acts in the force sensor alone.
    """
    if effect.signature.energy == "reading":
        claim(set(effect.slots) == {"force_sensor", "rates"})
        return
    works = []
    for stretch, period, swing, phase in product((1e-3, 0.02, 0.1), (0.5, 20.0), (0.0, 2e5), (0.0, 2.0)):
        if phase and not swing:
            continue
        path = Swing(stretch=stretch, period=period, swing=swing, phase=phase)
        force, step = driven(effect, path, points=400, tolerance=1e-5)
        work = force * step
        scale = np.abs(work).sum()
        cycles = [part.sum() for part in np.array_split(work[1:], path.cycles)]
        works += [np.cumsum(work).min() / max(scale, 1e-12), *(cycle / max(scale, 1e-12) for cycle in cycles)]
    if effect.signature.energy == "dissipative":
        claim(min(works) >= -1e-3)
        claim(max(works) > 1e-3)
    else:
        claim(effect.signature.energy == "lumped")
        claim(min(works) < -1e-2)


def check_drive_claims(effect: Effect) -> None:
    """No claim on the force at a length and pressure; seen over time, and by slow tests only as a reading."""
    signature = effect.signature
    claim((signature.direction, signature.pressure_power, signature.zero_at) == (None, None, ()))
    slots = set(effect.slots)
    channels = {"force_reading", "pressure_reading", "stroke_reading", "skew"} & slots
    slow = {"isobaric", "isometric", "isotonic"} if channels else {"isotonic"} if "guide" in slots else set()
    claim(effect.kinds == ({"joint"} if slots <= JOINT_SLOTS else {"transient"} | slow))
    claim((signature.energy == "reading") == bool(channels))
    if "guide" in slots:
        for speed in (-1.0, -SPEED, SPEED, 1.0):
            context = {"stroke": 0.01, "speed": speed, "direction": math.copysign(1.0, speed), "load": 200.0}
            values = effect.defaults | _slid(effect, context, way=0.1)
            claim(effect.call("guide", context, values) * speed > 0.0)
        claim(signature.energy == "dissipative")


def _slid(effect: Effect, context: dict[str, float], *, way: float) -> dict[str, float]:
    """States of a guide after a way [m] at constant speed."""
    names = [state.name for state in effect.states]

    def rates(_: float, y: np.ndarray) -> list[float]:
        values = effect.defaults | dict(zip(names, y, strict=True))
        return [float(rate) for rate in effect.call("drive_rates", context, values)]

    if not names:
        return {}
    rest = [state.initial for state in effect.states]
    run = solve_ivp(rates, (0.0, way / abs(context["speed"])), rest, method="LSODA")
    return dict(zip(names, run.y[:, -1], strict=True))


RUN_CLAIMS = (
    check_nothing_without_history,
    check_mirrored_motion,
    check_power_over_run,
    check_shows_in_runs,
    check_work_of_run,
)
DRIVE_CLAIMS = (check_nothing_without_history, check_drive_claims)
