"""Files of one test say for each other what one of them leaves open."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mckibben.application.measurement.files import measurements_of
from mckibben.documents.studio import Studio
from mckibben.measurement.measurement import Measurement
from mckibben.physics.errors import InputError
from tests.measurement.reading.isobaric import FORCE, PRESSURE, STROKE, table
from tests.shipped import shipped_studio

AIR = 1.01325  # bar
HEAD = "Druck [bar];Weg [mm];Kraft [N]\n"
SAID = "# Druck absolut\n# Kraft negativ bei Zug\n"


@pytest.fixture(scope="module")
def studio() -> Studio:
    """The presets and effects as shipped."""
    return shipped_studio()


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A run whose preamble says how its sensors count, and one that says nothing."""
    for name, said, factor in (("a.csv", SAID, 1.0), ("b.csv", "", 0.9)):
        rows = table(PRESSURE + AIR, STROKE, -factor * FORCE, separator=";")
        (tmp_path / name).write_text(said + HEAD + rows)
    return tmp_path


def read(folder: Path, studio: Studio, *names: str) -> list[Measurement]:
    found = measurements_of([str(folder / name) for name in names], studio)
    return [one.points.measurement for one in found]


@pytest.mark.parametrize("order", [("a.csv", "b.csv"), ("b.csv", "a.csv")])
def test_what_one_run_says_of_a_sensor_counts_for_the_other(
    folder: Path, studio: Studio, order: tuple[str, str]
) -> None:
    alone = read(folder, studio, "b.csv")[0]
    np.testing.assert_allclose(alone.columns["pressure"], (PRESSURE + AIR) * 1e5)
    found = {one.name: one for one in read(folder, studio, *order)}
    for one in found.values():
        np.testing.assert_allclose(one.columns["pressure"], PRESSURE * 1e5, rtol=1e-9)
    np.testing.assert_allclose(found["b.csv"].columns["force"], 0.9 * FORCE, rtol=1e-9)
    assert any("'# Druck absolut' (a.csv, line 1)" in message for message in found["b.csv"].messages)
    assert found["b.csv"].id != alone.id  # read in another way


def test_other_columns_are_another_rig(folder: Path, studio: Studio) -> None:
    rows = table(PRESSURE, STROKE, FORCE, separator=";")
    (folder / "c.csv").write_text(HEAD.replace("Druck", "p") + rows)
    np.testing.assert_allclose(read(folder, studio, "a.csv", "c.csv")[1].columns["pressure"], PRESSURE * 1e5)


def test_what_a_run_says_itself_stands(folder: Path, studio: Studio) -> None:
    rows = table(PRESSURE, STROKE, -FORCE, separator=";")
    (folder / "c.csv").write_text("# Relativdruck\n" + HEAD + rows)
    np.testing.assert_allclose(read(folder, studio, "a.csv", "c.csv")[1].columns["pressure"], PRESSURE * 1e5)


def test_notes_without_readings_are_texts_of_all_files(folder: Path, studio: Studio) -> None:
    (folder / "notes.md").write_text("Versuch 12\nRuhelänge 300 mm, Druck absolut\n")
    found = read(folder, studio, "notes.md", "b.csv")
    assert [one.name for one in found] == ["b.csv"]
    assert found[0].conditions["nominal_length"] == 0.3
    np.testing.assert_allclose(found[0].columns["pressure"], PRESSURE * 1e5, rtol=1e-9)
    assert found[0].messages[0] == "notes.md holds no readings: its texts count for the files beside it"


def test_a_table_without_numbers_is_no_note_and_notes_alone_are_no_measurement(
    folder: Path, studio: Studio
) -> None:
    (folder / "broken.csv").write_text(HEAD + "x;y;z\n")
    with pytest.raises(InputError, match=r"broken\.csv, row 1: there are no rows of numbers"):
        read(folder, studio, "a.csv", "broken.csv")
    (folder / "notes.md").write_text("Ruhelänge 300 mm\n")
    with pytest.raises(InputError, match=r"notes\.md: no table"):
        read(folder, studio, "notes.md")
    with pytest.raises(InputError, match="there is no such file"):
        read(folder, studio, "notes.md", "nothing.csv")
