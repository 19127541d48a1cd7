"""Presets and effects of the session: those of the program, and those in the user's own folders."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

import logging
import sys
import warnings
from collections.abc import Sequence
from contextlib import redirect_stdout
from os import PathLike
from pathlib import Path

from mckibben.documents.studio import Studio, unused_files
from mckibben.door.problem import reported
from mckibben.physics.errors import InputError
from mckibben.resources import presets_folder, user_folder
from mckibben.simulation.integrate.background import tell_who_waits


class _Session:
    """The chosen folders, and the studio made from them when it is first needed."""

    def __init__(self) -> None:
        self.presets: Path | None = None
        self.effects: tuple[Path, ...] = ()
        self.studio: Studio | None = None


_session = _Session()


def _say_that_it_compiles() -> None:
    logging.getLogger("mckibben").warning(
        "The integrators are being compiled, once on this machine; that takes about 20 s of a core."
    )


# A script or a notebook shows no progress and would seem to hang.
tell_who_waits(_say_that_it_compiles)


def studio() -> Studio:
    """Presets and effects of the session."""
    if _session.studio is None:
        _session.studio = _opened(_session.presets, _session.effects)
    return _session.studio


@reported
def use_presets(folder: str | PathLike[str] | None) -> None:
    """Read the user's own presets from this folder, as ``--presets`` does.

    It has a subfolder for each kind, e.g. ``muscles/my-muscle.json``. A file that is changed later is read
    again when it is next needed. A file that cannot be used gives a warning that says why.

    Args:
        folder: the folder; None for the one in the user's data folder, where the studio saves.

    Raises:
        Problem: it is not a folder.
    """
    path = None if folder is None else _existing(folder, "presets")
    _session.studio = _opened(path, _session.effects)
    _session.presets = path


@reported
def use_effects(*folders: str | PathLike[str]) -> None:
    """Load the user's own effects from these folders, as ``--effects`` does; instead of earlier ones.

    Each Python file of a folder is one effect and is executed; its name is the id. Calling it again reads
    changed files again; models that exist keep the effects they were made with. A file that cannot be used
    gives a warning that says why.

    Args:
        folders: the folders; none of them for the program's effects only.

    Raises:
        Problem: a folder does not exist.
    """
    paths = tuple(_existing(folder, "effects") for folder in folders)
    _session.studio = _opened(_session.presets, paths)
    _session.effects = paths


def _existing(folder: str | PathLike[str], what: str) -> Path:
    path = Path(folder).expanduser()
    if not path.is_dir():
        problem = "is not a folder" if path.exists() else "does not exist"
        raise InputError(f"{what} {path}: {problem}", hint="name an existing folder")
    return path


def _opened(presets: Path | None, effects: Sequence[Path]) -> Studio:
    chosen = user_folder() / "presets" if presets is None else presets
    with redirect_stdout(sys.stderr):  # what an effect file prints when it is loaded is no answer
        found = Studio(presets=presets_folder(), user_presets=chosen, effects=effects)
    for sentence in unused_files(found, chosen):
        warnings.warn(sentence, stacklevel=5)
    return found
