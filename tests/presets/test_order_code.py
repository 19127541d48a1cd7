"""Order codes of fluidic muscles: those of the paper and the catalogue, and parts that are not understood."""

from __future__ import annotations

import pytest

from mckibben.application.model.order_code import ordered_muscle
from mckibben.documents.start_model import StatedMuscle
from mckibben.physics.errors import InputError
from mckibben.presets.order_code import OrderCode, begin_of_order_code, order_code
from tests.shipped import shipped_studio

KNOWN = ["DMSP-5", "DMSP-10", "DMSP-20", "MAS-10", "MAS-20", "hand-made"]


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("DMSP-20-300N-RM-CM", OrderCode("DMSP-20", 0.3, ("RM", "CM"))),
        ("MAS-10-N-100-AA-MCFK", OrderCode("MAS-10", 0.1, ("AA", "MCFK"))),
        ("dmsp-10-250n", OrderCode("DMSP-10", 0.25, ())),
        ("DMSP-20-N200", OrderCode("DMSP-20", 0.2, ())),
    ],
)
def test_a_code_names_preset_length_and_the_rest(text: str, code: OrderCode) -> None:
    assert order_code(text, KNOWN) == code


@pytest.mark.parametrize("text", ["DMSP-20", "hand-made", "XYZ-20-300N", "", "DMSP"])
def test_what_does_not_begin_like_one_is_none(text: str) -> None:
    assert order_code(text, KNOWN) is None


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("DMSP-21-300N", "'21'"),
        ("DMSP-20-300X-RM", "'300X'"),
        ("DMSP-20-0N", "'0N'"),
        ("DMSP-20-300N-R2", "'R2'"),
        ("DMSP-20-300N-RN-CM", "'RN'"),
        ("MAS-10-N-100-AA-MCX", "'MCX'"),
        ("MAS-10-N-long", "'Nlong'"),
    ],
)
def test_the_part_that_is_not_understood_is_named(text: str, part: str) -> None:
    with pytest.raises(InputError, match=part) as refused:
        order_code(text, KNOWN)
    assert text in refused.value.message
    assert refused.value.hint


def test_the_meanings_are_those_of_the_type_code() -> None:
    code = order_code("MAS-10-N-100-AA-MCFK-ER", KNOWN)
    assert code is not None
    membrane, connection, other = code.meanings
    assert "chloroprene" in membrane
    assert "one side" in connection
    assert "force limiter" in connection
    assert "changes nothing" in other


def test_the_use_case_says_what_each_part_means_and_where_one_is_not_understood() -> None:
    studio = shipped_studio()
    found = ordered_muscle(" mas-10-N-100-AA-MCFK ", studio)
    assert (found.preset, found.nominal_length) == ("MAS-10", 0.1)
    assert [part.text for part in found.parts] == ["MAS", "10", "100N", "AA", "MCFK"]
    for text, field in (
        ("XYZ-20-300N", "code.0"), ("DMSP-21-300N", "code.1"), ("DMSP-20-300X-RM", "code.2"),
        ("MAS-10-N-10O-AA", "code.3"), ("DMSP-20-300N-RM-C1", "code.4"), ("DMSP-20", "code"), ("", "code.0"),
    ):  # fmt: skip
        with pytest.raises(InputError) as refused:
            ordered_muscle(text, studio)
        assert refused.value.field == field, text


def test_a_muscle_is_found_by_its_code_with_the_length_of_the_code() -> None:
    studio = shipped_studio()
    start = studio.start_model(StatedMuscle(preset="DMSP-20-250N-RM-CM"), None)
    assert start.muscle.nominal_length == 0.25
    assert start.preset is not None
    assert start.preset.id == "DMSP-20"
    other = studio.start_model(StatedMuscle(preset="DMSP-20-250N", nominal_length=0.4), None)
    assert other.muscle.nominal_length == 0.4
    with pytest.raises(InputError, match="'25ON'") as refused:
        studio.facts("DMSP-20-25ON")
    assert (refused.value.code, refused.value.field) == ("unknown_preset", "muscle.preset")


@pytest.mark.parametrize("preset", ["DMSP-5", "DMSP-40", "MAS-10"])
def test_what_is_written_on_a_parts_list_is_understood_again(preset: str) -> None:
    code = begin_of_order_code(preset=preset, length=0.2471)
    assert code is not None
    assert order_code(f"{code}-RM-CM", [preset]) == OrderCode(preset, 0.247, ("RM", "CM"))


@pytest.mark.parametrize("preset", ["hand-made", "paper", "DMSP-20-mine"])
def test_other_muscles_have_no_order_code(preset: str) -> None:
    assert begin_of_order_code(preset=preset, length=0.3) is None
