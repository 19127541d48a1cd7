"""``serve`` and ``curves``."""

from __future__ import annotations

import typer

from mckibben.cli.app import app
from mckibben.cli.options import (
    AsJson,
    DataFolder,
    EffectIds,
    EffectsFolders,
    Ideal,
    ModelOptions,
    MuscleText,
    PresetsFolder,
    SavedModelFile,
)


@app.command()
def serve(
    host: str = typer.Option(
        "127.0.0.1", help="Address to listen on; any address but loopback requires a token."
    ),
    port: int | None = typer.Option(
        None, min=0, max=65535, help="Port; 0 = any free port. Default: 8000, or the next free one."
    ),
    no_open: bool = typer.Option(False, "--no-open", help="Do not open the browser."),
    workers: int | None = typer.Option(
        None,
        min=0,
        max=64,
        help="Processes for diagnoses, sizings and reports; 0 = none of their own. Default: one per core.",
    ),
    presets: PresetsFolder = None,
    effects: EffectsFolders = None,
    data: DataFolder = None,
) -> None:
    """Start the studio and open it in the browser."""
    from mckibben.cli.serve import run

    run(
        host=host,
        port=port,
        open_browser=not no_open,
        workers=workers,
        presets=presets,
        effects=effects or [],
        data=data,
    )


@app.command()
def curves(
    muscle: MuscleText = "",
    ideal: Ideal = False,
    effect: EffectIds = None,
    model: SavedModelFile = "",
    pressure: str | None = typer.Option(
        None, help='Gauge pressures, e.g. "1 bar,3 bar"; 1 to 6 bar when left out.'
    ),
    as_json: AsJson = False,
    presets: PresetsFolder = None,
    effects: EffectsFolders = None,
    data: DataFolder = None,
) -> None:
    """Force, stiffness, volume and diameter of a muscle over its contraction."""
    from mckibben.cli.curves import run
    from mckibben.cli.options import open_studio

    run(
        open_studio(presets, effects, data),
        model=ModelOptions(muscle, ideal, effect or (), model=model),
        pressure=pressure,
        as_json=as_json,
    )
