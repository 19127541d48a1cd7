"""How the cost of reading a file grows with each token that it can repeat.

    python -m tests.benchmarks.linear_reading [--only TEXT] [--most 2.5]

A file is made of ordinary readings with one thing repeated n, 2n and 4n times: characters of a head, brackets
of a unit, columns, remarks, quantities of a sentence, comments, quotes, blocks, keys, groups ... A
doubling may cost `--most` times the processor time. What takes less than `_SHORTEST` says nothing.
"""

from __future__ import annotations

import argparse
import io
import json
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from itertools import pairwise

import numpy as np
from openpyxl import Workbook
from scipy.io import savemat

from mckibben.measurement.reading import Correction, preview_here
from mckibben.physics.errors import InputError

_SHORTEST = 0.05  # s, below which a time is noise
_TIMES = 2  # runs of which the shorter counts
HEAD = "t [s];p [bar];F [N];s [mm]"
ROWS = "\n".join(f"{0.1 * k:.1f};{2 + k % 3};{200 + 10 * (k % 20)};{60 - 3 * (k % 20)}" for k in range(60))


def text(above: str = "", head: str = HEAD, rows: str = ROWS, below: str = "") -> bytes:
    """The readings with something else around them."""
    return "\n".join(part for part in (above, head, rows, below) if part).encode()


def _json(value: object) -> bytes:
    return json.dumps(value).encode()


def _nested(depth: int) -> bytes:
    return (b'{"a":' * depth) + b"1" + b"}" * depth


def _mat(n: int) -> bytes:
    stream = io.BytesIO()
    savemat(stream, {f"v{k}": np.arange(50.0) + k for k in range(n)})
    return stream.getvalue()


def _workbook(rows: int, columns: int) -> bytes:
    book = Workbook(write_only=True)
    sheet = book.create_sheet("a")
    sheet.append([f"F{k} [N]" for k in range(columns)])
    for row in range(rows):
        sheet.append([row + k for k in range(columns)])
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


def _head(head: str) -> bytes:
    """The readings under a head for the force."""
    return text(head=f"{head};p [bar];s [mm];t [s]")


def _rows(row: Callable[[int], str], n: int) -> bytes:
    """Rows of their own under the usual heads."""
    return text(rows="\n".join(row(k) for k in range(n)))


def _columns(heads: Sequence[str], rows: int) -> bytes:
    line = ";".join(["1,5"] * len(heads))
    return "\n".join([";".join(heads), *[line] * rows]).encode()


def _blocks(n: int) -> bytes:
    return "\n\n".join(f"p = {k % 9} bar\ns [mm];F [N]\n1;2\n2;3\n3;4" for k in range(n)).encode()


def _on_their_side(n: int) -> bytes:
    return "\n".join(f"{head};" + ";".join(["1,5"] * n) for head in HEAD.split(";")).encode()


def _one_a_line(n: int) -> bytes:
    rows = (f"{k // 3};{'pFs'[k % 3]};1" for k in range(n))
    return "\n".join(["time;channel;value", *rows]).encode()


def _sentence(word: str) -> Callable[[int], bytes]:
    """A hundred remarks of n words each."""
    return lambda n: text(above="\n".join(f"# remark {k}: {word * n}" for k in range(100)))


