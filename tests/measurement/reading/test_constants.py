"""Columns that hold a condition in every row, and conditions that change within a file."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading import read_measurement, spoken_correction
from mckibben.physics.errors import InputError

FORCES = [1200.0, 900.0, 640.0, 420.0, 250.0, 110.0, 30.0]


def text(*columns: tuple[str, Sequence[str]]) -> bytes:
    """Forces over a contraction at 4 bar, and other columns, whose values are repeated."""
    rows = [";".join(["p [bar]", "Kontraktion [%]", "Kraft [N]", *(head for head, _ in columns)])]
    for index, force in enumerate(FORCES * 3):
        cells = ["4.00", f"{3.5 * (index % len(FORCES)):.1f}", f"{force:.1f}"]
        rows.append(
            ";".join([*cells, *(values[index // len(FORCES) % len(values)] for _, values in columns)])
        )
    return "\n".join(rows).encode()


def read(data: bytes, name: str = "a.csv", **options: object) -> Measurement:
    return read_measurement(data, name, spoken_correction(**options))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("head", "value", "key", "si"),
    [
        ("L0_mm", "300", "nominal_length", 0.3),
        ("Ruhelänge [cm]", "25.0", "nominal_length", 0.25),
        ("mass_kg", "12", "load_mass", 12.0),
        ("Versorgungsdruck [bar]", "6.0", "supply_pressure", 6e5),
    ],
)
def test_a_column_of_one_value_is_a_condition(head: str, value: str, key: str, si: float) -> None:
    result = read(text((head, [value])))
    assert result.conditions[key] == pytest.approx(si)
    assert head not in result.ignored
    assert head not in dict(result.unread)
    (stated,) = [one for one in result.stated if one.key == key]
    assert stated.where == f"a.csv, column '{head}'"


def test_the_column_counts_more_than_the_name_of_the_file_and_a_text_is_weighed() -> None:
    data = text(("L0 [mm]", ["300"]))
    assert read(data, "DMSP-20-400N.csv").conditions["nominal_length"] == pytest.approx(0.3)
    with pytest.raises(
        InputError, match=r"two values for the rest length, 0.3 m .column 'L0 .mm.'. and 250 mm"
    ):
        read(b"# rest_length: 250 mm\n" + data)
    same = read(b"# rest_length: 30 cm\n" + data)
    assert same.conditions["nominal_length"] == pytest.approx(0.3)


def test_the_order_code_in_a_column_states_the_rest_length() -> None:
    result = read(text(("muscle", ["DMSP-40-300N"])))
    assert result.conditions["nominal_length"] == pytest.approx(0.3)
    assert result.conditions["muscle"] == "DMSP-40"
    both = read(text(("muscle", ["DMSP-40-300N"]), ("L0_mm", ["305"])))
    assert both.conditions["nominal_length"] == pytest.approx(0.305)


def test_a_rest_length_that_changes_is_asked_for() -> None:
    data = text(("L0 [mm]", ["200", "300", "400"]))
    with pytest.raises(InputError, match=r"'L0 \[mm\]' holds 3 values, 200 mm, 300 mm, 400 mm"):
        read(data)
    assert read(data, rest_length="300 mm").conditions["nominal_length"] == pytest.approx(0.3)
    beside = read(text(("mass_kg", ["5", "10"])))  # a measured force needs no load
    assert "column 'mass_kg' is not used: force is read from 'Kraft [N]'" in beside.messages
    assert read(text(("mass_kg", ["5", "10"])), load="5 kg").conditions["load_mass"] == pytest.approx(5.0)
