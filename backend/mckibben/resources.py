"""Where the files that come with the package are, and where the user's are kept."""

from __future__ import annotations

import os
import sys
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent
_CHECKOUT = _PACKAGE.parents[1]


def _packaged_or_checkout(packaged: str, checkout: str) -> Path:
    """``_data/…`` inside an installed wheel, else the folder of the checkout."""
    inside_wheel = _PACKAGE / "_data" / packaged
    return inside_wheel if inside_wheel.is_dir() else _CHECKOUT / checkout


def frontend_folder() -> Path:
    """The only folder that is served to the browser."""
    return _packaged_or_checkout("frontend", "frontend/app")


def presets_folder() -> Path:
    """The presets that come with the package."""
    return _packaged_or_checkout("presets", "presets")


def installed_code_folder() -> Path:
    """Code that was compiled while the package was installed; made by ``backend/compile_kernels.py``."""
    return _PACKAGE / "_data" / "compiled"


def plotly_javascript() -> tuple[Path, str]:
    """The plotly.js bundle inside the installed plotly wheel, and the wheel's version.

    Found without importing plotly, which would cost a third of the server's start.

    Raises:
        FileNotFoundError: plotly is not installed, or its wheel no longer brings the bundle.
    """
    spec = find_spec("plotly")
    if spec is None or not spec.submodule_search_locations:
        raise FileNotFoundError("plotly is not installed; reinstall mckibben with pip")
    path = Path(spec.submodule_search_locations[0]) / "package_data" / "plotly.min.js"
    if not path.is_file():
        raise FileNotFoundError(f"{path} does not exist; install 'plotly>=6.5,<8'")
    return path, version("plotly")


def user_folder() -> Path:
    """Where measurements and saved presets are kept when no folder is named.

    ``MCKIBBEN_DATA`` wins; else the platform's place for application data. Where only the place of earlier
    versions exists (they did not ask platformdirs), it stays in use, so that nothing kept there is lost.
    """
    from platformdirs import user_data_path

    if chosen := os.environ.get("MCKIBBEN_DATA"):
        return Path(chosen).expanduser()
    place, earlier = user_data_path("mckibben", appauthor=False), _earlier_user_folder()
    return earlier if earlier.is_dir() and not place.exists() else place


def cache_folder() -> Path | None:
    """Where compiled code is kept that can be made again; ``MCKIBBEN_CACHE`` is another place or ``off``."""
    if chosen := os.environ.get("MCKIBBEN_CACHE"):
        return None if chosen == "off" else Path(chosen).expanduser()
    from platformdirs import user_cache_path

    return user_cache_path("mckibben", appauthor=False)


def _earlier_user_folder() -> Path:
    home = Path.home()
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA", home / "AppData" / "Local")) / "mckibben"
    if sys.platform == "darwin":
        return home / "Library" / "Application Support" / "mckibben"
    return Path(os.environ.get("XDG_DATA_HOME", home / ".local" / "share")) / "mckibben"
