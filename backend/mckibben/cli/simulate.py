"""``mckibben simulate``: a drive through time."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from mckibben.application.runs import grid_of
from mckibben.application.simulations import POINTS, preset_document, read_document, simulation_answer
from mckibben.application.start import Json
from mckibben.cli.options import located
from mckibben.cli.output import figure, remark, write_json, write_table
from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_reading import GivenDrive, drive_of
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.presets import DrivePreset
from mckibben.presets.reading import BadDocumentError, parse, read_file
from mckibben.simulation.drive.transient import segments_of

_FEW_SEGMENTS = 20
# Figure of the timing table -> how it is shown: name, factor, unit.
_SHOWN = {
    "positioning_time": ("positioning time", 1e3, "ms"),
    "rise_time": ("rise time 10-90 %", 1e3, "ms"),
    "delay_time": ("delay time 50 %", 1e3, "ms"),
    "settling_time": ("settling time", 1e3, "ms"),
    "average_speed": ("average speed", 1.0, "m/s"),
    "max_speed": ("largest speed", 1.0, "m/s"),
    "max_speed_at": ("  at", 1e3, "ms"),
    "max_acceleration": ("largest acceleration", 1.0, "m/s²"),
    "max_acceleration_at": ("  at", 1e3, "ms"),
    "min_acceleration": ("smallest acceleration", 1.0, "m/s²"),
    "min_acceleration_at": ("  at", 1e3, "ms"),
    "end_speed": ("end speed", 1.0, "m/s"),
    "impact_energy": ("impact energy", 1.0, "J"),
    "overshoot": ("overshoot", 100.0, "%"),
    "pressure_rise_time": ("pressure rise time", 1e3, "ms"),
    "pressure_delay_time": ("pressure delay time", 1e3, "ms"),
    "pressure_settling_time": ("pressure settling time", 1e3, "ms"),
    "air_mass": ("air", 1e3, "g"),
    "air_volume_anr": ("air at ANR", 1e3, "l"),
    "choked_share": ("valve choked", 100.0, "%"),
}
# Column of the file -> column of the answer; names as in measurement files, so a trace can be read back.
_COLUMNS = {
    "time_s": "time",
    "command": "command",
    "pressure_Pa": "pressure",
    "displacement_m": "position",
    "velocity_m/s": "velocity",
    "acceleration_m/s2": "acceleration",
    "force_N": "force",
    "length_m": "length",
    "diameter_m": "diameter",
    "mass_flow_kg/s": "mass_flow",
    "reference_m": "reference",
}


def run(studio: Studio, *, drive: str, out: Path | None, as_json: bool) -> None:
    """Run the drive, print the timing table or the answer, write the trace.

    Raises:
        InputError: names the file, the field, what is wrong and what would be right.
    """
    document = _document(drive, studio)
    try:
        grid = grid_of(duration=document.duration, begin=0.0, end=document.duration, points=POINTS)
        given = drive_of(document, studio)
        answer = simulation_answer(given, grid, engine=_engine(given))
    except InputError as error:
        raise InputError(f"{drive}: {located(error.field, error.message)}", hint=error.hint) from error
    if out is not None:
        _write_trace(out, document, answer)
    if as_json:
        write_json(answer)
    else:
        _write_tables(drive, answer)
    for item in answer["flags"]:
        remark(item["message"])
    if answer["message"] is not None:
        remark(f"{answer['outcome']}: {answer['message']}")


def _engine(given: GivenDrive) -> str:
    """The kernel takes 0.6 s to load, longer than LSODA takes for a few segments."""
    return "lsoda" if len(segments_of(given.drive)[0]) <= _FEW_SEGMENTS else "rodas"


def _document(name: str, studio: Studio) -> DriveDocument:
    """The document of a file, of a preset file, or of a preset."""
    path = Path(name)
    known = [preset.id for preset in studio.library.list("drives")]
    if name in known or not (path.exists() or name.lower().endswith(".json")):
        if name not in known:
            raise InputError(
                f"{name}: there is no such file and no such drive preset", hint=did_you_mean(name, known)
            )
        return preset_document(name, studio)
    try:
        content = read_file(path, follow_links=True)
        if isinstance(content, dict) and "kind" in content:
            preset = parse(DrivePreset, content, studio.effect_table)
            assert isinstance(preset, DrivePreset)  # noqa: S101 - it was parsed as one
            content = preset.document
        return read_document(content, "the drive")
    except BadDocumentError as bad:
        finding = bad.findings[0]
        raise InputError(f"{name}: {located(finding.field, finding.message)}", hint=finding.hint) from bad
    except InputError as error:
        message = located(error.field, error.message).removesuffix(".")
        raise InputError(f"{name}: {message}", hint=error.hint) from error


def _write_tables(name: str, answer: Json) -> None:
    timing = answer["timing"]
    rows: list[Sequence[str]] = []
    for key, (label, factor, unit) in _SHOWN.items():
        figures = [timing[phase].get(key) for phase in ("extend", "retract")]
        rows.append([label, *(figure(_times(value, factor), unit=f" {unit}") for value in figures)])
    write_table(f"{name}: {answer['outcome']}", ["", "extend (fill)", "retract (exhaust)"], rows)
    reasons = {
        f"{phase}: {why}"
        for phase in ("extend", "retract")
        for key in _SHOWN
        if timing[phase].get(key) is None and (why := timing["notes"].get(f"{phase}.{key}"))
    }
    for reason in sorted(reasons):
        remark(f"– {reason}")
    follows = answer["tracking"]
    if follows is not None:
        rows = [
            ["rms error", figure(follows["rms"] * 1e3, unit=" mm")],
            ["largest error", figure(follows["max"] * 1e3, unit=" mm")],
            ["lag", figure(_times(follows["lag"], 1e3), unit=" ms")],
        ]
        write_table("Following the reference", ["", ""], rows)


def _times(value: float | None, factor: float) -> float | None:
    return None if value is None else value * factor


def _write_trace(path: Path, document: DriveDocument, answer: Json) -> None:
    """The columns as CSV, with the conditions a reader of measurements asks for."""
    columns: dict[str, Any] = {
        header: answer[name] for header, name in _COLUMNS.items() if answer[name] is not None
    }
    text = io.StringIO()
    text.write("# kind: transient\n# pressure: gauge\n")
    if document.muscle.preset is not None:
        text.write(f"# muscle: {document.muscle.preset}:{answer['geometry']['nominal_length'] * 1e3:g}mm\n")
    text.write(
        f"# supply_pressure: {document.supply.pressure:g} Pa\n# load_mass: {document.load.mass:g} kg\n"
    )
    if isinstance(document.load.force, float) and document.load.force:
        text.write(f"# load_force: {document.load.force:g} N\n")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows([f"{value:.9g}" for value in row] for row in zip(*columns.values(), strict=True))
    try:
        path.write_text(text.getvalue(), encoding="utf-8")
    except OSError as error:
        raise InputError(f"--out {path}: cannot be written: {error.strerror or error}") from error
