"""Find missing effects: search, indistinguishable effects, verdict, and the next experiment."""
