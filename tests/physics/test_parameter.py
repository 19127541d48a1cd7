"""Parameters and sources refuse what cannot be meant, and name it."""

from __future__ import annotations

import dataclasses

import pytest

from mckibben.physics.parameter import GRADES, MuscleSize, Parameter, Source

SOURCE = Source("Chou & Hannaford 1996", "M")


def parameter(**changes: object) -> Parameter:
    """A valid parameter with some fields changed."""
    fields = {
        "name": "force",
        "symbol": "F_c",
        "unit": "N",
        "default": 10.0,
        "lower": 0.0,
        "upper": 200.0,
        "source": SOURCE,
        "description": "Half the width of the loop.",
        "off": 0.0,
    }
    return Parameter(**{**fields, **changes})


def test_a_valid_one() -> None:
    assert parameter().fitted
    assert parameter(off=None).off is None
    assert parameter(default=0.0).default == parameter().lower, "bounds belong to the range"


def test_bounds_of_a_strong_muscle_are_the_same_share_of_its_force() -> None:
    grows = parameter(lower=-50.0, unit="N")
    assert [grows.bounds(MuscleSize(force)) for force in (0.0, 500.0, 2000.0)] == [(-50.0, 200.0)] * 3
    assert grows.bounds(MuscleSize(4900.0)) == pytest.approx((-122.5, 490.0))
    number = {"unit": "1", "lower": 0.05, "upper": 20.0, "off": None}
    assert parameter(**number, with_force=True).bounds(MuscleSize(4000.0)) == (0.05, 40.0), "never towards 0"
    assert parameter(**number).bounds(MuscleSize(4900.0)) == (0.05, 20.0)


@pytest.mark.parametrize(
    ("unit", "factor"),
    [
        ("m", 3.0),
        ("N/m", 4.0 / 3.0),
        ("m/N", 1.0),
        ("1/N", 1.0),
        ("m3", 3.0 * 2.0**2),
        ("Pa", 1.0),
        ("s", 1.0),
    ],
)
def test_bounds_of_a_long_muscle_are_the_same_shares_of_its_dimensions(unit: str, factor: float) -> None:
    """Four times the force, three times the length and twice the diameter: by the dimension of the unit."""
    large = MuscleSize(8000.0, 0.9, 0.04)
    assert parameter(unit=unit).bounds(large) == pytest.approx((0.0, 200.0 * factor))
    assert parameter(unit="m", across=True).bounds(large) == pytest.approx((0.0, 400.0))


def test_a_small_muscle_may_be_as_compliant_as_a_large_one_over_its_force() -> None:
    small = MuscleSize(100.0, 0.15, 0.005)
    assert parameter(unit="1/N").bounds(small) == pytest.approx((0.0, 200.0 * 20.0))
    assert parameter(unit="m/N").bounds(small) == pytest.approx((0.0, 200.0 * 10.0))
    assert parameter(unit="N").bounds(small) == (0.0, 200.0)


def test_a_default_of_one_muscle_is_the_same_share_of_the_force_of_another() -> None:
    stated = parameter(default_at=4000.0)
    defaults = [stated.default_of(MuscleSize(force)) for force in (0.0, 4000.0, 1000.0)]
    assert defaults == [10.0, 10.0, 2.5]
    assert parameter(unit="Pa", default_at=10.0).default_of(MuscleSize(4000.0)) == 200.0, "within the bounds"
    assert parameter().default_of(MuscleSize(1000.0)) == 10.0


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"name": "loop width"}, r"'loop width' is not an identifier"),
        ({"lower": 300.0}, r"'force': lower bound 300.0 is not below 200.0"),
        ({"lower": 10.0, "upper": 10.0}, r"'force': lower bound"),
        ({"default": -1.0}, r"'force': default -1.0 is outside \[0.0, 200.0\]"),
        ({"default": 201.0}, r"'force': default 201.0 is outside"),
        ({"off": -5.0}, r"'force': off value -5.0 is outside its bounds"),
        ({"measured": (0.0, 1e9)}, r"'force': measured range without default or beyond the bounds"),
        ({"default": float("nan")}, r"'force': .* must be finite"),
        ({"upper": float("inf")}, r"'force': .* must be finite"),
        ({"off": float("nan")}, r"'force': .* must be finite"),
    ],
)
def test_refusals_name_the_parameter(changes: dict, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        parameter(**changes)


def test_cannot_be_changed() -> None:
    with pytest.raises(dataclasses.FrozenInstanceError):
        parameter().default = 1.0  # type: ignore[misc]


@pytest.mark.parametrize("grade", sorted(GRADES))
def test_grades(grade: str) -> None:
    assert Source("anything", grade).verified == (grade not in ("M", "E"))


def test_unknown_grade_is_refused() -> None:
    with pytest.raises(ValueError, match=r"grade 'A' of source 'a paper' is not one of S, S2, C"):
        Source("a paper", "A")
