"""Fits: bounded least squares, derivatives, standard errors, held-out error."""
