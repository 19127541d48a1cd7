"""Files as laboratories write them: the corpus beside the checkout, and ten files of our own."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from mckibben.application.measurement.convert import converted
from mckibben.measurement.reading import read_measurement
from tests.benchmarks.formats import CORPUS, corpus_scores, score_own
from tests.measurement.reading.sealed_files import WRITERS, LabFile

AT_LEAST = 22  # of the 24 files of the corpus are read right, or asked about rightly


def test_the_corpus_is_read_or_asked_about() -> None:
    if not (CORPUS / "index.json").exists():
        pytest.skip("the corpus is not beside this checkout")
    scores = corpus_scores()
    assert [found for found in scores if found.verdict in ("wrong", "crashed")] == []
    assert sum(found.verdict in ("right", "asked") for found in scores) >= AT_LEAST


@pytest.mark.parametrize("write", WRITERS, ids=lambda write: write.__name__)
def test_files_of_other_habits_are_read_right(write: Callable[[], LabFile]) -> None:
    assert score_own(write()).why == ""


@pytest.mark.parametrize("write", WRITERS, ids=lambda write: write.__name__)
def test_the_canonical_file_holds_the_same_channels(write: Callable[[], LabFile]) -> None:
    file = write()
    original = read_measurement(file.data, file.name)
    text = converted(original).text
    again = read_measurement(text.encode(), "clean.csv")
    assert again.kind == original.kind
    for channel, values in original.columns.items():
        assert again.columns[channel].tolist() == values.tolist()
    assert again.slack.tolist() == original.slack.tolist()
    for key in ("nominal_length", "load_mass", "muscle"):
        assert again.conditions.get(key) == original.conditions.get(key)
    assert file.name in text
    for channel in original.channels:
        assert f"# {channel.name} is read from '{channel.column.replace(':', ' ')}'" in text
