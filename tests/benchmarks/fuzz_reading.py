"""Files that a coverage-guided fuzzer makes of real ones, read in this process: no hang, no crash, no memory.

    python -m tests.benchmarks.fuzz_reading [--seconds 3600] [--found FOLDER]

Needs `atheris` (pip install atheris; Linux). It begins with the files of strangers in
`tests/measurement/reading`. A finding is an exception that is no `InputError`, a file of at most 60 kB that
takes more than two minutes, or one allocation of more than 200 MB; the file is left in the folder, and
`--again FILE` reads it once more.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import zipfile
from pathlib import Path

STRANGERS = Path(__file__).resolve().parents[1] / "measurement" / "reading" / "strangers"
NAMES = (
    "a.csv",
    "a.txt",
    "a.json",
    "a.mat",
    "a.h5",
    "a.tdms",
    "a.xlsx",
    "a.parquet",
    "a.lvm",
    "L300mm_3bar.dat",
)
LONGEST, SLOWEST, LARGEST = 60_000, 120, 200  # bytes, s of the clock, MB


def name_of(data: bytes) -> str:
    """The name of a file, by its last byte: what the fuzzer changes."""
    return NAMES[data[-1] % len(NAMES)] if data else NAMES[0]


def main() -> None:
    """Run the fuzzer."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--seconds", type=int, default=3600)
    parser.add_argument("--found", type=Path, default=Path("found"))
    parser.add_argument("--again", type=Path)
    given = parser.parse_args()
    try:
        import atheris
    except ImportError:
        raise SystemExit("this needs atheris: pip install atheris (Linux)") from None

    with atheris.instrument_imports(include=["mckibben.measurement"], enable_loader_override=False):
        from mckibben.measurement.reading import load_readers, preview_here
        from mckibben.physics.errors import InputError

    load_readers()

    def read(data: bytes) -> None:
        try:
            preview_here(data, name_of(data))
        except InputError:
            return

    if given.again is not None:
        read(given.again.read_bytes())
        return
    given.found.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        for place in STRANGERS.glob("*.zip"):
            with zipfile.ZipFile(place) as archive:
                for number, name in enumerate(archive.namelist()):
                    content = archive.read(name)
                    if 0 < len(content) <= LONGEST and not name.endswith((".py", "index.json", "README.md")):
                        (Path(folder) / f"{place.stem}-{number}").write_bytes(content)
        options = [
            f"-max_total_time={given.seconds}", f"-max_len={LONGEST}", f"-timeout={SLOWEST}",
            f"-malloc_limit_mb={LARGEST}", "-rss_limit_mb=4000", f"-artifact_prefix={given.found}/",
        ]  # fmt: skip
        atheris.Setup([sys.argv[0], *options, folder], read)
        atheris.Fuzz()


if __name__ == "__main__":
    main()
