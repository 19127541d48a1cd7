"""Joints at rest against formulas of their own: six paths, torque, stiffness, equilibrium, pressures."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from math import atan2, cos, hypot, pi, radians, sin, sqrt, tan
from typing import Any, NamedTuple

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

import mckibben as mk

D0, L0, ALPHA = 0.02, 0.3, radians(25.0)
MUSCLE = {"inside_diameter": "20 mm", "braid_angle": "25 deg", "nominal_length": "300 mm", "preset": None}
GAMMA, ATMOSPHERE = 1.4, 101_325.0


def force(pressure: float, length: complex) -> complex:
    """F = (pi D0^2 p / 4) (3 (1 - k)^2 / tan^2 - 1 / sin^2), Tondu & Lopez 2000; no force where it pushes."""
    k = 1.0 - length / L0
    found = pi * D0**2 / 4.0 * pressure * (3.0 / tan(ALPHA) ** 2 * (1.0 - k) ** 2 - 1.0 / sin(ALPHA) ** 2)
    return found if np.real(found) > 0.0 else 0.0 * found


def volume(length: complex) -> complex:
    """pi D^2 L / 4 with D = b sin / (n pi), cos = L / b."""
    b = L0 / cos(ALPHA)
    n = b * sin(ALPHA) / (pi * D0)
    return (b**2 - length**2) * length / (4.0 * pi * n**2)


def slope(of: Callable[[complex], complex], at: float) -> float:
    return float(np.imag(of(at + 1e-30j)) / 1e-30)


class Case(NamedTuple):
    """A joint document, and the length of each muscle over the angle by a formula of its own."""

    parts: dict[str, Any]
    lengths: tuple[Callable[[complex], complex], ...]
    passive: Callable[[complex], complex] = lambda angle: 0.0 * angle


def between(
    origin: tuple[float, float], insertion: tuple[float, float], cord: float
) -> Callable[[complex], complex]:
    """Length by the coordinates of both points."""

    def length(angle: complex) -> complex:
        c, s = np.cos(angle), np.sin(angle)
        x = insertion[0] * c - insertion[1] * s - origin[0]
        y = insertion[0] * s + insertion[1] * c - origin[1]
        return np.sqrt(x * x + y * y) - cord

    return length


KNEE = np.radians([-115.0, -90.0, -60.0, -30.0, 0.0]), np.array([12.0, 24.0, 34.0, 40.0, 44.0]) * 1e-3
_knee = PchipInterpolator(*KNEE)


def knee(angle: complex) -> complex:
    """Lever by monotone cubics, length by 40 points of Gauss-Legendre in each interval, from 0 downwards."""
    at, weight = np.polynomial.legendre.leggauss(40)
    real = float(np.real(angle))
    ends = [real, *[float(b) for b in KNEE[0] if b > real]]
    area = sum(
        0.5 * (b - a) * float(weight @ _knee(0.5 * (b - a) * at + 0.5 * (a + b))) for a, b in pairwise(ends)
    )
    return 0.295 - area + 1j * np.imag(angle) * float(_knee(real))


PULLEY = (
    {"path": {"lever": "30 mm", "contraction": "10 %"}},
    {"path": {"lever": "-30 mm", "contraction": "10 %"}},
)
CASES = {
    "pair on a pulley": Case(
        {"muscles": PULLEY, "stops": {"min_angle": "-0.6 rad", "max_angle": "0.6 rad"}},
        (lambda a: 0.9 * L0 - 0.03 * a, lambda a: 0.9 * L0 + 0.03 * a),
    ),
    "pair on a cam": Case(
        {
            "muscles": [
                {"path": {"lever": "0.03 - 0.008*angle**2 + 0.004*angle", "contraction": "10 %"}},
                {"path": {"lever": "0.028*(cos(angle) - 2)", "contraction": 0.08}},
            ],
            "stops": {"min_angle": "-0.5 rad", "max_angle": "0.5 rad"},
        },
        (
            lambda a: 0.9 * L0 - (0.03 * a - 0.008 * a**3 / 3.0 + 0.002 * a**2),
            lambda a: 0.92 * L0 - 0.028 * (np.sin(a) - 2.0 * a),
        ),
    ),
    "single with a spring": Case(
        {
            "muscles": [{"path": {"lever": "25 mm"}}],
            "spring": {"stiffness": "8 N*m/rad", "relaxed_at": "10 deg"},
            "stops": {"min_angle": "0 deg", "max_angle": "100 deg"},
        },
        (lambda a: L0 - 0.025 * a,),
        lambda a: -8.0 * (a - radians(10.0)),
    ),
    "two points, link and cord": Case(
        {
            "muscles": [
                {
                    "path": {
                        "points": {"origin": ["0 mm", "330 mm"], "insertion": ["45 mm", "-10 mm"]},
                        "tendon": "60 mm",
                    }
                }
            ],
            "link": {"mass": "1.2 kg", "centre": "150 mm", "level_at": "20 deg"},
            "stops": {"min_angle": "-30 deg", "max_angle": "50 deg"},
        },
        (between((0.0, 0.33), (0.045, -0.01), 0.06),),
        lambda a: -1.2 * 9.80665 * 0.15 * np.cos(a - radians(20.0)),
    ),
    "knee of a table": Case(
        {
            "muscles": [
                {
                    "path": {
                        "table": {"angle": KNEE[0].tolist(), "lever": (-KNEE[1]).tolist()},
                        "length": "295 mm",
                    }
                }
            ]
        },
        (knee,),
    ),
    "a formula of the length": Case(
        {
            "muscles": [{"path": {"length": "0.3 - 0.03*sin(angle) - 0.004*angle"}}],
            "stops": {"min_angle": "-0.2 rad", "max_angle": "1 rad"},
        },
        (lambda a: 0.3 - 0.03 * np.sin(a) - 0.004 * a,),
    ),
}  # fmt: skip


def joint_of(case: Case) -> mk.Joint:
    muscle = {name: value for name, value in MUSCLE.items() if value is not None}
    return mk.Joint(
        case.parts["muscles"], muscle=muscle, **{k: v for k, v in case.parts.items() if k != "muscles"}
    )


def torque(case: Case, angle: complex, pressures: tuple[float, ...]) -> float:
    """By virtual work: - sum F dL/d angle."""
    parts = (
        -float(np.real(force(p, of(angle)))) * slope(of, float(np.real(angle)))
        for p, of in zip(pressures, case.lengths, strict=True)
    )
    return sum(parts) + float(np.real(case.passive(angle)))


def stiffness(case: Case, angle: float, pressures: tuple[float, ...], *, closed: bool = False) -> float:
    """- d torque / d angle by Richardson's extrapolation, at the pressure that a closed gas has there."""

    def at(other: float) -> float:
        changed = list(pressures)
        if closed:
            for place, of in enumerate(case.lengths):
                ratio = float(np.real(volume(of(angle)) / volume(of(other))))
                changed[place] = (pressures[place] + ATMOSPHERE) * ratio**GAMMA - ATMOSPHERE
        return torque(case, other, tuple(changed))

    def central(h: float) -> float:
        return (at(angle + h) - at(angle - h)) / (2.0 * h)

    return -(4.0 * central(5e-4) - central(1e-3)) / 3.0


