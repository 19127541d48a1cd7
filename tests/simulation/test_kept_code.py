"""Machine code that other processes have compiled before."""

from __future__ import annotations

import os
import select
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from mckibben.simulation import kept_code
from mckibben.simulation.kept_code import keep, kept, one_process_at_a_time


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """An empty folder for the code of this test."""
    monkeypatch.setenv("MCKIBBEN_CACHE", str(tmp_path))
    kept_code._folder.cache_clear()
    yield tmp_path
    kept_code._folder.cache_clear()


def files(place: Path) -> list[Path]:
    return [path for path in place.rglob("*") if path.is_file()]


def test_code_is_found_by_its_key(place: Path) -> None:
    assert kept(b"one") is None
    keep(b"one", b"code")
    keep(b"two", b"other code")
    assert (kept(b"one"), kept(b"two"), kept(b"three")) == (b"code", b"other code", None)
    assert len(files(place)) == 2


@pytest.mark.skipif(sys.platform == "win32", reason="files are not locked there")
def test_a_second_process_waits_until_the_first_has_compiled(place: Path) -> None:
    code = (
        "from mckibben.simulation.kept_code import one_process_at_a_time\n"
        "print('ready', flush=True)\n"
        "with one_process_at_a_time('kernels'):\n    print('mine', flush=True)\n"
    )
    with one_process_at_a_time("kernels"):
        other = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
        assert other.stdout is not None
        assert other.stdout.readline() == "ready\n"
        assert not select.select([other.stdout], [], [], 0.3)[0]  # it does not come any further
    with other:
        assert other.stdout.read() == "mine\n"
    assert other.returncode == 0


@pytest.mark.parametrize("spoilt", [b"", b"short", b"\0" * 40])
def test_a_file_that_is_not_as_it_was_written_is_none(place: Path, spoilt: bytes) -> None:
    keep(b"one", b"code")
    (file,) = files(place)
    file.write_bytes(spoilt)
    assert kept(b"one") is None
    keep(b"one", b"code")
    assert kept(b"one") == b"code"


@pytest.mark.skipif(sys.platform == "win32", reason="permissions of POSIX")
def test_only_the_user_may_write_there(place: Path) -> None:
    keep(b"one", b"code")
    (file,) = files(place)
    assert file.parent.stat().st_mode & 0o077 == 0


def test_without_a_place_nothing_is_kept_and_nothing_fails(
    place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("MCKIBBEN_CACHE", "off")
    keep(b"one", b"code")
    assert kept(b"one") is None
    (place / "a file").write_text("no folder can be made below it")
    monkeypatch.setenv("MCKIBBEN_CACHE", str(place / "a file"))
    kept_code._folder.cache_clear()
    keep(b"one", b"code")
    assert kept(b"one") is None


def test_old_code_goes(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    gone = place / "code" / "of-another-processor"
    gone.mkdir(parents=True)
    (gone / "file").write_bytes(b"x")
    long_ago = time.time() - 40 * 24 * 3600
    os.utime(gone, (long_ago, long_ago))
    keep(b"old", b"x" * 100)
    assert not gone.exists()
    (old,) = files(place)
    os.utime(old, (long_ago, long_ago))
    keep(b"new", b"y" * 100)
    monkeypatch.setattr(kept_code, "_LEFT", 0.6)
    monkeypatch.setattr(kept_code, "_MOST", 231)  # two files of 116 bytes are more
    kept_code._folder.cache_clear()
    assert (kept(b"old"), kept(b"new")) == (None, b"y" * 100)


@pytest.mark.skipif(sys.platform == "win32", reason="a link to nothing stands for a file that vanishes")
def test_a_file_that_vanishes_while_the_folder_is_tidied_costs_nothing(place: Path) -> None:
    keep(b"one", b"code")
    (file,) = files(place)
    (file.parent / "vanished").symlink_to(place / "nothing")
    kept_code._folder.cache_clear()
    assert kept(b"one") == b"code"


def test_code_of_the_installation_is_found(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    keep(b"one", b"code")
    monkeypatch.setattr(kept_code, "installed_code_folder", lambda: place)
    monkeypatch.setenv("MCKIBBEN_CACHE", "off")
    kept_code._folder.cache_clear()
    assert kept(b"one") == b"code"
    assert kept(b"two") is None
