"""Facts that people see, each declared once: figures, units, what a result holds."""
