"""Paths of muscles: virtual work, and by how much stated lengths and levers disagree."""

from __future__ import annotations

import numpy as np
import pytest
import symengine as se

from mckibben.physics import ops
from mckibben.physics.errors import InputError
from mckibben.physics.muscle_path import (
    MusclePath,
    constant_lever,
    path_of_length,
    path_of_lever,
    path_of_table,
    two_points,
)

ROWS = np.array([-1.0, -0.3, 0.2, 0.9])
PATHS: dict[str, MusclePath] = {
    "pulley": constant_lever(lever=0.03, length=0.3),
    "cam": path_of_lever(lever=lambda a: 0.03 - 0.01 * ops.sin(a), length=0.3, low=-1.0, high=1.0),
    "length": path_of_length(length=lambda a: 0.3 - 0.02 * a - 0.003 * a**3, low=-1.0, high=1.0),
    "points": two_points(origin=(0.01, 0.3), insertion=(0.04, -0.02), tendon=0.05),
    "levers": path_of_table(angle=ROWS, lever=np.array([0.02, 0.035, 0.03, 0.01]), length_at_zero=0.3),
    "lengths": path_of_table(angle=ROWS, length=np.array([0.33, 0.31, 0.3, 0.29])),
}


@pytest.mark.parametrize("name", PATHS)
def test_virtual_work_and_symbols(name: str) -> None:
    """L(b) - L(a) = - integral of the lever by Gauss' rule in 400 pieces; symbols give the same numbers."""
    path, symbol = PATHS[name], se.Symbol("phi")
    node, weight = np.polynomial.legendre.leggauss(5)
    edges = np.unique(np.concatenate([np.linspace(-0.9, 0.8, 401), ROWS[1:3]]))
    half = 0.5 * np.diff(edges)
    at = 0.5 * (edges[:-1] + edges[1:])[:, None] + half[:, None] * node
    for of, by, sign in ((path.length, path.lever, -1.0), (path.lever, path.lever_slope, 1.0)):
        work = float(
            np.sum(half[:, None] * weight * np.broadcast_to(by(at.ravel()), at.size).reshape(at.shape))
        )
        change = float(of(np.array(0.8)) - of(np.array(-0.9)))
        assert change == pytest.approx(sign * work, abs=1e-13)
    for of in (path.length, path.lever, path.lever_slope):
        for angle in (-0.7, 0.1, 0.6):
            symbolic = float(se.sympify(of(symbol)).subs({symbol: angle}))
            assert symbolic == pytest.approx(float(of(np.array(angle))), abs=1e-15)


def test_lengths_and_levers_that_disagree() -> None:
    angle = np.linspace(-1.0, 0.5, 31)
    lever = np.full(31, 0.03)
    agree = path_of_table(angle=angle, lever=lever, length=0.31 - 0.03 * angle)
    assert agree.disagreement is not None
    assert agree.disagreement.rms < 1e-15
    tenth = path_of_table(angle=angle, lever=lever, length=0.31 - 0.033 * angle).disagreement
    assert tenth is not None
    assert tenth.lever_factor == pytest.approx(1.1)
    assert tenth.rms == pytest.approx(0.003 * np.std(angle))
    assert tenth.largest == pytest.approx(0.003 * 0.75, abs=1e-12)
    assert tenth.rest < 1e-12
    assert "off by 1.3 mm rms" in tenth.sentence
    unsigned = path_of_table(angle=angle, lever=lever, length=0.31 + 0.03 * angle)
    assert float(unsigned.lever(np.array(0.0))) == pytest.approx(-0.03)
    assert unsigned.disagreement is not None
    assert unsigned.disagreement.rms < 1e-15


def test_paths_that_cannot_be() -> None:
    with pytest.raises(InputError, match="lies on the pivot"):
        two_points(origin=(0.0, 0.0), insertion=(0.1, 0.0))
    with pytest.raises(InputError, match="occurs twice"):
        path_of_table(angle=np.array([0.1, 0.1]), lever=np.array([1.0, 2.0]))
    with pytest.raises(InputError, match="how long the muscle is"):
        path_of_table(angle=np.array([0.1, 0.2]), lever=np.array([1.0, 2.0]))
    with pytest.raises(InputError, match="not smooth"):
        path_of_lever(lever=lambda a: 0.03 * ops.absolute(a - 0.3), length=0.3, low=-1.0, high=1.0)
    with pytest.raises(InputError, match=r"is stated from -57.3 to 51.57 deg"):
        PATHS["levers"].checked(-1.0, 1.2)
    with pytest.raises(InputError, match=r"the length at 40.11 deg is"):
        constant_lever(lever=0.5, length=0.35).checked(0.0, 1.0)
