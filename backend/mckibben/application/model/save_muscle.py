"""Keep a fitted model as a muscle preset of the user, with how sure it is and where it was measured."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mckibben.documents.convert import stated_muscle
from mckibben.documents.saved_model import SavedModel, fit_record
from mckibben.documents.studio import Studio
from mckibben.physics.custom import CUSTOM
from mckibben.physics.errors import InputError
from mckibben.physics.muscle import GEOMETRY
from mckibben.presets import MusclePreset

_UNITS = {name: "rad" if name == "braid_angle" else "m" for name in GEOMETRY}
_SAME = 1e-9  # relative difference below which a value is that of the preset it started from
_LONGEST_SOURCE = 300
_NOT_FITTED = "of the model, not fitted"
#: What a preset has from the one that its model started from: nothing of it was fitted.
_INHERITED = (
    "maker",
    "series",
    "tolerance",
    "limits",
    "data",
    "reference_curve",
    "measurement",
    "references",
)


def keep(saved: SavedModel, studio: Studio, *, id: str, title: str = "") -> MusclePreset:
    """Save a fitted model as a muscle of the user.

    Args:
        saved: the model.
        studio: presets.
        id: of the new preset; one of the user with this id is replaced.
        title: its name for display; "" = the id.

    Raises:
        InputError: a model with a typed term, or without a length; an id that cannot be used (``field`` id).
    """
    return studio.library.save_muscle(preset_document(saved, studio, id=id, title=title or id))


def preset_document(saved: SavedModel, studio: Studio, *, id: str, title: str) -> dict[str, Any]:
    """The muscle preset of a fitted model as a document.

    Geometry and parameters that the fit did not change keep their sources; limits are those of the preset
    that the model started from.

    Raises:
        InputError: as `keep`, but for the id.
    """
    if CUSTOM in saved.effects:
        raise InputError(
            "a model with a typed term cannot be a preset", field="effects.custom",
            hint="save it as a model (JSON), which keeps the term",
        )  # fmt: skip
    base = None if saved.muscle.preset is None else studio.library.muscle(saved.muscle.preset)
    if saved.muscle.nominal_length is None and base is None:
        raise InputError(
            "the model is one of muscles of several lengths and has none of its own",
            field="muscle.nominal_length",
            hint="state the length that the preset shall have",
        )
    start = studio.start_model(stated_muscle(saved.muscle), saved.effects)
    before = None if base is None else studio.facts(base.id)
    stated = {} if base is None else base.to_document()
    source = _source(saved)
    record = fit_record(saved)

    catalogue = start.catalogue

    def quantity(
        value: float, unit: str, old: float | None, said: Mapping[str, Any] | None, *, fitted: bool
    ) -> dict[str, Any]:
        """The value with its old source where it is unchanged, else with that of the model."""
        if said is not None and old is not None and abs(value - old) <= _SAME * abs(old):
            return dict(said)
        return {"value": value, "unit": unit, "source": source if fitted else _NOT_FITTED, "grade": "user"}

    return {
        "schema": 1,
        "kind": "muscle",
        "id": id,
        "title": title,
        **{name: stated[name] for name in _INHERITED if name in stated},
        "description": "A muscle by its geometry." if base is None else f"Based on {base.title}.",
        "geometry": {
            name: quantity(
                value,
                _UNITS[name],
                None if before is None else getattr(before.muscle, name),
                stated.get("geometry", {}).get(name),
                fitted=name in saved.free,
            )
            for name, value in start.muscle._asdict().items()
            if value
        },
        "effects": {
            effect: {
                name: quantity(
                    value,
                    catalogue[effect].parameter(name).unit,
                    None if before is None else before.effects.get(effect, {}).get(name),
                    stated.get("effects", {}).get(effect, {}).get(name),
                    fitted=catalogue[effect].parameter(name).fitted or f"{effect}.{name}" in saved.freed,
                )
                for name, value in values.items()
            }
            for effect, values in start.effects.items()
        },
        **({} if record is None else {"fit": record.model_dump(mode="json", exclude_none=True)}),
    }


def _source(saved: SavedModel) -> str:
    files = [] if saved.origin is None else [file.name for file in saved.origin.files]
    if not files:
        return "from a saved model"
    named = f"fitted to {', '.join(files)}"
    return named if len(named) <= _LONGEST_SOURCE else f"fitted to {len(files)} measurements"
