"""The words of each language that code is written in."""

from __future__ import annotations

import keyword
import re
import textwrap
import unicodedata
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

_FUNCTIONS = (
    "exp", "log", "sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh"
)  # fmt: skip
_LONGEST = 40  # characters of a name; MATLAB allows 63, with what formats put before and after
_LOCAL = re.compile(r"t\d+")  # variables of `mckibben.export.code`
_INVISIBLE = frozenset({"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"})


@dataclass(frozen=True)
class Language:
    """How a language writes statements, choices, functions and comments.

    Attributes:
        name: of the language, for messages.
        functions: name in symengine -> name of a function of one argument.
        reserved: words that cannot be names, in lower case.
        comment: what begins a line of comment.
        continued: what ends a line whose statement goes on.
        end: what ends a statement.
        brackets: whether a text that goes on in the next line has to stand in brackets.
    """

    name: str
    functions: Mapping[str, str]
    reserved: frozenset[str]
    comment: str
    continued: str = ""
    end: str = ";"
    brackets: bool = False
    _declaration: str = "{name} = {text}"
    _choice: str = "({condition} ? {yes} : {no})"
    _power: str = "pow({base}, {exponent})"
    _words: Mapping[str, str] = field(default_factory=lambda: {"And": "&&", "Or": "||", "Not": "!"})
    _truths: tuple[str, str] = ("0", "1")

    def declared(self, name: str, text: str, *, boolean: bool) -> str:
        """A new variable of a function."""
        kind = "int" if boolean else "double"
        return self._declaration.format(kind=kind, name=name, text=text) + self.end

    def assigned(self, target: str, text: str) -> str:
        """A result; of the target "return" that of a function."""
        if target == "return":
            return f"return {text}{self.end}"
        return f"{target} = {text}{self.end}"

    def choice(self, condition: str, yes: str, no: str) -> str:
        """One of two values."""
        return self._choice.format(condition=condition, yes=yes, no=no)

    def power(self, base: str, exponent: str) -> str:
        """A power that is no product."""
        return self._power.format(base=base, exponent=exponent)

    def logic(self, kind: str, parts: Sequence[str]) -> str:
        """Conditions combined by And, Or or Not."""
        word = self._words[kind]
        return f"({word}({parts[0]}))" if kind == "Not" else f"({f' {word} '.join(parts)})"

    def truth(self, value: bool) -> str:
        """True or False."""
        return self._truths[value]

    def inline(self, code: str, text: str) -> str:
        """A line of code with a comment after it."""
        closing = " */" if self.comment == " *" else ""
        opening = "/*" if closing else self.comment
        return f"{code} {opening} {plain(text)}{closing}"

    def remarks(self, lines: Iterable[str]) -> Iterator[str]:
        """Lines of comment that cannot end early, whatever their text; long ones are broken."""
        for line in lines:
            indent = " " * (len(line) - len(line.lstrip(" ")))
            hanging = f"{indent}  "
            broken = textwrap.wrap(plain(line), 96, initial_indent=indent, subsequent_indent=hanging)
            yield from (f"{self.comment} {part}".rstrip() for part in broken or [""])


def plain(text: str) -> str:
    """A text for a comment: one line, nothing invisible, nothing that begins, ends or continues a comment."""
    shown = "".join(" " if unicodedata.category(c) in _INVISIBLE else c for c in text)
    shown = " ".join(shown.split()).replace("\\", "/")
    while "*/" in shown or "/*" in shown or "??" in shown:
        shown = shown.replace("*/", "* /").replace("/*", "/ *").replace("??", "? ?")
    return shown


def words_of(text: str) -> str:
    """A text as a name: ASCII letters, digits and single underscores, beginning with a letter."""
    folded = unicodedata.normalize("NFKD", text).encode("ascii", "ignore").decode()
    name = re.sub(r"[^A-Za-z0-9]+", "_", folded).strip("_").lower()[:_LONGEST].strip("_")
    if not name:
        return "model"
    return name if name[0].isalpha() else f"m_{name}"


