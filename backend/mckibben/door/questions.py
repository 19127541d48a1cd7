"""A model as documents, and the question of a comparison or diagnosis with it."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import Any, Protocol, TypeAlias, cast

from mckibben.application.compare.question import EffectDocument, ModelQuestion
from mckibben.application.compare.stated_question import SavedStart, stated_question
from mckibben.application.measurement.experiment import QuestionModel
from mckibben.application.measurement.files import ARGUMENT
from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_reading import drive_of, read_document
from mckibben.documents.kinds import kind_of
from mckibben.documents.located import at_file
from mckibben.documents.model_files import drive_document, saved_model
from mckibben.documents.muscle_files import Effects, preset_of_file, start_of_input, with_length
from mckibben.documents.saved_model import SavedModel, read_saved_model, with_record
from mckibben.documents.shorthand import MUSCLE_TEXT
from mckibben.documents.start_model import PresetFacts, StartModel
from mckibben.documents.studio import Studio
from mckibben.door.measurement import Measurement, read
from mckibben.door.values import names_of
from mckibben.measurement.experiment import ExperimentValue
from mckibben.physics.custom import TERM
from mckibben.physics.errors import InputError
from mckibben.physics.muscle import GEOMETRY
from mckibben.physics.units import si
from mckibben.presets.reading import BadDocumentError, read_file
from mckibben.simulation.outcome import Watch

#: What is compared with a model: a measurement, the path of a file, or several.
Data: TypeAlias = Measurement | str | PathLike[str] | Sequence[Measurement | str | PathLike[str]]


class DocumentedDrive(Protocol):
    """What a question needs of a `mckibben.Drive`, which is made of models."""

    @property
    def parsed(self) -> DriveDocument:
        """The drive document, checked."""
        ...


_SAMPLE_LENGTH = 0.3  # m; to check a model that has no length of its own
_NAME = "the model"  # in messages


@dataclass(frozen=True, slots=True)
class StatedModel:
    """A model as documents.

    Attributes:
        muscle: document of the muscle; without a length, data or preset give it.
        effects: None for those of the preset.
        saved: the saved model that it comes from.
        source: file or origin, for messages; "" without one.
        facts: of a preset in a file outside of the session's folders.
    """

    muscle: Mapping[str, object]
    effects: Effects | None = None
    saved: SavedModel | None = None
    source: str = ""
    facts: PresetFacts | None = None

    @classmethod
    def of_saved(cls, saved: SavedModel, source: str) -> StatedModel:
        """The model that a saved one states."""
        document = saved.to_document()
        muscle, effects = cast("dict[str, object]", document["muscle"]), cast(Effects, document["effects"])
        return cls(muscle, effects, saved, source)

    @classmethod
    def of_parts(cls, document: Mapping[str, object], source: str, of: Studio) -> StatedModel:
        """Muscle and effects of a drive document; without stated effects those of all its presets.

        Raises:
            InputError: there is no muscle.
        """
        muscle = MUSCLE_TEXT.document(document.get("muscle"))
        if not isinstance(muscle, Mapping):
            place = f"{source}: " if source else ""
            raise InputError(f"{place}the document has no muscle", hint='{"muscle": {"preset": "DMSP-20"}}')
        effects = document.get("effects")
        if effects is None and "valve" in document:
            effects = drive_of(read_document(document, source), of, measured=True).start.effects
        return cls(dict(cast("Mapping[str, object]", muscle)), cast("Effects | None", effects), None, source)

    @classmethod
    def of_file(cls, path: Path, studio: Studio) -> StatedModel:
        """The model in a JSON file.

        Raises:
            InputError: the file cannot be read, or holds no model.
        """
        source = str(path)
        try:
            content = read_file(path, follow_links=True)
        except BadDocumentError as bad:
            raise at_file(
                source, bad.findings[0].field, bad.findings[0].message, bad.findings[0].hint
            ) from bad
        if _is_saved(content):
            return cls.of_saved(saved_model(source), source)
        if kind_of(content) == "drive" or (
            isinstance(content, dict) and ("muscle" in content or "drive" in content)
        ):
            return cls.of_parts(drive_document(source, studio), source, studio)
        content = preset_of_file(path, studio)
        if isinstance(content, PresetFacts):
            return cls({}, None, None, source, content)
        if isinstance(content, dict):
            return cls(cast("dict[str, object]", content), None, None, source)
        raise InputError(f"{source}: holds no model", hint='e.g. {"preset": "DMSP-20"}')

    def changed(
        self, *, muscle: Mapping[str, object] | None = None, effects: Effects | None = None
    ) -> StatedModel:
        """The model with another muscle or other effects."""
        return replace(
            self,
            muscle=self.muscle if muscle is None else muscle,
            effects=self.effects if effects is None else effects,
        )

    def start(self, studio: Studio, rest_length: float | None = None) -> StartModel:
        """The start model; without a length of its own it has the given one.

        Raises:
            InputError: muscle or effects cannot be used, or there is no length.
        """
        document = with_length(dict(self.muscle), rest_length)
        start = start_of_input(studio, document, self.effects, self._place, facts=self.facts)
        return start if self.saved is None else with_record(start, self.saved, studio)

    def sample(self, studio: Studio) -> StartModel:
        """The start model; of some length if it has none."""
        return self.start(studio, None if self.has_length(studio) else _SAMPLE_LENGTH)

    def has_length(self, studio: Studio) -> bool:
        """Whether muscle or preset have a length."""
        return self.facts is not None or "nominal_length" in self.muscle or "preset" in self.muscle

    @property
    def _place(self) -> str:
        return "" if self.saved is not None else self.source

    def named(self, studio: Studio) -> str:
        """Preset and length, or what is known of the geometry."""
        start = self.sample(studio)
        bore = start.muscle.inside_diameter or start.muscle.braid_diameter
        name = f"muscle of {bore * 1e3:.3g} mm" if start.preset is None else start.preset.id
        length = f", {start.muscle.nominal_length * 1e3:.4g} mm" if self.has_length(studio) else ""
        return f"{name}{length}"

    def to_saved(self, studio: Studio) -> SavedModel:
        """The model as the document of a file that stands alone."""
        start = self.sample(studio)
        effects = self._all_effects(start)
        muscle = self._muscle_document(start, studio)
        document: dict[str, Any] = {"schema": 1, "kind": "model"}
        if self.saved is not None:
            document = dict[str, Any](self.saved.to_document())
            changed = document["muscle"] != muscle or document["effects"] != effects
            if not changed:
                return self.saved
            # What was said of the fit no longer holds.
            for name in ("origin", "errors", "covariance", "stated"):
                document.pop(name, None)
            document["freed"] = [
                name for name in document.get("freed", []) if name.partition(".")[0] in effects
            ]
            if "drive" in document:
                rest = {"nominal_length": start.muscle.nominal_length}
                document["drive"] = {**document["drive"], "muscle": {**rest, **muscle}, "effects": effects}
        return read_saved_model({**document, "muscle": muscle, "effects": effects}, _NAME)

    def _all_effects(self, start: StartModel) -> EffectDocument:
        effects: EffectDocument = {name: dict(values) for name, values in start.effects.items()}
        for name, values in (self.effects or {}).items():
            if TERM in values:
                effects[name] = {TERM: values[TERM], **effects[name]}
        return effects

    def _muscle_document(self, start: StartModel, studio: Studio) -> dict[str, object]:
        """What was stated; of a preset that another computer does not have, its dimensions."""
        preset = start.preset
        if preset is None or (self.facts is None and studio.library.is_built_in("muscles", preset.id)):
            return dict(self.muscle)
        return {name: float(value) for name, value in zip(GEOMETRY, start.muscle, strict=True) if value}

    def said(self, studio: Studio, drive: DriveDocument | None) -> QuestionModel:
        """Muscle, effects and drive as a question takes them."""
        name = self.source or _NAME
        preset, length = self.muscle.get("preset"), self.muscle.get("nominal_length")

        def start(named: str, rest_length: float | None) -> StartModel:
            return self.start(studio, rest_length)

        said_length = None
        if length is not None:
            said_length = ExperimentValue(si(length, "m"), "m", "you", name)
        muscle = None if preset is None else ExperimentValue(str(preset), "", "you", name)
        own = drive
        if self.saved is not None:
            own = self.saved.drive if own is None else own
        where = "drive" if drive is not None else name
        return QuestionModel(start, said_length, muscle, own, where)


def _is_saved(content: object) -> bool:
    return isinstance(content, dict) and cast("dict[str, object]", content).get("kind") == "model"


def question_of(
    model: StatedModel,
    studio: Studio,
    data: Data,
    *,
    free: str | Sequence[str] = (),
    use: str | Sequence[str] = (),
    keep: str | Sequence[str] = (),
    drive: DriveDocument | None = None,
    noise: float | str | None = None,
    strict: bool = False,
    refit: bool = True,
    validate: Data = (),
) -> tuple[ModelQuestion, str]:
    """The question of a comparison or diagnosis, and names of the data; arguments as in `stated_question`.

    Raises:
        InputError: as there.
    """
    measurements = _measurements_in(data)
    checks = [] if isinstance(validate, Sequence) and not validate else _measurements_in(validate)
    saved = None
    if model.saved is not None:
        kept = frozenset(model.saved.effects) & frozenset(model.sample(studio).effects)
        saved = SavedStart(model.saved, model.source, kept)
    question = stated_question(
        model.said(studio, drive),
        [
            *(measurement.said for measurement in measurements),
            *(replace(measurement.said, validation=True) for measurement in checks),
        ],
        studio,
        saved=saved,
        free=names_of(free),
        noise=noise,
        strict=strict,
        refit=refit,
        use=names_of(use),
        keep=names_of(keep),
        prefix=ARGUMENT,
    )
    return question, ", ".join(measurement.name for measurement in measurements)


def _measurements_in(data: Data) -> list[Measurement]:
    """One measurement or several; files are read.

    Raises:
        InputError: something else.
    """
    if isinstance(data, Measurement | str | PathLike):
        data = [data]
    if not isinstance(data, Sequence):  # pyright: ignore[reportUnnecessaryIsInstance] - from outside
        raise InputError(
            f"a {type(data).__name__} is no measurement",
            hint="mk.read(path), mk.Measurement.from_frame(frame) or .from_arrays(channels)",
        )
    found = [each if isinstance(each, Measurement) else read(each) for each in data]
    if not found:
        raise InputError("there is no measurement", hint="at least one")
    return found


def watch_of(progress: Callable[[float], object] | None) -> Watch:
    """The watch of long work without a time limit."""

    def tell(share: float) -> None:
        if progress is not None:
            progress(share)

    return Watch(progress=None if progress is None else tell)
