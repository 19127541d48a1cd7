"""The study document: what is varied in a drive or a task, how, and which figures are watched."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field, JsonValue, model_validator

from mckibben.documents.drive import DriveDocument, DriveOrId, OrPreset
from mckibben.documents.kinds import is_preset, refuse_other, refuse_table
from mckibben.documents.located import located
from mckibben.documents.problems import validated
from mckibben.documents.saved_model import SavedModel
from mckibben.documents.strict import Strict
from mckibben.documents.task import SizingTask
from mckibben.facts.study import STUDY
from mckibben.physics.errors import InputError
from mckibben.presets.reading import BadDocumentError, read_file

TaskOrId = Annotated[SizingTask, OrPreset("task", "lift-20kg")]
MOST_RUNS = 10_000_000  # a table of so many runs still fits into memory

FieldPath = Annotated[str, Field(min_length=1, max_length=200, pattern=r"^[A-Za-z0-9_.]+$")]
StudyValue = Annotated[
    float | Annotated[str, Field(min_length=1, max_length=100)],
    Field(description="A number in SI units, or a text with a unit.", examples=["8 kg"]),
]
Seed = Annotated[int, Field(ge=0, le=2**32 - 1)]
Runs = Annotated[int, Field(ge=1, le=MOST_RUNS)]
_SEED = "The random numbers follow from it: the same seed gives the same runs."
_LEAST = "Values below it do not occur: the distribution is truncated there. Default: not truncated."
_MOST = "Values above it do not occur: the distribution is truncated there. Default: not truncated."


class NormalDistribution(Strict):
    """A normal distribution, possibly truncated."""

    type: Literal["normal"] = Field(description="Kind of distribution.")
    mean: StudyValue = Field(description="Mean, before truncation.")
    deviation: StudyValue = Field(description="Standard deviation, before truncation.")
    least: StudyValue | None = Field(None, description=_LEAST)
    most: StudyValue | None = Field(None, description=_MOST)


class LognormalDistribution(Strict):
    """A lognormal distribution, possibly truncated: its logarithm is normally distributed."""

    type: Literal["lognormal"] = Field(description="Kind of distribution.")
    median: StudyValue = Field(description="Median, before truncation.")
    log_deviation: Annotated[float, Field(gt=0.0, le=10.0)] = Field(
        description="Standard deviation of the natural logarithm; 0.1 is a spread of about 10 %."
    )
    least: StudyValue | None = Field(None, description=_LEAST)
    most: StudyValue | None = Field(None, description=_MOST)


class UniformDistribution(Strict):
    """All values between two bounds are equally probable."""

    type: Literal["uniform"] = Field(description="Kind of distribution.")
    least: StudyValue = Field(description="Lower bound.")
    most: StudyValue = Field(description="Upper bound.")


class TriangularDistribution(Strict):
    """A density that rises linearly from the lower bound to the mode, and falls to the upper bound."""

    type: Literal["triangular"] = Field(description="Kind of distribution.")
    least: StudyValue = Field(description="Lower bound.")
    mode: StudyValue = Field(description="Most probable value.")
    most: StudyValue = Field(description="Upper bound.")


Distribution = Annotated[
    NormalDistribution | LognormalDistribution | UniformDistribution | TriangularDistribution,
    Field(discriminator="type"),
]


class VariedQuantity(Strict):
    """A quantity of the document that is varied: by values, over a range, or with a distribution."""

    path: FieldPath = Field(
        description="Path of the quantity in the document of the subject.",
        examples=["load.mass", "muscle.nominal_length", "effects.<id>.<parameter>"],
    )
    values: Annotated[list[StudyValue], Field(min_length=1, max_length=100_000)] | None = Field(
        None, description="The values. For a field that is no quantity, e.g. the id of a preset, texts."
    )
    begin: StudyValue | None = Field(None, alias="from", description="Lower end of a range.")
    end: StudyValue | None = Field(None, alias="to", description="Upper end of a range.")
    points: Annotated[int, Field(ge=2, le=100_000)] | None = Field(
        None, description="Number of values of a range, for a grid and for designs of a robust study."
    )
    scale: Literal["linear", "logarithmic"] = Field(
        "linear", description="How a range is divided, and how its values are distributed."
    )
    distribution: Distribution | None = Field(None, description="How the value is distributed.")
    relative: bool = Field(
        False,
        description="Whether the values are factors on the value in the document, e.g. 1 ± 0.05 for a "
        "tolerance; of a design in a robust study, on the value of the design.",
    )

    @model_validator(mode="after")
    def _one_form(self) -> VariedQuantity:
        ranged = self.begin is not None or self.end is not None
        forms = [self.values is not None, ranged, self.distribution is not None]
        if sum(forms) != 1:
            raise InputError(
                "a varied quantity has values, a range (from, to), or a distribution: one of them",
                hint='e.g. "from": "8 kg", "to": "12 kg"',
            )
        if ranged and (self.begin is None or self.end is None):
            missing = "from" if self.begin is None else "to"
            raise InputError(f"the range has no '{missing}'", field=missing)
        if not ranged and (self.points is not None or self.scale != "linear"):
            raise InputError("points and scale belong to a range", hint="give from and to, or omit them")
        return self


class Goal(Strict):
    """A figure that is to be small, or large."""

    figure: FieldPath = Field(description="Path of the figure.", examples=["timing.extend.positioning_time"])
    direction: Literal["minimise", "maximise"] = Field("minimise", description="What is better.")


class Limit(Strict):
    """A limit of a figure; a run without this figure does not keep it."""

    figure: FieldPath = Field(description="Path of the figure.", examples=["timing.extend.impact_energy"])
    at_least: StudyValue | None = Field(None, description="Lower limit.")
    at_most: StudyValue | None = Field(None, description="Upper limit.")

    @model_validator(mode="after")
    def _some_limit(self) -> Limit:
        if self.at_least is None and self.at_most is None:
            raise InputError("a limit has at_least, at_most, or both", hint='e.g. "at_most": "0.3 s"')
        return self


class GridMethod(Strict):
    """All combinations of the values."""

    type: Literal["grid"] = Field(description="Name of the method.")


class ListMethod(Strict):
    """One run for the first value of each quantity, one for the second values, and so on."""

    type: Literal["list"] = Field(description="Name of the method.")


class LatinHypercubeMethod(Strict):
    """Latin hypercube: each quantity is spread evenly over its distribution or range."""

    type: Literal["latin_hypercube"] = Field(description="Name of the method.")
    runs: Runs = Field(100, description="Number of runs.")
    seed: Seed = Field(1, description=_SEED)


class MonteCarloMethod(Strict):
    """Independent random values; ranges are uniform distributions."""

    type: Literal["monte_carlo"] = Field(description="Name of the method.")
    runs: Runs = Field(1000, description="Number of runs.")
    seed: Seed = Field(1, description=_SEED)


class SobolMethod(Strict):
    """Sobol's indices: the share of the variance of a figure that each quantity causes."""

    type: Literal["sobol"] = Field(description="Name of the method.")
    samples: Annotated[int, Field(ge=2, le=2**20)] = Field(
        256, description="Base samples, a power of two; samples * (quantities + 2) runs."
    )
    seed: Seed = Field(1, description=_SEED)

    @model_validator(mode="after")
    def _power(self) -> SobolMethod:
        if self.samples & (self.samples - 1):
            below = 1 << (self.samples.bit_length() - 1)
            raise InputError(
                f"{self.samples} is not a power of two", field="samples", hint=f"{below} or {2 * below}"
            )
        return self


