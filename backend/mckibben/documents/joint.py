"""The joint document: muscles on paths about one axis, springs, a link, its bearing and its stops.

One form says what a muscle does to a joint: its path (`PathInput`). A pulley is a constant lever; today's
antagonist pair is two muscles with the levers +r and -r (`joint_of_drive`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field

from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_reading import DEFAULT_PRECONTRACTION, named_document, stops_of
from mckibben.documents.joint_parts import JointInput, joint_stops, path_of
from mckibben.documents.kinds import kind_of, refuse_table
from mckibben.documents.located import at_file, located
from mckibben.documents.muscle import EffectsInput, Muscle
from mckibben.documents.problems import validated
from mckibben.documents.quantity import Temperature
from mckibben.documents.start_model import StartModel, stated_muscle
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError, fields_inside
from mckibben.presets.reading import BadDocumentError, read_file
from mckibben.simulation.statics.joint import Joint, JointMuscle, weight_torque

_PAIR = ("first", "second")


class JointDocument(JointInput):
    """A joint by itself, for its statics and for measurements of torque over angle."""

    schema_version: Literal[1] = Field(1, alias="schema", description="Version of the document.")
    kind: Literal["joint"] = Field("joint", description="The word 'joint'.")
    title: Annotated[str, Field(max_length=200)] = Field("", description="Title for display.")
    muscle: Muscle | None = Field(None, description="The muscle of all that state no own one.")
    effects: EffectsInput | None = Field(None, description="The effects of its model; null: of the preset.")
    temperature: Temperature = Field(293.15, description="Temperature of the muscles.")


@dataclass(frozen=True)
class StatedJoint:
    """A joint of a document.

    Attributes:
        joint: in SI.
        starts: the muscles with their effects, in their order.
        title: of the document.
        notes: what has to be said of it: disagreements of lengths and levers.
    """

    joint: Joint
    starts: tuple[StartModel, ...]
    title: str
    notes: tuple[str, ...]


def joint_of(document: JointDocument, studio: Studio) -> StatedJoint:
    """The joint of a document.

    Raises:
        InputError: an unknown preset or effect, a path that cannot be, stops that are missing or beyond it;
            ``field`` is the path in the document.
    """
    low, high = joint_stops(document)
    muscles, starts, notes = [], [], []
    for place, stated in enumerate(document.muscles):
        where = f"muscles.{place}"
        name = stated.name or f"muscle {place + 1}"
        muscle = stated.muscle or document.muscle
        if muscle is None:
            raise InputError(
                f"{where}.muscle is missing", field=f"{where}.muscle", hint="e.g. 'DMSP-20:300mm'"
            )
        shared = document.effects if stated.muscle is None else None
        effects = shared if stated.effects is None else stated.effects
        with fields_inside(where):
            start = studio.start_model(stated_muscle(muscle), effects)
            model = studio.slow_model(start)
            rest = float(start.muscle.nominal_length)
            path = path_of(stated.path, rest_length=rest, low=low, high=high)
        if path.disagreement is not None and path.disagreement.rms > 1e-9:
            notes.append(f"{name}: {path.disagreement.sentence}")
        muscles.append(JointMuscle(name, model, path))
        starts.append(start)
    spring, link = document.spring, document.link
    joint = Joint(
        tuple(muscles),
        low,
        high,
        spring=0.0 if spring is None else spring.stiffness,
        spring_rest=0.0 if spring is None else spring.relaxed_at,
        weight=0.0 if link is None else weight_torque(mass=link.mass, centre=link.centre),
        level_at=0.0 if link is None else link.level_at,
        friction=document.friction,
        temperature=document.temperature,
    )
    return StatedJoint(joint, tuple(starts), document.title, tuple(notes))


def joint_of_drive(document: DriveDocument, studio: Studio) -> JointDocument:
    """The joint document of a drive: of an antagonist pair on a pulley, or of a joint with paths.

    Raises:
        InputError: the drive has no joint.
    """
    load = document.load
    if load.joint is not None:
        own = load.joint.to_document()
        shared = {
            "title": document.title,
            "muscle": document.muscle.to_document(),
            "effects": document.effects,
        }
        return read_joint({**own, **shared, "temperature": document.gas.temperature})
    if load.arrangement != "antagonist" or load.pulley_radius is None:
        raise InputError(
            "this drive has no joint: its load moves along a line",
            field="load.arrangement",
            hint="an antagonist pair, a joint, or a joint document",
        )
    middle = DEFAULT_PRECONTRACTION if load.precontraction is None else load.precontraction
    start = studio.start_model(stated_muscle(document.muscle), document.effects)
    lowest, highest = stops_of(document, studio.static_model(start))
    turn = float(start.muscle.nominal_length) / load.pulley_radius
    return read_joint(
        {
            "title": document.title,
            "muscle": document.muscle.to_document(),
            "effects": document.effects,
            "muscles": [
                {"name": name, "path": {"lever": sense * load.pulley_radius, "contraction": middle}}
                for name, sense in zip(_PAIR, (1.0, -1.0), strict=True)
            ],
            "stops": {"min_angle": (lowest - middle) * turn, "max_angle": (highest - middle) * turn},
            "temperature": document.gas.temperature,
        }
    )


def read_joint(document: object, subject: str = "the joint") -> JointDocument:
    """A joint document from JSON.

    Raises:
        InputError: it is not valid; ``field`` is the path in it.
    """
    return validated(JointDocument, document, subject)


def named_joint(name: str, studio: Studio) -> JointDocument:
    """The joint of a file, or that of the drive of a file or preset.

    Raises:
        InputError: names the file, the field, what is wrong and what would be right.
    """
    path = Path(name)
    if not (path.exists() or name.lower().endswith(".json")):
        return joint_of_drive(named_document(name, studio), studio)
    refuse_table(name, "joint")
    try:
        content: Any = read_file(path, follow_links=True)
        if isinstance(content, Mapping) and kind_of(content) == "drive":
            return joint_of_drive(named_document(name, studio), studio)
        return read_joint(content)
    except BadDocumentError as bad:
        finding = bad.findings[0]
        raise InputError(f"{name}: {located(finding.field, finding.message)}", hint=finding.hint) from bad
    except InputError as error:
        raise at_file(name, error.field, error.message, error.hint) from error
