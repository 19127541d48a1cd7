"""Ten files of habits that the reader was not made with: written before it, and scored once when it was done.

Each writer gives the bytes of a file and what is in it, in SI.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
import openpyxl
from scipy.io import savemat

from tests.measurement.reading.muscle_test import Array, isobaric, isotonic

#: What is rounded in a file, in units of its last digit.
_HALF = 0.51
GRAVITY = 9.80665
ATMOSPHERE = 101_325.0


@dataclass(frozen=True)
class LabFile:
    """A file: its name, its bytes, the channels in it in SI with the rounding of each, what it states."""

    name: str
    data: bytes
    kind: tuple[str, ...]
    channels: Mapping[str, tuple[Array, float]]
    conditions: Mapping[str, float | str] = field(default_factory=dict)
    asks: tuple[str, ...] = ()


def decimal_comma(value: float, digits: int) -> str:
    """``1234.5`` as ``1.234,50``: dots between the thousands, a comma before the decimals."""
    return f"{value:,.{digits}f}".replace(",", " ").replace(".", ",").replace(" ", ".")


def italian() -> LabFile:
    """Semicolons, thousands dots, decimal commas, Italian heads, a preamble."""
    r = isobaric(2e5, 3e5, 5e5, rest=0.3)
    rows = [
        ";".join(
            [decimal_comma(t, 2), decimal_comma(p / 100, 1), decimal_comma(x * 1e3, 2), decimal_comma(f, 2)]
        )
        for t, p, x, f in zip(r.time, r.pressure, r.stroke, r.force, strict=True)
    ]
    head = ["Prova statica muscolo pneumatico", "Operatore;Rossi", "Lunghezza a riposo;300,0;mm", ""]
    text = "\r\n".join([*head, "Tempo [s];Pressione relativa [mbar];Accorciamento [mm];Forza [N]", *rows, ""])
    channels = {
        "time": (r.time, 0.01), "pressure": (r.pressure, 10.0), "displacement": (r.stroke, 1e-5),
        "force": (r.force, 0.01),
    }  # fmt: skip
    return LabFile("prova_7.csv", text.encode(), ("isobaric",), channels, {"nominal_length": 0.3})


def scanner() -> LabFile:
    """A scanning multimeter: scan number, ISO time stamps, channel numbers, imperial units, raw volts."""
    r = isobaric(2e5, 4e5, rest=0.25)
    start = np.datetime64("2024-05-02T08:15:00.000")
    lines = ["Scan,Time stamp,101 Force cell raw (mV),102 Pressure (psig),103 Force (lbf),104 Length (in)"]
    for n in range(len(r.time)):
        stamp = str(start + np.timedelta64(round(r.time[n] * 1e3), "ms")) + "Z"
        lines.append(
            f"{n + 1},{stamp},{r.force[n] / 400:.4f},{r.pressure[n] / 6894.757293168:.3f},"
            f"{r.force[n] / 4.4482216152605:.3f},{(0.25 - r.stroke[n]) / 0.0254:.4f}"
        )
    channels = {
        "time": (r.time, 1e-3), "pressure": (r.pressure, 6.9), "force": (r.force, 4.5e-3),
        "length": (0.25 - r.stroke, 2.6e-6),
    }  # fmt: skip
    return LabFile("scan_0502.csv", "\n".join(lines).encode(), ("isobaric",), channels)


def valid_names() -> LabFile:
    """A MATLAB table written to text: its heads were made into valid names, brackets became underscores."""
    r = isobaric(1.5e5, 3e5, 4.5e5)
    lines = ["Zeit_s_,Druck_bar_,Weg_mm_,Kraft_N_,Var5"]
    lines += [
        f"{t:.1f},{p / 1e5:.5f},{x * 1e3:.3f},{f:.3f},NaN"
        for t, p, x, f in zip(r.time, r.pressure, r.stroke, r.force, strict=True)
    ]
    channels = {
        "time": (r.time, 0.1), "pressure": (r.pressure, 1.0), "displacement": (r.stroke, 1e-6),
        "force": (r.force, 1e-3),
    }  # fmt: skip
    return LabFile("T.csv", "\n".join(lines).encode(), ("isobaric",), channels)


def stacked_workbook() -> LabFile:
    """Excel: a block per pressure one below the other, each with title, head, units; remarks beside."""
    r = isobaric(2e5, 3.5e5, 5e5)
    book = openpyxl.Workbook()
    sheet = book.active
    sheet.title = "Versuche"
    sheet["A1"], sheet["A2"], sheet["B2"] = "Versuchsreihe Kennlinien", "Anfangslänge (mm):", 250
    line = 4
    for run, title in enumerate(["Druck: 2 bar", "Druck: 3,5 bar", "Druck: 5 bar"]):
        sheet.cell(line, 1, title)
        for column, (name, unit) in enumerate(
            [("Zeit", "s"), ("Hub", "mm"), ("Kraft", "N"), ("Bemerkung", None)], 1
        ):
            sheet.cell(line + 1, column, name)
            sheet.cell(line + 2, column, unit)
        line += 3
        for n in np.flatnonzero(r.run == run):
            values = [round(r.time[n], 1), round(r.stroke[n] * 1e3, 3), round(r.force[n], 2)]
            for column, value in enumerate(values, 1):
                sheet.cell(line, column, float(value))
            if n % 9 == 4:
                sheet.cell(line, 4, "Regler nachgestellt")
            line += 1
        line += 2
    stream = io.BytesIO()
    book.save(stream)
    held = np.array([2e5, 3.5e5, 5e5])[r.run]
    channels = {
        "time": (r.time, 0.1), "displacement": (r.stroke, 1e-6), "force": (r.force, 0.01),
        "pressure": (held, 1.0),
    }  # fmt: skip
    return LabFile("Versuche.xlsx", stream.getvalue(), ("isobaric",), channels, {"nominal_length": 0.25})


def french_clock() -> LabFile:
    """Times of day with milliseconds behind a comma, force in daN, French heads, tabs, Latin-1."""
    r = isobaric(2e5, 4e5, 6e5, rest=0.28)
    lines = [
        "Banc d'essai n°2",
        "Longueur à vide : 280 mm",
        "",
        "Heure\tPression\tEffort\tCourse",
        "hh:mm:ss,ms\tmbar\tdaN\tmm",
    ]
    for t, p, x, f in zip(r.time, r.pressure, r.stroke, r.force, strict=True):
        total = 10 * 3_600_000 + 59 * 60_000 + 55_000 + round(t * 1e3)
        clock = (
            f"{total // 3_600_000:02d}:{total // 60_000 % 60:02d}:{total // 1000 % 60:02d},{total % 1000:03d}"
        )
        lines.append(f"{clock}\t{p / 100:.1f}\t{f / 10:.3f}\t{x * 1e3:.2f}".replace(".", ","))
    channels = {
        "time": (r.time, 1e-3), "pressure": (r.pressure, 10.0), "force": (r.force, 0.01),
        "displacement": (r.stroke, 1e-5),
    }  # fmt: skip
    data = "\r\n".join(lines).encode("latin-1")
    return LabFile("mesure_2.txt", data, ("isobaric",), channels, {"nominal_length": 0.28})


def wide() -> LabFile:
    """A wide table: one stroke, and a force column for each pressure."""
    pressures = (1e5, 2e5, 3e5, 4e5)
    r = isobaric(*pressures)
    rows = len(r.time) // len(pressures)
    force = r.force.reshape(len(pressures), rows)
    lines = [
        "# rest length: 250 mm",
        "stroke [mm]," + ",".join(f"F @ {p / 1e5:g} bar [N]" for p in pressures),
    ]
    lines += [f"{r.stroke[n] * 1e3:.3f}," + ",".join(f"{f:.2f}" for f in force[:, n]) for n in range(rows)]
    held = np.array(pressures)[r.run]
    channels = {"displacement": (r.stroke, 1e-6), "force": (r.force, 0.01), "pressure": (held, 1.0)}
    return LabFile(
        "wide.csv", "\n".join(lines).encode(), ("isobaric", "static"), channels, {"nominal_length": 0.25}
    )


def spanish() -> LabFile:
    """Commas between quoted decimal commas, technical units, a contraction in per cent, with BOM."""
    r = isobaric(2e5, 3e5, 4e5)
    lines = ["Tiempo (s),Presión (kgf/cm2),Contracción (%),Fuerza (kgf),Observaciones"]
    for n, (t, p, x, f) in enumerate(zip(r.time, r.pressure, r.stroke, r.force, strict=True)):
        cells = [f"{t:.2f}", f"{p / (GRAVITY * 1e4):.4f}", f"{x / 0.25 * 100:.3f}", f"{f / GRAVITY:.4f}"]
        note = "inicio, sin carga" if n == 0 else ""
        lines.append(",".join(f'"{cell}"'.replace(".", ",") for cell in cells) + f',"{note}"')
    channels = {
        "time": (r.time, 0.01), "pressure": (r.pressure, 10.0), "contraction": (r.stroke / 0.25, 1e-5),
        "force": (r.force, 1e-3),
    }  # fmt: skip
    return LabFile("ensayo.csv", ("\ufeff" + "\n".join(lines)).encode(), ("isobaric",), channels)


def simulink() -> LabFile:
    """Simulink's "structure with time": signals with values and label, the units in the labels."""
    r = isobaric(2e5, 4e5)
    signals = np.empty(3, object)
    for n, (label, values) in enumerate(
        [
            ("pressure [bar]", r.pressure / 1e5),
            ("length [mm]", (0.25 - r.stroke) * 1e3),
            ("force [N]", r.force),
        ]
    ):
        signals[n] = {
            "values": values[:, None],
            "dimensions": 1.0,
            "label": label,
            "blockName": f"rig/scope{n}",
        }
    stream = io.BytesIO()
    savemat(
        stream,
        {
            "out": {"time": r.time[:, None], "signals": signals, "blockName": "rig/scope"},
            "K": np.eye(4),
            "ans": 3.0,
        },
    )
    channels = {
        "time": (r.time, 1e-9), "pressure": (r.pressure, 1e-3), "length": (0.25 - r.stroke, 1e-12),
        "force": (r.force, 1e-9),
    }  # fmt: skip
    return LabFile("scope.mat", stream.getvalue(), ("isobaric",), channels)


