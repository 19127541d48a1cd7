"""The command line: what each command prints, and one line for whatever is wrong."""

from __future__ import annotations

import json
import os
import re
import signal
import socket
import subprocess
import sys
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from mckibben import __version__, cli
from mckibben.cli.options import ModelOptions, start_model
from mckibben.cli.serve import _bind, _link
from mckibben.resources import presets_folder
from tests.cli.conftest import Run, write
from tests.running_server import MAIN, RunningServer, opener
from tests.shipped import shipped_studio

CSV = "# kind: static\npressure_bar;length_mm;force_N\n" + "".join(
    f"{p};{length};{100 * p + length / 10:.1f}\n" for p in (1, 2, 3) for length in (280, 290, 300)
)
GEOMETRY = {"braid_diameter": "10 mm", "braid_angle": "25 deg", "nominal_length": "100 mm"}
Started = Callable[..., tuple[subprocess.Popen[str], str]]


def refused(result: tuple[int, str, str]) -> str:
    """The one line on stderr of a command line that cannot be used."""
    code, out, err = result
    assert code == 2, err
    assert out == ""
    assert err.count("\n") == 1
    assert err.endswith("\n")
    assert "Traceback" not in err
    return err


# --- curves


def test_curves_print_one_json_object(run: Run) -> None:
    code, out, err = run("curves", "--muscle", "paper", "--pressure", "1 bar,3 bar,6 bar", "--json")
    assert (code, err) == (0, "")
    answer = json.loads(out)
    assert answer["pressure"] == [1e5, 3e5, 6e5]
    assert [row[0] for row in answer["force"]] == pytest.approx([64.3855, 193.1566, 386.3132], abs=1e-4)
    promised = {
        "pressure",
        "length",
        "contraction",
        "force",
        "stiffness",
        "volume",
        "diameter",
        "limits",
        "flags",
    }
    assert promised <= answer.keys()


def test_curves_print_a_table(run: Run) -> None:
    code, out, err = run("curves", "--muscle", "DMSP-20", "--pressure", "6 bar")
    assert code == 0
    assert "6 bar" in out
    assert "Blocked force" in out
    assert "not read in a source" in err
    assert "Dahl friction (force, break strain), Viscous damping (coefficient), max pressure" in " ".join(
        err.split()
    )


def test_curves_print_the_stiffness_when_asked(run: Run) -> None:
    code, out, _ = run("curves", "--muscle", "paper", "--pressure", "6 bar", "--stiffness")
    assert code == 0
    rest = next(line for line in out.split("Stiffness of paper")[1].splitlines() if "50 mm" in line)
    # 3 L P/(2 pi n^2) of the muscle of 100 mm is 13.00311 N/mm; at half the length n halves, so twice that.
    assert [float(cell) for cell in rest.split()[-4:]] == pytest.approx(
        [26.01, 129.7, 26.01, 21.29], abs=0.06
    )


@pytest.mark.parametrize("muscle", ["DMSP-20:500mm", "DMSP-20:500 mm", "dmsp-20:0.5 m"])
def test_a_preset_takes_a_length(run: Run, muscle: str) -> None:
    assert json.loads(run("curves", "--muscle", muscle, "--json")[1])["geometry"]["nominal_length"] == 0.5


def test_a_muscle_in_a_file_may_stand_inside_muscle_but_a_drive_is_no_muscle(run: Run) -> None:
    geometry = GEOMETRY | {"nominal_length": "300 mm"}
    nested, bare = write("nested.json", {"muscle": geometry}), write("bare.json", geometry)
    assert run("curves", "--muscle", nested, "--json")[1] == run("curves", "--muscle", bare, "--json")[1]
    data = write("d.csv", CSV)
    lengths = [
        json.loads(run("compare", data, "--muscle", file, "--json")[1])["experiment"]
        for file in (nested, bare)
    ]
    assert lengths[0] == json.loads(json.dumps(lengths[1]).replace("bare.json", "nested.json"))
    drive = write("drive.json", {"muscle": geometry, "valve": "MPYE-5-1/8-HF"})
    for command in (("curves",), ("compare", data)):
        err = refused(run(*command, "--muscle", drive))
        assert "drive.json: this is a drive, not a muscle (use mckibben simulate)" in err


