"""Three hundred damaged or unusual files, made from good ones; the seed makes them the same every time."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from scipy.sparse import csc_matrix

from tests.robustness import files
from tests.robustness.files import COLUMNS, HEADERS, ROWS

SEED = 20261121
FIRST = 3  # row of the first reading in a CSV file and a sheet


_NO_READING = ("nan", "NaN", "inf", "-Infinity", "")  # the row is left out and counted


class Variant(NamedTuple):
    """A file and what must become of it.

    ``names``: what the refusal must name; None = it must be read and give the good values; empty = either, as
    long as the refusal names something and what is read is right. ``left_out``: rows that may be missing.
    """

    what: str
    name: str
    content: bytes
    names: tuple[str, ...] | None
    left_out: int = 0

    def __str__(self) -> str:
        return f"{self.what} ({self.name})"


def variants() -> list[Variant]:
    """All of them."""
    random = np.random.default_rng(SEED)
    return [*_cells(random), *_csv_structure(random), *_workbooks(random), *_matlab(random), *_tdms(random)]


def _spot(random: np.random.Generator) -> tuple[int, int]:
    return int(random.integers(1, ROWS)), int(random.integers(len(HEADERS)))


def _cells(random: np.random.Generator) -> Iterator[Variant]:
    """One bad cell of a CSV file."""
    bad = [
        "abc",
        "nan",
        "NaN",
        "inf",
        "-Infinity",
        "",
        "1e999",
        "1.000.000,5",
        "0x1F",
        "300 mm",
        "--5",
        "1_0",
        "٣",
    ]
    for cell in bad:
        for _ in range(4):
            row, column = _spot(random)
            rows = files.text_rows()
            rows[row][column] = cell
            # A thousands separator brings a comma: the row has a cell too many.
            names = (f"row {row + FIRST}", *(() if "," in cell else (HEADERS[column],)))
            if cell in _NO_READING:
                yield Variant(f"cell {cell!r}", "cell.csv", files.csv(rows), None, 1)
            else:
                yield Variant(f"cell {cell!r}", "cell.csv", files.csv(rows), names)
    for column, value, what in (
        (2, "-250", "negative length"), (2, "0", "length 0"),
        (1, "-1.5", "below vacuum"), (3, "1e308", "huge"),
    ):  # fmt: skip
        for _ in range(3):
            row, _ = _spot(random)
            rows = files.text_rows()
            rows[row][column] = value
            names = (f"row {row + FIRST}", HEADERS[column])
            if what == "huge":  # it stands for no reading: left out, and said
                yield Variant(what, "value.csv", files.csv(rows), None, 1)
            else:
                yield Variant(what, "value.csv", files.csv(rows), names)
    for _ in range(6):
        row, column = _spot(random)
        lines = files.csv().split(b"\n")
        cells = lines[row + FIRST - 1].split(b",")
        cells[column] = b"\xff\xfe" + cells[column]
        lines[row + FIRST - 1] = b",".join(cells)
        names = (f"row {row + FIRST}", HEADERS[column])
        yield Variant("no UTF-8", "latin.csv", b"\n".join(lines), names)


def _csv_structure(random: np.random.Generator) -> Iterator[Variant]:
    good, rows = files.csv(), files.text_rows()
    text = good.decode()
    for number in range(8):
        row, _ = _spot(random)
        short = [list(r) for r in rows]
        short[row] = short[row][: number % 3 + 1] if number % 2 else [*short[row], "7"]
        yield Variant("ragged", "ragged.csv", files.csv(short), (f"row {row + FIRST}",))
        mixed = good.split(b"\n")
        mixed[row + 2] = mixed[row + 2].replace(b",", b";", 1 + number % 3)
        yield Variant("mixed separators", "mixed.csv", b"\n".join(mixed), (f"row {row + FIRST}",))
        lines = good.split(b"\n")
        kept = b"\n".join(lines[: row + 2]) + b"\n" + b",".join(lines[row + 2].split(b",")[: 1 + number % 3])
        yield Variant("truncated", "cut.csv", kept, (f"row {row + FIRST}",))
        comma = files.csv(rows, separator=";").replace(b".", b",").split(b"\n")
        whole = [n for n in range(2 + row, ROWS + 2) if b"," in comma[n]]
        comma[whole[0]] = comma[whole[0]].replace(b",", b".")
        if any(b"," in line for line in comma[2 : whole[0]]):
            yield Variant("mixed decimals", "decimal.csv", b"\n".join(comma), (f"row {whole[0] + 1}",))
        at = int(random.integers(len(good) // 3, len(good)))
        row = good.count(b"\n", 0, at) + 1
        yield Variant("NUL byte", "nul.csv", good[:at] + b"\0" + good[at:], (f"row {row}",))
        lines = good.split(b"\n")
        lines[row - 1] = b'"' + lines[row - 1]
        yield Variant("open quote", "quote.csv", b"\n".join(lines), (f"row {row}",))
    for number in range(len(HEADERS)):
        twice = list(HEADERS)
        twice[number] = HEADERS[number - 1].upper()
        # A second time may be that of another signal: what is wrong is said in other words.
        names = () if number == 1 else (f"'{twice[number]}'",)
        yield Variant("duplicate", "twice.csv", files.csv(header=twice), names)
        wrong = list(HEADERS)
        wrong[number] = wrong[number].split("_")[0] + "_Hz"
        yield Variant("wrong unit", "unit.csv", files.csv(header=wrong), (wrong[number],))
        wrong = list(HEADERS)
        wrong[number] = wrong[number].split("_")[0] + " [parsnip]"
        yield Variant(
            "unknown unit", "unit.csv", files.csv(header=wrong), (wrong[number], "not a known unit")
        )
        swapped = [HEADERS[n] for n in np.roll(np.arange(4), number)]
        table = np.array(rows)[:, np.roll(np.arange(4), number)].tolist()
        yield Variant("other order", "order.csv", files.csv(table, header=swapped), None)
    headless = good.replace(b"time_s,pressure_bar,length_mm,force_N\n", b"")
    yield Variant("no header", "headless.csv", headless, ("'column 1'",))
    for content in (b"", b" \n\n\n", b"# kind: static\n", b"\xef\xbb\xbf", b",,,\n"):
        yield Variant("empty", "empty.csv", content, ())
    yield Variant("header only", "empty.csv", b"\n".join(good.split(b"\n")[:2]), ("row 2",))
    yield Variant("other columns", "other.csv", files.csv(header=["a", "b", "c", "e"]), ("'a'",))
    yield Variant("kind", "kind.csv", good.replace(b"static", b"statik"), ("kind 'statik'",))
    yield Variant("kind without its column", "kind.csv", good.replace(b"static", b"diameter"), ("diameter",))
    for line in ("load_mass: 12 mm", "load_mass: heavy", "supply_pressure: -3 bar", "load_force: nan N"):
        bad = f"# {line}\n".encode() + good
        yield Variant("condition", "condition.csv", bad, ("line 1", line.split(":")[0]))
    for name, content in {
        "bom": b"\xef\xbb\xbf" + good,
        "utf-16": text.encode("utf-16"),
        "utf-16-be": b"\xfe\xff" + text.encode("utf-16-be"),
        "crlf": good.replace(b"\n", b"\r\n"),
        "old mac": good.replace(b"\n", b"\r"),
        "semicolon": files.csv(separator=";"),
        "tab": files.csv(separator="\t"),
        "decimal comma": files.csv(separator=";").replace(b".", b","),
        "hint": b"sep=,\n" + good,
        "empty lines": good.replace(b"\n", b"\n\n"),
        "empty end": good + b",,,\n,,,\n",
        "quoted": good.replace(b"time_s", b'"time_s"'),
    }.items():
        yield Variant(name, "variant.csv", content, None)
    for name in ("good.xlsx", "good.mat", "good.tdms", "good.pdf", "good", "good.CSV.exe"):
        yield Variant("other extension", name, good, None)
    yield Variant("damaged utf-16", "cut16.csv", text.encode("utf-16")[:-1], ("row",))
    shuffled = [rows[n] for n in random.permutation(ROWS)]
    yield Variant("unsorted times", "times.csv", files.csv(shuffled), ())
    same = [["0.1", *row[1:]] for row in rows]
    yield Variant("one time only", "times.csv", files.csv(same), ())
    for first in (
        b"\x1f\x8b\x08\x00",
        b"%PDF-1.7\n",
        b"\xd0\xcf\x11\xe0\xa1\xb1",
        b"7z\xbc\xaf\x27\x1c",
        b"\x89PNG\r\n",
    ):
        yield Variant("another format", "other.csv", first + random.bytes(400), ())


def _archive(parts: dict[str, bytes]) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in parts.items():
            archive.writestr(name, content)
    return stream.getvalue()


def _parts(content: bytes) -> dict[str, bytes]:
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def _damaged(content: bytes, random: np.random.Generator, *, begin: int = 0, end: int | None = None) -> bytes:
    """A few bytes changed."""
    data = bytearray(content)
    for _ in range(int(random.integers(1, 6))):
        at = int(random.integers(begin, end or len(data)))
        data[at] = int(random.choice([0, 255, 127, (data[at] + 1) % 256]))
    return bytes(data)


def _workbooks(random: np.random.Generator) -> Iterator[Variant]:
    good = files.xlsx()
    for cell in ("abc", None, "#DIV/0!", "=1/0", True, "1,5 bar"):
        for _ in range(2):
            row, column = _spot(random)
            rows = files.number_rows()
            rows[row][column] = cell
            names = ("sheet 'run'", f"row {row + FIRST}", HEADERS[column])
            left_out = cell in (None, "#DIV/0!", "=1/0")
            yield Variant(
                f"cell {cell!r}", "cell.xlsx", files.xlsx(rows), None if left_out else names, int(left_out)
            )
    for _ in range(8):
        yield Variant("truncated", "cut.xlsx", good[: int(random.integers(4, len(good) - 30))], ())
        yield Variant("damaged", "damaged.xlsx", _damaged(good, random, begin=30), ())
    for number in range(len(HEADERS)):
        twice = list(HEADERS)
        twice[number] = HEADERS[number - 1]
        names = () if number == 1 else (f"'{twice[number]}",)
        yield Variant("duplicate", "twice.xlsx", files.xlsx(header=twice), names)
    parts = _parts(good)
    sheet = "xl/worksheets/sheet2.xml"
    bomb = {**parts, sheet: parts[sheet].replace(b"</sheetData>", b" " * 60_000_000 + b"</sheetData>")}
    yield Variant("compressed too far", "bomb.xlsx", _archive(bomb), ("sheet2.xml",))
    entity = b'<!DOCTYPE x [<!ENTITY a "aaaaaaaaaa">]>'
    head, _, rest = parts[sheet].partition(b"<worksheet")
    spy = {**parts, sheet: head + entity + b"<worksheet" + rest}
    yield Variant("entities", "entity.xlsx", _archive(spy), None)  # which the reader of XML does not expand
    missing = {name: content for name, content in parts.items() if name != sheet}
    yield Variant("without its sheet", "missing.xlsx", _archive(missing), ())
    broken = {**parts, sheet: parts[sheet][: len(parts[sheet]) // 2]}
    yield Variant("half a sheet", "half.xlsx", _archive(broken), ())
    yield Variant("zip of something else", "zip.xlsx", _archive({"readme.txt": b"hello"}), ("no table",))
    yield Variant("zip of a table", "table.zip", _archive({"good.csv": files.csv()}), None)
    yield Variant("no header", "headless.xlsx", files.xlsx(header=["1", "2", "3", "4"]), ("'column 1'",))
    yield Variant("wrong extension", "good.csv", good, None)


def _matlab(random: np.random.Generator) -> Iterator[Variant]:
    plain, packed, newest = files.mat(), files.mat(packed=True), files.mat73()
    for content, name in ((plain, "cut5.mat"), (packed, "cut7.mat"), (newest, "cut73.mat")):
        for _ in range(6):
            at = int(random.integers(130 if content is not newest else 700, len(content) - 20))
            yield Variant("truncated", name, content[:at], ())
    for _ in range(10):
        yield Variant("damaged", "damaged7.mat", _damaged(packed, random, begin=128), ())
        yield Variant("damaged", "damaged73.mat", _damaged(newest, random, begin=512, end=3000), ())
    for _ in range(4):  # the tags of the first variable: type, size, flags, dimensions
        yield Variant("damaged", "damaged5.mat", _damaged(plain, random, begin=128, end=168), ())
    for name in HEADERS:
        columns = {**COLUMNS, name: np.where(np.arange(ROWS) % 10 == 3, np.nan, COLUMNS[name])}
        yield Variant("nan", "nan.mat", files.mat(columns), (), left_out=4)
        if name != HEADERS[0]:  # without its time it is still a map: the message says so
            empty = files.mat73({**COLUMNS, name: np.full(ROWS, np.inf)})
            yield Variant("inf", "inf73.mat", empty, (name,))
            yield Variant("shorter", "short.mat", files.mat({**COLUMNS, name: COLUMNS[name][:-3]}), (name,))
        renamed = {(key.split("_")[0] + "_Hz" if key == name else key): v for key, v in COLUMNS.items()}
        yield Variant("wrong unit", "unit.mat", files.mat(renamed), (name.split("_")[0] + "_Hz",))
    yield Variant(
        "negative length",
        "value.mat",
        files.mat({**COLUMNS, "length_mm": -COLUMNS["length_mm"]}),
        ("length_mm",),
    )
    yield Variant("matrix", "matrix.mat", files.mat({"A": np.eye(5)}), ("A",))
    yield Variant("sparse", "sparse.mat", files.mat({"A": csc_matrix(np.eye(5))}), ("A",))
    yield Variant(
        "words",
        "words.mat",
        files.mat({**COLUMNS, "force_N": np.array(["x"] * ROWS, dtype=object)}),
        ("force_N",),
    )
    yield Variant("empty", "empty.mat", files.mat({}), ())
    yield Variant("header only", "header.mat", plain[:128], ())
    yield Variant("wrong extension", "good.xlsx", plain, None)


def _tdms(random: np.random.Generator) -> Iterator[Variant]:
    good = files.tdms()
    for _ in range(8):
        yield Variant("truncated", "cut.tdms", good[: int(random.integers(4, len(good) - 1))], ())
        yield Variant("damaged", "damaged.tdms", _damaged(good, random, begin=4, end=28), ())
    for name in HEADERS[1:]:
        columns = {**COLUMNS, name: np.where(np.arange(ROWS) % 10 == 3, np.nan, COLUMNS[name])}
        yield Variant("nan", "nan.tdms", files.tdms(columns), (), left_out=4)
        channel = name.split("_")[0]
        yield Variant("shorter", "short.tdms", files.tdms({**COLUMNS, name: COLUMNS[name][:-3]}), (channel,))
        renamed = {(f"{channel}_Hz" if key == name else key): v for key, v in COLUMNS.items()}
        yield Variant("wrong unit", "unit.tdms", files.tdms(renamed), (channel, "Hz"))
    yield Variant("index", "good.tdms_index", b"TDSh" + good[4:], ())
    yield Variant("wrong extension", "good.csv", good, None)