@pytest.mark.parametrize("name", CASES)
def test_torque_and_stiffness_of_six_joints(name: str) -> None:
    case, joint = CASES[name], joint_of(CASES[name])
    low, high = joint.stops
    pressures = (2.5e5, 4e5)[: len(case.lengths)]
    angles = np.linspace(low + 0.011, high - 0.013, 9)
    result = joint.statics([list(pressures)], points=3)
    found = joint.torque(angle=angles, pressures=list(pressures))
    for angle, value in zip(angles, found, strict=True):
        assert value == pytest.approx(torque(case, angle, pressures), rel=1e-9, abs=1e-9)
    middle = float(result.angle[1])
    if name == "knee of a table":  # its lever bends at the rows of the table
        middle = float(result.angle[1])
        assert min(abs(middle - KNEE[0])) > 2e-3
    assert result.stiffness[0, 1] == pytest.approx(stiffness(case, middle, pressures), rel=1e-7, abs=1e-7)
    closed = stiffness(case, middle, pressures, closed=True)
    assert result.stiffness_closed[0, 1] == pytest.approx(closed, rel=1e-7, abs=1e-7)


def test_a_pair_rests_where_both_torques_are_equal() -> None:
    """Of the pulley: p1 g(L1) = p2 g(L2) has a closed form, a quadratic in the angle."""
    joint = joint_of(CASES["pair on a pulley"])
    a, b = 3.0 / tan(ALPHA) ** 2, 1.0 / sin(ALPHA) ** 2
    for first, second in ((4e5, 3e5), (3e5, 3e5), (2e5, 2.3e5)):
        u = 0.03 / L0
        square = a * u * u * (first - second)
        line, rest = -2.0 * a * 0.9 * u * (first + second), (a * 0.81 - b) * (first - second)
        wanted = 0.0 if square == 0.0 else (-line - sqrt(line**2 - 4.0 * square * rest)) / (2.0 * square)
        rests = joint.statics([[first, second]]).rests
        assert [rest.angle for rest in rests] == [pytest.approx(wanted, abs=1e-11)]
        assert not rests[0].at_stop


