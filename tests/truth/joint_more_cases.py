"""More joints: the other effects on the other paths, and two hidden at once, one of them in the joint."""

from __future__ import annotations

from collections.abc import Callable
from math import radians
from typing import Any, NamedTuple

import numpy as np

from tests.truth import elastomer, friction, geometry, sensors
from tests.truth.cases import BOOK, Case
from tests.truth.composition import Hidden, accept
from tests.truth.elastic_cases import size
from tests.truth.joints import Path, Turned, cam, hanging, jointed, pulley, rubbing, strut
from tests.truth.muscle import Muscle, made

REACH: dict[str, dict[str, Any]] = {
    "cam": {}, "pulley": {"high": 1.5}, "strut": {"low": -0.9, "high": 0.5, "rows": 120},
}  # fmt: skip


def _path(kind: str, m: Muscle) -> Path:
    if kind == "strut":
        return strut(m, 0.12 * m.nominal)
    return cam(m, 0.1 * m.nominal, 0.35, 0.015) if kind == "cam" else pulley(m, 0.11 * m.nominal, 0.0)


def _wall(m: Muscle) -> Hidden:
    # Rubber of about the same share of the muscle's force in every size.
    c = 0.2e6 * m.blocked / 1572.0 * 0.0218 / m.diameter
    return elastomer.bladder(m, elastomer.yeoh(c, -0.03 * c, 0.01 * c))


def _ends(m: Muscle) -> Hidden:
    return geometry.rounded_ends(m, 2.2, "end_caps", "contraction_factor")


def _contact(m: Muscle) -> Hidden:
    return geometry.late_contact(28e3, 6e3, "threshold_pressure", "pressure_offset")


def _zero(m: Muscle) -> Hidden:
    return sensors.zero_error("pressure", -14e3, "pressure_offset")


def _scale(m: Muscle) -> Hidden:
    ids = ("pressure_scale", "force_scale", "effectiveness")
    return sensors.bent_scale("pressure", 0.95, 0.004, 6e5, *ids)


def _spring(m: Muscle) -> Hidden:
    return elastomer.soft_spring(m, 0.6 * m.blocked / m.nominal)


def _braid(m: Muscle) -> Hidden:
    ids = ("coulomb_friction", "dahl", "bouc_wen", "maxwell_slip")
    return friction.bristles(0.012 * m.blocked, 4e-4, *ids)


def _bearing(m: Muscle) -> Turned:
    rub = rubbing(0.009 * m.blocked * 0.11 * m.nominal, 0.15)
    return Turned(accept("bearing_friction"), rub=rub, name="a journal that rubs")


def _link(m: Muscle) -> Turned:
    weight = hanging(0.025 * m.blocked * 0.1 * m.nominal, 0.3, 0.15)
    return Turned(accept("link_weight"), weight=weight, name="a bent link")


def _lever(m: Muscle) -> Turned:
    return Turned(accept("lever_scale"), lever=0.93, name="a cable that has worn its groove")


def _angle(m: Muscle) -> Turned:
    return Turned(accept("angle_offset"), angle=radians(3.5), name="an index mark beside its zero")


class Told(NamedTuple):
    """What is hidden on which path."""

    path: str
    joint: Callable[[Muscle], Turned] | None
    muscle: Callable[[Muscle], Hidden] | None


CASES = {
    "joint-link-cam": Told("cam", _link, None),
    "joint-bearing-pulley": Told("pulley", _bearing, None),
    "joint-lever-pulley": Told("pulley", _lever, None),
    "joint-threshold-cam": Told("cam", None, _contact),
    "joint-ends-strut": Told("strut", None, _ends),
    "joint-pressure-scale-pulley": Told("pulley", None, _scale),
    "joint-bladder-strut": Told("strut", None, _wall),
    "joint-spring-cam": Told("cam", None, _spring),
    "pair-joint-bearing-bladder-strut": Told("strut", _bearing, _wall),
    "pair-joint-lever-pressure-zero-cam": Told("cam", _lever, _zero),
    "pair-joint-link-bladder-pulley": Told("pulley", _link, _wall),
    "pair-joint-angle-bladder-cam": Told("cam", _angle, _wall),
    "pair-joint-bearing-ends-pulley": Told("pulley", _bearing, _ends),
    "pair-joint-angle-pressure-zero-cam": Told("cam", _angle, _zero),
    "pair-joint-lever-friction-cam": Told("cam", _lever, _braid),
    "pair-joint-link-threshold-pulley": Told("pulley", _link, _contact),
}


def _recipe(name: str, told: Told, number: int) -> None:
    def make(rng: np.random.Generator, seed: int) -> Case:
        m = made(size(seed, number % 3), rng)
        reach = dict(REACH[told.path])
        return jointed(
            name, seed, m, _path(told.path, m), rng,
            turned=told.joint(m) if told.joint else Turned(),
            hidden=(told.muscle(m),) if told.muscle else (), **reach,
        )  # fmt: skip

    BOOK.recipe(name)(make)


for _number, (_name, _told) in enumerate(CASES.items()):
    _recipe(_name, _told, _number)
