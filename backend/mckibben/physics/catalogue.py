"""All known effects: every Python file of the effects folder, and of additional folders of the user."""

from __future__ import annotations

import importlib.util
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError, did_you_mean

BUILT_IN_FOLDER = Path(__file__).parent / "effects"


@dataclass(frozen=True, slots=True)
class EffectProblem:
    """A file that could not be loaded as an effect, and why."""

    file: str
    message: str


class EffectCatalogue(Mapping[str, Effect]):
    """Effects by id, sorted; the id is the file name without ``.py``.

    A broken file of the effects folder raises. A broken file of an additional folder is reported in
    ``problems``, and the others still load. Two files with the same id are refused.

    Args:
        folders: additional folders whose Python files are loaded, and thus executed, as effects.
    """

    def __init__(self, folders: Sequence[Path] = ()) -> None:
        self.problems: list[EffectProblem] = []
        by_id = {path.stem: _load(path) for path in _files(BUILT_IN_FOLDER)}
        for folder in folders:
            if not folder.is_dir():
                raise InputError(f"effects folder {folder} does not exist", field="effects")
            for path in _files(folder):
                try:
                    if path.stem in by_id:
                        raise ValueError(f"an effect '{path.stem}' exists already; rename the file")
                    by_id[path.stem] = _load(path)
                except Exception as error:  # a user's file may fail in any way
                    self.problems.append(EffectProblem(path.name, f"{type(error).__name__}: {error}"))
        self._effects = dict(sorted(by_id.items()))

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


def _load(path: Path) -> Effect:
    name = f"mckibben.physics.effects.{path.stem}"
    spec = importlib.util.spec_from_file_location(name, path)
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
