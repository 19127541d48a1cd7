"""Polynomials and plays beside a model: known polynomials and loops, and no word beyond the range."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.residual.rivals import plain_rivals, rivals_of
from mckibben.identification.residual.surface import play, surface_of
from tests.identification.residual.test_surface import (
    CONTRACTION,
    CURVE,
    FORCE,
    NOISE,
    PRESSURE,
    Rig,
    loops,
)
from tests.identification.synthetic import linear_node

WHITE = np.random.default_rng(12).normal(size=len(CONTRACTION))


def test_a_polynomial_is_found_with_its_numbers_and_leaves_the_noise() -> None:
    """A parabola times the pressure, over a table: the noise is left, and no more than twice its numbers."""
    pressure, contraction = np.repeat(np.linspace(1.0, 7.0, 7), 9), np.tile(np.linspace(0.0, 0.2, 9), 7)
    curve = np.repeat(np.arange(7), 9)
    force = pressure * (100.0 - 900.0 * contraction**2) + np.random.default_rng(5).normal(size=63)
    rig = Rig(force, np.ones((63, 1)), (curve,), {"pressure": pressure, "length": 1.0 - contraction})
    rig.records, rig.sweeps = curve, [np.flatnonzero(one == curve) for one in range(7)]
    (found,) = plain_rivals(linear_node(force, np.ones((63, 1)), rig.folds), rig)
    assert found.kind == "static polynomial"
    assert 4 <= found.numbers <= 12
    assert found.left == pytest.approx(1.0, rel=0.2)
    assert found.left_out == pytest.approx(1.0, rel=0.3)
    assert found.share is not None
    assert found.share < 0.1


def test_groups_beyond_the_others_are_not_told() -> None:
    """Two pressures, each a group: neither lies within the range of the other."""
    pressure = np.repeat([2.0, 5.0], 20)
    contraction = np.tile(np.linspace(0.0, 0.2, 20), 2)
    force = pressure * (100.0 - contraction)
    rig = Rig(
        force, np.ones((40, 1)), (pressure.astype(int),), {"pressure": pressure, "length": 1.0 - contraction}
    )
    rig.records, rig.sweeps = pressure.astype(int), [np.arange(20), np.arange(20, 40)]
    assert plain_rivals(linear_node(force, np.ones((40, 1)), rig.folds), rig) == []


def test_plays_follow_dry_friction_that_a_polynomial_cannot() -> None:
    """Upon a polynomial, a friction that turns over a tenth of the range: the play of that half width."""
    behind = play(CONTRACTION, 0.05 * float(np.ptp(CONTRACTION)), CURVE) - CONTRACTION
    force = PRESSURE / 1e5 * (50.0 - 300.0 * CONTRACTION) + 30.0 * behind / float(np.max(behind))
    node, rig = loops(force - FORCE + NOISE * WHITE)
    polynomial, plays = plain_rivals(node, rig)
    assert (polynomial.kind, plays.kind) == ("static polynomial", "polynomial with plays")
    assert polynomial.left > 8.0 * NOISE
    assert plays.left == pytest.approx(NOISE, rel=0.1)
    assert plays.left_out is not None
    assert plays.left_out < 1.5 * NOISE


def test_the_best_on_left_out_groups_comes_first_and_the_model_is_of_the_same_rows() -> None:
    node, rig = loops(20.0 * np.sin(40.0 * CONTRACTION) + NOISE * WHITE)
    found = rivals_of(node, rig, surface_of(node, rig))
    shares = [rival.share for rival in found if rival.share is not None]
    assert {rival.kind for rival in found} >= {"free surface", "static polynomial"}
    assert shares == sorted(shares)
