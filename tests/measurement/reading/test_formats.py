"""Workbooks, MATLAB and TDMS files beyond the plain case; every format through tests/robustness too."""

import io
import struct
from datetime import datetime, timedelta

import h5py
import numpy as np
import openpyxl
import pytest
from nptdms import ChannelObject, GroupObject, RootObject, TdmsWriter
from scipy.io import savemat

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading import read_measurement
from mckibben.physics.errors import InputError
from tests.robustness.files import COLUMNS, ROWS, SI


def workbook(*sheets: list[list[object]]) -> bytes:
    book = openpyxl.Workbook()
    for number, rows in enumerate(sheets):
        sheet = book.create_sheet(f"s{number}")
        for row in rows:
            sheet.append(row)
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


def matlab(**variables: object) -> bytes:
    stream = io.BytesIO()
    savemat(stream, variables)
    return stream.getvalue()


def tdms(*objects: object) -> bytes:
    stream = io.BytesIO()
    with TdmsWriter(stream) as writer:
        writer.write_segment(list(objects))
    return stream.getvalue()


def refused(data: bytes, name: str) -> InputError:
    with pytest.raises(InputError) as caught:
        read_measurement(data, name)
    return caught.value


def assert_same(result: Measurement, *, but: tuple[str, ...] = ()) -> None:
    for channel, values in SI.items():
        if channel not in but:
            np.testing.assert_allclose(result.columns[channel], values, rtol=1e-12)


def table() -> list[list[object]]:
    return [list(COLUMNS), *(list(row) for row in zip(*(c.tolist() for c in COLUMNS.values()), strict=True))]


def test_a_workbook_is_searched_for_its_table() -> None:
    notes = [["Test of 3 May", None, 7], ["operator", "me"]]
    above = [["A rig"], [], ["# load_mass: 6 kg"], ["# supply_pressure", "7 bar"], [None, None]]
    result = read_measurement(workbook(notes, [*above, *table()]), "a.xlsx")
    assert_same(result)
    assert result.conditions == {"load_mass": 6.0, "supply_pressure": 7e5}


def test_cells_that_are_text_or_times() -> None:
    rows = table()
    start = datetime(2026, 5, 3, 12, 0, 0)
    for number, row in enumerate(rows[1:]):
        row[0] = start + timedelta(seconds=0.5 * number)
        row[3] = str(row[3]).replace(".", ",")
    result = read_measurement(workbook(rows), "a.xlsx")
    assert_same(result, but=("time",))
    np.testing.assert_allclose(result.columns["time"], 0.5 * np.arange(ROWS), atol=1e-3)


def test_a_workbook_says_sheet_row_and_column() -> None:
    rows = table()
    rows[5][2] = "long"
    error = refused(workbook([["nothing"]], rows), "a.xlsx")
    assert error.message.startswith("a.xlsx, sheet 's1', row 6, column 'length_mm': 'long' is not a number")


@pytest.mark.parametrize("packed", [False, True])
def test_scalars_and_texts_are_conditions(packed: bool) -> None:
    stream = io.BytesIO()
    extra = {
        "load_mass": 6.0,
        "supply_pressure_bar": 7.0,
        "kind": "isometric",
        "note": "hello",
        "A": np.eye(3),
    }
    savemat(stream, {**COLUMNS, **extra}, do_compression=packed)
    result = read_measurement(stream.getvalue(), "a.mat")
    assert_same(result)
    assert result.kind == "isometric"
    assert result.conditions == {"load_mass": 6.0, "supply_pressure": 7e5, "note": "hello"}
    assert any(m.startswith("'A' is not read: it is no vector of numbers") for m in result.messages)


def test_words_integers_and_singles() -> None:
    words = np.array(["up"] * 20 + ["down"] * 20, dtype=object)
    columns = {**COLUMNS, "direction": words, "run": np.repeat(np.int16([3, 4]), 20)}
    columns["force_N"] = COLUMNS["force_N"].astype(np.float32)
    result = read_measurement(matlab(data=columns), "a.mat")
    assert_same(result)
    np.testing.assert_array_equal(result.columns["direction"], np.repeat([-1.0, 1.0], 20))
    np.testing.assert_array_equal(result.columns["group"], np.repeat([3, 4], 20))


def test_big_endian_matlab_files() -> None:
    def element(kind: int, data: bytes) -> bytes:
        return struct.pack(">II", kind, len(data)) + data + b"\0" * (-len(data) % 8)

    content = b""
    for name, values in COLUMNS.items():
        parts = element(6, struct.pack(">II", 6, 0)) + element(5, struct.pack(">ii", 1, ROWS))
        parts += element(1, name.encode()) + element(9, values.astype(">f8").tobytes())
        content += element(14, parts)
    header = b"MATLAB 5.0 MAT-file".ljust(124) + b"\x01\x00MI"
    assert_same(read_measurement(header + content, "a.mat"))


