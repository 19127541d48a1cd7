"""Old workbooks whose parts lead back into themselves are refused before a library follows them."""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest

from mckibben.measurement.reading import read_measurement
from mckibben.measurement.reading.compound import has_sound_chains
from mckibben.physics.errors import InputError

STRANGERS = Path(__file__).parent / "strangers"


@pytest.fixture(scope="module")
def workbook() -> bytes:
    """An .xls of a stranger."""
    with zipfile.ZipFile(STRANGERS / "frontier.zip") as archive:
        return archive.read("files/ensayo_musculo_casero.xls")


def test_a_workbook_as_it_is_written_is_sound(workbook: bytes) -> None:
    assert has_sound_chains(workbook)


@pytest.mark.parametrize("place", range(4))
def test_a_chain_that_leads_back_is_refused(workbook: bytes, place: int) -> None:
    table = 512 * (1 + int.from_bytes(workbook[76:80], "little"))  # where the next sectors stand
    used = [i for i in range(128) if int.from_bytes(workbook[table + 4 * i :][:4], "little") < 0xFFFFFFFA]
    at = table + 4 * used[place]
    damaged = workbook[:at] + used[0].to_bytes(4, "little") + workbook[at + 4 :]
    assert not has_sound_chains(damaged)
    with pytest.raises(InputError, match="the workbook is damaged"):
        read_measurement(damaged, "a.xls")


def test_a_file_that_is_cut_off_is_none(workbook: bytes) -> None:
    for size in (600, 1024, 3000):
        assert not has_sound_chains(workbook[:size])
