"""Maps among named values: two vectors and a matrix over them."""

from __future__ import annotations

import io

import numpy as np
import pytest
from scipy.io import savemat

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading import read_measurement
from mckibben.physics.errors import InputError

PRESSURE = np.array([1.0, 2.0, 3.0, 4.0, 5.0])  # bar
SHARE = np.arange(0.0, 24.0, 2.0)  # %
FORCE = np.round(120.0 * PRESSURE * (1.0 - SHARE[:, None] / 26.0) ** 2, 1)  # N, contraction down


def read(**values: object) -> Measurement:
    file = io.BytesIO()
    savemat(file, values)
    return read_measurement(file.getvalue(), "map.mat")


def assert_is_the_map(result: Measurement, stroke: str = "contraction", factor: float = 0.01) -> None:
    order = np.lexsort((result.columns[stroke], result.columns["pressure"]))  # rows stand as in the matrix
    found = {name: values[order] for name, values in result.columns.items()}
    np.testing.assert_allclose(found["pressure"], np.repeat(PRESSURE, len(SHARE)) * 1e5)
    np.testing.assert_allclose(found[stroke], np.tile(SHARE, len(PRESSURE)) * factor)
    np.testing.assert_allclose(found["force"], FORCE.T.reshape(-1))


@pytest.mark.parametrize("turned", [False, True])
def test_a_matrix_over_two_vectors_is_a_map_either_way_round(turned: bool) -> None:
    result = read(p_bar=PRESSURE, contraction_pct=SHARE[:, None], F_N=FORCE.T if turned else FORCE)
    assert result.kind == "static"
    assert any("a map of" in message for message in result.messages)
    assert_is_the_map(result)


def test_in_a_struct_with_other_names() -> None:
    values = {"Druck_bar": PRESSURE, "Hub_mm": SHARE, "Kraft_N": FORCE.T, "L0_mm": 200.0}
    result = read(kennfeld=values)
    assert_is_the_map(result, "displacement", 1e-3)
    assert result.conditions["nominal_length"] == pytest.approx(0.2)


def test_cells_without_a_reading_are_left_out_and_counted() -> None:
    force = FORCE.copy()
    force[-2:, 0] = np.nan
    result = read(p_bar=PRESSURE, contraction_pct=SHARE, F_N=force)
    assert result.rows == FORCE.size - 2
    assert sum(result.skipped.values()) == 2


def test_a_square_map_is_refused_as_either_side_could_be_the_pressure() -> None:
    with pytest.raises(InputError, match=r"'F_N': a map of 5 x 5 cells .* either of which could be its rows"):
        read(p_bar=PRESSURE, contraction_pct=SHARE[:5], F_N=FORCE[:5])


def test_a_matrix_that_fits_no_vectors_is_said() -> None:
    rows = {"p_bar": np.linspace(1.0, 5.0, 12), "contraction_pct": SHARE, "force_N": FORCE[:, 0]}
    result = read(**rows, noise_N=np.ones((3, 4)))
    assert any("'noise_N' is not used" in message for message in result.messages)