def test_the_length_of_the_muscle_tells_the_number_in_a_file_name(run: Run) -> None:
    muscle = write("m.json", GEOMETRY | {"nominal_length": "150 mm"})
    rows = "".join(f"{0.1 * n},{1 + 0.1 * n:.1f},{10 + n}\n" for n in range(40))
    file = write("iso_138.csv", f"# isometric test\ntime_s,pressure_bar,force_N\n{rows}")
    answer = json.loads(run("compare", file, "--muscle", muscle, "--json")[1])
    assert answer["kind"] == "isometric"
    assert answer["experiment"]["rest_length"]["value"] == pytest.approx(0.15)
    assert any("'138' (read as mm, 92 % of the rest length" in message for message in answer["messages"])
    assert "--rest-length" in refused(run("convert", file))


def test_a_muscle_can_be_a_file_by_geometry_or_a_whole_preset(run: Run) -> None:
    by_geometry = json.loads(run("curves", "--muscle", write("m.json", GEOMETRY), "--json")[1])
    assert by_geometry["model"]["effects"] == {}
    preset = json.loads((presets_folder() / "muscles" / "DMSP-20.json").read_text("utf-8"))
    by_preset = json.loads(run("curves", "--muscle", write("p.json", preset | {"id": "mine"}), "--json")[1])
    own = json.loads(run("curves", "--muscle", "DMSP-20", "--json")[1])
    assert by_preset["force"] == own["force"]
    assert by_preset["limits"] == own["limits"]


def test_ideal_drops_the_effects_and_effect_replaces_them(run: Run) -> None:
    def effects(*options: str) -> set[str]:
        return set(
            json.loads(run("curves", "--muscle", "DMSP-20", *options, "--json")[1])["model"]["effects"]
        )

    assert effects() == {"bladder_elasticity", "prestress", "lost_stroke", "dahl", "viscous_damping"}
    assert effects("--ideal") == set()
    assert effects("--effect", "prestress", "--effect", "end_caps") == {"prestress", "end_caps"}


def test_own_presets_and_effects_are_found_in_their_folders(run: Run, tmp_path: Path) -> None:
    preset = json.loads((presets_folder() / "muscles" / "paper.json").read_text("utf-8"))
    (tmp_path / "mine" / "muscles").mkdir(parents=True)
    write("mine/muscles/my-muscle.json", preset | {"id": "my-muscle"})
    (tmp_path / "effects").mkdir()
    source = Path(cli.__file__).parents[1] / "physics" / "effects" / "prestress.py"
    write("effects/my_offset.py", source.read_text("utf-8"))
    write("effects/broken.py", "1/0")
    options = ("--presets", "mine", "--effects", "effects", "--effect", "my_offset", "--json")
    code, out, err = run("curves", "--muscle", "my-muscle", *options)
    assert code == 0
    assert list(json.loads(out)["model"]["effects"]) == ["my_offset"]
    assert "broken.py" in err


# --- compare


def test_compare_prints_one_json_object(run: Run) -> None:
    code, out, err = run("compare", write("a.csv", CSV), "--muscle", "DMSP-20", "--json")
    assert (code, err) == (0, "")
    answer = json.loads(out)
    promised = {
        "kind", "rows", "rows_used", "predicted", "unit", "rmse", "nrmse_percent", "holdout_rmse",
        "noise_floor", "residual_mean", "parameters",
    }  # fmt: skip
    assert promised <= answer.keys()
    assert answer["rows"] == answer["rows_used"] == 9
    for parameters in answer["parameters"].values():
        for parameter in parameters.values():
            assert {"value", "stderr", "unit", "at_bound"} <= parameter.keys()


def test_compare_prints_tables_and_what_to_know(run: Run) -> None:
    code, out, err = run(
        "compare", write("a.csv", CSV), "--muscle", "DMSP-20", "--fit", "--free", "braid_angle"
    )
    assert code == 0
    assert "RMS error" in out
    assert "geometry.braid_angle" in out
    assert "direction of motion is unknown" in err


