"""What the preview shows as the reason why a column is what it is."""

from __future__ import annotations

from mckibben.measurement.reading import preview, spoken_correction
from tests.measurement.reading.isobaric import FORCE, PRESSURE, STROKE, table

TEXT = (
    "# Weg positiv = Muskel verkürzt sich\n# pressure is absolute\n"
    "Soll [bar],Druck [bar],Weg [mm],Kraft [N]\n"
    + table(PRESSURE, PRESSURE * 1.01 + 1.01325, STROKE, FORCE)
)  # fmt: skip


def test_each_thing_that_is_read_of_a_column_names_its_words_and_their_place() -> None:
    aside, pressure, stroke, force = preview(TEXT.encode(), "a.csv").columns
    assert aside.channel is None
    assert any(line.startswith("set value: 'Soll [bar]' (line 3") for line in aside.evidence)
    assert [line.split("'")[0] for line in pressure.evidence] == ["pressure: ", "bar: ", "absolute: "]
    assert pressure.evidence[2].endswith("'# pressure is absolute' (line 2)")
    assert stroke.evidence[2] == "sign as it stands: '# Weg positiv = Muskel verkürzt sich' (line 1)"
    assert [line.split("'")[0] for line in force.evidence] == ["force: ", "N: "]


def test_what_the_user_says_needs_no_other_reason() -> None:
    said = spoken_correction(columns=["force=Kraft [N]"])
    assert preview(TEXT.encode(), "a.csv", said).columns[3].evidence == ("you say what it is",)
