"""What a diagnosis says of static loops of known truth: braid, rubber wall, prestress and dry friction."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import mckibben as mk
from tests.frontend.comparing import REACH, braid_force, wall_force

C10, PRESTRESS, FRICTION = 0.5e6, 60.0, 25.0
TRUE = {
    ("bladder_elasticity", "shear_modulus"): C10,
    ("prestress", "force"): PRESTRESS,
    ("coulomb_friction", "force"): FRICTION,
}


def noise_of(kind: float, rows: int, seed: int) -> np.ndarray:
    """Of 2 N; ``kind``: correlation of neighbouring rows."""
    noise = np.random.default_rng(seed).standard_normal(rows)
    for row in range(1, rows):
        noise[row] = kind * noise[row - 1] + math.sqrt(1.0 - kind**2) * noise[row]
    return 2.0 * noise


def loops(
    path: Path, *, seed: int = 0, correlation: float = 0.0, timed: bool = True, friction: float = FRICTION
) -> Path:
    """Five loops of 60 rows, one at each pressure from 2 to 6 bar."""
    rows = []
    for pressure, reach in REACH.items():
        if pressure < 2e5:
            continue
        for way in (-1, 1):
            for share in np.linspace(0.0, 1.0, 30):
                contraction = reach * (0.02 + 0.9 * (share if way < 0 else 1.0 - share))
                force = braid_force(pressure, contraction) + wall_force(contraction, C10)
                rows.append([pressure / 1e5, 300.0 * (1.0 - contraction), force + way * friction - PRESTRESS])
    noise = noise_of(correlation, len(rows), seed)
    head = "pressure [bar],length [mm],force [N]"
    lines = [f"{p:g},{x:.5f},{f + e:.3f}" for (p, x, f), e in zip(rows, noise, strict=True)]
    if timed:
        head = f"time [s],{head}"
        lines = [f"{0.5 * row},{line}" for row, line in enumerate(lines)]
    path.write_text("\n".join(["# muscle: DMSP-20", "# nominal_length: 300 mm", head, *lines]))
    return path


def model(*more: str) -> mk.Model:
    found = mk.Model.preset("DMSP-20", length="300 mm").ideal()
    for name in ("bladder_elasticity", "prestress", "coulomb_friction", *more):
        found = found.with_effect(name)
    return found


@pytest.mark.parametrize(
    ("correlation", "timed"),
    [
        (0.0, False),
        (0.98, True),
        *(
            pytest.param(*other, marks=pytest.mark.examination("test_the_intervals_of_fitted_constants_hold"))
            for other in ((0.0, True), (0.98, False))
        ),
    ],
)
def test_the_intervals_of_fitted_constants_hold(tmp_path: Path, correlation: float, timed: bool) -> None:
    """Of 24 intervals of two standard errors; taken as independent, correlated rows would leave 11."""
    inside = []
    for seed in range(8):
        file = loops(tmp_path / "loops.csv", seed=seed, correlation=correlation, timed=timed)
        found = model().compare(mk.read(file), fit=True).parameters
        for (effect, name), true in TRUE.items():
            number = found[effect][name]
            assert number.stderr is not None
            inside.append(abs(number.value - true) <= 2.0 * number.stderr)
    assert sum(inside) >= 20


def test_rows_without_time_have_the_friction_of_their_way(tmp_path: Path) -> None:
    """The same rows with and without their time: the same error, and no row on the wrong branch."""
    timed, plain = (
        model().compare(mk.read(loops(tmp_path / f"{name}.csv", timed=name == "timed")), fit=True)
        for name in ("timed", "plain")
    )
    assert plain.rmse == pytest.approx(timed.rmse, rel=0.03)
    assert plain.rows_used >= timed.rows_used


def test_a_second_law_of_the_same_friction_is_said_to_be_superfluous(tmp_path: Path) -> None:
    file = mk.read(loops(tmp_path / "loops.csv"))
    verdict = model("bouc_wen").diagnose(file).verdict
    assert verdict.status == "adequate"
    assert verdict.superfluous in (["bouc_wen"], ["coulomb_friction"])
    assert "is superfluous here" in verdict.sentence
    assert model().diagnose(file).verdict.superfluous == []


def test_friction_that_is_not_there_is_not_needed(tmp_path: Path) -> None:
    verdict = model().diagnose(mk.read(loops(tmp_path / "loops.csv", friction=0.0))).verdict
    assert verdict.superfluous == ["coulomb_friction"]
