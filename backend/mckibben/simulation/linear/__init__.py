"""The linear view of a drive: matrices at an operating point, frequency response, loop, controller design."""
