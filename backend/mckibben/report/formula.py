"""LaTeX to MathML, which browsers render without a script."""

from __future__ import annotations

from functools import lru_cache
from xml.etree import ElementTree

from mckibben.report.html import Html, tag

_TAGS = frozenset({
    "math", "mrow", "mi", "mn", "mo", "mtext", "mspace", "mfrac", "msqrt", "mroot", "msub", "msup", "msubsup",
    "munder", "mover", "munderover", "mtable", "mtr", "mtd", "mstyle", "mpadded", "mphantom",
})  # fmt: skip
_ATTRIBUTES = frozenset({
    "display", "stretchy", "fence", "form", "separator", "minsize", "maxsize", "width", "linethickness",
    "mathvariant", "columnalign", "accent", "displaystyle", "scriptlevel", "lspace", "rspace",
    "movablelimits",
})  # fmt: skip


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


def _copied(element: ElementTree.Element) -> Html:
    name = element.tag.rpartition("}")[2]
    known = {key: value for key, value in element.attrib.items() if key in _ATTRIBUTES}
    parts = [element.text]
    for child in element:
        parts += [_copied(child), child.tail]
    return tag(name if name in _TAGS else "mrow", *parts, **known)
