"""The ideal muscle against published numbers, its second form and independent derivations."""

from __future__ import annotations

from math import cos, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from scipy.integrate import quad

from mckibben.physics import ideal
from mckibben.physics.braid import braid_from_diameter, volume

D0, THETA0, L0, P = 0.010, radians(25.0), 0.100, 0.6e6
BRAID = braid_from_diameter(diameter=D0, braid_angle=THETA0, length=L0)
A0 = pi * D0**2 / 4.0
A, C_B = 3.0 / tan(THETA0) ** 2, 1.0 / sin(THETA0) ** 2
SHORTEST = ideal.zero_force_length(braid=BRAID)


def random_muscles() -> list[tuple[float, float, float, float, float]]:
    """Diameter, angle, length at rest, contraction and pressure of ten muscles."""
    random = np.random.default_rng(18)
    low = (0.005, radians(18.0), 0.06, -0.03, 1e4)
    high = (0.04, radians(35.0), 1.0, 0.4, 8e5)
    return [tuple(map(float, row)) for row in random.uniform(low, high, (10, 5))]


def test_reference_numbers() -> None:
    """Printed to seven digits or more: half a unit of the last digit is the tolerance."""
    assert pytest.approx(13.796730, abs=5e-7) == A
    assert pytest.approx(5.598910, abs=5e-7) == C_B
    assert pytest.approx(8.197820, abs=1e-6) == A - C_B  # 13.796730 - 5.598910, each rounded
    assert ideal.max_contraction(braid_angle=THETA0) == pytest.approx(0.3629645, abs=5e-8)
    assert ideal.force(braid=BRAID, pressure=P, length=L0) == pytest.approx(386.31316, abs=5e-6)
    assert ideal.blocked_force(diameter=D0, braid_angle=THETA0, pressure=P) == pytest.approx(
        386.31316, abs=5e-6
    )
    assert ideal.stiffness(braid=BRAID, pressure=P, length=L0) == pytest.approx(13003.11, abs=5e-3)
    assert ideal.stiffness(braid=BRAID, pressure=P, length=SHORTEST) == pytest.approx(8283.44, abs=5e-3)
    assert ideal.lock_force(braid=BRAID, pressure=P) == pytest.approx(527.6848, abs=5e-5)
    assert ideal.max_work(braid=BRAID, pressure=P, length=L0) == pytest.approx(6.49274, abs=5e-6)


@pytest.mark.parametrize(("exponent", "extra", "ratio"), [(1.0, 37017.40, 3.847), (1.4, 51824.36, 4.986)])
def test_closed_valve_reference_numbers(exponent: float, extra: float, ratio: float) -> None:
    """Extra stiffness at rest without dead volume, absolute pressure 701325 Pa."""
    open_valve = ideal.stiffness(braid=BRAID, pressure=P, length=L0)
    closed = ideal.stiffness_closed(braid=BRAID, pressure=P, length=L0, polytropic_exponent=exponent)
    assert closed - open_valve == pytest.approx(extra, rel=5e-7)
    assert closed / open_valve == pytest.approx(ratio, abs=5e-4)
    # 1 + gamma (p/P) (a - c_b)^2/(2 a)
    shape = (A - C_B) ** 2 / (2.0 * A)
    assert closed / open_valve == pytest.approx(1.0 + exponent * 701325.0 / P * shape, rel=1e-12)


def test_figure_9_of_the_paper_is_the_blocked_force() -> None:
    """64.39, 193.16 as printed; the third is printed 386.32 and is 386.31: see PAPER.md."""
    got = [ideal.blocked_force(diameter=D0, braid_angle=THETA0, pressure=p) for p in (1e5, 3e5, 6e5)]
    assert got == pytest.approx([64.3855, 193.1566, 386.3132], abs=6e-5)
    assert [round(float(force), 2) for force in got[:2]] == [64.39, 193.16]
    assert got[2] == pytest.approx(386.32, abs=0.01)
    assert got[1] / got[0] == pytest.approx(3.0, rel=1e-12)
    assert got[2] / got[0] == pytest.approx(6.0, rel=1e-12)


def test_simscape_run_of_the_paper() -> None:
    """247 mm at 6 bar: at rest, at 40 and 61.7 mm stroke, and stretched by 20 mm."""
    braid = braid_from_diameter(diameter=D0, braid_angle=THETA0, length=0.247)
    strokes = np.array([0.0, 0.040, 0.0617, -0.020])
    got = ideal.force(braid=braid, pressure=P, length=0.247 - strokes)
    assert got == pytest.approx([386.3, 192.8, 102.1, 495.9], abs=0.06)
    assert braid.thread_length - 0.247 == pytest.approx(0.0255, abs=5e-5)
    assert ideal.stiffness(braid=braid, pressure=P, length=0.247) == pytest.approx(5264.0, abs=0.5)


