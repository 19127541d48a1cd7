"""Find a Chromium for the browser tests; where there is none, get one.

Looked for in this order: the environment (``MCKIBBEN_BROWSER``, then ``CHROME_PATH`` and
``PLAYWRIGHT_CHROMIUM_EXECUTABLE_PATH``), the PATH, the one Playwright downloaded earlier. A candidate counts
when it starts: a stub that only says "install the snap", or a browser whose libraries are missing, does not.

Got in this order: as root on Debian from apt, because that comes from where the machine gets its packages
anyway and brings the shared libraries which a bare machine lacks; otherwise, and when apt fails, Playwright's
download. On Ubuntu apt's package is a stub for a snap, so there Playwright comes first.

The headless shell comes before the whole browser: the same pages take a fifth less processor time in it.
"""

from __future__ import annotations

import os
import platform
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path

from tests.one_at_a_time import one_at_a_time

OWN_VARIABLE = "MCKIBBEN_BROWSER"
OTHER_VARIABLES = ("CHROME_PATH", "PLAYWRIGHT_CHROMIUM_EXECUTABLE_PATH")
NAMES = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome", "google-chrome-stable")

# No --no-sandbox: Playwright itself adds it, which root and most containers need, and the only pages opened
# are those of our own server. The rest keeps the browser from doing anything of its own while we measure.
ARGUMENTS = (
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    # Pages of one context share a process, and with it what was compiled: a page opens in half the time.
    "--process-per-site",
    # A script that is parsed while it arrives is not looked for among what was compiled before: Plotly would
    # be parsed again for each page. The rest is Playwright's own choice, which this switch replaces.
    "--disable-features=ScriptStreaming,AvoidUnnecessaryBeforeUnloadCheckSync,DestroyProfileOnBrowserClose,"
    "HttpsUpgrades,HttpsFirstBalancedModeAutoEnable,MediaRouter,PaintHolding,ThirdPartyStoragePartitioning,"
    "OptimizationHints,NetworkTimeServiceQuerying,Translate",
)

# Limits in seconds. Playwright's host is out of reach on some machines and then hangs instead of refusing.
CHECK_LIMIT = 30
APT_LIMIT = 600
DOWNLOAD_LIMIT = 300
DOWNLOAD_CONNECT_LIMIT = 10

APT_ENVIRONMENT = {"DEBIAN_FRONTEND": "noninteractive"}
DRIVER_LIBRARY = "libatomic1"

_LAUNCH = """
from playwright.sync_api import sync_playwright
with sync_playwright() as playwright:
    playwright.chromium.launch().close()
"""

Say = Callable[[str], None]


class NoBrowserError(Exception):
    """No Chromium here and none to be had; the message says what to install."""


@dataclass(frozen=True)
class Browser:
    """A Chromium that starts; ``executable`` is None for Playwright's own, which Playwright finds itself."""

    executable: str | None
    found: str


def find_or_get(say: Say) -> Browser:
    """A Chromium that starts, installed first if need be; `say` is told what makes the tests wait.

    Raises:
        NoBrowserError: there is none and none could be had; or Playwright itself does not start.
    """
    if _driver_failure() is None and (found := find()):
        return found
    with _one_at_a_time(say):
        _need_driver(say)
        if found := find():  # a run beside this one has just installed it
            return found
        failures = []
        for name, command, limit, environment in ways():
            say(f"No Chromium for the browser tests: trying {name} (at most {limit // 60} minutes) ...")
            failure = run(command, limit=limit, environment=environment)
            if found := find():
                say(f"... the browser tests use {found.found}.")
                return found
            failures.append(f"{name}: {failure or 'ran, but left no Chromium that starts'}")
            say(f"... failed: {failures[-1]}")
    raise NoBrowserError(
        "The browser tests need Chromium: install it (Debian: `apt-get install chromium`; elsewhere: "
        f"`{Path(sys.executable).name} -m playwright install --with-deps chromium`) "
        f"or name one in {OWN_VARIABLE}. Tried: {'; '.join(failures)}."
    )


def find() -> Browser | None:
    """The first Chromium that is here and starts, or None.

    Raises:
        NoBrowserError: ``MCKIBBEN_BROWSER`` names one that does not start.
    """
    if named := os.environ.get(OWN_VARIABLE):
        if failure := run([named, "--version"], limit=CHECK_LIMIT):
            raise NoBrowserError(
                f"{OWN_VARIABLE}={named} is not a browser that starts ({failure}): correct or unset it."
            )
        return Browser(named, f"{named} ({OWN_VARIABLE})")
    for executable, found in _candidates():
        if run([executable, "--version"], limit=CHECK_LIMIT) is None:
            return Browser(executable, found)
    if run([sys.executable, "-c", _LAUNCH], limit=CHECK_LIMIT) is None:
        return Browser(None, "Playwright's own Chromium")
    return None


