"""Sines for the nonlinear drive: the linear response when they are small, describing functions beyond."""

from __future__ import annotations

from math import acos, pi, sqrt

import numpy as np
import pytest

from mckibben.simulation.linear.linearise import balanced_bias, balanced_share, linearise
from mckibben.simulation.linear.response import eigenvalues, frequency_response
from mckibben.simulation.linear.sweep import describing_points
from tests.simulation.linear.drives import drive

FREQUENCIES = (1.0, 4.0, 8.0)


@pytest.mark.parametrize(("source", "amplitude"), [("command", 0.01), ("load_force", 1.0)])
def test_a_small_sine_gives_the_linear_response(source: str, amplitude: float) -> None:
    linear = linearise(drive("regulator"))
    points = describing_points(
        linear, source=source, out="position", frequencies=FREQUENCIES, amplitudes=(amplitude,)
    )
    expected = frequency_response(linear.primary, source, "position", np.array(FREQUENCIES))
    for point, value in zip(points, expected, strict=True):
        assert point.remark is None
        assert point.gain == pytest.approx(abs(value), rel=0.02)
        assert np.exp(1j * point.phase) == pytest.approx(value / abs(value), abs=0.03)
        assert point.distortion < 0.02


def test_an_undamped_drive_swings_by_itself_beside_the_sine() -> None:
    """Above its own 3 Hz that oscillation is larger than the forced one, and never decays."""
    linear = linearise(drive("propneu-20"))
    own = max(abs(value.imag) for value in eigenvalues(linear.primary)) / (2.0 * pi)
    frequencies = tuple(own * share for share in (0.3, 1.5, 2.0))
    points = describing_points(
        linear, source="command", out="position", frequencies=frequencies, amplitudes=(0.01,)
    )
    # A small sine opens the valve anew in each period: the dead time is that of opening.
    expected = frequency_response(linear.models[0], "command", "position", np.array(frequencies))
    for point, value in zip(points, expected, strict=True):
        assert point.gain == pytest.approx(abs(value), rel=0.06)
        assert np.angle(np.exp(1j * point.phase) / value) == pytest.approx(0.0, abs=0.15)
    assert points[-1].remark == "the drive's own oscillation does not decay; it is taken off"
    near = describing_points(
        linear, source="command", out="position", frequencies=(1.02 * own,), amplitudes=(0.01,)
    )
    assert near[0].remark == "the drive's own oscillation of nearly this frequency does not decay"


def test_a_valve_that_fills_and_vents_lies_between_its_two_models() -> None:
    linear = linearise(drive("valve"))
    points = describing_points(
        linear, source="command", out="position", frequencies=FREQUENCIES, amplitudes=(0.005,)
    )
    expected = frequency_response(linear.primary, "command", "position", np.array(FREQUENCIES))
    for point, value in zip(points, expected, strict=True):
        assert point.gain == pytest.approx(abs(value), rel=0.03)


def test_friction_lies_between_held_and_sliding() -> None:
    linear = linearise(drive("friction"))
    held, sliding = (
        abs(frequency_response(linear.models[i], "command", "position", np.array([1.0]))[0]) for i in (0, 1)
    )
    assert held == 0.0  # 0.5 % of 6 bar are 3 N; the friction takes 10 N
    small, large = describing_points(
        linear, source="command", out="position", frequencies=(1.0,), amplitudes=(0.005, 0.05)
    )
    assert small.gain == 0.0
    assert np.isnan(small.phase)
    assert small.remark == "dry friction holds the load"
    assert 0.0 < large.gain < sliding


def test_the_balance_of_two_gains() -> None:
    # Equal gains need no bias, and each side has half of the describing function.
    assert balanced_bias((3.0, 3.0), 1.0) == pytest.approx(0.0, abs=1e-9)
    assert balanced_share((3.0, 3.0)) == pytest.approx(0.5, abs=1e-6)
    # In closed form: area of a sine above -b is 2 (sqrt(1 - b^2) + b (pi - acos b)), below it the rest.
    bias = balanced_bias((2.0, 1.0), 1.0)
    above = 2.0 * (sqrt(1.0 - bias**2) + bias * (pi - acos(bias)))
    below = 2.0 * (sqrt(1.0 - bias**2) - bias * acos(bias))
    assert bias < 0.0
    assert 2.0 * above == pytest.approx(below, rel=1e-3)
    share = (pi - acos(bias) - bias * sqrt(1.0 - bias**2) + 2.0 * bias * sqrt(1.0 - bias**2)) / pi
    assert balanced_share((2.0, 1.0)) == pytest.approx(share, rel=1e-3)


def test_what_keeps_a_point_from_being_clean_is_said() -> None:
    linear = linearise(drive("regulator"))
    (clipped,) = describing_points(
        linear, source="command", out="position", frequencies=(1.0,), amplitudes=(0.9,)
    )
    assert not np.isfinite(clipped.gain)
    assert clipped.remark == "the sine would leave the range of the command"
    (landed,) = describing_points(
        linearise(drive("valve")), source="command", out="position", frequencies=(0.3,), amplitudes=(0.5,)
    )
    assert landed.remark == "the load touches an end stop"
