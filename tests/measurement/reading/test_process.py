"""What readers do not foresee ends at a limit of time or memory, is said in a line, and nothing else ends."""

from __future__ import annotations

import os
import re
import sys
import time
from collections.abc import Callable
from pathlib import Path
from types import MappingProxyType

import numpy as np
import pytest
from fastapi.testclient import TestClient

import mckibben as mk
from mckibben.measurement import reading
from mckibben.measurement.reading import preview, process, read_measurement
from mckibben.measurement.reading.process import bounded
from mckibben.physics.errors import InputError
from mckibben.server.app import create_app
from mckibben.server.settings import Settings
from tests.cli.conftest import run  # noqa: F401 - the fixture

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="files are read in place elsewhere")

GOOD = b"# kind: static\npressure_bar,length_mm,force_N\n1,300,10\n1,290,5\n2,300,60\n2,290,40\n"


def hang(*_: object) -> object:
    """As a pattern of `re` that goes back without end does, in native code."""
    return re.match(r"(a|a)*$", "a" * 200 + "b")


def swell(*_: object) -> object:
    """Memory without end, each piece of it written to."""
    return [bytearray(50_000_000) for _ in range(10**6)]


def crash(*_: object) -> object:
    """As a fault of a library does."""
    os.kill(os.getpid(), 11)


@pytest.fixture
def planted(monkeypatch: pytest.MonkeyPatch) -> Callable[[Callable[..., object]], None]:
    """A reader that does something else than to read, with limits that are soon reached."""
    monkeypatch.setattr(process, "seconds_for", lambda size: 1)
    monkeypatch.setattr(process, "MOST_MEMORY", 200_000_000)

    def plant(instead: Callable[..., object]) -> None:
        reading.read_measurement(GOOD, "good.csv")  # what is loaded once is loaded with the right reader
        monkeypatch.setattr(reading, "read_here", instead)
        monkeypatch.setattr(reading, "preview_here", instead)

    return plant


LIMITS = [(hang, "takes more than 1 s of processor time"), (swell, "takes more than 200 MB of memory")]


@pytest.mark.parametrize(("instead", "words"), [*LIMITS, (crash, "ended unexpectedly (signal 11)")])
def test_a_file_beyond_a_limit_is_refused(planted, instead: Callable[..., object], words: str) -> None:
    before = children()
    planted(instead)
    for door in (read_measurement, preview):
        with pytest.raises(InputError) as refused:
            door(GOOD, "a.csv")
        assert refused.value.message.startswith("a.csv: no column can be read: ")
        assert words in refused.value.message
        assert (refused.value.field, "CSV" in (refused.value.hint or "")) == ("file", True)
    assert children() <= before


def test_every_door_says_so(planted, run, tmp_path: Path) -> None:  # noqa: F811
    instead, words = LIMITS[1]
    file = tmp_path / "a.csv"
    file.write_bytes(GOOD)
    (tmp_path / "bad.csv").write_bytes(b"no table")
    usual, _, _ = run("convert", str(tmp_path / "bad.csv"), "-o", "out.csv")
    planted(instead)
    for command in (
        ["convert", str(file), "-o", "out.csv"],
        ["compare", str(file), "--muscle", "DMSP-20:300mm"],
    ):
        code, out, error = run(*command)
        assert (code, out) == (usual, "")
        assert words in " ".join(error.split())
        assert "Traceback" not in error
    with pytest.raises(mk.Problem, match=words):
        mk.read(file)
    settings = Settings(data=tmp_path / "data", user_presets=tmp_path / "presets")
    with TestClient(create_app(settings), base_url="http://127.0.0.1:8000") as client:
        answer = client.put("/api/measurements", params={"name": "a.csv"}, content=GOOD)
    assert answer.status_code == 422
    assert words in answer.json()["error"]["message"]


def test_the_result_is_that_of_reading_in_place() -> None:
    there = read_measurement(GOOD, "a.csv")
    here = reading.read_here(GOOD, "a.csv", reading.Correction())
    assert there.columns.keys() == here.columns.keys()
    for name, values in here.columns.items():
        np.testing.assert_array_equal(there.columns[name], values)
        assert there.columns[name].flags.writeable == values.flags.writeable
    assert (there.id, there.kind, there.messages, there.channels) == (
        here.id,
        here.kind,
        here.messages,
        here.channels,
    )
    assert there.conditions == here.conditions


def test_what_was_raised_is_raised_here() -> None:
    def refuse() -> None:
        raise InputError("row 3: no number", field="row 3", hint="1.5", code="conflict")

    with pytest.raises(InputError) as refused:
        bounded(refuse, "a.csv", lambda: None, size=100)
    error = refused.value
    assert (error.message, error.field, error.hint, error.code) == (
        "row 3: no number",
        "row 3",
        "1.5",
        "conflict",
    )

    def fail() -> None:
        error = ValueError("of a library")
        error.held = lambda: None  # type: ignore - what cannot be sent
        raise error

    with pytest.raises(RuntimeError, match="ValueError: of a library"):
        bounded(fail, "a.csv", lambda: None, size=100)


def test_views_and_large_arrays_come_back() -> None:
    numbers = np.arange(3_000_000.0)
    numbers.flags.writeable = False
    found = bounded(
        lambda: MappingProxyType({"a": numbers, "b": numbers[::2]}), "a.csv", lambda: None, size=100
    )
    assert isinstance(found, MappingProxyType)
    np.testing.assert_array_equal(found["a"], numbers)
    np.testing.assert_array_equal(found["b"], numbers[::2])
    assert not found["a"].flags.writeable


def test_a_reader_that_waits_for_ever_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    before = children()
    monkeypatch.setattr(process, "seconds_for", lambda size: 1)
    monkeypatch.setattr(process, "PATIENCE", 1)
    with pytest.raises(InputError, match="processor time"):
        bounded(lambda: time.sleep(3600), "a.csv", lambda: None, size=100)
    assert children() <= before


def test_an_interruption_leaves_no_reader_behind(monkeypatch: pytest.MonkeyPatch) -> None:
    before = children()

    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(process, "_heard", interrupted)
    with pytest.raises(KeyboardInterrupt):
        bounded(lambda: time.sleep(3600), "a.csv", lambda: None, size=100)
    assert children() <= before


def test_a_device_without_end_is_too_large(run) -> None:  # noqa: F811
    code, _, error = run("convert", "/dev/zero", "-o", "out.csv")
    assert code != 0
    assert "larger than 200 MB" in error


def children() -> set[str]:
    """Processes that this one has started and that are still there; a browser of other tests may be one."""
    return set(Path(f"/proc/self/task/{os.getpid()}/children").read_text().split())
