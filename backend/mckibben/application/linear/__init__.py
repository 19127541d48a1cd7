"""The linear view of a drive."""
