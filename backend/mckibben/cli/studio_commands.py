"""``serve``, ``curves``, ``inverse`` and ``joint``."""

from __future__ import annotations

from dataclasses import replace
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

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
    ProjectsAddress,
    SavedModelFile,
    with_shared_options,
)
from mckibben.physics.errors import InputError

if TYPE_CHECKING:
    from mckibben.documents.studio import Studio


class LogLevel(StrEnum):
    """What is written to the terminal: this and what is worse."""

    critical = "critical"
    error = "error"
    warning = "warning"
    info = "info"
    debug = "debug"


class LogFormat(StrEnum):
    """How it is written."""

    text = "text"
    json = "json"


@app.command()
def serve(
    host: str = typer.Option(
        "127.0.0.1", help="Address to listen on; any but loopback needs --certfile, or --insecure."
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
    token_file: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Take the token from this file; also MCKIBBEN_TOKEN. Else it is in the file 'token' of the "
            "data folder, and a new one at each start on addresses that others can reach.",
        ),
    ] = None,
    uds: Annotated[
        Path | None,
        typer.Option(
            metavar="PATH", help="Listen on a Unix socket that only you can open, instead of an address."
        ),
    ] = None,
    certfile: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Certificate (PEM): the server speaks HTTPS.")
    ] = None,
    keyfile: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Its key, where it is not in the same file.")
    ] = None,
    insecure: bool = typer.Option(
        False,
        "--insecure",
        help="With --host: send token and data in clear text, which everybody on the way can read.",
    ),
    log_level: Annotated[LogLevel, typer.Option(help="What is written to the terminal.")] = LogLevel.warning,
    log_format: Annotated[
        LogFormat, typer.Option(help="How: lines for people, or a JSON object a line, without data or token.")
    ] = LogFormat.text,
    access_log: bool | None = typer.Option(
        None,
        "--access-log/--no-access-log",
        help="A line for each request. Default: only on addresses that others can reach.",
    ),
    quota: Annotated[
        list[str] | None,
        typer.Option(
            metavar="KIND=GB",
            help="How much what is kept may take on the disk: measurements=4, projects=4, studies=0.5, "
            "diagnoses=0.2, presets=0.1 (the defaults); a number alone is that of measurements. "
            "May be repeated.",
        ),
    ] = None,
    presets: PresetsFolder = None,
    effects: EffectsFolders = None,
    data: DataFolder = None,
    projects: ProjectsAddress = "",
) -> None:
    """Start the studio and open it in the browser."""
    from mckibben.cli.serve import run

    run(
        host=host,
        port=port,
        open_browser=not no_open,
        workers=workers,
        token_file=token_file,
        uds=uds,
        certificate=None if certfile is None else (certfile, keyfile),
        insecure=insecure,
        log_level=log_level.value,
        log_json=log_format is LogFormat.json,
        access_log=access_log,
        quota=quota or [],
        presets=presets,
        effects=effects or [],
        data=data,
        projects=projects or None,
    )


@app.command()
@with_shared_options
def curves(
    muscle: MuscleText = "",
    ideal: Ideal = False,
    effect: EffectIds = None,
    model: SavedModelFile = "",
    pressure: str | None = typer.Option(
        None, help='Gauge pressures, e.g. "1 bar,3 bar"; 1 to 6 bar when left out.'
    ),
    stiffness: bool = typer.Option(
        False,
        "--stiffness",
        help="Also the stiffness: tangent, valve closed, that which the force implies, and the secant.",
    ),
    as_json: AsJson = False,
    *,
    studio: Studio,
) -> None:
    """Force, stiffness, volume and diameter of a muscle over its contraction."""
    from mckibben.application.curves.curves import CurvesQuestion, example_question, pressures_of
    from mckibben.application.curves.curves import curves as curves_of
    from mckibben.cli.options import example_design, start_model
    from mckibben.cli.output import remark, write_json, write_summary
    from mckibben.report.summary.curves import summary_of

    start = start_model(studio, ModelOptions(muscle, ideal, effect or (), model=model))
    example = example_design(muscle, studio)
    question = CurvesQuestion(start) if example is None else example_question(example, start)
    question = replace(question, further_stiffness=stiffness)
    if pressure is not None:
        question = replace(question, pressures=pressures_of(pressure.split(","), "--pressure"))
    result = curves_of(question, studio)
    if as_json:
        write_json(result)
    else:
        write_summary(summary_of(result, muscle or model))
    for misprint in [] if example is None else example.misprints:
        remark(f"misprint of the source: {misprint}")


@app.command()
@with_shared_options
def ask(
    question: Annotated[
        str,
        typer.Argument(
            help='In one line: "How far does a DMSP-20 of 300 mm at 6 bar lift 20 kg, pressure for 15 %?"'
        ),
    ],
    as_json: AsJson = False,
    *,
    studio: Studio,
) -> None:
    """What a muscle does with a load at one pressure: rest, lift, stiffness, pressure for a contraction."""
    from mckibben.application.curves.curves import CurvesQuestion
    from mckibben.application.curves.curves import curves as curves_of
    from mckibben.cli.options import start_model
    from mckibben.cli.output import remark, write_json, write_summary
    from mckibben.documents.asked import read_asked
    from mckibben.report.summary.curves import lift_summary_of

    asked = read_asked(question, [preset.id for preset in studio.library.list("muscles")])
    for part in asked.parts:
        if part.problem is not None:
            remark(f"'{part.text}' is not read: {part.problem}")
    if asked.muscle is None:
        raise InputError("the question names no muscle", hint='"DMSP-20 of 300 mm"')
    if asked.load is None:
        raise InputError("the question states no load", hint='"20 kg"')
    if asked.pressure is None:
        raise InputError("the question states no pressure", hint='"6 bar"')
    length = "" if asked.nominal_length is None else f":{1e3 * asked.nominal_length:.9g}mm"
    start = start_model(studio, ModelOptions(f"{asked.muscle}{length}", False, ()))
    asks = CurvesQuestion(
        start,
        pressures=(asked.pressure,),
        load=asked.load,
        at_pressure=asked.pressure,
        at_contraction=asked.contraction,
    )
    lift = curves_of(asks, studio).lift
    if lift is not None and not as_json:
        write_summary(lift_summary_of(lift, f"{asked.muscle}{length}"))
    elif lift is not None:
        write_json(lift)


