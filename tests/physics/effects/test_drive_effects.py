"""Valve, tube, supply, gas, load and sensors: each effect's own behaviour against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from mckibben.application.effect.runs import run
from mckibben.documents.drive import GasInput
from mckibben.physics import gas
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.muscle import Muscle

CATALOGUE = default_catalogue()


@pytest.mark.parametrize("damping", [0.5, 0.8])
def test_spool_step_is_that_of_a_damped_oscillator(damping: float) -> None:
    """DC gain 1; 1 - e^{-zeta t/tau} (cos + zeta/sqrt(1 - zeta^2) sin)."""
    time = np.linspace(0.0, 0.05, 501)
    values = {"time": 2e-3, "damping": damping}
    states = run(CATALOGUE["spool_lag"], lambda _: {"opening": 0.8}, time, values, slot="drive_rates")
    root = np.sqrt(1.0 - damping**2)
    turn = root * time / 2e-3
    want = 1.0 - np.exp(-damping * time / 2e-3) * (np.cos(turn) + damping / root * np.sin(turn))
    np.testing.assert_allclose(states["position"], 0.8 * want, atol=1e-5)
    assert states["position"][-1] == pytest.approx(0.8, abs=1e-4)


def test_spool_without_a_lag_is_its_command() -> None:
    opening = CATALOGUE["spool_lag"].call("opening", {"opening": 0.7}, {"time": 0.0, "position": 0.1})
    assert float(opening) == 0.7


def test_deadband_is_shut_inside_and_monotone_outside() -> None:
    commands = np.linspace(-1.0, 1.0, 2001)
    got = CATALOGUE["valve_deadband"].call("opening", {"opening": commands}, {"half_width": 0.05})
    assert not got[np.abs(commands) <= 0.05].any()
    assert got[np.abs(commands) > 0.0501].all()
    assert (np.diff(got) >= 0.0).all()
    assert (got[0], got[-1]) == (-1.0, 1.0)
    np.testing.assert_allclose(got, -got[::-1], atol=1e-15)


def test_supply_droops_with_the_flow_and_comes_back() -> None:
    """1 l/s on 0.2 bar per l/s: 0.2 bar, with the time constant; to the nominal pressure afterwards."""
    effect, flow = CATALOGUE["supply_droop"], 1e-3 * gas.ANR_DENSITY
    time = np.linspace(0.0, 10.0, 1001)
    values = {"droop": 2e7, "time": 0.5}
    drop = run(effect, lambda t: {"supply_flow": flow if t < 5.0 else 0.0}, time, values, slot="drive_rates")[
        "drop"
    ]
    assert np.interp(0.5, time, drop) == pytest.approx(2e4 * (1.0 - np.exp(-1.0)), rel=1e-3)
    assert np.interp(5.0, time, drop) == pytest.approx(2e4, rel=1e-3)
    assert drop[-1] == pytest.approx(2e4 * np.exp(-10.0), abs=20.0)
    supply = effect.call("supply", {"supply_pressure": 7e5}, {**values, "drop": drop})
    assert float(supply.min()) == pytest.approx(6.8e5, rel=1e-3)
    assert float(supply[-1]) == pytest.approx(7e5, abs=20.0)


def test_gas_at_rest_fills_the_bore_that_a_wall_leaves() -> None:
    """pi/4 D^2 L0 of the braid less the wall is pi/4 (D - 2t)^2 L0; the wall is at most a fifth of D."""
    muscle = Muscle(nominal_length=0.3, braid_diameter=0.02, braid_angle=0.45)
    for thickness, bore in ((0.0, 0.02), (0.0015, 0.017), (0.004, 0.012), (0.006, 0.012)):
        taken = CATALOGUE["wall_volume"].call("extra_volume", {"muscle": muscle}, {"thickness": thickness})
        assert np.pi / 4.0 * 0.02**2 * 0.3 + float(taken) == pytest.approx(np.pi / 4.0 * bore**2 * 0.3)


def test_silencer_blows_down_exponentially_while_it_is_choked() -> None:
    """10 ml behind 1e-8 m3/(s Pa): tau = V/(C_s p0), C_s = C f/sqrt(1 - f^2), down to ambient over 0.3."""
    effect, ambient = CATALOGUE["silencer"], 1e5
    values = {"factor": 0.6, "volume": 1e-5}
    around = {"exhaust_conductance": 1e-8, "ambient_pressure": ambient}
    time = np.linspace(0.0, 0.2, 201)
    into = gas.ANR_DENSITY * 0.75e-8 * 5e5  # so much leaves at 5 bar

    def flow(t: float) -> dict[str, float]:
        return {**around, "exhaust_flow": into if t < 0.15 else 0.0}

    excess = run(effect, flow, time, values, slot="drive_rates")["excess"]
    p0 = gas.ANR_DENSITY * gas.GAS_CONSTANT * gas.ANR_TEMPERATURE
    tau = 1e-5 / (0.75e-8 * p0)
    assert np.interp(0.15, time, excess) == pytest.approx(4e5, rel=2e-3), "steady: as much out as in"
    assert np.interp(0.155, time, excess) + ambient == pytest.approx(5e5 * np.exp(-0.005 / tau), rel=5e-3)
    sink = effect.call("exhaust_sink", {"sink_pressure": ambient}, {"factor": 0.6, "excess": excess})
    assert np.array_equal(sink, ambient + excess)
    without = effect.call("exhaust_sink", {"sink_pressure": ambient}, {"factor": 1.0, "excess": excess})
    assert np.array_equal(without, np.full(201, ambient))


def test_sensor_lag_has_gain_1_and_the_width_of_a_false_loop() -> None:
    """A ramp is read late by exactly the time constant; the other channels are read at once."""
    effect = CATALOGUE["sensor_lag"]
    time = np.linspace(0.0, 1.0, 501)

    def ramp(t: float) -> dict[str, float]:
        return {
            "instant_force_reading": 300.0 * min(t, 0.5),
            "instant_pressure_reading": 2e5,
            "instant_stroke_reading": 0.01,
        }

    values = {"force_time": 0.02}
    states = run(effect, ramp, time, values, slot="drive_rates")
    assert np.interp(0.45, time, states["force_first"]) == pytest.approx(300.0 * (0.45 - 0.02), rel=1e-6)
    assert states["force_first"][-1] == pytest.approx(150.0, rel=1e-6)
    both = {**effect.defaults, **values, **states}
    assert np.array_equal(effect.call("force_reading", {"reading": 1.0}, both), states["force_first"])
    assert float(effect.call("pressure_reading", {"reading": 2e5}, both)[0]) == 2e5
    assert np.array_equal(states["stroke_first"], np.zeros(501)), "a channel without a lag costs nothing"


def test_two_equal_stages_are_critically_damped() -> None:
    """The step response of 1/(1 + tau p)^2 is 1 - (1 + t/tau) exp(-t/tau)."""
    effect = CATALOGUE["sensor_lag"]
    time = np.linspace(0.0, 0.2, 201)
    at = {"instant_pressure_reading": 1e5, "instant_force_reading": 0.0, "instant_stroke_reading": 0.0}
    values = {"pressure_time": 0.02, "second_share": 1.0, "force_time": 0.0}
    states = run(effect, lambda _: at, time, values, slot="drive_rates")
    shown = effect.call("pressure_reading", {"reading": 1e5}, {**effect.defaults, **values, **states})
    assert shown == pytest.approx(1e5 * (1.0 - (1.0 + time / 0.02) * np.exp(-time / 0.02)), abs=0.5)


def test_leak_flows_out_and_stops_at_equal_pressures() -> None:
    leak = CATALOGUE["leak"]
    pressures = np.array([0.9e5, 1e5, 1.0005e5, 2e5, 7e5, 8e5])
    flows = leak.call(
        "leakage",
        {"absolute_pressure": pressures, "ambient_pressure": 1e5, "gas_temperature": 293.15},
        leak.defaults,
    )
    assert flows[0] < 0.0
    assert flows[1] == 0.0
    assert (np.diff(flows) > 0.0).all()
    assert flows[5] / flows[4] == pytest.approx(8.0 / 7.0, rel=1e-12), "choked: exponential in pressure"


def test_closed_muscle_leaks_with_its_time_constant() -> None:
    """Choked at constant temperature: tau = V/(C p0), p0 = rho0 R T0."""
    leak, conductance, volume = CATALOGUE["leak"], 1e-10, 1e-4
    p0 = gas.ANR_DENSITY * gas.GAS_CONSTANT * gas.ANR_TEMPERATURE
    context = {"absolute_pressure": 7e5, "ambient_pressure": 1e5, "gas_temperature": 293.15}
    flow = leak.call("leakage", context, leak.defaults | {"conductance": conductance})
    rate = gas.GAS_CONSTANT * 293.15 * flow / volume
    assert 7e5 / rate == pytest.approx(volume / (conductance * p0), rel=1e-12)


def leak_flow(pressure: object, *, temperature: float = 293.15, **values: float) -> np.ndarray:
    """Mass flow of a leak of 1e-10 m3/(s Pa) against 1 bar [kg/s]."""
    leak = CATALOGUE["leak"]
    context = {"absolute_pressure": pressure, "ambient_pressure": 1e5, "gas_temperature": temperature}
    return leak.call("leakage", context, leak.defaults | {"conductance": 1e-10} | values)


def test_a_laminar_leak_goes_with_the_difference_of_squares() -> None:
    """7 to 2 bar as 48 to 3; 4 bar as through the orifice, whatever the share; 0.5 bar back as -0.75 to 3."""
    flows = leak_flow(np.array([7e5, 2e5, 1e5, 0.5e5]), laminar_share=1.0)
    assert flows / flows[1] == pytest.approx([16.0, 1.0, 0.0, -0.25], rel=1e-12)
    for share in (0.0, 0.3, 1.0):
        assert leak_flow(4e5, laminar_share=share) == pytest.approx(1e-10 * 1.185 * 4e5, rel=1e-12)
    pressures = np.linspace(0.6e5, 9e5, 200)
    assert (np.diff(leak_flow(pressures, laminar_share=0.5)) > 0.0).all()


def test_a_closed_muscle_with_a_laminar_leak_decays_as_a_hyperbolic_cotangent() -> None:
    """dp/dt = -K (p^2 - p_a^2) from 7 bar, isothermal: p = p_a coth(K p_a t + arcoth 7)."""
    volume = 1e-4
    rate = 1e-10 * gas.ANR_DENSITY * gas.GAS_CONSTANT * 293.15 / (volume * 3.75e5)
    time = np.linspace(0.0, 30.0, 7)

    def falling(_: float, p: np.ndarray) -> np.ndarray:
        return -gas.GAS_CONSTANT * 293.15 / volume * leak_flow(p, laminar_share=1.0)

    got = solve_ivp(falling, (0.0, 30.0), [7e5], t_eval=time, rtol=1e-10, atol=1e-3).y[0]
    want = 1e5 / np.tanh(rate * 1e5 * time + np.arctanh(1.0 / 7.0))
    assert got == pytest.approx(want, rel=1e-8)
    assert got[-1] < 2e5, "most of it has gone"


def test_heat_flows_from_warm_to_cold_over_the_wall() -> None:
    heat = CATALOGUE["heat_exchange"]

    def into_gas(temperature: float) -> float:
        context = {
            "length": 0.3,
            "diameter": 0.02,
            "gas_temperature": temperature,
            "ambient_temperature": 293.0,
        }
        return float(heat.call("heat", context, heat.defaults))

    assert into_gas(293.0) == 0.0
    assert into_gas(350.0) < 0.0 < into_gas(250.0)


def test_size_20_cools_within_a_second() -> None:
    """tau = m c_v/(h A), 0.83 g of air at 7 bar over 0.0195 m^2: 0.6-1.5 s for 50-20 W/(m^2 K)."""
    heat = CATALOGUE["heat_exchange"]
    context = {"length": 0.3, "diameter": 0.02, "gas_temperature": 294.0, "ambient_temperature": 293.0}
    for coefficient, seconds in ((20.0, 1.53), (50.0, 0.61)):
        loss = -float(heat.call("heat", context, {"coefficient": coefficient}))
        assert 0.83e-3 * gas.HEAT_CAPACITY_V / loss == pytest.approx(seconds, rel=0.03)


def test_delays() -> None:
    tube = CATALOGUE["tube_delay"].call("command_delay", {"tube_length": 1.0}, {"factor": 1.0})
    assert tube == pytest.approx((2.914e-3, 2.914e-3), rel=1e-3)
    valve = CATALOGUE["valve_delay"]
    assert valve.call("command_delay", {"tube_length": 1.0}, valve.defaults) == (0.005, 0.0075)


def test_guide_friction_holds_then_slides() -> None:
    """A spring of F_c/x_g from rest, the Stribeck curve after a long way, twice as stiff at a reversal."""
    effect = CATALOGUE["guide_friction"]
    values = {"force": 5.0, "static_share": 0.4, "stribeck_speed": 0.01, "break_way": 1e-4}

    def force(speed: float, states: dict[str, np.ndarray]) -> np.ndarray:
        return effect.call("guide", {"speed": speed, "load": 0.0}, {**effect.defaults, **values, **states})

    time = np.linspace(0.0, 1.0, 10001)
    turned = 0.5
    creep = 0.005
    states = run(
        effect, lambda t: {"speed": creep if t < turned else -creep}, time, values, slot="drive_rates"
    )
    shown = force(0.0, states)
    sliding = 5.0 * (1.0 + 0.4 * np.exp(-0.5))
    assert (shown[1] - shown[0]) / (creep * time[1]) == pytest.approx(5.0 / 1e-4, rel=5e-3)
    assert shown[4990] == pytest.approx(sliding, rel=1e-6)
    assert shown[-1] == pytest.approx(-sliding, rel=1e-6)
    after = (shown[5002] - shown[5001]) / (-creep * (time[1] - time[0]))
    assert after == pytest.approx(2.0 * 5.0 / 1e-4, rel=0.02), (
        "bristles bent the other way spring back as well"
    )


def test_guide_friction_of_grease_grows_with_the_speed() -> None:
    guide = CATALOGUE["guide_friction"]
    values = {**guide.defaults, "force": 0.0, "coefficient": 10.0, "presliding": 1.0}
    assert guide.call("guide", {"speed": -0.3, "load": 0.0}, values) == pytest.approx(-3.0)


def test_guide_friction_grows_with_the_load_that_presses_on_it() -> None:
    """Coulomb's law: 5 N of the seals, and 2 % of a load of 400 N."""
    guide = CATALOGUE["guide_friction"]
    values = {**guide.defaults, "force": 5.0, "load_share": 0.02, "presliding": -1.0}
    assert guide.call("guide", {"speed": 0.0, "load": 400.0}, values) == pytest.approx(-13.0)


def test_heat_exchange_starts_from_the_coefficient_that_a_drive_has_without_it() -> None:
    assert CATALOGUE["heat_exchange"].defaults["coefficient"] == GasInput().wall_heat_transfer
