"""States of effects along a record: equal to the driven run, reset with each record, integrated once."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
import pytest

from mckibben.identification.fit.effort import final_effort
from mckibben.identification.fit.misfit import Misfit
from mckibben.identification.predict import memory
from mckibben.identification.predict.comparable_rows import ComparableRows, comparable_rows
from mckibben.identification.predict.fit_model import FitModel, free_numbers
from mckibben.identification.predict.memory import HISTORIES, Memory, remembers
from mckibben.identification.predict.quasistatic import QuasistaticPredictor
from mckibben.measurement.reading import read_measurement
from mckibben.physics.errors import InputError
from mckibben.simulation.drive.records import force_of_record
from mckibben.simulation.statics.model import StaticModel
from tests.identification.synthetic import (
    CATALOGUE,
    CYCLE_HEADER,
    MUSCLE,
    csv,
    cycle_rows,
    cycles,
    force_map,
    truth,
)

SLIP = {"force": 30.0, "break_strain": 0.02, "ratio": 2.0}


def fit_model(**values: dict[str, float]) -> FitModel:
    chosen = tuple(CATALOGUE[name] for name in values)
    return FitModel(MUSCLE, chosen, {e.id: e.defaults | values[e.id] for e in chosen})


def record(task: ComparableRows) -> dict[str, np.ndarray]:
    assert task.time is not None
    return {"time": task.time, "pressure": task.state["pressure"], "length": task.state["length"]}


@pytest.mark.parametrize("effect", sorted(name for name, e in CATALOGUE.items() if remembers(e)))
def test_states_along_a_record_give_the_driven_force(effect):
    task = comparable_rows(cycles(each=40), MUSCLE)
    model = fit_model(**{effect: {}})
    states = Memory(task).states(model)
    assert set(states) == {f"{effect}.{state.name}" for state in CATALOGUE[effect].states}
    compiled = StaticModel.of(MUSCLE, model.effects, model.values)
    expected = force_of_record(compiled, **record(task))
    found = QuasistaticPredictor(task).after(("rest",)).predict(model)
    # A driven run knows the rate between rows; at the rows themselves only terms of velocity differ.
    counted = ~task.turning
    assert np.count_nonzero(counted) > 0.9 * len(counted)
    assert found == pytest.approx(expected[counted], abs=2e-4 * np.max(expected))


@pytest.mark.parametrize(
    ("preamble", "expected"),
    [((), "rest"), ((0.28, 0.30), "the other way"), ((0.3035, 0.295), "the same way")],
)
@pytest.mark.parametrize("effect", ["maxwell_slip", "dahl", "bouc_wen"])
def test_what_went_before_a_record_is_found(effect, preamble, expected):
    """The force of a longer record, of which only the rest was kept, is that of the rest alone."""
    values = {"force": 30.0} if effect != "bouc_wen" else {}
    model = fit_model(**{effect: values})
    begin = preamble[-1] if preamble else 0.30
    corners = [*preamble, begin, 0.27, 0.298, 0.28, begin]
    length = np.concatenate(
        [np.linspace(a, b, 60, endpoint=False) for a, b in itertools.pairwise(corners)] + [[begin]]
    )
    time, pressure = 0.1 * np.arange(len(length)), np.full(len(length), 4e5)
    compiled = StaticModel.of(MUSCLE, model.effects, model.values)
    force = force_of_record(compiled, time=time, pressure=pressure, length=length)
    first = 60 * len(preamble)
    kept = slice(first, None)
    rows = zip(time[kept] - time[first], 1e3 * length[kept], force[kept], strict=True)
    text = "# kind: isobaric\ntime_s,pressure_bar,length_mm,force_N\n"
    text += "".join(f"{t:.3f},4,{x:.6f},{f:.6f}\n" for t, x, f in rows)
    predictor = QuasistaticPredictor(comparable_rows(read_measurement(text.encode(), "cut.csv"), MUSCLE))
    assert predictor.history(model) == (expected,)
    assert np.max(np.abs(predictor.residual(model))) < 0.02 * np.ptp(force)
    assert len(predictor.assumed_history(model)) == (expected != "rest")


def test_a_hold_that_begins_with_its_pressure_creeps_on():
    """Three clamped lengths, each filled at once after a rest without air; the record begins behind the step.

    The force that an arm of each time lacks decays from the whole pressure: p A c/3 sum exp(-t/tau_j).
    """
    share, times = -0.06, (1.0, 10.0, 100.0)
    model = fit_model(pressure_creep={"share": share, "time": 10.0, "spread": 10.0})
    t = np.geomspace(0.01, 600.0, 40)
    lines, expected, begin = [], [], 0.0
    for pressure, length in ((2e5, 0.30), (3e5, 0.285), (4e5, 0.27)):
        late = sum(np.exp(-(t - t[0]) / each) for each in times) / 3.0
        whole = truth(pressure, length)
        force = whole * (1.0 - share * late)
        lines += [f"{begin + at},{pressure},{length},{f}" for at, f in zip(t, force, strict=True)]
        expected.append(force)
        begin += 605.0
    measurement = csv(lines, "time_s,pressure_Pa,length_m,force_N", "kind: isometric")
    predictor = QuasistaticPredictor(comparable_rows(measurement, MUSCLE))
    assert predictor.histories(model.effects) == (("rest",), ("applied",), ("applied anew",))
    assert predictor.history(model) == ("applied anew",)
    assert np.max(np.abs(predictor.residual(model))) < 2e-3 * np.max(expected)
    (said,) = predictor.assumed_history(model)
    assert "put on anew before each level" in said
    started = model.with_numbers(["pressure_creep.share"], [0.0])
    free = free_numbers(started, (), ["pressure_creep.share"])
    assert Misfit(predictor, started, free).fit(final_effort(simulated=False)) == pytest.approx(
        [share], rel=0.02
    )


def test_what_no_rest_undoes_is_said_unless_stated():
    predictor = QuasistaticPredictor(comparable_rows(cycles(each=40), MUSCLE))
    (said,) = predictor.assumed_history(fit_model(bladder_elasticity={}, mullins={}))
    assert said == (
        "Mullins effect (run-in): the muscle is taken as new in each record; of one that had been used "
        "before, mullins.run_in says how far"
    )
    assert predictor.assumed_history(fit_model(bladder_elasticity={}, mullins={"run_in": 0.1})) == ()


def test_a_sweep_from_no_pressure_has_had_nothing_put_on():
    lines = [
        f"{0.5 * row},{4e5 * abs(1 - abs(row / 40 - 1))},{length},100"
        for length in (0.30, 0.28)
        for row in range(81)
    ]
    task = comparable_rows(csv(lines, "time_s,pressure_Pa,length_m,force_N", "kind: isometric"), MUSCLE)
    assert QuasistaticPredictor(task).histories((CATALOGUE["pressure_creep"],)) == (("rest",),)


def test_maxwell_cells_are_sliders_behind_springs():
    """Each cell follows the length until its limit; at the end of a long way all slide."""
    task = comparable_rows(cycles(each=400, levels=(4e5, 5e5)), MUSCLE)
    states = Memory(task).states(fit_model(maxwell_slip=SLIP))
    length, limit = task.state["length"], 0.02 * 0.3
    for number in range(1, 5):
        cell = states[f"maxwell_slip.cell_{number}"]
        own = limit / 2.0 ** (4 - number)
        early = np.abs(length - length[0]) < 0.85 * own
        first = early & (np.arange(len(length)) < 100)
        assert cell[first] == pytest.approx((length[first] - length[0]) / own, abs=2e-3)
        turn = 400  # the shortest length
        assert cell[turn - 1] == pytest.approx(-1.0, abs=1e-3)
        assert np.max(np.abs(cell)) <= 1.0 + 1e-6


@pytest.mark.parametrize(("effect", "strain"), [("dahl", 2e-3), ("bouc_wen", 2e-3), ("maxwell_slip", 2e-2)])
def test_noise_of_the_length_is_no_motion_of_friction(effect, strain):
    """Noise of a tenth of the way over which friction builds up, which is not small beside that of a row."""
    task = comparable_rows(cycles(each=400), MUSCLE)
    length = task.state["length"]
    noise = 6e-5 * np.random.default_rng(0).standard_normal(len(length))
    way = float(np.median(np.abs(np.diff(length))))
    assert way < 5.0 * 6e-5
    noisy = replace(task, state={**task.state, "length": length + noise})
    model = fit_model(**{effect: {"break_strain": strain}})
    clean, read = (Memory(each).states(model) for each in (task, noisy))
    untimed = Memory(replace(noisy, time=None)).states(model)  # rows without time have no neighbours in time
    for name in clean:
        left = np.sqrt(np.mean((read[name] - clean[name]) ** 2))
        assert left < 0.8 * np.sqrt(np.mean((untimed[name] - clean[name]) ** 2))


def test_records_begin_at_rest():
    rows = cycle_rows(each=30, levels=(4e5, 5e5))
    again = cycle_rows(each=30, levels=(4e5, 5e5), noise=1.0)  # the same motion, other readings of the force
    twice = comparable_rows(csv([*rows, *again], CYCLE_HEADER, "kind: isobaric"), MUSCLE)
    assert len(np.unique(twice.records)) == 2
    states = Memory(twice).states(fit_model(dahl={}))["dahl.presliding"]
    half = len(rows)
    assert states[0] == states[half] == 0.0
    assert states[:half] == pytest.approx(states[half:], abs=1e-9)
    alone = Memory(comparable_rows(csv(rows, CYCLE_HEADER, "kind: isobaric"), MUSCLE)).states(
        fit_model(dahl={})
    )
    assert states[:half] == pytest.approx(alone["dahl.presliding"], abs=1e-9)


def test_models_that_share_their_memory_share_the_run():
    memory = Memory(comparable_rows(cycles(each=30), MUSCLE))
    name = "dahl.presliding"
    first = memory.states(fit_model(dahl={"force": 10.0}))[name]
    assert memory.states(fit_model(dahl={"force": 50.0}))[name] is first  # the force is not in the rates
    assert memory.states(fit_model(dahl={"force": 10.0}, prestress={}))[name] is first
    assert memory.states(fit_model(dahl={"force": 10.0}, creep={}))[name] is first, "each effect by itself"
    other = memory.states(fit_model(dahl={"break_strain": 0.01}))[name]
    assert not np.allclose(other, first)
    wider = fit_model(dahl={}).with_numbers(["nominal_length"], [0.31])
    assert memory.states(wider)[name] is not first
    # Sensors turn what is read into what the memory follows.
    assert memory.states(fit_model(dahl={}, length_offset={}))[name] is not first


def test_no_memory_no_states():
    memory = Memory(comparable_rows(force_map(), MUSCLE))
    assert memory.states(fit_model(prestress={}, viscous_damping={})) == {}
    assert memory.by_parameters(fit_model(prestress={}), ["prestress.force"]) == {}


def test_derivatives_are_asked_for_where_there_are_any():
    memory = Memory(comparable_rows(cycles(each=40), MUSCLE))
    model = fit_model(dahl={"break_strain": 0.01})
    names = ["dahl.force", "dahl.break_strain", "braid_angle"]
    found = memory.by_parameters(model, names)
    assert set(found) == {"dahl.break_strain"}
    # z = sign + (z0 - sign) exp(-way/x_b) with x_b = eps L0: on the first way from rest by hand.
    task = memory._task
    way = 0.3 - task.state["length"][:40]
    xb = 0.01 * 0.3
    by_hand = way / (0.01 * xb) * np.exp(-way / xb)  # d/d eps of -(1 - exp(-way/(eps L0)))
    derivative = found["dahl.break_strain"]["dahl.presliding"][:40]
    assert derivative == pytest.approx(by_hand, abs=0.02 * np.max(by_hand))


def test_after_a_new_level_the_first_way_is_not_counted():
    """3 mm of 20 mm at each pressure but the first; the history of the first is known: there was none."""
    sweep = np.concatenate([np.linspace(0.30, 0.28, 101), np.linspace(0.28, 0.30, 101)[1:]])
    lines = [
        f"{(number * 203 + row) * 0.05},{pressure},{length},{truth(pressure, length)}"
        for number, pressure in enumerate((2e5, 4e5, 6e5))
        for row, length in enumerate(sweep)
    ]
    task = comparable_rows(csv(lines, "time_s,pressure_Pa,length_m,force_N", "kind: isobaric"), MUSCLE)
    unseen = task.turning.reshape(3, 201)
    told = task.excluded["history unknown at the start or after a break"]
    assert 0 < told <= 2 * 16  # some of them are turning points too
    assert not unseen[0, 2:15].any()
    assert unseen[1:, :15].all()
    assert not unseen[:, 20:95].any()


def test_a_trial_that_cannot_be_followed_is_lost_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two models side by side, one of which fails: the other has the states that it has alone."""
    task = comparable_rows(cycles(c10=0.4e6, each=40), MUSCLE)
    models = [fit_model(dahl={"break_strain": strain}) for strain in (0.002, 0.004)]
    alone = Memory(task).states(models[0])["dahl.presliding"]
    followed = memory.states_of_records

    def failing(given, *rest, **named):
        if any(model.values["dahl"]["break_strain"] == 0.004 for model in given):
            raise InputError("it does not follow this record")
        return followed(given, *rest, **named)

    monkeypatch.setattr(memory, "states_of_records", failing)
    first, second = Memory(task).together([(model, HISTORIES["rest"]) for model in models])
    np.testing.assert_array_equal(first["dahl.presliding"], alone)
    assert np.isnan(second["dahl.presliding"]).all()


def test_noise_of_the_length_at_rest_moves_no_friction_whatever_the_kind():
    """Two pressures in one file make it static; the muscle is held, and only its sensor is restless."""
    draw = np.random.default_rng(4)
    model = fit_model(dahl={"force": 30.0, "break_strain": 0.002})
    lines = [
        f"{0.1 * n},{p},{0.28 + 2e-5 * draw.standard_normal()},{truth(p, 0.28)}"
        for n, p in enumerate(150 * [2e5] + 150 * [4e5])
    ]
    measurement = csv(lines, "time_s,pressure_Pa,length_m,force_N", "kind: static")
    predictor = QuasistaticPredictor(comparable_rows(measurement, MUSCLE)).after(("rest",))
    states = predictor._evaluation.state(model)["dahl.presliding"]
    assert np.std(states) < 0.4 * 2e-5 / (0.002 * MUSCLE.nominal_length)
