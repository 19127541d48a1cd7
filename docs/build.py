"""Builds these pages into ``site/``: ``python docs/build.py``. Nothing is loaded from elsewhere.

It is also the hook that MkDocs calls: pages of effects, presets, commands and Python names are made from the
program, the paper's page from its list, and the stories of ``presets/examples`` are run and shown with what
they print and draw (``--no-stories`` leaves them as they stand in their files).
"""

from __future__ import annotations

import ast
import contextlib
import inspect
import io
import os
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

DOCS = Path(__file__).resolve().parent
ROOT = DOCS.parent
STORIES = ("first_steps", "missing_effect", "sizing_a_lift", "own_parts")
EXAMINATIONS = (
    "diagnosis", "second_truth", "strangers", "held_out", "decided", "probabilities", "nulls", "entries",
    "measured",
)  # fmt: skip
_AXES = {"1": (100.0, "%"), "Pa": (1e-5, "bar"), "m": (1e3, "mm"), "s": (1.0, "s"), "N": (1.0, "N")}


def cell(text: object) -> str:
    """A text as a cell of a table."""
    return " ".join(str(text).split()).replace("|", "\\|")


def table(head: list[str], rows: list[list[object]]) -> str:
    """A Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(cell(each) for each in line) + " |" for line in lines)


def effect_pages() -> Iterator[tuple[str, str]]:
    """A page for each effect, from its file, and their index."""
    from mckibben.physics.catalogue import default_catalogue

    catalogue = default_catalogue()
    rows: list[list[object]] = [
        [f"[{effect.title}]({effect.id}.md)", f"`{effect.id}`", effect.family, effect.type]
        for effect in catalogue.values()
    ]
    head = (
        "# Effects\n\nEach page is made from the file of its effect; `mckibben effects` lists them too.\n\n"
    )
    yield "reference/effects/index.md", head + table(["effect", "id", "family", "type"], rows) + "\n"
    for effect in catalogue.values():
        yield f"reference/effects/{effect.id}.md", effect_page(effect, catalogue)


def effect_page(effect: Any, catalogue: Any) -> str:
    """Law, picture of its experiment, twins, source."""
    from mckibben.physics.catalogue import BUILT_IN_FOLDER
    from mckibben.report.formula import equation, formula

    parameters = [
        [
            f"`{p.name}`", formula(p.symbol), p.unit, f"{p.default:g}", f"{p.lower:g} to {p.upper:g}",
            p.description, f"{p.source.text} ({p.source.grade})",
        ]
        for p in effect.parameters
    ]  # fmt: skip
    twins = [
        [f"[{catalogue[twin.effect].title}]({twin.effect}.md)" if twin.effect in catalogue else twin.effect,
         twin.separated_by]
        for twin in effect.confused_with
    ]  # fmt: skip
    examples = [
        [
            e.quantity, f"{e.expected:g}",
            ", ".join(f"{name} {value:g}" for name, value in {**e.parameters, **e.state}.items()),
            f"{e.source.text} ({e.source.grade})",
        ]
        for e in effect.examples
    ]  # fmt: skip
    source = (BUILT_IN_FOLDER / f"{effect.id}.py").read_text("utf-8")
    parts = [
        f"# {effect.title}",
        f"`{effect.id}` · {effect.family} · {effect.type} · shows in {', '.join(sorted(effect.kinds))}",
        effect.cause,
        equation(effect.equation),
        "## Parameters",
        table(["name", "symbol", "unit", "default", "bounds", "what it is", "source (grade)"], parameters),
        "Parameters scale with the muscle where the physics does; the numbers here are those of a DMSP-20.",
        "## How it shows",
        effect.signature.text[:1].upper() + effect.signature.text[1:] + ".",
        *pictures(effect, catalogue),
        "## Confused with",
        table(["effect", "what separates both"], twins) if twins else "Nothing in the catalogue.",
        "## References",
        "\n".join(f"- {each.text} ({each.grade})" for each in effect.references),
        "## Worked examples",
        table(["quantity", "SI", "where", "source (grade)"], examples),
        f'??? note "Source: {effect.id}.py"\n\n    ```python\n'
        + "\n".join(f"    {line}".rstrip() for line in source.splitlines())
        + "\n    ```",
    ]
    return "\n\n".join(str(part) for part in parts) + "\n"


def pictures(effect: Any, catalogue: Any) -> Iterator[str]:
    """What it leaves in the readings of each kind of test, as drawings."""
    from mckibben.application.diagnose.signatures import USUAL_PRESSURE
    from mckibben.application.effect.states import MUSCLE
    from mckibben.identification.diagnose.atlas import pictures as pictures_of
    from mckibben.identification.diagnose.atlas import stand_ins
    from mckibben.identification.predict.fit_model import FitModel
    from mckibben.report.chart import chart, family
    from mckibben.report.marks import Axis, Line

    base = FitModel(MUSCLE)
    for name in stand_ins(effect, catalogue, {}):
        base = base.adding(catalogue[name])
    yield "What a DMSP-20 of 300 mm reads with the effect at its usual size, minus without it:"
    for picture in pictures_of(base, effect, pressure=USUAL_PRESSURE):
        along, across = _AXES[picture.x_unit], _AXES.get(picture.unit, (1.0, picture.unit))
        lines = [
            Line(curve.x * along[0], curve.y * across[0], label=level(picture, curve.level), colour=colour)
            for curve, colour in zip(picture.curves, family(len(picture.curves)), strict=True)
        ]
        drawing = chart(
            Axis(picture.x, along[1]), Axis(picture.quantity, across[1], zero=True), lines,
            title=f"{effect.title} in a test of the kind {picture.kind}", height=220.0,
        )  # fmt: skip
        yield f"**{picture.kind}**, {picture.quantity}\n\n<div>{drawing}</div>"


def level(picture: Any, value: float) -> str:
    """What the rig held."""
    if not picture.held:
        return ""
    scale, unit = _AXES[picture.held_unit]
    return f"{value * scale:.3g} {unit}"


def preset_page() -> str:
    """All presets with their ids."""
    from mckibben.documents.studio import Studio
    from mckibben.resources import presets_folder

    library = Studio(presets=presets_folder()).library
    parts = ["# Presets\n\nThese ids stand wherever a file may. Every value has its unit, source and grade: "
             "`mckibben presets muscles --json`."]  # fmt: skip
    for kind in library.kinds:
        rows: list[list[object]] = [[f"`{p.id}`", p.heading, p.maker] for p in library.list(kind)]
        parts.append(f"## {kind.capitalize()}\n\n" + table(["id", "title", "maker"], rows))
    return "\n\n".join(parts) + "\n"


def command_page() -> str:
    """The commands with all options, from the program."""
    import typer

    from mckibben import cli

    parts = ["# Commands\n\nMade from `--help`. `--json` prints one JSON object on stdout, all else goes to "
             "stderr. Exit code 0: done; 2: bad input, in one line; 3: the answer is no."]  # fmt: skip

    def walk(command: Any, name: str) -> None:
        if hasattr(command, "commands"):
            for word, inner in command.commands.items():
                walk(inner, f"{name} {word}")
            return
        rows: list[list[object]] = []
        for each in command.params:
            names = (
                getattr(each, "metavar", None) if each.param_type_name == "argument" else ", ".join(each.opts)
            )
            rows.append([f"`{names or each.name}`", getattr(each, "help", None) or ""])
        parts.append(f"## {name}\n\n{inspect.cleandoc(command.help or '')}\n\n{table(['', ''], rows)}")

    walk(typer.main.get_command(cli.app), "mckibben")
    return "\n\n".join(parts) + "\n"


def python_page() -> str:
    """The public names with their signatures and docstrings."""
    import mckibben as mk
    import mckibben.effects as _  # noqa: F401 - the module, whose name is that of a function
    from mckibben.door import drive, model

    parts = ["# Python\n\n`import mckibben as mk`. Every result prints as in a terminal, shows tables in a "
             "notebook, and has `to_frame()`, `to_dict()`, `plot()`, `save()`; all keys of `--json`. "
             "With every field of every result: `/help/python` of a running server."]  # fmt: skip
    for name in sorted(mk.__all__):
        found = getattr(mk, name)
        if not callable(found):
            continue
        parts.append(f"## mk.{name}\n\n" + documented(found, f"mk.{name}"))
        if inspect.isclass(found) and found.__module__ in (
            drive.__name__,
            model.__name__,
            "mckibben.door.measurement",
        ):
            parts += [
                f"### mk.{name}.{word}\n\n" + documented(getattr(found, word), f"{word}")
                for word in sorted(vars(found))
                if not word.startswith("_") and callable(getattr(found, word))
            ]
    module = sys.modules["mckibben.effects"]
    parts.append(f"## mckibben.effects\n\n{inspect.cleandoc(module.__doc__ or '')}\n\nNames: "
                 + ", ".join(f"`{name}`" for name in module.__all__))  # fmt: skip
    return "\n\n".join(parts) + "\n"


def documented(found: Any, name: str) -> str:
    """Signature and docstring of a name."""
    try:
        signature = str(inspect.signature(found)).replace("'", "")
    except (TypeError, ValueError):
        signature = "()"
    return f"```python\n{name}{signature}\n```\n\n```text\n{inspect.cleandoc(found.__doc__ or '')}\n```"


def paper_page() -> str:
    """The list of the paper's equations, misprints and figures."""
    text = (ROOT / "backend/mckibben/physics/PAPER.md").read_text("utf-8")
    return text.replace("`docs/reference/scenarios.md`", "[the paper's scenarios](scenarios.md)")  # fmt: skip


