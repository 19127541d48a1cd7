"""A pressure regulator: two orifices with a flow limit, the lag of its set point, dead band; closed forms."""

from __future__ import annotations

from math import exp, pi, sqrt
from typing import Any

import numpy as np
import pytest

from mckibben.application.run.simulate import SimulationQuestion, SimulationResult, simulate
from mckibben.documents.drive_reading import drive_of, read_document
from mckibben.physics import gas
from mckibben.physics.errors import InputError
from mckibben.physics.flow_path import regulator_shares
from tests.shipped import shipped_studio

STUDIO = shipped_studio()
CONDUCTANCE = 1e-8  # m^3/(s Pa)
# A muscle pressed on its stop by 2 kN keeps its volume.
HELD: dict[str, Any] = {
    "muscle": {"inside_diameter": "20 mm", "braid_angle": "25 deg", "nominal_length": "300 mm"},
    "effects": {},
    "supply": {"pressure": "8 bar"},
    "valve": {"sonic_conductance": CONDUCTANCE, "critical_pressure_ratio": 0.3},
    "load": {"mass": "1 kg", "force": "3 kN", "arrangement": "horizontal"},
    "gas": {"polytropic_exponent": 1.0},
    "command": {"shape": "step", "level": 1.0, "initial": 0.0},
    "duration": "0.4 s",
}


def run(regulator: dict[str, Any], **changes: Any) -> SimulationResult:
    document = read_document({**HELD, "regulator": regulator, **changes}, "held")
    return simulate(SimulationQuestion(drive_of(document, STUDIO), points=2001))


def test_the_orifices_open_with_the_error_beyond_the_dead_band() -> None:
    error = np.array([-1e5, -2.5e4, -1e4, -500.0, 0.0, 500.0, 1e4, 2.5e4, 1e5])
    fill, exhaust = regulator_shares(error=error, band=4e4, dead_band=2e3)
    assert fill == pytest.approx([0, 0, 0, 0, 0, 0, 9e3 / 4e4, 2.4e4 / 4e4, 1.0])
    assert exhaust == pytest.approx(fill[::-1])


def test_far_from_its_set_point_it_fills_with_the_choked_flow_of_its_orifice() -> None:
    result = run({"range": "6 bar", "time": "0.1 ms"})
    pressure, time = np.asarray(result.pressure) + 101325.0, np.asarray(result.time)
    choked = (time > 0.002) & (pressure < 0.3 * 9.01325e5)
    slope = np.polyfit(time[choked], pressure[choked], 1)[0]
    # p' = R T m'/V with m' = C rho0 p_s, at constant volume and temperature.
    inflow = CONDUCTANCE * gas.ANR_DENSITY * 9.01325e5
    assert choked.sum() > 20
    assert slope == pytest.approx(gas.GAS_CONSTANT * 293.15 * inflow / result.volume[0], rel=2e-3)


def test_it_holds_its_set_point_and_not_the_pressure_of_the_supply() -> None:
    result = run({"range": "6 bar", "time": "5 ms"}, command={"shape": "step", "level": 0.5, "initial": 0.0})
    assert result.pressure[-1] == pytest.approx(3e5, abs=20.0)
    low = run({"range": "6 bar", "time": "5 ms"}, supply={"pressure": "2 bar"}, duration="2 s")
    assert low.pressure[-1] == pytest.approx(2e5, rel=5e-3)


def test_a_lag_of_second_order_overshoots_as_its_closed_form() -> None:
    damping, time = 0.4, 0.02
    regulator = {"range": "6 bar", "time": time, "damping": damping}
    result = run(regulator, command={"shape": "step", "level": 0.5, "initial": 0.0})
    assert result.regulator_pressure is not None
    set_point = np.asarray(result.regulator_pressure)
    assert set_point.max() / 3e5 - 1.0 == pytest.approx(exp(-pi * damping / sqrt(1 - damping**2)), rel=1e-3)
    peak = result.time[int(np.argmax(set_point))]
    assert peak == pytest.approx(pi * time / sqrt(1.0 - damping**2), rel=5e-3)


def test_within_its_dead_band_it_stays_where_it_is() -> None:
    command = {"shape": "step", "level": 0.5, "initial": 0.0}
    result = run({"range": "6 bar", "time": "5 ms", "dead_band": "0.2 bar"}, command=command, duration="1 s")
    assert result.pressure[-1] == pytest.approx(3e5 - 0.1e5, abs=100.0)
    assert np.asarray(result.supply_flow)[-1] < 1e-5


def test_impossible_figures_are_refused_at_their_field() -> None:
    for changed, field in (
        ({"dead_band": "7 bar"}, "regulator.dead_band"),
        ({"band": "0 bar"}, "regulator.band"),
        ({"damping": 0.0}, "regulator.damping"),
    ):
        with pytest.raises(InputError) as caught:
            run({"range": "6 bar", "time": "5 ms", **changed})
        assert caught.value.field == field
