"""Options that say how a measurement file is to be read."""

from __future__ import annotations

from typing import Annotated

import typer

Sheet = Annotated[
    str | None, typer.Option("--sheet", metavar="NAME", help="Sheet, group or struct with the measurement.")
]
Head = Annotated[
    int | None, typer.Option("--head", metavar="ROW", help="Row of the column names, counted from 1.")
]
Columns = Annotated[
    list[str] | None,
    typer.Option(
        "--column",
        metavar="C=NAME",
        help='What a column is, e.g. "force=-Kraft [kN]": sign and unit; repeatable.',
    ),
]
Ignored = Annotated[
    list[str] | None,
    typer.Option("--ignore", metavar="NAME", help="A column that is not wanted; repeatable."),
]
RestLength = Annotated[
    str | None,
    typer.Option("--rest-length", help='Length of the muscle without air and load, e.g. "300 mm".'),
]
Load = Annotated[str | None, typer.Option("--load", help='Mass or force on the muscle, e.g. "6 kg".')]
Supply = Annotated[str | None, typer.Option("--supply", help='Supply pressure, gauge, e.g. "6 bar".')]
Accuracy = Annotated[
    str | None,
    typer.Option(
        "--accuracy", help='Standard deviation by channel, e.g. "length 1 mm, force 0.5 %", or a sensor.'
    ),
]
Experiment = Annotated[
    list[str] | None,
    typer.Option(
        "--experiment",
        metavar="FIELD=VALUE",
        help='More about the test, e.g. "force_zero=2.5 N" or "inclination=45 deg"; repeatable.',
    ),
]
Strict = Annotated[
    bool, typer.Option("--strict", help="Refuse a file instead of assuming what it does not say.")
]
