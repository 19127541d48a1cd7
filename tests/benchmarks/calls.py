"""Nanoseconds of one call of the exported C beside one of our own functions, on the same states:

    python -m tests.benchmarks.calls [--calls 200000]

Of the muscle (force, stiffness, volume and their derivatives): each effect alone and combinations. Of drives:
right-hand side and Jacobian. The C is built by gcc -O2; ours is the machine code of the engine, called for
many rows at once and for a single row from Python; of a muscle with parts in series both look for the length
of the muscle alone. gcc is needed.
"""

from __future__ import annotations

import argparse
import subprocess
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from mckibben.export.formats.c import sources
from mckibben.export.subject import Subject
from mckibben.simulation.integrate.system import compiled_drive
from mckibben.simulation.statics.compiled import compiled_state
from mckibben.simulation.statics.model import settle
from tests.benchmarks.diagnosis import say
from tests.export.models import cases, random_inputs, subject
from tests.export.test_c import drive, packed, random_rows

ROWS = 1000
DRIVES = ("lift", "pair", "regulated")

_HEAD = """#define _POSIX_C_SOURCE 199309L
#include "model.h"
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
static double now(void)
{
    struct timespec at;
    clock_gettime(CLOCK_MONOTONIC, &at);
    return 1e9 * (double)at.tv_sec + (double)at.tv_nsec;
}
static void read_all(double *values, size_t count)
{
    if (fread(values, sizeof(double), count, stdin) != count) {
        exit(1);
    }
}
"""
_MUSCLE = """
static model_input given[ROWS];
int main(void)
{
    double row[WIDTH], sum = 0.0;
    for (int i = 0; i < ROWS; ++i) {
        read_all(row, WIDTH);
        model_rest(&given[i]);
        given[i].length = row[0];
        given[i].pressure = row[1];
        given[i].velocity = row[2];
        given[i].direction = row[3];
        given[i].temperature = row[4];
STATES
    }
    const double begin = now();
    for (int call = 0; call < CALLS; ++call) {
        model_result out;
        model_at(&given[call % ROWS], &out);
        sum += out.force + out.stiffness + out.volume;
    }
    printf("%.2f %g\\n", (now() - begin) / CALLS, sum);
    return 0;
}
"""
_DRIVE = """
static double y[ROWS][MODEL_DRIVE_STATES], u[ROWS][MODEL_DRIVE_INPUTS], w[ROWS][MODEL_DRIVE_SWITCHES];
int main(void)
{
    double k[MODEL_DRIVE_CONSTANTS], rates[MODEL_DRIVE_STATES], sum = 0.0;
    double matrix[MODEL_DRIVE_STATES * MODEL_DRIVE_STATES];
    model_prepare(model_parameters, k);
    for (int i = 0; i < ROWS; ++i) {
        read_all(y[i], MODEL_DRIVE_STATES);
        read_all(u[i], MODEL_DRIVE_INPUTS);
        read_all(w[i], MODEL_DRIVE_SWITCHES);
    }
    const double begin = now();
    for (int call = 0; call < CALLS; ++call) {
        model_rates(y[call % ROWS], k, u[call % ROWS], w[call % ROWS], rates);
        sum += rates[1];
    }
    const double middle = now();
    for (int call = 0; call < CALLS; ++call) {
        model_jacobian(y[call % ROWS], k, u[call % ROWS], w[call % ROWS], matrix);
        sum += matrix[1];
    }
    printf("%.2f %.2f %g\\n", (middle - begin) / CALLS, (now() - middle) / CALLS, sum);
    return 0;
}
"""


def timed(model: Subject, text: str, rows: np.ndarray, calls: int) -> list[float]:
    """What a program prints that is built from the C of a model by gcc -O2, best of three runs."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for ending, part in zip(("h", "c"), sources(model, "model"), strict=True):
            (folder / f"model.{ending}").write_text(part, "utf-8")
        body = text.replace("CALLS", str(calls)).replace("ROWS", str(len(rows)))
        (folder / "main.c").write_text(_HEAD + body, "utf-8")
        command = ["gcc", "-std=c99", "-O2", "-o", "program", "main.c", "model.c", "-lm"]
        subprocess.run(command, cwd=folder, check=True)
        given = np.ascontiguousarray(rows, float).tobytes()
        answers = [
            subprocess.run([folder / "program"], input=given, capture_output=True, check=True).stdout.split()
            for _ in range(3)
        ]
    return [min(float(answer[place]) for answer in answers) for place in range(len(answers[0]) - 1)]


def ours(function: Callable[[], object], calls: int, repeats: int) -> float:
    """Nanoseconds of one of so many calls within a function, best of some repeats."""
    best = float("inf")
    for _ in range(repeats):
        begin = time.perf_counter_ns()
        function()
        best = min(best, (time.perf_counter_ns() - begin) / calls)
    return best


def of_muscle(name: str, calls: int) -> tuple[float, float, float]:
    """C, and our machine code by rows and alone [ns]."""
    model = subject(name)
    inputs = random_inputs(model, ROWS, 1)
    states = len(model.equations.states)
    text = _MUSCLE.replace("WIDTH", str(len(inputs)))
    text = text.replace(
        "STATES", "\n".join(f"        given[i].states[{k}] = row[{k + 5}];" for k in range(states))
    )
    (c,) = timed(model, text, np.column_stack(list(inputs.values())), calls)
    compiled = compiled_state(model.statics.effects, memory=True)
    constants = compiled.pack(model.statics.muscle, model.statics.values)
    known = {each: inputs.get(each, np.zeros(ROWS)) for each in compiled.inputs}
    single = {each: values[:1] for each, values in known.items()}
    with np.errstate(all="ignore"):
        rows = ours(lambda: settle(compiled, constants, known), ROWS, 20)
        alone = ours(lambda: [settle(compiled, constants, single) for _ in range(200)], 200, 5)
    return c, rows, alone


def of_drive(name: str, calls: int) -> tuple[list[float], list[float]]:
    """Right-hand side and Jacobian: of C, and ours called singly from Python [ns]."""
    runnable = drive(name).runnable
    assert runnable is not None
    states, inputs, switches = random_rows(runnable, 1)
    c = timed(drive(name), _DRIVE, np.hstack([states, inputs, switches]), calls)
    compiled = compiled_drive(runnable.drive.structure)
    point, w = packed(compiled, runnable, states[0], inputs[0]), switches[0]
    own = [
        ours(lambda call=call: [call(point, w) for _ in range(500)], 500, 5)  # type: ignore[misc]
        for call in (compiled.rates, compiled.jacobian)
    ]
    return c, own


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--calls", type=int, default=200_000)
    calls = parser.parse_args().calls
    say(f"{'muscle':28}{'C [ns]':>10}{'ours, a row of many':>22}{'ours, alone':>14}")
    found = []
    for name in cases():
        found.append(of_muscle(name, calls))
        say(f"{name:28}{found[-1][0]:10.0f}{found[-1][1]:22.0f}{found[-1][2]:14.0f}")
    middle = np.median(np.array(found), axis=0)
    say(f"{'median':28}{middle[0]:10.0f}{middle[1]:22.0f}{middle[2]:14.0f}")
    say(f"{'drive':28}{'C: rates':>10}{'Jacobian':>22}{'ours: rates':>14}{'Jacobian':>12}")
    for name in DRIVES:
        c, own = of_drive(name, calls)
        say(f"{name:28}{c[0]:10.0f}{c[1]:22.0f}{own[0]:14.0f}{own[1]:12.0f}")


if __name__ == "__main__":
    main()
