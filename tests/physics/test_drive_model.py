"""The drive's equations take every effect, alone and all at once, and stay finite and exact."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import pytest
import symengine as se

from mckibben.application.effect.states import MUSCLE
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.drive import DriveModel
from mckibben.physics.drive_terms import COUNTER, OUTPUTS, DriveStructure
from mckibben.physics.effect import Effect
from mckibben.physics.record_model import RecordModel
from mckibben.simulation.integrate.machine_code import Function, Writer, engine_of, machine_code, texts_of

CATALOGUE = default_catalogue()
EFFECTS = list(CATALOGUE.values())
PLAIN = ("speed", "pressure", "supplied", "vented", "stroke")

CONSTANTS = {
    "supply_pressure": 7e5,
    "ambient_pressure": 1e5,
    "ambient_temperature": 293.15,
    "fill_conductance": 1e-8,
    "fill_ratio": 0.3,
    "exhaust_conductance": 1.2e-8,
    "exhaust_ratio": 0.35,
    "regulator_range": 6e5,
    "regulator_time": 0.02,
    "regulator_damping": 0.7,
    "regulator_band": 3e4,
    "regulator_dead_band": 600.0,
    "filling_restriction": 6e-9,
    "filling_restriction_ratio": 0.25,
    "venting_restriction": 1.0,
    "venting_restriction_ratio": 0.25,
    "quick_exhaust_conductance": 3e-8,
    "quick_exhaust_ratio": 0.35,
    "quick_exhaust_band": 1e4,
    "tube_volume": 1.2e-5,
    "tube_conductance": 1.2e-8,
    "tube_ratio": 0.3,
    "fitting_volume": 2e-6,
    "polytropic_exponent": 1.4,
    "mass": 10.0,
    "own_mass": 0.1,
    "gravity": 9.80665,
    "spring": 100.0,
    "lever_ratio": 1.0,
    "precontraction": 0.0,
    "stop_low": 0.0,
    "stop_high": 0.08,
    "slack_damping": 2.0,
    "wall_heat_transfer": 0.0,
}
INPUTS = {
    "opening": 0.6,
    "opening_slope": 0.0,
    "counter_opening": -0.6,
    "counter_opening_slope": 0.0,
    "external_force": 5.0,
    "external_force_slope": 0.0,
    "begin": 0.0,
}
STATES = {
    "stroke": 0.03,
    "length": MUSCLE.nominal_length - 0.03,
    "speed": 0.2,
    "pressure": 4e5,
    "supplied": 1e-4,
    "vented": 0.0,
    "clock": 0.1,
    "tube_pressure": 5e5,
    "regulator_pressure": 5.5e5,
}


def numbers(
    model: DriveModel, values: dict[str, dict[str, float]], *, share: float = 0.3, **changed: float
) -> dict[se.Symbol, float]:
    """Every symbol of the model at a plausible state; states of effects at a share of their scale."""
    table = {**CONSTANTS, **MUSCLE._asdict()}
    table |= {f"{effect}.{name}": value for effect, own in values.items() for name, value in own.items()}
    # The gas at ambient temperature.
    states = {"gas_mass": 4e5 * 1.3e-4 / (287.05 * 293.15), **STATES, **changed}
    numbers = {symbol: table[name] for name, symbol in model.parameters.items()}
    numbers |= {symbol: INPUTS[name] for name, symbol in model.inputs.items()}
    rising = states["speed"]
    numbers |= {switch.symbol: float(switch.slides * rising > 0.0) for switch in model.switches}
    for state in model.states:
        own = state.name.removesuffix(COUNTER)
        numbers[model.symbols[state.name]] = states.get(own, share * state.scale)
    return numbers


def evaluate(expressions: list[se.Basic], at: dict[se.Symbol, float]) -> np.ndarray:
    return se.Lambdify(list(at), expressions, backend="llvm", cse=True)(np.array(list(at.values())))


def defaults(effects: Iterable[Effect]) -> dict[str, dict[str, float]]:
    return {effect.id: effect.defaults for effect in effects}


def jacobian(model: DriveModel | RecordModel) -> list[se.Basic]:
    """The derivatives that are not zero at first sight."""
    return [
        rate.diff(symbol)
        for rate in model.rates
        for symbol in rate.free_symbols & set(model.symbols.values())
    ]


@pytest.mark.parametrize("effect", EFFECTS, ids=[effect.id for effect in EFFECTS])
def test_every_effect_alone_gives_finite_equations_that_vanish_when_off(effect: Effect) -> None:
    without, model = (
        DriveModel(DriveStructure((), tube=True, polytropic=True)),
        DriveModel(DriveStructure((effect,), tube=True, polytropic=True)),
    )
    expressions = [*model.rates, *model.outputs, *jacobian(model)]
    for share, speed in ((0.3, 0.2), (0.0, 0.0), (1.0, -0.5)):
        at = numbers(model, defaults([effect]), share=share, speed=speed)
        assert np.isfinite(evaluate(expressions, at)).all()

    heated = "gas_mass" in model.symbols
    at = numbers(model, {effect.id: effect.off}, share=0.0)
    plain = numbers(without, {})
    if heated:  # off is an adiabatic chamber; the plain one has the exponent 1.4 here, and its temperature
        volume = evaluate(model.outputs, at)[OUTPUTS.index("volume")]
        at[model.symbols["gas_mass"]] = 4e5 * volume / (287.05 * 293.15)
    names = [state.name for state in model.states]
    got = evaluate([model.rates[names.index(name)] for name in PLAIN] + model.outputs, at)
    names = [state.name for state in without.states]
    want = evaluate([without.rates[names.index(name)] for name in PLAIN] + without.outputs, plain)
    np.testing.assert_allclose(got, want, rtol=1e-9, atol=1e-12)


def everything(*, tube: bool, regulator: bool, pair: bool) -> DriveModel:
    """A drive with all effects at once."""
    on_muscle = {"flow_control": True, "quick_exhaust": tube}
    return DriveModel(DriveStructure(tuple(EFFECTS), tube=tube, regulator=regulator, pair=pair, **on_muscle))


PLACES = ((0.3, 0.2), (0.0, 0.0), (-1.0, -0.3))


def test_all_effects_at_once_give_a_finite_jacobian() -> None:
    """With numbers for all but states and switches, in code without common parts: both save a minute."""
    model = everything(tube=False, regulator=True, pair=False)
    assert len(model.rates) == len(model.states)
    free = set().union(*(expression.free_symbols for expression in [*model.rates, *model.outputs]))
    switches = {switch.symbol for switch in model.switches}
    assert free <= {*model.symbols.values(), *model.parameters.values(), *model.inputs.values(), *switches}
    moving = [*model.symbols.values(), *switches]
    values = defaults(EFFECTS)
    first, *others = [numbers(model, values, share=share, speed=speed) for share, speed in PLACES]
    fixed = {symbol: value for symbol, value in first.items() if symbol not in moving}
    rates = [rate.subs(fixed) for rate in model.rates]
    slopes = [rate.diff(symbol) for rate in rates for symbol in rate.free_symbols & {*model.symbols.values()}]
    assert len(slopes) > 15 * len(rates)  # of all pairs of states a third are coupled
    expressions = [*rates, *(output.subs(fixed) for output in model.outputs), *slopes]
    code = engine_of(texts_of({"all": (moving, expressions)}, Writer, quick=True), 0)
    function = Function(code, "all", len(moving), len(expressions))
    for at in (first, *others):
        assert np.isfinite(function(np.array([at[symbol] for symbol in moving], dtype=float))).all()


@pytest.mark.examination("test_all_effects_at_once_give_a_finite_jacobian")
@pytest.mark.parametrize(("tube", "regulator", "pair"), [(False, True, False), (True, False, True)])
def test_all_effects_at_once_give_a_finite_jacobian_as_runs_compile_it(
    tube: bool, regulator: bool, pair: bool
) -> None:
    model = everything(tube=tube, regulator=regulator, pair=pair)
    expressions = [*model.rates, *model.outputs, *jacobian(model)]
    function = None
    for share, speed in PLACES:
        at = numbers(model, defaults(EFFECTS), share=share, speed=speed)
        function = function or machine_code({"all": (list(at), expressions)})["all"]
        assert np.isfinite(function(np.array(list(at.values()), dtype=float))).all()


@pytest.mark.parametrize(
    "motion",
    [
        False,
        pytest.param(
            True, marks=pytest.mark.examination("test_all_effects_at_once_with_the_muscle_measured")
        ),
    ],
)
def test_all_effects_at_once_with_the_muscle_measured(motion: bool) -> None:
    model = RecordModel(tuple(EFFECTS), motion=motion)
    expressions = [*model.rates, *model.outputs, *jacobian(model)]
    table = {**CONSTANTS, **MUSCLE._asdict(), "temperature": 293.15}
    table |= {f"{effect.id}.{p.name}": p.default for effect in EFFECTS for p in effect.parameters}
    measured = {
        "pressure": 3e5,
        "pressure_slope": 1e5,
        "length": 0.27,
        "length_slope": -0.1,
        "direction": -1.0,
    }
    at = {symbol: table[name] for name, symbol in model.parameters.items()}
    at |= {symbol: (measured | INPUTS)[name] for name, symbol in model.inputs.items()}
    at |= {switch.symbol: 0.0 for switch in model.switches}
    for share in (0.0, 0.3, -1.0):
        at |= {model.symbols[s.name]: STATES.get(s.name, share * s.scale) for s in model.states}
        assert np.isfinite(evaluate(expressions, at)).all()


def test_settled_states_have_a_rest() -> None:
    """Their rates are linear in them, so a column of differences for each gives where all are zero."""
    effects = [effect for effect in EFFECTS if any(state.settled for state in effect.states)]
    assert effects
    model = DriveModel(DriveStructure(tuple(effects)))
    names = [state.name for state in model.states]
    settled = [state for state in model.states if state.settled]
    rates = [model.rates[names.index(state.name)] for state in settled]

    def at(values: Iterable[float]) -> np.ndarray:
        changed = dict(zip((state.name for state in settled), values, strict=True))
        return evaluate(rates, numbers(model, defaults(effects), **changed))

    scales = np.array([state.scale for state in settled])
    zero = at(0.0 * scales)
    columns = np.column_stack([at(column) - zero for column in np.diag(scales)])
    for share in (-1.0, 0.7):
        np.testing.assert_allclose(at(share * scales), zero + share * columns.sum(axis=1), rtol=1e-9)
    rest = scales * np.linalg.lstsq(columns, -zero, rcond=None)[0]
    assert np.abs(at(rest)).max() <= 1e-9 * np.abs(zero).max()
