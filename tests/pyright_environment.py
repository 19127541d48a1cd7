"""What pyright needs to run offline, with the Node that Playwright brings: a wheel of its own has 200 MB."""

from __future__ import annotations

import os
from pathlib import Path

import playwright

_DRIVER = Path(playwright.__file__).with_name("driver")  # holds node, which pyright looks for on the path


def pyright_environment() -> dict[str, str]:
    """The environment of this process, and what pyright needs."""
    return {
        **os.environ,
        "PATH": os.pathsep.join((str(_DRIVER), os.environ.get("PATH", os.defpath))),
        "PYRIGHT_PYTHON_NODEJS_WHEEL": "0",
        "PYRIGHT_PYTHON_IGNORE_WARNINGS": "1",  # else it asks the network for a newer version of itself
    }
