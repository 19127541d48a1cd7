"""Accuracy in words, by sensor, and by default."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.accuracy import (
    SENSORS,
    SHARE,
    ChannelAccuracy,
    default_accuracy,
    read_accuracy,
    sigma_of,
)
from mckibben.measurement.measurement import Measurement, build
from mckibben.physics.errors import InputError


def plateaus(**further: np.ndarray) -> Measurement:
    """Six readings at each of two clamped lengths."""
    columns = {
        "length": np.repeat([0.25, 0.28], 6),
        "pressure": np.tile(np.linspace(1e5, 6e5, 6), 2),
        "force": np.tile(np.linspace(50.0, 800.0, 6), 2),
    }
    return build(columns | further, name="a.csv", id="0" * 64, kind="isometric")


@pytest.mark.parametrize(
    ("text", "channels"),
    [
        (
            "length 1 mm, force 0.5 %, pressure 20 mbar",
            {"length": (1e-3, "m"), "force": (5e-3, SHARE), "pressure": (2e3, "Pa")},
        ),
        ("length 0,5 mm; force 2 N", {"length": (5e-4, "m"), "force": (2.0, "N")}),
        ("displacement 0.1 mm", {"length": (1e-4, "m")}),
        ("Caliper, force load cell", {"length": (1e-4, "m"), "force": (1e-3, SHARE)}),
        ("pressure 0 bar", {"pressure": (0.0, "Pa")}),
    ],
)
def test_words_are_read(text: str, channels: dict[str, tuple[float, str]]) -> None:
    found = {name: (each.value, each.unit) for name, each in read_accuracy(text).items()}
    assert found == {name: (pytest.approx(value), unit) for name, (value, unit) in channels.items()}


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "no accuracy"),
        ("1 mm", "not a channel or sensor|is not an accuracy"),
        ("length", "is not an accuracy"),
        ("length 3", "no unit"),
        ("length 3 bar", "pressure"),
        ("length -1 mm", "out of range"),
        ("force 25 %", "out of range"),
        ("speed 1 mm", "'speed' is not a channel or sensor"),
        ("length crane scale", "measures force"),
        ("length ruler", "'ruler' is not known"),
        ("length 1 mm, length 2 mm", "twice"),
    ],
)
def test_other_words_are_refused(text: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        read_accuracy(text)


def test_every_sensor_has_a_source_and_is_plausible() -> None:
    for name, sensor in SENSORS.items():
        assert sensor.source, name
        assert read_accuracy(f"{sensor.channel} {name}")[sensor.channel].sensor == name
        assert 0.0 < sensor.value < (0.05 if sensor.unit == SHARE else 2e-3)


def test_plateaus_at_set_lengths_have_a_default() -> None:
    assert default_accuracy(plateaus())["length"] == ChannelAccuracy(1e-3, "m")
    # A machine that measures the length, or records time, is not set by hand.
    measured = np.repeat([0.25, 0.28], 6) + 1e-5 * np.sin(np.arange(12.0))
    assert default_accuracy(plateaus(length=measured)) == {}
    assert default_accuracy(plateaus(time=np.arange(12.0))) == {}


def test_a_share_counts_of_the_largest_value() -> None:
    half = ChannelAccuracy(0.005, SHARE)
    assert sigma_of(half, "force", plateaus(), 0.3) == pytest.approx(4.0)
    assert sigma_of(half, "pressure", plateaus(), 0.3) == pytest.approx(3e3)
    assert sigma_of(half, "length", plateaus(), 0.3) == pytest.approx(1.5e-3)
    assert sigma_of(half, "diameter", plateaus(), 0.3) == 0.0
    assert sigma_of(ChannelAccuracy(2.0, "N"), "force", plateaus(), 0.3) == 2.0
