"""Versions named in a report."""

from __future__ import annotations

import platform
from importlib.metadata import version

from mckibben.version import __version__


def versions() -> dict[str, str]:
    """Program -> version."""
    return {
        "mckibben": __version__,
        "Python": platform.python_version(),
        # Read from the package metadata: importing scipy would delay the start of the server.
        **{name: version(name) for name in ("numpy", "scipy")},
    }
