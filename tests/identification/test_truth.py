"""The generator of measurements with hidden effects, by closed forms and conservation laws of its own."""

from __future__ import annotations

import ast
from math import pi, radians, sin, tan
from pathlib import Path

import numpy as np
import pytest

from tests.truth import elastomer, friction, geometry, sensors
from tests.truth.bench import length_under
from tests.truth.composition import Hidden, Record, Truth
from tests.truth.experiments import isobaric, isometric
from tests.truth.muscle import Muscle, ideal_force

FOLDER = Path(__file__).parents[1] / "truth"
SIZE_10 = Muscle(0.1, 0.01, radians(25.0), 0.0018, 0.01)
SIZE_20 = Muscle(0.3, 0.0218, radians(26.5), 0.0018, 0.02)
LENGTHS = np.linspace(0.24, 0.31, 40)
ROOM = np.full_like(LENGTHS, 293.15)

WALLS = {
    "yeoh": elastomer.bladder(SIZE_20, elastomer.yeoh(0.33e6, -0.012e6, 0.004e6)),
    "ogden": elastomer.bladder(SIZE_20, elastomer.ogden((0.62e6, 1.3), (1e3, 5.0), (-1e4, -2.0))),
    "eight-chain": elastomer.bladder(SIZE_20, elastomer.arruda_boyce(0.5e6, 3.5)),
    "exponential": elastomer.exponential_bladder(SIZE_20, 150.0, 0.03, 100.0),
    "mapped": elastomer.mapped_bladder(SIZE_20, 1.0),
    "spring": elastomer.soft_spring(SIZE_20, 3e3),
}
FRICTIONS = {
    "lugre": friction.bristles(20.0, 5e-4),
    "crossings": friction.crossings(SIZE_20, 1e-3, 5e-4),
    "rubbing": friction.rubbing(SIZE_20, 0.01, 0.04, 0.1),
    "dahl": friction.yielding(20.0, 3e-3, 1.4),
    "baber-noori": friction.degrading_bouc(20.0, 3e-3, 2.4, 0.3),
    "iwan": friction.iwan(20.0, 5e-3),
    "viscous": friction.power_viscous(100.0, 0.9, 1e-7, 0.8),
    "creep": elastomer.power_law_creep(500.0, 0.12),
}


def cycle(cycles: int = 3, speed: float = 1.0, rows: int = 3000) -> Record:
    """A length that swings between 0.27 and 0.29 m at 4 bar."""
    phase = np.linspace(0.0, 2.0 * pi * cycles, rows * cycles + 1)
    length = 0.28 + 0.01 * np.cos(phase)
    return Record(
        phase / (2.0 * pi * speed),
        np.full_like(phase, 4e5),
        length,
        np.zeros(len(phase), int),
        np.ones(len(phase), bool),
        np.full_like(phase, 293.15),
    )


def work(record: Record, force: np.ndarray) -> np.ndarray:
    """Work done on what pulls, along the record [J]."""
    steps = 0.5 * (force[1:] + force[:-1]) * np.diff(record.length)
    return np.concatenate([[0.0], np.cumsum(steps)])


def test_the_truth_shares_no_code_with_what_it_judges():
    files = list(FOLDER.glob("*.py"))
    assert len(files) > 15
    for file in files:
        for fitted_model in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            names = [fitted_model.module or ""] if isinstance(fitted_model, ast.ImportFrom) else []
            names += (
                [alias.name for alias in fitted_model.names] if isinstance(fitted_model, ast.Import) else []
            )
            assert not [name for name in names if name.split(".")[0] == "mckibben"], file.name
        assert "mckibben" not in file.read_text(encoding="utf-8"), file.name
        assert len(file.read_text(encoding="utf-8").splitlines()) <= 300, file.name


def test_ideal_force_is_that_of_diameter_and_angle():
    t = SIZE_20.angle
    lam = LENGTHS / SIZE_20.nominal
    expected = 3e5 * pi * SIZE_20.diameter**2 / 4 * (3 * lam**2 / tan(t) ** 2 - 1 / sin(t) ** 2)
    assert ideal_force(SIZE_20, np.full_like(LENGTHS, 3e5), LENGTHS) == pytest.approx(expected, rel=1e-12)
    assert SIZE_10.blocked == pytest.approx(386.31316, rel=1e-7)


