"""Timing figures on motions whose figures are known in closed form."""

from __future__ import annotations

from dataclasses import asdict

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mckibben.facts.timing import TIMING as FIGURES
from mckibben.simulation.command.segments import Segments, phases
from mckibben.simulation.timing.table import Phase, PhaseFigures, TimingTable, timing
from mckibben.simulation.timing.trace import Impact, Trace

GRAVITY = 9.80665


def trace(time, position, velocity, acceleration, **columns) -> Trace:
    zero = np.zeros(len(time))
    given = {"pressure": zero, "force": zero, "mass_flow": zero} | columns
    return Trace(time=time, position=position, velocity=velocity, acceleration=acceleration, **given)


def grid(duration: float, count: int, *, uneven: bool = False) -> np.ndarray:
    t = np.linspace(0.0, duration, count)
    if uneven:
        t[1:-1] += np.random.default_rng(2).uniform(-0.3, 0.3, count - 2) * (duration / count)
    return t


def lift(t: np.ndarray, *, a: float, stop: float, delay: float = 0.0, bounce: float = 0.0) -> Trace:
    """Rest, from ``delay`` on constant acceleration up to the stop; then rest, or bounces."""
    fly = np.maximum(t - delay, 0.0)
    x, v = 0.5 * a * fly**2, a * fly
    acceleration, contact = np.where(fly > 0.0, a, 0.0), fly <= 0.0
    impact, speed = delay + np.sqrt(2.0 * stop / a), np.sqrt(2.0 * stop * a)
    impacts = []
    while True:
        hit = t >= impact
        impacts.append(Impact(impact, stop, speed))
        speed *= bounce
        length = 2.0 * speed / a
        if length < 1e-3:
            x[hit], v[hit], acceleration[hit], contact[hit] = stop, 0.0, 0.0, True
            break
        back = t[hit] - impact
        x[hit], v[hit] = stop - speed * back + 0.5 * a * back**2, -speed + a * back
        impact += length
    run = trace(t, x, v, acceleration, contact=contact)
    for hit in impacts:
        run = with_impact(run, hit, a, bounce)
    return run


_COLUMNS = (
    "time", "position", "velocity", "acceleration", "contact", "pressure", "force", "mass_flow"
)  # fmt: skip


def with_impact(run: Trace, impact: Impact, a: float, bounce: float) -> Trace:
    """The trace with the rows before and after an impact, instead of one at the same instant."""
    apart = np.abs(run.time - impact.time) > 1e-6
    columns = {name: getattr(run, name)[apart] for name in _COLUMNS}
    row = int(np.searchsorted(columns["time"], impact.time))
    if not 0 < row < len(columns["time"]):
        return run
    rows = {
        "time": (impact.time, impact.time + 1e-9),
        "position": (impact.position,) * 2,
        "velocity": (impact.velocity, -bounce * impact.velocity),
        "acceleration": (a, columns["acceleration"][row]),
        "contact": (False, columns["contact"][row]),
    }
    columns = {name: np.insert(column, row, rows.get(name, (0.0, 0.0))) for name, column in columns.items()}
    return Trace(**columns, impacts=(*run.impacts, impact))


def extend(run: Trace, target: float | None = None, **options) -> tuple[PhaseFigures, dict[str, str]]:
    table = timing(run, fill=Phase((0.0, float(run.time[-1])), target), vent=None, **options)
    return table.extend, table.notes


def check_complete(table: TimingTable) -> None:
    """Every figure is there, and every None has its reason."""
    for name in ("extend", "retract"):
        figures = asdict(getattr(table, name))
        assert set(figures) == {*FIGURES, "state", "motion"}
        for figure in FIGURES:
            value = figures[figure]
            if value is None:
                assert table.notes[f"{name}.{figure}"]
            else:
                assert np.isfinite(value)


