"""Archives, compressed files, sheets of LibreOffice, data bases: one test is read, others are refused."""

from __future__ import annotations

import gzip
import io
import sqlite3
import zipfile
from collections.abc import Callable

import numpy as np
import pytest

from mckibben.physics.errors import InputError
from tests.measurement.read.bench import FORCE, PRESSURE, STROKE, TIME, assert_is_the_test, read, table

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


def test_arrays_of_numpy() -> None:
    data = io.BytesIO()
    np.savez(data, t_s=TIME, p_bar=PRESSURE, F_N=FORCE, shortening_mm=STROKE, rest_length=np.array("300 mm"))
    assert_is_the_test(read(data.getvalue(), "a.npz"))


def test_a_sheet_of_libreoffice() -> None:
    def cell(value: object) -> str:
        if isinstance(value, str):
            return f'<table:table-cell office:value-type="string"><text:p>{value}</text:p></table:table-cell>'
        return f'<table:table-cell office:value-type="float" office:value="{value}"/>'

    rows = [["rest length 300 mm"], [], ["t [s]", "p [bar]", "F [N]", "shortening [mm]"]]
    rows += [list(map(float, row)) for row in zip(TIME, PRESSURE, FORCE, STROKE, strict=True)]
    body = "".join(f"<table:table-row>{''.join(map(cell, row))}</table:table-row>" for row in rows)
    spaces = " ".join(
        f'xmlns:{name}="urn:oasis:names:tc:opendocument:xmlns:{name}:1.0"'
        for name in ("office", "table", "text")
    )
    sheet = f'<table:table table:name="Test">{body}</table:table>'
    content = f"<office:document-content {spaces}>{sheet}</office:document-content>"
    data = packed(mimetype="application/vnd.oasis.opendocument.spreadsheet", content__xml=content)
    assert_is_the_test(read(data, "a.ods"))


def test_a_data_base() -> None:
    base = sqlite3.connect(":memory:")
    base.execute("CREATE TABLE meta (key TEXT, value TEXT)")
    base.execute("INSERT INTO meta VALUES ('rest_length', '300 mm')")
    base.execute("CREATE TABLE samples (t_s REAL, p_bar REAL, F_N REAL, shortening_mm REAL)")
    rows = [tuple(map(float, row)) for row in zip(TIME, PRESSURE, FORCE, STROKE, strict=True)]
    base.executemany("INSERT INTO samples VALUES (?, ?, ?, ?)", rows)
    base.commit()
    assert_is_the_test(read(base.serialize(), "a.db"))


def _wide_base() -> bytes:
    """A small data base whose rows are all gaps, of as many columns as SQLite takes."""
    base = sqlite3.connect(":memory:")
    base.execute(f"CREATE TABLE a ({', '.join(f'c{n}' for n in range(1900))})")
    base.executemany("INSERT INTO a (c0) VALUES (?)", [(n,) for n in range(20_000)])
    base.commit()
    return base.serialize()


def _false_array() -> bytes:
    """An array whose head says more numbers than there are."""
    data = io.BytesIO()
    np.save(data, np.zeros(3))
    return packed(t__npy=data.getvalue().replace(b"(3,)", b"(9" + b"9" * 11 + b",)"))


HOSTILE: dict[str, Callable[[], bytes]] = {
    "zeros.zip": lambda: packed(a__csv=b"0," * 20_000_000),
    "nested.zip": lambda: packed(a__zip=packed(a__csv=TABLE), b__csv=packed(a__csv=TABLE)),
    "torn.zip": lambda: packed(a__csv=TABLE)[:-30],
    "torn.csv.gz": lambda: gzip.compress(TABLE.encode())[:-20],
    "zeros.csv.gz": lambda: gzip.compress(b"0," * 50_000_000),
    "twice.csv.gz": lambda: gzip.compress(gzip.compress(TABLE.encode())),
    "wide.db": _wide_base,
    "torn.db": lambda: _wide_base()[:5000],
    "false.npz": _false_array,
    "odd.ods": lambda: packed(mimetype="a", content__xml="<a><b></a>"),
    "several.zip": lambda: packed(a__json="{}", b__json="{}"),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_what_is_packed_beyond_measure_or_damaged_is_refused(name: str) -> None:
    content = HOSTILE[name]()
    with pytest.raises(InputError) as caught:
        read(content, name)
    assert name.split(".")[0] in str(caught.value)
