"""The length at which a muscle was held, in the names of files."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mckibben.application.measurement.files import measurements_of
from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading import Correction, read_measurement
from mckibben.measurement.reading.named import length_of_name
from mckibben.physics.errors import InputError
from tests.measurement.reading.isobaric import TIME, table
from tests.shipped import shipped_studio

ROWS = "t [s],p [bar],F [N]\n" + table(TIME, np.linspace(1.0, 5.0, 40), np.linspace(90.0, 600.0, 40))
ISOMETRIC = f"# isometric test\n{ROWS}"


def read(
    name: str, rest: float | None = 0.15, text: str = ISOMETRIC, others: tuple[str, ...] = ()
) -> Measurement:
    """The measurement of a text under a name; the rest length as ``--rest-length`` says it."""
    said = {} if rest is None else {"nominal_length": rest}
    return read_measurement(text.encode(), name, replace(Correction(conditions=said), beside=others))


@pytest.mark.parametrize(
    ("name", "rest", "millimetres"),
    [
        ("sine_L380mm.dat", 0.4, 380.0), ("L_380_mm.csv", 0.4, 380.0), ("step_L40cm.dat", 0.4, 400.0),
        ("held 38,5 cm.csv", 0.4, 385.0), ("iso_138.txt", 0.15, 138.0), ("iso_L138.txt", 0.15, 138.0),
        ("2024-03-17_iso_138.txt", 0.15, 138.0), ("DMSP-20-250N_231_3bar.csv", 0.25, 231.0),
    ],
)  # fmt: skip
def test_a_name_says_the_length(name: str, rest: float, millimetres: float) -> None:
    found = read(name, rest)
    np.testing.assert_allclose(found.columns["length"], 1e-3 * millimetres)
    assert found.kind == "isometric"
    assert any("length is taken from the file's name" in message for message in found.messages)


@pytest.mark.parametrize(
    ("name", "rest"),
    [
        ("test_2024.csv", 2.0), ("iso_2024.csv", 2.0), ("run_130_2.csv", 0.15), ("test_138.csv", 0.15),
        ("Versuch 138.csv", 0.15), ("iso_0138.csv", 0.15), ("iso_38.csv", 0.04), ("iso_70.csv", 0.15),
        ("iso_138_146.csv", 0.15), ("iso_138Hz.csv", 0.15), ("stroke140mm.csv", 0.15),
        ("hose 140 mm.csv", 0.15),
        ("DMSP-20-250N.csv", 0.25), ("iso_240317.csv", 0.3), ("iso_p138.csv", 0.15),
    ],
)  # fmt: skip
def test_other_numbers_of_names_are_no_length(name: str, rest: float) -> None:
    with pytest.raises(InputError, match="the length at which the muscle was held"):
        read(name, rest)


@pytest.mark.parametrize(
    ("names", "rest", "millimetres"),
    [
        (("iso_138.txt", "iso_146.txt", "iso_150.txt"), 0.15, 138.0),
        (("iso_38.txt", "iso_34.txt", "iso_29.txt"), 0.04, 38.0),
        (("iso_150_138.5.txt", "iso_150_146.txt"), 0.15, 138.5),
        (("138_1.txt", "146_2.txt", "150_3.txt"), 0.15, 138.0),
    ],
)
def test_the_number_that_differs_among_the_files_of_a_test(
    names: tuple[str, ...], rest: float, millimetres: float
) -> None:
    found = read(names[0], rest, others=names[1:])
    np.testing.assert_allclose(found.columns["length"], 1e-3 * millimetres)
    assert any("differs among the files" in message for message in found.messages)


@pytest.mark.parametrize(
    "names",
    [
        ("run_130.txt", "run_138.txt"),  # runs
        ("iso_38.txt", "iso_39.txt", "iso_40.txt"),  # counted
        ("iso_38.txt", "iso_95.txt"),  # one of them is no length of this muscle
        ("iso_38_36.txt", "iso_36_38.txt"),  # two that differ
    ],
)
def test_numbers_that_count_or_do_not_fit_are_none(names: tuple[str, ...]) -> None:
    assert length_of_name(names[0], 0.04, isometric=True, others=names[1:]) is None


def test_files_given_together_are_one_test(tmp_path: Path) -> None:
    for number in (38, 34, 29):
        (tmp_path / f"iso_{number}.txt").write_text(ISOMETRIC)
    said = Correction(conditions={"nominal_length": 0.04})
    found = measurements_of(sorted(str(path) for path in tmp_path.iterdir()), shipped_studio(), said)
    lengths = [each.points.measurement.columns["length"][0] for each in found]
    np.testing.assert_allclose(lengths, [0.029, 0.034, 0.038])


@pytest.mark.parametrize(("name", "millimetres"), [("iso_138.txt", 138.0), ("iso_L140mm.txt", 140.0)])
def test_the_length_of_the_muscle_may_stand_beside_the_file(name: str, millimetres: float) -> None:
    """It says what the number in the name is, but not who says the rest length of the file."""
    found = read_measurement(ISOMETRIC.encode(), name, Correction(muscle_length=0.15))
    np.testing.assert_allclose(found.columns["length"], 1e-3 * millimetres)
    assert "nominal_length" not in found.conditions


def test_without_a_rest_length_the_hint_names_the_number() -> None:
    for name, shown in (("iso_138.txt", "'138'"), ("sine_L380mm.dat", "'L380mm'")):
        with pytest.raises(InputError) as caught:
            read(name, None)
        assert f"{shown} in the file's name is it where --rest-length is stated" in str(caught.value)


def test_a_strict_reading_takes_no_bare_number() -> None:
    said = Correction(conditions={"nominal_length": 0.15}, strict=True)
    with pytest.raises(InputError, match="the length at which"):
        read_measurement(ISOMETRIC.encode(), "iso_138.txt", said)
    found = read_measurement(ISOMETRIC.encode(), "iso_L138mm.txt", said)
    np.testing.assert_allclose(found.columns["length"], 0.138)


def test_a_bare_number_is_a_length_in_isometric_tests_only() -> None:
    assert "length" not in read("blow_138.txt", text=ROWS).columns
    assert "length" in read("iso_138.txt", text=ROWS).columns
