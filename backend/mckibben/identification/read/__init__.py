"""Readers of measurement files, one format a file, all giving the same Measurement."""
