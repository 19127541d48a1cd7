"""Readings as the text of a file: many header styles, units, separators and decimal signs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from tests.truth.muscle import ATMOSPHERE, Array


@dataclass(frozen=True)
class Style:
    """How a laboratory writes its files.

    Attributes:
        names: channel -> header; a channel without one is left out.
        factors: channel -> written value over SI.
        separator, decimal: of the text.
        absolute: whether the pressure is written absolute.
    """

    names: dict[str, str]
    factors: dict[str, float]
    separator: str = ","
    decimal: str = "."
    absolute: bool = False


_SAME = {"force": 1.0, "command": 1.0, "time": 1.0, "temperature": 1.0}

STYLES = (
    Style(
        {"time": "time_s", "pressure": "pressure_bar", "length": "length_mm",
         "displacement": "displacement_mm", "force": "force_N", "diameter": "diameter_mm",
         "command": "command_1", "temperature": "temperature_K"},
        _SAME | {"pressure": 1e-5, "length": 1e3, "displacement": 1e3, "diameter": 1e3},
    ),
    Style(
        {"time": "t [s]", "pressure": "p [bar]", "length": "L [mm]", "displacement": "x [mm]",
         "force": "F [N]", "diameter": "D [mm]", "command": "u", "temperature": "T [K]"},
        _SAME | {"pressure": 1e-5, "length": 1e3, "displacement": 1e3, "diameter": 1e3},
        separator=";",
        decimal=",",
    ),
    Style(
        {"time": "Time (ms)", "pressure": "Pressure (kPa)", "contraction": "Contraction (%)",
         "displacement": "Stroke (mm)", "force": "Force (N)", "diameter": "Diameter (mm)",
         "command": "Command (%)", "temperature": "Temperature (degC)"},
        _SAME | {"time": 1e3, "pressure": 1e-3, "contraction": 1e2, "displacement": 1e3, "diameter": 1e3,
                 "command": 1e2},
        separator="\t",
    ),
    Style(
        {"time": "time_s", "pressure": "pressure_MPa", "displacement": "displacement_mm", "force": "load_kN",
         "diameter": "diameter_m", "command": "valve_pct", "temperature": "temperature_K"},
        _SAME | {"pressure": 1e-6, "displacement": 1e3, "force": 1e-3, "diameter": 1.0, "command": 1e2},
    ),
    Style(
        {"time": "time_s", "pressure": "pressure_abs_bar", "length": "length_m", "displacement": "position_m",
         "force": "force_N", "diameter": "diameter_mm", "command": "command", "temperature": "temperature_K"},
        _SAME | {"pressure": 1e-5, "length": 1.0, "displacement": 1.0, "diameter": 1e3},
        separator=";",
        absolute=True,
    ),
)  # fmt: skip


def text_of(
    columns: dict[str, Array],
    *,
    nominal: float,
    style: Style,
    conditions: dict[str, str],
    channels: tuple[str, ...],
    stroke: str = "",
    direction: str = "",
    group: bool = False,
) -> str:
    """The file.

    Args:
        columns: SI, by channel; the stroke as ``length``.
        nominal: nominal length, for contraction and displacement [m].
        conditions: ``# key: value`` lines.
        channels: what to write besides the stroke.
        stroke: how that is written; "" as the style has it.
        direction: words for shortening and lengthening, divided by "/", "" for no such column.
        group: whether the loops are numbered.
    """
    written = dict(columns)
    if "length" in columns:
        written["displacement"] = nominal - columns["length"]
        written["contraction"] = 1.0 - columns["length"] / nominal
    stroke = stroke or next(n for n in ("length", "contraction", "displacement") if n in style.names)
    wanted = [*channels, *([stroke] if "length" in columns else [])]
    order = [name for name in style.names if name in wanted and name in written]
    lines = [f"# {key}: {value}" for key, value in conditions.items()]
    header = [style.names[name] for name in order]
    cells = [_cells(written[name], name, style) for name in order]
    if direction:
        header.append("direction")
        words = direction.split("/")
        cells.append([words[0] if way < 0 else words[1] for way in _ways(columns)])
    if group:
        header.append("run")
        cells.append([f"{int(label) + 1}" for label in columns["group"]])
    lines.append(style.separator.join(header))
    lines += [style.separator.join(row) for row in zip(*cells, strict=True)]
    return "\n".join(lines) + "\n"


def _cells(values: Array, name: str, style: Style) -> list[str]:
    shown = values + (ATMOSPHERE if name == "pressure" and style.absolute else 0.0)
    if name == "temperature" and "degC" in style.names[name]:
        shown = shown - 273.15
    shown = shown * style.factors[name]
    cells = [f"{value:.9g}" for value in shown]
    return [cell.replace(".", style.decimal) for cell in cells] if style.decimal != "." else cells


def _ways(columns: dict[str, Array]) -> Array:
    """-1 while the muscle gets shorter or is filled, else +1, by the row's neighbours."""
    group = columns["group"]
    signal = columns["way"]
    step = np.diff(signal, append=signal[-1])
    step[np.append(np.diff(group) != 0, True)] = 0.0  # the last row of a loop goes on like the one before
    ways = np.sign(step)
    for row in range(1, len(ways)):
        if ways[row] == 0.0:
            ways[row] = ways[row - 1]
    return ways
