"""Plotly figures of results, with the look of the studio; plotly is imported when the first is drawn."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from mckibben.application.compare.compare import ComparisonResult
from mckibben.application.curves.curves import CurvesResult
from mckibben.application.diagnose.result import DiagnosisResult
from mckibben.application.joint.joint import JointResult
from mckibben.application.linear.result import LinearResult
from mckibben.application.run.simulate import SimulationResult
from mckibben.application.size.size import ExploredDrive, ProposedDrive, SizingResult
from mckibben.application.study.study import StudyResult
from mckibben.facts.comparison import NOISE, error_scale
from mckibben.facts.diagnosis import DIAGNOSIS
from mckibben.facts.joint import JOINT_STATICS
from mckibben.facts.sizing import SIZING
from mckibben.facts.study import INFLUENCE, WATCHED
from mckibben.facts.units import Scale
from mckibben.identification.fit.profile import Profile
from mckibben.measurement.measurement import Measurement
from mckibben.report.chart import family
from mckibben.report.figures import variable

if TYPE_CHECKING:
    from plotly.graph_objects import Figure

# The light theme of the page.
INK, SOFT, GRID, LINE = "#17212b", "#4d5b6a", "#e9edf1", "#c0c9d2"
ACCENT, SECOND, LOAD = "#1257b8", "#a3591a", "#b93815"
FONT = "Inter, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, sans-serif"

_DASHES = ("dash", "dot", "dashdot", "longdash")

_BINS = 40


def blank(title: str, *, rows: int = 1) -> Figure:
    """A figure without curves.

    Args:
        title: of the figure.
        rows: number of plots, one below the other, over the same x axis.
    """
    from plotly.subplots import make_subplots

    from mckibben.door.shown import ShownFigure

    figure = ShownFigure(
        None if rows == 1 else make_subplots(rows=rows, cols=1, shared_xaxes=True, vertical_spacing=0.06)
    )
    figure.update_layout(
        template="none",
        title={"text": _plain(title), "x": 0.02, "font": {"size": 15}},
        font={"family": FONT, "size": 12, "color": INK},
        paper_bgcolor="#ffffff",
        plot_bgcolor="#ffffff",
        margin={"l": 62, "r": 20, "t": 48, "b": 48},
        width=800,
        height=480 if rows == 1 else 210 * rows + 90,
        legend={"font": {"size": 11}},
        hovermode="closest",
    )
    axis = {
        "gridcolor": GRID, "linecolor": LINE, "tickcolor": LINE, "ticks": "outside", "ticklen": 4,
        "showline": True, "zerolinecolor": LINE, "tickfont": {"color": SOFT}, "nticks": 7,
    }  # fmt: skip
    figure.update_xaxes(**axis)
    figure.update_yaxes(**axis)
    return figure


def name_axes(figure: Figure, x: str, y: Sequence[str]) -> None:
    """Titles of the axes, each with its unit; the x axis is that of the lowest plot."""
    font = {"size": 12, "color": SOFT}
    for row, title in enumerate(y, 1):
        place: dict[str, Any] = {} if len(y) == 1 else {"row": row, "col": 1}
        figure.update_yaxes(title={"text": title, "font": font, "standoff": 8}, **place)
    last: dict[str, Any] = {} if len(y) == 1 else {"row": len(y), "col": 1}
    figure.update_xaxes(title={"text": x, "font": font, "standoff": 8}, **last)


def add_line(
    figure: Figure, x: ArrayLike, y: ArrayLike, name: str, *, colour: str = ACCENT, dash: str | None = None,
    row: int = 1, legend: bool = True,
) -> None:  # fmt: skip
    """Add a curve to a plot of the figure."""
    from plotly.graph_objects import Scatter

    line = {"width": 2, "color": colour, "dash": dash}
    trace = Scatter(
        x=np.asarray(x), y=np.asarray(y), mode="lines", line=line, name=_plain(name), showlegend=legend
    )
    _add(figure, trace, row)


def add_points(
    figure: Figure, x: ArrayLike, y: ArrayLike, name: str, *, colour: str = ACCENT, row: int = 1,
    legend: bool = True,
) -> None:  # fmt: skip
    """Add points to a plot of the figure."""
    from plotly.graph_objects import Scatter

    marker = {"size": 5, "color": colour, "line": {"width": 1.4, "color": colour}}
    trace = Scatter(
        x=np.asarray(x), y=np.asarray(y), mode="markers", marker=marker, name=_plain(name), showlegend=legend
    )
    _add(figure, trace, row)


def _add(figure: Figure, trace: Any, row: int) -> None:
    if row == 1 and not figure._has_subplots():
        figure.add_trace(trace)
    else:
        figure.add_trace(trace, row=row, col=1)


def _plain(text: str) -> str:
    """A text in which Plotly finds no markup."""
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def bode_figure(result: LinearResult, title: str) -> Figure:
    """Gain and phase of each model over frequency, with the nonlinear drive under sines."""
    figure = blank(title, rows=2)
    others = 0
    for model in result.models:
        colour = ACCENT if model.primary else SOFT
        dash = None if model.primary else _DASHES[others % len(_DASHES)]
        others += 0 if model.primary else 1
        add_line(figure, result.frequency, _decibels(model.gain), model.name, colour=colour, dash=dash)
        degrees = np.degrees(model.phase)
        add_line(figure, result.frequency, degrees, model.name, colour=colour, dash=dash, row=2, legend=False)
    amplitudes = sorted({point.amplitude for point in result.describing})
    scale, unit = (100.0, " %") if result.input.unit == "1" else (1.0, f" {result.input.unit}")
    for amplitude, colour in zip(amplitudes, family(len(amplitudes)), strict=True):
        points = [
            each for each in result.describing if each.amplitude == amplitude and each.gain == each.gain
        ]
        at = [point.frequency for point in points]
        name = f"nonlinear, {scale * amplitude:.3g}{unit}"
        add_points(figure, at, _decibels(np.array([p.gain for p in points])), name, colour=colour)
        phases = np.degrees([point.phase for point in points])
        add_points(figure, at, phases, name, colour=colour, row=2, legend=False)
    figure.update_xaxes(type="log")
    name_axes(figure, "Frequency (Hz)", [f"Gain (dB re 1 {result.gain_unit})", "Phase (°)"])
    return figure


def design_figure(result: LinearResult, title: str) -> Figure:
    """Position and command of each controller's step on the nonlinear drive."""
    figure = blank(title, rows=2)
    design = result.design
    if design is None:
        return figure
    for trial, colour in zip(reversed(design.trials), (ACCENT, SECOND, LOAD), strict=False):
        add_line(figure, trial.time, 1e3 * trial.position, trial.name, colour=colour)
        add_line(figure, trial.time, 100.0 * trial.command, trial.name, colour=colour, row=2, legend=False)
    last = design.trials[-1]
    add_line(figure, last.time, 1e3 * last.reference, "reference", colour=SOFT, dash="dash")
    name_axes(figure, "Time (s)", ["Position (mm)", "Command (%)"])
    return figure


