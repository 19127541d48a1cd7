"""The answer does not depend on what does not matter.

`python -m tests.benchmarks.metamorphic` has all cases, with the whole catalogue.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any

import numpy as np
import pytest

from mckibben.identification.diagnose.diagnosis import Diagnosis
from tests.benchmarks.metamorphic import (
    FEW,
    RELATIONS,
    Relation,
    answer_of,
    difference,
    predictor_for,
)
from tests.benchmarks.metamorphic_cases import Case, friction_case, isotonic_case, logger_case, map_case
from tests.identification.synthetic import CATALOGUE

CHOICE = {name: CATALOGUE[name] for name in FEW}
EXACT = [relation for relation in RELATIONS if relation.exact and relation.name != "rows repeated"]


@lru_cache
def plain(make) -> tuple[Case, Diagnosis]:
    """A case and the diagnosis of its files as they are."""
    case = make()
    return case, answer_of(case.sheets, case.muscle, CHOICE)


@lru_cache
def friction() -> Case:
    return friction_case(each=15)


def pairs(relations: Sequence[Relation], *makes: Callable[[], Case | None]) -> list[Any]:
    """Each case with each relation that applies to it; a case without its file with each of them."""
    return [
        pytest.param(make, relation, id=f"{case.name if case else make.__name__}: {relation.name}")
        for make in makes
        for case in [make()]
        for relation in relations
        if case is None or relation.rewritten(case.sheets) is not None
    ]


@pytest.mark.parametrize(("make", "relation"), pairs(RELATIONS, friction, map_case))
def test_the_same_data_written_otherwise_give_the_same_answer(make, relation):
    case, before = plain(make)
    sheets = relation.rewritten(case.sheets)
    assert sheets is not None
    assert before.added
    assert difference(relation, before, answer_of(sheets, case.muscle, CHOICE)) == ""


@pytest.mark.parametrize(("make", "relation"), pairs(EXACT, isotonic_case, logger_case))
def test_a_diagnosis_gets_the_same_numbers(make, relation):
    """All that a diagnosis sees is the same to the last binary digit, so that its answer is the same."""
    case = make()
    if case is None:
        pytest.skip("the logger's file is not beside the project")
    sheets = relation.rewritten(case.sheets)
    assert sheets is not None
    before, after = (predictor_for(files, case.muscle) for files in (case.sheets, sheets))
    assert before.rows_used == after.rows_used
    assert before.excluded == after.excluded
    np.testing.assert_array_equal(before.measured, after.measured)
    assert set(before.inputs) == set(after.inputs)
    for name, values in before.inputs.items():
        np.testing.assert_array_equal(values, after.inputs[name], err_msg=name)
    for labels, others in zip(before.folds, after.folds, strict=True):
        np.testing.assert_array_equal(labels, others)


@pytest.mark.parametrize("make", [friction, map_case, isotonic_case], ids=["friction", "map", "isotonic"])
def test_repeated_rows_are_told_and_count_once(make):
    case = make()
    repeated = next(relation for relation in RELATIONS if relation.name == "rows repeated")
    sheets = repeated.rewritten(case.sheets)
    assert sheets is not None
    once, twice = (predictor_for(files, case.muscle) for files in (case.sheets, sheets))
    rows = sum(len(sheet.columns["pressure"]) for sheet in case.sheets)
    assert twice.excluded["repeated rows"] == rows
    assert any(f"{rows} rows repeat an earlier row" in message for message in twice.messages)
    assert "repeated rows" not in once.excluded
    np.testing.assert_array_equal(once.measured, twice.measured)


def test_a_difference_that_matters_is_seen():
    """Another force is another answer: the comparison of the answers can fail."""
    case, before = plain(map_case)
    sheet = case.sheets[0]
    other = case.sheets[0].__class__(
        sheet.name, sheet.comments, {**sheet.columns, "force": 1.05 * sheet.columns["force"]}
    )
    assert difference(EXACT[0], before, answer_of((other,), case.muscle, CHOICE))
