"""What is read off a run: its trace, its phases, the timing figures, how a reference is followed."""
