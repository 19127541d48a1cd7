"""What speaks for and against a model: two tests of structure, what repeats in step, noise that lasts."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from mckibben.identification.diagnose.judgement import Judgement, judged
from mckibben.identification.diagnose.judgement_words import undecided_text
from mckibben.identification.residual.correlated import WHITE, Chain, Noise, Weighed
from mckibben.identification.residual.outlying import Outlying
from mckibben.identification.residual.surface import Surface
from tests.identification.residual.test_surface import CONTRACTION, correlated, loops

NONE = Outlying((), 0.0, (), (), surface=False)


def judgement(
    *, rmse: float = 2.0, noise: float | None = 1.0, ratio: float = 0.0, gain: float = 0.0, left: float = 1.0,
    of: Noise = WHITE, repeats: Any = None, rows: bool = True,
) -> Judgement:  # fmt: skip
    """One made of figures; sweeps have 60 rows."""
    surface = Surface(
        left, 9, (gain + 0.1,), (gain,), (gain + 0.2,), (1.0,), (True,), np.zeros(60), np.zeros(60), ()
    )
    return Judgement(
        rmse=rmse, least=1e-9, noise=noise, typical=rmse,
        noises=[[Weighed(of, 1.0, rmse**2, Chain([np.arange(60)]))]],
        ratio=ratio, surface=surface if rows else None, outlying=NONE, repeats=repeats, sweep=60.0,
    )  # fmt: skip


@pytest.mark.parametrize(
    ("given", "structured", "undecided"),
    [
        ({"ratio": 20.0, "gain": 0.3}, True, False),
        ({"ratio": 20.0}, False, True),
        ({"gain": 0.3}, False, True),
        ({}, False, False),
        ({"ratio": 20.0, "gain": 0.3, "rmse": 1.1}, False, False),  # no more than the noise
        ({"ratio": 20.0, "gain": 0.3, "left": 1.9}, False, False),  # a surface would leave nearly as much
        ({"repeats": SimpleNamespace(in_step=True)}, True, False),
        ({"repeats": SimpleNamespace(in_step=False)}, False, False),
        ({"repeats": SimpleNamespace(in_step=False), "gain": 0.3}, True, False),
        ({"of": Noise(0.99, 0.0, 1e-5), "rmse": 6.0}, False, True),  # alike over 100 rows
        ({"of": Noise(0.9, 0.0, 1e-5), "rmse": 6.0}, False, False),
        ({"rows": False, "rmse": 6.0}, True, False),
        ({"rows": False, "rmse": 4.0}, False, True),
        ({"rows": False, "rmse": 1.1}, False, True),  # no surface, so no proof
        ({"rows": False, "rmse": 6.0, "noise": None}, False, True),
        ({"noise": None}, False, True),
    ],
)
def test_two_tests_together_show_a_structure_and_one_alone_decides_nothing(
    given: dict[str, Any], structured: bool, undecided: bool
) -> None:
    found = judgement(**given)
    assert (found.structured, found.undecided) == (structured, undecided)
    holds = [holds for holds, _ in found.proofs.values()]
    assert (False in holds) >= (structured and found.surface is not None)
    if not structured:
        assert undecided is not all(holds)


def test_each_proof_that_fails_says_why() -> None:
    found = judgement(ratio=20.0, gain=0.3, noise=None).proofs
    assert found["noise_known"] == (None, "the noise cannot be estimated")
    assert found["white"] == (False, "a free surface explains more than noise does")
    assert found["rival_gains_nothing"][0] is False
    assert judgement(rows=False).proofs["white"] == (None, "there are fewer than twenty rows")


@pytest.mark.parametrize(("period", "steps"), [(30.0, True), (30.0, False)])
def test_a_line_is_told_with_its_period_and_swinging_noise_is_none(period: float, steps: bool) -> None:
    """A sine through all rows; noise of the same period that loses its step within two of them."""
    rng = np.random.default_rng(2)
    rows = np.arange(len(CONTRACTION))
    if steps:
        extra = 4.0 * np.sin(2.0 * np.pi * rows / period) + rng.standard_normal(len(rows))
    else:
        extra = rng.standard_normal(len(rows))
        radius = 0.97
        for row in range(2, len(rows)):
            extra[row] += (
                2.0 * radius * np.cos(2.0 * np.pi / period) * extra[row - 1] - radius**2 * extra[row - 2]
            )
    model, rig = loops(extra)
    rig.records = np.zeros(len(rows), int)
    found = judged(_lined(model, rig), rig, 1.0)
    if steps:
        assert found.repeats is not None
        assert found.repeats.in_step
        assert found.repeats.period == pytest.approx(period, rel=0.02)
        assert found.repeats.amplitude == pytest.approx(4.0, rel=0.1)
    else:
        assert found.repeats is None or not found.repeats.in_step


def test_correlated_noise_is_no_structure() -> None:
    rng = np.random.default_rng(3)
    for rho in (0.0, 0.9):
        model, rig = loops(correlated(rng, rho, len(CONTRACTION))[: len(CONTRACTION)].ravel())
        assert not judged(_lined(model, rig), rig, 0.5).structured


def test_rows_that_do_not_fit_are_named_beside_noise_alone() -> None:
    """Three rows that are far off: named beside noise, and not where the model fits no row."""
    rng = np.random.default_rng(4)
    white = rng.standard_normal(len(CONTRACTION))
    bad = [70, 150, 260]
    for step, named in ((0.0, True), (40.0, False)):
        extra = white + step * (CONTRACTION > 0.1)  # a step that no smooth surface follows
        extra[bad] += 15.0 * np.array([1.0, -1.0, 1.0])
        model, rig = loops(extra)
        found = judged(_lined(model, rig), rig, 1.0)
        assert set(found.outlying.rows) == (set(bad) if named else set())
        assert found.structured is not named


def test_a_row_that_correlated_noise_explains_is_not_named() -> None:
    rng = np.random.default_rng(5)
    noise = correlated(rng, 0.98, len(CONTRACTION))[: len(CONTRACTION)].ravel()
    for jump, named in ((0.0, ()), (12.0, (150,))):
        extra = noise.copy()
        extra[150] += jump * np.std(np.diff(noise))
        model, rig = loops(extra)
        assert judged(_lined(model, rig), rig, None).outlying.rows == named


def _lined(model: Any, rig: Any) -> Any:
    """The fitted subject with the lines of its data."""
    from dataclasses import replace

    return cast(Any, replace(model, noise_lines=rig.noise_lines))


def test_a_surface_that_interpolates_is_not_quoted() -> None:
    """Of 60 rows: 9 numbers say something of the rest, 31 go through the points."""
    found = judgement(ratio=20.0)
    assert found.surface is not None
    assert "A free curve with 9 numbers would leave 1.00 N." in undecided_text(found, "N", 1.0)
    dense = replace(found, surface=replace(found.surface, numbers=31))
    assert "free curve" not in undecided_text(dense, "N", 1.0)