def test_ideal_force_is_the_work_of_the_gas():
    step = 1e-6
    slope = (SIZE_20.volume(LENGTHS + step) - SIZE_20.volume(LENGTHS - step)) / (2 * step)
    assert SIZE_20.area(LENGTHS) == pytest.approx(-slope, rel=1e-7)


def test_mooney_rivlin_wall_has_the_published_tension():
    # latex constants 118.4 and 105.7 kPa, differentiated by hand
    def latex(a, b, c):
        first = a**2 + b**2 + c**2 - 3.0
        second = a**-2 + b**-2 + c**-2 - 3.0
        return 118.4e3 * first + 105.7e3 * second

    wall = elastomer.bladder(SIZE_20, latex)
    found = wall.elastic(np.array([0.285, 0.270, 0.240]), ROOM[:3])
    assert found == pytest.approx([-78.939, -100.678, -108.932], rel=2e-5)


@pytest.mark.parametrize("wall", WALLS.values(), ids=WALLS)
def test_walls_are_free_at_the_nominal_length_and_resist_both_ways(wall: Hidden):
    assert wall.elastic is not None
    rest = np.array([SIZE_20.nominal])
    scale = float(np.max(np.abs(wall.elastic(LENGTHS, ROOM))))
    assert abs(float(wall.elastic(rest, ROOM[:1])[0])) < 1e-4 * scale
    assert wall.elastic(rest - 0.03, ROOM[:1])[0] < 0.0 < wall.elastic(rest + 0.006, ROOM[:1])[0]


@pytest.mark.parametrize("name", FRICTIONS)
def test_friction_takes_work_over_every_cycle(name: str):
    record = cycle()
    part = FRICTIONS[name]
    assert part.memory is not None
    spent = work(record, part.memory(record))
    assert np.all(spent[3000::3000] - spent[:-1:3000] > 0.0)


@pytest.mark.parametrize("name", ["dahl", "baber-noori", "iwan"])
def test_rate_independent_laws_do_not_know_the_time(name: str):
    part = FRICTIONS[name]
    assert part.memory is not None
    slow, fast = part.memory(cycle(speed=0.01)), part.memory(cycle(speed=10.0))
    assert fast == pytest.approx(slow, abs=1e-12)


def test_sliding_friction_takes_twice_its_force_times_the_stroke():
    record = cycle(cycles=2, rows=20_000)
    part = friction.bristles(20.0, 1e-6, rise=0.0)
    assert part.memory is not None
    spent = work(record, part.memory(record))
    assert spent[-1] - spent[20_000] == pytest.approx(2 * 20.0 * 0.02, rel=2e-3)


def test_iwan_cells_close_their_minor_loops():
    part = FRICTIONS["iwan"]
    corners = np.array([0.28, 0.27, 0.276, 0.272, 0.276])
    length = np.interp(np.linspace(0, 4, 4001), np.arange(5), corners)
    base = cycle()
    record = Record(np.arange(4001.0), np.full(4001, 4e5), length, base.group, base.kept, base.temperature)
    assert part.memory is not None
    force = part.memory(record)
    assert force[4000] == pytest.approx(force[2000], abs=1e-9)


def test_softening_only_takes_force_below_the_largest_strain_so_far():
    record = cycle()
    lost = elastomer.softening(SIZE_20, elastomer.neo_hooke(0.4e6), 4.0, 0.3).memory
    assert lost is not None
    change = lost(record)
    first_half = slice(0, 1500)  # shortening for the first time
    assert np.max(np.abs(change[first_half])) < 1e-9
    assert np.min(change[1501:2900]) > 0.0  # the wall pushes less on the way back
    assert change[3000:6000] == pytest.approx(change[6000:9000], abs=1e-6)