def _decibels(gain: np.ndarray) -> np.ndarray:
    return 20.0 * np.log10(np.maximum(gain, 1e-300))


def diagnosis_figure(result: DiagnosisResult, title: str) -> Figure:
    """The error after each addition, in the fit and in groups left out, and the noise."""
    from plotly.graph_objects import Bar

    scale = error_scale(result.unit)
    steps = [step.added or ("start model" if n == 0 else "refitted") for n, step in enumerate(result.path)]
    names = [f"{number}. {name}" for number, name in enumerate(steps)]
    figure = blank(title)
    figure.add_trace(
        Bar(
            x=names,
            y=[scale.of(s.rmse) for s in result.path],
            name=DIAGNOSIS["rmse"].label,
            marker_color=ACCENT,
        )
    )
    figure.add_trace(
        Bar(
            x=names,
            y=[scale.of(s.holdout_rmse) for s in result.path],
            name=DIAGNOSIS["holdout_rmse"].label,
            marker_color=SECOND,
        )
    )
    noise = result.noise_floor.rmse
    if noise is not None:
        figure.add_hline(
            y=scale.of(noise), line={"color": SOFT, "dash": "dash"}, annotation_text=NOISE["rmse"].words,
            annotation_font_color=SOFT,
        )  # fmt: skip
    name_axes(figure, "after adding", [f"{DIAGNOSIS['rmse'].label} ({scale.unit})"])
    return figure


