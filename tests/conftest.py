"""What every test gets: a working directory of its own, one place for caches, the real server."""

from __future__ import annotations

import gc
import hashlib
import os
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import hypothesis
import hypothesis.configuration
import pytest

from tests.one_at_a_time import one_at_a_time
from tests.running_server import RunningServer

# Deadlines measure the machine, not the code; examples that failed before are kept by the person who fixes
# them as an explicit @example, not in a database that only one checkout has.
hypothesis.settings.register_profile("mckibben", hypothesis.settings(), deadline=None, database=None)
hypothesis.settings.load_profile("mckibben")


FOLDER = Path(__file__).parent
# What needs no integrator, for the workers that would wait while one of them compiles those.
WITHOUT_KERNELS = ("test_toolchain.py", "robustness/test_malformed_files.py", "measurement/reading")
# What shows that files are read in a process of their own, and at each door that they are.
READ_APART = (
    "measurement/reading/test_process.py",
    "robustness",
    "server/test_event_loop.py",
    "server/test_measurements.py",
    "door/test_measurement.py",
)
# First the one that compiles, beside the tools and 300 copies of a worker that is small yet; then where most
# of the time goes, the longest first: whoever takes one of these last lets the other workers wait. Comparing
# and the cases begin with the same diagnosis: beside each other one would wait for it.
FIRST = (
    "test_toolchain.py",
    "robustness/test_malformed_files.py",
    "frontend/test_transient.py",
    "frontend/test_compare.py",
    "measurement/reading",
    "frontend/test_sizing.py",
    "frontend/test_case.py",
    "frontend/test_compare_flows.py",
    "frontend/test_design.py",
    "frontend/test_accessibility.py",
    "identification/diagnose/test_diagnosis.py",
    "physics/test_drive_model.py",
    "identification/test_hidden_effects.py",
    "server/test_diagnoses.py",
    "physics/test_effect_contract.py",
    "simulation/integrate/test_against_radau.py",
    "identification/test_truth_cases.py",
)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Begin with the files and folders of `FIRST`; the others keep their order."""
    absent = [name for name in (*FIRST, *WITHOUT_KERNELS, *READ_APART) if not (FOLDER / name).exists()]
    assert not absent, f"{__file__} names files that are gone: {absent}"
    items.sort(key=lambda item: place_of(item.path, FIRST))


@cache
def place_of(path: Path, names: tuple[str, ...]) -> int:
    """The number of the first name that is the file or one of its folders; behind all if there is none."""
    places = (FOLDER / name for name in names)
    return next((number for number, place in enumerate(places) if path.is_relative_to(place)), len(names))


def pytest_configure(config: pytest.Config) -> None:
    """Keep the plugins' caches in the ignored folders of the checkout, not wherever pytest was started."""
    # A worker holds more than a gigabyte in the end, which is looked through in vain each time.
    gc.set_threshold(100_000, 50, 100)
    # Some containers forbid it; then each of the programs that tests start compiles all our modules again.
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    # Compiled once for all workers and the programs that tests start; the key holds the sources.
    os.environ["MCKIBBEN_CACHE"] = str(config.rootpath / ".pytest_cache" / "code")
    # numba looks whether a function has changed, not whether one has that it calls: a folder for each state.
    sources = sorted(Path(__file__).with_name("truth").glob("*.py"))
    state = hashlib.sha256(b"".join(file.read_bytes() for file in sources))
    os.environ["NUMBA_CACHE_DIR"] = str(config.rootpath / ".pytest_cache" / f"truth-{state.hexdigest()[:16]}")
    hypothesis.configuration.set_hypothesis_home_dir(config.rootpath / ".hypothesis")
    if config.option.benchmark_storage == "file://./.benchmarks":
        config.option.benchmark_storage = f"file://{config.rootpath}/.benchmarks"


@pytest.fixture(scope="session", autouse=True)
def _own_working_directory(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Tests find their files by absolute path; what they write without one lands in a temporary folder.

    So it does not matter where pytest was started, and two runs at once do not meet.
    """
    started_in = os.getcwd()
    os.chdir(tmp_path_factory.mktemp("working-directory"))
    yield
    os.chdir(started_in)


@pytest.fixture(scope="session")
def compiled_kernels(tmp_path_factory: pytest.TempPathFactory) -> None:
    """The integrators' machine code: of the installation, or compiled by one of the workers for all.

    The latter takes 20 s of processor time, after a change of a kernel.
    """
    from mckibben.simulation.integrate.many import lane_kernels

    with one_at_a_time(tmp_path_factory.getbasetemp().parent / "kernels.lock"):
        lane_kernels.awaited()


@pytest.fixture(scope="module", autouse=True)
def _kernels_before_tests(request: pytest.FixtureRequest) -> None:
    """Workers side by side would otherwise all compile them, and so would the programs that they start.

    The tools that check the sources and the readers need none: they come first, beside the compilation.
    """
    needed = place_of(request.path, WITHOUT_KERNELS) == len(WITHOUT_KERNELS)
    if os.environ.get("PYTEST_XDIST_WORKER") and needed:
        request.getfixturevalue("compiled_kernels")


@pytest.fixture(scope="module", autouse=True)
def _files_read_in_place(request: pytest.FixtureRequest) -> Iterator[None]:
    """Read files in the process of the tests; those of `READ_APART` and programs that are started do not.

    To copy a process of a gigabyte takes three times as long as to read the file of a test.
    """
    if place_of(request.path, READ_APART) < len(READ_APART):
        yield
        return
    from mckibben.measurement import reading

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(reading, "bounded", lambda work, name, load, *, size: work())
        yield


@pytest.fixture(scope="session")
def announce(pytestconfig: pytest.Config) -> Callable[[str], None]:
    """Print a line at once, past pytest's capture: for what makes the run wait."""
    terminal = pytestconfig.pluginmanager.get_plugin("terminalreporter")
    capture = pytestconfig.pluginmanager.get_plugin("capturemanager")

    def say(line: str) -> None:
        if terminal is None or capture is None:
            return
        with capture.global_and_fixture_disabled():
            terminal.ensure_newline()
            terminal.write_line(line, flush=True)

    return say


@pytest.fixture(scope="session")
def server(compiled_kernels: None, tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    """The real server with empty data and preset folders, one for the whole run.

    One process does its long work: what one test made it compile is there for the next.
    """
    with RunningServer(tmp_path_factory.mktemp("server"), arguments=["--workers", "1"]) as running:
        yield running
    assert "Traceback" not in running.output, running.output


@pytest.fixture(scope="session")
def server_url(server: RunningServer) -> str:
    """``http://127.0.0.1:<port>`` of the real server."""
    return server.url
