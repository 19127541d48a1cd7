"""The store of measurements: whole files or none, whatever happens meanwhile."""

from __future__ import annotations

import hashlib
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from mckibben.measurement import store as store_module
from mckibben.measurement.reading import read_correction
from mckibben.measurement.store import MeasurementStore
from mckibben.physics.errors import InputError
from tests.server.conftest import CSV

ID = hashlib.sha256(CSV).hexdigest()
MAPPING = read_correction('{"kind": "isobaric"}')

# Puts the same large file again and again; says when it begins.
_WRITER = """
import sys
from pathlib import Path
from mckibben.measurement.store import MeasurementStore
folder = Path(sys.argv[1])
rows = b"".join(b"%d,%d,%d\\n" % (n, 300, n) for n in range(1, 20000))
store = MeasurementStore(folder)
print("ready", flush=True)
for number in range(10_000):
    store.put(b"# note: %d\\npressure_Pa,length_mm,force_N\\n" % number + rows, "large.csv")
"""


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.rglob("*") if path.is_file() and path.name != ".lock")


@pytest.mark.parametrize("wait", [0.0, 0.1, 0.4])
def test_a_kill_leaves_no_partial_file(tmp_path: Path, wait: float) -> None:
    process = subprocess.Popen([sys.executable, "-c", _WRITER, str(tmp_path)], stdout=subprocess.PIPE)
    try:
        assert process.stdout is not None
        assert process.stdout.readline() == b"ready\n"
        deadline = time.monotonic() + 30.0
        while not list(tmp_path.rglob("*.data")) and time.monotonic() < deadline:
            time.sleep(0.001)
        time.sleep(wait)
    finally:
        process.send_signal(signal.SIGKILL)
        process.wait()
        process.stdout.close()
    data = list(tmp_path.rglob("*.data"))
    assert data
    for path in data:
        assert hashlib.sha256(path.read_bytes()).hexdigest() == path.stem
    leftover = [
        path
        for path in tmp_path.rglob("*")
        if path.is_file() and path.name != ".lock" and path.suffix not in (".data", ".json")
    ]
    # Between link and rename a whole file may carry its passing name for a moment; never a part of one.
    for path in leftover:
        assert path.suffix == ".tmp"
        assert path.stat().st_size in {len(each.read_bytes()) for each in data} | {21}
    assert MeasurementStore(tmp_path).get(data[0].stem).rows == 19_999


def test_the_same_file_at_once_is_kept_once(tmp_path: Path) -> None:
    stores = [MeasurementStore(tmp_path) for _ in range(8)]
    failures: list[BaseException] = []

    def put(store: MeasurementStore) -> None:
        try:
            assert store.put(CSV, "run.csv").id == ID
        except BaseException as error:
            failures.append(error)

    threads = [threading.Thread(target=put, args=(store,)) for store in stores]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures
    assert names(tmp_path) == [f"{ID}.data", f"{ID}.json"]


def test_what_a_killed_process_left_is_removed(tmp_path: Path) -> None:
    store = MeasurementStore(tmp_path)
    store.put(CSV, "run.csv")
    folder = tmp_path / "measurements"
    left = folder / ".left.tmp"
    left.write_bytes(b"half")
    store.put(CSV, "run.csv")
    assert not left.exists()


def test_a_damaged_file_is_not_given_out_and_is_mended(tmp_path: Path) -> None:
    MeasurementStore(tmp_path).put(CSV, "run.csv")
    path = tmp_path / "measurements" / f"{ID}.data"
    path.write_bytes(CSV[:-10])
    with pytest.raises(InputError, match="there is no measurement"):
        MeasurementStore(tmp_path).get(ID)
    MeasurementStore(tmp_path).put(CSV, "run.csv")
    assert path.read_bytes() == CSV
    assert MeasurementStore(tmp_path).get(ID).rows == 9


def test_a_mapped_measurement_lives_beside_the_plain_one(tmp_path: Path) -> None:
    store = MeasurementStore(tmp_path)
    plain, mapped = store.put(CSV, "run.csv"), store.put(CSV, "run.csv", MAPPING)
    assert (plain.id, plain.kind) == (ID, "static")
    assert (mapped.id, mapped.kind) == (MAPPING.identity(CSV), "isobaric")
    assert names(tmp_path) == sorted([f"{ID}.data", f"{ID}.json", f"{mapped.id}.json"])
    later = MeasurementStore(tmp_path)
    assert (later.get(mapped.id).kind, later.get(ID).kind) == ("isobaric", "static")


def test_content_that_needs_its_mapping_is_found_by_it_only(tmp_path: Path) -> None:
    content = b"alpha,length_mm,force_N\n1,300,5\n2,290,6\n"
    correction = read_correction('{"columns": {"alpha": {"channel": "pressure", "unit": "bar"}}}')
    kept = MeasurementStore(tmp_path).put(content, "run.csv", correction)
    later = MeasurementStore(tmp_path)
    assert later.get(kept.id).columns["pressure"].tolist() == [1e5, 2e5]
    with pytest.raises(InputError, match="there is no measurement"):
        later.get(hashlib.sha256(content).hexdigest())


def test_large_measurements_do_not_pile_up_in_memory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    store = MeasurementStore(tmp_path)
    files = [b"# note: %d\n" % number + CSV for number in range(4)]
    sizes = {sum(values.nbytes for values in store.put(file, "a.csv").columns.values()) for file in files}
    (size,) = sizes
    assert len(store._recent) == 4
    for most, kept in ((2 * size, 2), (size, 1), (1, 1)):  # the last one stays, whatever its size
        monkeypatch.setattr(store_module, "_MOST_IN_MEMORY", most)
        last = store.put(files[0], "a.csv")
        assert len(store._recent) == kept
        assert last.id in store._recent
    assert all(store.get(hashlib.sha256(file).hexdigest()).rows == 9 for file in files)
