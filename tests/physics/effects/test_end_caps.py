"""End caps: solid geometry, Tondu's factor as their limit, and what the force maps of two muscles ask for."""

from __future__ import annotations

from math import pi, radians, tan

import numpy as np
import pytest

from mckibben.physics import ideal
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.model import Model, State
from mckibben.physics.muscle import Muscle

EFFECT = default_catalogue()["end_caps"]
THETA = radians(25.0)


def evaluate(
    muscle: Muscle, cone_factor: float, length: object, pressure: float = 6e5, threadless: float = 0.0
) -> State:
    values = {"end_caps": {"cone_factor": cone_factor, "threadless_factor": threadless}}
    return Model([EFFECT]).evaluate(muscle=muscle, values=values, length=length, pressure=pressure)


@pytest.mark.parametrize("cone_factor", [0.7, 1.0, 1.5])
@pytest.mark.parametrize("inside", [0.0, 0.008])
def test_volume_is_a_cylinder_and_two_truncated_cones(cone_factor: float, inside: float) -> None:
    muscle = Muscle(0.1, 0.01, THETA, 0.0, inside)
    for length in (0.07, 0.085, 0.095):
        got = evaluate(muscle, cone_factor, length)
        d, fitting = float(got.diameter), inside or 0.01
        cone = cone_factor * (d - fitting) / 2.0
        truncated = pi * cone / 12.0 * (d**2 + d * fitting + fitting**2)
        assert got.volume == pytest.approx(
            pi * d**2 / 4.0 * (length - 2.0 * cone) + 2.0 * truncated, rel=1e-12
        )


def test_is_tondus_factor_for_small_contraction() -> None:
    """k - 1 = chi cot^2(theta0) D0/(3 L0), from dF = -2 a (k - 1) A0 P eps."""
    muscle = Muscle(0.3, 0.0218, THETA)
    small = 1e-4
    length = 0.3 * (1.0 - small)
    change = evaluate(muscle, 1.3, length).force - ideal.force(
        braid=muscle.braid, pressure=6e5, length=length
    )
    a, a0 = 3.0 / tan(THETA) ** 2, pi * 0.0218**2 / 4.0
    k = 1.0 - change / (2.0 * a * a0 * 6e5 * small)
    assert k - 1.0 == pytest.approx(1.3 / tan(THETA) ** 2 * 0.0218 / (3.0 * 0.3), rel=1e-3)


@pytest.mark.parametrize(
    ("nominal", "diameter", "angle", "fitted"), [(0.3, 0.0218, 26.6, 1.12), (0.25, 0.0118, 25.0, 1.075)]
)
def test_real_cones_explain_the_factors_fitted_to_two_muscles(
    nominal: float, diameter: float, angle: float, fitted: float
) -> None:
    """Force maps of a DMSP-20-300 and a DMSP-10-250 (Martens & Boblan 2017) ask for k = 1.12 and 1.075.

    Cones of 35 to 55 degrees are chi = 1.43 to 0.7.
    """
    muscle = Muscle(nominal, diameter, radians(angle))
    a, a0 = 3.0 / tan(radians(angle)) ** 2, pi * diameter**2 / 4.0

    def tondu(cone_factor: float) -> float:
        """F = P A0 (a (1 - k eps)^2 - c_b) solved for k at eps = 5 %."""
        whole = ideal.force(braid=muscle.braid, pressure=6e5, length=0.95 * nominal)
        change = evaluate(muscle, cone_factor, 0.95 * nominal).force - whole
        return float((1.0 - np.sqrt(0.95**2 + change / (6e5 * a0 * a))) / 0.05)

    assert tondu(0.7) < fitted < tondu(1.43)


def test_a_long_muscle_is_ideal() -> None:
    """The relative loss falls as 1/L0."""
    losses = []
    for nominal in (0.1, 1.0, 10.0):
        muscle = Muscle(nominal, 0.01, THETA)
        whole = ideal.force(braid=muscle.braid, pressure=6e5, length=0.9 * nominal)
        losses.append(float(1.0 - evaluate(muscle, 1.0, 0.9 * nominal).force / whole))
    assert losses[0] / losses[1] == pytest.approx(10.0, rel=1e-9)
    assert losses[1] / losses[2] == pytest.approx(10.0, rel=1e-9)


def test_a_stretched_muscle_has_no_cones() -> None:
    muscle = Muscle(0.1, 0.01, THETA)
    lengths = np.array([0.1001, 0.103])
    got = evaluate(muscle, 1.5, lengths)
    assert np.array_equal(got.volume, evaluate(muscle, 0.0, lengths).volume)
    assert np.array_equal(got.force, evaluate(muscle, 0.0, lengths).force)
    near = evaluate(muscle, 1.5, np.array([0.1 - 1e-9, 0.1 + 1e-9])).force
    assert near[0] == pytest.approx(near[1], abs=1e-4), "no step in force where the cones begin"


def test_ends_without_thread_leave_it_to_a_shorter_cylinder() -> None:
    """Cylinder of all the thread, of length L_a with L = L_a + chi (D(L_a) - D_0), and its two cones.

    At rest the force is P A_0 (2 a k/3 - 1), k = 1/(1 - a chi D_0/(3 L_0)), a = 3/tan^2(theta_0): there the
    cones are as wide as the cylinder, and only the cylinder shortens.
    """
    muscle, factor = Muscle(0.3, 0.02, 0.45), 0.6
    thread, turns = muscle.braid
    cylinder = 0.26
    wide = np.sqrt(thread**2 - cylinder**2) / (pi * turns)
    step = wide - 0.02
    cones = pi / 12.0 * factor * step * (wide**2 + wide * 0.02 + 0.02**2)
    here = evaluate(muscle, 0.0, cylinder + factor * step, 1e5, threadless=factor)
    assert here.volume == pytest.approx(pi / 4.0 * wide**2 * cylinder + cones, rel=1e-9)
    a = 3.0 / tan(0.45) ** 2
    grown = 1.0 / (1.0 - a * factor * 0.02 / 0.9)
    rest = evaluate(muscle, 0.0, 0.3, 1e5, threadless=factor)
    assert rest.force == pytest.approx(1e5 * pi / 4.0 * 0.02**2 * (2.0 * a * grown / 3.0 - 1.0), rel=1e-6)