def run_figure(result: SimulationResult, title: str) -> Figure:
    """Position with its set point, pressure, and force over time."""
    figure = blank(title, rows=3)
    add_line(figure, result.time, 1e3 * result.position, "position")
    if result.reference is not None:
        add_line(figure, result.time, 1e3 * result.reference, "set point", colour=SECOND, dash="dash")
    add_line(figure, result.time, result.pressure / 1e5, "pressure", row=2)
    if result.tube_pressure is not None:
        add_line(
            figure, result.time, result.tube_pressure / 1e5, "pressure in the tube", colour=SECOND, row=2
        )
    add_line(figure, result.time, result.force, "force of the muscle", row=3)
    add_line(figure, result.time, result.load_force, "force of the load", colour=LOAD, dash="dot", row=3)
    name_axes(figure, "Time (s)", ["Position (mm)", "Pressure (bar)", "Force (N)"])
    return figure


def sizing_figure(result: SizingResult, title: str) -> Figure:
    """Air per cycle over the time of the stroke: all drives that fulfil the task, and the proposals."""
    figure, (across, up) = blank(title), (SIZING["time"], SIZING["air_volume_anr"])

    def points(drives: Sequence[ExploredDrive | ProposedDrive], name: str, colour: str) -> None:
        x, y = ([getattr(one, each.name) for one in drives] for each in (across, up))
        add_points(figure, across.scale.all(x), up.scale.all(y), name, colour=colour)

    points(result.explored, "fulfils the task", SOFT)
    length = SIZING["nominal_length"].scale
    for rank, one in enumerate(result.proposals, 1):
        name = f"{rank}. {one.muscle}, {length.of(one.nominal_length):.4g} {length.unit}"
        points([one], name, ACCENT if rank == 1 else SECOND)
    name_axes(
        figure,
        f"{across.label} ({across.scale.unit})",
        [f"{up.label.removesuffix(' (ANR)')} ({up.scale.unit})"],
    )
    return figure


def axis_title(channel: str) -> str:
    """Title of an axis with its unit: "Force (N)"."""
    name, scale = variable(channel)
    words = name[:1].upper() + name[1:]
    return f"{words} ({scale.unit})" if scale.unit else words


def curves_figure(result: CurvesResult, title: str) -> Figure:
    """Force over contraction, one curve per pressure."""
    figure = blank(title)
    order = np.argsort(np.argsort(result.pressure))
    shades = family(len(result.pressure))
    for index, pressure in enumerate(result.pressure):
        add_line(
            figure, 100.0 * result.contraction, result.force[index], f"{pressure / 1e5:g} bar",
            colour=shades[int(order[index])],
        )  # fmt: skip
    name_axes(figure, axis_title("contraction"), [axis_title("force")])
    return figure


def joint_figure(result: JointResult, title: str) -> Figure:
    """Torque over angle, one curve for each set of pressures."""
    figure = blank(title)
    torque, angle = JOINT_STATICS["torque"], JOINT_STATICS["angle"]
    for values, own, colour in zip(
        result.torque, result.pressures, family(len(result.pressures)), strict=True
    ):
        name = " / ".join(f"{pressure / 1e5:g}" for pressure in own) + " bar"
        add_line(figure, result.angle / angle.scale.factor, values / torque.scale.factor, name, colour=colour)
    names = [f"{each.label} [{each.scale.unit}]" for each in (angle, torque)]
    name_axes(figure, names[0], names[1:])
    return figure


