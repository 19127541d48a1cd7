"""Pulse-width modulation: pulses by their closed form, mean flows, a controlled run, what is refused."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from mckibben.documents.drive_reading import drive_of, read_document
from mckibben.physics import gas
from mckibben.physics.errors import InputError
from mckibben.simulation.command.pwm import Pulse, PulseWidth
from mckibben.simulation.command.segments import Segments
from mckibben.simulation.drive.controlled import simulate_controlled
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import simulate
from mckibben.simulation.linear.linearise import linearise
from mckibben.simulation.timing.evaluation import trace_of
from mckibben.simulation.timing.table import Phase, timing
from tests.simulation.drive.sampled import Edges
from tests.simulation.drive.test_muscle_valves import AMBIENT, HELD, STUDIO, SUPPLY, VALVE


def drive(**changes: Any) -> Drive:
    return drive_of(read_document({**HELD, **changes}, "held"), STUDIO).drive


def steady(level: float) -> dict[str, Any]:
    return {"shape": "step", "level": level, "initial": 0.0}


def test_a_pulse_is_the_share_of_the_period_within_the_shortest_times() -> None:
    two = PulseWidth(10.0, min_on=0.01, min_off=0.02)
    assert two.pulse(0.4) == Pulse(1.0, pytest.approx(0.04), 0.0)
    assert two.pulse(-0.4) == Pulse(-1.0, pytest.approx(0.04), 0.0)
    assert two.pulse(0.09).width == 0.0
    assert two.pulse(0.85).width == two.pulse(7.0).width == two.period
    one = PulseWidth(10.0, "one")
    assert one.pulse(0.5) == Pulse(1.0, pytest.approx(0.075), -1.0)
    assert one.pulse(-1.0).width == 0.0


def test_the_command_is_read_at_the_start_of_each_period() -> None:
    ramp = Segments(np.array([0.0, 0.25]), np.array([0.0]), np.array([4.0]))
    found = PulseWidth(10.0).switched(ramp)
    assert found.times == pytest.approx([0.0, 0.1, 0.14, 0.2, 0.25])
    assert found.start_values == pytest.approx([0.0, 1.0, 0.0, 1.0])
    # Sampled every 30 ms it is the same, of the commands that are held then.
    edges_of = Edges(PulseWidth(10.0))
    edges = [edge for n in range(5) for edge in edges_of(0.03 * n, 0.03 * n + 0.03, 0.12 * n)]
    assert [opening for _, opening in edges] == [0.0, 1.0, 0.0]
    assert [instant for instant, _ in edges] == pytest.approx([0.0, 0.1, 0.136])


def test_the_mean_of_a_choked_flow_is_its_duty_ratio() -> None:
    run = simulate(drive(pwm={"frequency": "100 Hz"}, command=steady(0.3), duration="0.2 s"))
    assert set(run.outputs["opening"]) <= {0.0, 1.0}
    volume = run.outputs["volume"][0]
    rise = gas.GAS_CONSTANT * 293.15 * 0.3 * VALVE * gas.ANR_DENSITY * SUPPLY / volume * 0.04
    end = int(np.searchsorted(run.time, 0.04))
    assert rise < 0.29 * SUPPLY - AMBIENT  # choked until then
    assert run.pressure[end] == pytest.approx(rise, rel=1e-3)


def test_a_fast_carrier_is_the_proportional_valve() -> None:
    lift: dict[str, Any] = {
        "effects": {},
        "load": {"mass": "20 kg"},
        "command": {"shape": "sine", "amplitude": 0.4, "frequency": "2 Hz"},
        "duration": "0.5 s",
    }
    smooth = simulate(drive(**lift))
    away = []
    for frequency in (50.0, 500.0):
        switched = simulate(drive(**lift, pwm={"frequency": frequency}))
        away.append(np.abs(switched.pressure - smooth.pressure).max())
    assert away[1] < 0.15 * away[0]
    assert away[1] < 0.02 * smooth.pressure.max()


def test_one_valve_holds_the_pressure_at_which_both_flows_have_one_mean() -> None:
    modulated = drive(pwm={"frequency": "200 Hz", "valves": "one"}, command=steady(0.0), duration="3 s")
    run = simulate(modulated, points=6001)
    settled = run.time > 2.5
    pressure = run.states["pressure"][settled]

    def mean_flow(p: float) -> float:
        def psi(r: float) -> float:
            return (1.0 - (max(r - 0.3, 0.0) / 0.7) ** 2) ** 0.5

        return SUPPLY * psi(p / SUPPLY) - p * psi(AMBIENT / p)

    low, high = AMBIENT, SUPPLY
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if mean_flow(middle) > 0.0 else (low, middle)
    assert pressure.mean() == pytest.approx(low, rel=5e-3)
    passed = run.states["supplied"] - run.states["vented"]
    inside = run.states["pressure"] * run.outputs["volume"] / (gas.GAS_CONSTANT * 293.15)
    assert passed == pytest.approx(inside - inside[0], abs=1e-5 * inside.max())


CONTROL = {"type": "pid", "kp": 2.0, "ki": 10.0, "kd": 0.01}
LIFT: dict[str, Any] = {
    "effects": {},
    "load": {"mass": "20 kg"},
    "controller": {**CONTROL, "reference": {"shape": "step", "level": "20 mm", "initial": "0 mm"}},
    "command": None,
    "duration": "0.6 s",
}
JOINT: dict[str, Any] = {
    **LIFT,
    "load": {"mass": "5 kg", "arrangement": "antagonist", "pulley_radius": "30 mm"},
    "controller": {**CONTROL, "angle": "10 deg", "stiffness": {"reference": "40 N*m/rad"}},
    "start_pressure": "2 bar",
}


@pytest.mark.parametrize("document", [LIFT, JOINT], ids=["lift", "joint"])
def test_a_controller_drives_switching_valves(document: dict[str, Any]) -> None:
    smooth = simulate_controlled(drive(**document), points=301)
    run = simulate_controlled(drive(**document, pwm={"frequency": "100 Hz"}), points=301)
    assert set(np.unique(run.command.start_values)) == {-1.0, 0.0, 1.0}
    if run.drive.pair:
        assert run.counter_command is not None
        assert set(np.unique(run.counter_command.start_values)) == {-1.0, 0.0, 1.0}
    end = run.states["stroke"][-60:].mean()
    assert end == pytest.approx(smooth.states["stroke"][-60:].mean(), rel=0.1)
    assert abs(end) > 3e-3


def test_the_linear_view_has_the_mean_opening_and_says_so() -> None:
    lift: dict[str, Any] = {"effects": {}, "load": {"mass": "20 kg"}, "supply": {"pressure": "6 bar"}}
    plain, modulated = linearise(drive(**lift)), linearise(drive(**lift, pwm={"frequency": "100 Hz"}))
    assert (modulated.primary.a == plain.primary.a).all()
    assert modulated.lost[-1].startswith("pulse-width modulation")
    with pytest.raises(InputError, match="fills and vents in every period"):
        linearise(drive(**lift, pwm={"frequency": "100 Hz", "valves": "one"}))


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"pwm": {"frequency": "100 Hz"}, "regulator": {"range": "6 bar", "time": "5 ms"}}, "pwm"),
        ({"pwm": {"frequency": "100 Hz", "min_on": "6 ms", "min_off": "5 ms"}}, "pwm.frequency"),
        ({"pwm": {"frequency": "0 Hz"}}, "pwm.frequency"),
        ({"pwm": {"frequency": "50 Hz", "valves": "three"}}, "pwm.valves"),
    ],
)
def test_what_cannot_be_is_refused_at_its_field(changes: dict[str, Any], field: str) -> None:
    with pytest.raises(InputError) as found:
        drive(**changes)
    assert found.value.field == field


def test_too_many_periods_are_refused() -> None:
    with pytest.raises(InputError, match="at most 100000"):
        simulate(drive(pwm={"frequency": "1000 Hz"}, duration="200 s"))


def test_a_level_in_a_pause_between_pulses_is_said() -> None:
    """Half of the pressure just before or behind a pause: 110 or 130 ms, at amplitudes of 1e-6 apart."""
    found = []
    for amplitude in (0.418185, 0.418186):
        document = {
            "muscle": {"preset": "DMSP-20", "nominal_length": "300 mm"}, "effects": {},
            "supply": {"pressure": "6 bar"}, "valve": {"sonic_conductance": 5e-8},
            "tube": {"inside_diameter": "4 mm", "length": "0.5 m"},
            "quick_exhaust": {"sonic_conductance": 5e-8}, "load": {"mass": "20 kg"},
            "pwm": {"frequency": "50 Hz"}, "duration": "0.6 s",
            "command": {"shape": "sine", "amplitude": amplitude, "period": "0.6 s"},
        }  # fmt: skip
        given = drive_of(read_document(document, "pulses"), STUDIO).drive
        grid = np.linspace(0.0, 0.6, 601)
        trace = trace_of(simulate(given, grid=grid))
        assert trace is not None
        table = timing(trace, fill=Phase((0.0, 0.3)), vent=None)
        assert table.extend.pressure_delay_time is not None
        found.append(table.extend.pressure_delay_time)
        first, last = (float(each) for each in table.notes["extend.pressure_delay_time"].split()[1:4:2])
        assert first < 110.5
        assert last > 129.5
    assert found == pytest.approx([0.110, 0.130], abs=1e-3)