def test_several_files_are_compared_together(run: Run) -> None:
    write("a.csv", CSV)
    write("b.csv", CSV.replace("300;", "299;"))
    answer = json.loads(run("compare", "a.csv", "b.csv", "--muscle", "DMSP-20", "--json")[1])
    assert answer["rows"] == 18
    assert len(answer["series"]) == 6
    alone = [
        json.loads(run("compare", name, "--muscle", "DMSP-20", "--json")[1]) for name in ("a.csv", "b.csv")
    ]
    together = sum(part["rmse"] ** 2 * part["rows_used"] for part in alone)
    assert answer["rmse"] == pytest.approx((together / 18) ** 0.5)


def test_forces_and_strokes_are_not_predicted_together(run: Run) -> None:
    write("a.csv", CSV)
    write("b.csv", CSV.replace("static", "isotonic"))
    assert "b.csv is isotonic" in refused(run("compare", "a.csv", "b.csv", "--muscle", "DMSP-20"))


def test_the_file_may_name_the_muscle_and_presets_may_be_data(run: Run) -> None:
    write("a.csv", "# muscle: DMSP-20\n" + CSV)
    assert run("compare", "a.csv")[0] == 0
    assert run("compare", "musclesim-20", "--muscle", "DMSP-20")[0] == 0
    write("b.csv", CSV)
    assert "--muscle is missing" in refused(run("compare", "b.csv"))


def test_a_fit_beats_the_given_parameters(run: Run) -> None:
    def rmse(*options: str) -> float:
        return json.loads(
            run("compare", "martens-dmsp-20-300", "--muscle", "DMSP-20", *options, "--json")[1]
        )["rmse"]

    ideal, given, fitted = rmse("--ideal"), rmse(), rmse("--fit")
    assert ideal > given > fitted > rmse("--fit", "--free", "braid_angle")


def test_compare_tells_where_the_model_fails(run: Run) -> None:
    code, out, err = run("compare", "martens-dmsp-20-300", "--muscle", "DMSP-20", "--ideal")
    assert code == 0
    assert "Noise" in out
    assert "rms; this variable alone predicts" in err
    assert "What is left is no noise" in err
    answer = json.loads(run("compare", "martens-dmsp-20-300", "--muscle", "DMSP-20", "--ideal", "--json")[1])
    assert {"where", "heat_map", "whiteness", "loops", "sentences", "channels", "validation"} <= answer.keys()
    assert answer["validation"] is None


# --- one line for whatever is wrong

WRONG = [
    (["curves", "--muscle", "DMSP-21"], ["DMSP-21", "Did you mean 'DMSP-20'?"]),
    (["curves", "--muscle", "DMSP-20:300"], ["300", "no unit", "300 mm"]),
    (["curves", "--muscle", "DMSP-20:"], ["empty"]),
    (["curves", "--muscle", "DMSP-20:3kg"], ["3kg", "length"]),
    (["curves", "--muscle", "DMSP-20:-3mm"], ["nominal_length", "above 0"]),
    (["curves", "--muscle", ""], ["--muscle"]),
    (["curves", "--muscle", "none.json"], ["none.json", "No such file"]),
    (["curves", "--muscle", "."], ["file"]),
    (["curves"], ["--muscle", "DMSP-20:300mm"]),
    (["curves", "--muscl", "DMSP-20"], ["--muscl", "--muscle"]),
    (["curve", "--muscle", "DMSP-20"], ["curve", "curves"]),
    (["size", "x.json"], ["x.json", "No such file"]),
    (["curves", "--muscle", "DMSP-20", "--pressure", "1"], ["--pressure", "1 bar,3 bar"]),
    (["curves", "--muscle", "DMSP-20", "--pressure", "1 bar,,3 bar"], ["--pressure", "empty"]),
    (["curves", "--muscle", "DMSP-20", "--pressure", "-1 bar"], ["-1 bar", "between"]),
    (["curves", "--muscle", "DMSP-20", "--pressure", ",".join(["1 bar"] * 13)], ["13", "12"]),
    (["curves", "--muscle", "DMSP-20", "--effect", "prestres"], ["prestres", "Did you mean 'prestress'?"]),
    (["curves", "--muscle", "DMSP-20", "--ideal", "--effect", "prestress"], ["--ideal", "--effect"]),
    (["curves", "--muscle", "DMSP-20", "--presets", "none"], ["--presets none", "does not exist"]),
    (["curves", "--muscle", "DMSP-20", "--effects", "a.csv"], ["--effects a.csv", "not a folder"]),
    (["compare", "a.csv", "--muscle", "DMSP-20", "--free", "braid_angel"], ["braid_angel", "braid_angle"]),
    (["compare", "b.csv", "--muscle", "DMSP-20"], ["b.csv", "Did you mean 'bad.csv'?"]),
    (["compare", ".", "--muscle", "DMSP-20"], ["folder"]),
    (["compare", "none/a.csv", "--muscle", "DMSP-20"], ["none/a.csv"]),
    (["compare", "a\0b.csv", "--muscle", "DMSP-20"], ["b.csv"]),
    (["compare", "x" * 300 + ".csv", "--muscle", "DMSP-20"], ["xxx"]),
    (["compare", "--muscle", "DMSP-20"], ["DATA"]),
    (["compare", "text.csv", "--muscle", "DMSP-20"], ["text.csv"]),
    (["compare", "bad.csv", "--muscle", "DMSP-20"], ["bad.csv", "abc", "4"]),
    (["serve", "--port", "99999"], ["--port"]),
    (["serve", "--port", "x"], ["--port"]),
    (["--prot", "1"], ["--prot", "--port"]),
    (["serve", "--host", "no.such.host.invalid"], ["--host", "127.0.0.1"]),
    (["serve", "--effects", "none"], ["--effects none"]),
    (["serve", "--data", "a.csv"], ["--data a.csv", "not a folder"]),
]