def test_pressures_for_an_angle_and_a_stiffness() -> None:
    joint = joint_of(CASES["pair on a cam"])
    for angle, wanted, external in ((0.2, 14.0, 0.0), (-0.25, 7.5, 2.0)):
        answer = joint.statics(angle=angle, stiffness=wanted, torque=external).answer
        assert answer is not None
        assert answer.pressures is not None
        pressures = tuple(answer.pressures.tolist())
        case = CASES["pair on a cam"]
        assert torque(case, angle, pressures) + external == pytest.approx(0.0, abs=1e-7)
        assert stiffness(case, angle, pressures) == pytest.approx(wanted, rel=1e-7)
    answer = joint.statics(angle=0.2, stiffness=500.0)
    assert answer.answer is not None
    assert answer.answer.pressures is None
    assert "out of reach" in str(answer.flags[-1])
    held = joint.statics(angle=0.2, torque=1e3)
    assert any("hold the joint" in str(flag) for flag in held.flags)


def test_the_region_holds_what_pressures_give() -> None:
    """No pair of pressures on a fine grid that holds an angle has a stiffness outside of the region."""
    joint = joint_of(CASES["pair on a pulley"])
    region = joint.statics(points=3).region
    assert region is not None
    case = CASES["pair on a pulley"]
    place = 40
    angle = float(region.angle[place])
    values = []
    for second in np.linspace(0.0, 6e5, 200):
        first = second * float(
            np.real(force(1.0, case.lengths[1](angle)) / force(1.0, case.lengths[0](angle)))
        )
        if first <= 6e5:
            values.append(stiffness(case, angle, (first, second)))
    assert region.least_stiffness[place] <= min(values) + 1e-9
    assert max(values) - 1e-6 <= region.most_stiffness[place] <= max(values) * 1.01


def test_a_slack_muscle_neither_pulls_nor_is_stiff() -> None:
    joint = joint_of(CASES["single with a spring"])
    angle = np.radians([90.0])
    limp = mk.Joint(
        [{"path": {"lever": "60 mm"}}],
        muscle={k: v for k, v in MUSCLE.items() if v is not None},
        stops={"min_angle": 0.0, "max_angle": 2.0},
    )
    assert float(limp.torque(angle=[1.9], pressures=[3e5])[0]) == 0.0  # free at 36.3 %
    result = limp.statics([[3e5]])
    assert result.stiffness[0, -1] == 0.0
    assert float(joint.torque(angle=angle, pressures=[3e5])[0]) == pytest.approx(
        torque(CASES["single with a spring"], float(angle[0]), (3e5,)), abs=1e-9
    )


def test_two_points_have_the_lever_of_their_line() -> None:
    """The lever is the distance of the pivot from the line through both points."""
    joint = joint_of(CASES["two points, link and cord"])
    for angle in np.radians([-20.0, 0.0, 35.0]):
        c, s = cos(angle), sin(angle)
        x, y = 0.045 * c + 0.01 * s, 0.045 * s - 0.01 * c
        distance = abs(x * 0.33) / hypot(x, y - 0.33)
        assert abs(float(joint.lever(angle))) == pytest.approx(distance, rel=1e-12)
        assert atan2(y, x) < pi / 2.0
