"""LaTeX to MathML, which browsers render without a script."""

from __future__ import annotations

import re
from functools import lru_cache
from xml.etree import ElementTree

from mckibben.report.html import Html, html, tag

_TAGS = frozenset({
    "math", "mrow", "mi", "mn", "mo", "mtext", "mspace", "mfrac", "msqrt", "mroot", "msub", "msup", "msubsup",
    "munder", "mover", "munderover", "mtable", "mtr", "mtd", "mstyle", "mpadded", "mphantom",
})  # fmt: skip
_ATTRIBUTES = frozenset({
    "display", "stretchy", "fence", "form", "separator", "minsize", "maxsize", "width", "linethickness",
    "mathvariant", "columnalign", "accent", "displaystyle", "scriptlevel", "lspace", "rspace",
    "movablelimits",
})  # fmt: skip
_OPENING, _CLOSING = ("{", r"\left", r"\begin"), ("}", r"\right", r"\end")
_TOKENS = re.compile(r"(\\[a-zA-Z]+|[{}])")


@lru_cache(maxsize=512)
def formula(latex: str, *, block: bool = False) -> Html:
    r"""The formula as MathML; LaTeX that cannot be parsed is shown as text.

    Only presentation elements are copied, so ``\href`` and the like have no effect.
    """
    from latex2mathml.converter import convert  # 0.05 s import

    try:
        root = ElementTree.fromstring(convert(latex, display="block" if block else "inline"))
    except Exception:  # a formula that cannot be converted must not prevent the report
        return tag("code", latex)
    return _copied(root)


def equation(latex: str) -> Html:
    r"""An equation in a line of its own, whose parts between ``\quad`` may continue on the next one."""
    return tag("div", [html(formula(part, block=True), " ") for part in _parts(latex)], class_="equation")


def _parts(latex: str) -> list[str]:
    """The parts between spaces that stand in no bracket or environment."""
    parts, depth = [""], 0
    for token in _TOKENS.split(latex):
        depth += token in _OPENING
        depth -= token in _CLOSING
        if token == "\\quad" and depth == 0:
            parts.append("")
        else:
            parts[-1] += token
    return [part.strip() for part in parts]


def _copied(element: ElementTree.Element) -> Html:
    name = element.tag.rpartition("}")[2]
    known = {key: value for key, value in element.attrib.items() if key in _ATTRIBUTES}
    parts = [element.text]
    for child in element:
        parts += [_copied(child), child.tail]
    return tag(name if name in _TAGS else "mrow", *parts, **known)
