"""Exact derivatives against central differences of the prediction, and lengths and diameters by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.comparable_rows import ComparableRows, comparable_rows
from mckibben.identification.predict.fit_model import LOAD, FitModel, Free, free_numbers
from mckibben.identification.predict.memory import Memory, remembers
from mckibben.identification.predict.quasistatic import QuasistaticPredictor, _corners, with_corners
from mckibben.identification.predict.sensor_dynamics import as_read
from mckibben.measurement.reading import read_measurement
from mckibben.physics import ideal
from mckibben.physics.errors import InputError
from tests.identification.synthetic import (
    CATALOGUE,
    MUSCLE,
    csv,
    cycles,
    diameter,
    force_map,
    length_under,
)

DELAYS = ("sensor_lag", "time_skew")
REMEMBERING = sorted(name for name, effect in CATALOGUE.items() if remembers(effect))

STEP = 0.07  # time between two rows [s]
DELAY = 0.03
ROWS = np.arange(90) * STEP
LAG = FitModel(MUSCLE).adding(CATALOGUE["time_skew"], {"delay": DELAY})


def fit_model(*ids: str, **values: dict[str, float]) -> FitModel:
    """A model with effects at their defaults, or at values."""
    chosen = tuple(CATALOGUE[name] for name in (*ids, *values))
    return FitModel(MUSCLE, chosen, {e.id: e.defaults | values.get(e.id, {}) for e in chosen})


def numbers(model: FitModel, names: list[str]) -> list[Free]:
    """Named numbers as free ones, wide bounds."""
    found = []
    for name in names:
        here = model.number(name)
        effect, _, parameter = name.partition(".")
        unit = CATALOGUE[effect].parameter(parameter).unit if parameter else "m"
        found.append(Free(name, here, -1e9, 1e9, unit))
    return found


def step_of(model: FitModel, name: str) -> float:
    effect, _, parameter = name.partition(".")
    if not parameter:
        return 1e-3 if name == LOAD else 1e-6
    declared = CATALOGUE[effect].parameter(parameter)
    return 1e-5 * (declared.upper - declared.lower)


def central(predictor: QuasistaticPredictor, model: FitModel, name: str, step: float) -> np.ndarray:
    """Central difference of the prediction."""
    ends = [
        predictor.predict(model.with_numbers([name], [model.number(name) + sign * step]), clipped=False)
        for sign in (1, -1)
    ]
    return (ends[0] - ends[1]) / (2 * step)


def assert_alike(exact: np.ndarray, expected: np.ndarray, tolerance: float, digits: float = 1e-12) -> None:
    """``digits``: what a difference may show where nothing changes."""
    scale = np.max(np.abs(expected)) + digits
    np.testing.assert_allclose(exact / scale, expected / scale, atol=tolerance)


def mapped() -> QuasistaticPredictor:
    """A map whose rows move both ways, warm: everything has something to act on."""
    task = comparable_rows(force_map(c10=0.4e6), MUSCLE)
    state = {
        **task.state,
        "direction": np.where(np.arange(60) % 2, 1.0, -1.0),
        "velocity": np.full(60, 0.02),
        "temperature": np.full(60, 310.0),
    }
    return QuasistaticPredictor(replace(task, state=state))


@pytest.mark.parametrize("effect", sorted(set(CATALOGUE) - set(DELAYS) - set(REMEMBERING)))
def test_exact_gradient_of_every_effect_is_the_central_difference(effect):
    predictor = mapped()
    # The elastomer gives the temperature something to act on, the compliance tests the implicit derivative.
    model = fit_model(*dict.fromkeys(("bladder_elasticity", "rig_compliance", effect)))
    names = [*(f"{effect}.{p.name}" for p in CATALOGUE[effect].parameters), "braid_angle", "nominal_length"]
    predicted, exact = predictor.linearised(model, numbers(model, names))
    np.testing.assert_allclose(predicted, predictor.predict(model, clipped=False), rtol=1e-9, atol=1e-7)
    assert exact.shape == (60, len(names))
    for column, name in enumerate(names):
        assert_alike(exact[:, column], central(predictor, model, name, step_of(model, name)), 2e-4)


@pytest.mark.parametrize("effect", REMEMBERING)
def test_gradient_of_effects_with_memory_is_the_central_difference(effect):
    """Exact, but for the numbers of a memory's own rates: those to a few percent."""
    predictor = predictor_of(cycles(c10=0.4e6, each=40), MUSCLE)
    assert isinstance(predictor, QuasistaticPredictor)
    model = fit_model("bladder_elasticity", "rig_compliance", effect)
    wanted = CATALOGUE[effect].wanted("rates")
    for p in CATALOGUE[effect].parameters:
        name = f"{effect}.{p.name}"
        exact = predictor.linearised(model, numbers(model, [name]))[1][:, 0]
        if p.name not in wanted:
            assert_alike(exact, central(predictor, model, name, step_of(model, name)), 2e-4)
            continue
        expected = central(predictor, model, name, 2e-3 * max(abs(model.number(name)), 0.01 * p.upper))
        size = np.sqrt(np.mean(expected**2))
        assert np.sqrt(np.mean((exact - expected) ** 2)) < 0.05 * size + 1e-6, (
            name
        )  # a micronewton is the integration's


