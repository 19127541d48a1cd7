"""The tables of a LaTeX text as lines of cells."""

from __future__ import annotations

import re

_SYMBOLS = {
    r"\varepsilon": "ε", r"\epsilon": "ε", r"\kappa": "κ", r"\Delta": "Δ", r"\mu": "µ", r"\%": "%",
    r"\degree": "°",
    r"\,": " ", r"\;": " ", r"\ ": " ", r"\&": "and", r"\_": "_", r"\#": "#", "~": " ", "$": "", "--": "-",
}  # fmt: skip
_UNITS = {
    r"\milli": "m", r"\kilo": "k", r"\mega": "M", r"\centi": "c", r"\hecto": "h", r"\metre": "m",
    r"\meter": "m", r"\newton": "N", r"\pascal": "Pa", r"\bar": "bar", r"\kilogram": "kg",
    r"\second": "s", r"\percent": "%",
}  # fmt: skip
_RULES = re.compile(
    r"\\(?:toprule|midrule|bottomrule|hline|cline\{[^}]*\}|cmidrule(?:\([^)]*\))?\{[^}]*\}|noalign\{[^}]*\})"
)
_QUANTITY = re.compile(r"\\(?:SI|qty)(?:\[[^\]]*\])?\{([^{}]*)\}\{([^{}]*)\}")
_UNIT = re.compile(r"\\(?:si|unit)(?:\[[^\]]*\])?\{([^{}]*)\}")
_COMMANDS = re.compile(
    r"\\(?:num|textbf|textit|mathrm|text|emph|multicolumn\{[0-9]+\}\{[^{}]*\}|caption|ensuremath)\s*\{([^{}]*)\}"
)


def is_latex(text: str) -> bool:
    """Whether a text holds a table of LaTeX."""
    return re.search(r"\\begin\{(?:tabular[x*]?|longtable|array|tblr)\}", text[:200_000]) is not None


def text_of_latex(text: str) -> str:
    """Lines of text; the cells of a row stand in one line, with tabs between them.

    >>> text_of_latex(chr(92) + "begin{tabular}{cc}" + chr(10) + "$p$ [bar] & F [N]" + chr(92) * 2)
    'p [bar]\\tF [N]'
    """
    text = re.sub(r"(?<!\\)%[^\n]*", "", text)
    text = _RULES.sub("", text)
    text = _QUANTITY.sub(lambda found: f"{found[1]} {_spelt(found[2])}", text)
    text = _UNIT.sub(lambda found: _spelt(found[1]), text)
    for _ in range(3):
        text = _COMMANDS.sub(r"\1", text)
    text = re.sub(r"\\(?:begin|end)\s*\{[^{}]*\}(?:\[[^\]]*\])?(?:\{[^\n]*\})?", "\n", text)
    lines = []
    for row in re.split(r"\\\\(?:\[[^\]]*\])?|\n\s*\n|\n(?=[^\n&]*\n)", text):
        row = row.replace("\\&", "\\and")
        cells = [_plain(cell) for cell in row.split("&")]
        if any(cells):
            lines.append("\t".join(cells))
    return "\n".join(lines)


def _spelt(unit: str) -> str:
    for name, letters in _UNITS.items():
        unit = unit.replace(name, letters)
    return unit


def _plain(cell: str) -> str:
    for symbol, letters in _SYMBOLS.items():
        cell = cell.replace(symbol, letters)
    cell = re.sub(r"\\(?:centering|small|footnotesize|label\{[^}]*\}|[A-Za-z]+)\s*", " ", cell)
    return " ".join(cell.replace("{", "").replace("}", "").split())