class MorrisMethod(Strict):
    """Morris' elementary effects: which quantities matter at all, with few runs."""

    type: Literal["morris"] = Field(description="Name of the method.")
    trajectories: Annotated[int, Field(ge=2, le=100_000)] = Field(
        20, description="Trajectories; trajectories * (quantities + 1) runs."
    )
    levels: Annotated[int, Field(ge=4, le=64, multiple_of=2)] = Field(
        4, description="Levels of each quantity, an even number."
    )
    seed: Seed = Field(1, description=_SEED)


class OptimisationMethod(Strict):
    """Optimisation of one or several goals within limits, over the ranges of the quantities."""

    type: Literal["optimisation"] = Field(description="Name of the method.")
    population: Annotated[int, Field(ge=8, le=10_000)] = Field(40, description="Runs of a generation.")
    generations: Annotated[int, Field(ge=1, le=10_000)] = Field(25, description="Number of generations.")
    seed: Seed = Field(1, description=_SEED)


class RobustMethod(Strict):
    """Probability that built specimens of each design keep the limits.

    Quantities with values or a range are those of the design (all combinations); quantities with a
    distribution differ between specimens. All designs are built with the same specimens.
    """

    type: Literal["robust"] = Field(description="Name of the method.")
    runs: Runs = Field(200, description="Specimens of each design.")
    seed: Seed = Field(1, description=_SEED)


