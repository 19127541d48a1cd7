"""A muscle that was measured before: its rubber is softer, and a saved model says how far it went."""

from __future__ import annotations

from math import exp
from pathlib import Path
from typing import Any

import pytest

from tests.cli.conftest import Run, write
from tests.cli.test_saved_model import answer_of
from tests.identification.synthetic import BRAID, CYCLE_HEADER, cycle_rows, text

STIFFNESS, LOSS, STRAIN, REACH = 3000.0, 0.4, 0.04, 0.16


def softened(kappa: float, largest: float) -> float:
    """Tension of a rubber that had been contracted as far as ``largest`` [N], after Mullins."""
    left = 1.0 - LOSS * (1.0 - exp(-max(largest - kappa, 0.0) / STRAIN))
    return -STIFFNESS * 0.3 * kappa * left


def used(**row: Any) -> float:
    return softened(row["kappa"], REACH)


def new() -> Any:
    """The tension of a new muscle along its record."""
    seen = [0.0]

    def extra(**row: Any) -> float:
        seen[0] = max(seen[0], row["kappa"])
        return softened(row["kappa"], seen[0])

    return extra


def cycles(name: str, extra: Any, **options: Any) -> str:
    return write(name, text(cycle_rows(extra, noise=1.0, **options), CYCLE_HEADER, "kind: isobaric"))


@pytest.fixture
def model(_own_folders: None) -> str:
    """A model of a muscle that had been measured as far as 16 % of contraction."""
    effects = {"linear_elasticity": {"stiffness": STIFFNESS}, "mullins": {"loss": LOSS, "strain": STRAIN}}
    envelope = {"contraction": {"least": 0.0, "most": REACH, "unit": "1"}}
    return write("model.json", {
        "schema": 1, "kind": "model", "muscle": BRAID, "effects": effects, "envelope": envelope,
    })  # fmt: skip


def test_a_later_test_goes_on_with_the_softened_muscle(run: Run, model: str) -> None:
    file = cycles("later.csv", used, levels=(3e5, 5e5), high=0.12)
    answer = answer_of(run("compare", file, "--model", model, "--json"))
    assert answer["rmse"] == pytest.approx(1.0, rel=0.1)
    assert answer["parameters"]["mullins"]["run_in"]["value"] == REACH
    (told,) = [words for words in answer["messages"] if "taken as used before" in words]
    assert "mullins.run_in = 0.16" in told
    assert "as a new muscle" in told


def test_a_muscle_of_ones_own_that_was_kept_with_its_fit_goes_on_as_well(run: Run, model: str) -> None:
    """`diagnose --save-preset` keeps the ranges of its data beside the values."""
    virgin = cycles("virgin.csv", new(), levels=(2e5, 4e5, 6e5), high=REACH, each=30)
    code, _, err = run(
        "diagnose", virgin, "--muscle", write("muscle.json", BRAID), "--effect", "linear_elasticity",
        "--effect", "mullins", "--free", "mullins.strain", "--save-preset", "MY-20",
    )  # fmt: skip
    assert code == 0, err
    file = cycles("later.csv", used, levels=(3e5, 5e5), high=0.12, seed=5)
    answer = answer_of(run("compare", file, "--muscle", "MY-20:300mm", "--json"))
    assert answer["rmse"] < 1.5  # the noise is 1 N; as a new muscle it would be some ten
    assert any("taken as used before" in words for words in answer["messages"])


def test_a_new_muscle_stays_new(run: Run, model: str) -> None:
    file = cycles("new.csv", new(), levels=(3e5, 5e5), high=0.14)
    answer = answer_of(run("compare", file, "--model", model, "--json"))
    assert answer["rmse"] == pytest.approx(1.0, rel=0.2)
    assert answer["parameters"]["mullins"]["run_in"]["value"] == 0.0
    assert not any("taken as used before" in words for words in answer["messages"])


def test_what_is_stated_of_the_past_is_not_changed(run: Run, model: str) -> None:
    document = Path(model).read_text("utf-8").replace('"strain": 0.04', '"strain": 0.04, "run_in": 0.05')
    assert "run_in" in document
    file = cycles("later.csv", used, levels=(3e5, 5e5), high=0.12)
    answer = answer_of(run("compare", file, "--model", write("stated.json", document), "--json"))
    assert answer["parameters"]["mullins"]["run_in"]["value"] == 0.05
