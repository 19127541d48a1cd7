"""Drawings: geometry of the marks, ticks, and what is said for those who cannot see them."""

from __future__ import annotations

import math
import re
from xml.etree import ElementTree

import pytest

from mckibben.report.bars import Bar, bars
from mckibben.report.chart import chart, family, ticks
from mckibben.report.heat import Shade, heat
from mckibben.report.marks import Axis, Band, Dots, Line, Rule
from mckibben.report.sizing.motion import Panel, stack

SVG = "{http://www.w3.org/2000/svg}"
X, Y = Axis("Contraction", "%"), Axis("Force", "N")


def paths(drawing: str) -> list[ElementTree.Element]:
    """Paths with a course inside the axes, in the order of drawing."""
    return ElementTree.fromstring(drawing).findall(f"{SVG}svg/{SVG}path")


def points(path: ElementTree.Element) -> list[tuple[float, float]]:
    """Corners of a path."""
    return [(float(a), float(b)) for a, b in re.findall(r"[ML](-?[\d.]+) (-?[\d.]+)", path.attrib["d"])]


def texts(drawing: str) -> list[str]:
    """All words of a drawing."""
    return ["".join(element.itertext()) for element in ElementTree.fromstring(drawing).iter(f"{SVG}text")]


@pytest.mark.parametrize(
    ("low", "high", "expected"),
    [
        (0.0, 10.0, [0, 2, 4, 6, 8, 10]),
        (-0.1, 0.35, [-0.1, 0.0, 0.1, 0.2, 0.3]),
        (1e5, 1.02e5, [1e5, 1.005e5, 1.01e5, 1.015e5, 1.02e5]),
    ],
)
def test_ticks_are_round_and_inside(low: float, high: float, expected: list[float]) -> None:
    assert ticks(low, high) == pytest.approx(expected)


def test_a_straight_line_is_drawn_straight_and_to_scale() -> None:
    drawing = chart(X, Y, [Line([0, 5, 10], [0, 50, 100], "model")], title="t")
    (x0, y0), (x1, y1), (x2, y2) = points(paths(drawing)[0])
    assert x1 == pytest.approx((x0 + x2) / 2, abs=0.1)
    assert y1 == pytest.approx((y0 + y2) / 2, abs=0.1)
    assert x0 < x2
    assert y0 > y2  # up is more
    words = texts(drawing)
    assert {"Contraction [%]", "Force [N]", "model", "0", "100"} <= set(words)


def test_gaps_break_a_line_and_leave_out_dots() -> None:
    values = [1.0, None, 3.0, math.nan, 5.0]
    drawing = chart(X, Y, [Line(range(5), values), Dots(range(5), values)], title="t")
    line, dots = paths(drawing)
    assert line.attrib["d"].count("M") == 3
    assert dots.attrib["d"].count("h0") == 3
    assert "nan" not in drawing


@pytest.mark.parametrize("values", [[], [2.0], [0.0, 0.0], [1e-9, 1e9], [-5.0, -5.0]])
def test_any_range_has_a_drawing(values: list[float]) -> None:
    drawing = chart(X, Axis("a<b", zero=True), [Dots(values, values, "x"), Band(-1, 1, "noise")], title="<t>")
    root = ElementTree.fromstring(drawing)
    assert root.attrib["role"] == "img"
    assert root.findtext(f"{SVG}title") == "<t>"


def test_a_rule_stands_at_its_value_over_the_whole_height() -> None:
    drawing = chart(X, Y, [Line([0, 10], [0, 100]), Rule(5.0, "half"), Dots([5], [50])], title="t")
    line, rule, _ = paths(drawing)
    (x0, y0), (x1, y1) = points(line)
    found = re.fullmatch(r"M([\d.]+) ([\d.]+)V([\d.]+)", rule.attrib["d"])
    assert found is not None
    at, top, bottom = map(float, found.groups())
    assert at == pytest.approx((x0 + x1) / 2, abs=0.1)
    assert top < y1 < y0 < bottom
    assert "half" in texts(drawing)


def test_given_ends_are_kept_and_a_bare_axis_has_no_numbers() -> None:
    drawing = chart(Axis("Time", "ms", ends=(0.0, 20.0), bare=True), Y, [Line([0, 10], [0, 1])], title="t")
    whole = chart(Axis("Time", "ms", ends=(0.0, 20.0)), Y, [Line([0, 20], [0, 1])], title="t")
    (x0, _), (x1, _) = points(paths(drawing)[0])
    (left, _), (right, _) = points(paths(whole)[0])
    assert x0 == left
    assert x1 == pytest.approx((left + right) / 2, abs=0.1)
    assert "Time [ms]" in texts(whole)
    assert not {"Time [ms]", "10", "20"} & set(texts(drawing))


