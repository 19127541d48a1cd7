"""Makes the measurements of `presets/examples` that are computed: `python -m tests.benchmarks.example_files`.

The muscle is the ideal one with effects of ours, the Dahl loops follow a formula written out here, the drive
runs through our engine; noise is added. Nothing of it was measured, and the head of each file says so.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import mckibben as mk
from mckibben.resources import presets_folder

FOLDER = presets_folder() / "examples"
LENGTH = 0.3  # m
_MADE = "Computed by mckibben and given noise; not measured."
_Column = tuple[str, NDArray[np.float64], int]


def _write(
    path: Path, head: list[str], columns: list[_Column], separator: str = ",", comma: str = "."
) -> None:
    rows = [separator.join(name for name, _, _ in columns)]
    for row in zip(*(values for _, values, _ in columns), strict=True):
        texts = (f"{value:.{digits}f}" for value, (_, _, digits) in zip(row, columns, strict=True))
        rows.append(separator.join(text.replace(".", comma) for text in texts))
    path.write_text("\n".join([*(f"# {line}" for line in head), *rows]) + "\n", "utf-8")


def _stroke(points: int) -> NDArray[np.float64]:
    """Contraction there and back."""
    there = np.linspace(0.0, 0.22, points)
    return np.concatenate([there, there[::-1]])


def _map(levels: list[float], seed: int, stiffness: float = 0.42e6) -> dict[str, NDArray[np.float64]]:
    """A force map at constant pressures: rubber and dry friction of a DMSP-20 that is ideal but for them."""
    noise = np.random.default_rng(seed)
    muscle = (
        mk.Model.preset("DMSP-20", length=LENGTH)
        .ideal()
        .with_effect("bladder_elasticity", shear_modulus=stiffness)
        .with_effect("coulomb_friction", force=14.0)
    )
    contraction = _stroke(40)
    direction = np.repeat([-1.0, 1.0], 40)
    pressure = np.repeat(levels, contraction.size)
    contraction, direction = np.tile(contraction, len(levels)), np.tile(direction, len(levels))
    force = muscle.force(pressure=pressure, contraction=contraction, direction=direction)
    keep = force > 0.0
    force = force + noise.normal(0.0, 2.0, force.size)
    return {
        "pressure": pressure[keep] + noise.normal(0.0, 300.0, int(keep.sum())),
        "length": LENGTH * (1.0 - contraction[keep]),
        "force": force[keep],
        "direction": direction[keep],
    }


def _maps() -> None:
    head = [
        f"Force map of a DMSP-20 of 300 mm at constant pressures. {_MADE}",
        "kind: isobaric",
        "muscle: DMSP-20",
        "rest_length: 300 mm",
    ]
    for name, levels, seed in (
        ("map", [1e5, 2e5, 3e5, 4e5, 5e5, 6e5], 1),
        ("other", [1.5e5, 3.5e5, 5.5e5], 2),
    ):
        data = _map(levels, seed)
        _write(
            FOLDER / f"{name}.csv",
            head,
            [
                ("pressure_bar", data["pressure"] / 1e5, 3),
                ("length_mm", data["length"] * 1e3, 2),
                ("force_N", data["force"], 1),
            ],
        )
    _laboratory(_map([1e5, 3e5, 5e5], 3, 0.38e6))


def _laboratory(data: dict[str, NDArray[np.float64]]) -> None:
    """The same kind of test as a German laboratory writes it down, as text and as a workbook."""
    from openpyxl import Workbook

    columns: list[_Column] = [
        ("Druck [bar]", data["pressure"] / 1e5, 3),
        ("Hub [mm]", (LENGTH - data["length"]) * 1e3, 2),
        ("Kraft [N]", data["force"], 1),
    ]
    head = [f"Kraftkennfeld, DMSP-20, 300 mm. {_MADE}", "muscle: DMSP-20", "rest_length: 300 mm"]
    _write(FOLDER / "lab.csv", head, columns, ";", ",")
    book = Workbook()
    sheet = book.worksheets[0]
    sheet.title = "Kennfeld"
    for line in head:
        sheet.append([f"# {line}"])
    sheet.append([name for name, _, _ in columns])
    for row in zip(*(values.round(digits) for _, values, digits in columns), strict=True):
        sheet.append([float(value) for value in row])
    book.save(FOLDER / "lab.xlsx")


def _loops() -> None:
    """Slow loops in time: the ideal muscle, and Dahl's law dz/dL = (1 - z sgn v)/x_b by small steps."""
    noise = np.random.default_rng(4)
    ideal = mk.Model.preset("DMSP-20", length=LENGTH).ideal()
    period, step, break_away, friction = 40.0, 0.1, 0.9e-3, 22.0
    start, share, parts = 0.0, -1.0, []
    for level in (2e5, 4e5, 6e5):
        time = np.arange(0.0, 2 * period, step)
        phase = (time / period) % 1.0
        length = LENGTH * (1.0 - 0.02 - 0.14 * (1.0 - np.abs(2.0 * phase - 1.0)))
        presliding = []
        for change in np.diff(length, prepend=length[0]):
            sign = np.sign(change)
            if sign:  # the exact solution of a step in one direction
                share = sign + (share - sign) * np.exp(-abs(change) / break_away)
            presliding.append(share)
        force = ideal.force(pressure=level, length=length) + friction * np.array(presliding)
        force = force + noise.normal(0.0, 1.0, time.size)
        parts.append(np.stack([start + time, np.full_like(time, level / 1e5), length * 1e3, force]))
        start += time[-1] + step
    time, pressure, length, force = np.concatenate(parts, axis=1)
    head = [
        f"Slow loops of length at 2, 4 and 6 bar, DMSP-20 of 300 mm. {_MADE}",
        "muscle: DMSP-20",
        "rest_length: 300 mm",
    ]
    _write(
        FOLDER / "loops.csv",
        head,
        [("time_s", time, 1), ("pressure_bar", pressure, 3), ("length_mm", length, 3), ("force_N", force, 1)],
    )


def _step() -> None:
    """Valve on, valve off: the drive of lift.json with half of the flow of its valve."""
    noise = np.random.default_rng(5)
    drive = mk.Drive.load(FOLDER / "lift.json")
    effects = {"flow_coefficient": {"factor": 0.5}}
    changed = drive.changed(effects={**drive.document["effects"], **effects})
    run = changed.run()
    time = np.arange(0.0, 3.0, 0.006)
    command = np.where(time < 1.5, 1.0, -1.0)
    position = np.interp(time, run.time, run.position) + noise.normal(0.0, 5e-5, time.size)
    pressure = np.interp(time, run.time, run.pressure) + noise.normal(0.0, 1500.0, time.size)
    head = [
        f"Valve on for 1.5 s, then off; the drive is lift.json. {_MADE}",
        "kind: transient",
        "load_mass: 12 kg",
        "supply_pressure: 6 bar",
    ]
    _write(
        FOLDER / "step.csv",
        head,
        [
            ("time_s", time, 3), ("command", command, 0), ("pressure_bar", pressure / 1e5, 3),
            ("displacement_mm", position * 1e3, 2),
        ],
    )  # fmt: skip


def main() -> None:
    """Write all of them again."""
    _maps()
    _loops()
    _step()


if __name__ == "__main__":
    main()
