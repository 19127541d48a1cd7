"""Effects for mckibben: the seal of a sliding end fitting."""
