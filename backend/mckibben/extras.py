"""Libraries that an extra brings: imported when they are first used, and named where they are missing."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from mckibben.physics.errors import InputError

#: Library -> the extra that brings it, what it is for.
EXTRAS = {
    "SALib": ("optimise", "sensitivity indices"),
    "control": ("control", "a plant for python-control"),
    "pandas": ("notebook", "a data frame"),
    "pymoo": ("optimise", "an optimisation"),
}


def of_extra(module: str) -> Any:
    """A module of a library of `EXTRAS`.

    Raises:
        InputError: it is not installed; says which extra brings it.
    """
    library = module.partition(".")[0]
    extra, purpose = EXTRAS[library]
    try:
        return import_module(module)
    except ImportError as error:
        raise InputError(
            f"{purpose} needs {library}, which is not installed", hint=f"pip install 'mckibben[{extra}]'"
        ) from error
