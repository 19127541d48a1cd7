"""The report of a diagnosis: data, model, error, where it fails, what is missing, how to reproduce it."""
