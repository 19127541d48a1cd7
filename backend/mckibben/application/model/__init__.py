"""Models as files and presets."""
