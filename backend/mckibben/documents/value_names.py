"""Values of a preset in words: those of an effect behind the title of the effect, since many have a force."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from mckibben.physics.effect import Effect

# As the page writes them.
_WORDS = {
    "area": "force per pressure",
    "displacement": "stroke",
    "mooney": "Mooney",
    "stribeck": "Stribeck",
}


def value_words(key: str) -> str:
    """The key of a value in words.

    >>> value_words("mooney_constant")
    'Mooney constant'
    """
    return " ".join(_WORDS.get(word, word) for word in key.split("_"))


def value_names(paths: Iterable[str], catalogue: Mapping[str, Effect]) -> tuple[str, ...]:
    """The values at ``paths`` of a preset, one text for each effect and for each other value, in their order.

    "effects.ID.force" and "effects.ID.break_strain" become "Title of the effect (force, break strain)",
    "limits.max_pressure" becomes "max pressure".
    """
    groups: dict[str, list[str]] = {}
    for path in dict.fromkeys(paths):
        section, _, name = path.rpartition(".")
        words = value_words(name)
        if section.startswith("effects."):
            groups.setdefault(_title(section.removeprefix("effects."), catalogue), []).append(words)
        else:
            groups.setdefault(words, [])
    return tuple(f"{name} ({', '.join(inside)})" if inside else name for name, inside in groups.items())


def _title(effect: str, catalogue: Mapping[str, Effect]) -> str:
    known = catalogue.get(effect)
    return effect.replace("_", " ") if known is None else known.title
