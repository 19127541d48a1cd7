"""Creep and run-in: limits of fast and slow motion, superposition, relaxation, and what rubber remembers."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.application.effect.runs import Swing, driven, run
from mckibben.application.effect.states import MUSCLE
from mckibben.physics.catalogue import default_catalogue

CREEP = default_catalogue()["creep"]
MULLINS = default_catalogue()["mullins"]
SELF_HEATING = default_catalogue()["self_heating"]
TEMPERATURE = default_catalogue()["temperature"]
PRESSURE_CREEP = default_catalogue()["pressure_creep"]
ARMS = 3.0 * 10.0 ** np.array([-1.0, -0.5, 0.0, 0.5, 1.0])  # s


def creep_force(velocity, time: np.ndarray, **constants: float) -> np.ndarray:
    values = CREEP.defaults | {"stiffness": 900.0, "time": 3.0} | constants
    states = run(CREEP, lambda t: {"velocity": velocity(t)}, time, values)
    context = {"muscle": MUSCLE, "length": MUSCLE.nominal_length, "pressure": 4e5}
    return CREEP.call("friction", context, {**values, **states})


@pytest.mark.parametrize("frequency", [1e-3, 0.05, 1.0, 100.0])
def test_creep_has_the_moduli_of_five_maxwell_arms(frequency: float) -> None:
    """Storage and loss stiffness k/5 sum (w tau)^2/(1 + (w tau)^2) and k/5 sum w tau/(1 + (w tau)^2)."""
    w, cycles = 2.0 * np.pi * frequency, min(max(3, int(120.0 * frequency)), 20)
    time = np.linspace(0.0, cycles / frequency, 60 * cycles + 1)
    force = creep_force(lambda t: 0.01 * w * np.cos(w * t), time)
    last = slice(-61, -1)
    sine, cosine = np.sin(w * time[last]), np.cos(w * time[last])
    storage, loss = (2.0 * np.mean(force[last] * part) / 0.01 for part in (sine, cosine))
    turn = w * ARMS
    assert storage == pytest.approx(180.0 * (turn**2 / (1.0 + turn**2)).sum(), abs=2.0)
    assert loss == pytest.approx(180.0 * (turn / (1.0 + turn**2)).sum(), abs=2.0)
    assert loss > 0.0
    if frequency == 100.0:
        assert storage == pytest.approx(900.0, rel=0.01), "fast: all arms"


def pressure_creep_force(pressure_rate, time: np.ndarray, **constants: float) -> np.ndarray:
    values = PRESSURE_CREEP.defaults | {"share": 0.04, "time": 3.0} | constants
    states = run(PRESSURE_CREEP, lambda t: {"pressure_rate": pressure_rate(t)}, time, values)
    return PRESSURE_CREEP.call(
        "friction", {"muscle": MUSCLE, "length": MUSCLE.nominal_length}, {**values, **states}
    )


def test_a_step_of_the_pressure_shows_its_share_late() -> None:
    """-c A P/3 sum exp(-t/tau_j) of a step P, with the effective area A of the ideal braid at rest."""
    time = np.concatenate([np.linspace(0.0, 1e-4, 11), np.geomspace(1.1e-4, 100.0, 300)])
    force = pressure_creep_force(lambda t: 2e9 if t < 1e-4 else 0.0, time)  # 2 bar
    braid = MUSCLE.braid
    area = (3.0 * MUSCLE.nominal_length**2 - braid.thread_length**2) / (4.0 * np.pi * braid.turns**2)
    decays = np.exp(-time[11:, None] / np.array([0.3, 3.0, 30.0]))
    np.testing.assert_allclose(force[11:], -0.04 * area * 2e5 * decays.mean(axis=1), rtol=2e-3, atol=0.02)


def test_slow_changes_of_the_pressure_show_no_creep() -> None:
    """A ramp over many times of the slowest arm ends at -c A rate sum tau_j/3."""
    time = np.linspace(0.0, 3000.0, 601)
    force = pressure_creep_force(lambda _: 1e2, time)
    braid = MUSCLE.braid
    area = (3.0 * MUSCLE.nominal_length**2 - braid.thread_length**2) / (4.0 * np.pi * braid.turns**2)
    assert force[-1] == pytest.approx(-0.04 * area * 1e2 * (0.3 + 3.0 + 30.0) / 3.0, rel=1e-3)


def test_a_spread_of_one_is_a_single_arm() -> None:
    """k v tau (1 - exp(-t/tau)) for a motion at constant speed, whatever the power."""
    time = np.linspace(0.0, 12.0, 241)
    expected = 900.0 * 0.002 * 3.0 * (1.0 - np.exp(-time / 3.0))
    force = creep_force(lambda _: 0.002, time, spread=1.0, power=0.5)
    np.testing.assert_allclose(force, expected, atol=1e-5)


def test_a_power_makes_the_fast_arms_stronger() -> None:
    """A step of 10 mm: k d sum w exp(-t/tau), w of the arms 10^0.4 : 10^0.2 : 1 : 10^-0.2 : 10^-0.4."""
    time = np.concatenate([np.linspace(0.0, 1e-4, 11), np.geomspace(1.1e-4, 100.0, 300)])
    force = creep_force(lambda t: 100.0 if t < 1e-4 else 0.0, time, power=0.4)
    weights = np.array([2.511886, 1.584893, 1.0, 0.630957, 0.398107])
    decays = np.exp(-time[11:, None] / ARMS)
    np.testing.assert_allclose(force[11:], 9.0 * decays @ weights / weights.sum(), atol=5e-3)


def test_slow_motion_adds_nothing() -> None:
    """F tends to k/5 v sum tau, which vanishes with the speed."""
    time = np.linspace(0.0, 400.0, 401)
    assert creep_force(lambda _: 1e-6, time)[-1] == pytest.approx(180.0 * 1e-6 * ARMS.sum(), rel=1e-4)


def test_a_pressed_braid_settles_by_its_share() -> None:
    """-c K x mean(1 - exp(-t/tau)) after a step x, with the braid's stiffness K = 3 L P/(2 pi n^2).

    Under a constant load the muscle therefore moves on by c x, at every pressure.
    """
    time = np.concatenate([np.linspace(0.0, 1e-4, 11), np.geomspace(1.1e-4, 1e4, 300)])
    force = creep_force(lambda t: -100.0 if t < 1e-4 else 0.0, time, stiffness=0.0, share=0.1)
    stiffness = 3.0 * MUSCLE.nominal_length * 4e5 / (2.0 * np.pi * MUSCLE.braid.turns**2)
    settled = 1.0 - np.exp(-time[11:, None] / ARMS).mean(axis=1)
    np.testing.assert_allclose(force[11:], 0.1 * stiffness * 0.01 * settled, rtol=2e-3, atol=0.02)
    assert force[-1] / stiffness == pytest.approx(0.1 * 0.01, rel=1e-6)


def test_creep_superposes() -> None:
    time = np.linspace(0.0, 10.0, 401)

    def one(t: float) -> float:
        return 0.01 * np.sin(t)

    def two(t: float) -> float:
        return 0.02 * np.cos(3.0 * t)

    both = creep_force(lambda t: one(t) + 2.0 * two(t), time)
    np.testing.assert_allclose(both, creep_force(one, time) + 2.0 * creep_force(two, time), atol=1e-5)


def test_relaxation_is_monotone_and_ends_at_zero() -> None:
    """A step of 10 mm in 10 ms: 9 N at first, falling all the time."""
    time = np.concatenate([np.linspace(0.0, 0.01, 11), np.geomspace(0.0101, 300.0, 300)])
    force = creep_force(lambda t: 1.0 if t < 0.01 else 0.0, time)
    after = force[11:]
    assert after[0] == pytest.approx(9.0, rel=0.02)
    assert (np.diff(after) < 0.0).all()
    slowest = 9.0 * np.exp(-300.0 / ARMS).mean()
    assert after[-1] == pytest.approx(slowest, rel=0.02)


def test_isometric_muscle_does_not_creep() -> None:
    force, _ = driven(CREEP, Swing(swing=2e5))
    assert np.array_equal(force, np.zeros_like(force))


def test_run_in_is_over_after_the_first_cycle() -> None:
    """The first cycle differs, the second is the third; memory only grows, and stays at the largest."""
    swing, points = Swing(stretch=0.08, cycles=3), 1200
    force, _ = driven(MULLINS, swing, points=points)
    first, second, third = (force[k * points : (k + 1) * points] for k in range(3))
    assert np.abs(second - first).max() > 1.0
    np.testing.assert_allclose(third, second, atol=0.01)
    time = np.linspace(0.0, 12.0, 2401)
    largest = run(MULLINS, swing.at, time)["largest"]
    assert (np.diff(largest) >= -1e-9).all()
    assert largest[-1] == pytest.approx(0.18, abs=1e-4)


def test_virgin_curve_beyond_the_largest_contraction() -> None:
    """Softer below it, by at most the loss; at and beyond it, and from new, nothing is lost."""
    lengths = MUSCLE.nominal_length * (1.0 - np.array([-0.03, 0.0, 0.05, 0.1499, 0.15, 0.2]))
    values = {"loss": 0.2, "strain": 0.05, "run_in": 0.0}
    factor = MULLINS.call(
        "elastomer_factor", {"muscle": MUSCLE, "length": lengths}, {**values, "largest": 0.15}
    )
    assert factor[:3] == pytest.approx(1.0 - 0.2 * (1.0 - np.exp([-3.0, -3.0, -2.0])), rel=1e-9)
    assert factor[4:] == pytest.approx([1.0, 1.0], abs=1e-12)
    assert (np.diff(factor[1:]) >= 0.0).all()
    new = MULLINS.call("elastomer_factor", {"muscle": MUSCLE, "length": lengths}, values)
    assert np.array_equal(new, np.ones(6))
    # One that had been contracted before is as soft as if it had been so in the record.
    used = MULLINS.call("elastomer_factor", {"muscle": MUSCLE, "length": lengths}, values | {"run_in": 0.15})
    assert np.array_equal(used, factor)


def test_work_warms_the_wall_and_rest_cools_it() -> None:
    """Twice the reference speed: w = 2 (1 - exp(-t/tau)), then it decays with the same time."""
    values = SELF_HEATING.defaults | {"softening": 0.2, "time": 60.0}
    rate = 0.1 * MUSCLE.nominal_length
    time = np.linspace(0.0, 240.0, 4801)
    states = run(
        SELF_HEATING,
        lambda t: {"muscle": MUSCLE, "velocity": np.where((t < 120.0), np.sign(np.sin(t)) * rate, 0.0)},
        time,
        values,
    )
    warmth = np.asarray(states["warmth"])
    assert np.interp([60.0, 120.0, 180.0], time, warmth) == pytest.approx(
        2.0 * np.array([1.0 - np.exp(-1.0), 1.0 - np.exp(-2.0), (1.0 - np.exp(-2.0)) * np.exp(-1.0)]),
        rel=0.01,
    )
    assert SELF_HEATING.call("elastomer_factor", {}, {**values, "warmth": 2.0}) == pytest.approx(np.exp(-0.4))


def test_warming_softens_a_filled_bladder_alike_by_temperature_and_by_work() -> None:
    """Their defaults are one statement: -0.5 % per kelvin at the 20 K of steady work, to first order."""
    by_work = SELF_HEATING.call("elastomer_factor", {"warmth": 1.0}, SELF_HEATING.defaults)
    by_kelvin = TEMPERATURE.call("elastomer_factor", {"temperature": 293.15 + 20.0}, TEMPERATURE.defaults)
    assert float(by_kelvin) == pytest.approx(0.9)
    assert float(by_work) == pytest.approx(float(by_kelvin), abs=0.1**2 / 2)


def test_an_unfilled_bladder_stiffens_by_entropy() -> None:
    """Modulus n k T: in proportion to the absolute temperature, at beta = 1/T0."""
    entropic = TEMPERATURE.defaults | {"coefficient": 1.0 / 293.15}
    got = TEMPERATURE.call("elastomer_factor", {"temperature": 330.0}, entropic)
    assert float(got) == pytest.approx(330.0 / 293.15)
