"""Which Chromium the browser tests take."""

from __future__ import annotations

import tempfile
import time
from pathlib import Path

import pytest

from tests.frontend import browser


@pytest.fixture
def bare(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A machine without any browser: an empty PATH folder, nothing named, nothing downloaded."""
    for variable in (browser.OWN_VARIABLE, *browser.OTHER_VARIABLES):
        monkeypatch.delenv(variable, raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv("PLAYWRIGHT_BROWSERS_PATH", str(tmp_path / "nothing-downloaded"))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))  # where the lock is
    return tmp_path


def program(path: Path, exit_code: int = 0) -> str:
    """An executable that ends with this exit code."""
    path.write_text(f"#!/bin/sh\necho it speaks\nexit {exit_code}\n")
    path.chmod(0o755)
    return str(path)


def test_none_on_a_bare_machine(bare: Path) -> None:
    assert browser.find() is None


def test_own_variable_comes_first(bare: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(browser.OWN_VARIABLE, program(bare / "mine"))
    monkeypatch.setenv("CHROME_PATH", program(bare / "other"))
    program(bare / "chromium")
    assert browser.find() == browser.Browser(str(bare / "mine"), f"{bare / 'mine'} ({browser.OWN_VARIABLE})")


def test_what_does_not_start_is_passed_over(bare: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CHROME_PATH", str(bare / "missing"))
    program(bare / "chromium", exit_code=1)
    program(bare / "google-chrome")
    assert browser.find() == browser.Browser(str(bare / "google-chrome"), str(bare / "google-chrome"))


def test_own_variable_is_never_passed_over(bare: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(browser.OWN_VARIABLE, program(bare / "broken", exit_code=1))
    program(bare / "chromium")
    with pytest.raises(browser.NoBrowserError, match=r"broken is not a browser that starts \(it speaks\)"):
        browser.find()


def test_without_any_way_the_message_says_what_to_install(
    bare: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    refuses = ("asking nicely", [program(bare / "installer", exit_code=1)], 120, {})
    monkeypatch.setattr(browser, "_driver_failure", lambda: None)  # tested by every test that opens a page
    monkeypatch.setattr(browser, "ways", lambda: [refuses])
    said: list[str] = []
    with pytest.raises(browser.NoBrowserError, match=r"apt-get install chromium.*asking nicely: it speaks"):
        browser.find_or_get(said.append)
    assert said == [
        "No Chromium for the browser tests: trying asking nicely (at most 2 minutes) ...",
        "... failed: asking nicely: it speaks",
    ]


def test_a_command_that_hangs_is_ended_with_its_children() -> None:
    start = time.perf_counter()
    assert browser.run(["sh", "-c", "sleep 60 & wait"], limit=0.2) == "no result within 0.2 s"
    assert time.perf_counter() - start < 10