Method = Annotated[
    GridMethod
    | ListMethod
    | LatinHypercubeMethod
    | MonteCarloMethod
    | SobolMethod
    | MorrisMethod
    | OptimisationMethod
    | RobustMethod,
    Field(discriminator="type"),
]


class Subject(Strict):
    """What is studied: a drive, a sizing task, or a saved model in a drive."""

    drive: DriveOrId | None = Field(
        None, description="A drive document or the id of a drive preset; with a model, the drive it is in."
    )
    task: TaskOrId | None = Field(
        None,
        description="A sizing task or the id of a task preset; the figures are those of its first proposal.",
    )
    model: SavedModel | None = Field(
        None, description="A saved model; its muscle and effects replace those of the drive."
    )

    @model_validator(mode="after")
    def _one_subject(self) -> Subject:
        hint = 'e.g. {"drive": "paper-step"}'
        if self.task is not None:
            if self.drive is not None or self.model is not None:
                raise InputError("a study has one subject: a task, or a drive or model", hint=hint)
        elif self.drive is None and (self.model is None or self.model.drive is None):
            what = "a model without a drive of its own needs one" if self.model else "there is no subject"
            raise InputError(what, hint=hint)
        return self


_EXAMPLES: list[JsonValue] = [
    {
        "title": "Tolerance of a lift",
        "subject": {"drive": "propneu-20-physical"},
        "quantities": [
            {
                "path": "load.mass",
                "distribution": {"type": "normal", "mean": "9.3 kg", "deviation": "0.3 kg"},
            },
            {"path": "supply.pressure", "from": "5.8 bar", "to": "6.2 bar"},
        ],
        "figures": ["timing.extend.rise_time", "timing.extend.impact_energy"],
        "limits": [{"figure": "timing.extend.positioning_time", "at_most": "0.5 s"}],
        "method": {"type": "monte_carlo", "runs": 200, "seed": 1},
    },
]