@pytest.mark.parametrize("effect", REMEMBERING)
def test_braid_angle_beside_memory(effect):
    predictor = predictor_of(cycles(c10=0.4e6, each=40), MUSCLE)
    assert isinstance(predictor, QuasistaticPredictor)
    model = fit_model("bladder_elasticity", effect)
    exact = predictor.linearised(model, numbers(model, ["braid_angle"]))[1][:, 0]
    assert_alike(exact, central(predictor, model, "braid_angle", 1e-6), 2e-3)


@pytest.mark.parametrize("effect", DELAYS)
def test_delayed_sensors_are_differenced_and_the_rest_taken_at_once(effect):
    predictor = predictor_of(cycles(c10=0.4e6, each=40, levels=(4e5, 5e5, 6e5)), MUSCLE)
    assert isinstance(predictor, QuasistaticPredictor)
    first = CATALOGUE[effect].parameters[0].name
    model = fit_model("bladder_elasticity", **{effect: {first: 0.02}})
    names = [f"{effect}.{first}", "bladder_elasticity.shear_modulus"]
    predicted, gradient = predictor.linearised(model, free_numbers(model)[::-1])
    order = [p.name for p in free_numbers(model)[::-1]]
    np.testing.assert_allclose(predicted, predictor.predict(model, clipped=False))
    for name in names:
        expected = central(predictor, model, name, 1e-2 * model.number(name))
        got = gradient[:, order.index(name)]
        size = np.sqrt(np.mean(expected**2))
        assert np.sqrt(np.mean((got - expected) ** 2)) < 0.05 * size, name


def test_a_skew_is_a_shift_of_the_force():
    """Of a force that is linear in time F(t) = a + b t a delay d takes b d away."""
    rows = [
        f"{t:.3f},{1e5 * (2 + t):.10g},{0.28 + 1e-9 * (k % 2)},{100 + t}"
        for k, t in enumerate(np.linspace(0.0, 2.0, 81))
    ]
    predictor = predictor_of(csv(rows, "time_s,pressure_Pa,length_m,force_N", "kind: isometric"), MUSCLE)
    prompt, late = fit_model(), fit_model(time_skew={"delay": 0.05})
    change = predictor.predict(late) - predictor.predict(prompt)
    time = predictor.inputs["time"]
    slope = np.ptp(predictor.predict(prompt)) / np.ptp(time)
    begun = time > 0.25
    assert np.count_nonzero(begun) > 60
    assert change[begun] == pytest.approx(np.full(np.count_nonzero(begun), -0.05 * slope), rel=1e-3)


def isotonic(*conditions: str, load: float = 250.0) -> QuasistaticPredictor:
    """Lengths of the ideal muscle under a load at nine pressures."""
    rows = [f"{p / 1e5},{1e3 * length_under(load, p)}" for p in np.linspace(3e5, 6e5, 9)]
    predictor = predictor_of(csv(rows, "pressure_bar,length_mm", "kind: isotonic", *conditions), MUSCLE)
    assert isinstance(predictor, QuasistaticPredictor)
    return predictor


