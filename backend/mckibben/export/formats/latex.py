"""LaTeX: the equations of the model with their values, a document that compiles as it is."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from types import ModuleType

from mckibben.export.language import plain
from mckibben.export.registry import ExportedFile, Format
from mckibben.export.subject import Subject
from mckibben.physics import braid, drive, gas, model
from mckibben.physics.custom import CUSTOM

_ESCAPED = {
    "\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "$": r"\$", "&": r"\&", "#": r"\#", "_": r"\_",
    "%": r"\%", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "<": r"\textless{}",
    ">": r"\textgreater{}", "|": r"\textbar{}", '"': r"\textquotedbl{}",
}  # fmt: skip
# Letters of the catalogue's texts that the text fonts of LaTeX lack.
_MATHEMATICAL = {
    "²": "$^2$", "³": "$^3$", "°": r"$^\circ$", "·": r"$\cdot$", "±": r"$\pm$", "×": r"$\times$",
    "κ": r"$\kappa$", "ε": r"$\varepsilon$", "α": r"$\alpha$", "θ": r"$\theta$", "π": r"$\pi$",
    "γ": r"$\gamma$", "ψ": r"$\psi$", "→": r"$\to$", "≤": r"$\le$", "≥": r"$\ge$", "−": "$-$",
    "…": r"\ldots{}", "–": "--", "—": "---", "‘": "`", "’": "'", "“": "``", "”": "''", "μ": r"$\mu$",
    "Ω": r"$\Omega$", "δ": r"$\delta$", "Δ": r"$\Delta$", "λ": r"$\lambda$", "ρ": r"$\rho$",
    "σ": r"$\sigma$", "τ": r"$\tau$", "φ": r"$\varphi$", "ω": r"$\omega$", "√": r"$\surd$", "∞": r"$\infty$",
    "≈": r"$\approx$", "€": r"\texteuro{}",
}  # fmt: skip
# Latin letters without a glyph in the T1 fonts, below U+0180; inputenc stops at them.
_UNKNOWN = frozenset("ĦħĸĿŀŉŦŧſ")
# Name, value, source and grade of the table of constants; together with their gaps as wide as the text.
_COLUMNS = (*(rf">{{\raggedright\arraybackslash}}p{{{width}\textwidth}}" for width in (0.28, 0.24, 0.3)), "l")
# What the symbols of the modules' equations are.
_BRAID = r"with a thread of length $b$ that makes $n$ turns around the muscle, and the braid angle $\theta$."
_COMPOSED = r"with the product $f$ of all factors of the force and the product $e$ of all of the elastomer."
_DRIVE = r"""with the stroke $s$ of the muscle (positive = shorter), the lever ratio $r$, and $F$ and $V$
of the muscle at its length $l$. End stops are rigid; a slack muscle carries no tension. Where a polytropic
exponent is stated, it replaces $\gamma$, and $n R T_0 \dot m$ the flows of heat and enthalpy."""


def equations_of(module: ModuleType) -> str:
    """The displayed equations of a module's docstring, where they are stated once."""
    found = re.search(r"\.\. math::(.*?)\n\n", module.__doc__ or "", re.DOTALL)
    assert found is not None, module.__name__  # noqa: S101 - a docstring that lost its equation
    text = " ".join(found[1].split())
    return rf"\[\begin{{aligned}} {text} \end{{aligned}}\]"


def write(subject: Subject, stem: str) -> tuple[ExportedFile, ...]:
    """One document."""
    return (ExportedFile.of_text(f"{stem}.tex", "\n".join(_lines(subject)), "application/x-tex"),)


def escaped(text: str) -> str:
    """A text without any command: every character stands for itself, or is a question mark."""
    return "".join(_ESCAPED.get(c) or _MATHEMATICAL.get(c) or _letter(c) for c in plain(text))


def _letter(character: str) -> str:
    """The character, or its letter without accents, where the fonts of LaTeX have it."""
    for each in (character, unicodedata.normalize("NFKD", character)[0]):
        if each < "\u0180" and each not in _UNKNOWN:
            return _ESCAPED.get(each, each)
    return "?"


def _lines(subject: Subject) -> Iterator[str]:
    about = subject.about
    yield r"\documentclass{article}"
    yield r"\usepackage[T1]{fontenc}"
    yield r"\usepackage[utf8]{inputenc}"
    yield r"\usepackage{amsmath,amssymb,array,longtable}"
    yield r"\begin{document}"
    yield rf"\section*{{{escaped(about.title)}}}"
    yield rf"Model \texttt{{{escaped(about.id)}}}, sha256 {{\tiny\texttt{{{about.hash}}}}}, by"
    yield rf"{escaped(about.program)}. SI units; pressures are gauge; $\kappa = 1 - L/L_0$."
    yield r"\section*{Muscle}"
    yield equations_of(braid)
    yield _BRAID
    yield equations_of(model)
    yield _COMPOSED
    for effect_id in subject.start.effects:
        effect = subject.start.catalogue[effect_id]
        yield rf"\subsection*{{{escaped(effect.title)} (\texttt{{{escaped(effect_id)}}})}}"
        yield escaped(effect.cause)
        if effect_id == CUSTOM:
            yield rf"\[ F_\mathrm{{custom}} = \texttt{{{escaped(subject.start.term or '')}}} \]"
        else:
            yield rf"\[ {effect.equation} \]"
        yield r"\begin{itemize}"
        for parameter in effect.parameters:
            symbol = escaped(parameter.name) if effect_id == CUSTOM else f"${parameter.symbol}$"
            value = subject.statics.values[effect_id][parameter.name]
            unit = "" if parameter.unit == "1" else rf"\,{escaped(parameter.unit)}"
            yield rf"\item {symbol} $= {_number(value)}$ {unit} --- {escaped(parameter.description)}"
        yield r"\end{itemize}"
    if subject.runnable is not None:
        yield r"\section*{Drive}"
        yield equations_of(drive)
        yield _DRIVE
        yield "The mass flow through a valve or tube:"
        yield equations_of(gas)
    yield r"\section*{Constants}"
    yield r"\setlength{\LTleft}{0pt}\small"
    yield r"\begin{longtable}{" + "".join(_COLUMNS) + "}"
    yield r"name & value & source & grade \\ \hline"
    for each in about.constants:
        unit = "" if each.unit == "1" else f" {escaped(each.unit)}"
        value = f"${_number(each.value)}${unit}"
        yield rf"{_breakable(each.name)} & {value} & {escaped(each.source)} & {escaped(each.grade)} \\"
    yield r"\end{longtable}\normalsize"
    for title, sentences in (
        ("Origin", about.origin),
        ("Assumed", about.assumed),
        ("Valid", [each.shown for each in about.valid]),
        ("Left out", [*about.left_out, "How the equations are solved, and the events of stops and slack."]),
    ):
        if sentences:
            yield rf"\section*{{{title}}}"
            yield r"\begin{itemize}"
            yield from (rf"\item {escaped(sentence)}" for sentence in sentences)
            yield r"\end{itemize}"
    yield r"\end{document}"


def _breakable(name: str) -> str:
    """A name that may go on in the next line behind a point or an underscore."""
    return re.sub(r"(\.|\\_)", r"\1\\allowbreak{}", escaped(name))


def _number(value: float) -> str:
    mantissa, _, exponent = f"{value:.10g}".partition("e")
    return rf"{mantissa} \cdot 10^{{{int(exponent)}}}" if exponent else mantissa


FORMAT = Format(title="LaTeX", note="the equations with their values and sources", write=write)
