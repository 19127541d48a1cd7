"""The claims an effect makes, as checks that evaluate them; `checks_of` says which an effect is held to.

"Contribution" is the force as measured, with the effect minus without; muscle and states: states.py.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from itertools import product

import numpy as np
from latex2mathml.converter import convert
from scipy.optimize import brentq

from mckibben.application.effect import runs, slots
from mckibben.application.effect.broken import claim
from mckibben.application.effect.states import (
    FORCE_SCALE,
    LENGTHS,
    MUSCLE,
    PHASE_STEP,
    PRESSURES,
    SPEED,
    WARM,
    acts_on_muscle,
    an_elastomer,
    closed_path,
    companions,
    compiled,
    contribution,
    defaults,
    grid,
    numeric,
    predict_force,
    random_points,
)
from mckibben.physics import ideal
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.effect import Effect
from mckibben.physics.model import ROOM_TEMPERATURE, Model, State
from mckibben.physics.units import si


def check_off_is_ideal(effect: Effect) -> None:
    """At its off values the effect leaves every output as it is, to the last bit, whatever its states are."""
    claim(any(parameter.off is not None for parameter in effect.parameters))
    for others in ((), (an_elastomer(),)):
        if effect in others:
            continue
        for sign in (-1.0, 0.0, 1.0):
            state = grid(sign=sign) | {"temperature": WARM}
            states = {state.name: 0.7 * state.scale for state in effect.states}
            off = {**defaults(others), effect.id: effect.off | states}
            got = Model((*others, effect)).evaluate(muscle=MUSCLE, values=off, **state)
            want = Model(others).evaluate(muscle=MUSCLE, values=defaults(others), **state)
            for name in State._fields:
                claim(np.array_equal(getattr(got, name), getattr(want, name)), f"{name} differs")
    if "compliance" in effect.slots:
        state = grid(sign=0.0)
        off = predict_force((effect,), {effect.id: effect.off}, **state)
        np.testing.assert_allclose(off, predict_force((), {}, **state), rtol=1e-13, atol=1e-10)


def check_finite_at_all_bounds(effect: Effect) -> None:
    """Outputs and derivatives are finite at every corner of the bounds over the whole working range."""
    effects = (*companions(effect), effect)
    names, function = compiled(effects)
    others = [value for other in companions(effect) for value in other.defaults.values()]
    corners = list(product(*((p.lower, p.upper) for p in effect.parameters)))
    memories = [
        tuple(share * state.scale for share, state in zip(shares, effect.states, strict=True))
        for shares in memories_of(len(effect.states))
    ]
    motions = [(sign * SPEED, sign) for sign in (-1.0, 0.0, 1.0)]
    rows = np.array(
        [
            (length, pressure, *motion, WARM, *MUSCLE, *others, *corner, *memory)
            for length, pressure, motion, corner, memory in product(
                LENGTHS, PRESSURES, motions, corners, memories
            )
        ]
    )
    results = function(rows)
    labels = [*State._fields, *(f"dF/d {name}" for name in names)]
    bad = [label for label, column in zip(labels, results.T, strict=True) if not np.isfinite(column).all()]
    claim(not bad, f"not finite: {', '.join(bad)}")
    if "compliance" in effect.slots:
        for corner in corners:
            values = {effect.id: dict(zip(effect.defaults, corner, strict=True))}
            claim(np.isfinite(predict_force((effect,), values, **grid(sign=0.0))).all())


def memories_of(states: int) -> set[tuple[float, ...]]:
    """States at -1, 0 and 1 of their scale: every combination of up to three; of more, all alike but one."""
    shares = (-1.0, 0.0, 1.0)
    if states <= 3:
        return set(product(shares, repeat=states))
    return {
        (*(all_of,) * place, one, *(all_of,) * (states - 1 - place))
        for all_of, one, place in product(shares, shares, range(states))
    }


def check_numbers_and_symbols_agree(effect: Effect) -> None:
    """The same text gives the same numbers on numpy and on symbols, and exact derivatives."""
    effects = (*companions(effect), effect)
    names, function = compiled(effects)
    steps = {"length": 3e-7, "pressure": 10.0, "velocity": 1e-6, "temperature": 1e-3} | {
        f"{e.id}.{p.name}": 1e-6 * (p.upper - p.lower) for e in effects for p in e.parameters
    }
    steps |= {f"{e.id}.{state.name}": 1e-6 * state.scale for e in effects for state in e.states}
    for point in random_points(effects, 12):
        result = function(np.array([point[name] for name in names]))
        here = numeric(effects, point)
        for name, got in zip(State._fields, result, strict=False):
            scale = FORCE_SCALE if name in ("force", "tension") else abs(getattr(here, name))
            want = float(getattr(here, name))
            claim(abs(got - want) <= 1e-12 * max(scale, abs(want)), f"{name}: {got} on symbols, {want}")
        for name, exact in zip(names, result[len(State._fields) :], strict=True):
            if name == "direction":
                continue  # a sign, not a quantity to differentiate by
            step = steps.get(name, 1e-6 * point[name])
            up, down = ({**point, name: point[name] + sign * step} for sign in (1.0, -1.0))
            slope = (numeric(effects, up).force - numeric(effects, down).force) / (2.0 * step)
            # Forces of 1 kN carry a rounding of 1e-12 N, which a difference divides by its step.
            claim(
                abs(exact - slope) <= 1e-6 * abs(slope) + 1e-14 * FORCE_SCALE / step,
                f"dF/d {name}: {exact} symbolic, {slope} by differences at {point}",
            )


def check_area_is_volume_slope(effect: Effect) -> None:
    """The area in the force is -dV/dL at a fixed thread, so that force and gas balance cannot disagree."""
    state, step = grid(sign=0.0), 1e-6
    values = defaults([effect])

    def at(length: np.ndarray) -> State:
        return Model([effect]).evaluate(muscle=MUSCLE, values=values, **{**state, "length": length})

    area = at(state["length"]).area
    if "braid" in effect.slots:
        context = {"muscle": MUSCLE, "braid": MUSCLE.braid, **state}
        thread = effect.call("braid", context, effect.defaults)
        expected = ideal.area(braid=thread, length=state["length"])
    else:
        volumes = [at(state["length"] + sign * step).volume for sign in (1.0, -1.0)]
        expected = -(volumes[0] - volumes[1]) / (2.0 * step)
    np.testing.assert_allclose(area, expected, rtol=0.0, atol=2e-8 * np.abs(area).max())


def check_direction(effect: Effect) -> None:
    """Even: the same whichever way the muscle moves. Odd: the opposite. Undeclared: neither."""
    back, forth = (contribution(effect, **grid(sign=sign)) for sign in (-1.0, 1.0))
    even, odd = (np.abs(forth - side).max() <= 1e-12 * FORCE_SCALE for side in (back, -back))
    claim((even, odd) == (effect.signature.direction == "even", effect.signature.direction == "odd"))


def check_pressure_power(effect: Effect) -> None:
    """Proportional to the declared power of pressure at constant length; undeclared: to no power."""
    pressures = PRESSURES[PRESSURES > 0.0]
    got = contribution(effect, **grid(sign=1.0, pressures=pressures))
    power = effect.signature.pressure_power
    if power is not None:
        share = got / (pressures[:, None] / pressures[-1]) ** power
        np.testing.assert_allclose(
            share, np.broadcast_to(share[-1], share.shape), rtol=0, atol=1e-8 * FORCE_SCALE
        )
        return
    shown = np.abs(got[:, np.argmax(np.abs(got[-1]))])
    claim(shown.min() == 0.0 or np.ptp(np.diff(np.log(shown)) / np.diff(np.log(pressures))) > 1e-3)


_AT_FORCELESS_LENGTH = {"length": MUSCLE.braid.thread_length / math.sqrt(3.0), "pressure": PRESSURES}
_AT_NO_PRESSURE = {"length": LENGTHS, "pressure": 0.0}
ZERO_STATES: dict[str, list[dict]] = {
    "nominal_length": [{"length": MUSCLE.nominal_length, "pressure": PRESSURES}],
    "zero_force_length": [_AT_FORCELESS_LENGTH],
    "zero_pressure": [_AT_NO_PRESSURE],
    "shorter_than_nominal": [grid(lengths=LENGTHS[MUSCLE.nominal_length > LENGTHS], sign=0.0)],
    "longer_than_nominal": [grid(lengths=LENGTHS[MUSCLE.nominal_length < LENGTHS], sign=0.0)],
    "no_motion": [grid(sign=0.0)],
    "zero_force": [_AT_FORCELESS_LENGTH, _AT_NO_PRESSURE],
    "reference_temperature": [grid(sign=0.0) | {"temperature": ROOM_TEMPERATURE}],
}


def check_zero_states(effect: Effect) -> None:
    """Nothing is left of the effect where it says so, moving or not."""
    for name in effect.signature.zero_at:
        for state in ZERO_STATES[name]:
            for sign in (0.0,) if name == "no_motion" else (-1.0, 0.0, 1.0):
                motion = {"velocity": sign * SPEED, "direction": sign}
                left = np.abs(contribution(effect, **{**state, **motion})).max()
                claim(left <= 1e-12 * FORCE_SCALE, f"{left} N at {name}")


def _isotonic_change(effect: Effect, *, contraction: float, pressure: float, sign: float) -> float:
    """Change of length [m] at the load that the muscle with the effect holds at this contraction."""
    state = {"pressure": pressure, "velocity": sign * SPEED, "direction": sign, "temperature": WARM}
    others = companions(effect)

    def force(effects: Sequence[Effect], length: float) -> float:
        return float(predict_force(effects, defaults(effects), length=length, **state))

    load = force((*others, effect), MUSCLE.nominal_length * (1.0 - contraction))
    low, high = 0.5 * MUSCLE.nominal_length, 1.05 * MUSCLE.nominal_length
    held = [
        brentq(lambda length, chosen=chosen: force(chosen, length) - load, low, high, xtol=1e-14)
        for chosen in (others, (*others, effect))
    ]
    return abs(held[1] - held[0])


def _shows_in(effect: Effect) -> dict[str, float]:
    """Per kind, the largest change of what it predicts, relative to its scale.

    An isometric record is taken without motion, a static map point by point with a known direction, isobaric
    and isotonic records in motion. A transient reveals what any of the force and length kinds reveals.
    """
    others = companions(effect)
    moving = max(np.abs(contribution(effect, **grid(sign=sign))).max() for sign in (-1.0, 1.0)) / FORCE_SCALE
    mapped = max(
        np.abs(contribution(effect, **grid(sign=sign) | {"velocity": 0.0})).max() for sign in (-1.0, 1.0)
    )
    # A stretched muscle, one in the middle of its range, and one near the end of it.
    held = ((-0.005, 6e5), (0.1, 3e5), (0.22, 6e5))
    lengths = [
        _isotonic_change(effect, contraction=contraction, pressure=pressure, sign=sign)
        for (contraction, pressure), sign in product(held, (-1.0, 1.0))
    ]
    state = grid(sign=0.0) | {"temperature": WARM}
    diameters = [
        np.asarray(Model(chosen).evaluate(muscle=MUSCLE, values=defaults(chosen), **state).diameter)
        for chosen in (others, (*others, effect))
    ]
    shown = {
        "isobaric": moving,
        "isometric": np.abs(contribution(effect, **grid(sign=0.0))).max() / FORCE_SCALE,
        "isotonic": max(lengths) / MUSCLE.nominal_length,
        "diameter": np.abs(diameters[1] - diameters[0]).max() / MUSCLE.braid_diameter,
        "static": mapped / FORCE_SCALE,
    }
    return shown | {"transient": max(shown[kind] for kind in ("isobaric", "isometric", "isotonic", "static"))}


def check_kinds(effect: Effect) -> None:
    """Visible in exactly the measurement kinds it names, and exactly invisible in the others.

    What acts on the muscle shows at a joint as well, and does not name it.
    """
    shown = _shows_in(effect)
    claim("joint" not in effect.kinds, "names joint, where only effects of the joint itself add anything")
    for kind in shown:
        if kind in effect.kinds:
            claim(shown[kind] > 1e-9, f"names {kind}, where nothing of it shows")
        else:
            claim(shown[kind] == 0.0, f"does not name {kind}, where {shown[kind]:.1e} of scale shows")


def check_energy(effect: Effect) -> None:
    """Conservative: the closed integral of F dL + P dV vanishes. Dissipative: no motion gains work.

    Work of the gas is taken as the integral of -V dP, the same over a closed path. A lumped effect must fail
    the conservative test, or it should be declared conservative. Readings move no energy: the tension is that
    of the ideal muscle at the true length.
    """
    state, length_rate, pressure_rate = closed_path()
    if effect.signature.energy in ("conservative", "lumped"):
        effects = (*companions(effect), effect)
        for own in (effect.defaults, {parameter.name: parameter.upper for parameter in effect.parameters}):
            values = {**defaults(effects), effect.id: own}
            got = Model(effects).evaluate(muscle=MUSCLE, values=values, **state)
            work = np.sum(got.tension * length_rate - got.volume * pressure_rate) * PHASE_STEP
            scale = np.sum(np.abs(got.tension * length_rate)) * PHASE_STEP
            closes = abs(work) <= 1e-6 * scale
            claim(closes == (effect.signature.energy == "conservative"), f"{work / scale:.1e} at {own}")
    elif effect.signature.energy == "dissipative":
        for sign in (-1.0, 1.0):
            claim((sign * contribution(effect, **grid(sign=sign))).min() >= 0.0)
        claim(np.sum(contribution(effect, **state) * length_rate) * PHASE_STEP > 0.0)
    else:
        got = Model([effect]).evaluate(muscle=MUSCLE, values=defaults([effect]), **grid(sign=1.0))
        at_true = {**grid(sign=1.0), "length": got.length}
        if "pressure_sensor" not in effect.slots:
            claim(np.array_equal(got.tension, Model().evaluate(muscle=MUSCLE, values={}, **at_true).tension))


def check_texts(effect: Effect) -> None:
    """Its texts are there, its formulas can be shown, its units can be typed."""
    for text in (effect.title, effect.cause, effect.signature.text):
        claim(text.strip() == text and len(text) > 3, f"a text is missing or has blanks around it: {text!r}")
    claim(_TWO_SENTENCES.fullmatch(effect.cause), f"the cause is two sentences: {effect.cause}")
    for latex in (effect.equation, *(parameter.symbol for parameter in effect.parameters)):
        claim(convert(latex).startswith("<math"), f"no LaTeX: {latex}")
    for parameter in effect.parameters:
        claim(parameter.description.endswith("."), f"{parameter.name}: the description is no sentence")
        text = "0.5" if parameter.unit == "1" else f"0.5 {parameter.unit}"
        claim(si(text, parameter.unit) == 0.5, f"{parameter.name}: nobody can type the unit {parameter.unit}")
    for slot, function in effect.slots.items():
        claim(function.__doc__, f"the function of the slot {slot} has no docstring")
        claim(getattr(function, "__globals__", {}).get("__doc__"), "the file has no docstring")


def check_shows_at_its_default(effect: Effect) -> None:
    """Its default is not the value at which it is off, and a fit may change something of it."""
    claim(effect.defaults != effect.off, "the defaults are the values at which it is off")
    claim(any(parameter.fitted for parameter in effect.parameters), "no parameter is fitted")


def check_twins_are_separable(effect: Effect) -> None:
    """What it is confused with is another known effect, and an experiment separates both."""
    for twin in effect.confused_with:
        claim(twin.effect in default_catalogue(), f"there is no effect {twin.effect} to be confused with")
        claim(twin.effect != effect.id, "it is confused with itself")
        claim(len(twin.separated_by) > 10, f"nothing is said to separate it from {twin.effect}")


_TWO_SENTENCES = re.compile(r"[^.]+\. [^.]+\.|(?:[^.]|\.\d)+\. (?:[^.]|\.\d)+\.")
Check = Callable[[Effect], None]
_DECLARED: tuple[Check, ...] = (check_texts, check_shows_at_its_default, check_twins_are_separable)
_ON_THE_MUSCLE: tuple[Check, ...] = (
    check_finite_at_all_bounds,
    check_numbers_and_symbols_agree,
    check_area_is_volume_slope,
)
_STATIC_CLAIMS: tuple[Check, ...] = (
    check_direction,
    check_pressure_power,
    check_zero_states,
    check_kinds,
    check_energy,
)


def checks_of(effect: Effect) -> tuple[Check, ...]:
    """What an effect is held to: one form for all; claims at rest, in a run from rest, or on the drive."""
    common = (*_DECLARED, check_off_is_ideal, slots.check_worked_examples)
    if not acts_on_muscle(effect):
        return (*common, *slots.SLOT_CHECKS, *runs.DRIVE_CLAIMS)
    if not effect.states:
        return (*common, *_ON_THE_MUSCLE, *_STATIC_CLAIMS)
    return (*common, *_ON_THE_MUSCLE, *slots.SLOT_CHECKS, *runs.RUN_CLAIMS)
