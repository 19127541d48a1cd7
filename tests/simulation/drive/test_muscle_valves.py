"""Flow control and quick exhaust on the muscle: closed forms of a held muscle, conservation of the air."""

from __future__ import annotations

from collections.abc import Callable
from math import asin
from typing import Any

import numpy as np
import pytest

from mckibben.application.run.simulate import SimulationQuestion, SimulationResult, simulate
from mckibben.documents.drive_reading import drive_of, read_document
from mckibben.physics import gas
from mckibben.physics.errors import InputError
from mckibben.physics.flow_path import quick_exhaust_share
from mckibben.simulation.drive.transient import Run
from mckibben.simulation.drive.transient import simulate as run_drive
from mckibben.simulation.linear.linearise import linearise
from tests.shipped import shipped_studio
from tests.simulation.lsoda import simulated

STUDIO = shipped_studio()
AMBIENT, SUPPLY = 101325.0, 901325.0
VALVE, THROTTLE, QUICK = 1e-8, 4e-9, 5e-8  # m^3/(s Pa)
# A muscle pressed on its stop by 3 kN keeps its volume.
HELD: dict[str, Any] = {
    "muscle": {"inside_diameter": "20 mm", "braid_angle": "25 deg", "nominal_length": "300 mm"},
    "effects": {},
    "supply": {"pressure": "8 bar"},
    "valve": {"sonic_conductance": VALVE, "critical_pressure_ratio": 0.3},
    "load": {"mass": "1 kg", "force": "3 kN", "arrangement": "horizontal"},
    "gas": {"polytropic_exponent": 1.0},
    "command": {"shape": "step", "level": 1.0, "initial": 0.0},
    "duration": "0.6 s",
}
TUBE = {"inside_diameter": "4 mm", "length": "1 m"}
VENTED = {"command": {"shape": "step", "level": -1.0, "initial": -1.0}, "start_pressure": "6 bar"}


def run(**changes: Any) -> SimulationResult:
    drive = drive_of(read_document({**HELD, **changes}, "held"), STUDIO)
    return simulate(SimulationQuestion(drive, points=2001))


def moments(result: SimulationResult, *levels: float) -> list[float]:
    """Times at which the absolute pressure passes levels [Pa]."""
    pressure, time = np.asarray(result.pressure) + AMBIENT, np.asarray(result.time)
    order = np.argsort(pressure)
    return [float(np.interp(level, pressure[order], time[order])) for level in levels]


def test_filling_through_valve_and_flow_control_takes_its_closed_form() -> None:
    result = run(flow_control={"meter": "in", "sonic_conductance": THROTTLE, "critical_pressure_ratio": 0.3})
    # The orifice of the flow control is choked behind the valve: C_1^2 psi(x)^2 = C_2^2 x^2 by bisection.
    low, high = 0.3, 1.0
    for _ in range(60):
        x = 0.5 * (low + high)
        opens = VALVE**2 * (1.0 - ((x - 0.3) / 0.7) ** 2) > THROTTLE**2 * x**2
        low, high = (x, high) if opens else (low, x)
    conductance = THROTTLE * low
    ratio = 1.0 - conductance**2 * 0.7 * (1.0 / VALVE**2 + 1.0 / THROTTLE**2)
    # p' = R T C rho0 p_s psi(p/p_s)/V, integrated: choked, then an arc.
    pace = gas.GAS_CONSTANT * 293.15 * conductance * gas.ANR_DENSITY / result.volume[0]
    first, second = 0.15 * SUPPLY, 0.85 * SUPPLY
    expected = (ratio - 0.15 + (1.0 - ratio) * asin((0.85 - ratio) / (1.0 - ratio))) / pace
    times = moments(result, first, second)
    assert times[1] - times[0] == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize("tube", [None, TUBE])
@pytest.mark.parametrize(("meter", "changes"), [("out", {}), ("in", VENTED)])
def test_the_other_direction_flows_freely(tube: Any, meter: str, changes: dict[str, Any]) -> None:
    free = run(tube=tube, **changes)
    throttled = run(tube=tube, flow_control={"meter": meter, "sonic_conductance": THROTTLE}, **changes)
    assert throttled.pressure == pytest.approx(free.pressure, rel=1e-5, abs=20.0)


def test_meter_out_throttles_the_venting_behind_a_tube() -> None:
    control = {"meter": "out", "sonic_conductance": THROTTLE}
    wide = {"inside_diameter": "8 mm", "length": "0.2 m"}
    result = run(tube=wide, flow_control=control, valve={"sonic_conductance": 1e-7}, **VENTED)
    # Choked at the throttle, with a wide tube and valve behind it: p' = -R T C rho0 p/V.
    times = moments(result, 6e5, 4e5)
    pace = gas.GAS_CONSTANT * 293.15 * THROTTLE * gas.ANR_DENSITY / result.volume[0]
    assert times[1] - times[0] == pytest.approx(np.log(6.0 / 4.0) / pace, rel=2e-3)