@pytest.mark.parametrize(("arguments", "words"), WRONG, ids=[" ".join(w[0])[:60] for w in WRONG])
def test_bad_input_is_one_line_that_says_what_would_be_right(
    run: Run, arguments: list[str], words: list[str]
) -> None:
    write("a.csv", CSV)
    write("text.csv", "just a text\n")
    write("bad.csv", CSV.replace("1;290", "1;abc"))
    line = refused(run(*arguments))
    for word in words:
        assert word in line


MUSCLE_FILES = {
    "{": ["m.json", "line 1"],
    "[]": ["m.json", "object"],
    '{"braid_angel": 1}': ["m.json", "braid_angel", "Did you mean 'braid_angle'?"],
    '{"nominal_length": "3 kg"}': ["m.json", "nominal_length", "length"],
    '{"nominal_length": 0.3}': ["m.json", "no geometry"],
    json.dumps({**GEOMETRY, "braid_angle": "65 deg"}): ["m.json", "lengthen"],
    '{"kind": "muscle"}': ["m.json", "no length"],
    '{"preset": "DMSP-21"}': ["m.json", "DMSP-20"],
    '{"nominal_length": NaN}': ["m.json"],
}


@pytest.mark.parametrize(("content", "words"), MUSCLE_FILES.items())
def test_a_bad_muscle_file_is_named_with_its_field(run: Run, content: str, words: list[str]) -> None:
    line = refused(run("curves", "--muscle", write("m.json", content)))
    for word in words:
        assert word in line


