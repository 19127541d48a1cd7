"""``effect``: an effect of your own, begun and checked."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mckibben.cli.app import app
from mckibben.cli.options import AsJson

effect = typer.Typer(
    help="An effect of your own: a file to begin with, and the check of what it claims.",
    no_args_is_help=True,
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.add_typer(effect, name="effect")

#: Exit code of a check that finds something broken.
BROKEN = 3


@effect.command("new")
def new(
    name: Annotated[
        str, typer.Argument(metavar="NAME", help="Its id and the name of its file, e.g. seal_drag.")
    ],
    out: Annotated[
        Path, typer.Option("--out", "-o", metavar="FOLDER", help="Where to write it.", show_default=False)
    ] = Path(),
) -> None:
    """Write a complete effect file to change into your own."""
    from mckibben.application.effect.check import write_template
    from mckibben.cli.output import remark

    path = write_template(name, out)
    remark(f"{path}: change it, then: mckibben effect check {path}; use it with: --effects {path.parent}")


@effect.command("check")
def check(
    file: Annotated[str, typer.Argument(metavar="FILE", help="An effect file, or the id of an effect.")],
    trials: Annotated[
        int, typer.Option(min=0, max=30, help="How often it is hidden in simulated readings and looked for.")
    ] = 3,
    as_json: AsJson = False,
) -> None:
    """Evaluate what an effect file claims: examples, physics, where it is seen, whether it is found again.

    Exit code 3 where not everything is so. The file is Python and is executed.
    """
    from mckibben.application.effect.check import CheckQuestion, effect_to_check
    from mckibben.application.effect.check import check as check_effect
    from mckibben.cli.output import progress, write_json, write_summary
    from mckibben.report.summary.effect import summary_of

    question = CheckQuestion(effect_to_check(file), trials)
    with progress("checking the effect") as watch:
        result = check_effect(question, watch)
    if as_json:
        write_json(result)
    else:
        write_summary(summary_of(result))
    if not result.passed:
        raise typer.Exit(BROKEN)
