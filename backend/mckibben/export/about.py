"""What every file says of itself: model, source of every constant, range, and what is left out."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from mckibben.physics.parameter import GRADES


@dataclass(frozen=True, slots=True)
class Constant:
    """A number of the model, SI.

    Attributes:
        name: "nominal_length", "effect.parameter", "drive.mass".
        source: where the number comes from.
        grade: how certain that is, a key of `mckibben.physics.parameter.GRADES`.
    """

    name: str
    value: float
    unit: str
    description: str
    source: str
    grade: str

    @property
    def shown(self) -> str:
        """Name, number and unit."""
        return f"{self.name} = {self.value!r}{'' if self.unit == '1' else f' {self.unit}'}"


@dataclass(frozen=True, slots=True)
class ValidRange:
    """A range in which the model was measured, or that the maker permits; SI."""

    quantity: str
    least: float | None
    most: float | None
    unit: str
    why: str

    @property
    def shown(self) -> str:
        """The range in words."""
        ends = [f"from {self.least:.6g}" if self.least is not None else ""]
        ends.append(f"to {self.most:.6g}" if self.most is not None else "")
        unit = "" if self.unit == "1" else f" {self.unit}"
        return f"{self.quantity} {' '.join(filter(None, ends))}{unit} ({self.why})"


@dataclass(frozen=True)
class About:
    """The identity of an exported model.

    Attributes:
        id: readable name and the beginning of the hash.
        hash: sha256 of all numbers that the model computes with.
        title: of the document, or what is known of the muscle.
        program: that wrote it.
        effects: "title (id)" of each effect, and the text of a typed term.
        constants: of the muscle, the effects and the drive.
        valid: where it holds.
        left_out: what the file does not contain, sentences.
        assumed: what nobody stated.
        origin: how the model was found, sentences.
    """

    id: str
    hash: str
    title: str
    program: str
    effects: tuple[str, ...]
    constants: tuple[Constant, ...]
    valid: tuple[ValidRange, ...]
    left_out: tuple[str, ...]
    assumed: tuple[str, ...]
    origin: tuple[str, ...]

    def lines(self, more: Sequence[str] = ()) -> Iterator[str]:
        """The content as lines of a comment; ``more`` is left out by the format."""
        yield self.title
        yield f"Model {self.id}, sha256 {self.hash}, written by {self.program}."
        yield "SI units. Pressures are gauge unless a name says otherwise. A contraction is 1 - L/L0."
        yield from self._part("Effects", self.effects or ("none: the ideal model",))
        yield from self._part("Where the model comes from", self.origin)
        yield from self._part("Assumed, because nobody stated it", self.assumed)
        yield from self._part("Valid", [each.shown for each in self.valid] or ["no range is known"])
        yield from self._part("Left out", [*self.left_out, *more])
        yield ""
        yield "Constants, with source and grade:"
        for each in self.constants:
            yield f"  {each.shown}: {each.description} Source: {each.source} [{each.grade}]"
        used = dict.fromkeys(each.grade for each in self.constants)
        yield (
            "  Grades: " + "; ".join(f"{grade} = {GRADES[grade]}" for grade in GRADES if grade in used) + "."
        )

    @staticmethod
    def _part(title: str, sentences: Sequence[str]) -> Iterator[str]:
        if sentences:
            yield ""
            yield f"{title}:"
            yield from (f"  - {sentence}" for sentence in sentences)
