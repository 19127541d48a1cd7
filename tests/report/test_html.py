"""HTML from values: what is text stays text."""

from __future__ import annotations

from xml.etree import ElementTree

import pytest

from mckibben.report.html import Html, html, tag

NASTY = "<script>alert(1)</script>\"'&\x00\x1b]]>\ud800"


def test_text_is_escaped_and_html_is_not() -> None:
    assert html("a<b", Html("<i>c</i>"), 3, None) == "a&lt;b<i>c</i>3"
    assert tag("p", "1 & 2", class_="a b", stroke_width=2, id=None) == (
        '<p class="a b" stroke-width="2">1 &amp; 2</p>'
    )


@pytest.mark.parametrize("text", [NASTY, '" onload="alert(1)', "</title>", "&lt;", "\ufffe"])
def test_any_text_comes_back_as_one_text_node_and_one_attribute(text: str) -> None:
    element = ElementTree.fromstring(tag("p", text, title=text))
    assert list(element) == []
    assert set(element.attrib) == {"title"}
    kept = "".join(c for c in text if c.isprintable() and not "\ud800" <= c <= "\udfff" and c < "\ufffe")
    assert (element.text or "").replace("\ufffd", "") == kept
    assert element.attrib["title"].replace("\ufffd", "") == kept


def test_elements_are_closed_as_xml_wants() -> None:
    assert tag("meta", charset="utf-8") == '<meta charset="utf-8"/>'
    assert tag("td") == "<td></td>"
    assert html(tag("li", number) for number in range(2)) == "<li>0</li><li>1</li>"
