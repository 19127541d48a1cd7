"""Files that leave something open: they ask exactly that, and read on with the answer."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from mckibben.measurement.read import Correction, preview, read_measurement, spoken_correction
from mckibben.physics.errors import InputError
from tests.measurement.read.open_files import WRITERS, OpenFile

ROUNDING = 1e-4  # of the largest value; the files hold four decimals


def spoken(options: tuple[str, ...]) -> Correction:
    """Options of the command line as a correction."""
    said: dict[str, list[str]] = {}
    for name, value in zip(options[::2], options[1::2], strict=True):
        said.setdefault(name, []).append(value)
    return spoken_correction(
        columns=said.get("--column", []),
        ignore=said.get("--ignore", []),
        rest_length=next(iter(said.get("--rest-length", [])), None),
        load=next(iter(said.get("--load", [])), None),
        sheet=next(iter(said.get("--sheet", [])), None),
    )


@pytest.mark.parametrize("write", WRITERS, ids=lambda write: write.__name__)
def test_it_asks_exactly_what_it_leaves_open(write: Callable[[], OpenFile]) -> None:
    file = write()
    found = preview(file.data, file.name)
    assert sorted(question.about for question in found.questions) == sorted(file.about)
    for question in found.questions:
        assert question.text
        assert question.option.startswith("--")
    assert (found.problem is not None) == file.stops
    assert (found.measurement is None) == file.stops
    if file.stops:
        with pytest.raises(InputError) as caught:
            read_measurement(file.data, file.name)
        assert caught.value.message.startswith(f"{file.name}: ")
        assert all(q.option in caught.value.message for q in found.questions if q.stops)
        assert caught.value.field
    else:
        result = read_measurement(file.data, file.name)
        for question in found.questions:
            assert f"{question.text} ({question.option})" in result.messages
        with pytest.raises(InputError, match=r": --[a-z]"):
            read_measurement(file.data, file.name, Correction(strict=True))


@pytest.mark.parametrize("write", WRITERS, ids=lambda write: write.__name__)
def test_the_answer_decides_the_values(write: Callable[[], OpenFile]) -> None:
    file = write()
    answer = spoken(file.options)
    result = read_measurement(file.data, file.name, answer)
    assert file.channel is not None
    channel, values = file.channel
    np.testing.assert_allclose(result.columns[channel], values, atol=ROUNDING * np.max(np.abs(values)))
    if file.options:
        assert result.questions == ()
        assert preview(file.data, file.name, answer).problem is None
