"""``presets``, ``effects`` and ``examples``: what there is."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mckibben.cli.app import app
from mckibben.cli.options import AsJson, with_shared_options
from mckibben.physics.errors import InputError, did_you_mean

if TYPE_CHECKING:
    from mckibben.documents.studio import Studio


@app.command("presets")
@with_shared_options
def list_presets(
    kind: Annotated[
        str,
        typer.Argument(
            metavar="[KIND]", help="muscles, valves, tubes, drives, tasks, ...; all when left out."
        ),
    ] = "",
    as_json: AsJson = False,
    *,
    studio: Studio,
) -> None:
    """The presets: muscles, valves, tubes, drives, tasks, measurements and the others, with their ids."""
    from mckibben.application.listing import preset_cards
    from mckibben.cli.output import write_json, write_summary
    from mckibben.report.summary.listing import presets_summary

    kinds = studio.library.kinds
    if kind and kind not in kinds:
        raise InputError(f"{kind}: there is no such kind of presets", hint=did_you_mean(kind, kinds))
    found = {each: list(preset_cards(studio, each).values()) for each in ([kind] if kind else kinds)}
    if as_json:
        write_json({each: [dict(card.document) for card in cards] for each, cards in found.items()})
    else:
        write_summary(presets_summary(found))


@app.command("effects")
@with_shared_options
def list_effects(
    effect: Annotated[
        str,
        typer.Argument(metavar="[ID]", help="An effect: its law, parameters and twins; all when left out."),
    ] = "",
    as_json: AsJson = False,
    *,
    studio: Studio,
) -> None:
    """The physical effects: all in one table, or the law, the parameters and the twins of one."""
    from mckibben.application.listing import effect_cards
    from mckibben.cli.output import write_json, write_summary
    from mckibben.report.summary.listing import effect_summary, effects_summary

    cards = effect_cards(studio)
    if effect and effect not in cards:
        raise InputError(f"{effect}: there is no such effect", hint=did_you_mean(effect, cards))
    if as_json:
        chosen = [cards[effect]] if effect else list(cards.values())
        write_json({"effects": [_as_json(card) for card in chosen]})
    else:
        write_summary(effect_summary(cards[effect]) if effect else effects_summary(cards.values()))


def _as_json(card: object) -> dict[str, object]:
    from mckibben.application.listing import EffectCard

    assert isinstance(card, EffectCard)  # noqa: S101
    return {
        name: getattr(card, name)
        for name in ("id", "title", "family", "type", "cause", "equation")
    } | {
        "kinds": sorted(card.kinds),
        "confused_with": dict(card.confused_with),
        "parameters": {
            name: {
                "symbol": p.symbol, "unit": p.unit, "default": p.default, "lower": p.lower, "upper": p.upper,
                "source": p.source.text, "grade": p.source.grade, "description": p.description,
            }
            for name, p in card.parameters.items()
        },
    }  # fmt: skip


@app.command("examples")
def list_examples(
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="[NAME...]", help="Examples to copy; with -o and without a name, all."),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option("--out", "-o", metavar="FOLDER", help="Where to copy them. Default: this folder."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Example files for every command: list them, or copy them."""
    from mckibben.application.listing import copy_examples, example_cards
    from mckibben.cli.output import remark, write_json, write_summary
    from mckibben.report.summary.listing import examples_summary

    cards = example_cards()
    if not names and out is None:
        if as_json:
            write_json({"examples": [asdict(card) for card in cards.values()]})
            return
        write_summary(examples_summary(cards.values()))
        remark("copy them all with: mckibben examples -o FOLDER; one of them with: mckibben examples NAME")
        return
    copied = copy_examples(names or [], out or Path())
    if as_json:
        write_json({"copied": [str(path) for path in copied]})
        return
    if names:
        for path in copied:
            remark(f"copied {path}; try: {cards[path.name].tried_by}")
    else:
        remark(f"copied {len(copied)} examples to {out}; try there: {cards[copied[0].name].tried_by}")
