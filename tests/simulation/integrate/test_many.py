"""Many parameter sets in lanes against the same sets one by one."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cache
from math import radians

import numpy as np
import pytest

from mckibben.documents.drive_reading import drive_of, preset_document, read_document
from mckibben.physics.muscle import Muscle
from mckibben.simulation.command.signals import signal_from
from mckibben.simulation.drive.initial_state import start_of
from mckibben.simulation.drive.parts import Drive, Load, Valve
from mckibben.simulation.drive.transient import parameters_of, segments_of
from mckibben.simulation.integrate.engine import CompiledDrive, Outcome, Solution, compiled_drive, integrate
from mckibben.simulation.integrate.many import ManySolutions, integrate_many, lane_kernels
from mckibben.simulation.statics.model import StaticModel
from tests.benchmarks.lift import DOCUMENT
from tests.shipped import shipped_studio
from tests.simulation.integrate.test_engine import K, Y, Z, system
from tests.simulation.lsoda import integrated

STUDIO = shipped_studio()
SETS, TOLERANCE = 19, 1e-6


@dataclass(frozen=True, eq=False)
class Case:
    """A drive and random parameter sets."""

    drive: Drive
    compiled: CompiledDrive
    parameters: np.ndarray
    starts: np.ndarray
    switches: np.ndarray
    times: np.ndarray
    inputs: np.ndarray
    grid: np.ndarray

    def one(
        self, index: int, tolerance: float = TOLERANCE, by: Callable[..., Solution] = integrate
    ) -> Solution:
        return by(
            self.compiled, parameters=self.parameters[index], start=self.starts[index],
            switches=self.switches[index], restitution=self.drive.restitution, times=self.times,
            inputs=self.inputs, grid=self.grid, tolerance=tolerance,
        )  # fmt: skip

    def many(self, chosen=None, tolerance: float = TOLERANCE, **options) -> ManySolutions:
        chosen = np.arange(len(self.parameters)) if chosen is None else np.asarray(chosen)
        given = {
            "parameters": self.parameters[chosen], "starts": self.starts[chosen],
            "switches": self.switches[chosen], "restitution": self.drive.restitution, "times": self.times,
            "inputs": self.inputs, "grid": self.grid, "tolerance": tolerance,
        }  # fmt: skip
        return integrate_many(self.compiled, **{**given, **options})

    @property
    def stroke(self) -> int:
        return [state.name for state in self.compiled.model.states].index("stroke")


def signal(unit: str = "1", **shape):
    return signal_from(shape, unit=unit, field="command")


SLACK_PAIR = Drive(
    model=StaticModel(Muscle(0.3, 0.0218, radians(26.5), 0.0018, 0.02), {"bladder_elasticity": {}}),
    valve=Valve(2e-8, 2e-8),
    load=Load(mass=8.0, inclination=0.0),
    command=signal(shape="pulse", on="0.05 s", off="0.8 s"),
    duration=1.5,
    supply_pressure=5e5,
    min_contraction=0.02,
    max_contraction=0.14,
    pair=True,
    precontraction=0.08,
)


@cache
def case_of(name: str) -> Case:
    if name == "slack pair":
        drive = SLACK_PAIR
    elif name in ("lift", "rebound"):
        drive = drive_of(read_document(DOCUMENT, "the lift"), STUDIO).drive
        drive = replace(drive, restitution=0.5 if name == "rebound" else 0.0)
    else:
        drive = drive_of(preset_document(name, STUDIO), STUDIO).drive
    compiled = compiled_drive(drive.structure, 1)
    times, inputs, _ = segments_of(drive)
    names, random = list(compiled.model.parameters), np.random.default_rng(11)
    parameters = np.tile(parameters_of(drive, compiled), (SETS, 1))
    for free in ("mass", "fill_conductance", "exhaust_conductance", "supply_pressure"):
        parameters[1:, names.index(free)] *= np.exp(random.uniform(np.log(0.7), np.log(1.4), SETS - 1))
    before = inputs[0] * 0.0
    starts = [start_of(drive, compiled, row, before) for row in parameters]
    return Case(
        drive, compiled, parameters, np.array([start.state for start in starts]),
        np.array([start.switches for start in starts]), times, inputs,
        np.linspace(0.0, drive.duration, 401),
    )  # fmt: skip


CASES = ["lift", "rebound", "propneu-20", "slack pair"]


@pytest.mark.parametrize("name", CASES)
def test_each_set_is_as_if_alone(name):
    case = case_of(name)
    found, kinds = case.many(), set()
    assert found.rows.shape == (SETS, 401, case.compiled.size + case.compiled.width)
    for index in range(SETS):
        alone = case.one(index)
        assert found.outcomes[index] is alone.outcome is Outcome.COMPLETED
        assert np.array_equal(found.rows[index], alone.rows), "bit by bit"
        assert np.array_equal(found.ends[index], alone.end)
        assert np.array_equal(found.switches[index], alone.switches)
        assert np.array_equal(found.events[index], alone.events)
        assert (found.steps[index], found.rejected[index]) == (alone.steps, alone.rejected)
        kinds |= set(found.events[index][:, 1])
    assert kinds, "switches change in these runs"


@pytest.mark.parametrize("name", CASES)
def test_lsoda_on_the_scalar_code_agrees(name):
    """Another integrator on code that is written and compiled apart from that of the lanes."""
    case = case_of(name)
    found = case.many([0, 1], 1e-8)
    for index in (0, 1):
        other = case.one(index, 1e-8, by=integrated)
        assert np.array_equal(found.events[index][:, 1:3], other.events[:, 1:3]), "the same switches change"
        assert found.events[index][:, 0] == pytest.approx(other.events[:, 0], abs=1e-4)
        assert found.rows[index, :, case.stroke] == pytest.approx(other.rows[:, case.stroke], abs=1e-5)


def test_the_cases_have_what_they_are_for():
    rebounds = case_of("rebound").many(columns=["stroke"]).events
    assert any(np.any((rows[:, 3] != 0.0) & (rows[:, 2] == 0.0)) for rows in rebounds)
    names = [switch.name for switch in case_of("slack pair").compiled.model.switches]
    slack = {index for index, switch in enumerate(names) if switch.startswith("slack")}
    assert any(slack & set(rows[:, 1]) for rows in case_of("slack pair").many(columns=["stroke"]).events)


def test_neighbours_order_and_division_do_not_matter():
    case = case_of("lift")
    whole = case.many()
    order = np.random.default_rng(5).permutation(SETS)
    assert np.array_equal(case.many(order).rows, whole.rows[order])
    parts = [case.many(range(begin, min(begin + 5, SETS))).rows for begin in range(0, SETS, 5)]
    assert np.array_equal(np.concatenate(parts), whole.rows)
    with ThreadPoolExecutor(2) as pool:
        for found in pool.map(lambda _: case.many(), range(4)):
            assert np.array_equal(found.rows, whole.rows)


@pytest.mark.parametrize("tolerance", [1e-4, 1e-5])
def test_a_muscle_that_turns_slack_in_a_long_step_does_not_chatter(tolerance):
    """The free length settles within microseconds; the dense output of a long step overshoots there."""
    case = case_of("propneu-20")
    random, names = np.random.default_rng(7), list(case.compiled.model.parameters)
    parameters = np.tile(case.parameters[0], (64, 1))
    for free in ("mass", "fill_conductance", "exhaust_conductance", "supply_pressure"):
        parameters[:, names.index(free)] *= np.exp(random.uniform(np.log(0.7), np.log(1.4), 64))
    starts = [start_of(case.drive, case.compiled, row, case.inputs[0] * 0.0) for row in parameters]
    given = {
        "parameters": parameters, "starts": np.array([start.state for start in starts]),
        "switches": np.array([start.switches for start in starts]), "columns": ["stroke"],
    }  # fmt: skip
    found = case.many(np.zeros(64, int), tolerance=tolerance, **given)
    tries = found.steps + found.rejected
    assert max(tries) < 3 * np.median(tries)
    worst = int(np.argmax(tries))
    alone = replace(case, parameters=parameters, starts=given["starts"], switches=given["switches"])
    assert abs(alone.one(worst, tolerance).steps - found.steps[worst]) < 0.2 * found.steps[worst]
    tight = case.many(np.zeros(64, int), tolerance=1e-8, **given)
    assert np.percentile(np.max(np.abs(found.rows - tight.rows), axis=1), 90) < 20 * tolerance


def test_columns_are_those_of_all_and_only_those():
    case = case_of("lift")
    names = [*(state.name for state in case.compiled.model.states), *case.compiled.model.output_names]
    wanted = ["contact", "speed", "clock", "force"]
    found = case.many(columns=wanted).rows
    # What outputs share is computed in another order where fewer are asked for: the last digit may differ.
    whole = case.many().rows[:, :, [names.index(name) for name in wanted]]
    np.testing.assert_allclose(found, whole, rtol=1e-14, atol=1e-12)
    assert np.array_equal(found[3, :, 2], case.grid)
    assert case.many(columns=[]).rows.shape == (SETS, 401, 0)
    with pytest.raises(ValueError, match="no state or output torsion"):
        case.many(columns=["torsion"])


def test_times_inputs_and_grids_of_each_set():
    case = case_of("lift")
    delays = np.linspace(0.0, 0.3, SETS)
    times = np.tile(case.times, (SETS, 1))
    times[:, 2:-1] += delays[:, None]
    grids = np.ascontiguousarray(np.linspace(0.0, 3.0 + delays, 301).T)
    inputs = np.tile(case.inputs, (SETS, 1, 1))
    inputs[:, :, -1] = times[:, :-1]
    found = case.many(times=times, inputs=inputs, grid=grids, columns=["stroke", "supply_flow"])
    for index in (0, 7, 18):
        alone = integrate(
            case.compiled, parameters=case.parameters[index], start=case.starts[index],
            switches=case.switches[index], times=times[index], inputs=inputs[index], grid=grids[index],
            tolerance=TOLERANCE,
        )  # fmt: skip
        assert found.rows[index, :, 0] == pytest.approx(alone.rows[:, case.stroke], abs=1e-6)


def test_a_row_does_not_depend_on_the_other_rows():
    # Few and many rows in a step, rows at the ends of segments, and the same instant several times.
    case, random = case_of("rebound"), np.random.default_rng(5)
    end = case.times[-1]
    crowd = np.linspace(0.31 * end, 0.3101 * end, 150)
    every = np.sort(np.concatenate([case.times, case.times, crowd, random.uniform(0.0, end, 700)]))
    whole = case.many(range(9), grid=every)
    assert (whole.written == len(every)).all()
    for kept in (0.03, 0.5, 0.9):
        some = np.sort(random.choice(len(every), int(kept * len(every)), replace=False))
        assert np.array_equal(case.many(range(9), grid=every[some]).rows, whole.rows[:, some])


def test_rows_at_scattered_instants_have_the_closed_form():
    equation = system({"clock": 1.0, "y": -K * Y}, {"twice": 2 * Y})
    random = np.random.default_rng(8)
    grid = np.sort(np.concatenate([[0.0, 0.0, 2.0], random.uniform(0.0, 2.0, 300), np.full(20, 1.0)]))
    factors = np.linspace(0.5, 3.0, 11)
    found = integrate_many(
        equation, parameters=factors[:, None], starts=np.tile([0.0, 1.0], (11, 1)),
        times=np.array([0.0, 1.0, 2.0]), inputs=np.zeros((2, 1)), grid=grid, tolerance=1e-9,
    ).rows  # fmt: skip
    exact = np.exp(-factors[:, None] * grid)
    assert np.array_equal(found[:, :, 0], np.tile(grid, (11, 1)))
    assert found[:, :, 1] == pytest.approx(exact, abs=1e-8)
    assert found[:, :, 2] == pytest.approx(2.0 * exact, abs=2e-8)


def test_a_set_that_fails_fails_alone():
    case = case_of("lift")
    sound, parameters = case.many(), case.parameters.copy()
    parameters[4] = np.nan
    parameters[9, list(case.compiled.model.parameters).index("mass")] = -np.inf
    found = case.many(parameters=parameters)
    rest = [index for index in range(SETS) if index not in (4, 9)]
    assert found.outcomes[4] is found.outcomes[9] is Outcome.DIVERGED
    assert found.written[4] == 0
    assert np.isnan(found.rows[4]).all()
    assert np.array_equal(found.rows[rest], sound.rows[rest])
    most = int(np.median(sound.steps + sound.rejected))
    limited = case.many(max_steps=most)
    late = sound.steps + sound.rejected > most
    assert late.any()
    assert [outcome is Outcome.STUCK for outcome in limited.outcomes] == late.tolist()
    assert np.array_equal(limited.rows[~late], sound.rows[~late])


def test_shapes_that_do_not_fit_are_refused():
    case = case_of("lift")
    with pytest.raises(ValueError, match="starts has the shape"):
        case.many(starts=case.starts[:3])
    with pytest.raises(ValueError, match="2 sets"):
        case.many(grid=np.tile(case.grid, (2, 1)))
    with pytest.raises(ValueError, match="common times"):
        case.many(times=np.tile(case.times, (SETS, 1)), together=True)


def test_differences_of_sets_that_run_together_are_derivatives():
    # Van der Pol.
    equation = system({"clock": 1.0, "y": Z, "z": K * ((1 - Y**2) * Z - Y)}, {})
    step, grid = 1e-7, np.linspace(0.0, 12.0, 241)

    def run(factors, tolerance, together=False):
        return integrate_many(
            equation, parameters=5.0 * np.asarray(factors)[:, None],
            starts=np.tile([0.0, 2.0, 0.0], (len(factors), 1)), times=np.array([0.0, 12.0]),
            inputs=np.zeros((1, 1)), grid=grid, tolerance=tolerance, columns=["y"], together=together,
        )  # fmt: skip

    high, low = run([1.0 + 1e-4, 1.0 - 1e-4], 1e-12).rows
    exact = (high - low) / 2e-4
    factors = np.concatenate([[1.0], np.full(10, 1.0 + step)])
    found = run(factors, 1e-5, together=True)
    assert len(found.rows) == 11, "more sets than lanes"
    assert found.alike.all()
    size = np.linalg.norm(exact)
    for jacobian in (found.rows - found.rows[0])[1:] / step:
        assert np.linalg.norm(jacobian - exact) / size < 0.02
    apart = run([1.0, 0.5, 2.0], 1e-5)
    assert len(set(apart.steps)) == 3, "each its own steps"
    assert set(found.steps) == {apart.steps[0]}, "the steps of the first"


FREE = {
    "lift": ("fill_conductance", "exhaust_conductance", "mass"),
    "propneu-20": ("mass", "fill_conductance", "exhaust_conductance", "supply_pressure"),
    "slack pair": ("mass", "fill_conductance", "supply_pressure"),
}


def changed(case: Case, free: tuple[str, ...], step: float, tolerance: float, **options) -> ManySolutions:
    """The first set, and a set for each of the parameters with that changed by a share."""
    names = list(case.compiled.model.parameters)
    parameters = np.tile(case.parameters[0], (len(free) + 1, 1))
    for index, name in enumerate(free, 1):
        parameters[index, names.index(name)] *= 1.0 + step
    before = case.inputs[0] * 0.0
    starts = [start_of(case.drive, case.compiled, row, before) for row in parameters]
    return case.many(
        [0] * len(parameters), tolerance, parameters=parameters, columns=["stroke", "pressure"],
        starts=np.array([start.state for start in starts]),
        switches=np.array([start.switches for start in starts]), **options,
    )  # fmt: skip


@pytest.mark.parametrize("name", FREE)
def test_differences_across_impacts_and_slack_are_derivatives(name):
    case, free, step = case_of(name), FREE[name], 1e-5
    ahead, behind = (changed(case, free, sign * 1e-4, 1e-10).rows for sign in (1.0, -1.0))
    exact = (ahead - behind)[1:] / 2e-4
    found = changed(case, free, step, 1e-5, together=True)
    assert found.alike.all()
    assert len(found.events[0]) > 2, "switches change"
    assert set(found.steps) == {found.steps[0]}
    slopes = (found.rows - found.rows[0])[1:] / step
    errors = np.linalg.norm(slopes - exact, axis=1) / np.linalg.norm(exact, axis=1)
    assert np.max(errors) < 0.05, errors
    assert np.median(errors) < 5e-3, errors


def test_sets_that_run_apart_are_told():
    case, free = case_of("propneu-20"), FREE["propneu-20"]
    far = changed(case, free, 0.3, 1e-5, together=True)
    assert far.alike[0]
    assert not far.alike[1:].any()
    assert changed(case, free, 1e-4, 1e-5, together=True).alike.all()


def test_sets_that_run_together_do_not_depend_on_their_group():
    case, free = case_of("lift"), FREE["lift"]
    few = changed(case, free, 1e-5, 1e-5, together=True)
    many = changed(case, free * 5, 1e-5, 1e-5, together=True)
    assert len(many.rows) > lane_kernels.awaited().lanes
    for index in range(1, len(many.rows)):
        assert np.array_equal(many.rows[index], few.rows[1 + (index - 1) % len(free)])
    alone = changed(case, (), 0.0, 1e-5)
    # To the last digits, which an impact enlarges (to 2.4e-6 with AVX2): below the tolerance of 1e-5.
    assert few.rows[0] == pytest.approx(alone.rows[0], rel=1e-5, abs=2e-7), "it runs as it does alone"


def test_no_sets():
    case = case_of("lift")
    found = case.many(np.zeros(0, int))
    assert found.rows.shape[0] == 0
    assert lane_kernels.awaited().lanes in (2, 4)