@pytest.mark.parametrize(
    "effect",
    ["bladder_elasticity", "prestress", "pressure_offset", "length_offset", "load_scale", "end_caps"],
)
def test_gradient_of_a_length_under_load(effect):
    predictor = isotonic("load_force: 250 N")
    model = fit_model(*dict.fromkeys(("bladder_elasticity", effect)))
    names = [*(f"{effect}.{p.name}" for p in CATALOGUE[effect].parameters), "braid_angle", "braid_diameter"]
    predicted, exact = predictor.linearised(model, numbers(model, names))
    assert predicted == pytest.approx(predictor.predict(model), abs=1e-9)
    for column, name in enumerate(names):
        step = step_of(model, name)
        # Lengths of 0.3 m have errors of 1e-16 m, each of them another one.
        assert_alike(exact[:, column], central(predictor, model, name, step), 1e-3, digits=1e-12 / step)


def test_length_under_an_unknown_load():
    predictor = isotonic()
    assert predictor.unknown_load is not None
    model = replace(fit_model(), load=180.0)
    expected = [length_under(180.0, p) for p in predictor.task.state["pressure"]]
    assert predictor.predict(model) == pytest.approx(expected, abs=1e-8)
    load = Free(LOAD, 180.0, 0.0, 1e3, "N")
    exact = predictor.linearised(model, [load])[1][:, 0]
    # dL/dW = 1/(dF/dL): more load, longer
    slope = [(length_under(180.5, p) - length_under(179.5, p)) for p in predictor.task.state["pressure"]]
    assert exact == pytest.approx(slope, rel=1e-3)
    assert np.all(exact > 0.0)


@pytest.mark.parametrize(
    ("effect", "values"),
    [
        ("coulomb_friction", {"force": 40.0}),
        ("guide_friction", {"force": 15.0, "load_share": 0.1}),  # of 250 N
    ],
)
def test_dry_friction_holds_a_length_between_two_branches(effect, values):
    """Pressure up and down under a load: the length follows one branch, sticks, and follows the other."""
    pressure = np.concatenate([np.linspace(3e5, 6e5, 31), np.linspace(5.9e5, 3e5, 30)])
    branches = {sign: np.array([length_under(250.0 + sign * 40.0, p) for p in pressure]) for sign in (1, -1)}
    # Shortening the muscle pulls the load and the friction, lengthening the friction helps.
    short, long = np.minimum(branches[1], branches[-1]), np.maximum(branches[1], branches[-1])
    expected = [float(long[0])]
    for low, high in zip(short[1:], long[1:], strict=True):
        expected.append(min(max(expected[-1], low), high))
    rows = [
        f"{0.5 * k},{p / 1e5:.10g},{1e3 * length:.10g}"
        for k, (p, length) in enumerate(zip(pressure, expected, strict=True))
    ]
    predictor = predictor_of(
        csv(rows, "time_s,pressure_bar,length_mm", "kind: isotonic", "load_force: 250 N"), MUSCLE
    )
    model = fit_model(**{effect: values})
    found = predictor.predict(model)
    assert found[1:] == pytest.approx(predictor.measured[1:], abs=1e-6)
    assert np.ptp(found[31:34]) < 1e-9  # it sticks at the turn
    assert isinstance(predictor, QuasistaticPredictor)
    for name in values:
        named = f"{effect}.{name}"
        gradient = predictor.linearised(model, numbers(model, [named]))[1][:, 0]
        step = 1e-3 * values[name]
        assert_alike(gradient[2:], central(predictor, model, named, step)[2:], 1e-2)


def test_a_load_beyond_the_braid_lock_ends_there():
    predictor = isotonic("load_force: 50 kN")
    assert predictor.predict(fit_model()) == pytest.approx(0.9999 * float(MUSCLE.braid.thread_length))


def test_diameters_of_free_and_of_measured_lengths():
    rows = [f"{p / 1e5},{1e3 * diameter(length_under(0.0, p, c10=0.4e6))}" for p in np.linspace(2e5, 6e5, 7)]
    predictor = predictor_of(csv(rows, "pressure_bar,diameter_mm", "kind: diameter"), MUSCLE)
    assert isinstance(predictor, QuasistaticPredictor)
    model = fit_model(bladder_elasticity={"shear_modulus": 0.4e6})
    assert predictor.unit == "m"
    assert np.max(np.abs(predictor.predict(model) - predictor.measured)) < 1e-6
    names = ["bladder_elasticity.shear_modulus"]
    exact = predictor.linearised(model, free_numbers(model))[1][:, 0]
    assert_alike(exact, central(predictor, model, names[0], 1e2), 1e-2)