def test_names_stand_beside_their_dots_and_stay_inside() -> None:
    drawing = chart(X, Y, [Dots([0, 10], [0, 100], names=["<first>", "last"], size=10)], title="t")
    found = {e.text: e.attrib for e in ElementTree.fromstring(drawing).iter(f"{SVG}text")}
    assert found["<first>"]["text-anchor"] == "start"
    assert found["last"]["text-anchor"] == "end"
    below = chart(X, Y, [Dots([5], [50], names=["n"], below=True)], title="t")
    above = chart(X, Y, [Dots([5], [50], names=["n"])], title="t")
    heights = [
        next(float(e.attrib["y"]) for e in ElementTree.fromstring(d).iter(f"{SVG}text") if e.text == "n")
        for d in (below, above)
    ]
    assert heights[0] > heights[1]


def test_a_stack_shares_its_axis() -> None:
    drawn = stack(
        Axis("Time", "ms", ends=(0.0, 8.0)),
        [
            Panel(Y, [Line([0, 8], [0, 1])], "one"),
            Panel(Axis("Pressure", "bar"), [Line([0, 8], [4, 9])], "two"),
        ],
    )
    one, two = ElementTree.fromstring(f"<r>{drawn}</r>")
    ends = [[x for x, _ in points(svg.findall(f"{SVG}svg/{SVG}path")[0])] for svg in (one, two)]
    assert ends[0] == ends[1]
    titles = [["".join(e.itertext()) for e in svg.iter(f"{SVG}text")] for svg in (one, two)]
    assert ["Time [ms]" in words for words in titles] == [False, True]


def test_a_long_legend_names_first_and_last_and_counts_the_rest() -> None:
    marks = [Line([0, 1], [k, k], f"series {k}") for k in range(30)]
    words = texts(chart(X, Y, marks, title="t"))
    assert {"series 0", "series 29", "and 18 more"} <= set(words)


def test_colours_of_a_family_differ() -> None:
    assert len(set(family(12))) == 12
    assert family(1) == ["rgb(34,154,136)"]


def test_bars_are_as_long_as_their_values_on_one_scale() -> None:
    drawn = [
        ElementTree.fromstring(bar)
        for bar in bars([Bar("a", 10.0, pale=True), Bar("b", 5.0, 12.0, strong=True)], level=6.0)
    ]
    one, two = (bar.find(f"{SVG}rect") for bar in drawn)
    assert one is not None
    assert two is not None
    begin, width = float(one.attrib["x"]), float(one.attrib["width"])
    assert width == pytest.approx(2 * float(two.attrib["width"]), rel=1e-3)
    assert one.attrib["fill"] != two.attrib["fill"]
    axis, level, tick = (float(line.attrib["x1"]) for line in drawn[1].iter(f"{SVG}line"))
    assert axis == begin
    assert level - begin == pytest.approx(0.6 * width, rel=2e-3)
    assert tick - begin == pytest.approx(1.2 * width, rel=2e-3)


def test_bars_of_nothing_have_a_drawing() -> None:
    assert bars([]) == []
    ElementTree.fromstring(bars([Bar("a", 0.0)])[0])


def test_heat_colours_by_sign_and_leaves_gaps_empty() -> None:
    drawing = heat(X, Y, [0, 1, 2], [0, 1, 2], [[-4.0, 2.0], [math.nan, 0.0]], title="t")
    fills = [e.attrib["fill"] for e in ElementTree.fromstring(drawing).iter(f"{SVG}rect")]
    assert fills == ["rgb(33,102,172)", "rgb(212,136,145)", "#fff", "rgb(247,247,247)"]
    assert {"\u22124.0", "2.0", "0"} <= set(texts(drawing))
    # With a noise: logarithmic outside, a dot for what is none.
    shade = Shade(10000.0, 1.0)
    assert shade.share(100.0) == pytest.approx(math.asinh(50.0) / math.asinh(5000.0))
    named = heat(X, Y, [0, 1, 2], ["low", "high"], [[-10000.0, 0.7], [math.nan, 0.8]], title="t", shade=shade)
    fills = [e.attrib["fill"] for e in ElementTree.fromstring(named).iter(f"{SVG}rect")]
    assert fills[:3] == ["rgb(33,102,172)", "rgb(247,247,247)", "#fff"]
    words = texts(named)
    assert words.count("·") == 1
    assert {"low", "high"} <= set(words)
