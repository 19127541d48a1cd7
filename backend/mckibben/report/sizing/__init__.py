"""The sizing report: task, drive, curves, run, margins, uncertainty, alternatives, parts, equations."""
