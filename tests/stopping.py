"""A transient record, and a limit of steps that its runs do not keep to."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.predict import moving_records

ROWS, SECONDS, STEPS = 300, 10.0, 200


def record() -> str:
    """A load on a muscle whose pressure swings faster and faster; few rows, so that curves show all."""
    time = np.linspace(0.0, SECONDS, ROWS)
    pressure = 300.0 + 200.0 * np.sin(2.0 * np.pi * (0.1 + 0.05 * time) * time)
    stroke = 60.0 * (1.0 - np.exp(-pressure / 180.0))
    rows = (f"{t:.4f},{p:.2f},{s:.3f}" for t, p, s in zip(time, pressure, stroke, strict=True))
    return "\n".join(["time [s],pressure [kPa],stroke [mm]", *rows]) + "\n"


def stop_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let every run of a record end after `STEPS` steps."""
    monkeypatch.setattr(moving_records, "MAX_STEPS", STEPS)
    monkeypatch.setattr(moving_records, "_STEPS_EACH", 0)
