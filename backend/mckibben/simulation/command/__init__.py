"""The command of a drive: signals of time as linear segments, and the sampled position controller."""
