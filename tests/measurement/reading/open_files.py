"""Files that leave something open: what each must ask, and the option that answers it."""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import openpyxl

from tests.measurement.reading.muscle_test import Array, Readings, isobaric, isotonic

ATMOSPHERE = 101_325.0


@dataclass(frozen=True)
class OpenFile:
    """A file: its name and bytes, what it asks about, the options that answer it, what is right then.

    Attributes:
        name: of the file.
        data: its bytes.
        about: the questions, as the preview names them.
        stops: whether the file is refused without an answer.
        options: of the command line, that answer.
        channel: one whose values the answer decides, with them in SI; None = none does.
    """

    name: str
    data: bytes
    about: tuple[str, ...]
    stops: bool
    options: tuple[str, ...] = ()
    channel: tuple[str, Array] | None = None


def text(head: Sequence[str], *columns: Array | Sequence[str], digits: int = 4) -> bytes:
    """A CSV file."""
    rows = zip(*columns, strict=True)
    lines = [
        ",".join(cell if isinstance(cell, str) else f"{cell:.{digits}f}" for cell in row) for row in rows
    ]
    return "\n".join([",".join(head), *lines]).encode()


def _isobaric(**options: float) -> Readings:
    return isobaric(2e5, 3e5, 4e5, **options)  # type: ignore[arg-type]


def no_unit() -> OpenFile:
    """A pressure in bar, of which nothing says so."""
    r = _isobaric()
    data = text(
        ["time_s", "pressure", "length_mm", "force_N"],
        r.time,
        r.pressure / 1e5,
        250 - r.stroke * 1e3,
        r.force,
    )
    return OpenFile(
        "a.csv",
        data,
        ("unit of pressure",),
        True,
        ("--column", "pressure=pressure [bar]"),
        ("pressure", r.pressure),
    )


def bare_psi() -> OpenFile:
    """A pressure in psi as bare numbers."""
    r = _isobaric()
    data = text(
        ["t [s]", "p", "x [mm]", "F [N]"], r.time, r.pressure / 6894.757293168, r.stroke * 1e3, r.force
    )
    answer = ("--column", "pressure=p [psi]", "--rest-length", "250 mm")
    return OpenFile(
        "b.csv", data, ("unit of pressure", "rest length"), True, answer, ("pressure", r.pressure)
    )


def no_rest_length() -> OpenFile:
    """A stroke, and no length of the muscle."""
    r = _isobaric()
    data = text(
        ["time_s", "pressure_bar", "stroke_mm", "force_N"], r.time, r.pressure / 1e5, r.stroke * 1e3, r.force
    )
    return OpenFile(
        "c.csv", data, ("rest length",), False, ("--rest-length", "250 mm"), ("displacement", r.stroke)
    )


def no_load() -> OpenFile:
    """A muscle that lifts a weight, of which nothing is said."""
    r = isotonic()
    data = text(["time_s", "pressure_bar", "length_mm"], r.time, r.pressure / 1e5, 250 - r.stroke * 1e3)
    return OpenFile("d.csv", data, ("load",), False, ("--load", "10 kg"), ("pressure", r.pressure))


def milliseconds() -> OpenFile:
    """Milliseconds that are called seconds."""
    r = _isobaric(step=0.019)
    data = text(
        ["t (s)", "p (bar)", "L (mm)", "F (N)"], r.time * 1e3, r.pressure / 1e5, 250 - r.stroke * 1e3, r.force
    )
    return OpenFile("e.csv", data, ("unit of time",), True, ("--column", "time=t [ms]"), ("time", r.time))


def absolute() -> OpenFile:
    """A pressure that shows the air outside at rest."""
    r = isobaric(0.0, 2e5, 4e5)
    force = np.where(r.run == 0, 0.3 * np.sin(np.arange(len(r.force))), r.force)
    data = text(
        ["time_s", "pressure_bar", "length_mm", "force_N"],
        r.time,
        (r.pressure + ATMOSPHERE) / 1e5,
        250 - r.stroke * 1e3,
        force,
    )
    answer = ("--column", "pressure=pressure [bar(a)]")
    return OpenFile("f.csv", data, ("reference of pressure",), True, answer, ("pressure", r.pressure))


def second_force() -> OpenFile:
    """Two force sensors; one of them bears the guide as well."""
    r = _isobaric()
    data = text(
        ["Zeit [s]", "Druck [bar]", "Länge [mm]", "Kraft oben [N]", "Kraft unten [N]"],
        r.time, r.pressure / 1e5, 250 - r.stroke * 1e3, r.force + 40.0 * np.sin(r.time), r.force,
    )  # fmt: skip
    return OpenFile(
        "g.csv", data, ("second force",), True, ("--column", "force=Kraft unten"), ("force", r.force)
    )


def two_specimens() -> OpenFile:
    """The readings of two muscles in one table."""
    r = _isobaric()
    names = ["M1" if run < 1 else "M2" for run in r.run]
    data = text(
        ["muscle", "pressure_bar", "length_mm", "force_N"],
        names,
        r.pressure / 1e5,
        250 - r.stroke * 1e3,
        r.force,
    )
    return OpenFile("h.csv", data, ("specimens",), True, ("--ignore", "muscle"), ("force", r.force))


