"""Pure physics of pneumatic muscles: plain functions on numbers, arrays and symbols. No I/O, no HTTP."""
