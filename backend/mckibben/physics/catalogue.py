"""All known effects: every Python file of the effects folder, and of additional folders of the user."""

from __future__ import annotations

import importlib.machinery
import importlib.util
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache
from importlib.metadata import EntryPoint, EntryPoints, entry_points
from pathlib import Path
from types import CodeType

from mckibben.facts.result import result_class
from mckibben.physics.custom import CUSTOM
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError, did_you_mean, error_text
from mckibben.physics.worked_examples import wrong_examples

BUILT_IN_FOLDER = Path(__file__).parent / "effects"
_LONGEST_NAME = 64  # characters, as in a request


@result_class
class EffectProblem:
    """A file that could not be loaded as an effect, and why."""

    file: str
    """Name of the file."""
    message: str
    """Why it was not loaded."""


class EffectCatalogue(Mapping[str, Effect]):
    """Effects by id, sorted; the id is the file name without ``.py``.

    A broken file of the effects folder raises. A broken file of an additional folder is reported in
    ``problems``, and the others still load. Two files with the same id are refused. Only a real interrupt
    (Ctrl+C) ends the loading.

    Args:
        folders: additional folders whose Python files are loaded, and thus executed, as effects.
        installed: effects of installed packages, as `installed_effects` finds them.
    """

    def __init__(self, folders: Sequence[Path] = (), installed: Iterable[EntryPoint] = ()) -> None:
        self.problems: list[EffectProblem] = []
        self._effects = {path.stem: _load(path) for path in _files(BUILT_IN_FOLDER)}
        for point in installed:
            self._add(point.name, f"{point.name} of a package", lambda point=point: _of_package(point))
        for folder in folders:
            if not folder.is_dir():
                raise InputError(f"effects folder {folder} does not exist", field="effects")
            for path in _files(folder):
                self._add(path.stem, path.name, lambda path=path: _of_file(path), path)
        self._effects = dict(sorted(self._effects.items()))

    def _add(self, name: str, source: str, load: Callable[[], Effect], path: Path | None = None) -> None:
        """Add an effect that is not of the program; what is wrong with it is a problem and stops nothing."""
        try:
            _check_name(name, self._effects)
            effect = load()
            if wrong := wrong_examples(effect=effect):
                raise ValueError("; ".join(wrong))
            self._effects[name] = effect
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # a user's code may fail in any way, also by ending the program
            self.problems.append(EffectProblem(source, _problem_text(error, path)))

    def __getitem__(self, effect_id: str) -> Effect:
        try:
            return self._effects[effect_id]
        except KeyError:
            raise InputError(
                f"there is no effect '{effect_id}'",
                field="effects",
                hint=did_you_mean(effect_id, self._effects),
                code="unknown_effect",
            ) from None

    def __contains__(self, effect_id: object) -> bool:
        return effect_id in self._effects

    def __iter__(self) -> Iterator[str]:
        return iter(self._effects)

    def __len__(self) -> int:
        return len(self._effects)


@cache
def default_catalogue() -> EffectCatalogue:
    """The built-in effects, loaded once."""
    return EffectCatalogue()


def _files(folder: Path) -> list[Path]:
    return sorted(path for path in folder.glob("*.py") if not path.stem.startswith("_"))


def installed_effects() -> EntryPoints:
    """The effects that installed packages offer as entry points of the group ``mckibben.effects``.

    The name is the id; it points to an `Effect`, or to a module with ``EFFECT``. Nothing is imported here.
    """
    return entry_points(group="mckibben.effects")


def effect_of_file(path: Path) -> Effect:
    """The effect in one file, with the file's name as its id; its examples are not evaluated.

    Raises:
        InputError: it cannot be loaded; says where and why.
    """
    try:
        _check_name(path.stem, ())
        return _of_file(path)
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # as in a folder of effects
        raise InputError(f"{path}: {_problem_text(error, path)}", field="effect") from error


def _of_file(path: Path) -> Effect:
    if not path.is_file():  # reading a pipe would never end
        raise ValueError("it is not a plain file")
    return _load(path)


def _of_package(point: EntryPoint) -> Effect:
    found = point.load()
    effect = getattr(found, "EFFECT", found)
    if not isinstance(effect, Effect):
        raise ValueError(f"{point.value} is neither an Effect nor a module with EFFECT = Effect(...)")
    return effect.named(point.name)


def _check_name(name: str, known: Iterable[str]) -> None:
    """Refuse a name that cannot be the id of an effect."""
    if name in known:
        raise ValueError(f"an effect '{name}' exists already; rename the file")
    if name == CUSTOM:
        raise ValueError(f"'{name}' is the id of the typed term; rename the file")
    if not (name.isascii() and name.isidentifier() and len(name) <= _LONGEST_NAME):
        raise ValueError(
            f"'{name[:_LONGEST_NAME]}' cannot be the id of an effect; name the file with at most "
            f"{_LONGEST_NAME} letters, digits and underscores, e.g. seal_drag.py"
        )


def _problem_text(error: BaseException, path: Path | None) -> str:
    """The problem of a file in one line: line number, type and message of the error."""
    line, file = 0, "" if path is None else str(path.absolute())
    for raised in (error, error.__cause__):
        step = None if raised is None else raised.__traceback__
        while step is not None:
            line = step.tb_lineno if step.tb_frame.f_code.co_filename == file else line
            step = step.tb_next
    text = error_text(error)
    if not isinstance(error, Exception):
        text = f"{text} when it is loaded; an effect file only defines functions and EFFECT"
    return f"line {line}: {text}" if line else text


class _Source(importlib.machinery.SourceFileLoader):
    """Loads what the file says now: kept bytecode is told from an old one by size and second alone."""

    def get_code(self, fullname: str) -> CodeType:
        """The code of the source, compiled anew."""
        return self.source_to_code(self.get_data(self.path), self.path)


def _load(path: Path) -> Effect:
    name = f"mckibben.physics.effects.{path.stem}"
    file = str(path.absolute())
    spec = importlib.util.spec_from_file_location(name, file, loader=_Source(name, file))
    if spec is None or spec.loader is None:
        raise ImportError(f"{path} cannot be imported")
    module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
        effect = getattr(module, "EFFECT", None)
        if not isinstance(effect, Effect):
            raise ValueError("no module-level EFFECT = Effect(...)")
    except ValueError as error:
        raise ValueError(f"effect file {path.name}: {error}") from error
    return effect.named(path.stem)
