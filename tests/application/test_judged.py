"""What a comparison says of a model: the same as a diagnosis of that model, without a search."""

from __future__ import annotations

from pathlib import Path

import pytest

import mckibben as mk
from tests.claims.cases_diagnosis import Situation, situations


def _compared(situation: Situation, folder: Path, model: mk.Model | None = None) -> mk.Comparison:
    path = folder / "measured.csv"
    path.write_text(situation.files[0])
    model = model or mk.Model(**situation.muscle, effects=situation.effects)
    return model.compare(mk.read(path, **situation.options))


@pytest.mark.parametrize(
    ("only", "status"),
    [
        ("null/loops/white/20 mm/no time", "adequate"),
        ("effect/Coulomb friction of 4 %/80 mm", "structure_left"),
        ("null/loops/ar098/80 mm/no time", "undecided"),
    ],
)
def test_the_status_of_a_compared_model_and_its_proofs(only: str, status: str, tmp_path: Path) -> None:
    (situation,) = situations((0,), only)
    found = _compared(situation, tmp_path)
    assert found.verdict is not None
    assert found.verdict.status == status
    holds = [getattr(found.verdict.proofs, name) for name in (
        "noise_known", "white", "no_outliers", "rival_gains_nothing",
    )]  # fmt: skip
    assert all(each is True for each in holds) is (status == "adequate")
    assert bool(found.verdict.why_not) is (status != "adequate")
    assert found.verdict.sentence in found.sentences
    assert [rival.kind for rival in found.rivals].count("free surface") == 1


def test_a_model_that_a_diagnosis_has_repaired_is_adequate_in_a_comparison_too(tmp_path: Path) -> None:
    (situation,) = situations((0,), "effect/Coulomb friction of 6 %/12 mm")
    before = _compared(situation, tmp_path)
    path = tmp_path / "measured.csv"
    data = mk.read(path, **situation.options)
    diagnosis = mk.Model(**situation.muscle, effects=situation.effects).diagnose(data)
    after = diagnosis.model.compare(data)
    assert before.verdict is not None
    assert after.verdict is not None
    assert before.verdict.status == "structure_left"
    assert list(diagnosis.effects) == ["coulomb_friction"]
    assert after.verdict.status == "adequate"


def test_a_row_that_does_not_fit_is_named_and_counts_for_nothing_in_the_verdict(tmp_path: Path) -> None:
    (situation,) = situations((0,), "bad rows/one length of 30 is 10 % short/12 mm")
    found = _compared(situation, tmp_path)
    assert [row.row for row in found.suspect_rows]
    assert "does not fit beside the others" in found.verdict.sentence


def test_forces_below_zero_are_set_aside_because_a_muscle_does_not_push(tmp_path: Path) -> None:
    (situation,) = situations((1,), "bad rows/negative forces beyond the shortest length/20 mm")
    found = _compared(situation, tmp_path)
    pushing = [row for row in found.suspect_rows if "does not push" in row.why]
    readings = [line.split(",") for line in situation.files[0].splitlines() if line[0].isdigit()]
    assert pushing
    assert all(float(readings[row.row - 1][-1]) < 0.0 for row in pushing)
    assert found.verdict is not None
    assert found.verdict.status != "structure_left"
