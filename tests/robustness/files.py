"""One measurement in every format that is read, written by other libraries than ours."""

from __future__ import annotations

import io
from collections.abc import Mapping

import h5py
import numpy as np
import openpyxl
from nptdms import ChannelObject, RootObject, TdmsWriter
from scipy.io import savemat

ROWS = 40
_STEP = np.arange(ROWS)
#: Header -> values as written; exact in decimals, so that every format holds the same numbers.
COLUMNS = {
    "time_s": np.round(0.1 * _STEP, 1),
    "pressure_bar": np.round(0.5 + 0.125 * _STEP, 3),
    "length_mm": np.round(300.0 - 1.5 * _STEP, 1),
    "force_N": np.round(10.0 + 12.25 * _STEP, 2),
}
HEADERS = list(COLUMNS)
#: Channel -> values in SI that must be read from all of them.
SI = {
    "time": COLUMNS["time_s"],
    "pressure": COLUMNS["pressure_bar"] * 1e5,
    "length": COLUMNS["length_mm"] / 1e3,
    "force": COLUMNS["force_N"],
}
KIND = "static"

Columns = Mapping[str, np.ndarray]


def text_rows() -> list[list[str]]:
    """The cells of a CSV file, without its header."""
    return [[f"{column[row]:.10g}" for column in COLUMNS.values()] for row in range(ROWS)]


def csv(
    rows: list[list[str]] | None = None, *, separator: str = ",", header: list[str] | None = None
) -> bytes:
    """A CSV file: the kind in row 1, the header in row 2, the first reading in row 3."""
    lines = [separator.join(cells) for cells in (header or HEADERS, *(rows or text_rows()))]
    return "\n".join([f"# kind: {KIND}", *lines, ""]).encode()


def xlsx(rows: list[list[object]] | None = None, *, header: list[str] | None = None) -> bytes:
    """A workbook: an empty sheet, then the table with the kind in row 1 and the header in row 2."""
    book = openpyxl.Workbook()
    sheet = book.create_sheet("run")
    sheet.append(["# kind", KIND])
    sheet.append(header or HEADERS)
    for row in rows or number_rows():
        sheet.append(row)
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


def number_rows() -> list[list[object]]:
    """The cells of a workbook, without its header."""
    return [[float(column[row]) for column in COLUMNS.values()] for row in range(ROWS)]


def mat(columns: Columns = COLUMNS, *, packed: bool = False, within: str = "") -> bytes:
    """A MATLAB v5 file (v7 when packed), the vectors in a struct of this name if one is given."""
    stream = io.BytesIO()
    own = {within: dict(columns)} if within else dict(columns)
    savemat(stream, {**own, "kind": KIND}, do_compression=packed)
    return stream.getvalue()


def mat73(columns: Columns = COLUMNS) -> bytes:
    """A MATLAB v7.3 file, as MATLAB lays it out, its data with checksums."""
    stream = io.BytesIO()
    with h5py.File(stream, "w", userblock_size=512) as file:
        for name, values in columns.items():
            data = file.create_dataset(name, data=values[None, :], compression="gzip", fletcher32=True)
            data.attrs["MATLAB_class"] = np.bytes_("double")
        codes = np.frombuffer(KIND.encode("utf-16-le"), np.uint16)
        kind = file.create_dataset("kind", data=codes[:, None])
        kind.attrs["MATLAB_class"] = np.bytes_("char")
    mark = b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(124) + b"\x00\x02IM"
    return mark + stream.getvalue()[128:]


def tdms(columns: Columns = COLUMNS) -> bytes:
    """A TDMS file: units as properties, the time from the waveform."""
    stream = io.BytesIO()
    with TdmsWriter(stream) as writer:
        channels = []
        for header, values in columns.items():
            name, _, unit = header.partition("_")
            if name != "time":
                properties = {"unit_string": unit, "wf_increment": 0.1, "wf_start_offset": 0.0}
                channels.append(ChannelObject("run", name, values, properties))
        writer.write_segment([RootObject({"kind": KIND, "Operator": "A. N. Other"}), *channels])
    return stream.getvalue()


#: File name -> content; all hold the same measurement.
GOOD = {
    "good.csv": csv(),
    "good.xlsx": xlsx(),
    "good5.mat": mat(),
    "good7.mat": mat(packed=True),
    "struct.mat": mat(within="data"),
    "good73.mat": mat73(),
    "good.tdms": tdms(),
}