@pytest.mark.parametrize("uneven", [False, True])
def test_constant_acceleration_up_to_a_stop(uneven):
    a, stop, mass, delay = 20.0, 0.2, 7.0, 0.0437
    figures, notes = extend(lift(grid(0.5, 401, uneven=uneven), a=a, stop=stop, delay=delay), mass=mass)

    def at(share: float) -> float:
        return np.sqrt(2.0 * share * stop / a)

    assert figures.stroke == pytest.approx(stop, rel=1e-9)
    assert figures.positioning_time == pytest.approx(delay + at(1.0), abs=1e-6)
    assert figures.rise_time == pytest.approx(at(0.9) - at(0.1), abs=1e-6)
    assert figures.delay_time == pytest.approx(delay + at(0.5), abs=1e-6)
    assert figures.settling_time == figures.positioning_time, "not settled before the impact"
    assert figures.average_speed == pytest.approx(stop / (delay + at(1.0)), rel=1e-5)
    assert figures.max_speed == figures.end_speed == pytest.approx(np.sqrt(2 * a * stop), rel=1e-5)
    assert figures.max_speed_at == figures.positioning_time
    assert figures.impact_energy == pytest.approx(mass * a * stop, rel=1e-5)
    assert figures.max_acceleration == pytest.approx(a)
    assert figures.min_acceleration >= 0.0, "the impact does not count"
    assert "impact" in notes["extend.min_acceleration"]
    assert notes["extend.stroke"] == "the phase ends on the stop"
    assert figures.overshoot is None, "the stop ends the stroke"
    assert notes["extend.overshoot"] == "the load hits the stop"


def test_a_dead_time_shifts_the_delay_and_leaves_the_rise():
    t = grid(0.6, 3001)
    early, _ = extend(lift(t, a=20.0, stop=0.2, delay=0.02))
    late, _ = extend(lift(t, a=20.0, stop=0.2, delay=0.07))
    assert late.rise_time == pytest.approx(early.rise_time, abs=1e-6)
    for figure in ("delay_time", "positioning_time", "settling_time", "max_speed_at"):
        assert getattr(late, figure) - getattr(early, figure) == pytest.approx(0.05, abs=1e-6)


def test_free_fall_of_the_retract_phase_counts_from_its_own_instant():
    t = grid(4.0, 4001)
    fall = lift(t[t >= 2.0] - 2.0, a=GRAVITY, stop=0.2)
    held = np.full((t < 2.0).sum(), 0.2)
    zero = np.zeros(len(held))
    run = trace(
        np.r_[t[t < 2.0], 2.0 + fall.time],
        np.r_[held, 0.2 - fall.position],
        np.r_[zero, -fall.velocity],
        np.r_[zero, -fall.acceleration],
        contact=np.r_[zero == 0.0, fall.contact],
        impacts=tuple(Impact(2.0 + i.time, 0.2 - i.position, -i.velocity) for i in fall.impacts),
    )
    table = timing(run, fill=Phase((0.0, 2.0)), vent=Phase((2.0, 4.0)), mass=5.0)
    check_complete(table)
    down = table.retract
    assert down.positioning_time == pytest.approx(np.sqrt(0.4 / GRAVITY), abs=1e-5)
    assert down.max_speed == pytest.approx(np.sqrt(0.4 * GRAVITY), rel=1e-4)
    assert down.min_acceleration == pytest.approx(-GRAVITY)
    assert down.impact_energy == pytest.approx(5.0 * GRAVITY * 0.2, rel=1e-4)
    assert table.extend.rise_time is None
    assert "stop" in table.notes["extend.rise_time"]


@given(st.floats(0.05, 0.6), st.floats(5.0, 60.0))  # all bounces are over within the run
def test_bounces_move_the_settling_and_nothing_else(bounce, a):
    t = grid(1.5, 3001)
    quiet, _ = extend(lift(t, a=a, stop=0.2), mass=1.0)
    figures, _ = extend(lift(t, a=a, stop=0.2, bounce=bounce), mass=1.0)
    for name in ("positioning_time", "rise_time", "delay_time", "max_speed", "end_speed", "impact_energy"):
        assert getattr(figures, name) == pytest.approx(getattr(quiet, name), rel=1e-3)
    height = 0.2 * bounce**2
    if height > 0.05 * 0.2 * 1.05:
        assert figures.settling_time > quiet.positioning_time
    elif height < 0.05 * 0.2 * 0.95:
        assert figures.settling_time <= quiet.positioning_time


@pytest.mark.parametrize("uneven", [False, True])
def test_exponential_approach(uneven):
    tau, stroke = 0.08, 0.05
    t = grid(1.0, 1001, uneven=uneven)
    e = np.exp(-t / tau)
    pressure = 6e5 * (1.0 - e)
    run = trace(t, stroke * (1 - e), stroke / tau * e, -stroke / tau**2 * e, pressure=pressure)
    figures, notes = extend(run, mass=3.0)
    assert figures.rise_time == pytest.approx(np.log(9.0) * tau, rel=1e-4)
    assert figures.delay_time == pytest.approx(np.log(2.0) * tau, rel=1e-4)
    assert figures.settling_time == pytest.approx(np.log(20.0) * tau, rel=1e-3)
    assert figures.positioning_time == pytest.approx(figures.settling_time)
    assert figures.impact_energy == 0.0
    assert "no stop" in notes["extend.impact_energy"]
    assert figures.pressure_rise_time == pytest.approx(np.log(9.0) * tau, rel=1e-3)
    assert figures.pressure_delay_time == pytest.approx(np.log(2.0) * tau, rel=1e-3)
    assert figures.pressure_settling_time == pytest.approx(np.log(100.0) * tau, rel=1e-3)