def test_what_data_can_reveal():
    ordered = predictor_of(cycles(), MUSCLE)
    grid = predictor_of(force_map(), MUSCLE)
    lifted = isotonic("load_force: 250 N")
    for name in (*REMEMBERING, *DELAYS):
        assert grid.why_hidden(CATALOGUE[name]), name  # a map has no order in time
        assert (not ordered.why_hidden(CATALOGUE[name])) == ("isobaric" in CATALOGUE[name].kinds), name
    assert not ordered.why_hidden(CATALOGUE["prestress"])
    assert ordered.why_hidden(CATALOGUE["dead_volume"])
    assert not lifted.why_hidden(CATALOGUE["rig_compliance"])


def test_a_trial_in_the_wide_structure_is_the_prediction():
    predictor = mapped()
    model = fit_model(bladder_elasticity={"shear_modulus": 0.5e6})
    before = predictor.trial(model)
    predictor = predictor.prepared(model, [e for e in CATALOGUE.values() if not predictor.why_hidden(e)])
    assert predictor.trial(model) == pytest.approx(before, abs=1e-7)
    further = model.adding(CATALOGUE["prestress"], {"force": 50.0})
    assert predictor.trial(further) == pytest.approx(before - 50.0, abs=1e-7)


def test_rows_that_cannot_be_used_are_counted_or_refused():
    rows = ["3,280,150", "3,290,300", "3,345,450"]
    predictor = predictor_of(csv(rows, "pressure_bar,length_mm,force_N", "kind: static"), MUSCLE)
    assert predictor.excluded == {"beyond the braid lock": 1}
    assert predictor.rows_used == 2
    none = csv(["3,345,150", "4,346,300"], "pressure_bar,length_mm,force_N", "kind: static")
    with pytest.raises(InputError, match="no row can be compared") as error:
        predictor_of(none, MUSCLE)
    assert error.value.field == "measurement"


def slack_rows(pull: float, zero: float = 0.0) -> QuasistaticPredictor:
    """Readings beyond the free contraction of the braid (ideal: 35 %): 0.5 N of noise about a zero.

    ``pull``: force that grows with the pressure [N at 4 bar], as of a muscle that does pull a little.
    """
    rng = np.random.default_rng(11)
    rows = [
        f"{p},{kappa:.4f},{zero + pull * p / 4e5 + rng.normal(0.0, 0.5):.4f}"
        for p in (1e5, 2e5, 3e5, 4e5)
        for kappa in np.linspace(0.37, 0.42, 8)
    ]
    return predictor_of(csv(rows, "pressure_Pa,contraction,force_N", "kind: static"), MUSCLE)


@pytest.mark.parametrize("zero", [0.0, 4.0])
def test_a_muscle_that_is_slack_throughout_is_compared_as_slack(zero: float) -> None:
    """It would push by up to 150 N if it could; what its cell reads is its zero, however a fit goes on."""
    predictor, model = slack_rows(0.0, zero), fit_model()
    values, slopes = predictor.linearised(model, numbers(model, ["nominal_length"]))
    assert np.max(np.abs(values)) == 0.0
    assert not slopes.any()
    offset = fit_model(force_offset={"offset": zero})
    assert predictor.predict(offset) == pytest.approx(predictor.linearised(offset, [])[0])


def test_a_small_force_that_follows_the_pressure_is_no_slack_muscle() -> None:
    predictor, model = slack_rows(5.0), fit_model()
    values, _ = predictor.linearised(model, [])
    assert np.min(values) < -50.0  # a fit has to see how far the model is away


def pressure(time: np.ndarray) -> np.ndarray:
    """Ramps and holds between 1 and 4 bar; their corners lie anywhere between rows [Pa]."""
    return 1e5 * np.interp(time, [0.0, 0.5, 1.53, 2.61, 3.31, 4.44, 5.0, 6.3], [1, 1, 4, 4, 2, 4, 1, 1])