def story_page(name: str, run: bool) -> str:
    """A story as a page: its cells, and with ``run`` what they print, show and draw."""
    path = ROOT / "presets" / "examples" / f"{name}.py"
    cells = re.split(r"^# %%(.*)$", path.read_text("utf-8"), flags=re.MULTILINE)[1:]
    scope: dict[str, Any] = {"__name__": "__main__", "__file__": str(path)}
    parts, drew = [], False
    for kind, body in zip(cells[::2], cells[1::2], strict=True):
        if "[markdown]" in kind:
            parts.append(
                "\n".join(line.removeprefix("#").removeprefix(" ") for line in body.strip().splitlines())
            )
            continue
        parts.append(f"```python\n{body.strip()}\n```")
        if run:
            shown = outcome(body, scope)
            drew = drew or "plotly-graph-div" in shown
            parts.append(shown)
    if drew:
        parts.insert(1, '<script src="../assets/plotly.min.js"></script>')
    parts.append(f"The file: `mckibben examples {path.name} -o .`")
    return "\n\n".join(part for part in parts if part) + "\n"


def outcome(body: str, scope: dict[str, Any]) -> str:
    """Run a cell as a notebook does; its output and the value of its last line as Markdown and HTML."""
    tree = ast.parse(body)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    said = io.StringIO()
    value = None
    with contextlib.redirect_stdout(said):
        exec(compile(tree, "<story>", "exec"), scope)
        if isinstance(last, ast.Expr):
            value = eval(compile(ast.Expression(last.value), "<story>", "eval"), scope)
    parts = [f"```text\n{said.getvalue().rstrip()}\n```"] if said.getvalue().strip() else []
    if hasattr(value, "to_plotly_json"):
        parts.append(value._html(False))
    elif value is not None and hasattr(value, "_repr_html_"):
        parts.append(f"<div>{value._repr_html_()}</div>")
    return "\n\n".join(parts)