def test_what_promises_more_than_it_holds_takes_no_memory() -> None:
    def element(kind: int, data: bytes) -> bytes:
        return struct.pack("<II", kind, len(data)) + data + b"\0" * (-len(data) % 8)

    parts = element(6, struct.pack("<II", 4, 0)) + element(5, struct.pack("<ii", 2**28, 1))
    parts += element(1, b"x") + element(16, b"text")
    header = b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM"
    assert "variable 'x' holds 4 characters" in refused(header + element(14, parts), "a.mat").message


def test_matlab_tables_are_refused_with_a_way_out() -> None:
    def element(kind: int, data: bytes) -> bytes:
        return struct.pack("<II", kind, len(data)) + data + b"\0" * (-len(data) % 8)

    opaque = (
        element(6, struct.pack("<II", 17, 0)) + element(1, b"T") + element(1, b"MCOS") + element(1, b"table")
    )
    header = b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM"
    error = refused(header + element(14, opaque), "a.mat")
    assert error.message == "a.mat, variable 'T': it is a MATLAB table or another object, which is not read"
    assert "table2struct" in str(error.hint)


def hdf5(fill) -> bytes:
    stream = io.BytesIO()
    with h5py.File(stream, "w", userblock_size=512) as file:
        fill(file)
    return stream.getvalue()


def test_structs_and_words_of_v73() -> None:
    def fill(file: h5py.File) -> None:
        group = file.create_group("data")
        group.attrs["MATLAB_class"] = np.bytes_("struct")
        for name, values in COLUMNS.items():
            group.create_dataset(name, data=values[None, :]).attrs["MATLAB_class"] = np.bytes_("double")
        references = []
        for number in range(ROWS):
            codes = np.frombuffer(("up" if number < 20 else "down").encode("utf-16-le"), np.uint16)
            word = file.create_dataset(f"#refs#/{number}", data=codes[:, None])
            word.attrs["MATLAB_class"] = np.bytes_("char")
            references.append(word.ref)
        cells = group.create_dataset("direction", data=np.array([references], dtype=h5py.ref_dtype))
        cells.attrs["MATLAB_class"] = np.bytes_("cell")
        mass = file.create_dataset("load_mass", data=np.array([[6.0]]))
        mass.attrs["MATLAB_class"] = np.bytes_("double")

    result = read_measurement(hdf5(fill), "a.mat")
    assert_same(result)
    np.testing.assert_array_equal(result.columns["direction"], np.repeat([-1.0, 1.0], 20))
    assert result.conditions["load_mass"] == 6.0


def test_v73_reads_nothing_outside_the_file(tmp_path) -> None:
    secret = tmp_path / "secret.bin"
    secret.write_bytes(np.arange(ROWS, dtype=float).tobytes())

    def fill(file: h5py.File) -> None:
        for name, values in COLUMNS.items():
            if name != "force_N":
                file.create_dataset(name, data=values[None, :])
        file.create_dataset("force_N", (ROWS,), "f8", external=[(str(secret), 0, 8 * ROWS)])

    assert "variable 'force_N' is not kept in the file" in refused(hdf5(fill), "a.mat").message

    def link(file: h5py.File) -> None:
        for name, values in COLUMNS.items():
            file.create_dataset(name, data=values[None, :])
        file["load_mass"] = h5py.ExternalLink(str(secret), "/x")
        file["kind"] = h5py.SoftLink("/nowhere")

    assert_same(read_measurement(hdf5(link), "a.mat"))


def channels(group: str, **more: object) -> list[ChannelObject]:
    made = []
    for header, values in COLUMNS.items():
        name, _, unit = header.partition("_")
        if name != "time":
            made.append(ChannelObject(group, name, values, {"unit_string": unit, **more}))
    return made


def test_groups_of_a_tdms_file_are_runs() -> None:
    data = tdms(*channels("first", wf_increment=0.1), *channels("second", wf_increment=0.1))
    result = read_measurement(data, "a.tdms")
    assert result.rows == 2 * ROWS
    np.testing.assert_array_equal(result.columns["group"], np.repeat([0, 1], ROWS))
    np.testing.assert_allclose(result.columns["time"], np.tile(SI["time"], 2), atol=1e-12)
    assert "2 tables with the same columns are read as runs: 'first', 'second'" in result.messages


def test_the_group_with_our_channels_is_read() -> None:
    other = ChannelObject("log", "status", np.arange(7))
    data = tdms(RootObject({"load_mass": 6.0, "Author": "me"}), GroupObject("run"), other, *channels("run"))
    result = read_measurement(data, "a.tdms")
    assert_same(result, but=("time",))
    assert result.conditions == {"load_mass": 6.0}
    assert "'log/status' is not read: it is in another table" in result.messages


def test_time_stamps_count_from_the_first() -> None:
    stamps = np.datetime64("2026-05-03T12:00:00") + np.arange(ROWS) * np.timedelta64(100, "ms")
    result = read_measurement(tdms(ChannelObject("run", "time", stamps), *channels("run")), "a.tdms")
    assert_same(result)
