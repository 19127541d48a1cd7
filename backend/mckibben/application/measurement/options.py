"""What the user says about measurement files: how they are to be read, and values of their experiment."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from mckibben.application.measurement.files import OPTION, said_values
from mckibben.documents.experiment import ExperimentInput
from mckibben.measurement.experiment import ExperimentValue
from mckibben.measurement.read import Correction, spoken_correction
from mckibben.physics.errors import InputError, did_you_mean

# What may answer a question of the file while it is read.
_CONDITIONS = ("force_zero", "pressure_zero", "inclination", "valve", "tube", "stops", "fixed_end")


@dataclass(frozen=True)
class FileOptions:
    """What the options say about the files.

    Attributes:
        correction: how they are to be read.
        said: values of the experiment of all measurements.
    """

    correction: Correction
    said: Mapping[str, ExperimentValue]


def file_options(
    *,
    sheet: str | None,
    head: int | None,
    columns: Sequence[str] | None,
    ignored: Sequence[str] | None,
    rest_length: str | float | None,
    load: str | float | None,
    supply: str | float | None,
    accuracy: str | None,
    experiment: Sequence[str] | Mapping[str, object] | None,
    strict: bool,
    prefix: str = OPTION,
) -> FileOptions:
    """What these options say about the files and their experiment.

    Args:
        sheet, head, columns, ignored, rest_length, load, supply, strict: see `spoken_correction`.
        accuracy: standard deviation by channel in words.
        experiment: further fields, as "field=value" or field -> value.
        prefix: of the names in messages, `OPTION` or `ARGUMENT`.

    Raises:
        InputError: names the option, what is wrong and what would be right.
    """
    correction = spoken_correction(
        sheet=sheet,
        head=head,
        columns=columns or (),
        ignore=ignored or (),
        rest_length=rest_length,
        load=load,
        supply=supply,
        strict=strict,
        prefix=prefix,
    )
    options = {"rest_length": rest_length, "load": load, "supply": supply, "accuracy": accuracy}
    given = _experiment(experiment or (), prefix)
    given |= {name: value for name, value in options.items() if value is not None}
    said = said_values(given, prefix)
    conditions = dict(correction.conditions)
    conditions |= {name: said[name].value for name in _CONDITIONS if name in said}
    if accuracy is not None:
        conditions["accuracy"] = accuracy
    return FileOptions(replace(correction, conditions=conditions), said)


def _experiment(stated: Sequence[str] | Mapping[str, object], prefix: str) -> dict[str, object]:
    """Field -> value of the further fields."""
    if isinstance(stated, Mapping):
        for name in stated:
            _check_field(str(name), f"{prefix}experiment {name!r}")
        return dict(stated)
    given: dict[str, object] = {}
    for text in stated:
        where = f"{prefix}experiment {text!r}"
        name, separator, value = (part.strip() for part in text.partition("="))
        if not separator or not value:
            raise InputError(
                f"{where}: is not 'field=value'", hint=f'e.g. {prefix}experiment "force_zero=2.5 N"'
            )
        _check_field(name, where)
        given[name] = value
    return given


def _check_field(name: str, where: str) -> None:
    if name not in ExperimentInput.model_fields:
        raise InputError(
            f"{where}: there is no field '{name}'", hint=did_you_mean(name, ExperimentInput.model_fields)
        )
