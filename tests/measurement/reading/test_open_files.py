"""Files that leave something open: they ask exactly that, and read on with the answer."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mckibben.application.measurement.experiment import assumptions_of, refuse_assumptions
from mckibben.measurement.reading import Correction, preview, read_measurement, spoken_correction
from mckibben.measurement.reading.correction import read_correction
from mckibben.physics.errors import InputError
from tests.measurement.reading.open_files import WRITERS, OpenFile, milliseconds

ROUNDING = 1e-4  # of the largest value; the files hold four decimals


def spoken(options: tuple[str, ...]) -> Correction:
    """Options of the command line as a correction."""
    said: dict[str, list[str]] = {}
    for name, value in zip(options[::2], options[1::2], strict=True):
        said.setdefault(name, []).append(value)
    zeros = [text.partition("=") for text in said.get("--experiment", [])]
    answer = spoken_correction(
        columns=said.get("--column", []),
        ignore=said.get("--ignore", []),
        rest_length=next(iter(said.get("--rest-length", [])), None),
        load=next(iter(said.get("--load", [])), None),
        sheet=next(iter(said.get("--sheet", [])), None),
    )
    stated = {key: float(value.removesuffix(" N")) for key, _, value in zeros}
    return replace(answer, conditions={**answer.conditions, **stated})


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


def test_a_real_logger_that_calls_milliseconds_seconds() -> None:
    path = Path(__file__).parents[4] / "shared" / "data" / "logger_S001P001.TXT"
    if not path.exists():
        pytest.skip("the logger's file is not beside this checkout")
    found = preview(path.read_bytes(), path.name)
    assert [question.about for question in found.questions if question.stops] == ["unit of time"]
    assert found.questions[0].option == '--column "time=t [ms]"'


def test_a_unit_that_is_assumed_is_said_wherever_one_that_is_stated_is_not() -> None:
    file = milliseconds()
    choice = {"channel": "time", "unit": "ms"}
    readings = {}
    for assumed in (False, True):
        said = read_correction(json.dumps({"columns": {"t (s)": {**choice, "assumed": assumed}}}))
        readings[assumed] = read_measurement(file.data, file.name, said)
    np.testing.assert_array_equal(readings[True].columns["time"], readings[False].columns["time"])
    assert assumptions_of([(readings[False], {})]) == ()
    (assumption,) = assumptions_of([(readings[True], {})])
    assert assumption.message == "assuming ms as the unit of column 't (s)': --column says otherwise"
    with pytest.raises(InputError, match="the unit of time is not stated"):
        refuse_assumptions(readings[True], {}, lambda name: name)


def test_tests_that_only_look_odd_are_not_asked_about() -> None:
    rows = np.arange(300)
    noise = 1e-3 * np.sin(7.0 * rows)
    creep = ["time_s,pressure_bar,length_mm,load_N"]
    creep += [
        f"{10 * n},{3 + e:.4f},{240 - 2 * (1 - np.exp(-n / 60)):.4f},50"
        for n, e in zip(rows, noise, strict=True)
    ]
    assert preview("\n".join(creep).encode(), "creep.csv").questions == ()
    by_hand = ["time_s,pressure_bar,length_mm,force_N"]
    way = [*range(0, 50, 5), *range(50, -1, -5)]
    by_hand += [f"{10 * n},3,{250 - x},{600 - 11 * x}" for n, x in enumerate(way)]
    assert preview("\n".join(by_hand).encode(), "hand.csv").questions == ()
    short = [
        "time_s,pressure_bar,length_mm,force_N"
    ]  # two held lengths; the short muscle pulls little at 1 bar
    for n, (length, lost) in enumerate([(250.0, 20.0), (215.0, 150.0)]):
        short += [f"{n * 20 + k},{1 + 0.25 * k},{length},{(1 + 0.25 * k) * 160 - lost}" for k in range(20)]
    assert preview("\n".join(short).encode(), "short.csv").questions == ()
