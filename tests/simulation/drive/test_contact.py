"""Contact, slack, air and start against drives written on their own (`independent.Rig`)."""

from __future__ import annotations

from dataclasses import replace
from math import pi, radians

import numpy as np
import pytest

from mckibben.documents.drive_reading import drive_of, read_document
from mckibben.simulation.drive.initial_state import Rest
from mckibben.simulation.drive.transient import Run, simulate
from mckibben.simulation.timing.evaluation import timing_of, trace_of
from mckibben.simulation.timing.table import PhaseFigures, TimingTable
from tests.shipped import shipped_studio
from tests.simulation.drive.independent import AMBIENT, RHO0, T0, R, Rig
from tests.simulation.lsoda import simulated

STUDIO = shipped_studio()
POSITION = 1e-5  # m
RELATIVE, LAPSE, SPEED = 1e-3, 1e-4, 1e-3  # 0.1 %, 0.1 ms, 1 mm/s


def run_of(document: dict, points: int = 4001, **options) -> Run:
    drive = drive_of(read_document(document, "the drive"), STUDIO).drive
    return simulate(drive, points=points, **options)


def timing(run: Run) -> TimingTable:
    return timing_of(run.drive, trace_of(run))


def instant(time: np.ndarray, values: np.ndarray, level: float) -> float:
    """First instant at which the values reach a level."""
    index = int(np.argmax(values >= level))
    return float(np.interp(level, values[index - 1 : index + 1], time[index - 1 : index + 1]))


def settled(time: np.ndarray, values: np.ndarray, end: float, band: float) -> float:
    """Last instant outside the band."""
    return float(time[np.flatnonzero(np.abs(values - end) > band)[-1]])


def expected_figures(rig: Rig, begin: float, end: float, sense: float) -> dict[str, float]:
    """Figures of a phase from rows of 20 us, by their definitions."""
    time = np.unique(np.concatenate([np.arange(begin, end, 2e-5), [end]]))
    rows = Rig(**{key: value for key, value in rig.__dict__.items() if key in Rig.__match_args__[:18]})
    rows.hits = []
    table = rows.run(time)
    t = time - begin
    stroke = rig.highest * rig.rest
    travel = sense * (table[:, 0] - (0.0 if sense > 0 else stroke))
    speed, pressure = sense * table[:, 1], sense * (table[:, 2] - table[0, 2])
    hit = next((at - begin, sense * v) for at, side, v in rows.hits if side == sense and begin < at < end)
    change = pressure[-1]
    return {
        "positioning_time": hit[0],
        "rise_time": instant(t, travel, 0.9 * stroke) - instant(t, travel, 0.1 * stroke),
        "delay_time": instant(t, travel, 0.5 * stroke),
        "settling_time": max(hit[0], settled(t, travel, stroke, 0.05 * stroke)),
        "average_speed": stroke / hit[0],
        "max_speed": max(float(speed.max()), hit[1]),
        "end_speed": hit[1],
        "impact_energy": 0.5 * rig.mass * hit[1] ** 2,
        "pressure_rise_time": instant(t, pressure, 0.9 * change) - instant(t, pressure, 0.1 * change),
        "pressure_delay_time": instant(t, pressure, 0.5 * change),
        "pressure_settling_time": settled(t, pressure, change, 0.01 * change),
        "supplied_mass": table[-1, 4] - table[0, 4],
        "vented_mass": table[-1, 5] - table[0, 5],
    }


def assert_figures(got: PhaseFigures, want: dict[str, float], *, air: bool = True) -> None:
    for name, value in want.items():
        if name.endswith("_mass") and not air:
            continue
        absolute = LAPSE if name.endswith("time") else SPEED if name.endswith("speed") else 0.0
        assert getattr(got, name) == pytest.approx(value, rel=RELATIVE, abs=absolute), name


RIGS = {
    "stated exponent": Rig(exponent=1.2),
    "energy balance": Rig(),
    "rebound": Rig(restitution=0.5),
    "light and slack": Rig(mass=3.0, spring=2000.0, drag=30.0, highest=0.2, exhaust=4e-8),
    "inclined": Rig(mass=12.0, inclination=30.0, drag=60.0, highest=0.15),
}


