"""Flow and chamber against the standard's own numbers, published tables and a data sheet's example."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.physics import gas

COLD = {"temperature_from": 293.15, "temperature_to": 293.15}


def flow(p1: float, p2: float, c: float = 1e-8, b: float = 0.3) -> float:
    return float(gas.mass_flow(pressure_from=p1, pressure_to=p2, conductance=c, critical_ratio=b, **COLD))


def test_choked_flow_is_c_rho_p():
    assert flow(7e5, 1e5) == pytest.approx(1e-8 * 1.185 * 7e5, rel=1e-12)
    assert flow(7e5, 0.3 * 7e5) == pytest.approx(flow(7e5, 1e5), rel=1e-12)


def test_flow_reverses_and_vanishes_at_equal_pressure():
    assert flow(5e5, 5e5) == 0.0
    for low in np.linspace(1e5, 6.999e5, 40):
        assert flow(low, 7e5) == pytest.approx(-flow(7e5, low), rel=1e-12)
        assert flow(7e5, low) > 0.0


def test_flow_function_is_continuous_where_it_changes_form():
    for joint in (0.3, gas.LAMINAR_RATIO):
        below, above = (float(gas.flow_function(ratio=joint + d, critical_ratio=0.3)) for d in (-1e-9, 1e-9))
        assert below == pytest.approx(above, abs=1e-6)


@pytest.mark.parametrize("ratios", [(0.3, 0.3), (0.2, 0.45), (0.45, 0.2), (0.5, 0.5), (0.0, 0.3)])
@pytest.mark.parametrize("first", [0.05, 0.29, 0.31, 0.6, 1.0, 2.0, 10.0])
def test_two_restrictions_in_series_are_nearly_one(first: float, ratios: tuple[float, float]) -> None:
    one, other = ratios
    conductance, ratio = gas.in_series(first=first, first_ratio=one, second=1.0, second_ratio=other)

    def psi(r: float, b: float) -> float:
        return 1.0 if r <= b else (1.0 - ((r - b) / (1.0 - b)) ** 2) ** 0.5

    def through_both(r: float) -> float:
        low, high = r, 1.0  # the pressure between both, by bisection
        for _ in range(60):
            x = 0.5 * (low + high)
            low, high = (x, high) if first * psi(x, one) > x * psi(r / x, other) else (low, x)
        return first * psi(low, one)

    for r, tolerance in ((0.001, 1e-6), (0.2, 0.015), (0.5, 0.015), (0.8, 0.015), (0.99, 1e-3)):
        assert float(conductance) * psi(r, float(ratio)) == pytest.approx(through_both(r), rel=tolerance)


def test_nothing_flows_through_a_closed_restriction_in_series():
    for first, second in ((0.0, 1e-8), (1e-8, 0.0), (0.0, 0.0)):
        found = gas.in_series(first=first, first_ratio=0.3, second=second, second_ratio=0.3)
        assert float(found[0]) == 0.0
        assert np.isfinite(found[1])


def test_worked_example_of_a_data_sheet():
    # SMC: C = 2 l/(s bar), b = 0.3, 0.4 to 0.3 MPa gauge at 20 degC: 600 * 2 * 0.5 * 0.7 = 420 l/min ANR.
    volume_flow = flow(5e5, 4e5, c=2e-8) / gas.ANR_DENSITY * 6e4
    assert volume_flow == pytest.approx(420.0, rel=2e-3)


@pytest.mark.parametrize(
    ("nominal", "by_ratio"),
    [
        (100, (0.46, 0.43, 0.40, 0.37)),
        (700, (3.19, 3.00, 2.81, 2.60)),
        (2000, (9.11, 8.58, 8.02, 7.42)),
    ],
)
def test_conductance_of_a_nominal_flow(nominal, by_ratio):
    for b, expected in zip((0.2, 0.3, 0.4, 0.5), by_ratio, strict=True):
        c = gas.conductance_of_nominal_flow(nominal_flow=nominal / 6e4, critical_ratio=b)
        assert c * 1e8 == pytest.approx(expected, abs=0.006)
        # Definition: 7 to 6 bar absolute must pass the nominal flow again.
        assert flow(7e5, 6e5, c=c, b=b) == pytest.approx(nominal / 6e4 * 1.293, rel=1e-9)


@pytest.mark.parametrize(
    ("diameter", "length", "c", "b"),
    [(2.6e-3, 0.5, 0.53, 0.37), (4e-3, 1.0, 1.20, 0.35), (4e-3, 2.0, 0.93, 0.28), (7e-3, 5.0, 2.60, 0.25)],
)
def test_tube_after_eckersten(diameter, length, c, b):
    assert gas.tube_conductance(diameter=diameter, length=length) * 1e8 == pytest.approx(c, abs=0.006)
    assert gas.tube_critical_ratio(diameter=diameter, length=length) == pytest.approx(b, abs=0.006)


def test_choked_filling_rate_of_a_rigid_chamber():
    # 1 l/(s bar) from 7 bar into 1 l, isothermal: 7 bar/s (times rho0 R T0 / p0 of the reference state).
    rate = gas.pressure_rate(
        pressure=1e5,
        volume=1e-3,
        volume_rate=0.0,
        mass_flow=flow(7e5, 1e5),
        temperature=293.15,
        polytropic_exponent=1.0,
    )
    assert rate == pytest.approx(7e5, rel=4e-3)


def test_closed_chamber_keeps_p_v_to_the_n():
    for exponent in (1.0, 1.4):
        rate = gas.pressure_rate(
            pressure=3e5,
            volume=1e-3,
            volume_rate=-1e-4,
            mass_flow=0.0,
            temperature=293.15,
            polytropic_exponent=exponent,
        )
        h = 1e-5
        expected = 3e5 * ((1e-3 / (1e-3 - 1e-4 * h)) ** exponent - (1e-3 / (1e-3 + 1e-4 * h)) ** exponent)
        assert rate == pytest.approx(expected / (2 * h), rel=1e-9)
