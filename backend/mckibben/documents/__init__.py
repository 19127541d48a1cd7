"""What callers write: muscle, drive, task, signals, quantities; read with errors that name the field."""