def crosshead() -> OpenFile:
    """The crosshead's way beside that of the muscle, under a name that tells nothing."""
    r = _isobaric()
    data = text(
        ["time_s", "pressure_bar", "length_mm", "force_N", "Traverse [mm]"],
        r.time, r.pressure / 1e5, 250 - r.stroke * 1e3, r.force, r.stroke * 1e3 + r.force / 500,
    )  # fmt: skip
    return OpenFile(
        "i.csv", data, ("column 'Traverse'",), True, ("--ignore", "Traverse"), ("length", 0.25 - r.stroke)
    )


def compression() -> OpenFile:
    """A force that is negative when the muscle pulls."""
    r = _isobaric()
    data = text(
        ["time_s", "pressure_bar", "length_mm", "force_kN"],
        r.time,
        r.pressure / 1e5,
        250 - r.stroke * 1e3,
        -r.force / 1e3,
        digits=6,
    )
    return OpenFile(
        "j.csv", data, ("sign of force",), False, ("--column", "force=-force [kN]"), ("force", r.force)
    )


def descending() -> OpenFile:
    """A position that falls as the muscle shortens."""
    r = _isobaric()
    data = text(
        ["time_s", "pressure_bar", "position_mm", "force_N"],
        r.time,
        r.pressure / 1e5,
        60 - r.stroke * 1e3,
        r.force,
    )
    answer = ("--column", "length=position [mm]")
    return OpenFile(
        "k.csv", data, ("zero of displacement", "rest length"), True, answer, ("length", 0.06 - r.stroke)
    )


def two_sheets() -> OpenFile:
    """Two sheets with the same table, which differ in nothing that their names tell."""
    book = openpyxl.Workbook()
    runs = [_isobaric(seed=seed) for seed in (1, 2)]
    for title, r in zip(("neu", "nach 1000 Zyklen"), runs, strict=True):
        sheet = book.create_sheet(title)
        sheet.append(["Zeit [s]", "Druck [bar]", "Länge [mm]", "Kraft [N]"])
        for row in zip(r.time, r.pressure / 1e5, 250 - r.stroke * 1e3, r.force, strict=True):
            sheet.append([float(value) for value in row])
    stream = io.BytesIO()
    book.save(stream)
    answer = ("--sheet", "nach 1000 Zyklen")
    return OpenFile("l.xlsx", stream.getvalue(), ("sheet",), True, answer, ("force", runs[1].force))


def impossible() -> OpenFile:
    """A pressure of hundreds of bar: it is in kPa."""
    r = _isobaric()
    data = text(
        ["time_s", "pressure_bar", "length_mm", "force_N"],
        r.time,
        r.pressure / 1e3,
        250 - r.stroke * 1e3,
        r.force,
    )
    return OpenFile(
        "m.csv",
        data,
        ("unit of pressure",),
        True,
        ("--column", "pressure=pressure [kPa]"),
        ("pressure", r.pressure),
    )


def long_stroke() -> OpenFile:
    """A stroke of 50 m without unit: it is in mm."""
    r = _isobaric()
    data = text(
        ["time_s", "pressure_bar", "stroke", "force_N"], r.time, r.pressure / 1e5, r.stroke * 1e3, r.force
    )
    answer = ("--column", "displacement=stroke [mm]", "--rest-length", "0.25 m")
    return OpenFile(
        "n.csv", data, ("unit of displacement", "rest length"), True, answer, ("displacement", r.stroke)
    )


def untared() -> OpenFile:
    """A force sensor that shows 60 N at rest."""
    r = isobaric(0.0, 2e5, 4e5)
    resting = np.where((r.run == 0), 0.0, r.force) + 60.0
    stroke = np.where(r.run == 0, 0.0, r.stroke)
    data = text(
        ["time_s", "pressure_bar", "stroke_mm", "force_N"], r.time, r.pressure / 1e5, stroke * 1e3, resting
    )
    answer = ("--experiment", "force_zero=60 N", "--rest-length", "250 mm")
    return OpenFile("o.csv", data, ("zero of force", "rest length"), False, answer, ("force", resting))


def held_pressure() -> OpenFile:
    """A loop at one pressure, which nothing states."""
    r = isobaric(2.5e5)
    data = text(["stroke_mm", "force_N"], r.stroke * 1e3, r.force)
    answer = ("--column", "pressure=2.5 bar", "--rest-length", "250 mm")
    return OpenFile(
        "p.csv", data, ("held pressure", "rest length"), True, answer, ("pressure", 2.5e5 + 0 * r.force)
    )


def levels() -> OpenFile:
    """Loops at three pressures that are called by words."""
    r = _isobaric()
    nominal = np.round(r.pressure / 1e5)
    words = [("low", "mid", "high")[int(p) - 2] for p in nominal]
    data = text(["pressure step", "length_mm", "force_N"], words, 250 - r.stroke * 1e3, r.force)
    answer = ("--column", "pressure=pressure step [low = 2, mid = 3, high = 4 bar]")
    return OpenFile("q.csv", data, ("levels of pressure",), True, answer, ("pressure", nominal * 1e5))


WRITERS: tuple[Callable[[], OpenFile], ...] = (
    no_unit, bare_psi, no_rest_length, no_load, milliseconds, absolute, second_force, two_specimens,
    crosshead, compression, descending, two_sheets, impossible, long_stroke, untared,
    held_pressure, levels,
)  # fmt: skip
