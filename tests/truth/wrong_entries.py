"""Cases in which what is stated is wrong: a dimension, a unit, a zero of a channel; alone and beside effects.

Each mistake changes the muscle document or the file of a case of this package, not the truth behind it.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, replace

from tests.truth.cases import Case
from tests.truth.generate import case

Change = Callable[[Case], Case]


@dataclass(frozen=True)
class Mistake:
    """A wrong entry.

    Attributes:
        name: of the mistake.
        right: ids of the hypotheses that name it, or its exact twins.
        change: makes it.
    """

    name: str
    right: frozenset[str]
    change: Change


def _muscle(field: str, factor: float = 1.0, shift: float = 0.0) -> Change:
    def change(given: Case) -> Case:
        number, unit = str(given.muscle[field]).split()
        wrong = f"{float(number) * factor + shift:.6g} {unit}"
        return replace(given, muscle={**given.muscle, field: wrong})

    return change


def _column(name: str, factor: float = 1.0, shift: float = 0.0) -> Change:
    """Another number in the columns of a name, in the unit of the head; ``shift`` is in units of 1e5 Pa."""

    def change(given: Case) -> Case:
        return replace(
            given, files={key: _table(text, name, factor, shift) for key, text in given.files.items()}
        )

    return change


def _table(text: str, name: str, factor: float, shift: float) -> str:
    lines = text.split("\n")
    head = next(i for i, line in enumerate(lines) if line and not line.startswith("#"))
    separator = next(mark for mark in (";", "\t", ",") if mark in lines[head])
    comma = separator == ";" and re.search(r"\d,\d", lines[head + 1]) is not None
    heads = lines[head].split(separator)
    places = [i for i, h in enumerate(heads) if re.match(name, h.strip(), re.IGNORECASE)]
    assert places, f"no column {name} in {heads}"
    for number in range(head + 1, len(lines)):
        cells = lines[number].split(separator)
        if len(cells) < len(heads):
            continue
        for place in places:
            value = float(cells[place].replace(",", ".") if comma else cells[place])
            cells[place] = f"{value * factor + shift * _bar(heads[place].lower()):.9g}".replace(
                ".", "," if comma else "."
            )
        lines[number] = separator.join(cells)
    return "\n".join(lines)


_STROKE = r"(displacement|position|stroke|hub|weg)"


def _bar(unit: str) -> float:
    """One bar in the unit of a head."""
    if "kpa" in unit:
        return 100.0
    if "mpa" in unit:
        return 0.1
    return 1e5 if re.search(r"\bpa\b", unit) else 1.0


MISTAKES = (
    Mistake("longer", frozenset({"rest_length"}), _muscle("nominal_length", 1.2)),
    Mistake("shorter", frozenset({"rest_length"}), _muscle("nominal_length", 0.88)),
    Mistake("thicker", frozenset({"braid_diameter"}), _muscle("braid_diameter", 1.18)),
    Mistake("steeper", frozenset({"braid_angle"}), _muscle("braid_angle", shift=4.0)),
    Mistake("absolute", frozenset({"absolute_pressure"}), _column(r"(p\b|pressure)", shift=1.01325)),
    Mistake("psi", frozenset({"pressure_in_psi"}), _column(r"(p\b|pressure)", 14.5038)),
    Mistake("tenth", frozenset({"pressure_in_MPa"}), _column(r"(p\b|pressure)", 0.1)),
    Mistake("kgf", frozenset({"force_in_kgf"}), _column(r"(f\b|force|load)", 1.0 / 9.80665)),
    Mistake("lbf", frozenset({"force_in_lbf"}), _column(r"(f\b|force|load)", 1.0 / 4.4482216)),
    Mistake("thin-wall", frozenset({"wall_thickness"}), _muscle("wall_thickness", 0.1)),
    Mistake("inch", frozenset({"stroke_in_inch"}), _column(_STROKE, 1.0 / 25.4)),
)


def _supply(factor: float) -> Change:
    def change(given: Case) -> Case:
        drive = given.drive or {}
        number, unit = str(drive["supply"]["pressure"]).split()
        supply = {"pressure": f"{float(number) * factor:.6g} {unit}"}
        return replace(given, drive={**drive, "supply": supply})

    return change


#: Mistakes of a drive, and the cases in which they are made.
DRIVE_MISTAKES = (
    Mistake("high-supply", frozenset({"supply"}), _supply(1.2)),
    Mistake("low-supply", frozenset({"supply"}), _supply(0.85)),
)
DRIVES = ("nothing-steps", "drag-partial", "silencer-steps", "delay-pulses")

#: Cases without a mistake of their own: nothing hidden, then one effect.
ALONE = ("nothing-isobaric", "nothing-known-wall-isometric", "nothing-thread-form-map", "nothing-steps")
BESIDE = (
    "bladder-yeoh-isobaric", "linear-spring-isobaric", "prestress-isometric", "bladder-ogden-isometric",
    "pressure-zero-isobaric",
)  # fmt: skip
#: Kept apart from what the thresholds of the diagnosis were chosen on.
APART = (
    "nothing-isotonic", "coulomb-isobaric", "effectiveness-isometric", "bladder-eight-chain-isotonic",
    "pair-bladder-coulomb-isobaric", "bladder-exponential-map", "viscous-speeds-isobaric",
    "end-caps-isobaric",
)  # fmt: skip


def mistaken(seed: int, names: tuple[str, ...] = (*ALONE, *BESIDE, *DRIVES)) -> list[tuple[Mistake, Case]]:
    """Every mistake in every case whose file and muscle allow it."""
    found = []
    for name in dict.fromkeys(names):
        for mistake in DRIVE_MISTAKES if name in DRIVES else MISTAKES:
            try:
                changed = mistake.change(case(name, seed))
            except (AssertionError, KeyError):
                continue
            heads = " ".join(text[:400].lower() for text in changed.files.values())
            if mistake.name in ("absolute", "tenth") and "abs" in heads:
                continue  # said to be absolute already; a tenth of it would be below the atmosphere
            if mistake.name == "thin-wall" and "bladder_elasticity" not in changed.effects:
                continue  # nobody knows the modulus: a thinner wall is a stiffer one
            if mistake.name in ("longer", "shorter") and "contraction" in heads:
                continue  # shares of the length say nothing about the length
            found.append((mistake, replace(changed, name=f"{name}+{mistake.name}")))
    return found