@pytest.mark.parametrize("name", RIGS)
def test_rigid_stops(name: str) -> None:
    rig = RIGS[name]
    run = run_of(rig.document)
    fresh = replace(rig, hits=[])
    rows = fresh.run(run.time)
    assert np.max(np.abs(run.states["stroke"] - rows[:, 0])) <= POSITION
    # Rebounds end below 1 mm/s; where exactly is a matter of rounding.
    got = [(event.time, event.speed) for event in run.events if event.impact and abs(event.speed) > 5e-3]
    want = [(time, speed) for time, _, speed in fresh.hits if abs(speed) > 5e-3]
    assert len(want) >= 2
    for (at, speed), (expected_at, expected_speed) in zip(got, want, strict=True):
        assert at == pytest.approx(expected_at, abs=LAPSE)
        assert speed == pytest.approx(expected_speed, abs=SPEED)


@pytest.mark.parametrize("name", ["stated exponent", "energy balance", "light and slack"])
def test_timing_table(name: str) -> None:
    rig = RIGS[name]
    table = timing(run_of(rig.document))
    air = rig.exponent is None
    assert_figures(table.extend, expected_figures(rig, 0.0, rig.off, 1.0), air=air)
    assert_figures(table.retract, expected_figures(rig, rig.off, rig.end, -1.0), air=air)


def test_an_impact_does_not_bounce_and_stays_out_of_the_accelerations() -> None:
    # Ideal 20 mm, 30 kg: with springs for stops the load rebounded by 6.2 mm and retract had -7.58 m/s^2.
    rig = RIGS["stated exponent"]
    run, high = run_of(rig.document), rig.highest * rig.rest
    first = next(event for event in run.events if event.impact)
    assert first.speed == pytest.approx(1.054, abs=1e-3)
    after = (run.time > first.time) & (run.time < first.time + 1e-3)
    assert np.max(high - run.states["stroke"][after]) < 1e-5
    table = timing(run)
    assert table.extend.settling_time == table.extend.positioning_time == pytest.approx(first.time)
    assert table.retract.min_acceleration == pytest.approx(-3.78, abs=5e-3)
    assert np.all(np.abs(run.states["speed"][run.outputs["contact"] != 0.0]) == 0.0)


def test_rebounds_follow_the_coefficient_of_restitution() -> None:
    run = run_of({**RIGS["rebound"].document, "load": {"mass": 30.0}, "duration": "3 s"})
    for index, event in enumerate(run.events[:-1]):
        if event.impact and not event.begins:
            just_after = np.argmax(run.time > event.time)
            step = run.time[just_after] - event.time
            drift = 20.0 * step + SPEED
            assert run.states["speed"][just_after] == pytest.approx(-0.5 * event.speed, abs=drift), index


LIFT = {
    "schema": 1,
    "muscle": {"preset": "DMSP-20", "nominal_length": "300 mm"},
    "supply": {"pressure": "5.5 bar"},
    "valve": {"preset": "MPYE-5-1/8-HF"},
    "tube": {"preset": "PUN-H-4x0.75", "length": "1 m"},
    "load": {"mass": "50 kg"},
    "command": {"shape": "pulse", "on": "0 s", "off": "1 s"},
    "duration": "2 s",
}


@pytest.mark.parametrize("restitution", [0.0, 0.5])
def test_another_integrator_finds_the_same_impacts(restitution: float) -> None:
    """A load that leaves its stop from rest is no impact, whatever rounding error its speed has."""
    stops = {"max_contraction": "12 %", "restitution": restitution}
    drive = drive_of(read_document({**LIFT, "stops": stops}, "the drive"), STUDIO).drive
    rodas, lsoda = (run(drive, points=2001) for run in (simulate, simulated))
    hits = [[event for event in run.events if event.impact] for run in (rodas, lsoda)]
    assert [event.switch for event in hits[0]] == [event.switch for event in hits[1]]
    assert [event.time for event in hits[1]] == pytest.approx([event.time for event in hits[0]], abs=1e-4)
    assert min(abs(event.speed) for event in hits[1]) > 1e-4
    for phase in ("extend", "retract"):
        first, second = (getattr(timing(run), phase) for run in (rodas, lsoda))
        for name in ("positioning_time", "end_speed", "impact_energy"):
            assert getattr(second, name) == pytest.approx(getattr(first, name), rel=2e-3), (phase, name)


def test_a_mass_is_conserved_over_repeated_cycles() -> None:
    rig = Rig(off=1.0)
    square = {"shape": "square", "period": "2 s", "duty": 0.5}
    run = run_of({**rig.document, "command": square, "duration": "12 s"}, points=12_001)
    at = [int(np.argmin(np.abs(run.time - instant))) for instant in (8.0, 10.0)]
    taken, let_out = (run.states[name][at[1]] - run.states[name][at[0]] for name in ("supplied", "vented"))
    assert taken == pytest.approx(let_out, rel=1e-3)


