"""Fits: bounded least squares, derivatives, standard errors, error on what was left out."""
