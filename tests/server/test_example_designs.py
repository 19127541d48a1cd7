"""Example designs are questions that every door takes, and say what their source misprints."""

from __future__ import annotations

import json
from typing import Any

import pytest
from fastapi.testclient import TestClient

from mckibben import cli
from mckibben.presets import DesignPreset
from tests.shipped import shipped_studio

DESIGNS = [each for each in shipped_studio().library.list("designs") if isinstance(each, DesignPreset)]


@pytest.mark.parametrize("design", DESIGNS, ids=lambda design: design.id)
def test_a_design_is_answered_alike_over_http_and_on_the_command_line(
    design: DesignPreset, client: TestClient, capsys: pytest.CaptureFixture[str]
) -> None:
    answer = client.post("/api/curves", json=design.document)
    assert answer.status_code == 200, answer.text
    assert cli.run(["curves", "--muscle", design.id, "--json"]) == 0
    shown = capsys.readouterr()
    assert json.loads(shown.out) == {"schema": 1, **answer.json()}
    assert all(misprint in shown.err for misprint in design.misprints)


def test_figure_9_has_the_forces_of_the_ideal_braid(client: TestClient) -> None:
    """P A0 (2/sin² 25° - 3) of 10 mm; the paper prints 386.32 N for the last and calls all three measured."""
    document: dict[str, Any] = next(each.document for each in DESIGNS if each.id == "paper-fig-9")
    force = client.post("/api/curves", json=document).json()["force"]
    assert [curve[0] for curve in force] == pytest.approx([64.3855, 193.1566, 386.3132], abs=1e-4)
