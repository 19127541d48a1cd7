"""What an installation that has been used for nothing yet answers without compiling the integrators."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from mckibben.resources import installed_code_folder
from mckibben.simulation.integrate.lane_kernel import rodas4_lanes

#: Runs a command line; tells how many kernels were loaded, and how many had to be compiled.
CHILD = """
import gc, json, sys
from mckibben import cli
code = cli.run(sys.argv[1:])
from mckibben.simulation.integrate.stamp import Kernel
kernels = [each.dispatcher.stats for each in gc.get_objects() if isinstance(each, Kernel)]
loaded, compiled = (sum(sum(s.values()) for s in (getattr(k, name) for k in kernels)) for name in
                    ("cache_hits", "cache_misses"))
print(json.dumps({"code": code, "loaded": loaded, "compiled": compiled}), file=sys.stderr)
"""


@pytest.fixture(scope="module")
def _compiled_at_installation() -> None:
    """In an editable installation the sources may have changed since; code there must be."""
    assert list(installed_code_folder().glob("code/*/*")), "backend/compile_kernels.py has compiled nothing"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("mckibben.simulation.kept_code._folder", lambda: None)
        dispatcher = rodas4_lanes.dispatcher
        found = dispatcher._cache.load_overload(rodas4_lanes.signature, dispatcher.targetctx)
    if found is None:
        pytest.skip(f"installed before the kernels changed: {installed_code_folder()} has others")


@pytest.mark.usefixtures("_compiled_at_installation")
@pytest.mark.parametrize("question", ["map", "drive"])
def test_the_first_answer_compiles_no_integrator(tmp_path: Path, question: str) -> None:
    rows = [
        f"{bar},{length:.1f},{200.0 * bar * (1.0 - (300.0 - length) / 75.0):.2f}"
        for bar in (2.0, 3.0, 4.0, 5.0, 6.0)
        for length in np.linspace(295.0, 250.0, 10)
    ]
    file = tmp_path / "map.csv"
    file.write_text("\n".join(["# kind: static", "pressure_bar,length_mm,force_N", *rows]) + "\n")
    asked = {"map": ["compare", str(file), "--muscle", "DMSP-20:300mm"], "drive": ["simulate", "propneu-20"]}
    empty = {"MCKIBBEN_CACHE": str(tmp_path / "cache"), "MCKIBBEN_DATA": str(tmp_path / "data")}
    done = subprocess.run(
        [sys.executable, "-c", CHILD, *asked[question]],
        capture_output=True, text=True, env={**os.environ, **empty}, timeout=600,
    )  # fmt: skip
    said = json.loads(done.stderr.splitlines()[-1])
    assert said["code"] == 0, done.stderr
    assert said["loaded"] > 0
    assert said["compiled"] == 0
