"""What ``import mckibben as mk`` offers: fixed, documented names, and an import that loads nothing."""

from __future__ import annotations

import inspect
import re
import subprocess
import sys
from pathlib import Path

import pytest

import mckibben as mk
from mckibben.door.comparison import Comparison
from mckibben.door.curves import Curves
from mckibben.door.diagnosis import Diagnosis
from mckibben.door.drive import Run
from mckibben.door.joint import JointStatics
from mckibben.door.linear import LinearView
from mckibben.door.sizing import Proposal, Sizing
from mckibben.door.study import Study

PACKAGE = Path(mk.__file__).parent
NAMES = {
    "Drive",
    "Joint",
    "Measurement",
    "Model",
    "Problem",
    "Project",
    "__version__",
    "effects",
    "load",
    "presets",
    "read",
    "size",
    "study",
    "use_effects",
    "use_presets",
}
CLASSES = (
    mk.Model,
    mk.Measurement,
    mk.Project,
    mk.Drive,
    mk.Joint,
    JointStatics,
    Curves,
    Comparison,
    Diagnosis,
    Run,
    LinearView,
    Sizing,
    Proposal,
    Study,
)


def test_the_names_are_these() -> None:
    assert set(mk.__all__) == set(dir(mk)) == NAMES
    for name in NAMES:
        assert getattr(mk, name) is not None
    with pytest.raises(AttributeError, match="no attribute 'modle'"):
        mk.modle  # type: ignore[attr-defined]  # noqa: B018


@pytest.mark.parametrize("name", sorted(NAMES - {"__version__"}))
def test_every_name_is_documented(name: str) -> None:
    text = inspect.getdoc(getattr(mk, name))
    assert text
    assert len(text.split()) > 8


@pytest.mark.parametrize("cls", CLASSES, ids=lambda cls: cls.__name__)
def test_every_member_is_documented_and_typed(cls: type) -> None:
    for name, member in inspect.getmembers(cls):
        if name.startswith("_") or not (callable(member) or isinstance(member, property)):
            continue
        assert inspect.getdoc(member), f"{cls.__name__}.{name}"
        function = member.fget if isinstance(member, property) else member
        assert "return" in inspect.unwrap(function).__annotations__, f"{cls.__name__}.{name}"


def test_presets_is_the_function_also_when_the_subpackage_is_imported() -> None:

    assert callable(mk.presets)
    assert "mckibben.presets.library" in sys.modules
    assert "DMSP-20" in mk.presets("muscles")


def test_the_import_loads_nothing_heavy() -> None:
    program = (
        "import sys, mckibben as mk; mk.__version__; "
        "print([name for name in ('numpy', 'pydantic', 'pandas', 'plotly') if name in sys.modules]); "
        "mk.Model; print([name for name in ('pandas', 'plotly', 'typer', 'fastapi') if name in sys.modules])"
    )
    environment = {"PYTHONPATH": str(PACKAGE.parent)}
    shown = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, env=environment)
    assert shown.stdout.split("\n")[:2] == ["[]", "[]"], shown.stdout + shown.stderr


def test_type_checkers_are_strict_on_the_door_and_see_its_types() -> None:
    assert (PACKAGE / "py.typed").exists()
    files = [file for file in (PACKAGE / "door").rglob("*.py") if file.name != "__init__.py"]
    lax = {
        file.relative_to(PACKAGE / "door").as_posix()
        for file in files
        if not re.search(r"^# pyright: strict", file.read_text("utf-8"), re.MULTILINE)
    }
    assert lax == {"figures.py", "frames.py", "shown.py"}
    assert len(files) > 10
