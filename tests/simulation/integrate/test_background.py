"""What is imported and compiled in the background."""

from __future__ import annotations

import threading
from contextlib import nullcontext

import pytest

from mckibben.simulation.integrate import background
from mckibben.simulation.integrate.background import Background, compiling, is_compiling


@pytest.mark.parametrize("kept", [True, False])
def test_only_what_is_compiled_is_said_to_be_compiled(monkeypatch: pytest.MonkeyPatch, kept: bool) -> None:
    """However long the loading takes; who waits for a compilation is told, once."""
    begun, go_on, told = threading.Event(), threading.Event(), []
    monkeypatch.setattr(background, "_tell", [lambda: told.append("compiling")])

    def load() -> str:
        with nullcontext() if kept else compiling("kernels"):
            begun.set()
            assert go_on.wait(10.0)
        return "kernels"

    kernels = Background(load, "kernels of a test")
    assert not is_compiling()
    kernels.warm()
    assert begun.wait(10.0)
    assert is_compiling() is not kept
    threading.Timer(0.5, go_on.set).start()
    assert [kernels.awaited(), kernels.awaited()] == ["kernels", "kernels"]
    assert told == ([] if kept else ["compiling"])
    assert not is_compiling()


def test_what_cannot_be_loaded_is_said_and_not_compiled_any_more(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(threading, "excepthook", lambda _: None)

    def load() -> str:
        with compiling("kernels"):
            raise OSError("no such library")

    with pytest.raises(RuntimeError, match="kernels of a test cannot be loaded"):
        Background(load, "kernels of a test").awaited()
    assert not is_compiling()
