"""Options of ``mckibben linearise``."""

from __future__ import annotations

from typing import Annotated

import typer

At = Annotated[
    str | None,
    typer.Option(
        "--at",
        help='Operating point: "position 40 mm", "contraction 10 %", "pressure 3 bar" or, of a regulator, '
        '"command 50 %". Default: the middle of the positions that can be held.',
    ),
]
Source = Annotated[str, typer.Option("--input", help="command, supply_pressure or load_force.")]
Output = Annotated[
    str, typer.Option("--output", help="position, velocity, pressure, force, mass_flow or position_reading.")
]
Amplitudes = Annotated[
    str | None,
    typer.Option("--amplitudes", help='Sines for the nonlinear drive, e.g. "1 %,20 %"; "none" for no sweep.'),
]
SlidingSpeed = Annotated[
    str | None,
    typer.Option(
        "--sliding-speed",
        help="Speed of the load at which models that slide against dry friction have the slopes of friction "
        'and damping, e.g. "20 mm/s". Default: they just slide.',
    ),
]
DesignGoals = Annotated[
    str | None,
    typer.Option(
        "--design",
        help='Also design a position controller, e.g. "overshoot 5 %, settling 0.5 s, step 10 mm, '
        'no saturation".',
    ),
]