def test_a_quick_exhaust_empties_the_muscle_through_its_own_orifice() -> None:
    quick = {"sonic_conductance": QUICK, "critical_pressure_ratio": 0.3, "band": "1 mbar"}
    result = run(tube={"inside_diameter": "4 mm", "length": "0.2 m"}, quick_exhaust=quick, **VENTED)
    times = moments(result, 6e5, 4e5)
    pace = gas.GAS_CONSTANT * 293.15 * QUICK * gas.ANR_DENSITY / result.volume[0]
    assert times[1] - times[0] == pytest.approx(np.log(6.0 / 4.0) / pace, rel=5e-3)


def test_its_lip_lifts_over_a_band() -> None:
    excess = np.array([-1e4, 0.0, 2.5e3, 1e4, 1e5])
    assert quick_exhaust_share(excess=excess, band=1e4) == pytest.approx([0.0, 0.0, 0.25, 1.0, 1.0])


@pytest.mark.parametrize("integrator", [run_drive, simulated], ids=["rodas", "lsoda"])
def test_no_air_is_made_or_lost(integrator: Callable[..., Run]) -> None:
    document = {
        "muscle": {"preset": "DMSP-20", "nominal_length": "300 mm"},
        "valve": {"sonic_conductance": VALVE},
        "load": {"mass": "20 kg", "arrangement": "hanging"},
        "tube": TUBE,
        "flow_control": {"meter": "in", "sonic_conductance": THROTTLE, "free_conductance": "2 l/(s*bar)"},
        "quick_exhaust": {"sonic_conductance": QUICK},
        "command": {"shape": "pulse", "on": 0, "off": 0.4},
        "supply": {"pressure": "6 bar"},
        "duration": "0.8 s",
    }
    drive = drive_of(read_document(document, "lift"), STUDIO).drive
    result = integrator(drive, points=201)
    states = result.states
    assert drive.tube is not None
    in_tube = states["tube_pressure"] * drive.tube.volume / (gas.GAS_CONSTANT * 293.15)
    inside = states["gas_mass"] + in_tube
    passed = states["supplied"] - states["vented"]
    assert passed.max() > 5.0 * inside[0]
    assert inside - inside[0] == pytest.approx(passed, abs=2e-5 * inside.max())
    assert states["pressure"][-1] < 1.05 * AMBIENT


def test_a_linear_model_has_a_side_for_each_direction() -> None:
    drive = {
        "muscle": {"preset": "DMSP-20", "nominal_length": "300 mm"},
        "effects": {},
        "valve": {"sonic_conductance": VALVE},
        "load": {"mass": "20 kg", "arrangement": "hanging"},
        "supply": {"pressure": "6 bar"},
        "tube": TUBE,
        "command": {"shape": "pulse", "on": 0, "off": 0.4},
    }
    control = {"meter": "out", "sonic_conductance": THROTTLE}
    for changes in ({"flow_control": control}, {"quick_exhaust": {"sonic_conductance": QUICK}}):
        found = linearise(drive_of(read_document({**drive, **changes}, "lift"), STUDIO).drive)
        assert not found.smooth
        by_name = {model.name: model for model in found.models}
        row = [state.name for state in by_name["filling"].states].index("tube_pressure")
        assert abs(by_name["venting"].a[row] - by_name["filling"].a[row]).max() > 1.0
        assert any(line.startswith(next(iter(changes)).replace("_", " ")) for line in found.lost)


@pytest.mark.parametrize(
    ("changes", "field"),
    [
        ({"quick_exhaust": {"sonic_conductance": 1e-8}}, "quick_exhaust"),
        ({"flow_control": {"meter": "in", "sonic_conductance": 0}}, "flow_control.sonic_conductance"),
        ({"flow_control": {"meter": "in"}}, "flow_control.sonic_conductance"),
        ({"flow_control": {"meter": "up", "sonic_conductance": 1e-8}}, "flow_control.meter"),
        (
            {"flow_control": {"meter": "in", "sonic_conductance": 2e-8, "free_conductance": 1e-8}},
            "flow_control.free_conductance",
        ),
        (
            {
                "tube": TUBE,
                "flow_control": {"meter": "out", "sonic_conductance": 1e-8},
                "quick_exhaust": {"sonic_conductance": 2e-8},
            },
            "flow_control.meter",
        ),
    ],
)
def test_what_cannot_be_is_refused_at_its_field(changes: dict[str, Any], field: str) -> None:
    with pytest.raises(InputError) as found:
        drive_of(read_document({**HELD, **changes}, "held"), STUDIO)
    assert found.value.field == field
