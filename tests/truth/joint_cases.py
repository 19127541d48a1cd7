"""Joints in which one effect is hidden, or nothing: of muscle, lever, bearing or link."""

from __future__ import annotations

from math import radians

import numpy as np

from tests.truth import elastomer, friction, geometry, sensors
from tests.truth.cases import BOOK, Case
from tests.truth.composition import accept
from tests.truth.elastic_cases import size
from tests.truth.joints import Turned, cam, hanging, jointed, pulley, rubbing, strut
from tests.truth.muscle import made


@BOOK.recipe("joint-lever-cam")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    path = cam(m, 0.1 * m.nominal, 0.35, 0.01)
    turned = Turned(accept("lever_scale"), lever=1.08, name="a cable above its groove")
    return jointed("joint-lever-cam", seed, m, path, rng, turned=turned)


@BOOK.recipe("joint-angle-zero-cam")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    path = cam(m, 0.1 * m.nominal, 0.5, 0.02)
    turned = Turned(accept("angle_offset"), angle=radians(3.5), name="an index mark beside its zero")
    return jointed("joint-angle-zero-cam", seed, m, path, rng, turned=turned, low=-0.1)


@BOOK.recipe("joint-bearing-strut")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    path = strut(m, 0.12 * m.nominal)
    rub = rubbing(0.008 * m.blocked * 0.12 * m.nominal, 0.15)
    turned = Turned(accept("bearing_friction"), rub=rub, name="a journal that rubs")
    return jointed("joint-bearing-strut", seed, m, path, rng, turned=turned, low=-0.9, high=0.5, rows=120)


@BOOK.recipe("joint-link-pulley")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 2), rng)
    path = pulley(m, 0.1 * m.nominal, 0.0)
    weight = hanging(0.02 * m.blocked * 0.1 * m.nominal, 0.3, 0.15)
    turned = Turned(accept("link_weight"), weight=weight, name="a bent link")
    return jointed("joint-link-pulley", seed, m, path, rng, turned=turned, high=1.6)


@BOOK.recipe("joint-bladder-pulley")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    wall = elastomer.bladder(m, elastomer.yeoh(0.15e6, -0.006e6, 0.002e6))
    return jointed(
        "joint-bladder-pulley", seed, m, pulley(m, 0.1 * m.nominal, 0.0), rng, hidden=(wall,), high=1.6
    )


@BOOK.recipe("joint-friction-strut")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    rubs = friction.bristles(0.012 * m.blocked, 4e-4, "coulomb_friction", "dahl", "bouc_wen", "maxwell_slip")
    path = strut(m, 0.12 * m.nominal)
    return jointed("joint-friction-strut", seed, m, path, rng, hidden=(rubs,), low=-0.9, high=0.5, rows=120)


@BOOK.recipe("joint-pressure-zero-cam")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 2), rng)
    zero = sensors.zero_error("pressure", -14e3, "pressure_offset")
    path = cam(m, 0.1 * m.nominal, 0.35, 0.01)
    return jointed("joint-pressure-zero-cam", seed, m, path, rng, hidden=(zero,))


@BOOK.recipe("joint-ends-pulley")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    ends = geometry.rounded_ends(m, 2.2, "end_caps", "contraction_factor")
    return jointed(
        "joint-ends-pulley", seed, m, pulley(m, 0.12 * m.nominal, 0.0), rng, hidden=(ends,), high=1.4
    )


@BOOK.recipe("joint-nothing-pulley")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    return jointed("joint-nothing-pulley", seed, m, pulley(m, 0.1 * m.nominal, 0.0), rng, high=1.6)


@BOOK.recipe("joint-nothing-cam")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    return jointed("joint-nothing-cam", seed, m, cam(m, 0.1 * m.nominal, 0.5, 0.02), rng)


@BOOK.recipe("joint-nothing-strut")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 2), rng)
    return jointed("joint-nothing-strut", seed, m, strut(m, 0.12 * m.nominal), rng, low=-0.9, high=0.5)


@BOOK.recipe("joint-nothing-map")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    path = strut(m, 0.12 * m.nominal)
    return jointed("joint-nothing-map", seed, m, path, rng, low=-0.9, high=0.5, timed=False)


@BOOK.recipe("joint-lever-pair")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    path = pulley(m, 0.12 * m.nominal, 0.09)
    turned = Turned(accept("lever_scale"), lever=1.07, name="a cable above its groove")
    return jointed("joint-lever-pair", seed, m, path, rng, turned=turned, low=-0.6, high=0.6, pair=True)


@BOOK.recipe("joint-angle-zero-pair")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    path = pulley(m, 0.12 * m.nominal, 0.09)
    turned = Turned(accept("angle_offset"), angle=radians(2.5), name="an index mark beside its zero")
    return jointed("joint-angle-zero-pair", seed, m, path, rng, turned=turned, low=-0.6, high=0.6, pair=True)


@BOOK.recipe("joint-bearing-pair")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 2), rng)
    path = cam(m, 0.12 * m.nominal, 0.3, 0.09)
    rub = rubbing(0.01 * m.blocked * 0.12 * m.nominal, 0.15)
    turned = Turned(accept("bearing_friction"), rub=rub, name="a journal that rubs")
    return jointed("joint-bearing-pair", seed, m, path, rng, turned=turned, low=-0.6, high=0.6, pair=True)


@BOOK.recipe("joint-ends-pair")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed, 1), rng)
    ends = geometry.rounded_ends(m, 2.2, "end_caps", "contraction_factor")
    path = pulley(m, 0.12 * m.nominal, 0.09)
    return jointed("joint-ends-pair", seed, m, path, rng, hidden=(ends,), low=-0.6, high=0.6, pair=True)


@BOOK.recipe("joint-nothing-pair")
def _(rng: np.random.Generator, seed: int) -> Case:
    m = made(size(seed), rng)
    path = cam(m, 0.12 * m.nominal, 0.3, 0.09)
    return jointed("joint-nothing-pair", seed, m, path, rng, low=-0.6, high=0.6, pair=True)
