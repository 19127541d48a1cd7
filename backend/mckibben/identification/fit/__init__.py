"""Fits: bounded least squares, derivatives, standard errors, hold-out error."""
