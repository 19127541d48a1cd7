"""Joints in time against equations and an integrator of their own: six paths, with slack and stops.

The valves are shut, so each muscle keeps its gas, p (V + V_d)^n constant. The ideal muscle has no force at
the length b / sqrt(3), whatever its pressure: slack it stays there, and so does its volume.
"""

from __future__ import annotations

from collections.abc import Callable
from math import cos, pi, radians, sin, sqrt, tan
from typing import Any, NamedTuple

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import mckibben as mk
from mckibben.documents.drive_reading import drive_of
from mckibben.door.workspace import studio
from mckibben.simulation.drive.transient import TOLERANCE, simulate

D0, L0, ALPHA = 0.02, 0.3, radians(25.0)
MUSCLE = {"inside_diameter": "20 mm", "braid_angle": "25 deg", "nominal_length": "300 mm"}
TIMES = np.linspace(0.0, 0.2, 201)
EXPONENT, DEAD, ATMOSPHERE, START = 1.2, 3e-5, 101_325.0, 3e5
THREAD = L0 / cos(ALPHA)
TURNS = THREAD * sin(ALPHA) / (pi * D0)
FREE = THREAD / sqrt(3.0)


def volume(length: float) -> float:
    return (THREAD**2 - length**2) * length / (4.0 * pi * TURNS**2)


def force(pressure: float, length: float) -> float:
    k = 1.0 - length / L0
    return pi * D0**2 / 4.0 * pressure * (3.0 / tan(ALPHA) ** 2 * (1.0 - k) ** 2 - 1.0 / sin(ALPHA) ** 2)


class Case(NamedTuple):
    """A joint of a drive document, its lengths over the angle, other torques, where it is let go."""

    joint: dict[str, Any]
    lengths: tuple[Callable[[float], float], ...]
    begin: float
    passive: Callable[[float], float] = lambda angle: 0.0
    restitution: float = 0.0


def strut(angle: float) -> float:
    x, y = 0.045 * cos(angle) + 0.01 * sin(angle), 0.045 * sin(angle) - 0.01 * cos(angle)
    return sqrt(x * x + (y - 0.33) ** 2) - 0.05


WIDE = {"min_angle": -0.55, "max_angle": 0.55}
CASES = {
    "pair on a pulley, one goes slack": Case(
        {
            "muscles": [
                {"path": {"lever": 0.05, "contraction": 0.25}},
                {"path": {"lever": -0.05, "contraction": 0.25}},
            ],
            "inertia": 0.004,
            "stops": {"min_angle": -0.9, "max_angle": 0.9},
        },
        (lambda a: 0.75 * L0 - 0.05 * a, lambda a: 0.75 * L0 + 0.05 * a),
        -0.8,
    ),
    "pair on a cam": Case(
        {
            "muscles": [
                {"path": {"lever": "0.03 - 0.008*angle**2 + 0.004*angle", "contraction": 0.1}},
                {"path": {"lever": "0.028*(cos(angle) - 2)", "contraction": 0.08}},
            ],
            "inertia": 0.002,
            "stops": WIDE,
        },
        (
            lambda a: 0.9 * L0 - (0.03 * a - 0.008 * a**3 / 3.0 + 0.002 * a**2),
            lambda a: 0.92 * L0 - 0.028 * (sin(a) - 2.0 * a),
        ),
        0.3,
    ),
    "single with a spring, against a stop that rebounds": Case(
        {
            "muscles": [{"path": {"lever": 0.025}}],
            "spring": {"stiffness": 8.0, "relaxed_at": 0.2},
            "inertia": 0.003,
            "stops": {"min_angle": 0.0, "max_angle": 1.2},
        },
        (lambda a: L0 - 0.025 * a,),
        0.05,
        lambda a: -8.0 * (a - 0.2),
        0.4,
    ),
    "two points and a link": Case(
        {
            "muscles": [
                {"path": {"points": {"origin": [0.0, 0.33], "insertion": [0.045, -0.01]}, "tendon": 0.05}}
            ],
            "link": {"mass": 2.5, "centre": 0.4, "level_at": 0.35},
            "inertia": 0.4,
            "stops": {"min_angle": -0.2, "max_angle": 0.9},
        },
        (strut,),
        0.1,
        lambda a: -2.5 * 9.80665 * 0.4 * cos(a - 0.35),
    ),
    "a formula of the length": Case(
        {
            "muscles": [{"path": {"length": "0.3 - 0.03*sin(angle) - 0.004*angle"}}],
            "spring": {"stiffness": 12.0},
            "inertia": 0.002,
            "stops": {"min_angle": 0.0, "max_angle": 1.0},
        },
        (lambda a: 0.3 - 0.03 * sin(a) - 0.004 * a,),
        0.1,
        lambda a: -12.0 * a,
    ),
    "a table of a straight lever": Case(
        {
            "muscles": [
                {
                    "path": {
                        "table": {"angle": [-0.6, -0.1, 0.6], "lever": [0.036, 0.031, 0.024]},
                        "length": 0.28,
                    }
                }
            ],
            "spring": {"stiffness": 15.0, "relaxed_at": -0.1},
            "inertia": 0.003,
        },
        (lambda a: 0.28 - 0.03 * a + 0.005 * a * a,),
        -0.4,
        lambda a: -15.0 * (a + 0.1),
    ),
}  # fmt: skip


