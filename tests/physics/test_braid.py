"""The three geometry forms, their conversions and limits."""

from __future__ import annotations

from math import asin, atan, cos, hypot, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mckibben.physics.braid import (
    Braid,
    Rhombus,
    angle,
    braid_from_diameter,
    braid_from_rhombus,
    diameter,
    rest_diameter_and_angle,
    rhombus_of,
    volume,
)
from mckibben.physics.errors import InputError

THETA = radians(25.0)
BRAID = braid_from_diameter(diameter=0.010, braid_angle=THETA, length=0.100)

geometries = st.tuples(
    st.floats(0.004, 0.060),  # diameter [m]
    st.floats(radians(15.0), radians(50.0)),  # braid angle
    st.floats(0.05, 2.0),  # length [m]
)


def test_reference_numbers() -> None:
    assert BRAID.thread_length == pytest.approx(0.1103378, rel=5e-7)
    assert BRAID.turns == pytest.approx(1.4843034, rel=5e-8)
    # pi/4 10 mm^2 100 mm
    assert volume(braid=BRAID, length=0.100) == pytest.approx(7.853981633974483e-6, rel=1e-12)


@given(geometries)
def test_thread_is_the_hypotenuse_of_the_unrolled_cylinder(geometry: tuple[float, float, float]) -> None:
    d, theta, length = geometry
    braid = braid_from_diameter(diameter=d, braid_angle=theta, length=length)
    around = braid.turns * pi * d
    assert braid.thread_length == pytest.approx(hypot(length, around), rel=1e-12)
    assert atan(around / length) == pytest.approx(theta, rel=1e-12)


@given(geometries, st.floats(1e-4, 1e-2))
def test_three_forms_round_trip(geometry: tuple[float, float, float], side: float) -> None:
    d, theta, length = geometry
    braid = braid_from_diameter(diameter=d, braid_angle=theta, length=length)
    lattice = rhombus_of(braid=braid, side=side)
    assert lattice.side == side
    again = braid_from_rhombus(side=lattice.side, along=lattice.along, around=lattice.around)
    assert again.thread_length == pytest.approx(braid.thread_length, rel=1e-13)
    assert again.turns == pytest.approx(braid.turns, rel=1e-13)
    rest = rest_diameter_and_angle(braid=again, length=length)
    assert rest == (pytest.approx(d, rel=1e-11), pytest.approx(theta, rel=1e-11))


def test_lattice_spans_length_and_circumference() -> None:
    """The diagonals of a rhombus of side l are 2 l cos(theta) along and 2 l sin(theta) around."""
    lattice = Rhombus(0.002, 60.0, 20.0)
    braid = braid_from_rhombus(side=lattice.side, along=lattice.along, around=lattice.around)
    assert braid == (0.24, 3.0)
    theta = radians(30.0)
    length = lattice.along * 2.0 * lattice.side * cos(theta)
    around = lattice.around * 2.0 * lattice.side * sin(theta)
    assert diameter(braid=braid, length=length) == pytest.approx(around / pi, rel=1e-13)
    assert angle(braid=braid, length=length) == pytest.approx(theta, rel=1e-13)


def test_diameter_squared_is_a_straight_line_over_length_squared() -> None:
    """Force-free identification of (b, n): slope -1/(n pi)^2, intercept (b/(n pi))^2."""
    lengths = np.linspace(0.05, 0.11, 30)
    slope, intercept = np.polyfit(lengths**2, diameter(braid=BRAID, length=lengths) ** 2, 1)
    turns = sqrt(-1.0 / slope) / pi
    assert turns == pytest.approx(BRAID.turns, rel=1e-9)
    assert sqrt(intercept) * turns * pi == pytest.approx(BRAID.thread_length, rel=1e-9)


def test_largest_volume_is_at_the_zero_force_length() -> None:
    """D(L_min)/D0 = sqrt(2/3)/sin(theta0) = 1.9319955, V_max/V0 = 2.3778031 at 25 degrees."""
    shortest = BRAID.thread_length / sqrt(3.0)
    assert diameter(braid=BRAID, length=shortest) / 0.010 == pytest.approx(1.9319955, rel=5e-8)
    ratio = volume(braid=BRAID, length=shortest) / volume(braid=BRAID, length=0.100)
    assert ratio == pytest.approx(2.3778031, rel=5e-8)
    lengths = np.linspace(0.05, 0.11, 2001)
    assert abs(lengths[np.argmax(volume(braid=BRAID, length=lengths))] - shortest) <= 0.06 / 2000
    assert angle(braid=BRAID, length=shortest) == pytest.approx(radians(54.73561032), rel=1e-9)


def test_volume_in_angles_is_the_corrected_equation_3() -> None:
    """V = b^3 sin^2(theta) cos(theta)/(4 pi n^2); the paper prints b^2/(n pi), a unit of area."""
    b, n = BRAID
    for theta in np.radians([10.0, 25.0, 40.0, 54.0, 70.0]):
        expected = b**3 * sin(theta) ** 2 * cos(theta) / (4.0 * pi * n**2)
        assert volume(braid=BRAID, length=b * cos(theta)) == pytest.approx(expected, rel=1e-12)


def test_beyond_the_braid_lock() -> None:
    """At and beyond L = b the threads are parallel to the axis: nearly no diameter, no angle, no NaN."""
    lengths = BRAID.thread_length * np.array([1.0, 1.01, 2.0])
    widths = diameter(braid=BRAID, length=lengths)
    assert np.all(widths > 0.0)
    assert np.all(widths < 1e-7)
    assert np.array_equal(angle(braid=BRAID, length=lengths), np.zeros(3))


def test_thread_that_is_too_short_is_refused() -> None:
    with pytest.raises(
        InputError, match=r"thread \(90 mm\) is not longer than the muscle \(100 mm\)"
    ) as caught:
        rest_diameter_and_angle(braid=Braid(0.09, 2.0), length=0.1)
    assert caught.value.field == "thread_length"
    with pytest.raises(InputError):
        rest_diameter_and_angle(braid=Braid(0.1, 2.0), length=0.1)
    with pytest.raises(InputError):
        rest_diameter_and_angle(braid=Braid(float("nan"), 2.0), length=0.1)


def test_arguments_are_given_by_name() -> None:
    with pytest.raises(TypeError):
        braid_from_diameter(0.01, THETA, 0.1)  # type: ignore[misc]


def test_angle_of_a_known_triangle() -> None:
    """3-4-5: thread 5, length 4, so sin(theta) = 3/5."""
    braid = Braid(0.5, 2.0)
    assert angle(braid=braid, length=0.4) == pytest.approx(asin(0.6), rel=1e-14)
    assert diameter(braid=braid, length=0.4) == pytest.approx(0.3 / (2.0 * pi), rel=1e-14)
    assert tan(angle(braid=braid, length=0.4)) == pytest.approx(0.75, rel=1e-14)
