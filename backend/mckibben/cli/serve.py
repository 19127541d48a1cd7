"""``mckibben serve``: the studio in the browser."""

from __future__ import annotations

import errno
import os
import re
import socket
import ssl
import sys
import threading
import webbrowser
from collections.abc import Sequence
from dataclasses import fields
from pathlib import Path
from types import FrameType

import typer

from mckibben.cli.options import folders
from mckibben.folder import Quotas
from mckibben.physics.errors import InputError

DEFAULT_PORT = 8000
TOKEN_VARIABLE = "MCKIBBEN_TOKEN"
_PORTS_TRIED = 50
_SHORTEST_TOKEN = 16
_USABLE_TOKEN = re.compile(r"[A-Za-z0-9._~-]+")


def run(
    *,
    host: str,
    port: int | None,
    open_browser: bool,
    workers: int | None,
    token_file: Path | None,
    uds: Path | None,
    certificate: tuple[Path, Path | None] | None,
    insecure: bool,
    log_level: str,
    log_json: bool,
    access_log: bool | None,
    quota: Sequence[str],
    presets: Path | None,
    effects: Sequence[Path],
    data: Path | None,
    projects: str | None,
) -> None:
    """Serve until interrupted.

    Raises:
        InputError: the address cannot be used, or a folder does not exist.
    """
    chosen = folders(presets, effects, data)
    stated_token, quotas = _stated_token(token_file), _stated_quotas(quota)
    listening = _bind(host, port) if uds is None else _bind_file(uds)
    if certificate is not None:
        _check_certificate(*certificate)
    # Imported only after the port is bound: errors of the address are reported at once.
    import uvicorn

    from mckibben.documents.studio import unused_files
    from mckibben.server.app import create_app
    from mckibben.server.security import kept_token, new_token
    from mckibben.server.serving import WAITING_CONNECTIONS, serving
    from mckibben.server.settings import Settings, is_every_interface, is_loopback

    actual_port = 0 if uds is not None else int(listening.getsockname()[1])
    if uds is not None:
        host, token = "localhost", stated_token
    elif is_loopback(host):
        token = stated_token or kept_token(chosen.data)
    elif certificate is None and not insecure:
        listening.close()
        raise InputError(
            f"--host {host}: would send the token and all data in clear text over the network",
            hint="give --certfile and --keyfile, or connect with 'ssh -L', or accept it with --insecure",
        )
    else:
        token = stated_token or new_token()
    once = None if token is None else new_token()
    settings = Settings(
        host=host,
        port=actual_port,
        token=token,
        once=once,
        own_account=uds is None and is_loopback(host) and stated_token is None,
        user_presets=chosen.user_presets,
        effects=chosen.effects,
        data=chosen.data,
        projects=projects,
        workers=(os.cpu_count() or 1) if workers is None else workers,
        quotas=quotas,
        log_level=log_level,
        log_json=log_json,
        access_log=access_log,
    )
    scheme = "http" if certificate is None else "https"
    place = _link(scheme, _own_address() if is_every_interface(host) else host, actual_port)
    shown = f"unix:{uds}" if uds is not None else place + f"?token={token}"

    class Server(uvicorn.Server):
        def handle_exit(self, sig: int, frame: FrameType | None) -> None:
            # Streams get their last event before uvicorn closes the connections.
            if app.state.workers is not None:
                threading.Thread(target=app.state.workers.end, daemon=True).start()
            super().handle_exit(sig, frame)

        async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
            await super().shutdown(sockets)
            if uds is not None:
                uds.unlink(missing_ok=True)

        async def startup(self, sockets: list[socket.socket] | None = None) -> None:
            await super().startup(sockets)
            # uvicorn lets the system keep as many as are accepted at once, which is few.
            listening.listen(WAITING_CONNECTIONS)
            if port is None and actual_port != DEFAULT_PORT:
                typer.echo(f"Port {DEFAULT_PORT} is in use; taking {actual_port}.", err=True)
            typer.echo(f"mckibben is ready at {shown} (Ctrl+C stops it)")
            if insecure and uds is None and certificate is None and not is_loopback(host):
                typer.echo(
                    "Token and data are sent in clear text: everybody on the way can read them.", err=True
                )
            sys.stdout.flush()
            if open_browser and uds is None and _has_screen():
                opened = f"{place}?once={once}"
                threading.Thread(target=webbrowser.open, args=(opened,), daemon=True).start()

    app = create_app(settings)
    for sentence in unused_files(app.state.studio, chosen.user_presets):
        typer.echo(sentence, err=True)
    config = serving(app, settings, certificate)
    try:
        Server(config).run(sockets=[listening])
    except KeyboardInterrupt:
        typer.echo("Stopped.", err=True)