def test_a_file_without_permission_is_said(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    name, opened = write("a.csv", CSV), Path.open

    def denied(path: Path, *args: Any, **kwargs: Any) -> Any:
        if path.name == "a.csv":
            raise PermissionError(13, "Permission denied", str(path))
        return opened(path, *args, **kwargs)

    monkeypatch.setattr(Path, "open", denied)  # a real one would not stop root
    line = refused(run("compare", name, "--muscle", "DMSP-20"))
    assert "a.csv" in line
    assert "Permission denied" in line


def test_an_unexpected_error_is_one_line_and_exit_one(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object, **__: object) -> None:
        raise RuntimeError("odd\nthing")

    monkeypatch.setattr("mckibben.cli.options.start_model", broken)
    code, out, err = run("curves", "--muscle", "DMSP-20")
    assert (code, out) == (1, "")
    assert err == "mckibben: unexpected RuntimeError: odd thing (MCKIBBEN_DEBUG=1 shows where)\n"
    monkeypatch.setenv("MCKIBBEN_DEBUG", "1")
    with pytest.raises(RuntimeError):
        cli.run(["curves", "--muscle", "DMSP-20"])


# --- help and version


def test_help_lists_only_commands_that_exist(run: Run) -> None:
    code, out, _ = run("--help")
    assert code == 0
    assert set(re.findall(r"^\W*(serve|curves|compare|simulate|diagnose|size)\b", out, re.MULTILINE)) == {
        "serve",
        "curves",
        "compare",
        "diagnose",
        "simulate",
        "size",
    }


@pytest.mark.parametrize("command", ["serve", "curves", "compare", "diagnose", "simulate", "size"])
def test_every_command_has_help(run: Run, command: str) -> None:
    code, out, err = run(command, "--help")
    assert (code, err) == (0, "")
    assert "--data" in out


def test_version(run: Run) -> None:
    assert run("--version") == (0, f"mckibben {__version__}\n", "")


# --- the real program


def program(*arguments: str) -> subprocess.CompletedProcess[bytes]:
    """The program as a user starts it."""
    return subprocess.run([*MAIN, *arguments], capture_output=True, timeout=60, check=False)


def test_the_program_answers_and_refuses() -> None:
    good = program("curves", "--muscle", "DMSP-20", "--json")
    assert good.returncode == 0
    assert good.stderr == b""
    assert json.loads(good.stdout)["pressure"]
    bad = program("curves", "--muscle", "DMSP-21")
    assert bad.returncode == 2
    assert bad.stdout == b""
    assert bad.stderr.count(b"\n") == 1


def test_a_reader_that_goes_away_is_no_error() -> None:
    process = subprocess.Popen(
        [*MAIN, "curves", "--muscle", "DMSP-20", "--json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    assert process.stdout is not None
    assert process.stderr is not None
    process.stdout.close()
    assert process.stderr.read() == b""
    process.stderr.close()
    process.wait(30)


@pytest.fixture
def started(tmp_path: Path) -> Iterator[Started]:
    """Start the program and read its first line."""
    running: list[subprocess.Popen[str]] = []

    def start(*arguments: str) -> tuple[subprocess.Popen[str], str]:
        process = subprocess.Popen(
            [*MAIN, *arguments, "--no-open", "--data", str(tmp_path / "served")],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        running.append(process)
        assert process.stdout is not None
        return process, process.stdout.readline()

    yield start
    for process in running:
        process.kill()
        process.communicate()


def test_small_answers_do_not_wait_to_be_collected() -> None:
    """Asyncio turns Nagle's algorithm off only on sockets that name their protocol."""
    with _bind("127.0.0.1", 0) as listening:
        assert listening.proto == socket.IPPROTO_TCP


def test_serve_prints_its_link_when_it_is_ready_and_stops_on_interrupt(
    started: Started, tmp_path: Path
) -> None:
    process, line = started("--port", "0")
    found = re.search(r"(http://127\.0\.0\.1:\d+)/\?token=(\S{43}) ", line)
    assert found is not None
    plain = urllib.request.build_opener(urllib.request.ProxyHandler({}))
    browser = urllib.request.Request(f"{found[1]}/api/health", headers={"sec-fetch-site": "cross-site"})
    with pytest.raises(urllib.error.HTTPError) as refused:
        plain.open(browser, timeout=5)
    assert refused.value.code == 401
    refused.value.close()
    kept = tmp_path / "served" / "token"  # for other programs of this user
    assert kept.read_text("ascii").strip() == found[2]
    if os.name == "posix":
        assert kept.stat().st_mode & 0o777 == 0o600
    bearer = {"authorization": f"Bearer {found[2]}"}
    request = urllib.request.Request(f"{found[1]}/api/health", headers=bearer)
    with plain.open(request, timeout=5) as answer:
        assert json.load(answer)["version"] == __version__
    if sys.platform == "linux":  # a program of the same account
        with plain.open(f"{found[1]}/api/health", timeout=5) as answer:
            assert answer.status == 200
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=10)
    assert process.returncode == 0
    assert out == ""
    assert "Traceback" not in err


def test_a_chosen_port_that_is_taken_is_refused() -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        result = program("serve", "--no-open", "--port", str(taken.getsockname()[1]))
    assert result.returncode == 2
    assert b"in use" in result.stderr
    assert result.stderr.count(b"\n") == 1


def test_the_default_port_moves_on_when_it_is_taken(started: Started) -> None:
    with socket.socket() as taken:
        taken.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            taken.bind(("127.0.0.1", 8000))
            taken.listen()
        except OSError:
            pass  # something else has it: as good
        _, line = started()
    found = re.search(r"http://127\.0\.0\.1:(\d+)/", line)
    assert found is not None
    assert 8000 < int(found[1]) < 8050


def test_an_address_in_a_link() -> None:
    assert _link("http", "192.0.2.7", 8000) == "http://192.0.2.7:8000/"
    assert _link("https", "[::1]", 8000) == "https://[::1]:8000/"


def test_clear_text_to_others_has_to_be_wished(run: Run) -> None:
    line = refused(run("serve", "--no-open", "--host", "0.0.0.0", "--port", "0"))
    assert "clear text" in line
    assert "--insecure" in line


@pytest.mark.skipif(not hasattr(socket, "AF_UNIX"), reason="no Unix sockets")
def test_a_unix_socket_is_of_its_user_alone(started: Started, tmp_path: Path) -> None:
    path = tmp_path / "studio.sock"
    process, line = started("--uds", str(path))
    assert f"ready at unix:{path} " in line
    assert path.stat().st_mode & 0o777 == 0o600
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as client:
        client.connect(str(path))
        client.sendall(b"GET /api/health HTTP/1.1\r\nhost: localhost\r\nconnection: close\r\n\r\n")
        assert client.makefile("rb").readline() == b"HTTP/1.1 200 OK\r\n"
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=10)
    assert not path.exists()


def test_what_is_sent_to_a_running_server_is_kept_in_its_folder(server: RunningServer) -> None:
    request = urllib.request.Request(
        f"{server.url}/api/measurements?name=a.csv", CSV.encode(), {"content-type": "text/csv"}, method="PUT"
    )
    with opener().open(request, timeout=10) as answer:
        identity = json.load(answer)["id"]
    assert (server.data / "measurements" / f"{identity}.data").read_bytes() == CSV.encode()


def test_a_file_named_like_a_preset_does_not_hide_it(tmp_path: Path) -> None:
    write("DMSP-20", "{}")
    studio = shipped_studio()
    assert start_model(studio, ModelOptions("DMSP-20")).preset is not None


def test_the_start_is_fast_because_nothing_heavy_is_imported() -> None:
    heavy = ("pandas", "scipy", "numba", "plotly", "rich", "pint")
    code = f"import sys, mckibben.server.app; print([m for m in {heavy} if m in sys.modules])"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert result.stdout.strip() == "[]"


def test_compare_takes_muscle_and_effects_of_a_drive_document(run: Run, tmp_path: Path) -> None:
    """Figures of an independent fit of the map at 296 mm: 1.26 % of full scale at its three parameters."""
    drive = tmp_path / "drive.json"
    muscle = {"preset": "DMSP-20", "nominal_length": "296 mm", "braid_angle": "26.67 deg"}
    effects = {"bladder_elasticity": {"shear_modulus": 464.7e3}, "prestress": {"force": "109.5 N"}}
    drive.write_text(json.dumps({"schema": 1, "muscle": muscle, "effects": effects}), encoding="utf-8")
    code, out, _ = run("compare", "martens-dmsp-20-300", "--drive", str(drive), "--json")
    assert code == 0
    assert json.loads(out)["nrmse_percent"] == pytest.approx(1.26, abs=0.01)
    # The model of an answer alone: the muscle is the option's.
    drive.write_text(json.dumps({"effects": effects}), encoding="utf-8")
    named = ("--drive", str(drive), "--muscle", "DMSP-20:296mm", "--json")
    code, out, _ = run("compare", "martens-dmsp-20-300", *named)
    assert json.loads(out)["parameters"]["prestress"]["force"]["value"] == pytest.approx(109.5)


@pytest.mark.parametrize(
    ("document", "word"),
    [
        ("[]", "an object"),
        ('{"effect": {}}', "'effects'"),
        ('{"effects": []}', "effects must"),
        ("{", "JSON"),
    ],
)
def test_a_drive_document_that_cannot_be_is_refused(
    run: Run, tmp_path: Path, document: str, word: str
) -> None:
    (tmp_path / "drive.json").write_text(document, encoding="utf-8")
    line = refused(run("compare", "martens-dmsp-20-300", "--drive", "drive.json", "--muscle", "DMSP-20"))
    assert "drive.json" in line
    assert word in line