_KEYS = {"p_bar": [1, 2, 3], "F_N": [1, 2, 3]}
#: What is repeated -> (smallest n, how the file is made, ending of its name).
TOKENS: Mapping[str, tuple[int, Callable[[int], bytes], str]] = {
    "characters of a head": (10_000, lambda n: _head("F" * n + " [N]"), "csv"),
    "words of a head": (2_000, lambda n: _head("force " * n + " [N]"), "csv"),
    "brackets of a unit": (2_000, lambda n: _head("F [" + "(" * n + "N" + ")" * n + "]"), "csv"),
    "signs of a unit": (5_000, lambda n: _head("F [N" + "/m" * n + "]"), "csv"),
    "columns": (120, lambda n: _columns([f"Kraft{k} [N]" for k in range(n)], 200), "csv"),
    "wide table": (100, lambda n: _columns(["s [mm]", *(f"{k} bar" for k in range(n))], 100), "csv"),
    "rows": (10_000, lambda n: text(rows="\n".join([ROWS] * (n // 60))), "csv"),
    "rows of words": (2_000, lambda n: _rows(lambda k: f"{k};2;3;w{k}", n), "csv"),
    "broken rows": (2_000, lambda n: _rows(lambda k: f"{k};2;x{k};4", n), "csv"),
    "ragged rows": (2_000, lambda n: _rows(lambda k: ";".join(["1"] * (1 + k % 7)), n), "csv"),
    "remarks": (500, lambda n: text(above="# rest length 300 mm\n" * n), "csv"),
    "different remarks": (500, lambda n: text(above="".join(f"# no {k}: 300 mm\n" for k in range(n))), "csv"),
    "remarks below": (2_000, lambda n: text(below="remark of the test\n" * n), "csv"),
    "numbers of remarks": (10, _sentence("3 bar "), "csv"),
    "scales of remarks": (5, _sentence("0-10 V = 0-10 bar, "), "csv"),
    "signs of remarks": (20, _sentence("pull = + , "), "csv"),
    "brackets of remarks": (40, _sentence("("), "csv"),
    "blanks of remarks": (60, _sentence("   "), "csv"),
    "empty comments": (5_000, lambda n: b"<!---->" * n, "csv"),
    "hashes": (20_000, lambda n: b"#" * n + b"\n" + text(), "csv"),
    "blanks": (20_000, lambda n: b" " * n + b"\n" + text(), "csv"),
    "empty lines": (50_000, lambda n: b"\n" * n + text(), "csv"),
    "quotes": (10_000, lambda n: text(rows=ROWS + "\n" + '"1";"2";"3";"4"\n' * n), "csv"),
    "digits of a cell": (20_000, lambda n: text(rows=f"{ROWS}\n1;2;3;" + "4" * n), "csv"),
    "signs of a cell": (20_000, lambda n: text(rows=f"{ROWS}\n1;2;3;" + "-+" * n), "csv"),
    "blocks": (200, _blocks, "csv"),
    "values on their side": (200, _on_their_side, "csv"),
    "one value a line": (2_000, _one_a_line, "csv"),
    "keys": (5_000, lambda n: _json({f"k{k}": k for k in range(n)} | _KEYS), "json"),
    "keys of texts": (5_000, lambda n: _json({f"k{k}_unit": "bar" for k in range(n)} | _KEYS), "json"),
    "arrays": (400, lambda n: _json({f"k{k}": [1.0, 2.0, 3.0] for k in range(n)}), "json"),
    "records": (5_000, lambda n: _json([{"t": k, "p_bar": 2.0, "F_N": 3.0} for k in range(n)]), "json"),
    "depth": (200, _nested, "json"),
    "runs": (200, lambda n: _json({f"run{k}": _KEYS for k in range(n)}), "json"),
    "variables": (200, _mat, "mat"),
    "rows of a sheet": (5_000, lambda n: _workbook(n, 4), "xlsx"),
    "columns of a sheet": (100, lambda n: _workbook(200, n), "xlsx"),
}


def seconds(data: bytes, name: str) -> float:
    """Processor time of a look at a file."""
    times = []
    for _ in range(_TIMES):
        begin = time.process_time()
        with suppress(InputError):
            preview_here(data, name, Correction())
        times.append(time.process_time() - begin)
    return min(times)


def main() -> None:
    """Print the times and what grows faster than allowed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--only", default="")
    parser.add_argument("--most", type=float, default=2.5, help="times the cost of a doubling")
    given = parser.parse_args()
    preview_here(text(), "warm.csv", Correction())
    wrong = 0
    for what, (n, make, ending) in TOKENS.items():
        if given.only not in what:
            continue
        taken = [seconds(make(n * factor), f"a.{ending}") for factor in (1, 2, 4)]
        growth = [after / before if after > _SHORTEST else 0.0 for before, after in pairwise(taken)]
        bad = max(growth) > given.most
        wrong += bad
        shown = " ".join(f"{t:7.3f}" for t in taken)
        sys.stdout.write(
            f"{'GROWS' if bad else 'ok':6} {what:24} n = {n:6} {shown} s   x {max(growth):.2f}\n"
        )
        sys.stdout.flush()
    sys.stdout.write(f"{wrong} grow faster\n")
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
