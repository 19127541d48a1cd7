"""The use case: an order code in, the preset, length and meaning of its parts out."""

from __future__ import annotations

from mckibben.documents.studio import Studio
from mckibben.facts.result import result_class
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.presets.order_code import order_code


@result_class
class CodePart:
    """A part of an order code as it is written, and what it means."""

    text: str
    """As it stands in the code."""
    meaning: str
    """What it means."""


@result_class
class OrderedMuscle:
    """What an order code says."""

    code: str
    """As it was given."""
    preset: str
    """Id of the muscle preset of its series and diameter."""
    nominal_length: float
    """Length that it states [m]."""
    parts: tuple[CodePart, ...]
    """Its parts, and what each means."""


def ordered_muscle(text: str, studio: Studio) -> OrderedMuscle:
    """The muscle that an order code names.

    Raises:
        InputError: a part is not understood; the field names its place between the hyphens, "code.2".
    """
    text = text.strip()
    presets = {preset.id: preset for preset in studio.library.list("muscles")}
    code = order_code(text, presets)
    if code is None:
        series, _, rest = text.partition("-")
        known = {preset.partition("-")[0] for preset in presets}
        if series.upper() in known:
            missing = "nominal length" if rest else "inside diameter and nominal length"
            raise InputError(
                f"the order code {text} ends before its {missing}",
                field="code",
                hint="e.g. DMSP-20-300N-RM-CM or MAS-10-N-100-AA-MCFK",
            )
        raise InputError(
            f"'{series}' in the order code {text} is no series of muscles",
            field="code.0",
            hint=did_you_mean(series, known),
        )
    series, size = code.preset.split("-", 1)
    length = f"{code.length * 1e3:.4g} mm"
    parts = (
        CodePart(series, f"series: {presets[code.preset].title}"),
        CodePart(size, f"inside diameter {size} mm"),
        CodePart(f"{code.length * 1e3:.0f}N", f"nominal length {length}"),
        *(CodePart(*each) for each in zip(code.further, code.meanings, strict=True)),
    )
    return OrderedMuscle(text, code.preset, code.length, parts)
