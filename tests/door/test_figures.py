"""Figures have the look of the studio's page, and the numbers of their results."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import mckibben as mk
from mckibben.door import figures
from mckibben.report.chart import family

ROOT = Path(__file__).parents[2]


def test_the_colours_and_the_font_are_those_of_the_page() -> None:
    theme = (ROOT / "frontend" / "app" / "js" / "plots" / "theme.js").read_text("utf-8")
    light = theme[theme.index("LIGHT = {") : theme.index("DARK = {")]
    shown = dict(re.findall(r'(\w+): "(#\w+)"', light))
    names = {"ink": figures.INK, "soft": figures.SOFT, "grid": figures.GRID, "line": figures.LINE}
    names |= {"accent": figures.ACCENT, "second": figures.SECOND, "load": figures.LOAD}
    assert {name: shown[name] for name in names} == names
    stops = re.findall(r"\[(\d+), (\d+), (\d+)\]", light)
    assert family(len(stops)) == [f"rgb({','.join(stop)})" for stop in stops]
    chart = (ROOT / "frontend" / "app" / "js" / "plots" / "chart.js").read_text("utf-8")
    assert figures.FONT in chart


def test_curves_show_their_numbers_with_units() -> None:
    curves = mk.Model.preset("DMSP-20", length="300 mm").curves("6 bar, 1 bar")
    figure = curves.plot()
    assert figure.layout.xaxis.title.text == "Contraction (%)"
    assert figure.layout.yaxis.title.text == "Force (N)"
    assert [trace.name for trace in figure.data] == ["6 bar", "1 bar"]
    assert np.asarray(figure.data[0].y) == pytest.approx(curves.force[0])
    # The colours follow the pressures, not the order in which they were asked for.
    assert [trace.line.color for trace in figure.data] == list(reversed(family(2)))


def test_a_comparison_shows_points_model_and_residual() -> None:
    compared = mk.Model.preset("DMSP-10").compare("martens-dmsp-10-250")
    figure = compared.plot()
    titles = [figure.layout.yaxis.title.text, figure.layout.yaxis2.title.text]
    assert titles == ["Force (N)", "Error (N)"]
    points = [np.asarray(trace.y) for trace in figure.data if trace.yaxis == "y2"]
    residual = np.concatenate(points)
    assert np.sqrt(np.mean(residual**2)) == pytest.approx(compared.rmse)


def test_a_run_and_a_measurement_over_time() -> None:
    run = mk.Drive.preset("propneu-20").run(points=101)
    figure = run.plot()
    assert figure.layout.xaxis3.title.text == "Time (s)"
    assert [figure.layout[f"yaxis{n}"].title.text for n in ("", 2, 3)] == [
        "Position (mm)",
        "Pressure (bar)",
        "Force (N)",
    ]
    assert np.asarray(figure.data[0].y) == pytest.approx(1e3 * run.position)
    run.save("trace.csv")
    shown = mk.read("trace.csv").plot()
    assert {trace.name for trace in shown.data} >= {"pressure", "length", "force"}
    assert mk.read("martens-dmsp-10-250").plot().layout.yaxis.title.text == "Force (N)"


def test_a_notebook_keeps_figures_as_html_and_the_script_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """What an executed notebook holds; a browser has drawn it (docs: the stories)."""
    from mckibben.door.shown import ShownFigure

    monkeypatch.setattr(ShownFigure, "_has_script", False)
    model = mk.Model.preset("DMSP-20", length="300 mm")
    first, second = (model.plot("3 bar")._repr_mimebundle_() for _ in range(2))
    for bundle in (first, second):
        assert bundle["application/vnd.plotly.v1+json"]["data"]
        assert "plotly-graph-div" in bundle["text/html"]
    assert len(second["text/html"]) < 50_000 < 1_000_000 < len(first["text/html"])
    assert len(mk.Drive.preset("paper-step").run().plot().data) >= 3  # several plots, one below the other