def ways() -> list[tuple[str, Sequence[str], int, Mapping[str, str]]]:
    """How a Chromium can be had on this machine, best first: name, command, limit in seconds, environment."""
    download = (
        "Playwright's download",
        [sys.executable, "-m", "playwright", "install", "--only-shell", "chromium"],
        DOWNLOAD_LIMIT,
        {"PLAYWRIGHT_DOWNLOAD_CONNECTION_TIMEOUT": str(DOWNLOAD_CONNECT_LIMIT * 1000)},
    )
    if not _has_apt():
        return [download]
    shell, apt = (
        (f"apt-get install {package}", _apt_install(package), APT_LIMIT, APT_ENVIRONMENT)
        for package in ("chromium-headless-shell", "chromium")
    )
    if _distribution() != "ubuntu":
        return [shell, apt, download]
    libraries = [sys.executable, "-m", "playwright", "install-deps", "chromium"]
    return [("the libraries of Playwright's Chromium", libraries, APT_LIMIT, APT_ENVIRONMENT), download, apt]


def run(command: Sequence[str], *, limit: float, environment: Mapping[str, str] | None = None) -> str | None:
    """Run a command quietly; None when it succeeded, else why not, in one line.

    It is ended with all its children after `limit` seconds.
    """
    try:
        process = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            env={**os.environ, **(environment or {})},
            start_new_session=True,
        )
    except OSError as error:
        return error.strerror or str(error)
    with process:
        try:
            output, _ = process.communicate(timeout=limit)
        except subprocess.TimeoutExpired:
            _end(process)
            return f"no result within {limit:g} s"
    if process.returncode == 0:
        return None
    lines = [line.strip() for line in output.splitlines() if line.strip()]
    telling = [line for line in lines if line.startswith(("E:", "Error:"))]
    # The first complaint is the cause, where there are complaints; else the last line tells most.
    return (telling[:1] or lines or [f"exit code {process.returncode}"])[-1]


def _candidates() -> Iterator[tuple[str, str]]:
    for variable in OTHER_VARIABLES:
        if named := os.environ.get(variable):
            yield named, f"{named} ({variable})"
    for name in NAMES:
        if path := shutil.which(name):
            yield path, path


def _driver_failure() -> str | None:
    return run([sys.executable, "-m", "playwright", "--version"], limit=CHECK_LIMIT)


def _need_driver(say: Say) -> None:
    """Playwright drives the browser from a Node of its own, which needs a library a bare Debian lacks."""
    failure = _driver_failure()
    if failure and _has_apt():
        say(f"Playwright does not start: trying apt-get install {DRIVER_LIBRARY} ...")
        run(_apt_install(DRIVER_LIBRARY), limit=APT_LIMIT, environment=APT_ENVIRONMENT)
        failure = _driver_failure()
    if failure:
        raise NoBrowserError(
            f"The browser tests need Playwright, which does not start ({failure}): "
            f"install the missing library (Debian and Ubuntu: `apt-get install {DRIVER_LIBRARY}`)."
        )


def _is_root() -> bool:
    return hasattr(os, "geteuid") and os.geteuid() == 0


def _has_apt() -> bool:
    return _is_root() and shutil.which("apt-get") is not None


def _apt_install(package: str) -> list[str]:
    return ["sh", "-c", f"apt-get -q update && apt-get -q install --yes --no-install-recommends {package}"]


def _distribution() -> str:
    try:
        return platform.freedesktop_os_release()["ID"]
    except OSError:
        return ""


def _end(process: subprocess.Popen[str]) -> None:
    if hasattr(os, "killpg"):
        os.killpg(process.pid, signal.SIGKILL)
    else:
        process.kill()


def _one_at_a_time(say: Say) -> AbstractContextManager[None]:
    """Hold back every other test run of this machine and user while this one installs."""
    user = os.getuid() if hasattr(os, "getuid") else 0
    lock = Path(tempfile.gettempdir()) / f"mckibben-browser-{user}.lock"
    return one_at_a_time(lock, lambda: say("Another test run is installing a browser: waiting for it ..."))
