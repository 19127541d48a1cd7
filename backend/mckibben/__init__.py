"""mckibben: a design studio for pneumatic-muscle drives, and a library.

``import mckibben as mk``: models (`Model`), measurements (`read`, `Measurement`), drives (`Drive`), joints
(`Joint`), sizing (`size`), studies (`study`), and what there is (`presets`, `effects`). Numbers are SI, texts
have a unit, pressures are gauge; bad input raises `Problem`. `__all__` and, for those who write effects,
`mckibben.effects` are all that is public; the other modules are how it works, and change.
"""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING

from mckibben.version import __version__

if TYPE_CHECKING:
    from mckibben.door.drive import Drive
    from mckibben.door.joint import Joint
    from mckibben.door.listing import effects, presets
    from mckibben.door.measurement import Measurement, read
    from mckibben.door.model import Model, load
    from mckibben.door.problem import Problem
    from mckibben.door.project import Project
    from mckibben.door.sizing import size
    from mckibben.door.study import study
    from mckibben.door.workspace import use_effects, use_presets

__all__ = [
    "Drive", "Joint", "Measurement", "Model", "Problem", "Project", "__version__", "effects", "load",
    "presets", "read", "size", "study", "use_effects", "use_presets",
]  # fmt: skip

_MODULES = {
    "Drive": "drive",
    "Joint": "joint",
    "Measurement": "measurement",
    "Model": "model",
    "Problem": "problem",
    "Project": "project",
    "effects": "listing",
    "load": "model",
    "presets": "listing",
    "read": "measurement",
    "size": "sizing",
    "study": "study",
    "use_effects": "workspace",
    "use_presets": "workspace",
}


def _public(name: str) -> object:
    """A public name, imported when it is first used: the command line and the server do without."""
    if name not in _MODULES:
        raise AttributeError(f"module 'mckibben' has no attribute '{name}'")
    return getattr(import_module(f"mckibben.door.{_MODULES[name]}"), name)


class _Package(ModuleType):
    """The package, whose ``presets`` and ``effects`` are functions, although modules have the same names."""

    @property
    def presets(self) -> object:
        return _public("presets")

    @presets.setter
    def presets(self, subpackage: ModuleType) -> None:
        """The import of the subpackage sets its name here, which is the function's."""

    @property
    def effects(self) -> object:
        return _public("effects")

    @effects.setter
    def effects(self, module: ModuleType) -> None:
        """As for ``presets``."""

    def __dir__(self) -> list[str]:
        return sorted(__all__)


sys.modules[__name__].__class__ = _Package
if not TYPE_CHECKING:  # else a misspelt name would be an object for type checkers
    __getattr__ = _public