def profile_figure(result: Profile) -> Figure:
    """The deviance over a constant, and the limit of the interval."""
    unit = "" if result.unit == "1" else f" [{result.unit}]"
    figure = blank(f"Profile of {result.name}")
    add_line(figure, result.value, result.deviance, "deviance")
    ends = [float(result.value[0]), float(result.value[-1])]
    limit = f"{100.0 * result.share:g} % interval"
    add_line(figure, ends, [result.limit, result.limit], limit, colour=SOFT, dash="dash")
    name_axes(figure, f"{result.name}{unit}", ["deviance"])
    return figure


def comparison_figure(result: ComparisonResult, title: str) -> Figure:
    """Measured points and the model, and below them the residual; over time where the data have it."""
    series = [one for one in result.series if one.use == "fit"]
    channels = list(dict.fromkeys(one.channel for one in series))
    timed = result.kind == "transient" and all(one.time is not None for one in series)
    figure = blank(title, rows=2 * len(channels))
    titles = []
    for number, channel in enumerate(channels):
        own = [one for one in series if one.channel == channel]
        scale = variable(channel)[1]
        row = 2 * number + 1
        for one, colour in zip(own, family(len(own)), strict=True):
            at = one.time if timed and one.time is not None else 100.0 * one.contraction
            if not timed and result.predicted == "diameter" and not np.any(np.isfinite(at)):
                at = one.x_pressure / 1e5
            shade = ACCENT if len(own) == 1 else colour
            order = np.arange(len(at)) if one.time is not None else np.argsort(at, kind="stable")
            add_points(
                figure, at, scale.all(one.measured), one.label, colour=shade, row=row, legend=not number
            )
            model = SECOND if len(own) == 1 else shade
            add_line(
                figure, at[order], np.array(scale.all(one.predicted))[order], f"{one.label}, model",
                colour=model, row=row, legend=len(own) == 1 and not number,
            )  # fmt: skip
            add_points(
                figure, at, scale.all(one.residual), one.label, colour=shade, row=row + 1, legend=False
            )
        titles += [axis_title(channel), f"Error ({scale.unit})" if scale.unit else "Error"]
    name_axes(figure, axis_title("time" if timed else "contraction"), titles)
    return figure


def measurement_figure(measurement: Measurement, title: str) -> Figure:
    """Every channel over time; without time, force (or the stroke) over the stroke or pressure."""
    columns = measurement.columns
    if "time" in columns:
        shown = [name for name in columns if name not in ("time", "group", "direction")]
        figure = blank(title, rows=len(shown))
        seconds = columns["time"]
        for row, name in enumerate(shown, 1):
            add_line(figure, seconds, variable(name)[1].all(columns[name]), name, row=row, legend=False)
        name_axes(figure, axis_title("time"), [axis_title(name) for name in shown])
        return figure
    channels = [name for name in columns if name not in ("group", "direction", "temperature")]
    y = next(
        (name for name in ("force", "diameter", "displacement", "length") if name in channels), channels[-1]
    )
    strokes = ("contraction", "displacement", "length", "pressure")
    x = next((name for name in strokes if name in channels and name != y), channels[0])
    figure = blank(title)
    groups = np.unique(columns["group"])
    for group, colour in zip(groups, family(len(groups)), strict=True):
        rows = columns["group"] == group
        label = f"group {group}"
        if "pressure" in columns and x != "pressure":
            label = f"{np.mean(columns['pressure'][rows]) / 1e5:.3g} bar"
        add_points(
            figure, variable(x)[1].all(columns[x][rows]), variable(y)[1].all(columns[y][rows]), label,
            colour=colour,
        )  # fmt: skip
    name_axes(figure, axis_title(x), [axis_title(y)])
    return figure