class InverseName(StrEnum):
    """What is asked for."""

    pressure = "pressure"
    contraction = "contraction"
    working_range = "working_range"
    stroke_pressure = "stroke_pressure"


@app.command()
@with_shared_options
def inverse(
    question: Annotated[
        InverseName,
        typer.Argument(
            metavar="QUESTION",
            help="pressure (of --force at --length or --contraction), contraction (of --force at "
            "--pressure), working_range (from --preload without pressure to --load at --pressure) or "
            "stroke_pressure (that lifts --load by --stroke).",
        ),
    ],
    muscle: MuscleText = "",
    ideal: Ideal = False,
    effect: EffectIds = None,
    model: SavedModelFile = "",
    force: str | None = typer.Option(None, help='Force of the muscle, e.g. "500 N".'),
    length: str | None = typer.Option(None, help='Its length, e.g. "270 mm".'),
    contraction: str | None = typer.Option(None, help='Its contraction, e.g. "10 %".'),
    pressure: str | None = typer.Option(None, help='Gauge pressure, e.g. "6 bar".'),
    load: str | None = typer.Option(None, help='Load at the end of the stroke, e.g. "200 N".'),
    preload: str | None = typer.Option(None, help="Load at the start of the stroke."),
    stroke: str | None = typer.Option(None, help='From the rest length, e.g. "40 mm".'),
    direction: int | None = typer.Option(
        None, help="Sign of dL/dt, for friction: -1 shortening, 1 lengthening, 0 none."
    ),
    temperature: str | None = typer.Option(None, help='Of the muscle, e.g. "40 degC".'),
    as_json: AsJson = False,
    *,
    studio: Studio,
) -> None:
    """Which pressure, contraction or stroke belongs to a force."""
    from mckibben.application.curves.inverse import answer, question_of_document
    from mckibben.cli.options import start_model
    from mckibben.cli.output import write_json, write_summary
    from mckibben.documents.inverse import read_inverse
    from mckibben.report.summary.inverse import summary_of

    stated = {
        "force": force, "length": length, "contraction": contraction, "pressure": pressure, "load": load,
        "preload": preload, "stroke": stroke, "direction": direction, "temperature": temperature,
    }  # fmt: skip
    start = start_model(studio, ModelOptions(muscle, ideal, effect or (), model=model))
    try:
        document = read_inverse({"question": question.value, **stated})
        result = answer(question_of_document(document, start), studio)
    except InputError as error:
        option = f"--{error.field}: " if error.field in stated else ""
        raise InputError(f"{option}{error.message}", hint=error.hint) from error
    if as_json:
        write_json(result)
    else:
        write_summary(summary_of(result, muscle or model))


@app.command()
@with_shared_options
def joint(
    file: Annotated[
        str,
        typer.Argument(
            metavar="JOINT", help="A joint document, or a drive of two muscles on a pulley: file or preset."
        ),
    ],
    pressures: Annotated[
        list[str] | None,
        typer.Option(
            metavar="P1,P2",
            help='Gauge pressures, one of each muscle, e.g. "4 bar, 2 bar"; may be repeated.',
        ),
    ] = None,
    angle: str | None = typer.Option(None, help='Angle at which the joint is to rest, e.g. "10 deg".'),
    stiffness: str | None = typer.Option(
        None, help='Stiffness that it is to have there, e.g. "20 N*m/rad"; the least when left out.'
    ),
    torque: str | None = typer.Option(None, help='External torque, e.g. "-2 N*m"; + to greater angles.'),
    highest_pressure: str | None = typer.Option(
        None, help="Gauge pressure that the muscles can be given; 6 bar when left out."
    ),
    direction: int | None = typer.Option(None, help="Sign of the motion, for friction; none when left out."),
    points: int | None = typer.Option(None, help="Number of angles; 121 when left out."),
    as_json: AsJson = False,
    *,
    studio: Studio,
) -> None:
    """Torque and stiffness of a joint over its angle, and pressures for an angle and a stiffness."""
    from mckibben.application.joint.joint import JointQuestion, joint_statics
    from mckibben.cli.output import write_json, write_summary
    from mckibben.documents.joint import joint_of, named_joint
    from mckibben.documents.joint_question import read_joint_question
    from mckibben.documents.located import at_file
    from mckibben.report.summary.joint import summary_of

    document = named_joint(file, studio)
    try:
        stated = joint_of(document, studio)
    except InputError as error:
        raise at_file(file, error.field, error.message, error.hint) from error
    asked = {
        "pressures": pressures, "angle": angle, "stiffness": stiffness, "torque": torque,
        "highest_pressure": highest_pressure, "direction": direction, "points": points,
    }  # fmt: skip
    try:
        result = joint_statics(JointQuestion(stated, read_joint_question(asked)))
    except InputError as error:
        name = (error.field or "").partition(".")[0]
        option = f"--{name.replace('_', '-')}: " if name in asked else ""
        raise InputError(f"{option}{error.message}", hint=error.hint) from error
    if as_json:
        write_json(result)
    else:
        write_summary(summary_of(result, document.title or file))
