"""The programs whose versions a report tells."""

from __future__ import annotations

import platform
from importlib.metadata import version

from mckibben import __version__


def versions() -> dict[str, str]:
    """Program -> version."""
    return {
        "mckibben": __version__,
        "Python": platform.python_version(),
        # Asked of their packages: importing scipy would delay the start of the server.
        **{name: version(name) for name in ("numpy", "scipy")},
    }
