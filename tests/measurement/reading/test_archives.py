"""Archives and compressed files: one test is read, others are refused."""

from __future__ import annotations

import gzip
import io
import sqlite3
import zipfile
from collections.abc import Callable

import numpy as np
import pytest

from mckibben.physics.errors import InputError
from tests.measurement.reading.isobaric import FORCE, PRESSURE, STROKE, TIME, assert_is_the_test, read, table

HEAD = "# rest length 300 mm\nt [s],p [bar],F [N],shortening [mm]\n"
TABLE = HEAD + table(TIME, PRESSURE, FORCE, STROKE)


def packed(**members: bytes | str) -> bytes:
    """An archive of members; ``__`` in a name stands for a point."""
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in members.items():
            archive.writestr(name.replace("__", "."), content)
    return data.getvalue()


def test_one_text_in_an_archive_and_a_compressed_one() -> None:
    assert_is_the_test(read(packed(a__csv=TABLE), "a.zip"))
    assert_is_the_test(read(gzip.compress(TABLE.encode()), "a.csv.gz"))


def test_a_text_for_each_pressure_and_a_readme() -> None:
    parts = {
        f"run_{int(p)}bar__csv": "t_s,force_N,shortening_mm\n" + table(TIME[k], FORCE[k], STROKE[k])
        for p in (2.0, 4.0)
        for k in [p == PRESSURE]
    }
    found = read(packed(readme__txt="Rest length 300 mm, gauge pressure\n", **parts), "a.zip")
    assert_is_the_test(found)


def test_archives_and_data_bases_of_other_kinds_are_refused_by_their_kind() -> None:
    arrays = io.BytesIO()
    np.savez(arrays, t_s=TIME, p_bar=PRESSURE)
    array = io.BytesIO()
    np.save(array, TIME)
    base = sqlite3.connect(":memory:")
    base.execute("CREATE TABLE samples (t_s REAL, p_bar REAL)")
    kinds = {
        "a.npz": (arrays.getvalue(), "an archive of numpy's arrays (.npz) is not a table"),
        "a.npy": (array.getvalue(), "the file is an array of numpy"),
        "a.ods": (packed(mimetype="application/vnd", content__xml="<a/>"), "the workbook cannot be opened"),
        "a.db": (base.serialize(), "the file is an SQLite database"),
    }
    for name, (content, what) in kinds.items():
        with pytest.raises(InputError) as caught:
            read(content, name)
        said = caught.value
        assert said.message.startswith(f"{name}: no column can be read: {what}")
        assert "CSV" in str(said.hint)


HOSTILE: dict[str, Callable[[], bytes]] = {
    "zeros.zip": lambda: packed(a__csv=b"0," * 20_000_000),
    "nested.zip": lambda: packed(a__zip=packed(a__csv=TABLE), b__csv=packed(a__csv=TABLE)),
    "torn.zip": lambda: packed(a__csv=TABLE)[:-30],
    "torn.csv.gz": lambda: gzip.compress(TABLE.encode())[:-20],
    "zeros.csv.gz": lambda: gzip.compress(b"0," * 50_000_000),
    "twice.csv.gz": lambda: gzip.compress(gzip.compress(TABLE.encode())),
    "several.zip": lambda: packed(a__json="{}", b__json="{}"),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_what_is_packed_beyond_measure_or_damaged_is_refused(name: str) -> None:
    content = HOSTILE[name]()
    with pytest.raises(InputError) as caught:
        read(content, name)
    assert name.split(".")[0] in str(caught.value)