@pytest.mark.parametrize("muscle", random_muscles())
def test_both_forms_are_identical(muscle: tuple[float, float, float, float, float]) -> None:
    """(b, n) against (D0, theta0, L0) with lambda = 1 - contraction."""
    d0, theta0, l0, contraction, pressure = muscle
    braid = braid_from_diameter(diameter=d0, braid_angle=theta0, length=l0)
    lam, length = 1.0 - contraction, l0 * (1.0 - contraction)
    a0, a, c_b = pi * d0**2 / 4.0, 3.0 / tan(theta0) ** 2, 1.0 / sin(theta0) ** 2
    state = {"braid": braid, "pressure": pressure, "length": length}
    v = a0 * l0 * (c_b * lam - a / 3.0 * lam**3)
    g = a0 * (a * lam**2 - c_b)
    k = 2.0 * a * lam * a0 * pressure / l0
    dead = 0.3 * a0 * l0
    # Differences of terms near L_min and near the lock cancel: the tolerance is relative to the terms.
    assert volume(braid=braid, length=length) == pytest.approx(v, abs=1e-12 * a0 * l0 * c_b)
    assert ideal.area(braid=braid, length=length) == pytest.approx(g, abs=1e-12 * a0 * a)
    assert ideal.force(**state) == pytest.approx(pressure * g, abs=1e-12 * pressure * a0 * a)
    assert ideal.stiffness(**state) == pytest.approx(k, rel=1e-12)
    gas = 1.3 * (pressure + 101325.0) * g**2 / (v + dead)
    closed = ideal.stiffness_closed(**state, polytropic_exponent=1.3, dead_volume=dead)
    assert closed == pytest.approx(k + gas, rel=1e-12)
    assert ideal.zero_force_length(braid=braid) / l0 == pytest.approx(
        1.0 - ideal.max_contraction(braid_angle=theta0), rel=1e-12
    )
    assert ideal.lock_force(braid=braid, pressure=pressure) == pytest.approx(
        2.0 * pressure * a0 * c_b, rel=1e-12
    )
    work = pressure * a0 * l0 * (2.0 / (3.0 * sqrt(3.0)) * c_b / cos(theta0) - 1.0)
    assert ideal.max_work(braid=braid, pressure=pressure, length=l0) == pytest.approx(work, rel=1e-11)


def test_force_in_angles_is_the_corrected_equation_10() -> None:
    """P b^2 (2 cos^2 - sin^2)/(4 pi n^2); printed with n instead of n^2."""
    b, n = BRAID
    for theta in np.radians([5.0, 25.0, 40.0, 54.7, 60.0]):
        expected = P * b**2 * (2.0 * cos(theta) ** 2 - sin(theta) ** 2) / (4.0 * pi * n**2)
        got = ideal.force(braid=BRAID, pressure=P, length=b * cos(theta))
        assert got == pytest.approx(expected, rel=1e-12, abs=1e-10)


def test_area_is_the_slope_of_the_volume() -> None:
    lengths, step = np.linspace(0.06, 0.105, 40), 1e-6
    slope = (volume(braid=BRAID, length=lengths + step) - volume(braid=BRAID, length=lengths - step)) / (
        2 * step
    )
    assert ideal.area(braid=BRAID, length=lengths) == pytest.approx(-slope, abs=1e-8 * A0)


def test_work_is_the_integral_of_the_force() -> None:
    work, _ = quad(lambda length: float(ideal.force(braid=BRAID, pressure=P, length=length)), SHORTEST, L0)
    assert ideal.max_work(braid=BRAID, pressure=P, length=L0) == pytest.approx(work, rel=1e-10)


def test_force_vanishes_and_changes_sign_at_the_zero_force_length() -> None:
    assert ideal.force(braid=BRAID, pressure=P, length=SHORTEST) == pytest.approx(0.0, abs=1e-10)
    assert ideal.force(braid=BRAID, pressure=P, length=SHORTEST * 1.001) > 0.0
    assert ideal.force(braid=BRAID, pressure=P, length=SHORTEST * 0.999) < 0.0
    assert ideal.force(braid=BRAID, pressure=0.0, length=L0) == 0.0


@pytest.mark.parametrize("exponent", [1.0, 1.4])
@pytest.mark.parametrize("dead_volume", [0.0, 5e-6])
def test_closed_valve_stiffness_of_a_closed_chamber(exponent: float, dead_volume: float) -> None:
    """A chamber that keeps p (V + V_d)^gamma, moved by hand: its force has the stiffness of the formula."""

    def force(length: float, at: float, absolute: float) -> float:
        chamber, start = (volume(braid=BRAID, length=x) + dead_volume for x in (length, at))
        pressure = absolute * (start / chamber) ** exponent - 101325.0
        return float(ideal.force(braid=BRAID, pressure=pressure, length=length))

    for at in (L0, 0.085, float(SHORTEST), 0.103):
        step = 1e-7
        got = (force(at + step, at, P + 101325.0) - force(at - step, at, P + 101325.0)) / (2.0 * step)
        formula = ideal.stiffness_closed(
            braid=BRAID, pressure=P, length=at, polytropic_exponent=exponent, dead_volume=dead_volume
        )
        assert formula == pytest.approx(got, rel=1e-6)