def test_air_of_a_stated_exponent_comes_from_the_states_at_rest() -> None:
    # (p V)/(R T0) at the end minus that at the start, by hand; what goes in comes out; said in a note.
    rig = RIGS["stated exponent"]
    run = run_of(rig.document)
    table, trace = timing(run), trace_of(run)
    full = (rig.supply + AMBIENT) * rig.volume(rig.rest * (1 - rig.highest))
    empty = AMBIENT * rig.volume(rig.rest)
    assert table.extend.supplied_mass == pytest.approx((full - empty) / (R * T0), rel=2e-3)
    assert table.retract.vented_mass == pytest.approx(table.extend.supplied_mass, rel=2e-3)
    assert trace is not None
    assert trace.supplied[-1] == pytest.approx(table.extend.supplied_mass, rel=2e-3), "the run says the same"
    assert "ambient temperature" in table.notes["extend.supplied_mass"]


@pytest.mark.parametrize("exponent", [None, 1.2])
def test_air_does_not_depend_on_the_grid_or_on_a_longer_pulse(exponent: float | None) -> None:
    rig = Rig(exponent=exponent, off=4.0, end=8.0)
    usual = timing(run_of(rig.document, 8001)).extend
    fine = timing(run_of(rig.document, 32_001)).extend
    longer = timing(run_of(replace(rig, off=6.0, end=10.0).document, 10_001)).extend
    for other, share in ((fine, 1e-3), (longer, 3e-3)):
        assert other.supplied_mass == pytest.approx(usual.supplied_mass, rel=share)
        assert other.choked_share == pytest.approx(usual.choked_share, abs=5e-3)
    assert usual.supplied_volume_anr == pytest.approx(usual.supplied_mass / RHO0)


def test_the_air_of_the_tube_is_counted_and_named() -> None:
    rig = Rig(off=4.0, end=8.0)
    tube = {"inside_diameter": "4 mm", "length": "2 m"}
    without = timing(run_of(rig.document)).extend
    with_tube = timing(run_of({**rig.document, "tube": tube})).extend
    expected = rig.supply * pi / 4 * 0.004**2 * 2.0 / (R * T0)
    assert with_tube.tube_air_mass == pytest.approx(expected, rel=1e-3)
    assert with_tube.supplied_mass - without.supplied_mass == pytest.approx(expected, rel=0.05)


def test_a_slack_muscle_has_its_free_length() -> None:
    rig = RIGS["light and slack"]
    run = run_of(rig.document)
    rows = replace(rig, hits=[]).run(run.time)
    assert any(event.switch == "slack" and event.begins for event in run.events)
    assert np.max(np.abs(run.states["pressure"] - rows[:, 2])) < 0.01 * rig.supply
    slack = run.states["length"] > rig.rest - run.states["stroke"] + 1e-4
    assert np.count_nonzero(slack) > 20
    # The same muscle at the distance of its fittings would be more than 2 % off in volume somewhere.
    free = np.array([rig.volume(length) for length in run.states["length"][slack]])
    short = np.array([rig.volume(rig.rest - stroke) for stroke in run.states["stroke"][slack]])
    assert np.max(np.abs(short / free - 1.0)) > 0.02


def test_a_start_that_could_be_anywhere_is_on_the_lower_stop() -> None:
    document = {
        "muscle": {"preset": "DMSP-10", "nominal_length": "247 mm"},
        "supply": {"pressure": "5 bar"},
        "valve": {"preset": "MPYE-5-1/8-HF"},
        "load": {"mass": "2 kg", "arrangement": "horizontal"},
        "command": {"shape": "step", "at": "0.1 s"},
        "duration": "0.5 s",
    }
    run = run_of(document, 501)
    assert run.states["stroke"][0] == 0.0
    assert run.start.why in (Rest.ANYWHERE, Rest.BALANCED)
    stated = run_of({**document, "start": {"position": "12 mm"}}, 501)
    assert stated.states["stroke"][0] == pytest.approx(0.012)
    assert stated.start.why is Rest.STATED
    assert np.ptp(stated.states["stroke"][stated.time < 0.1]) < 1e-9, (
        "nothing moves it before the valve opens"
    )


def test_an_inclined_load_presses_on_its_stop_with_its_weight() -> None:
    rig = Rig(mass=10.0, inclination=30.0, off=0.5, end=1.0)
    run = run_of(rig.document, 501)
    assert run.start.why is Rest.LOW_STOP
    assert run.outputs["net_force"][0] == pytest.approx(-10.0 * 9.80665 * np.sin(radians(30.0)), rel=1e-9)