def aligned() -> LabFile:
    """Columns aligned by blanks, the head in a comment, as plotting programs like it."""
    r = isobaric(3e5, 5e5)
    lines = ["# rig 4, 2023-11-07", "# muscle rest length 250 mm", "#   t[s]   p[MPa]    L[cm]    F[kN]"]
    lines += [
        f"{t:8.2f} {p / 1e6:8.5f} {25.0 - x * 100:8.4f} {f / 1e3:9.6f}"
        for t, p, x, f in zip(r.time, r.pressure, r.stroke, r.force, strict=True)
    ]
    channels = {
        "time": (r.time, 0.01), "pressure": (r.pressure, 10.0), "length": (0.25 - r.stroke, 1e-6),
        "force": (r.force, 1e-3),
    }  # fmt: skip
    return LabFile("run4.dat", "\n".join(lines).encode(), ("isobaric",), channels, {"nominal_length": 0.25})


def three_heads() -> LabFile:
    """Three head lines with devices, a running number, statistics below, the load as a weight, Latin-1."""
    r = isotonic(load=10.0 * GRAVITY)
    lines = [
        "Messung vom 07.11.2023;;;;", "Ruhelänge: 250 mm;;;;", "",
        "Lfd. Nr.;Zeit;Muskeldruck;Hub;Last", ";Timer;Sensor A;Sensor B;Waage", "-;s;bar (Ü);mm;kg",
    ]  # fmt: skip
    lines += [
        f"{n + 1};{r.time[n]:.1f};{r.pressure[n] / 1e5:.4f};{r.stroke[n] * 1e3:.3f};10,00".replace(".", ",")
        for n in range(len(r.time))
    ]
    lines += ["", "MIN;0,0;1,9989;38,1;10,00", "MAX;35,0;6,0011;66,0;10,00", "MITTEL;17,5;4,0;55,0;10,00"]
    channels = {
        "time": (r.time, 0.1), "pressure": (r.pressure, 10.0), "displacement": (r.stroke, 1e-6),
        "force": (r.force, 1e-3),
    }  # fmt: skip
    data = "\r\n".join(lines).encode("latin-1")
    return LabFile("hubversuch.csv", data, ("isotonic",), channels, {"nominal_length": 0.25})


WRITERS: tuple[Callable[[], LabFile], ...] = (
    italian, scanner, valid_names, stacked_workbook, french_clock, wide, spanish, simulink, aligned,
    three_heads,
)  # fmt: skip


def differs(file: LabFile, columns: Mapping[str, Array]) -> list[str]:
    """How what was read differs from what was written, a sentence per channel; rows in any order of runs."""
    found = []
    for channel, (wanted, digit) in file.channels.items():
        if channel not in columns:
            found.append(f"{channel} is missing")
            continue
        values = np.asarray(columns[channel], float)
        if channel == "time":
            values, wanted = values - values[0], wanted - wanted[0]
        if len(values) != len(wanted):
            found.append(f"{channel}: {len(values)} rows, {len(wanted)} were written")
        elif np.max(np.abs(values - wanted)) > 1.02 * digit:
            worst = int(np.argmax(np.abs(values - wanted)))
            found.append(f"{channel}: {values[worst]:.7g} in row {worst}, {wanted[worst]:.7g} was written")
    return found
