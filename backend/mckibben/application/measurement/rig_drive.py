"""The drive of one transient measurement: the document of the request with the values of its experiment."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from math import pi
from typing import Any

from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_reading import drive_of, read_document
from mckibben.documents.start_model import StartModel
from mckibben.documents.studio import Studio
from mckibben.identification.predict import driven_by_pressure, highest_stop, lowest_stop
from mckibben.measurement.experiment import FIELDS, FROM_DRIVE, LOAD_FORCE, ExperimentValue
from mckibben.measurement.measurement import Measurement
from mckibben.physics.errors import InputError
from mckibben.physics.muscle import GEOMETRY
from mckibben.physics.units import si
from mckibben.simulation.drive.parts import Drive

_SUPPLY = 6e5  # Pa, assumed where nobody says it
_MAX_CONTRACTION = 0.25  # where neither the user nor the maker states one
_STOPS = re.compile(r"\s*(\S+(?:\s*%)?)\s*(?:to|-|\.\.)\s*(\S+(?:\s*%)?)\s*")
_TUBE = re.compile(r"\s*([0-9.]+\s*[a-z]+)\s*x\s*([0-9.]+\s*[a-z]+)\s*", re.IGNORECASE)
_OWN = ("supply", "valve", "tube", "stops", "inclination")  # fields that change the drive document


def drive_values(
    measurement: Measurement,
    stated: Mapping[str, ExperimentValue],
    drive: DriveDocument | None,
    start: StartModel,
) -> dict[str, ExperimentValue]:
    """Load, supply, valve, tube, stops and inclination of a transient, as the drive document states them.

    What it leaves out is assumed as it is in a simulation.

    Args:
        measurement: the data; nothing is said of one that is not transient.
        stated: by user and file.
        drive: the document of the request.
        start: for the maker's limits.
    """
    if measurement.kind != "transient":
        return {}
    commanded = "command" in measurement.columns
    known = commanded and (drive is not None or "valve" in stated)
    values: dict[str, ExperimentValue] = {}

    def add(name: str, value: float | str, said: bool, unit: str | None = None, place: str = "") -> None:
        origin = "you" if said else "assumed"
        unit = FIELDS[name].unit if unit is None else unit
        values[name] = ExperimentValue(value, unit, origin, FROM_DRIVE if said else place)

    load = None if drive is None else drive.load
    if drive is not None and load is not None:
        said = "load" in drive.model_fields_set
        constant = load.force if isinstance(load.force, float | int) else None
        if load.mass or not constant:
            add("load", load.mass, said)
        else:
            add("load", float(constant), said, "N")
    if known:
        supply = None if drive is None else drive.supply
        said = supply is not None and "pressure" in supply.model_fields_set
        add("supply", _SUPPLY if supply is None else supply.pressure, said)
        if drive is not None:
            add("valve", drive.valve.preset or "by its flow", said=True)
        said = drive is not None and "tube" in drive.model_fields_set
        tube = None if drive is None else drive.tube
        add("tube", "none" if tube is None else tube.preset or "by its size", said)
    inclined = load is not None and bool({"inclination", "arrangement"} & load.model_fields_set)
    if not (load is not None and load.arrangement == "antagonist"):
        angle = _angle(load) if load is not None else pi / 2.0
        add("inclination", angle, inclined)
    values["stops"] = _stops(measurement, drive, start)
    return values


def _stops(measurement: Measurement, drive: DriveDocument | None, start: StartModel) -> ExperimentValue:
    """The end stops that a document states, else those assumed."""
    stops = None if drive is None else drive.stops
    limit = start.limits.max_contraction
    if drive is not None and stops is not None and "stops" in drive.model_fields_set:
        shown = _shown_stops(stops.min_contraction, stops.max_contraction or limit or _MAX_CONTRACTION)
        return ExperimentValue(shown, FIELDS["stops"].unit, "you", FROM_DRIVE)
    bare = drive is None and "command" not in measurement.columns
    return assumed_stops(measurement, start.muscle.nominal_length, limit, bare=bare)


def assumed_stops(
    measurement: Measurement | None, rest_length: float | None, limit: float | None, *, bare: bool
) -> ExperimentValue:
    """The end stops where nobody states them: none where the record is beyond them.

    Args:
        measurement: of a transient, if it is known already.
        rest_length: of the muscle [m], if it is known.
        limit: contraction that the maker allows.
        bare: the pressure was measured and no drive is stated, so that no upper stop is simulated.
    """
    low, high = 0.0, highest_stop(None, 1.0, None) if bare else limit or _MAX_CONTRACTION
    places = []
    if measurement is not None and rest_length is not None:
        if (seen := lowest_stop(measurement, rest_length)) < 0.0:
            low = seen
            places.append("lowest position of the record")
        free = highest_stop(measurement, rest_length, None if bare else high)
        if free > high:
            places.append(f"the record passes {100.0 * high:.3g} %")
        high = free
    if bare:
        places.append("no upper stop")
    elif limit is not None and high == limit:
        places.append("limit of the maker")
    return ExperimentValue(_shown_stops(low, high), FIELDS["stops"].unit, "assumed", "; ".join(places))


def _shown_stops(low: float, high: float) -> str:
    return f"{100.0 * low:.3g} % to {100.0 * high:.3g} %"


def passed_stop(
    measurement: Measurement, values: Mapping[str, ExperimentValue], rest_length: float
) -> str | None:
    """What is to be said of a stated upper stop that the record passes; None = it does not."""
    stops = values.get("stops")
    if measurement.kind != "transient" or stops is None or stops.origin == "assumed":
        return None
    high = stops_of(str(stops.value))[1]
    if highest_stop(measurement, rest_length, high) <= high:
        return None
    return (
        f"{measurement.name}: the record passes the stated end stop at {100.0 * high:.3g} % contraction, so "
        "no upper stop is simulated; check the stop, the rest length and the zero of the stroke"
    )


def _angle(load: Any) -> float:
    if load.inclination is not None:
        return float(load.inclination)
    return 0.0 if load.arrangement == "horizontal" else pi / 2.0


def own_document(
    measurement: Measurement,
    values: Mapping[str, ExperimentValue],
    document: DriveDocument | None,
    start: StartModel,
    where: str,
) -> DriveDocument | None:
    """The document of the drive of a transient measurement; None where too little is known of it.

    Args:
        measurement: the data.
        values: its experiment.
        document: of the request.
        start: for the geometry, where the experiment alone describes the drive.
        where: name of the document in errors.

    Raises:
        InputError: a value that cannot be used, naming the field of the document or the experiment.
    """
    if measurement.kind != "transient":
        return None
    if document is None:
        return _of_experiment(values, start) if "command" in measurement.columns else None
    said = _said(values)
    if not said:
        return document
    return read_document({**document.to_document(), **_document_of(said, document)}, where)


def own_drive(
    measurement: Measurement,
    values: Mapping[str, ExperimentValue],
    document: DriveDocument | None,
    start: StartModel,
    studio: Studio,
    where: str,
) -> Drive | None:
    """The drive of a transient measurement; None where none is needed, or too little is known of it.

    Args:
        measurement: the data.
        values: its experiment.
        document: of its drive (`own_document`).
        start: its muscle with the effects of the model.
        studio: presets and effects.
        where: name of the document of the request in errors.

    Raises:
        InputError: a value that cannot be used, naming the field of the document or the experiment.
    """
    if measurement.kind != "transient":
        return None
    if document is None:
        said = _said(values)
        if "command" in measurement.columns or not said.keys() & {"stops", "inclination"}:
            return None
        return _bare(measurement, said, start, studio)
    try:
        drive = drive_of(document, studio, measured=True).drive
    except InputError as error:
        raise error.at(
            f"{where}.{error.field}" if error.field and where == "drive" else error.field
        ) from error
    if "stops" not in document.model_fields_set:
        drive = replace(drive, min_contraction=lowest_stop(measurement, start.muscle.nominal_length))
    top = highest_stop(measurement, start.muscle.nominal_length, drive.max_contraction)
    return replace(drive, model=studio.static_model(start), max_contraction=top)


def _said(values: Mapping[str, ExperimentValue]) -> dict[str, ExperimentValue]:
    """The values that change the drive document."""
    return {name: values[name] for name in _OWN if name in values and _own(values[name])}


def _own(value: ExperimentValue) -> bool:
    return value.origin != "assumed" and value.where != FROM_DRIVE


def _of_experiment(values: Mapping[str, ExperimentValue], start: StartModel) -> DriveDocument | None:
    """A drive from what the experiment alone states; None without a valve or a load."""
    if "valve" not in values or "load" not in values:
        return None
    geometry = {name: float(getattr(start.muscle, name)) for name in GEOMETRY if getattr(start.muscle, name)}
    chosen = {
        name: values[name] for name in _OWN if name in values and (name != "tube" or _own(values[name]))
    }
    load: dict[str, Any] = {}
    for name in ("load", LOAD_FORCE):
        if name in values:
            load["mass" if values[name].unit == "kg" else "force"] = float(values[name].value)
    document = {"muscle": geometry, "effects": {}, "load": load, **_document_of(chosen, None)}
    document["load"] = {**load, **document["load"]}
    return read_document(document, "the experiment")


def _document_of(said: Mapping[str, ExperimentValue], document: DriveDocument | None) -> dict[str, Any]:
    """The parts of a drive document that values of an experiment state."""
    parts: dict[str, Any] = {"load": {} if document is None else document.load.to_document()}
    for name, value in said.items():
        if name == "supply":
            parts["supply"] = {"pressure": float(value.value)}
        elif name == "valve":
            parts["valve"] = {"preset": str(value.value)}
        elif name == "tube":
            parts["tube"] = _tube(str(value.value))
        elif name == "stops":
            low, high = stops_of(str(value.value))
            parts["stops"] = {"min_contraction": low, "max_contraction": high}
        elif name == "inclination":
            parts["load"]["inclination"] = float(value.value)
    return parts


def _tube(text: str) -> dict[str, Any] | None:
    if text == "none":
        return None
    size = _TUBE.fullmatch(text)
    return {"inside_diameter": size[1], "length": size[2]} if size else {"preset": text}


def stops_of(text: str) -> tuple[float, float]:
    """The contractions in "0 % to 25 %".

    Raises:
        InputError: no such text.
    """
    found = _STOPS.fullmatch(text)
    if found is None:
        raise InputError(f"'{text[:60]}' are no end stops", field="stops", hint="e.g. '0 % to 25 %'")
    return si(found[1], "1", field="stops"), si(found[2], "1", field="stops")


def _bare(
    measurement: Measurement, said: Mapping[str, ExperimentValue], start: StartModel, studio: Studio
) -> Drive:
    """The drive of a measured pressure with stops and inclination."""
    drive = replace(driven_by_pressure(measurement, start.muscle), model=studio.static_model(start))
    if "inclination" in said:
        drive = replace(drive, load=replace(drive.load, inclination=float(said["inclination"].value)))
    if "stops" in said:
        low, high = stops_of(str(said["stops"].value))
        top = highest_stop(measurement, start.muscle.nominal_length, high)
        drive = replace(drive, min_contraction=low, max_contraction=top)
    return drive