def on_files(files: Any, config: Any) -> Any:
    """MkDocs: add the pages that are made."""
    from mkdocs.structure.files import File

    from mckibben.resources import plotly_javascript

    run = os.environ.get("MCKIBBEN_DOCS_STORIES", "run") == "run"
    pages = [
        *effect_pages(),
        ("reference/presets.md", preset_page()),
        ("reference/commands.md", command_page()),
        ("reference/python.md", python_page()),
        ("reference/paper.md", paper_page()),
        *((f"tutorials/{name}.md", story_page(name, run)) for name in STORIES),
    ]
    for place, text in pages:
        files.append(File.generated(config, place, content=text))
    if run:
        files.append(
            File.generated(config, "assets/plotly.min.js", content=plotly_javascript()[0].read_bytes())
        )
    return files


def on_page_markdown(markdown: str, page: Any, config: Any, files: Any) -> str:
    """MkDocs: the figures that examinations reached, from the head of each."""
    if page.file.src_uri != "explanation/how-often-right.md":
        return markdown
    parts = [markdown, "## What was reached\n\nEach from the head of the examination that measures it."]
    for name in EXAMINATIONS:
        source = (ROOT / "tests" / "benchmarks" / f"{name}.py").read_text("utf-8")
        text = (ast.get_docstring(ast.parse(source)) or "").replace("``", "`")
        parts.append(f"### tests.benchmarks.{name}\n\n{text}")
    return "\n\n".join(parts) + "\n"


def on_config(config: Any) -> Any:
    """MkDocs: the effects in the navigation are those of the catalogue."""
    from mckibben.physics.catalogue import default_catalogue

    for part in config.nav:
        for entries in part.values() if isinstance(part, dict) else ():
            for place, entry in enumerate(entries) if isinstance(entries, list) else ():
                if isinstance(entry, dict) and entry.get("Effects"):
                    pages = [f"reference/effects/{name}.md" for name in default_catalogue()]
                    entries[place] = {"Effects": ["reference/effects/index.md", *pages]}
    return config


def main() -> int:
    """Build the site; the exit code."""
    import subprocess

    if "--no-stories" in sys.argv:
        os.environ["MCKIBBEN_DOCS_STORIES"] = "shown"
    environment = {**os.environ, "NO_MKDOCS_2_WARNING": "1"}
    return subprocess.call(
        [sys.executable, "-m", "mkdocs", "build", "-q", "-f", str(ROOT / "mkdocs.yml")], env=environment
    )


if __name__ == "__main__":
    sys.exit(main())
