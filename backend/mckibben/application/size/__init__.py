"""From a task to ranked drives."""
