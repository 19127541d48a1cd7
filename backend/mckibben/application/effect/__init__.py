"""The check of an effect file: what it claims, whether it is found again, and where it is seen."""
