"""Columns of a file that nothing is read from: told by the comparison and by the diagnosis."""

from __future__ import annotations

import pytest

from mckibben.application.compare.compare import compare
from mckibben.application.measurement.summary import UnreadColumn
from mckibben.documents.studio import Studio
from tests.application.measurement.test_experiment import asked, diagnosed
from tests.application.truths import specimen
from tests.shipped import shipped_studio


@pytest.fixture(scope="module")
def studio() -> Studio:
    """Presets and effects that come with the program."""
    return shipped_studio()


def with_a_column(text: str, name: str) -> str:
    """The table of a text with one more column of numbers."""
    lines = text.splitlines()
    head = next(i for i, line in enumerate(lines) if not line.startswith("#"))
    more = [f"{line},{name if i == 0 else 10 * i}" for i, line in enumerate(lines[head:])]
    return "\n".join([*lines[:head], *more]) + "\n"


def test_a_comparison_and_a_diagnosis_tell_the_columns_that_they_do_not_read(studio: Studio) -> None:
    question = asked(studio, [with_a_column(specimen(0.3), "blorp")])
    for result in (compare(question), diagnosed(studio, question)):
        assert result.unread == [UnreadColumn("blorp", "its name is not known")]
        assert "columns that are not read: 'blorp' (its name is not known)" in result.messages


def test_of_several_files_each_sentence_names_its_own(studio: Studio) -> None:
    texts = [specimen(0.3), with_a_column(specimen(0.4), "blorp")]
    result = compare(asked(studio, texts))
    assert "1.csv: columns that are not read: 'blorp' (its name is not known)" in result.messages
    assert not any("not read" in message and "0.csv" in message for message in result.messages)


def test_without_such_columns_nothing_is_said(studio: Studio) -> None:
    result = compare(asked(studio, [specimen(0.3)]))
    assert result.unread == []
    assert not any("columns that are not read" in message for message in result.messages)