def own_run(case: Case, low: float, high: float, inertia: float, times: np.ndarray) -> np.ndarray:
    """Angles by the eighth-order method of Dormand and Prince, from stop to stop."""
    gas = [
        (START + ATMOSPHERE) * (volume(max(of(case.begin), FREE)) + DEAD) ** EXPONENT for of in case.lengths
    ]

    def torque(angle: float) -> float:
        total = case.passive(angle)
        for kept, of in zip(gas, case.lengths, strict=True):
            length, step = of(angle), 1e-5
            pressure = kept / (volume(max(length, FREE)) + DEAD) ** EXPONENT - ATMOSPHERE
            lever = (of(angle - step) - of(angle + step)) / (2.0 * step)
            total += lever * force(pressure, length) if length > FREE else 0.0
        return total

    def rates(_: float, y: np.ndarray) -> list[float]:
        return [y[1], torque(y[0]) / inertia]

    angles = np.full(len(times), np.nan)
    begin, y = 0.0, [case.begin, 0.0]
    while begin < times[-1]:
        events: list[Any] = [lambda _, s: s[0] - low, lambda _, s: s[0] - high]
        for event, way in zip(events, (-1.0, 1.0), strict=True):
            event.terminal, event.direction = True, way
        run = solve_ivp(
            rates, (begin, times[-1]), y, method="DOP853", rtol=1e-10, atol=1e-12, events=events,
            dense_output=True, max_step=1e-2,
        )  # fmt: skip
        inside = (times >= begin) & (times <= run.t[-1])
        angles[inside] = run.sol(times[inside])[0]
        begin = float(run.t[-1])
        if run.status != 1:
            break
        stop = low if run.y[0, -1] < 0.5 * (low + high) else high
        y = [stop, -case.restitution * float(run.y[1, -1])]
        pressed = torque(stop) * (1.0 if stop == high else -1.0) >= 0.0
        if abs(y[1]) < 1e-3 and pressed:
            angles[times > begin] = stop
            break
    return angles


