"""A simulated run as columns and as CSV with the conditions that measurement files require."""

from __future__ import annotations

import csv
import io

import numpy as np

from mckibben.application.run.simulate import SimulationResult
from mckibben.documents.drive import DriveDocument


def trace_columns(result: SimulationResult) -> dict[str, np.ndarray]:
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


def trace_text(document: DriveDocument, result: SimulationResult) -> str:
    """The columns as CSV, with the conditions that measurement files require."""
    columns = trace_columns(result)
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
    return text.getvalue()