def isometric(readings: np.ndarray, force: np.ndarray | float = 100.0) -> ComparableRows:
    """Rows of a test at a constant length."""
    rows = np.broadcast_arrays(ROWS, readings, 0.95 * MUSCLE.nominal_length, force)
    text = "# kind: isometric\ntime_s,pressure_Pa,length_m,force_N\n"
    text += "\n".join(",".join(f"{value:.9g}" for value in row) for row in zip(*rows, strict=True))
    return comparable_rows(read_measurement(text.encode(), "test.csv"), MUSCLE)


def corners(way: np.ndarray) -> np.ndarray:
    """Times of the corners of a way [s]."""
    row, after = _corners(ROWS[: len(way)], way, np.zeros(len(way), int))
    return ROWS[row] + after


def test_corners_are_where_the_straight_lines_meet() -> None:
    assert corners(pressure(ROWS)) == pytest.approx([0.5, 1.53, 2.61, 3.31, 4.44, 5.0], abs=1e-9)


def test_a_corner_at_a_row_is_that_row() -> None:
    tip = ROWS[40]
    assert not len(corners(-np.abs(ROWS - tip)))


def test_a_smooth_way_has_no_corners() -> None:
    assert not len(corners(np.sin(2.0 * np.pi * ROWS / 1.3)))


def test_noise_has_no_corners() -> None:
    for seed in range(20):
        noise = np.random.default_rng(seed).normal(size=len(ROWS))
        assert not len(corners(noise))
        assert not len(corners(ROWS + noise))


def test_no_corner_is_looked_for_across_records() -> None:
    row, _ = _corners(ROWS, pressure(ROWS), np.arange(len(ROWS)) // 5)
    assert not len(row)


def test_a_late_reading_beside_a_corner_is_that_of_the_true_course() -> None:
    task = isometric(pressure(ROWS))
    late = replace(task, state={**task.state, "pressure": pressure(ROWS - DELAY)})
    true = QuasistaticPredictor(late).predict(FitModel(MUSCLE))
    assert QuasistaticPredictor(task).predict(LAG) == pytest.approx(true, abs=0.02)


def test_a_slow_reading_is_that_of_the_true_course() -> None:
    slow = FitModel(MUSCLE).adding(CATALOGUE["sensor_lag"], {"force_time": 0.05})
    task = isometric(pressure(ROWS))
    fine = np.arange(100 * len(ROWS)) * STEP / 100.0
    force = ideal.force(braid=MUSCLE.braid, pressure=pressure(fine), length=0.95 * MUSCLE.nominal_length)
    true = as_read(slow, time=fine, records=[np.arange(len(fine))], values=force)[::100]
    assert QuasistaticPredictor(task).predict(slow) == pytest.approx(true[~task.turning], abs=0.1)


def test_a_row_is_predicted_alike_with_a_delay_of_nothing() -> None:
    predictor = QuasistaticPredictor(isometric(pressure(ROWS)))
    none = FitModel(MUSCLE).adding(CATALOGUE["time_skew"], {"delay": 0.0})
    assert predictor.predict(none) == pytest.approx(predictor.predict(FitModel(MUSCLE)), rel=1e-12)


def test_memory_does_not_depend_on_the_rows_at_corners() -> None:
    task = isometric(pressure(ROWS))
    model = FitModel(MUSCLE).adding(CATALOGUE["pressure_hysteresis"])
    more = with_corners(task)
    assert more.corners is not None
    assert len(more.rows) == len(task.rows) + 2 * 6
    plain, between = Memory(task).states(model), Memory(more).states(model)
    for name, values in plain.items():
        assert between[name][~more.corners] == pytest.approx(values, abs=1e-12)


def test_derivatives_are_those_of_the_prediction() -> None:
    predictor = QuasistaticPredictor(isometric(pressure(ROWS)))
    model = LAG.adding(CATALOGUE["linear_elasticity"], {"stiffness": 300.0})
    free = free_numbers(model)
    _, slopes = predictor.linearised(model, free)
    apart = np.abs(slopes - predictor.differences(model, free))
    assert np.all(apart < 1e-3 * np.max(np.abs(slopes), axis=0))