@pytest.mark.parametrize("plateau", [0.4999, 0.5001])
def test_a_pause_at_half_the_pressure_is_said(plateau):
    """A pause of 20 ms at 0.01 % beside half of the step: the delay jumps by the pause."""
    t = np.linspace(0.0, 0.52, 5201)
    begins, step = plateau * 0.5, 1e5
    pressure = np.interp(t, [0.0, begins, begins + 0.02, 0.52], [0.0, plateau * step, plateau * step, step])
    zero = np.zeros(len(t))
    rising = trace(t, zero, zero, zero, pressure=pressure)
    table = timing(rising, fill=Phase((0.0, 0.52)), vent=None)
    expected = 0.25 if plateau > 0.5 else 0.27
    assert table.extend.pressure_delay_time == pytest.approx(expected, abs=2e-4)
    assert table.notes["extend.pressure_delay_time"].startswith(
        "from 249.5 to 270.5 ms the pressure is within 0.1 % of its step around 50 % of it"
    )
    assert "extend.pressure_rise_time" not in table.notes
    smooth = trace(t, zero, zero, zero, pressure=step * t / 0.52)
    assert "extend.pressure_delay_time" not in timing(smooth, fill=Phase((0.0, 0.52)), vent=None).notes


def test_the_average_speed_without_a_stop_is_that_of_the_way_to_the_arrival():
    t, stroke, speed = grid(1.0, 1001), 0.1, 0.2
    moving = t < stroke / speed
    run = trace(t, np.where(moving, speed * t, stroke), np.where(moving, speed, 0.0), 0.0 * t)
    figures, _ = extend(run)
    assert figures.positioning_time == pytest.approx(0.95 * stroke / speed, abs=1e-6)
    assert figures.average_speed == pytest.approx(speed, rel=1e-6)


def swinging_off(height: float) -> Trace:
    """At 0.8 m/s against a stop at 0.2 m, from which it swings back by ``height`` every 0.5 s."""
    t = grid(2.2, 4401)
    late = np.maximum(t - 0.25, 0.0)
    w = 4.0 * np.pi
    x = np.where(t <= 0.25, 0.8 * t, 0.2 - 0.5 * height * (1.0 - np.cos(w * late)))
    v = np.where(t <= 0.25, 0.8, -0.5 * height * w * np.sin(w * late))
    return trace(t, x, v, np.gradient(v, t), impacts=(Impact(0.25, 0.2, 0.8),))


@pytest.mark.parametrize("end", [1.95, 2.05, 2.2])
@pytest.mark.parametrize("height", [0.008, 0.02, 0.2])
def test_a_load_that_swings_off_its_stop_has_not_arrived_wherever_the_phase_ends(height: float, end: float):
    """Half of its range is 2, 5 and 50 % of the stroke; the phase ends anywhere in the swing."""
    table = timing(swinging_off(height), fill=Phase((0.0, end)), vent=None, mass=2.0)
    figures, notes = table.extend, table.notes
    behind = 0.5 * height * (1.0 - np.cos(4.0 * np.pi * (end - 0.25)))
    assert figures.stroke == pytest.approx(0.2 - behind, abs=1e-9)
    assert notes["extend.stroke"] == f"the phase ends {1e3 * behind:.3g} mm before the stop that it hit"
    assert figures.impact_energy == pytest.approx(0.64)
    assert figures.end_speed == pytest.approx(0.8)
    if height < 0.01:
        assert figures.positioning_time == pytest.approx(0.25)
        assert figures.average_speed == pytest.approx(0.8, rel=1e-3)
        assert figures.state == "arrived_and_held"
    else:
        assert figures.positioning_time is figures.average_speed is figures.settling_time is None
        assert notes["extend.positioning_time"] == "the load swings until the end of the phase"
        assert figures.state == "swings"
        assert figures.swing_frequency == pytest.approx(2.0, rel=1e-2)


