"""Compilers for an FMU: the system's own, and Zig from its wheel (the extra ``fmu``) for other systems."""

from __future__ import annotations

import importlib.util
import platform
import shutil
import struct
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

FLAGS = ("-std=c99", "-O2", "-shared", "-fPIC", "-fvisibility=hidden", "-ffp-contract=off")
_SUFFIX = {"linux64": ".so", "win64": ".dll", "darwin64": ".dylib"}
_SECONDS = 900.0  # Zig's first compilation for a system compiles the libraries of that system too
_HOSTS = {"Linux": "linux64", "Darwin": "darwin64", "Windows": "win64"}
# An old glibc, so that the binary runs on older systems too.
_TARGETS = {
    "linux64": ("x86_64-linux-gnu.2.17",),
    "win64": ("x86_64-windows-gnu",),
    "darwin64": ("x86_64-macos", "aarch64-macos"),
}
_PAGE = 14  # log2 of the alignment of the parts of a macOS binary
# Operating systems as FMI 3.0 names them.
_SYSTEMS = {"linux64": "linux", "win64": "windows", "darwin64": "darwin"}
_ARCHITECTURES = {"AMD64": "x86_64", "arm64": "aarch64"}
# What an architecture is called in the head of a macOS binary of several.
_PROCESSORS = {"x86_64-macos": (0x01000007, 3), "aarch64-macos": (0x0100000C, 0)}


@dataclass(frozen=True, slots=True)
class Compiler:
    """A command for a platform of FMI; of several commands the results are one binary.

    Attributes:
        platform: "linux64", "win64" or "darwin64".
        commands: program and options for each architecture, by its name.
    """

    platform: str
    commands: tuple[tuple[str, tuple[str, ...]], ...]


@dataclass(frozen=True, slots=True)
class Built:
    """Binaries by their path in the FMU, and why one is missing."""

    binaries: dict[str, bytes]
    remarks: tuple[str, ...]


def compilers() -> tuple[Compiler, ...]:
    """What can compile here, one for each platform."""
    found: dict[str, Compiler] = {}
    if importlib.util.find_spec("ziglang") is not None:
        zig = (sys.executable, "-m", "ziglang", "cc")
        for name, targets in _TARGETS.items():
            found[name] = Compiler(name, tuple((each, (*zig, "-target", each)) for each in targets))
    host = _HOSTS.get(platform.system())
    own = shutil.which("gcc") or shutil.which("cc")
    if host is not None and own is not None and platform.machine() in ("x86_64", "AMD64", "arm64"):
        found.setdefault(host, Compiler(host, (("", (own,)),)))
        if host == "linux64":
            found[host] = Compiler(host, (("", (own,)),))
    return tuple(found[name] for name in _SUFFIX if name in found)


def built(
    sources: Mapping[str, str], identifier: str, using: tuple[Compiler, ...], *, tuples: bool = False
) -> Built:
    """Compile sources for all platforms of some compilers.

    Args:
        sources: name -> text.
        identifier: name of the binaries.
        using: the compilers.
        tuples: whether a folder is named by architecture and system, as in FMI 3.0, not by platform.
    """
    binaries: dict[str, bytes] = {}
    done: set[str] = set()
    remarks = []
    for compiler in using:
        name = f"{identifier}{_SUFFIX[compiler.platform]}"
        try:
            parts = {
                target: _compiled(sources, name, (*command, *FLAGS)) for target, command in compiler.commands
            }
        except (OSError, subprocess.SubprocessError) as error:
            remarks.append(f"The FMU has no binary for {compiler.platform}, {_why(error)}")
            continue
        done.add(compiler.platform)
        if tuples:
            for target, part in parts.items():
                binaries[f"binaries/{_tuple_of(compiler.platform, target)}/{name}"] = part
            continue
        binaries[f"binaries/{compiler.platform}/{name}"] = (
            next(iter(parts.values())) if len(parts) == 1 else universal(parts)
        )
    missing = [name for name in _SUFFIX if name not in done]
    if not using:
        remarks.append(
            "The FMU holds sources only: no C compiler was found here. Install gcc, or the extra 'fmu' "
            "(pip install 'mckibben[fmu]'), and export again; or compile the sources where it is used."
        )
    elif missing and binaries and not remarks:
        remarks.append(
            f"The FMU has binaries for {', '.join(each.platform for each in using)}, not for "
            f"{' and '.join(missing)}; the extra 'fmu' (pip install 'mckibben[fmu]') compiles for them too."
        )
    return Built(binaries, tuple(remarks))


def _why(error: OSError | subprocess.SubprocessError) -> str:
    """What the user should know of a compiler that failed."""
    if isinstance(error, subprocess.TimeoutExpired):
        return (
            f"the compiler was stopped after {error.timeout:.0f} s: the first time it compiles the libraries "
            "of that system too, and keeps them; export again"
        )
    said = getattr(error, "stderr", None) or str(error)
    first = (str(said).strip().splitlines() or ["no message"])[0]
    return f"the compiler failed: {first[:200]}"


def _tuple_of(name: str, target: str) -> str:
    """ "x86_64-linux" of a platform; without a target that of this machine."""
    architecture = target.partition("-")[0] or platform.machine()
    return f"{_ARCHITECTURES.get(architecture, architecture)}-{_SYSTEMS[name]}"


def _compiled(sources: Mapping[str, str], name: str, command: tuple[str, ...]) -> bytes:
    with tempfile.TemporaryDirectory(prefix="mckibben-fmu-") as folder:
        for file, text in sources.items():
            (Path(folder) / file).write_text(text, "utf-8")
        files = [file for file in sources if file.endswith(".c")]
        subprocess.run(
            [*command, "-o", name, *files, "-lm"],
            cwd=folder, check=True, capture_output=True, text=True, timeout=_SECONDS,
        )  # fmt: skip
        return (Path(folder) / name).read_bytes()


def universal(parts: Mapping[str, bytes]) -> bytes:
    """One macOS binary of several architectures ("fat" in Apple's loader.h)."""
    align = 1 << _PAGE
    head = struct.pack(">II", 0xCAFEBABE, len(parts))
    body, at = b"", align
    for target, content in parts.items():
        processor, kind = _PROCESSORS[target]
        head += struct.pack(">IIIII", processor, kind, at, len(content), _PAGE)
        padded = content + bytes(-len(content) % align)
        body, at = body + padded, at + len(padded)
    return head.ljust(align, b"\0") + body
