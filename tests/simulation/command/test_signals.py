"""Signals: exact breakpoints, chords within their stated error, dead times, what a document may not say."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mckibben.physics.errors import InputError
from mckibben.simulation.command.signals import (
    MAX_SEGMENTS,
    SHAPES,
    SMOOTH_ERROR,
    Segments,
    Signal,
    delayed,
    merged,
    signal_from,
)

levels = st.floats(-5.0, 5.0)
times = st.floats(0.0, 3.0)
spans = st.floats(0.02, 3.0)


def command(document: dict, **options) -> Signal:
    return signal_from(document, unit="1", field="command", **options)


def refusal(document: object, **options) -> InputError:
    with pytest.raises(InputError) as caught:
        signal_from(document, unit="1", field="command", **options)  # type: ignore[arg-type]
    return caught.value


def switched(*pieces: tuple[float, float], end: float) -> Segments:
    """Constant pieces (start, level)."""
    starts, values = zip(*pieces, strict=True)
    return Segments(np.array([*starts, end]), np.array(values), np.zeros(len(values)))


def as_pieces(segments: Segments) -> list[tuple[float, float]]:
    return [
        (round(float(t), 9), float(v)) for t, v in zip(segments.times, segments.start_values, strict=False)
    ]


@st.composite
def documents(draw: st.DrawFn) -> dict:
    on = draw(times)
    count = draw(st.integers(1, 8))
    ladder = sorted(draw(st.lists(st.floats(-1.0, 4.0), min_size=count, max_size=count)))
    return draw(
        st.sampled_from(
            [
                {"shape": "step", "at": on, "level": draw(levels), "initial": draw(levels)},
                {"shape": "pulse", "on": on, "off": on + draw(spans), "level": draw(levels)},
                {"shape": "square", "period": draw(spans), "duty": draw(st.floats(0.05, 0.95))},
                {
                    "shape": "triangle",
                    "period": draw(spans),
                    "amplitude": draw(levels),
                    "offset": draw(levels),
                },
                {
                    "shape": "ramp",
                    "from": draw(levels),
                    "to": draw(levels),
                    "start": on,
                    "duration": draw(spans),
                },
                {"shape": "sine", "period": draw(spans), "amplitude": draw(levels), "phase": draw(levels)},
                {"shape": "chirp", "from": draw(times), "to": draw(times), "duration": draw(spans)},
                {"shape": "random", "hold": draw(spans), "seed": draw(st.integers(0, 99)), "lower": -2.0},
                {
                    "shape": "table",
                    "times": ladder,
                    "values": draw(st.lists(levels, min_size=count, max_size=count)),
                    "interpolation": draw(st.sampled_from(["linear", "hold"])),
                },
            ]
        )
    )


@given(document=documents(), duration=st.floats(0.1, 6.0))
def test_value_is_what_the_segments_say(document, duration):
    signal = command(document)
    segments = signal.segments(duration)
    assert segments.times[0] == 0.0
    assert segments.times[-1] == duration
    assert np.all(np.diff(segments.times) > 0.0)
    inside = np.random.default_rng(1).uniform(0.0, duration, 200)
    # Away from jumps: on either side of a breakpoint the two may differ by rounding of its time.
    inside = inside[np.abs(inside[:, None] - segments.times[None, :]).min(axis=1) > 1e-9]
    smooth = document["shape"] in ("sine", "chirp")
    allowed = SMOOTH_ERROR * abs(getattr(signal, "amplitude", 0.0)) if smooth else 0.0
    slack = 1e-9 * (1.0 + np.abs(segments.slopes).max())
    assert np.abs(signal.value(inside) - segments.value(inside)).max(initial=0.0) <= allowed + slack
    low, high = signal.extent
    values = np.r_[segments.start_values, segments.end_values]
    assert low - slack <= values.min()
    assert values.max() <= high + slack


def test_every_shape_is_covered_by_the_property():
    assert set(SHAPES) == {
        *("step", "pulse", "square", "triangle", "ramp", "sine", "chirp", "random", "table"),
    }


def test_breakpoints_are_exact():
    pulse = command({"shape": "pulse", "on": "250 ms", "off": "2 s"}, rest=-1.0).segments(4.0)
    assert as_pieces(pulse) == [(0.0, -1.0), (0.25, 1.0), (2.0, -1.0)]
    triangle = signal_from({"shape": "triangle", "amplitude": "20 mm", "period": "1 s"}, unit="m", field="r")
    segments = triangle.segments(1.75)
    assert as_pieces(segments) == [(0.0, 0.0), (0.5, 0.02), (1.0, 0.0), (1.5, 0.02)]
    assert segments.slopes == pytest.approx([0.04, -0.04, 0.04, -0.04])
    assert segments.end_values == pytest.approx([0.02, 0.0, 0.02, 0.01])


def test_a_pulse_at_once_keeps_its_level_before():
    pulse = command({"shape": "pulse", "on": 0.0, "off": 2.0}, rest=-1.0)
    assert pulse.before == -1.0
    assert as_pieces(pulse.segments(4.0)) == [(0.0, 1.0), (2.0, -1.0)]


def test_square_levels_from_amplitude():
    upper = command({"shape": "square", "period": 1.0, "amplitude": 0.6, "initial": 0.1})
    lower = command({"shape": "square", "period": 1.0, "amplitude": 0.6, "level": 0.7})
    assert upper.extent == pytest.approx((0.1, 0.7))
    assert lower.extent == pytest.approx((0.1, 0.7))
    assert "not all three" in str(
        refusal({"shape": "square", "period": 1.0, "amplitude": 1.0, "level": 1.0, "initial": 0.0})
    )


@given(frequency=st.floats(0.1, 20.0), amplitude=st.floats(0.1, 10.0), phase=st.floats(-4.0, 4.0))
def test_chords_of_a_sine_stay_within_the_stated_error(frequency, amplitude, phase):
    document = {"shape": "sine", "frequency": frequency, "amplitude": amplitude, "phase": phase}
    signal = command(document)
    segments = signal.segments(1.0)
    middle = 0.5 * (segments.times[1:] + segments.times[:-1])  # where a chord is furthest off
    worst = np.abs(signal.value(middle) - segments.value(middle)).max()
    assert worst < SMOOTH_ERROR * amplitude
    if frequency > 1.0:
        assert worst > 0.8 * SMOOTH_ERROR * amplitude, "more chords than needed"


def test_chirp_frequency_goes_from_first_to_last():
    chirp = command({"shape": "chirp", "from": "1 Hz", "to": "5 Hz", "duration": "4 s"})
    t = np.linspace(0.0, 6.0, 600_001)
    values = chirp.value(t)
    crossings = t[1:][(values[1:] >= 0.0) & (values[:-1] < 0.0)]
    assert len(crossings[crossings <= 4.0 + 1e-4]) == 12  # (1 + 5)/2 Hz in 4 s
    assert np.diff(crossings[crossings > 4.0]) == pytest.approx(0.2, abs=2e-5)


def test_smooth_step_makes_shorter_chords():
    sine = command({"shape": "sine", "period": 1.0})
    assert np.diff(sine.segments(1.0, 1e-3).times).max() <= 1e-3 + 1e-12


def test_random_is_reproducible_and_grows():
    document = {"shape": "random", "hold": "0.1 s", "seed": 7, "lower": 0.2, "upper": 0.4}
    short, long = command(document).segments(1.0), command(document).segments(3.0)
    assert np.array_equal(short.start_values, long.start_values[: len(short.start_values)])
    assert 0.2 <= long.start_values.min() < long.start_values.max() <= 0.4
    other = command({**document, "seed": 8}).segments(1.0)
    assert not np.array_equal(short.start_values, other.start_values)


def test_table_takes_units_jumps_and_times_before_zero():
    document = {
        "shape": "table",
        "times": {"unit": "ms", "values": [-500, 500, 500]},
        "values": ["0 %", "100 %", 0.5],
    }
    segments = command(document).segments(1.0)
    assert as_pieces(segments) == [(0.0, 0.5), (0.5, 0.5)]
    assert segments.end_values == pytest.approx([1.0, 0.5])


def test_table_points_closer_than_any_valve_are_a_jump():
    table = command({"shape": "table", "times": [0.0, 1.0, 1.0 + 1e-15], "values": [0.0, 0.0, 5.0]})
    assert as_pieces(table.segments(2.0)) == [(0.0, 0.0), (1.0, 5.0)]
    assert command({"shape": "chirp", "from": 0, "to": 0, "duration": 1}).segments(2.0).value(1.5) == 0.0


def test_levels_of_another_unit_must_be_given():
    with pytest.raises(InputError, match=r"r.level is missing"):
        signal_from({"shape": "step"}, unit="m", field="r")


@pytest.mark.parametrize(
    ("document", "field", "words"),
    [
        ({"shape": "tringle"}, "command.shape", "no shape 'tringle'"),
        ({"shape": 3}, "command.shape", "no shape '3'"),
        ({}, "command.shape", "missing"),
        ({"shape": "sine", "frequncy": 1}, "command.frequncy", "has no 'frequncy'"),
        ({"shape": "pulse", "on": "3 s", "off": "2 s"}, "command.off", "2 s is not after on = 3 s"),
        ({"shape": "pulse", "on": -1, "off": 2}, "command.on", "-1 is not positive or zero"),
        ({"shape": "square", "period": 0}, "command.period", "0 is not positive"),
        ({"shape": "square", "period": 1, "duty": "120 %"}, "command.duty", "between 0 and 1"),
        ({"shape": "sine", "period": -1}, "command.period", "not positive"),
        ({"shape": "sine", "period": 1, "frequency": 1}, "command.period", "not both"),
        ({"shape": "sine", "frequency": "1 s"}, "command.frequency", "a time"),
        ({"shape": "ramp", "duration": math.nan}, "command.duration", "nan"),
        ({"shape": "random", "hold": 1, "seed": 1.5}, "command.seed", "whole number"),
        ({"shape": "random", "hold": 1, "lower": 1, "upper": 0}, "command.upper", "not above"),
        ({"shape": "table", "times": [0, 2, 1], "values": [1, 2, 3]}, "command.times", "entry 3 is earlier"),
        ({"shape": "table", "times": [0, 1], "values": [1]}, "command.times", "2 times for 1 values"),
        ({"shape": "table", "times": [], "values": []}, "command.times", "empty"),
        ({"shape": "table", "times": "0, 1", "values": [1]}, "command.times", "list"),
        ({"shape": "table", "times": [0], "values": [math.nan]}, "command.values, entry 1", "nan"),
        (
            {"shape": "table", "times": [0], "values": [1], "interpolation": "cubic"},
            "command.interpolation",
            "cubic",
        ),
        ({"shape": "step", "level": 2}, "command", "outside -1 to 1"),
        ({"shape": "step", "level": 1e300}, "command.level", "1e+300"),
        ({"shape": "sine", "frequency": 1e200}, "command.frequency", "1e+200"),
        ({"shape": "ramp", "duration": 1e-320}, "command.duration", "shorter than 1e-09 s"),
    ],
)
def test_what_cannot_be_is_refused(document, field, words):
    error = refusal(document, limits=(-1.0, 1.0))
    assert error.field == field
    assert words in str(error)


def test_a_near_miss_is_named():
    assert refusal({"shape": "tringle"}).hint == "Did you mean 'triangle'?"
    assert refusal({"shape": "sine", "frequncy": 1}).hint == "Did you mean 'frequency'?"
    assert refusal("pulse").field == "command"


@pytest.mark.parametrize(
    "document",
    [
        {"shape": "square", "period": "1 us"},
        {"shape": "square", "period": "1e-8 s"},
        {"shape": "sine", "frequency": "100 kHz"},
        {"shape": "random", "hold": "1 ns"},
        {"shape": "chirp", "from": 0, "to": "1 MHz", "duration": 1},
    ],
)
def test_too_many_segments_are_refused_before_they_are_made(document):
    with pytest.raises(InputError, match=str(MAX_SEGMENTS)) as caught:
        command(document).segments(4.0)
    assert caught.value.field == "command"


@pytest.mark.parametrize("duration", [0.0, -1.0, math.nan, math.inf])
def test_duration_must_be_positive(duration):
    with pytest.raises(InputError, match="duration"):
        command({"shape": "step"}).segments(duration)


def test_dead_time_of_both_edges():
    pulse = switched((0.0, 0.0), (1.0, 1.0), (2.0, 0.0), end=4.0)
    assert as_pieces(delayed(pulse, 0.1, 0.3)) == [(0.0, 0.0), (1.1, 1.0), (2.3, 0.0)]


def test_an_edge_at_the_start_is_delayed_too():
    pulse = switched((0.0, 1.0), (2.0, 0.0), end=4.0)
    assert as_pieces(delayed(pulse, 0.1, 0.3, before=-1.0)) == [(0.0, -1.0), (0.1, 1.0), (2.3, 0.0)]
    assert as_pieces(delayed(pulse, 0.1, 0.3)) == [(0.0, 1.0), (2.3, 0.0)]


def test_a_pulse_shorter_than_the_difference_never_comes():
    pulse = switched((0.0, 0.0), (1.0, 1.0), (1.005, 0.0), end=2.0)
    assert set(delayed(pulse, 0.010, 0.002).start_values) == {0.0}
    pause = switched((0.0, 1.0), (1.0, 0.0), (1.005, 1.0), end=2.0)
    assert set(delayed(pause, 0.002, 0.010).start_values) == {1.0}


def test_a_delay_beyond_the_end_leaves_the_level_before():
    step = switched((0.0, 0.0), (1.0, 1.0), end=2.0)
    assert set(delayed(step, 5.0, 5.0).start_values) == {0.0}


@given(document=documents(), delay=st.floats(0.0, 0.5))
def test_equal_delays_are_a_shift(document, delay):
    original = command(document).segments(4.0)
    late = delayed(original, delay, delay)
    t = np.linspace(delay, 4.0, 300)
    t = t[np.abs(t[:, None] - delay - original.times[None, :]).min(axis=1) > 1e-9]
    slack = 1e-8 * (1.0 + np.abs(original.slopes).max())
    assert late.value(t) == pytest.approx(original.value(t - delay), abs=slack)


@given(document=documents(), on=st.floats(0.0, 0.5), off=st.floats(0.0, 0.5))
def test_delayed_keeps_the_order_and_adds_no_levels(document, on, off):
    original = command(document).segments(3.0)
    late = delayed(original, on, off, before=0.0)
    assert late.times[0] == 0.0
    assert late.times[-1] == 3.0
    assert np.all(np.diff(late.times) > 0.0)
    bounds = np.r_[0.0, original.start_values, original.end_values]
    slack = 1e-9 * (1.0 + np.abs(original.slopes).max())
    values = np.r_[late.start_values, late.end_values]
    assert bounds.min() - slack <= values.min()
    assert values.max() <= bounds.max() + slack


def test_a_continuous_signal_stays_continuous_with_unequal_delays():
    late = delayed(command({"shape": "triangle", "period": 1.0}).segments(3.0), 0.02, 0.05)
    assert late.start_values[1:] == pytest.approx(late.end_values[:-1], abs=1e-9)


def test_impossible_delays_are_refused():
    with pytest.raises(ValueError, match="not negative"):
        delayed(switched((0.0, 1.0), end=1.0), -0.1, 0.0)


@given(first=documents(), second=documents())
def test_merged_keeps_both_values(first, second):
    a, b = command(first).segments(3.0), command(second).segments(3.0)
    one, two = merged(a, b)
    assert one.times is two.times
    t = 0.5 * (one.times[1:] + one.times[:-1])
    for before, after in ((a, one), (b, two)):
        slack = 1e-9 * (1.0 + np.abs(before.slopes).max())
        assert after.value(t) == pytest.approx(before.value(t), abs=slack)


def test_merged_needs_the_same_span():
    with pytest.raises(ValueError, match="different times"):
        merged(switched((0.0, 1.0), end=1.0), switched((0.0, 1.0), end=2.0))
