"""``mckibben simulate``: transient simulation of a drive."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from mckibben.application.simulate import SimulationQuestion, SimulationResult, simulate
from mckibben.cli.output import figure, remark, write_json, write_table
from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_files import preset_document, read_document
from mckibben.documents.drive_reading import AnnotatedDrive, drive_of
from mckibben.documents.located import located
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.presets import DrivePreset
from mckibben.presets.reading import BadDocumentError, parse, read_file
from mckibben.simulation.drive.transient import segments_of
from mckibben.simulation.timing.table import PhaseFigures

_FEW_SEGMENTS = 20
# Name of a figure, its field in the timing table, factor and unit.
_SHOWN: tuple[tuple[str, Callable[[PhaseFigures], float | None], str, float, str], ...] = (
    ("positioning time", lambda phase: phase.positioning_time, "positioning_time", 1e3, "ms"),
    ("rise time 10-90 %", lambda phase: phase.rise_time, "rise_time", 1e3, "ms"),
    ("delay time 50 %", lambda phase: phase.delay_time, "delay_time", 1e3, "ms"),
    ("settling time", lambda phase: phase.settling_time, "settling_time", 1e3, "ms"),
    ("average speed", lambda phase: phase.average_speed, "average_speed", 1.0, "m/s"),
    ("largest speed", lambda phase: phase.max_speed, "max_speed", 1.0, "m/s"),
    ("  at", lambda phase: phase.max_speed_at, "max_speed_at", 1e3, "ms"),
    ("largest acceleration", lambda phase: phase.max_acceleration, "max_acceleration", 1.0, "m/s²"),
    ("  at", lambda phase: phase.max_acceleration_at, "max_acceleration_at", 1e3, "ms"),
    ("smallest acceleration", lambda phase: phase.min_acceleration, "min_acceleration", 1.0, "m/s²"),
    ("  at", lambda phase: phase.min_acceleration_at, "min_acceleration_at", 1e3, "ms"),
    ("end speed", lambda phase: phase.end_speed, "end_speed", 1.0, "m/s"),
    ("impact energy", lambda phase: phase.impact_energy, "impact_energy", 1.0, "J"),
    ("overshoot", lambda phase: phase.overshoot, "overshoot", 100.0, "%"),
    ("pressure rise time", lambda phase: phase.pressure_rise_time, "pressure_rise_time", 1e3, "ms"),
    ("pressure delay time", lambda phase: phase.pressure_delay_time, "pressure_delay_time", 1e3, "ms"),
    (
        "pressure settling time",
        lambda phase: phase.pressure_settling_time,
        "pressure_settling_time",
        1e3,
        "ms",
    ),
    ("air", lambda phase: phase.air_mass, "air_mass", 1e3, "g"),
    ("  of it for the tube", lambda phase: phase.tube_air_mass, "tube_air_mass", 1e3, "g"),
    ("air at ANR", lambda phase: phase.air_volume_anr, "air_volume_anr", 1e3, "l"),
    ("share that flows choked", lambda phase: phase.choked_share, "choked_share", 100.0, "%"),
)


def _columns(result: SimulationResult) -> dict[str, np.ndarray]:
    """Header -> column; names as in measurement files, so that a trace can be read back."""
    columns = {
        "time_s": result.time,
        "command": result.command,
        "pressure_Pa": result.pressure,
        "displacement_m": result.position,
        "velocity_m/s": result.velocity,
        "acceleration_m/s2": result.acceleration,
        "force_N": result.force,
        "length_m": result.length,
        "diameter_m": result.diameter,
        "mass_flow_kg/s": result.mass_flow,
        "reference_m": result.reference,
    }
    return {header: column for header, column in columns.items() if column is not None}


def run(studio: Studio, *, drive: str, out: Path | None, as_json: bool) -> None:
    """Run the drive, print the timing table or the answer, write the trace.

    Raises:
        InputError: names the file, the field, what is wrong and what would be right.
    """
    document = _document(drive, studio)
    try:
        annotated = drive_of(document, studio)
        result = simulate(SimulationQuestion(annotated, engine=_engine(annotated)))
    except InputError as error:
        raise InputError(f"{drive}: {located(error.field, error.message)}", hint=error.hint) from error
    if out is not None:
        _write_trace(out, document, result)
    if as_json:
        write_json(result)
    else:
        _write_tables(drive, result)
    for notice in result.flags:
        remark(notice.message)
    if result.message is not None:
        remark(f"{result.outcome}: {result.message}")


def _engine(annotated: AnnotatedDrive) -> str:
    """The engine for a drive: loading the kernel takes 0.6 s, longer than LSODA for a few segments."""
    return "lsoda" if len(segments_of(annotated.drive)[0]) <= _FEW_SEGMENTS else "rodas"


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
            assert isinstance(preset, DrivePreset)  # noqa: S101 - parsed as one
            content = preset.document
        return read_document(content, "the drive")
    except BadDocumentError as bad:
        finding = bad.findings[0]
        raise InputError(f"{name}: {located(finding.field, finding.message)}", hint=finding.hint) from bad
    except InputError as error:
        message = located(error.field, error.message).removesuffix(".")
        raise InputError(f"{name}: {message}", hint=error.hint) from error


def _write_tables(name: str, result: SimulationResult) -> None:
    timing = result.timing
    phases = (("extend", timing.extend), ("retract", timing.retract))
    rows: list[Sequence[str]] = []
    reasons = set()
    for label, figure_of, key, factor, unit in _SHOWN:
        figures = [figure_of(phase) for _, phase in phases]
        rows.append([label, *(figure(_times(value, factor), unit=f" {unit}") for value in figures)])
        for (phase, _), value in zip(phases, figures, strict=True):
            if value is None and (why := timing.notes.get(f"{phase}.{key}")):
                reasons.add(f"{phase}: {why}")
    write_table(f"{name}: {result.outcome}", ["", "extend (fill)", "retract (exhaust)"], rows)
    for reason in sorted(reasons):
        remark(f"– {reason}")
    start = result.start
    remark(f"start at {start.position * 1e3:.4g} mm ({start.contraction * 100:.3g} %), {start.reason}")
    remark(f"air: {result.gas}")
    if (note := timing.notes.get("extend.air_mass")) is not None:
        remark(f"air mass {note}")
    follows = result.tracking
    if follows is not None:
        rows = [
            ["rms error", figure(follows.rms * 1e3, unit=" mm")],
            ["largest error", figure(follows.max * 1e3, unit=" mm")],
            ["lag", figure(_times(follows.lag, 1e3), unit=" ms")],
        ]
        write_table("Following the reference", ["", ""], rows)


def _times(value: float | None, factor: float) -> float | None:
    return None if value is None else value * factor


def _write_trace(path: Path, document: DriveDocument, result: SimulationResult) -> None:
    """Write the columns as CSV, with the conditions that measurement files require."""
    columns = _columns(result)
    text = io.StringIO()
    text.write("# kind: transient\n# pressure: gauge\n")
    if document.muscle.preset is not None:
        text.write(f"# muscle: {document.muscle.preset}:{result.geometry.nominal_length * 1e3:g}mm\n")
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
