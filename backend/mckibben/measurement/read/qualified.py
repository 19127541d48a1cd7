"""Columns side by side that differ only in a word behind their name: the way of the muscle, or the run."""

from __future__ import annotations

from collections.abc import Sequence

from mckibben.measurement.read.head_text import without_run
from mckibben.measurement.read.recognise import recognise
from mckibben.measurement.read.unit_words import unit_of
from mckibben.measurement.read.vocabulary import WAYS, folded

_OF_UNIT = "values"  # of which a head says the unit alone


def without_way(name: str) -> str:
    """``"Kraft hin [N]"`` -> ``"Kraft [N]"``; ``"unloading kgf"`` -> ``"values [kgf]"``."""
    kept = [word for word in name.split() if not _is_way(word)]
    if len(kept) == 1 < len(name.split()) and unit_of(kept[0]) is not None:
        return f"{_OF_UNIT} [{kept[0].strip('()[]')}]"
    return " ".join(kept) if kept else name


def way_of(name: str) -> str:
    """The words that `without_way` leaves out: ``"Kraft hin [N]"`` -> ``"hin"``; empty without any."""
    words = name.split()
    ways = [word.strip("()-,") for word in words if _is_way(word)]
    return " ".join(ways) if len(ways) < len(words) else ""


def _is_way(word: str) -> bool:
    return folded(word.strip("()-,")) in WAYS


def qualified_groups(
    names: Sequence[str], used: Sequence[int]
) -> tuple[list[int], list[list[int]], dict[int, str]] | None:
    """(columns of all parts, columns of each part, their names without way and run); None = no such parts.

    Two ways beside one time are two sensors, not two parts.
    """
    runs = {c: without_run(names[c]) for c in used}
    ways = {c: without_way(base) for c, (base, _) in runs.items()}
    said = {c: _words_left_out(runs[c][0], ways[c]) for c in used}
    groups: dict[tuple[str, str], list[int]] = {}
    shared: list[int] = []
    for c in used:
        if (runs[c][1] or said[c]) and recognise(ways[c]).channel is not None:
            groups.setdefault((runs[c][1], said[c]), []).append(c)
        elif names[c]:
            shared.append(c)
    keys = [[folded(ways[c]) for c in group] for group in groups.values()]
    if len(groups) < 2 or any(sorted(key) != sorted(keys[0]) or len(set(key)) < len(key) for key in keys):
        return None
    by_way = len({run for run, _ in groups}) < len(groups)
    if by_way and any(recognise(names[c]).channel == "time" for c in shared):
        return None
    if len(keys[0]) < 2 and not any(recognise(names[c]).channel for c in shared):
        return None
    ordered = [
        [group[key.index(k)] for k in keys[0]] for group, key in zip(groups.values(), keys, strict=True)
    ]
    return shared, ordered, {c: ways[c] for group in ordered for c in group}


def _words_left_out(text: str, shorter: str) -> str:
    kept = shorter.split()
    return " ".join(folded(word) for word in text.split() if word not in kept)
