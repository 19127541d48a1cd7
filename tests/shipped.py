"""What the package ships, read once for all tests of a process."""

from __future__ import annotations

from functools import cache

from mckibben.documents.studio import Studio
from mckibben.resources import presets_folder


@cache
def shipped_studio() -> Studio:
    """The studio of the built-in presets and effects; nothing can be saved in it, so tests share it."""
    return Studio(presets=presets_folder())
