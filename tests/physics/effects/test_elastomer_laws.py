"""The elastomer under braid kinematics against small-strain theory of a tube and a hand-derived slope."""

from __future__ import annotations

from math import pi, radians, sqrt, tan

import numpy as np
import pytest
from scipy.integrate import quad

from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.model import Model
from mckibben.physics.muscle import Muscle

CATALOGUE = default_catalogue()
DEFAULTS = CATALOGUE["bladder_elasticity"].defaults
MUSCLE = Muscle(0.3, 0.0218, radians(26.5), 0.0018)
# Klute & Hannaford 2000
LATEX = DEFAULTS | {"shear_modulus": 118.4e3, "mooney_constant": 105.7e3, "stiffening": 0.0}


def tension(length: float, values: dict[str, float] = LATEX, muscle: Muscle = MUSCLE) -> float:
    """Tension of the bladder alone [N]: without pressure nothing else pulls."""
    model = Model([CATALOGUE["bladder_elasticity"]])
    return float(
        model.evaluate(
            muscle=muscle, values={"bladder_elasticity": values}, length=length, pressure=0.0
        ).force
    )


def test_published_latex_figures() -> None:
    assert [tension(0.3 * (1.0 - e)) for e in (0.0, 0.05, 0.1, 0.2)] == pytest.approx(
        [0.0, -78.939, -100.678, -108.932], abs=1e-3
    )


def test_initial_stiffness_is_that_of_a_tube_under_a_braid() -> None:
    """k_e = (2/3)(E A_w/L0)[1 + q^2 + (q - 1)^2], q = cot^2(theta0), E = 6 (C10 + C01)."""
    q = 1.0 / tan(MUSCLE.braid_angle) ** 2
    bare = 6.0 * (118.4e3 + 105.7e3) * pi * 0.0218 * 0.0018 / 0.3
    stiffness = 2.0 / 3.0 * bare * (1.0 + q**2 + (q - 1.0) ** 2)
    assert stiffness == pytest.approx(9695.0, abs=1.0)
    assert bare == pytest.approx(553.0, abs=1.0), "17.5 times softer"
    step = 1e-6
    assert (tension(0.3 + step) - tension(0.3 - step)) / (2.0 * step) == pytest.approx(stiffness, rel=1e-6)


def test_tension_is_the_derivative_of_mooney_and_rivlins_energy() -> None:
    """dW/dlambda_z written out with the stretches and their slopes."""
    cot2 = 1.0 / tan(MUSCLE.braid_angle) ** 2
    rubber = pi * 0.0218 * 0.0018 * 0.3
    for lam in (1.02, 0.97, 0.9, 0.78):
        hoop = sqrt(1.0 + cot2 * (1.0 - lam**2))
        radial = 1.0 / (lam * hoop)
        hoop_slope = -lam * cot2 / hoop
        radial_slope = -(hoop + lam * hoop_slope) / (lam * hoop) ** 2
        first = 2.0 * (lam + hoop * hoop_slope + radial * radial_slope)
        second = -2.0 * (lam**-3 + hoop**-3 * hoop_slope + radial**-3 * radial_slope)
        expected = rubber / 0.3 * (118.4e3 * first + 105.7e3 * second)
        assert tension(0.3 * lam) == pytest.approx(expected, rel=1e-11)


def test_a_stiffening_wall_is_gents_to_second_order() -> None:
    """-C10 J ln(1 - x/J), x = I1 - 3, of chains with a limit J, differentiated by hand; y = 1/(2 J)."""
    limit = 200.0
    cot2 = 1.0 / tan(MUSCLE.braid_angle) ** 2
    for lam in (1.01, 0.97, 0.9):
        hoop2 = 1.0 + cot2 * (1.0 - lam**2)
        first = lam**2 + hoop2 + 1.0 / (lam**2 * hoop2) - 3.0
        slope = 2.0 * lam - 2.0 * lam * cot2 - 2.0 / (lam**3 * hoop2) + 2.0 * cot2 / (lam * hoop2**2)
        gent = pi * 0.0218 * 0.0018 * 250e3 * slope / (1.0 - first / limit)
        wall = DEFAULTS | {"shear_modulus": 250e3, "mooney_constant": 0.0, "stiffening": 0.5 / limit}
        assert tension(0.3 * lam, wall) == pytest.approx(gent, rel=2.0 * (first / limit) ** 2 + 1e-12)


def test_stretch_pulls_and_contraction_pushes() -> None:
    assert tension(0.31) > 0.0 > tension(0.29)


@pytest.mark.parametrize("exponent", [0.5, 1.6, 2.0])
def test_the_tension_of_a_spring_grows_with_the_power_of_the_stroke(exponent: float) -> None:
    """At 10 % of 300 mm stiffness times stroke; at 20 % 2^m times that; odd about the nominal length."""
    effect = CATALOGUE["linear_elasticity"]
    values = {"linear_elasticity": effect.defaults | {"stiffness": 1000.0, "exponent": exponent}}
    lengths = np.array([0.3, 0.27, 0.24, 0.33])
    got = Model([effect]).evaluate(muscle=MUSCLE, values=values, length=lengths, pressure=0.0).force
    assert got == pytest.approx([0.0, -30.0, -30.0 * 2.0**exponent, 30.0], rel=1e-9, abs=1e-12)


def test_linear_elasticity_stores_half_k_x_squared() -> None:
    effect = CATALOGUE["linear_elasticity"]
    values = {"linear_elasticity": effect.defaults | {"stiffness": 3000.0}}
    model = Model([effect])

    def force(length: float) -> float:
        return float(model.evaluate(muscle=MUSCLE, values=values, length=length, pressure=0.0).force)

    work, _ = quad(force, 0.27, 0.3)
    assert work == pytest.approx(-0.5 * 3000.0 * 0.03**2, rel=1e-10)
    assert np.sign(force(0.31)) == 1.0


def test_filled_rubber_softens_with_its_strain() -> None:
    """Energy V C10 int ((j + c^2)/(1 + c^2))^(-n/2) dj by quadrature; its tension is dW/dL."""
    muscle = Muscle(0.3, 0.0218, radians(26.5), 0.0018)
    bladder = default_catalogue()["bladder_elasticity"]
    values = bladder.defaults | {"shear_modulus": 4e5, "softening": 0.8, "onset": 0.4}

    def energy(length: float) -> float:
        axial = (length / 0.3) ** 2
        hoop = 1.0 + (1.0 - axial) / tan(radians(26.5)) ** 2
        strain = np.linspace(0.0, axial + hoop + 1.0 / (axial * hoop) - 3.0, 20001)
        stiffness = ((strain + 0.16) / 1.16) ** -0.4
        return float(pi * 0.0218 * 0.0018 * 0.3 * 4e5 * np.trapezoid(stiffness, strain))

    for length in (0.29, 0.25):
        slope = (energy(length + 1e-5) - energy(length - 1e-5)) / 2e-5
        tension = bladder.call("elastomer", {"muscle": muscle, "length": length}, values)
        assert float(tension) == pytest.approx(slope, rel=1e-5)
