"""What a comparison or diagnosis is asked about: the start model, the drive, the measurements."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from mckibben.documents.convert import given_muscle
from mckibben.documents.drive_reading import drive_of
from mckibben.documents.start_model import StartModel
from mckibben.documents.studio import Studio
from mckibben.identification.predict.fit_model import FitModel
from mckibben.measurement.points import Points, find_points, joined
from mckibben.measurement.store import MeasurementStore
from mckibben.physics.custom import CUSTOM, TERM
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.server.schemas.comparisons import ModelRequest
from mckibben.simulation.drive.parts import Drive


@dataclass(frozen=True)
class Asked:
    """A request, ready to be worked on.

    Attributes:
        start: muscle and effects.
        drive: of transient measurements.
        points: what models are fitted to.
        validation: what they are only judged by.
        free, freed: geometry and further constants that fits may change.
        noise: of the predicted channel, when it is known [SI].
    """

    start: StartModel
    points: Points
    drive: Drive | None = None
    validation: Points | None = None
    free: Sequence[str] = ()
    freed: Sequence[str] = ()
    noise: float | None = None

    def __post_init__(self) -> None:
        for name in self.free:
            if name in self.start.assumed:
                raise InputError(
                    f"the muscle's {name.replace('_', ' ')} is not known, so no fit can start from it",
                    field=f"muscle.{name}",
                    hint=f"state {name}, or leave it out of 'free'",
                )

    def fit_model(self) -> FitModel:
        """The start model as identification knows it."""
        effects = tuple(self.start.catalogue[name] for name in self.start.effects)
        return FitModel(
            self.start.muscle.checked(), effects, self.start.effects, assumed=frozenset(self.start.assumed)
        )

    def effects_json(self, fit_model: FitModel) -> dict[str, dict[str, float | str]]:
        """Effects with their values as a request takes them, a typed term with its text."""
        found: dict[str, dict[str, float | str]] = {name: dict(own) for name, own in fit_model.values.items()}
        if CUSTOM in found and self.start.term is not None:
            found[CUSTOM] = {TERM: self.start.term, **found[CUSTOM]}
        return found


def asked(request: ModelRequest, studio: Studio, store: MeasurementStore) -> Asked:
    """Look up what a request names.

    Raises:
        InputError: an unknown preset, effect, parameter or measurement, or no model or data at all.
    """
    drive = None
    if request.drive is not None:
        document = request.drive.model_copy(
            update={
                name: value
                for name, value in (("muscle", request.muscle), ("effects", request.effects))
                if value is not None
            }
        )
        try:
            given = drive_of(document, studio, measured=True)
        except InputError as error:
            field = error.field or ""
            inside = field if field.startswith(("muscle", "effects")) else f"drive.{field}".rstrip(".")
            raise InputError(error.message, field=inside, hint=error.hint, code=error.code) from error
        drive, start = given.drive, given.start
    elif request.muscle is not None:
        start = studio.start_model(given_muscle(request.muscle), request.effects)
    else:
        raise InputError("a muscle or a drive is needed", field="muscle", hint='e.g. {"preset": "DMSP-20"}')
    studio.static_model(start)  # refuses values and a geometry that cannot be
    _check_freed(request.freed, start)
    used: dict[str, list[Points]] = {"fit": [], "validation": []}
    for place, item in enumerate(request.chosen()):
        try:
            used[item.use].append(find_points(item.id, library=studio.library, store=store))
        except InputError as error:
            field = "measurement" if request.measurement is not None else f"measurements.{place}.id"
            raise InputError(error.message, field=field, hint=error.hint, code=error.code) from error
    if not used["fit"]:
        raise InputError("no measurement to fit to", field="measurements", hint='give one the use "fit"')
    validation = joined(used["validation"]) if used["validation"] else None
    return Asked(start, joined(used["fit"]), drive, validation, request.free, request.freed, request.noise)


def _check_freed(freed: Sequence[str], start: StartModel) -> None:
    known = {f"{effect.id}.{p.name}" for effect in start.catalogue.values() for p in effect.parameters}
    for place, name in enumerate(freed):
        if name not in known:
            own = {each for each in known if each.startswith(name.partition(".")[0])} or known
            raise InputError(
                f"there is no constant '{name}'", field=f"freed.{place}", hint=did_you_mean(name, own)
            )
