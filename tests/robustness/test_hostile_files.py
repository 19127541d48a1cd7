"""Small files that become large are refused in words before they take memory; large honest ones are read."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from fastapi.testclient import TestClient

from mckibben.measurement.reading import read_measurement
from mckibben.measurement.reading.limits import MAX_ROWS, MAX_UNPACKED
from mckibben.server.app import create_app
from mckibben.server.settings import Settings
from tests.robustness import hostile as made
from tests.robustness.hostile import MATLAB, Hostile, doubles, hostile, one_of_each_format

LARGEST = 4 * MAX_UNPACKED
#: Keeps files one after the other: name -> (message, hint and field of the refusal; most memory so far).
CHILD = """
import json, resource, sys
from pathlib import Path
import h5py, nptdms, openpyxl, pandas, scipy.io
from mckibben.application.json_text import to_json
from mckibben.application.measurement.summary import summary_of
from mckibben.measurement.store import MeasurementStore
from mckibben.physics.errors import InputError

def peak():  # of this process, or of one that read for it; getrusage would begin with what its parent took
    lines = Path("/proc/self/status").read_text().splitlines()
    own = next(int(line.split()[1]) for line in lines if line.startswith("VmHWM"))
    return 1024 * max(own, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)

store, begin, found = MeasurementStore(Path(sys.argv[1])), peak(), {}
for path in map(Path, sys.argv[2:]):
    said = None
    try:
        to_json(summary_of(store.put(path.read_bytes(), path.name)))
    except InputError as error:
        said = error.message, error.hint, error.field
    found[path.name] = said, peak() - begin
print(json.dumps(found))
"""


class Read(NamedTuple):
    """What became of a file: message, hint and field of the refusal, None = read; memory so far [bytes]."""

    refusal: tuple[str, str | None, str | None] | None
    peak: int


def read_elsewhere(folder: Path, files: dict[str, bytes]) -> dict[str, Read]:
    """What a process of its own makes of files."""
    if not Path("/proc/self/status").exists():
        pytest.skip("the system does not tell the most memory a process took")
    for name, content in files.items():
        (folder / name).write_bytes(content)
    command = [sys.executable, "-c", CHILD, str(folder / "data"), *(str(folder / name) for name in files)]
    done = subprocess.run(command, capture_output=True, check=True, timeout=600, text=True)
    return {name: Read(*read) for name, read in json.loads(done.stdout).items()}


def problems(file: Hostile, read: Read) -> list[str]:
    """What is wrong with a refusal: it must say what the file is, what is allowed and what to do."""
    if read.refusal is None:
        return [f"{file.name} was read"] if file.words else []
    message, hint, field = read.refusal
    told = f"{message} ({hint})"
    found = [f"does not say {words!r}" for words in file.words if words not in told]
    if not message.startswith(file.name) or not field or not hint:
        found.append("names no place, or no way out")
    if len(message) > 400:
        found.append("is too long")
    return [f"{file.name}: {what}: {told[:600]}" for what in found]


@pytest.mark.examination("test_a_server_refuses_them_and_goes_on")
def test_they_are_refused_in_words_and_take_little_memory(tmp_path: Path) -> None:
    found = read_elsewhere(tmp_path, {file.name: file.content for file in hostile()})
    wrong = [problem for file in hostile() for problem in problems(file, found[file.name])]
    assert not wrong, "\n".join(wrong)
    assert found["bomb.mat"].peak < MAX_UNPACKED // 2, "what it unpacks to was known before"
    most = {name: f"{read.peak / 1e6:.0f} MB" for name, read in found.items()}
    assert found["short.mat"].peak > 10e6, "nothing is measured"
    assert max(read.peak for read in found.values()) < LARGEST, most


def large_files(share: float) -> dict[str, bytes]:
    """A packed MATLAB file and a CSV of so large a share of what is read at most."""
    rows = int(share * min(MAX_ROWS, MAX_UNPACKED // 8 // 5 - 100))
    number = np.arange(rows)
    columns = {
        b"time_s": 1e-3 * number, b"pressure_bar": 1.0 + number % 7, b"length_mm": 300.0 - number % 20,
        b"force_N": 10.0 + number % 90, b"temperature_degC": 20.0 + number % 3,
    }  # fmt: skip
    packed = MATLAB + b"".join(doubles(name, values) for name, values in columns.items())
    pairs = int(share * MAX_ROWS) // 2
    lines = b"# kind: static\npressure_bar;length_mm;force_N\n" + b"1;280;10\n2;281;20\n" * pairs
    return {"large.mat": packed, "large.csv": lines}


@pytest.mark.examination("test_a_server_refuses_them_and_goes_on")
def test_large_files_are_read_in_four_times_what_they_unpack_to_at_most(tmp_path: Path) -> None:
    """A quarter of the limit here; ``python -m tests.benchmarks.large_files`` goes up to it.

    Beside what the first reading of a small file takes: modules that it imports.
    """
    small = large_files(1e-4)
    for name, content in large_files(0.25).items():
        found = read_elsewhere(tmp_path, {f"small {name}": small[name], name: content})
        assert found[name].refusal is None, name
        assert 25e6 < found[name].peak - found[f"small {name}"].peak < LARGEST / 4, name


def test_a_server_refuses_them_and_goes_on(tmp_path: Path) -> None:
    settings = Settings(data=tmp_path / "data", user_presets=tmp_path / "presets")
    files = one_of_each_format()
    assert len(files) == 5
    with TestClient(create_app(settings), base_url="http://127.0.0.1:8000") as client:
        for file in (file for file in files if file.words):
            query = {"name": file.name}
            refusal = client.put("/api/measurements", params=query, content=file.content)
            assert refusal.status_code == 422
            look = client.post("/api/measurements/preview", params=query, content=file.content)
            body = look.json()
            assert look.status_code in (200, 422)
            for error in (refusal.json()["error"], body.get("problem") or body["error"]):
                assert file.words[0] in f"{error['message']} ({error['hint']})"
    assert not list(tmp_path.rglob("*.data"))


def test_texts_with_halves_of_characters_are_read() -> None:
    halves = made.matrix(b"note", made.CHAR, made.element(4, b"\x3d\xd8" * 5), (1, 5))
    columns = {b"pressure_bar": np.ones(9), b"length_mm": 280.0 + np.arange(9), b"force_N": np.arange(9.0)}
    packed = b"".join(doubles(name, values) for name, values in columns.items())
    measurement = read_measurement(MATLAB + packed + made.packed(halves), "a.mat")
    assert str(measurement.conditions["note"]).encode() == "\N{REPLACEMENT CHARACTER}".encode() * 5


def test_rows_beyond_the_size_that_a_sheet_says_are_read() -> None:
    parts = made.parts_of(made.files.xlsx())
    sheet = "xl/worksheets/sheet2.xml"
    wrong = parts[sheet].replace(b'<dimension ref="A1:D42"', b'<dimension ref="A1:D5"')
    assert wrong != parts[sheet]
    measurement = read_measurement(made.archive({**parts, sheet: wrong}), "a.xlsx")
    assert measurement.rows == made.files.ROWS


def test_what_a_workbook_holds_beside_its_cells_does_not_count() -> None:
    chart = b"<c>" + b"<v>1</v>" * 300_000 + b"</c>"
    more = {"xl/charts/chart1.xml": made.filled(chart), "xl/calcChain.xml": made.filled(chart)}
    content = made.archive({**made.parts_of(made.files.xlsx()), **more})
    assert read_measurement(content, "a.xlsx").rows == made.files.ROWS
