"""Hook of the build: the kernels are compiled with the installation, so no first run waits for them.

It takes about 20 s. The code serves the processor that it was compiled on; on another one, or where this
fails, the program compiles it when it is first needed.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface  # type: ignore - only while it is built

_BACKEND = Path(__file__).resolve().parent
_COMPILED = _BACKEND / "mckibben" / "_data" / "compiled"  # `mckibben.resources.installed_code_folder`
# The environment of the build may reach its packages by PYTHONPATH: that stays as it is.
_CALL = """
import sys
sys.path.insert(0, sys.argv[1])
from mckibben.identification.residual import whitening
from mckibben.simulation.integrate.lane_buffers import compile_kernels
compile_kernels()
for kernel in (whitening.whiten, whitening.misfit):
    kernel.compiled()
"""


class CompileKernels(BuildHookInterface):
    """Compiles them into the package."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Called before the wheel is built, for an editable installation too."""
        shutil.rmtree(_COMPILED, ignore_errors=True)
        environment = {**os.environ, "MCKIBBEN_CACHE": str(_COMPILED)}
        command = [sys.executable, "-c", _CALL, str(_BACKEND)]
        done = subprocess.run(command, env=environment, capture_output=True, text=True)
        if done.returncode:
            self.app.display_warning(f"the kernels are compiled at their first use: {done.stderr}")
        if version == "standard" and _COMPILED.is_dir():  # an editable installation has it in its place
            build_data["force_include"][str(_COMPILED)] = "mckibben/_data/compiled"