def names_for(texts: Iterable[str], language: Language, taken: Iterable[str] = ()) -> dict[str, str]:
    """A name for each text, all different and none a word of the language."""
    used = {name.lower() for name in taken}
    names: dict[str, str] = {}
    for text in texts:
        base = name = words_of(text)
        number = 2
        while name.lower() in used or name.lower() in language.reserved or _LOCAL.fullmatch(name):
            name, number = f"{base}_{number}", number + 1
        used.add(name.lower())
        names[text] = name
    return names


def _each(pattern: str) -> dict[str, str]:
    return {name: pattern.format(name) for name in _FUNCTIONS}


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


C = Language(
    "C",
    {**_each("{}"), "Abs": "fabs"},
    _words(
        "auto break case char const continue default do double else enum extern float for goto if "
        "inline int long register restrict return short signed sizeof static struct switch typedef "
        "union unsigned void volatile while main in out double_t float_t y0 y1 yn j0 j1 jn gamma "
        "signgam infinity nan asm typeof linux unix errno bool true false null class delete new "
        "template this acos asin atan atan2 cbrt ceil copysign cos cosh erf erfc exp exp2 expm1 fabs "
        "fdim floor fma fmax fmin fmod frexp hypot ilogb ldexp lgamma log log10 log1p log2 logb lrint "
        "lround modf nearbyint nextafter pow remainder remquo rint round scalbln scalbn sin sinh sqrt "
        "tan tanh tgamma trunc"
    ),
    " *",
    _declaration="const {kind} {name} = {text}",
)
PYTHON = Language(
    "Python",
    {**_each("np.{}"), "asin": "np.arcsin", "acos": "np.arccos", "atan": "np.arctan", "Abs": "np.abs"},
    frozenset({*(word.lower() for word in (*keyword.kwlist, *keyword.softkwlist)), "np", "numpy", "lambda"}),
    "#",
    end="",
    brackets=True,
    _choice="np.where({condition}, {yes}, {no})",
    _power="np.power({base}, {exponent})",
    _words={"And": "&", "Or": "|", "Not": "np.logical_not"},
    _truths=("False", "True"),
)
MATLAB = Language(
    "MATLAB",
    {
        **_each("{}"),
        **{name: f"real_{name}" for name in ("sqrt", "log", "asin", "acos")},
        "Abs": "abs",
    },
    _words(
        "break case catch classdef continue do else elseif end end_try_catch end_unwind_protect "
        "endclassdef endenumeration endevents endfor endfunction endif endmethods endparfor "
        "endproperties endswitch endwhile enumeration events for function global if methods otherwise "
        "parfor persistent properties return spmd switch try until unwind_protect "
        "unwind_protect_cleanup while i j e pi eps inf nan na ans true false zeros ones size pick "
        "real_sqrt real_log real_asin real_acos real_power exp sin cos tan atan sinh cosh tanh abs "
        "import"
    ),
    "%",
    continued=" ...",
    _choice="pick({condition}, {yes}, {no})",
    _power="real_power({base}, {exponent})",
    _words={"And": "&", "Or": "|", "Not": "~"},
    _truths=("false", "true"),
)
MODELICA = Language(
    "Modelica",
    {**_each("{}"), "Abs": "abs"},
    _words(
        "algorithm and annotation block break class connect connector constant constrainedby der "
        "discrete each else elseif elsewhen encapsulated end enumeration equation expandable extends "
        "external false final flow for function if import impure in initial inner input loop model "
        "not operator or outer output package parameter partial protected public pure record "
        "redeclare replaceable return stream then true type when while within time real integer "
        "boolean string model abs sign sqrt pre edge change reinit sample"
    ),
    "//",
    _choice="(if {condition} then {yes} else {no})",
    _power="({base}) ^ ({exponent})",
    _words={"And": "and", "Or": "or", "Not": "not "},
    _truths=("false", "true"),
)
