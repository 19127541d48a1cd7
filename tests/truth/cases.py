"""A case: what the diagnosis is shown, and the sealed answer."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any
from zlib import crc32

import numpy as np


@dataclass(frozen=True)
class Held:
    """Another test of the same muscle and rig, to predict.

    Attributes:
        text: of its file.
        drive: its drive document, None where there is none.
        noise: as of a case.
    """

    text: str
    drive: dict[str, Any] | None
    noise: dict[str, float]


@dataclass(frozen=True)
class Case:
    """One synthetic measurement with its answer.

    The diagnosis may see ``files``, ``muscle``, ``drive`` and ``effects``; the rest is sealed.

    Attributes:
        name: of the case, without its seed.
        kind: kind of measurement.
        hidden: per hidden effect, the effect ids that count as right.
        unknown: what the effect beyond every catalogue is, None without one.
        muscle: muscle document.
        drive: drive document the user has, None where there is none.
        effects: the start model's effects, {} the ideal one.
        files: text of each file, by its name.
        noise: predicted channel -> standard deviation of measured minus truth at the measured inputs, SI.
        seed: of the random numbers.
        truths: what each hidden effect really is.
        ratios: rms of each hidden effect over the noise; of the unknown one last.
        rows: data rows of all files.
        clean: predicted channel -> the truth at the measured inputs, SI.
        measured: predicted channel -> the readings, SI.
        held: the same rig under conditions that the diagnosis does not see; None where there are none.
    """

    name: str
    kind: str
    hidden: tuple[frozenset[str], ...]
    unknown: str | None
    muscle: dict[str, Any]
    drive: dict[str, Any] | None
    effects: dict[str, dict[str, Any]]
    files: dict[str, str]
    noise: dict[str, float]
    seed: int
    truths: tuple[str, ...]
    ratios: tuple[float, ...]
    rows: int
    clean: dict[str, np.ndarray] = field(repr=False)
    measured: dict[str, np.ndarray] = field(repr=False)
    held: Held | None = field(default=None, repr=False)

    @property
    def id(self) -> str:
        """Name with seed."""
        return f"{self.name}-{self.seed}"

    @property
    def status(self) -> str:
        """What a verdict should say; ``missing_effects`` may also be called ambiguous."""
        if self.unknown is not None:
            return "unknown_effect"
        return "missing_effects" if self.hidden else "adequate"


def file_name(text: str) -> str:
    """A name that says nothing of what is in the file."""
    return f"measurement-{crc32(text.encode()):08x}.csv"


Recipe = Callable[[np.random.Generator, int], Case]


class Book:
    """Recipes by name."""

    def __init__(self) -> None:
        self.recipes: dict[str, Recipe] = {}

    def recipe(self, name: str) -> Callable[[Recipe], Recipe]:
        """Register a recipe."""

        def add(recipe: Recipe) -> Recipe:
            if name in self.recipes:
                raise ValueError(f"two cases are called {name}")
            self.recipes[name] = recipe
            return recipe

        return add

    def make(self, name: str, seed: int) -> Case:
        """Make a case; the same name and seed always give the same one."""
        return self.recipes[name](np.random.default_rng([crc32(name.encode()), seed]), seed)


BOOK = Book()
