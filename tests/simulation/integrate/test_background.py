"""What is imported and compiled in the background."""

from __future__ import annotations

import threading

import pytest

from mckibben.simulation.integrate import background
from mckibben.simulation.integrate.background import Background, is_compiling


def test_what_takes_longer_than_loading_is_being_compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(background, "_LONG", 0.0)
    begun, go_on = threading.Event(), threading.Event()

    def load() -> str:
        begun.set()
        assert go_on.wait(10.0)
        return "kernels"

    kernels = Background(load, "kernels of a test")
    assert not is_compiling()
    kernels.warm()
    assert begun.wait(10.0)
    assert is_compiling()
    kernels.warm()
    go_on.set()
    assert kernels.awaited() == "kernels"
    assert not is_compiling()


def test_who_waits_for_a_compilation_is_told_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(background, "_LONG", 0.0)
    told, go_on = [], threading.Event()

    def tell() -> None:
        told.append("compiling")
        go_on.set()

    def load() -> str:
        assert go_on.wait(10.0)  # ends only after somebody was told
        return "kernels"

    monkeypatch.setattr(background, "_tell", [tell])
    kernels = Background(load, "kernels of a test")
    assert [kernels.awaited(), kernels.awaited()] == ["kernels", "kernels"]
    assert told == ["compiling"]


def test_what_cannot_be_loaded_is_said_and_not_compiled_any_more(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(background, "_LONG", 0.0)
    monkeypatch.setattr(threading, "excepthook", lambda _: None)

    def load() -> str:
        raise OSError("no such library")

    with pytest.raises(RuntimeError, match="kernels of a test cannot be loaded"):
        Background(load, "kernels of a test").awaited()
    assert not is_compiling()