def test_overshoot_of_a_damped_oscillation():
    w, damping, stroke = 20.0, 4.0, 0.03
    t = grid(3.0, 3001)
    e = np.exp(-damping * t)
    y = 1.0 - e * (np.cos(w * t) + damping / w * np.sin(w * t))
    v = e * (w + damping**2 / w) * np.sin(w * t)
    figures, _ = extend(trace(t, stroke * y, stroke * v, stroke * np.gradient(v, t)))
    assert figures.overshoot == pytest.approx(np.exp(-damping * np.pi / w), rel=1e-3)
    assert figures.positioning_time < np.pi / w < figures.settling_time
    outside = t[np.abs(y - 1.0) > 0.05][-1]
    assert figures.settling_time == pytest.approx(outside, abs=1.1e-3)


def test_a_swing_within_the_band_is_settled():
    # Arrives at 0.2 s and goes on swinging by 3 % of the stroke below the end, undamped.
    w, stroke = 25.0, 0.2
    t = grid(2.0, 4001)
    late = t - 0.2
    x = np.where(late < 0.0, stroke * t / 0.2, stroke * (1.0 - 0.015 * (1.0 - np.cos(w * late))))
    v = np.where(late < 0.0, stroke / 0.2, -stroke * 0.015 * w * np.sin(w * late))
    run = trace(t, x, v, np.gradient(v, t))
    usual, _ = extend(run, target=stroke)
    assert usual.settling_time == pytest.approx(0.95 * 0.2, abs=1e-3)
    narrow, _ = extend(run, target=stroke, band=0.02)
    # The last swing leaves 2 % at most one period before the end.
    assert narrow.settling_time is None or narrow.settling_time > 2.0 - 2.0 * np.pi / w


def test_a_stroke_that_is_not_reached_has_no_arrival():
    t = grid(1.0, 1001)
    e = np.exp(-t / 0.05)
    run = trace(t, 0.12 * (1 - e), 2.4 * e, -48.0 * e)
    table = timing(run, fill=Phase((0.0, 1.0), 0.2), vent=None)
    check_complete(table)
    figures, notes = table.extend, table.notes
    assert figures.delay_time == pytest.approx(0.05 * np.log(6.0), rel=1e-4)
    for name in ("positioning_time", "rise_time", "settling_time", "average_speed", "end_speed"):
        assert getattr(figures, name) is None
        assert "120 mm of the 200 mm" in notes[f"extend.{name}"]


@pytest.mark.parametrize("kept", [True, False])
def test_a_demanded_stroke_that_is_passed_and_not_kept_has_no_arrival(kept):
    """By constant speed past the demand; then back to it in 0.1 s, or away from it to the end."""
    t, speed, demanded = grid(1.0, 1001), 0.5, 0.2
    turns, home = 0.44, 0.54
    back = np.interp(t, [0.0, turns, home, 1.0], [0.0, 0.22, 0.2, 0.2] if kept else [0.0, 0.22, 0.2, 0.1])
    run = trace(
        t, back, np.where(t < turns, speed, np.where(t < home, -0.2, 0.0 if kept else -0.1 / 0.46)), 0 * t
    )
    figures, notes = extend(run, target=demanded)
    assert figures.delay_time == pytest.approx(0.5 * demanded / speed, abs=1e-6)
    assert figures.rise_time == pytest.approx(0.8 * demanded / speed, abs=1e-6)
    arrivals = {
        "positioning_time": 0.95 * demanded / speed,
        "average_speed": speed,
        "end_speed": speed,
    }
    for name, expected in arrivals.items():
        if kept:
            assert getattr(figures, name) == pytest.approx(expected, rel=1e-6)
            assert f"extend.{name}" not in notes
        else:
            assert getattr(figures, name) is None
            assert notes[f"extend.{name}"] == "220 mm of the 200 mm are reached, or not kept"
    assert figures.state == ("arrived_and_held" if kept else "never_arrived")


@pytest.mark.parametrize("demanded", [0.2, 0.15])
def test_a_load_that_ends_on_its_stop_has_arrived_where_that_was_demanded(demanded):
    a, stop = 20.0, 0.2
    figures, notes = extend(lift(grid(0.5, 401), a=a, stop=stop), target=demanded)
    assert figures.end_speed == pytest.approx(np.sqrt(2.0 * stop * a), rel=1e-5)
    if demanded == stop:
        assert figures.positioning_time == pytest.approx(np.sqrt(2.0 * stop / a), abs=1e-6)
        assert figures.settling_time is not None
    else:
        assert figures.positioning_time is figures.settling_time is None
        assert "of the 150 mm are reached, or not kept" in notes["extend.positioning_time"]


