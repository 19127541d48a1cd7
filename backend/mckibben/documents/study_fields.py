"""Fields of a document by their path: unit, stated value, and the document with other values in them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import NoneType
from typing import Annotated, Any, get_args, get_origin

from pydantic import BaseModel

from mckibben.documents.drive import AsGiven
from mckibben.documents.quantity import QuantityField
from mckibben.documents.signals import SignalInput, key_units
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.parameter import Parameter
from mckibben.physics.units import si

EffectTable = Mapping[str, Mapping[str, Parameter]]


@dataclass(frozen=True, slots=True)
class StudyField:
    """A field of a document.

    Attributes:
        path: its keys, joined by dots.
        unit: SI unit; None if it is no quantity, as the id of a preset.
        stated: its value in SI in the document, or its default; None without either.
        as_text: whether a plain number in the document would not be in SI.
    """

    path: str
    unit: str | None
    stated: float | None = None
    as_text: bool = False

    def written(self, value: float | str) -> float | str | int:
        """The value in SI as it stands in the document."""
        if isinstance(value, str):
            return value
        if self.unit is None and float(value).is_integer():
            return int(value)
        return f"{value!r} {self.unit}" if self.as_text else value


def with_values(content: Mapping[str, Any], values: Mapping[str, object]) -> dict[str, Any]:
    """The document with these values at their paths; the original and its other parts are shared.

    Raises:
        InputError: a part on the way is not an object.
    """
    result = dict(content)
    for path, value in values.items():
        *parents, last = path.split(".")
        place = result
        for step in parents:
            inner = place.get(step, {})
            if not isinstance(inner, Mapping):
                raise InputError(f"{step} of the subject is no object", field=path)
            place[step] = dict(inner)
            place = place[step]
        place[last] = value
    return result


def field_at(
    path: str, model: type[BaseModel], content: Mapping[str, Any], effects: EffectTable
) -> StudyField:
    """The field at a path.

    Args:
        path: as in a study, "load.mass".
        model: the model of the document.
        content: the document.
        effects: effect id -> parameter name -> parameter.

    Raises:
        InputError: there is no such field (with the nearest match), or it cannot be varied.
    """
    steps = path.split(".")
    if steps[0] == "effects" and "effects" in model.model_fields:
        return _effect_field(path, steps[1:], content.get("effects") or {}, effects)
    annotations: list[tuple[Any, Sequence[Any]]] = [(model, ())]
    value: Any = content
    for place, step in enumerate(steps):
        for _, metadata in annotations:
            signal = next((item for item in metadata if isinstance(item, SignalInput)), None)
            if signal is not None and isinstance(value, Mapping):
                return _signal_field(path, steps[place:], value, signal)
        models = [kind for kind, _ in annotations if isinstance(kind, type) and issubclass(kind, BaseModel)]
        known = {field.alias or name: field for kind in models for name, field in kind.model_fields.items()}
        if step not in known:
            raise InputError(f"the subject has no field {path}", hint=did_you_mean(step, known))
        value = value.get(step) if isinstance(value, Mapping) else None
        if value is None and place == len(steps) - 1 and not known[step].is_required():
            value = known[step].get_default()
        annotations = list(_parts(known[step].annotation, known[step].metadata))
    quantity = next(
        (item for _, metadata in annotations for item in metadata if isinstance(item, QuantityField)), None
    )
    if quantity is not None:
        return _quantity_field(path, quantity, value)
    signal = next((item for _, meta in annotations for item in meta if isinstance(item, SignalInput)), None)
    if signal is not None and signal.plain and not isinstance(value, Mapping):
        return StudyField(path, signal.unit, None if value is None else si(value, signal.unit))
    if any(isinstance(kind, type) and issubclass(kind, BaseModel) for kind, _ in annotations):
        raise InputError(f"{path} is a part of the subject, not one value", hint=_inside(path, annotations))
    if isinstance(value, int | float) and not isinstance(value, bool):
        return StudyField(path, None, float(value))
    return StudyField(path, None)


def stated_paths(model: type[BaseModel], content: Mapping[str, Any], effects: EffectTable) -> Iterator[str]:
    """Paths of the values in a document, and of fields that have a default in parts that always exist.

    Not every one of them can be varied; `field_at` says.
    """
    for name, field in model.model_fields.items():
        path = field.alias or name
        value = content.get(path)
        if path == "effects":
            for effect in value or {}:
                yield from (f"effects.{effect}.{parameter}" for parameter in effects.get(effect, {}))
            continue
        parts = list(_parts(field.annotation, field.metadata))
        inner = [kind for kind, _ in parts if isinstance(kind, type) and issubclass(kind, BaseModel)]
        if any(isinstance(item, SignalInput) for _, metadata in parts for item in metadata):
            yield from (f"{path}.{key}" for key in value) if isinstance(value, Mapping) else (path,)
        elif not inner:
            yield path
        elif isinstance(value, Mapping) or (value is None and not any(kind is NoneType for kind, _ in parts)):
            yield from (
                f"{path}.{rest}"
                for rest in dict.fromkeys(
                    rest for kind in inner for rest in stated_paths(kind, value or {}, effects)
                )
            )


def _parts(annotation: Any, metadata: Sequence[Any]) -> Iterator[tuple[Any, Sequence[Any]]]:
    """The types in an annotation, each with its metadata."""
    origin = get_origin(annotation)
    if origin is Annotated:
        inner, *more = get_args(annotation)
        yield from _parts(inner, [*metadata, *more])
    elif get_args(annotation) and origin is not dict and origin is not list:
        for inner in get_args(annotation):
            yield from _parts(inner, metadata)
    else:
        yield annotation, metadata


def _inside(path: str, annotations: Sequence[tuple[Any, Sequence[Any]]]) -> str | None:
    names = [
        f"{path}.{field.alias or name}"
        for kind, _ in annotations
        if isinstance(kind, type) and issubclass(kind, BaseModel)
        for name, field in kind.model_fields.items()
    ]
    return f"e.g. {names[0]}" if names else None


def _quantity_field(path: str, quantity: QuantityField, value: object) -> StudyField:
    as_text = isinstance(quantity, AsGiven)
    plain = isinstance(value, int | float)
    if value is None or (as_text and plain):  # a plain gain is not in SI
        return StudyField(path, quantity.unit, None, as_text)
    return StudyField(path, quantity.unit, si(value, quantity.unit, reference=quantity.reference), as_text)


def _signal_field(
    path: str, steps: Sequence[str], value: Mapping[str, Any], signal: SignalInput
) -> StudyField:
    units = key_units(str(value.get("shape")), signal.unit)
    if len(steps) != 1 or steps[0] not in units:
        raise InputError(f"the signal has no quantity {path}", hint=did_you_mean(steps[-1], units))
    stated = value.get(steps[0])
    unit = units[steps[0]]
    return StudyField(path, unit, None if stated is None else si(stated, unit))


def _effect_field(
    path: str, steps: Sequence[str], own: Mapping[str, Mapping[str, Any]], effects: EffectTable
) -> StudyField:
    if len(steps) != 2:
        raise InputError(f"{path} is not one parameter of an effect", hint="effects.<id>.<parameter>")
    effect, name = steps
    if effect not in own:
        hint = did_you_mean(effect, own) if own else "the model of the subject is ideal: add the effect there"
        raise InputError(f"the model of the subject has no effect {effect}", hint=hint)
    parameters = effects.get(effect, {})
    if name not in parameters:
        raise InputError(f"{effect} has no parameter {name}", hint=did_you_mean(name, parameters))
    parameter = parameters[name]
    stated = own[effect].get(name, parameter.default)
    return StudyField(path, parameter.unit, si(stated, parameter.unit))