@pytest.mark.parametrize(
    "part",
    [
        geometry.rounded_ends(SIZE_20, 0.0),
        geometry.faster_middle(SIZE_20, 1.0, 0.0, 1e5),
        geometry.thinning_wall(SIZE_20, 0.0, 0.5),
        geometry.stretching_threads(SIZE_20, 1e-15, 5.0),
        geometry.late_contact(0.0, 1.0),
        geometry.saturating(1.0, 0.0, 1e5),
        geometry.taut_braid(SIZE_20, 0.0, 0.0, 1e-3),
        geometry.hardening_rig(0.0, 1e3),
    ],
    ids=lambda part: part.name,
)
def test_parts_of_no_size_leave_the_ideal_muscle(part: Hidden):
    pressure = np.full_like(LENGTHS, 4e5)
    found = Truth(SIZE_20, hidden=(part,)).force(pressure, LENGTHS, ROOM)
    assert found == pytest.approx(ideal_force(SIZE_20, pressure, LENGTHS), rel=1e-5)


def test_a_wall_that_keeps_its_section_costs_nothing():
    # The bore then differs from the braid by a volume that falls with the length alone: t (D - t) L pi.
    part = geometry.thinning_wall(SIZE_20, 1e-6, 1.0)
    pressure = np.full_like(LENGTHS, 4e5)
    change = Truth(SIZE_20, hidden=(part,)).force(pressure, LENGTHS, ROOM) - ideal_force(
        SIZE_20, pressure, LENGTHS
    )
    # pi D0 t P: what the removed section of the wall would have pushed on the fitting
    assert change == pytest.approx(4e5 * pi * SIZE_20.diameter * 1e-6 * np.ones_like(LENGTHS), rel=1e-3)


def test_stretching_threads_cost_force_with_the_square_of_pressure():
    part = geometry.stretching_threads(SIZE_20, 1e-9, 1e-3)
    truth = Truth(SIZE_20, hidden=(part,))
    changes = []
    for level in (1e5, 2e5):
        pressure = np.full_like(LENGTHS, level)
        changes.append(truth.force(pressure, LENGTHS, ROOM) - ideal_force(SIZE_20, pressure, LENGTHS))
    assert changes[1] / changes[0] == pytest.approx(4.0, rel=1e-3)


def test_a_rig_of_known_stretch_shifts_the_length_by_it():
    part = geometry.hardening_rig(1e-6, 1e12)  # as good as linear
    truth = Truth(SIZE_20, hidden=(part,))
    pressure = np.full_like(LENGTHS, 5e5)
    force = truth.force(pressure, LENGTHS, ROOM)
    assert force == pytest.approx(ideal_force(SIZE_20, pressure, LENGTHS - 1e-6 * force), rel=1e-8)


def test_a_length_under_load_carries_the_load():
    truth = Truth(SIZE_20, hidden=(WALLS["yeoh"],))
    pressure = np.linspace(4e5, 6e5, 20)
    length = length_under(truth, pressure, np.full(20, 250.0))
    assert truth.force(pressure, length, ROOM[:20]) == pytest.approx(np.full(20, 250.0), rel=1e-6)


def test_second_order_filter_delays_a_ramp_by_twice_its_damping_over_omega():
    time = np.linspace(0.0, 3.0, 3001)
    passed = sensors.second_order(time, 2.0 * time, 5.0, 0.9)
    delay = 2 * 0.9 / (2 * pi * 5.0)
    assert passed[2000:] == pytest.approx(2.0 * (time[2000:] - delay), abs=1e-6)
    assert sensors.second_order(time, np.ones_like(time), 5.0, 0.9) == pytest.approx(np.ones_like(time))


def test_protocols_stay_where_the_muscle_pulls():
    truth = Truth(SIZE_20, hidden=(WALLS["yeoh"],))
    for record in (
        isobaric(truth, levels=(2e5, 4e5), high=0.25),
        isometric(truth, contractions=(0.0, 0.1, 0.2)),
    ):
        force = truth.force(record.pressure, record.length, record.temperature)[record.kept]
        assert np.min(force) > 0.02 * SIZE_20.blocked
        assert np.all(np.diff(record.time) > 0.0)
