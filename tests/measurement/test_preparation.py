"""Steps that prepare a measurement, against closed forms: sines, lines, counted rows; and what errors say."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.measurement import Measurement, build
from mckibben.measurement.points import Points, joined
from mckibben.measurement.preparation import (
    LONGEST,
    MOST,
    low_passed,
    parts_of,
    prepared,
    prepared_points,
    rows_of_file,
)
from mckibben.measurement.rescaled import rescaled
from mckibben.measurement.settled import settled
from mckibben.physics.errors import InputError

RATE = 200.0
TIME = np.arange(0.0, 20.0, 1.0 / RATE)


def sine(frequency: float) -> np.ndarray:
    return 10.0 * np.sin(2.0 * np.pi * frequency * TIME)


def record(force: np.ndarray, time: np.ndarray = TIME, **columns: np.ndarray) -> Measurement:
    n = len(time)
    table = {
        "time": time,
        "pressure": np.full(n, 3e5),
        "length": 0.25 + 1e-3 * np.sin(time),
        "force": 100.0 + force,
        **columns,
    }
    return build(table, name="made", id="0" * 64, kind="isobaric", excluded_rows={})


def amplitude(values: np.ndarray, frequency: float, time: np.ndarray = TIME) -> complex:
    """Complex amplitude of a sine in the middle half of a record, by least squares."""
    middle = slice(len(time) // 4, 3 * len(time) // 4)
    phase = 2.0 * np.pi * frequency * time[middle]
    table = np.column_stack([np.sin(phase), np.cos(phase), np.ones_like(phase)])
    found = np.linalg.lstsq(table, values[middle], rcond=None)[0]
    return complex(found[0], found[1])


@pytest.mark.parametrize("frequency", [1.0, 5.0, 8.0, 20.0])
def test_a_low_pass_leaves_of_a_sine_what_the_formula_says_and_is_not_late(frequency: float) -> None:
    after = prepared(record(sine(frequency)), ["low pass force 5 Hz"])
    ratio = np.tan(np.pi * frequency / RATE) / np.tan(np.pi * 5.0 / RATE)
    left = 10.0 / (1.0 + (np.sqrt(2.0) - 1.0) * ratio**4)
    found = amplitude(after.columns["force"], frequency)
    assert found.real == pytest.approx(left, abs=1e-3)
    assert found.imag == pytest.approx(0.0, abs=1e-3)
    if frequency == 5.0:
        assert found.real == pytest.approx(10.0 / np.sqrt(2.0), rel=1e-4)


def test_a_low_pass_of_all_channels_leaves_times_and_commands_alone() -> None:
    command = np.sign(np.sin(TIME))
    before = record(sine(20.0), command=command)
    after = prepared(before, ["low pass 5 Hz"])
    for name in ("time", "command", "group"):
        assert np.array_equal(after.columns[name], before.columns[name])
    assert "command is not filtered" in after.prepared[0].done
    inner = slice(200, -200)  # a filter has fewer rows at the ends
    assert np.ptp(after.columns["force"][inner]) < 0.02 * np.ptp(before.columns["force"])


def test_what_a_filter_leaves_of_white_noise_is_known_though_neighbours_do_not_show_it() -> None:
    noise = np.random.default_rng(2).normal(0.0, 3.0, len(TIME))
    after = prepared(record(noise), ["low pass 5 Hz"])
    left = np.std(after.columns["force"])
    assert after.shared_noise["force"] == pytest.approx(left, rel=0.1)
    # By the integral of the response over all frequencies.
    f = np.linspace(0.0, 0.5 * RATE, 20001)[:-1]
    response = 1.0 / (1.0 + (np.sqrt(2.0) - 1.0) * (np.tan(np.pi * f / RATE) / np.tan(np.pi * 5 / RATE)) ** 4)
    assert after.shared_noise["force"] == pytest.approx(3.0 * np.sqrt(np.mean(response**2)), rel=0.05)
    assert rescaled(after, "force", factor=-2.0).shared_noise["force"] == pytest.approx(
        2.0 * after.shared_noise["force"]
    )


def test_no_step_crosses_rows_that_do_not_follow_each_other() -> None:
    jump = np.where(TIME < 10.0, 0.0, 50.0)
    clock = np.where(TIME < 10.0, TIME, TIME - 10.0)  # a second run
    after = prepared(record(jump, clock), ["low pass 2 Hz"])
    assert after.columns["force"] == pytest.approx(100.0 + jump, abs=1e-6)
    assert [len(part) for part in parts_of(after)] == [2000, 2000]


def test_faulty_readings_are_bridged_and_stay_left_out() -> None:
    force, bad = np.zeros(len(TIME)), np.zeros(len(TIME), bool)
    force[1000], bad[1000] = 1e4, True
    table = dict(record(force).columns) | {"force": 100.0 + force}
    faulty = build(table, name="made", id="0" * 64, kind="isobaric", excluded_rows={"spike": bad})
    after = prepared(faulty, ["low pass 5 Hz"])
    assert np.flatnonzero(after.excluded_rows["spike"]).tolist() == [1000]
    assert after.columns["force"] == pytest.approx(np.full(len(TIME), 100.0), abs=1e-6)


def test_a_known_drift_is_taken_away_and_the_beginning_stays() -> None:
    after = prepared(record(0.3 * TIME), ["detrend force"])
    assert after.columns["force"] == pytest.approx(np.full(len(TIME), 100.0), abs=1e-9)
    assert "0.3 N/s" in after.prepared[0].done


def test_a_drift_between_two_rests_is_that_of_their_means() -> None:
    work = np.where((TIME > 2.0) & (TIME < 18.0), 40.0, 0.0)  # would tilt a line through all rows
    after = prepared(record(work + 0.3 * TIME), ["detrend force 0 s to 1 s, 19 s to 19.9 s"])
    expected = 100.0 + work + 0.3 * 0.5  # as it is in the middle of the first rest
    assert after.columns["force"] == pytest.approx(expected, abs=2e-3)


def test_a_range_leaves_its_rows_with_the_numbers_of_the_file() -> None:
    before = record(sine(1.0))
    after = prepared(before, ["range time 2 s to 10 s"])
    inside = np.flatnonzero((TIME >= 2.0) & (TIME <= 10.0))
    assert np.array_equal(rows_of_file(after), inside)
    assert np.array_equal(after.columns["force"], before.columns["force"][inside])
    assert after.prepared[0].rows_before == len(TIME)
    assert after.prepared[0].rows_after == after.rows == len(inside)
    assert sum(after.skipped.values()) == len(TIME) - len(inside)
    assert after.channels[0].maximum == pytest.approx(10.0)
    twice = prepared(after, ["range rows 500 to 600"])
    assert rows_of_file(twice).tolist() == list(range(499, 600))
    assert np.array_equal(rows_of_file(settled(twice).measurement), rows_of_file(twice))


@pytest.mark.parametrize(("text", "rows"), [("range time from 19 s", 200), ("range time to 1 s", 201)])
def test_a_range_may_have_one_end(text: str, rows: int) -> None:
    assert prepared(record(sine(1.0)), [text]).rows == rows


def test_a_range_of_a_channel_begins_anew_after_each_gap() -> None:
    after = prepared(record(sine(0.25)), ["range force 100 N to 200 N"])  # five half waves of 2 s
    assert len(after.starts) == 5
    assert np.all(np.diff(after.columns["time"])[np.array(after.starts[1:]) - 1] > 1.0)
    assert "5 parts" in after.prepared[0].done


def test_resampling_keeps_what_a_longer_step_holds_and_folds_nothing_back() -> None:
    slow, fast = sine(2.0), sine(27.0)  # 27 Hz would look like 7 Hz at 20 Hz
    after = prepared(record(slow + fast), ["resample 20 Hz"])
    time = after.columns["time"]
    assert np.diff(time) == pytest.approx(np.full(len(time) - 1, 0.05))
    assert abs(amplitude(after.columns["force"], 2.0, time)) == pytest.approx(10.0, rel=1e-3)
    assert abs(amplitude(after.columns["force"], 7.0, time)) < 1e-2
    assert rows_of_file(after)[:3].tolist() == [0, 10, 20]


def test_uneven_times_are_refused_by_a_filter_and_evened_by_resampling() -> None:
    uneven = TIME + np.random.default_rng(1).uniform(0.0, 0.4 / RATE, len(TIME))
    force = 10.0 * np.sin(2.0 * np.pi * uneven)
    with pytest.raises(InputError, match="uneven") as refused:
        prepared(record(force, uneven), ["low pass 5 Hz"])
    assert "resample" in str(refused.value.hint)
    after = prepared(record(force, uneven), ["resample 200 Hz", "low pass 20 Hz"])
    expected = 100.0 + 10.0 * np.sin(2.0 * np.pi * after.columns["time"])
    assert after.columns["force"][50:-50] == pytest.approx(expected[50:-50], abs=0.02)


def test_a_command_keeps_its_last_value_when_resampled() -> None:
    command = np.where(TIME < 0.013, 0.0, 1.0)
    after = prepared(record(sine(1.0), command=command), ["resample 100 Hz"])
    assert set(after.columns["command"]) == {0.0, 1.0}
    assert after.columns["command"][:3].tolist() == [0.0, 0.0, 1.0]


def test_steps_follow_each_other_and_each_says_what_it_did() -> None:
    steps = ["range time 2 s to 18 s", "low  pass 20 Hz", "resample 50 Hz"]
    after = prepared(record(sine(1.0)), steps)
    assert [step.step for step in after.prepared] == [
        "range time 2 s to 18 s",
        "low pass 20 Hz",
        "resample 50 Hz",
    ]
    assert [(s.rows_before, s.rows_after) for s in after.prepared] == [
        (4000, 3201),
        (3201, 3201),
        (3201, 801),
    ]
    assert all(any(step.step in message for message in after.messages) for step in after.prepared)
    points = prepared_points(Points(record(sine(1.0))), steps)
    assert sum(points.left_out.values()) + points.measurement.rows == 4000
    two = joined([points, points])
    assert two.measurement.shared_noise["force"] == pytest.approx(points.measurement.shared_noise["force"])


@pytest.mark.parametrize(
    ("step", "problem", "hint"),
    [
        ("lowpas 20 Hz", "is no step", "low pass 20 Hz"),
        ("", "is no text", "range"),
        ("x" * (LONGEST + 1), "is no text", "range"),
        ("low pass", "no cut-off", "low pass 20 Hz"),
        ("low pass 150 Hz", "not below half the rate", "below 100 Hz"),
        ("low pass 20 kg", "20 kg", "Hz"),
        ("range time 30 s to 40 s", "leaves 0 of 4000 rows", "time goes from 0 to 19.995 s"),
        ("range tim 1 s to 2 s", "no channel 'tim'", "time"),
        ("range time 5 s to 2 s", "begins above its end", "smaller"),
        ("range diameter 1 mm to 2 mm", "the file has no diameter", "force"),
        ("range rows 0 to 5", "'0' is no row", "from 1"),
        ("range time", "is no range", "range time 2 s to 10 s"),
        ("detrend", "names no channel", "detrend force"),
        ("detrend time", "has no drift", "force"),
        ("detrend force 5 s to 6 s, 1 s to 2 s", "not one after the other", "detrend force"),
        ("detrend force 0 s to 1 s, 50 s to 60 s", "no row lies in one of the rests", "0 to 19.995 s"),
        ("resample 3 N", "neither a rate nor a time step", "resample 100 Hz"),
        ("resample 0 Hz", "above 0", "resample"),
        ("resample 1 GHz", "rows", "lower rate"),
    ],
)
def test_what_cannot_be_done_is_said_in_one_line(step: str, problem: str, hint: str) -> None:
    with pytest.raises(InputError) as refused:
        prepared(record(sine(1.0)), [step])
    error = refused.value
    assert problem in error.message
    assert hint in str(error.hint)
    assert error.message.startswith(f"prepare '{step[:40]}")
    assert "\n" not in error.message
    assert error.field == "prepare"


def test_steps_without_time_need_it_and_there_are_not_too_many() -> None:
    table = {name: values for name, values in record(sine(1.0)).columns.items() if name != "time"}
    untimed = build(table, name="made", id="0" * 64, kind="isobaric", excluded_rows={})
    for step in ("low pass 5 Hz", "detrend force", "resample 10 Hz", "range time 1 s to 2 s"):
        with pytest.raises(InputError, match="has no time"):
            prepared(untimed, [step])
    with pytest.raises(InputError, match="steps"):
        prepared(untimed, ["range rows 1 to 100"] * (MOST + 1))


def test_a_constant_is_left_as_it_is_up_to_its_ends() -> None:
    assert low_passed(np.full(50, 7.0), 5.0, RATE, 8) == pytest.approx(np.full(50, 7.0), abs=1e-6)