@pytest.mark.parametrize("name", CASES)
def test_angles_of_six_joints_over_time(name: str) -> None:
    case = CASES[name]
    rim = float(np.asarray(mk.Joint(
        case.joint["muscles"], muscle=MUSCLE, **{k: v for k, v in case.joint.items() if k != "muscles"}
    ).lever(0.5 * sum(_stops(case)))))  # fmt: skip
    drive = mk.Drive(
        MUSCLE,
        valve={"sonic_conductance": "1e-9 m^3/(s*Pa)"},
        command={"shape": "step", "level": 0.0, "initial": 0.0},
        load={"arrangement": "joint", "joint": case.joint},
        gas={"polytropic_exponent": EXPONENT, "dead_volume": DEAD},
        start_pressure=START,
        start={"position": abs(rim) * case.begin},
        stops={"restitution": case.restitution},
        duration=TIMES[-1],
        effects={},
    )
    low, high = _stops(case)
    angles = own_run(case, low, high, case.joint["inertia"], TIMES)
    known = np.isfinite(angles)
    assert np.count_nonzero(known) > 0.9 * len(angles)
    for tolerance, within in ((1e-9, 1e-5), (TOLERANCE, 5e-4)):
        found = simulate(drive_of(drive.parsed, studio()).drive, grid=TIMES, tolerance=tolerance)
        assert found.outcome.label == "completed"
        assert found.drive.path is not None
        assert np.max(np.abs(found.states["stroke"] / found.drive.path.rim - angles)[known]) < within
    run = drive.run()
    if "slack" in name:
        assert any("slack" in event.kind for event in run.details.events)
    if "rebounds" in name:
        assert any("rebounds" in event.kind for event in run.details.events)


def _stops(case: Case) -> tuple[float, float]:
    stops = case.joint.get("stops", {"min_angle": -0.6, "max_angle": 0.6})
    return stops["min_angle"], stops["max_angle"]


def test_a_constant_lever_is_a_pulley() -> None:
    """The same equations in another form: a pair on a pulley, and two muscles with the levers +r and -r."""
    shared: dict[str, Any] = {
        "valve": "VPPM-6", "duration": "1 s", "start_pressure": "3 bar",
        "command": {"shape": "square", "level": 0.7, "initial": 0.3, "period": "1 s"},
    }  # fmt: skip
    turn = 0.03 * 0.8 / 0.3
    pulley = mk.Drive(
        "DMSP-20:300mm",
        load={"arrangement": "antagonist", "pulley_radius": 0.03, "mass": 0.004 / 0.03**2,
              "precontraction": 0.1},
        stops={"min_contraction": 0.1 - turn, "max_contraction": 0.1 + turn},
        **shared,
    ).run().details.joint  # fmt: skip
    muscles = [{"path": {"lever": sense * 0.03, "contraction": 0.1}} for sense in (1.0, -1.0)]
    joint = {"muscles": muscles, "inertia": 0.004, "stops": {"min_angle": -0.8, "max_angle": 0.8}}
    path = (
        mk.Drive("DMSP-20:300mm", load={"arrangement": "joint", "joint": joint}, **shared).run().details.joint
    )
    assert pulley is not None
    assert path is not None
    for name, scale in (("angle", 1.0), ("torque", 30.0), ("stiffness", 30.0)):
        assert getattr(path, name) == pytest.approx(getattr(pulley, name), abs=1e-9 * scale)


FOLLOWING = (
    ("joint-cam", -5, 10, 2.5, 15, 0.03),
    ("joint-spring", 25, 40, 2.5, 15, 0.03),
    ("joint-knee", -50, -35, 0.2, 2, 0.01),
)


@pytest.mark.parametrize(("name", "low", "high", "kp", "ki", "kd"), FOLLOWING)
def test_a_controller_follows_the_angle_over_a_changing_lever(
    name: str, low: int, high: int, kp: float, ki: float, kd: float
) -> None:
    angle = {"shape": "step", "initial": f"{low} deg", "level": f"{high} deg", "at": "3 s"}
    drive = mk.Drive.load(name)
    values = {key: value for key, value in drive.document.items() if key not in ("command", "controller")}
    control = {"type": "pid", "kp": kp, "ki": ki, "kd": kd, "sample_time": "2 ms", "angle": angle}
    run = mk.Drive(**{**values, "controller": control, "duration": "6 s"}).run().details
    assert run.joint is not None
    for moment, wanted in ((2.99, low), (6.0, high)):
        found = run.joint.angle[np.searchsorted(run.time, moment)]
        assert found == pytest.approx(radians(wanted), abs=radians(0.3)), moment
