"""The parts of a squared residual: exact for balanced designs, none for noise, always all of it."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.residual.parts import residual_parts

# A balanced grid: each contraction at each pressure in both directions, twice.
KAPPA, PRESSURE, DIRECTION, _ = (
    a.ravel() for a in np.meshgrid(np.arange(8.0), np.arange(5.0), [-1.0, 1.0], [0, 1], indexing="ij")
)
VARIABLES = {"contraction": KAPPA, "pressure": PRESSURE, "direction": DIRECTION}


def shares(residual: np.ndarray, variables: dict[str, np.ndarray] = VARIABLES) -> dict[str, float]:
    return {part.of: part.share for part in residual_parts(residual, variables, None)}


def test_orthogonal_parts_have_the_shares_of_their_variances() -> None:
    # In a balanced design the sum of squares is that of each part: n a^2, n b^2 var(kappa), ...
    a, b, c, d, e = 3.0, 0.7, 1.1, 2.0, 0.4
    k, p = KAPPA - np.mean(KAPPA), PRESSURE - np.mean(PRESSURE)
    residual = a + b * k + c * p + d * DIRECTION + e * k * p
    squares = {
        "offset": a**2,
        "contraction": b**2 * np.mean(k**2),
        "pressure": c**2 * np.mean(p**2),
        "direction": d**2,
        "together": e**2 * np.mean(k**2) * np.mean(p**2),
        "rest": 0.0,
    }
    whole = sum(squares.values())
    assert shares(residual) == pytest.approx({name: s / whole for name, s in squares.items()}, abs=1e-12)


def test_noise_is_the_rest() -> None:
    rng = np.random.default_rng(5)
    n = 4000
    variables = {
        "contraction": rng.uniform(0.0, 0.2, n),
        "pressure": rng.choice([1e5, 2e5, 3e5], n),
        "direction": rng.choice([-1.0, 1.0], n),
    }
    found = shares(rng.normal(0.0, 2.0, n), variables)
    assert found["rest"] > 0.95
    assert all(share < 0.03 for name, share in found.items() if name != "rest")


def test_noise_beside_a_structure_keeps_its_share() -> None:
    rng = np.random.default_rng(6)
    sigma, friction = 2.0, 5.0
    residual = friction * DIRECTION + rng.normal(0.0, sigma, len(DIRECTION))
    found = shares(residual)
    assert found["direction"] == pytest.approx(friction**2 / (friction**2 + sigma**2), abs=0.05)
    assert sum(found.values()) == pytest.approx(1.0)


@pytest.mark.parametrize("names", [(), ("pressure",), ("contraction", "direction")])
def test_the_shares_add_up_to_one(names: tuple[str, ...]) -> None:
    rng = np.random.default_rng(7)
    residual = 1.0 + KAPPA * PRESSURE + rng.normal(0.0, 1.0, len(KAPPA))
    found = shares(residual, {name: VARIABLES[name] for name in names})
    assert sum(found.values()) == pytest.approx(1.0)
    assert min(found.values()) >= 0.0
    assert set(found) == {"offset", *names, "rest"} | ({"together"} if len(names) > 1 else set())


def test_a_zero_residual_has_no_parts() -> None:
    assert residual_parts(np.zeros(6), {"pressure": np.arange(6.0)}, 1.0) == []


def test_a_variable_the_order_does_not_know_is_left_out() -> None:
    assert set(shares(KAPPA + 1.0, {"temperature": KAPPA})) == {"offset", "rest"}


def test_a_rest_of_the_size_of_the_noise_is_noise() -> None:
    noise = np.random.default_rng(4).normal(size=4000)
    pressure = np.repeat(np.arange(4.0), 1000)
    for known, name in ((1.0, "noise"), (0.5, "rest"), (None, "rest")):
        found = residual_parts(noise + pressure, {"pressure": pressure}, known)
        assert found[-1].of == name
        assert sum(part.share for part in found) == pytest.approx(1.0)