def test_still_moving_at_the_end():
    t = grid(1.0, 501)
    table = timing(trace(t, 0.1 * t, 0.1 + 0 * t, 0 * t), fill=Phase((0.0, 1.0)), vent=Phase((1.0, 2.0)))
    check_complete(table)
    assert table.extend.rise_time == pytest.approx(0.8)
    assert table.extend.settling_time is None
    assert "still moving" in table.notes["extend.positioning_time"]
    assert "ended before" in table.notes["retract.rise_time"]


@pytest.mark.parametrize(
    ("position", "contact", "words"),
    [(0.0, False, "does not move"), (0.0, True, "stays on its stop"), (-0.01, False, "behind its start")],
)
def test_no_motion_in_the_direction_of_the_phase(position, contact, words):
    t = grid(1.0, 101)
    run = trace(t, position * t, position + 0 * t, 0 * t, contact=np.full(101, contact))
    table = timing(run, fill=Phase((0.0, 1.0)), vent=None)
    check_complete(table)
    assert words in table.notes["extend.rise_time"]
    assert "does not change" in table.notes["extend.pressure_rise_time"]
    assert "no such phase" in table.notes["retract.vented_mass"]


def test_a_lifted_load_in_contact_before_it_moves():
    # Rest on the lower stop counts as contact: the lift-off is no impact.
    figures, notes = extend(lift(grid(0.15, 301), a=10.0, stop=0.2, delay=0.05))
    assert figures.impact_energy == 0.0
    assert "extend.max_acceleration" not in notes


def test_air_and_choked_share():
    t = grid(4.0, 4001)
    inflow, outflow = np.where(t < 0.5, 2e-3, 0.0), np.where((t > 2.0) & (t < 3.0), 1e-3, 0.0)
    x = np.where(t < 2.0, 0.1 * np.minimum(t, 1.0), 0.1 * np.maximum(3.0 - t, 0.0))
    run = trace(t, x, np.gradient(x, t), 0 * t, mass_flow=inflow - outflow, choked=(t > 2.25) & (t < 2.75))
    table = timing(run, fill=Phase((0.0, 2.0)), vent=Phase((2.0, 4.0)))
    check_complete(table)
    assert table.extend.supplied_mass == pytest.approx(1e-3, rel=2e-3)
    assert table.extend.supplied_volume_anr == pytest.approx(1e-3 / 1.185, rel=2e-3)
    assert table.extend.choked_share == 0.0
    assert table.retract.vented_mass == pytest.approx(1e-3, rel=2e-3)
    assert table.retract.choked_share == pytest.approx(0.5, abs=1e-3), "half of the air"


@given(
    st.integers(3, 60),
    st.integers(0, 2**32 - 1),
    st.floats(0.0, 1.0),
    st.sampled_from([None, 0.05]),
)
def test_no_trace_breaks_the_table(count, seed, touching, stroke):
    generator = np.random.default_rng(seed)
    t = np.cumsum(generator.uniform(1e-4, 0.2, count))
    columns = generator.normal(size=(6, count)) * generator.choice([0.0, 1e-3, 1.0, 1e3], size=(6, 1))
    x, v, a, pressure, force, flow = columns
    run = trace(
        t, x, v, a, pressure=pressure, force=force, mass_flow=flow, contact=generator.random(count) < touching
    )
    middle = float(generator.choice(t))
    table = timing(run, fill=Phase((0.0, middle), stroke), vent=Phase((middle, float(t[-1]))), mass=2.0)
    check_complete(table)


def test_broken_columns_are_the_programmers_fault():
    t = np.array([0.0, 1.0, 1.0])
    with pytest.raises(ValueError, match="ascending"):
        trace(t, t, t, t)
    with pytest.raises(ValueError, match="velocity"):
        trace(np.arange(3.0), t, np.array([0.0, np.nan, 1.0]), t)


def test_phases_of_a_command():
    def command(starts, values, end=4.0):
        return Segments(np.array([*starts, end]), np.array(values), np.zeros(len(values)))

    assert phases(command([0.0, 0.5, 2.0], [-1.0, 1.0, -1.0])) == ((0.5, 2.0), (2.0, 4.0))
    assert phases(command([0.0, 1.0, 2.0, 3.0], [1.0, 0.0, -1.0, 1.0])) == ((0.0, 1.0), (1.0, 3.0))
    assert phases(command([0.0], [1.0])) == ((0.0, 4.0), None)
    assert phases(command([0.0, 1.0], [0.0, -1.0])) == (None, (1.0, 4.0))
    assert phases(command([0.0], [0.0])) == (None, None)
