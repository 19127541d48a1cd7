"""LaTeX as MathML that every browser draws by itself."""

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
    r"""The formula; where LaTeX cannot be read, its text.

    Only the drawing part of MathML passes: ``\href`` and the like do not.
    """
    from latex2mathml.converter import convert  # 0.05 s import

    try:
        root = ElementTree.fromstring(convert(latex, display="block" if block else "inline"))
    except Exception:  # whatever the converter stumbles over: the report is still to be read
        return tag("code", latex)
    return _copied(root)


def _copied(element: ElementTree.Element) -> Html:
    name = element.tag.rpartition("}")[2]
    known = {key: value for key, value in element.attrib.items() if key in _ATTRIBUTES}
    parts = [element.text]
    for child in element:
        parts += [_copied(child), child.tail]
    return tag(name if name in _TAGS else "mrow", *parts, **known)
