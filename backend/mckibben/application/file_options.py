"""What the user says about measurement files: how they are to be read, and values of their experiment."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from mckibben.application.measurement_files import said_values
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
    rest_length: str | None,
    load: str | None,
    supply: str | None,
    accuracy: str | None,
    experiment: Sequence[str] | None,
    strict: bool,
) -> FileOptions:
    """What these options say about the files and their experiment.

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
    )
    said = _said(rest_length=rest_length, load=load, supply=supply, accuracy=accuracy, experiment=experiment)
    conditions = dict(correction.conditions)
    conditions |= {name: said[name].value for name in _CONDITIONS if name in said}
    if accuracy is not None:
        conditions["accuracy"] = accuracy
    return FileOptions(replace(correction, conditions=conditions), said)


def _said(
    *,
    rest_length: str | None,
    load: str | None,
    supply: str | None,
    accuracy: str | None,
    experiment: Sequence[str] | None,
) -> Mapping[str, ExperimentValue]:
    given: dict[str, str] = {}
    for text in experiment or ():
        name, separator, value = (part.strip() for part in text.partition("="))
        if not separator or not value:
            raise InputError(
                f"--experiment {text!r}: is not 'field=value'", hint='e.g. --experiment "force_zero=2.5 N"'
            )
        if name not in ExperimentInput.model_fields:
            raise InputError(
                f"--experiment {text!r}: there is no field '{name}'",
                hint=did_you_mean(name, ExperimentInput.model_fields),
            )
        given[name] = value
    options = {"rest_length": rest_length, "load": load, "supply": supply, "accuracy": accuracy}
    given |= {name: value for name, value in options.items() if value is not None}
    return said_values(given, "--")