def study_figure(result: StudyResult, title: str) -> Figure:
    """What the method asks for: Pareto front, influences, or the distribution of the first figure."""
    if any(item.influences for item in result.sensitivity):
        return _influences(result, title)
    if len(result.front) > 1:
        return _front(result, title)
    return _histogram(result, title)


def _label(result: StudyResult, name: str) -> str:
    """A figure with its unit; a quantity by its path, in SI."""
    if name in WATCHED:
        label, unit = WATCHED[name].label, WATCHED[name].scale.unit
    else:
        label, unit = name, next(column.unit for column in result.columns if column.name == name) or ""
    return f"{label} ({unit})" if unit not in ("", "1") else label


def _values(result: StudyResult, name: str) -> list[float]:
    """A column in the unit of its label; NaN where a run lacks it."""
    values = [None if value is None else float(value) for value in result.table[name]]
    return WATCHED[name].scale.all(values) if name in WATCHED else Scale("").all(values)


def _front(result: StudyResult, title: str) -> Figure:
    """All runs over the two first figures, those of the front marked."""
    x, y = [column.name for column in result.columns if column.kind == "figure"][-2:]
    if len(result.goals) > 1:
        x, y = result.goals[:2]
    columns = [np.array(_values(result, name)) for name in (x, y)]
    on = np.isin(np.array(result.table["run"]), result.front)
    figure = blank(title)
    add_points(figure, columns[0][~on], columns[1][~on], "runs", colour=SOFT)
    add_points(figure, columns[0][on], columns[1][on], SIZING["front"].label, colour=ACCENT)
    name_axes(figure, _label(result, x), [_label(result, y)])
    return figure


def _influences(result: StudyResult, title: str) -> Figure:
    """Bars of the first figure with influences, the largest on top."""
    from plotly.graph_objects import Bar

    item = next(item for item in result.sensitivity if item.influences)
    sobol = item.influences[0].total is not None
    parts = [("total", ACCENT), ("first", SECOND)] if sobol else [("mean_size", ACCENT)]
    shown = sorted(item.influences, key=lambda one: getattr(one, parts[0][0]))
    figure = blank(f"{title}: {WATCHED[item.figure].label}")
    scale = INFLUENCE["total"].scale if sobol else WATCHED[item.figure].scale._replace(offset=0.0)
    for value, colour in parts:
        figure.add_trace(
            Bar(
                x=scale.all(getattr(one, value) for one in shown),
                y=[one.quantity for one in shown],
                error_x={"array": scale.all(getattr(one, f"{value}_error") for one in shown), "color": SOFT},
                orientation="h",
                name=INFLUENCE[value].words,
                marker_color=colour,
            )
        )
    effect = f"{INFLUENCE['mean_size'].label} ({scale.unit})"
    name_axes(figure, "Share of the variance" if sobol else effect, [""])
    figure.update_yaxes(automargin=True)
    return figure


def _histogram(result: StudyResult, title: str) -> Figure:
    """The distribution of the first figure that varies, with its percentiles."""
    from plotly.graph_objects import Histogram

    known = [item for item in result.summary if item.count]
    figure = blank(title)
    if not known:
        return figure
    item = next((one for one in known if one.least != one.most), known[0])
    values = [
        value
        for value, outcome in zip(_values(result, item.figure), result.table["outcome"], strict=True)
        if value == value and outcome == "completed"
    ]
    figure.add_trace(Histogram(x=values, nbinsx=_BINS, name=WATCHED[item.figure].label, marker_color=ACCENT))
    scale = WATCHED[item.figure].scale
    for percent in ("5", "50", "95"):
        figure.add_vline(
            x=scale.of(item.percentiles[percent].value), line={"color": SECOND, "dash": "dash"},
            annotation_text=f"{percent} %", annotation_font_color=SECOND,
        )  # fmt: skip
    name_axes(figure, _label(result, item.figure), ["Runs"])
    return figure
