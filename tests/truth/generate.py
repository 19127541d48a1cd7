"""All cases, made when asked for and kept in a temporary folder under the hash of this code.

``python -m tests.truth.generate FOLDER`` writes the files and, in ``answers.json``, what is hidden in them.
"""

from __future__ import annotations

import hashlib
import json
import os
import pickle
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

# Importing a module of cases registers its recipes.
from tests.truth import (
    drive_cases,
    elastic_cases,
    friction_cases,
    joint_cases,
    joint_more_cases,
    mixed_cases,
    sensor_cases,
)
from tests.truth.cases import BOOK, Case

MODULES = (
    elastic_cases,
    friction_cases,
    sensor_cases,
    drive_cases,
    mixed_cases,
    joint_cases,
    joint_more_cases,
)
SEEDS = (0, 1, 2)


def names() -> tuple[str, ...]:
    """Names of all cases."""
    return tuple(BOOK.recipes)


def case(name: str, seed: int = 0, *, cache: Path | None = None) -> Case:
    """One case.

    Args:
        name: one of `names`.
        seed: of the random numbers; muscle, sizes and noise change with it.
        cache: folder of made cases, None: under the system's temporary folder.
    """
    folder = cache or Path(tempfile.gettempdir()) / f"muscle-truth-{_code()}"
    file = folder / f"{name}-{seed}.pickle"
    if file.exists():
        return pickle.loads(file.read_bytes())
    made = BOOK.make(name, seed)
    folder.mkdir(parents=True, exist_ok=True)
    own = file.with_suffix(f".{os.getpid()}")  # two runs at once may write the same case
    own.write_bytes(pickle.dumps(made))
    own.replace(file)
    return made


def all_cases(seeds: Sequence[int] = SEEDS, *, cache: Path | None = None) -> Iterator[Case]:
    """Every case with every seed, one after the other."""
    for name in names():
        for seed in seeds:
            yield case(name, seed, cache=cache)


def _code() -> str:
    """Hash of everything the cases depend on here."""
    found = hashlib.sha256(np.__version__.encode())
    for file in sorted(Path(__file__).parent.glob("*.py")):
        found.update(file.read_bytes())
    return found.hexdigest()[:16]


def answer_of(made: Case) -> dict[str, Any]:
    """The sealed part of a case, as JSON."""
    return {
        "name": made.name,
        "seed": made.seed,
        "kind": made.kind,
        "status": made.status,
        "hidden": [sorted(ids) for ids in made.hidden],
        "truths": list(made.truths),
        "unknown": made.unknown,
        "rows": made.rows,
        "noise": made.noise,
        "effect_over_noise": [round(ratio, 2) for ratio in made.ratios],
    }


def write(folder: Path, seeds: Sequence[int] = SEEDS) -> list[dict[str, Any]]:
    """Write every case: ``<id>.csv``, ``<id>.given.json`` (muscle, drive, effects), and ``answers.json``."""
    folder.mkdir(parents=True, exist_ok=True)
    answers = []
    for made in all_cases(seeds):
        for text in made.files.values():
            (folder / f"{made.id}.csv").write_text(text, encoding="utf-8")
        given = {"muscle": made.muscle, "drive": made.drive, "effects": made.effects}
        (folder / f"{made.id}.given.json").write_text(json.dumps(given, indent=1), encoding="utf-8")
        answers.append(answer_of(made))
    (folder / "answers.json").write_text(json.dumps(answers, indent=1), encoding="utf-8")
    return answers


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: python -m tests.truth.generate FOLDER")
    written = write(Path(sys.argv[1]))
    sys.stdout.write(f"{len(written)} cases in {sys.argv[1]}\n")
