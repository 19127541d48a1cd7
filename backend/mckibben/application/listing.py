"""What there is: presets, effects and examples, as cards."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

from mckibben.documents.studio import Studio
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.parameter import Parameter
from mckibben.resources import presets_folder


@dataclass(frozen=True, slots=True)
class PresetCard:
    """A preset.

    Attributes:
        kind: "muscles", "valves" and the like.
        id, title, maker, description: what it is.
        verified: whether every value was read in a source.
        own: whether it is the user's own.
        document: its file, every value with unit, source and grade.
    """

    kind: str
    id: str
    title: str
    maker: str
    description: str
    verified: bool
    own: bool
    document: Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class EffectCard:
    """A physical effect.

    Attributes:
        id, title: what it is.
        family: geometry, elastomer, friction, gas, valve, tube, supply, load or sensor.
        type: static, rate, hysteretic, dynamic or measurement.
        cause: why it exists.
        equation: LaTeX of what it adds or changes.
        parameters: name -> symbol, SI unit, default, bounds, source, description.
        kinds: kinds of measurements that reveal it.
        confused_with: effect -> the experiment that separates it.
    """

    id: str
    title: str
    family: str
    type: str
    cause: str
    equation: str
    parameters: Mapping[str, Parameter]
    kinds: frozenset[str]
    confused_with: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class ExampleCard:
    """An example that comes with the program.

    Attributes:
        name: of the file or folder.
        title: what it is.
        tried_by: the command that uses it, in the folder it was copied to.
        needs: other examples that this command uses.
    """

    name: str
    title: str
    tried_by: str
    needs: tuple[str, ...] = ()


def preset_cards(studio: Studio, kind: str) -> dict[str, PresetCard]:
    """The presets of a kind by their ids.

    Raises:
        InputError: there is no such kind, with the nearest match.
    """
    return {
        preset.id: PresetCard(
            kind=kind,
            id=preset.id,
            title=preset.heading,
            maker=preset.maker,
            description=preset.description,
            verified=preset.verified,
            own=preset.origin == "user",
            document=MappingProxyType(preset.to_document()),
        )
        for preset in studio.library.list(kind)
    }


def effect_cards(studio: Studio) -> dict[str, EffectCard]:
    """The effects by their ids."""
    return {effect.id: _effect_card(effect) for effect in studio.catalogue.values()}


def _effect_card(effect: Effect) -> EffectCard:
    return EffectCard(
        id=effect.id,
        title=effect.title,
        family=effect.family,
        type=effect.type,
        cause=effect.cause,
        equation=effect.equation,
        parameters=MappingProxyType({p.name: p for p in effect.parameters}),
        kinds=frozenset(effect.kinds),
        confused_with=MappingProxyType({twin.effect: twin.separated_by for twin in effect.confused_with}),
    )


def examples_folder() -> Path:
    """Where the examples are."""
    return presets_folder() / "examples"


def example_cards() -> dict[str, ExampleCard]:
    """The examples by their names, in the order in which they are read."""
    listed = json.loads((examples_folder() / "index.json").read_text("utf-8"))
    return {
        card["name"]: ExampleCard(card["name"], card["title"], card["try"], tuple(card.get("needs", ())))
        for card in listed
    }


def copy_examples(names: list[str], folder: Path) -> list[Path]:
    """Copy examples, and those that they need; a file that is the same already is left.

    Args:
        names: of the examples; none for all.
        folder: made if it does not exist.

    Returns:
        The copied files and folders.

    Raises:
        InputError: there is no such example, another file has its name, or it cannot be written.
    """
    known = example_cards()
    for name in names:
        if name not in known:
            raise InputError(f"{name}: there is no such example", hint=did_you_mean(name, known))
    wanted = dict.fromkeys(each for name in names or known for each in (name, *known[name].needs))
    files = {
        folder / file.relative_to(examples_folder()): file.read_bytes()
        for name in wanted
        for file in _files(examples_folder() / name)
    }
    for path, content in files.items():
        if path.exists() and not (path.is_file() and path.read_bytes() == content):
            raise InputError(
                f"{path}: exists and is not the example", hint="-o ANOTHER_FOLDER, or move it away"
            )
    try:
        for path, content in files.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
    except OSError as error:
        raise InputError(f"{folder}: cannot be written: {error.strerror or error}") from error
    return [folder / name for name in wanted]


def _files(place: Path) -> list[Path]:
    if place.is_file():
        return [place]
    return sorted(path for path in place.rglob("*") if path.is_file() and "__pycache__" not in path.parts)
