"""Grids that are no columns below a head, rewritten as such; rows keep their numbers."""

from __future__ import annotations

from mckibben.measurement.read.reshape.regular import Regular, regular

__all__ = ["Regular", "regular"]
