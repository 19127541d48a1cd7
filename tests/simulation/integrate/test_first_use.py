"""What an installation that has compiled nothing yet answers without compiling the integrators."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from math import radians
from pathlib import Path

import numpy as np
import pytest

from mckibben.physics.muscle import Muscle
from mckibben.simulation.drive.records import states_of_records
from mckibben.simulation.integrate import engine
from mckibben.simulation.statics.model import StaticModel

#: Runs a command line; tells which compiled functions of the program there are by then, and how many segments
#: of records were followed without them.
CHILD = """
import gc, json, sys
from mckibben import cli
from mckibben.simulation.integrate import engine
code = cli.run(sys.argv[1:])
from numba.core.dispatcher import Dispatcher
every = [each for each in gc.get_objects() if isinstance(each, Dispatcher)]
own = [each for each in every if each.py_func.__module__.startswith("mckibben.")]
compiled = sorted(each.py_func.__qualname__ for each in own if each.signatures)
followed = engine._BEFORE_COMPILING - engine._spared._left
said = {"code": code, "compiled": compiled, "followed": followed, "known": len(own)}
print(json.dumps(said), file=sys.stderr)
"""


def test_a_comparison_of_a_static_map_compiles_no_integrator(tmp_path: Path) -> None:
    """The preset has friction with memory, so its states are followed along the rows."""
    rows = [
        f"{bar},{length:.1f},{200.0 * bar * (1.0 - (300.0 - length) / 75.0):.2f}"
        for bar in (2.0, 3.0, 4.0, 5.0, 6.0)
        for length in np.linspace(295.0, 250.0, 10)
    ]
    file = tmp_path / "map.csv"
    file.write_text("\n".join(["# kind: static", "pressure_bar,length_mm,force_N", *rows]) + "\n")
    empty = {"NUMBA_CACHE_DIR": str(tmp_path / "numba"), "MCKIBBEN_CACHE": str(tmp_path / "cache")}
    command = [sys.executable, "-c", CHILD, "compare", str(file), "--muscle", "DMSP-20:300mm"]
    environment = {**os.environ, **empty, "MCKIBBEN_DATA": str(tmp_path / "data")}
    done = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=600)
    said = json.loads(done.stderr.splitlines()[-1])
    assert said["code"] == 0, done.stderr
    assert "RMS error" in done.stdout
    assert said["known"], "the kernels were not even looked at: the test has lost its subject"
    assert said["followed"] >= len(rows) - 1
    assert said["compiled"] == []


def test_short_work_is_done_without_the_kernel_until_it_is_worth_compiling(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(engine, "_spared", engine._Spared(500))
    monkeypatch.setattr(engine.kernel, "at_hand", lambda: False)
    chosen = [engine.engine_for_records(100, runs=runs) for runs in (1, 3, 2, 1)]
    assert chosen == ["lsoda", "lsoda", "rodas", "rodas"]
    assert engine.engine_for_records(10, runs=1, among=11) == "lsoda", "a few need no kernel at all"
    monkeypatch.setattr(engine, "_spared", engine._Spared(500))
    monkeypatch.setattr(engine.kernel, "at_hand", lambda: True)
    assert engine.engine_for_records(100, runs=1) == "rodas"


def test_the_states_are_those_of_the_kernel(monkeypatch: pytest.MonkeyPatch) -> None:
    muscle = Muscle(0.3, 0.0218, radians(26.5), 0.0018, 0.02)
    models = [StaticModel(muscle, {"dahl": {"force": force}}) for force in (10.0, 20.0)]
    rows = np.arange(60.0)
    record = {"time": rows, "pressure": np.full(60, 3e5), "length": 0.29 - 0.02 * np.sin(0.3 * rows)}
    found = {}
    for at_hand in (True, False):
        monkeypatch.setattr(engine.kernel, "at_hand", lambda at_hand=at_hand: at_hand)
        monkeypatch.setattr(engine, "_spared", engine._Spared(1000))
        found[at_hand] = states_of_records(models, ["dahl.presliding"], begins=[{}, {}], **record)
        assert (engine._spared._left < 1000) is not at_hand
    for one, other in zip(found[True], found[False], strict=True):
        assert np.ptp(one["dahl.presliding"]) > 0.1
        np.testing.assert_allclose(one["dahl.presliding"], other["dahl.presliding"], atol=2e-5)