class StudyDocument(Strict):
    """A study: many runs of one subject with varied quantities."""

    model_config = ConfigDict(json_schema_extra={"examples": _EXAMPLES})

    schema_version: Literal[1] = Field(1, alias="schema", description="Version of the document.")
    kind: Literal["study"] = Field("study", description="The word 'study'.")
    title: Annotated[str, Field(max_length=200)] = Field("", description="Title for display.")
    subject: Subject = Field(description="What is studied.")
    quantities: Annotated[list[VariedQuantity], Field(min_length=1, max_length=100)] = Field(
        description="What is varied."
    )
    figures: Annotated[list[FieldPath], Field(max_length=100)] = Field(
        default_factory=list,
        description="Figures to watch, besides those of goals and limits: timing.extend.rise_time and the "
        "other figures of the timing table, tracking.rms, largest.pressure, best.time.",
    )
    goals: Annotated[list[Goal], Field(max_length=10)] = Field(
        default_factory=list, description="Goals, of an optimisation or for the Pareto front of the runs."
    )
    limits: Annotated[list[Limit], Field(max_length=20)] = Field(
        default_factory=list, description="Limits of figures."
    )
    method: Method = Field(description="Which runs are made.")
    confidence: Annotated[float, Field(ge=0.5, le=0.9999)] = Field(
        0.95, description=STUDY["confidence"].definition
    )

    def figure_paths(self) -> list[str]:
        """All figures that are needed, each once, in the order in which they are stated."""
        used = [*self.figures, *(goal.figure for goal in self.goals), *(item.figure for item in self.limits)]
        return list(dict.fromkeys(used))

    @model_validator(mode="after")
    def _complete(self) -> StudyDocument:
        if not self.figure_paths():
            raise InputError(
                "the study watches no figure", field="figures", hint='e.g. ["timing.extend.rise_time"]'
            )
        if self.method.type == "optimisation" and not self.goals:
            raise InputError(
                "an optimisation needs a goal",
                field="goals",
                hint='e.g. [{"figure": "timing.extend.positioning_time"}]',
            )
        if self.method.type == "robust" and not self.limits:
            raise InputError(
                "a robust study needs limits that the designs are to keep",
                field="limits",
                hint='e.g. [{"figure": "timing.extend.positioning_time", "at_most": "0.5 s"}]',
            )
        return self


def drive_content(subject: Subject, preset: DriveDocument | None) -> dict[str, Any]:
    """The drive document of a subject as JSON, with muscle and effects of its model.

    Args:
        subject: a drive or a model.
        preset: the document of the preset that the subject names.
    """
    drive = preset if isinstance(subject.drive, str) else subject.drive
    model = subject.model
    if drive is None:
        drive = None if model is None else model.drive
    if drive is None:
        raise ValueError("the subject has no drive")
    content = dict(drive.to_document())
    if model is not None and subject.drive is not None:
        saved = model.to_document()
        muscle: dict[str, Any] = model.muscle.to_document()
        own = content["muscle"]
        if "nominal_length" not in muscle and isinstance(own, dict) and "nominal_length" in own:
            muscle["nominal_length"] = own["nominal_length"]
        content |= {"muscle": muscle, "effects": saved["effects"]}
    return content


def read_study(document: object) -> StudyDocument:
    """A study from JSON.

    Raises:
        InputError: what is wrong, with ``field`` the path in the document.
    """
    return validated(StudyDocument, document, "the study")


def read_study_file(path: Path) -> StudyDocument:
    """The study of a file; its subject may name other JSON files, relative to it.

    Raises:
        InputError: names the file, the field, what is wrong and what would be right.
    """
    try:
        refuse_table(path.name, "study")
        content = _content(path, "")
        refuse_other(content, "", ("study",))
        if isinstance(content, dict) and isinstance(subject := content.get("subject"), dict):
            content = {**content, "subject": {name: _named(part, path) for name, part in subject.items()}}
        return read_study(content)
    except InputError as error:
        raise in_file(str(path), error) from error


def in_file(file: str, error: InputError) -> InputError:
    """The error with its file and its whole field in front: several quantities may have the same mistake."""
    message = error.message.removesuffix(".")
    if error.field and not message.startswith(error.field):
        message = f"{error.field}: {message}"
    return InputError(f"{file}: {message}", hint=error.hint, code=error.code)


def _named(part: object, study: Path) -> object:
    """The content of the file that a part of the subject names; other parts unchanged."""
    if not isinstance(part, str) or not part.lower().endswith(".json"):
        return part
    content = _content(study.parent / part, f"{part}: ")
    return content["document"] if isinstance(content, dict) and is_preset(content) else content


def _content(path: Path, named: str) -> object:
    try:
        return read_file(path, follow_links=True)
    except BadDocumentError as bad:
        finding = bad.findings[0]
        raise InputError(f"{named}{located(finding.field, finding.message)}", hint=finding.hint) from bad
