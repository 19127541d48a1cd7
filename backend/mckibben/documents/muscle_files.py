"""From a muscle in a document or file, with chosen effects, to a start model; errors name the file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from mckibben.documents.kinds import refuse_other, refuse_table
from mckibben.documents.located import at_file
from mckibben.documents.shorthand import MUSCLE_TEXT
from mckibben.physics.errors import InputError

if TYPE_CHECKING:
    from mckibben.documents.start_model import PresetFacts, StartModel
    from mckibben.documents.studio import Studio

#: Effect id -> parameter -> SI number, or text with a unit.
Effects = dict[str, dict[str, float | str]]


@dataclass(frozen=True, slots=True)
class NamedEffects:
    """Effects of ``--effect``: with the numbers of the document or preset where it has them."""

    ids: tuple[str, ...]

    def of(self, stated: Mapping[str, Mapping[str, float | str]]) -> Effects:
        """The effects with what is stated of each; what is not takes its default."""
        return {name: dict(stated.get(name, {})) for name in self.ids}


def with_length(document: object, rest_length: float | None) -> object:
    """A muscle of a document, with this length where it has none."""
    document = MUSCLE_TEXT.document(document)
    if not isinstance(document, dict) or rest_length is None or "nominal_length" in document:
        return document
    return {**document, "nominal_length": rest_length}


def muscle_alone(document: object, source: str) -> object:
    """The muscle of a document that holds it alone, also as ``{"muscle": {...}}``.

    Raises:
        InputError: it is a whole drive.
    """
    if not isinstance(document, dict) or not isinstance(document.get("muscle"), dict | str):
        return document
    beside = ", ".join(str(key) for key in document if key != "muscle")
    if beside:
        refuse_other(document, source, ("muscle",))
        raise InputError(
            f"{source}: beside the muscle it holds {beside}",
            field="muscle",
            hint="what belongs here is what stands inside 'muscle'; a whole drive goes to --drive",
        )
    return MUSCLE_TEXT.document(document["muscle"])


def is_file(muscle: str, studio: Studio) -> bool:
    """Whether it names a JSON file; a preset id with a slash, or a file named like a preset, does not."""
    if muscle.lower().endswith(".json"):
        return True
    known = {preset.id.lower() for preset in studio.library.list("muscles")}
    return muscle.partition(":")[0].lower() not in known and Path(muscle).exists()


def start_of_file(
    studio: Studio, path: Path, effects: Effects | NamedEffects | None, rest_length: float | None
) -> StartModel:
    """A muscle by geometry, or a whole preset file.

    Raises:
        InputError: names the file and field, what is wrong and what would be right.
    """
    from mckibben.documents.start_model import PresetFacts

    content = preset_of_file(path, studio)
    if not isinstance(content, PresetFacts):
        document = muscle_alone(content, str(path))
        return start_of_input(studio, with_length(document, rest_length), effects, str(path))
    if isinstance(effects, NamedEffects):
        effects = effects.of(content.effects)
    return start_of_input(studio, {}, effects, str(path), facts=content)


def preset_of_file(path: Path, studio: Studio) -> PresetFacts | object:
    """The facts of a muscle preset in a file, or the content of a file that holds something else.

    Raises:
        InputError: names the file and field, what is wrong and what would be right.
    """
    from mckibben.documents.start_model import preset_facts
    from mckibben.presets import MusclePreset
    from mckibben.presets.reading import BadDocumentError, parse, read_file

    try:
        refuse_table(str(path), "muscle")
        document = read_file(path, follow_links=True)
        refuse_other(document, str(path), ("muscle",))
        if not isinstance(document, dict) or "kind" not in document:
            return document
        if "geometry" not in document and "id" not in document:  # a plain muscle that says what it is
            return {name: value for name, value in document.items() if name not in ("schema", "kind")}
        preset = parse(MusclePreset, document, studio.effect_table)
    except BadDocumentError as bad:
        finding = bad.findings[0]
        where = f"{path}: {finding.field}" if finding.field else str(path)
        raise InputError(f"{where}: {finding.message}", hint=finding.hint) from bad
    assert isinstance(preset, MusclePreset)  # noqa: S101 - parsed as one
    preset.adopt("user", studio.effect_table)
    return preset_facts(preset, studio.catalogue)


def _usable(studio: Studio, start: StartModel) -> StartModel:
    """The same, after checking that a model can be built; here an error can name the file."""
    studio.static_model(start)
    return start


def start_of_input(
    studio: Studio,
    document: object,
    effects: Effects | NamedEffects | None,
    source: str,
    *,
    facts: PresetFacts | None = None,
) -> StartModel:
    """A muscle of a document with chosen effects.

    Args:
        studio: presets and effects.
        document: the muscle as JSON.
        effects: {} is the ideal model, None the effects of the preset.
        source: where the document stands, for messages; "" for nowhere.
        facts: of a preset that no folder has.

    Raises:
        InputError: names source and field, what is wrong and what would be right.
    """
    from pydantic import ValidationError

    from mckibben.documents.muscle import MuscleInput
    from mckibben.documents.problems import first_problem
    from mckibben.documents.start_model import start_model, stated_muscle

    try:
        muscle = stated_muscle(MuscleInput.model_validate(document))
        if isinstance(effects, NamedEffects):
            effects = effects.of({} if muscle.preset is None else studio.facts(muscle.preset).effects)
        if facts is None:
            return _usable(studio, studio.start_model(muscle, effects))
        return _usable(studio, start_model(muscle, effects, preset=facts, catalogue=studio.catalogue))
    except ValidationError as error:
        problem = first_problem(error.errors(), MuscleInput, document, "the muscle")
        raise at_file(source, problem.field, problem.message, problem.hint) from error
    except InputError as error:
        raise at_file(
            source, (error.field or "").removeprefix("muscle."), error.message, error.hint
        ) from error
