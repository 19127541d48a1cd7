"""Input documents: muscle, drive, task, signals, quantities. Errors name the field."""