def _stated_quotas(texts: Sequence[str]) -> Quotas:
    """What each kind of what is kept may take, from texts such as 'projects=8'."""
    stated = {}
    for text in texts:
        kind, is_named, size = text.rpartition("=")
        kind = kind.strip() if is_named else "measurements"
        try:
            stated[kind] = round(float(size) * 1e9)
        except (ValueError, OverflowError):
            stated[kind] = 0
        known = [field.name for field in fields(Quotas)]
        if kind not in known or stated[kind] <= 0:
            hint = f"e.g. --quota projects=8, for 8 GB; kinds: {', '.join(known)}"
            raise InputError(f"--quota {text}: is no size of what is kept", hint=hint)
    return Quotas(**stated)


def _stated_token(file: Path | None) -> str | None:
    """The token of a file or of the environment; None without one."""
    name, text = f"the environment variable {TOKEN_VARIABLE}", os.environ.get(TOKEN_VARIABLE)
    if file is not None:
        name = f"--token-file {file}"
        try:
            text = file.read_text("utf-8")
        except (OSError, UnicodeError) as error:
            why = error.strerror if isinstance(error, OSError) else "is not a text"
            raise InputError(f"{name}: {why}", hint="name a file with the token in it") from error
    if text is None:
        return None
    token = text.strip()
    if len(token) < _SHORTEST_TOKEN or not _USABLE_TOKEN.fullmatch(token):
        raise InputError(
            f"{name}: is no token",
            hint=f"at least {_SHORTEST_TOKEN} letters, digits, '-', '_', '.', e.g. of 'openssl rand -hex 32'",
        )
    return token


def _bind(host: str, port: int | None) -> socket.socket:
    """A bound socket; without a port, on the first free one from 8000 on."""
    name = host.strip("[]")
    try:
        family, kind, _, _, address = socket.getaddrinfo(name, 0, type=socket.SOCK_STREAM)[0]
    except (OSError, UnicodeError) as error:
        raise _unknown_host(host) from error
    wishes = range(DEFAULT_PORT, DEFAULT_PORT + _PORTS_TRIED) if port is None else [port]
    for wish in wishes:
        # With an explicit protocol asyncio disables Nagle's algorithm; otherwise each answer waits 40 ms.
        listening = socket.socket(family, kind, socket.IPPROTO_TCP)
        if os.name == "posix":
            # On Windows this would let two servers share a port.
            listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listening.bind((address[0], wish, *address[2:]))
            listening.listen(128)
            return listening
        except OSError as error:
            listening.close()
            if error.errno == errno.EADDRINUSE and port is None:
                continue
            raise _refused(host, wish, error) from error
    raise InputError(f"ports {wishes[0]} to {wishes[-1]} are all in use", hint="choose one with --port")


def _bind_file(path: Path) -> socket.socket:
    """A socket bound to a file that only this user can open; one that a dead server has left is replaced."""
    if not hasattr(socket, "AF_UNIX"):
        raise InputError("--uds: this system has no Unix sockets", hint="leave it out")
    listening = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        if path.is_socket():
            with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as probe:
                try:
                    probe.connect(str(path))
                except ConnectionRefusedError:
                    path.unlink()
        before = os.umask(0o177)
        try:
            listening.bind(str(path))
        finally:
            os.umask(before)
        listening.listen(128)
    except OSError as error:
        listening.close()
        raise InputError(
            f"--uds {path}: {error.strerror or error}", hint="name a file that is not there"
        ) from error
    return listening


def _check_certificate(certificate: Path, key: Path | None) -> None:
    try:
        ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER).load_cert_chain(certificate, key)
    except (OSError, ValueError) as error:  # ssl.SSLError is one
        name = f"--certfile {certificate}" + (f" --keyfile {key}" if key else "")
        hint = "a certificate and its key without a password, both PEM"
        raise InputError(f"{name}: {getattr(error, 'strerror', None) or error}", hint=hint) from error


def _refused(host: str, port: int, error: OSError) -> InputError:
    if error.errno == errno.EADDRINUSE:
        return InputError(f"--port {port}: is in use by another program", hint=f"e.g. --port {port + 1}")
    if error.errno in (errno.EACCES, errno.EPERM):
        return InputError(f"--port {port}: needs administrator rights", hint="ports from 1024 on do not")
    if error.errno == errno.EADDRNOTAVAIL:
        return _unknown_host(host)
    return InputError(f"{host}:{port} cannot be opened: {error.strerror or error}")


def _unknown_host(host: str) -> InputError:
    return InputError(f"--host {host}: is not an address of this machine", hint="e.g. 127.0.0.1")


def _own_address() -> str:
    """The address at which other machines reach this one; connecting a datagram socket sends nothing."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("192.0.2.1", 9))
            return str(probe.getsockname()[0])
        except OSError:
            return "127.0.0.1"


def _link(scheme: str, host: str, port: int) -> str:
    name = host.strip("[]")
    shown = f"[{name}]" if ":" in name else name
    return f"{scheme}://{shown}:{port}/"


def _has_screen() -> bool:
    """Without a display a text browser would take over the terminal."""
    return sys.platform in ("win32", "darwin") or bool(
        os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    )