def test_closed_valve_at_the_zero_force_length_is_as_soft_as_an_open_one() -> None:
    closed = ideal.stiffness_closed(braid=BRAID, pressure=P, length=SHORTEST)
    assert closed == pytest.approx(ideal.stiffness(braid=BRAID, pressure=P, length=SHORTEST), rel=1e-14)


@pytest.mark.parametrize("length", [0.07, 0.09, 0.1, 0.105])
def test_thread_tension_balances_both_directions(length: float) -> None:
    """Free-body cuts of a cylinder of threads: across the axis (axial) and along it (hoop).

    Cut across: N threads at theta carry N T cos(theta) = F + P pi D^2/4. Cut along the length: each thread
    crosses both walls n times, N T n sin(theta) per wall against P D L of the gas.
    """
    threads = 40.0
    theta = np.arccos(length / BRAID.thread_length)
    diameter = BRAID.thread_length * sin(theta) / (BRAID.turns * pi)
    tension = ideal.thread_tension(braid=BRAID, pressure=P, length=length, threads=threads)
    pull = ideal.force(braid=BRAID, pressure=P, length=length)
    assert threads * tension * cos(theta) == pytest.approx(pull + P * pi * diameter**2 / 4.0, rel=1e-12)
    assert 2.0 * threads * tension * BRAID.turns * sin(theta) == pytest.approx(
        P * diameter * length, rel=1e-12
    )


def test_thread_tension_reference() -> None:
    """Size 20 (21.8 mm, 26.6 degrees) at 6 bar: all threads together carry 1998 N at rest."""
    braid = braid_from_diameter(diameter=0.0218, braid_angle=radians(26.6), length=0.3)
    assert ideal.thread_tension(braid=braid, pressure=P, length=0.3) == pytest.approx(1998.0, abs=0.5)
    expected = 2.0 * P * pi * 0.0218**2 / 4.0 * cos(radians(26.6)) / sin(radians(26.6)) ** 2
    assert ideal.thread_tension(braid=braid, pressure=P, length=0.3) == pytest.approx(expected, rel=1e-12)


def test_no_energy_is_created_on_a_closed_path() -> None:
    """The closed integral of F dL equals that of V dP (the muscle takes from the gas what it gives)."""
    s = np.linspace(0.0, 2.0 * pi, 4001)[:-1]
    length, length_rate = 0.085 + 0.015 * np.sin(s), 0.015 * np.cos(s)
    pressure, pressure_rate = 3e5 + 2e5 * np.cos(s + 0.4), -2e5 * np.sin(s + 0.4)
    mechanical = np.mean(ideal.force(braid=BRAID, pressure=pressure, length=length) * length_rate)
    pneumatic = np.mean(volume(braid=BRAID, length=length) * pressure_rate)
    assert mechanical == pytest.approx(pneumatic, rel=1e-12)
    assert abs(mechanical) > 0.01, "a path that encloses something"


def test_stiffness_from_the_force_is_the_tangent_of_the_ideal_muscle() -> None:
    """Equation (20): with the force of the ideal muscle at any pressure it is (19)."""
    for diameter, angle, length0, contraction, pressure in random_muscles():
        braid = braid_from_diameter(diameter=diameter, braid_angle=angle, length=length0)
        length = length0 * (1.0 - contraction)
        force = ideal.force(braid=braid, pressure=pressure, length=length)
        expected = ideal.stiffness(braid=braid, pressure=pressure, length=length)
        got = ideal.stiffness_from_force(braid=braid, force=force, length=length)
        assert got == pytest.approx(expected, rel=1e-9)


def test_secant_stiffness_is_the_mean_of_the_tangent_from_the_shortest_length() -> None:
    """Equation (25): the tangent of the ideal muscle is linear in L, so its mean is that of the two ends."""
    force = ideal.force(braid=BRAID, pressure=P, length=L0)
    secant = ideal.stiffness_secant(force=force, length=L0, shortest=SHORTEST)
    ends = [ideal.stiffness(braid=BRAID, pressure=P, length=length) for length in (SHORTEST, L0)]
    assert secant == pytest.approx(sum(ends) / 2.0, rel=1e-12)
    assert secant == pytest.approx(10643.3, abs=0.1)  # (8283.44 + 13003.11)/2, physics of the tables above
